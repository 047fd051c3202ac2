#!/usr/bin/env bash
# Tests of the program as people meet it: exit codes, messages, what is left on disk.
# Usage: run.sh PATH/TO/drypoint [NAME-PATTERN | --part K/N]. Prints TAP and a closing count. Part K of N has every
# N-th test; CLI_TIMES=1 prints how long each took, in ms. SANITIZED=1: a sanitizer's build, which is slow: what repeats
# drawings or is large, and whose code others run, is left out.
set -u
program=$(realpath "${1:?usage: run.sh PATH/TO/drypoint [PATTERN | --part K/N]}")
pattern=${2:-} part=1 parts=1
if [ "$pattern" = --part ]; then
    part=${3%/*} parts=${3#*/} pattern=
fi
broken_assimp=$(dirname "$program")/tests/libbroken_assimp.so
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d "${TMPDIR:-/tmp}/drypoint-cli-XXXXXX")
trap 'chmod -R u+w "$work"; rm -rf "$work"' EXIT
cd "$work" || exit 1

passed=0 failed=0 number=0 problem=

# fail TEXT: the test that runs has failed; the first reason is told.
fail() { [ -n "$problem" ] || problem=$1; }

# run CODE ARGS...: runs the program; its exit code must be CODE. Fills out and err.
run() {
    local wanted=$1 code=0
    shift
    "$program" "$@" >out 2>err </dev/null || code=$?
    [ "$code" = "$wanted" ] || fail "drypoint $*: exit code $code, not $wanted: $(head -c 300 err)"
}

# says FILE TEXT: a line of FILE holds TEXT.
says() { grep -qF -e "$2" "$1" || fail "$1 does not say \"$2\" but: $(head -c 400 "$1")"; }
silent() { [ ! -s "$1" ] || fail "$1 is not empty: $(head -c 300 "$1")"; }
# one_line: errors are one line and begin with the program's name.
one_line() {
    [ "$(wc -l <err)" = 1 ] || fail "not one line: $(head -c 400 err)"
    grep -q '^drypoint: ' err || fail "does not begin with drypoint: $(head -c 300 err)"
}
absent() { [ ! -e "$1" ] || fail "$1 is there"; }
no_temporary() {
    [ -z "$(find . -name '.drypoint-*')" ] || fail "a temporary file is left: $(find . -name '.drypoint-*')"
}
is_png() {
    [ "$(head -c 8 "$1" | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ] || fail "$1 is no PNG"
    [ "$(tail -c 8 "$1" | head -c 4)" = IEND ] || fail "$1 is cut short"
}
# png_size FILE: width and height, from its header.
png_size() { od -An -tu1 -j16 -N8 "$1" | awk '{print $1*16777216+$2*65536+$3*256+$4 "x" $5*16777216+$6*65536+$7*256+$8}'; }

# wrong ARGS... -- TEXT: wrong usage that says TEXT, leaves nothing.
wrong() {
    local arguments=()
    while [ "$1" != -- ]; do arguments+=("$1"); shift; done
    run 2 "${arguments[@]}"
    one_line
    says err "$2"
    silent out
    absent out.png
}

# bad FILE TEXT: a model that cannot be drawn; TEXT is said, nothing is left.
bad() {
    run 1 "$1" -o out.png
    one_line
    says err "$2"
    silent out
    absent out.png
    no_temporary
}

small="--size 160x120"

# ---- what it does ----

draws() {
    run 0 shape:gear $small -o out.png
    silent out
    silent err
    is_png out.png
    [ "$(png_size out.png)" = 160x120 ] || fail "size is $(png_size out.png)"
}
default_size() {
    run 0 shape:cube -o out.png
    [ "$(png_size out.png)" = 1600x1200 ] || fail "size is $(png_size out.png)"
}
standard_output() {
    run 0 shape:bolt $small -o -
    is_png out
    cp out first
    run 0 shape:bolt $small -o out.png
    cmp -s first out.png || fail "differs from the same picture in a file"
}
standard_input() {
    run 0 make bolt -o b.stl
    run 0 b.stl $small -o file.png
    "$program" - $small -o - <b.stl >redirected.png || fail "redirected"
    cat b.stl | "$program" - $small -o - >piped.png || fail "piped"
    cmp -s file.png redirected.png || fail "standard input from a file differs"
    cmp -s file.png piped.png || fail "standard input from a pipe differs"
    for given in '--detail exact' '--up y' '--view iso --ortho 0' '--size 500x500' '--hidden thin' '--edges adjacency'; do
        run 0 b.stl $small $given -q -o trace=file.txt
        cat b.stl | "$program" - $small $given -q -o trace=piped.txt || fail "piped, $given"
        cmp -s file.txt piped.txt || fail "standard input from a pipe differs with $given"
    done
    run 0 b.stl --size 640x480 --azimuth 70 --detail exact -o file.png
    cat b.stl | "$program" - --size 640x480 --azimuth 70 --detail exact -o - >piped.png || fail "piped"
    cmp -s file.png piped.png || fail "triangles from a pipe are drawn as polygons"
}
# A file that does not fit is read twice, in parts: the picture is the same.
streamed() {
    local small="--size 160x120 --lines silhouette,ridge,valley"
    run 0 make sphere --triangles 600000 -o t.stl
    run 0 t.stl $small -o held.png --stats=json
    grep -q '"polygons": 5' out || fail "statistics: $(cat out)"
    run 0 t.stl $small -o streamed.png --memory 48M --stats=json
    grep -q '"polygons": 5' out || fail "statistics, streamed: $(cat out)"
    grep -q '"edges_lost": 0,' out || fail "edges are lost: $(cat out)"
    silent err
    cmp -s held.png streamed.png || fail "differs from the picture from memory"
    run 0 t.stl $small -o threads.png --memory 50331648 --threads 3
    cmp -s held.png threads.png || fail "differs with three threads"
    run 0 t.stl $small -o once.png --memory 48m --passes 1
    is_png once.png
    for size in 0 1M -5 47M 12Q M ''; do wrong t.stl -o out.png --memory "$size" -- --memory; done
    head -c 20000000 t.stl >cut.stl
    run 1 cut.stl -o out.png --memory 48M
    says err 'cut short'
    absent out.png
}
streamed_from_a_pipe() {
    run 0 make terrain --triangles 1300000 -o t.stl
    view='--eye 3,2,3 --target 0,0,0 --fov 35'
    "$program" - $small -o out.png --memory 48M <<<"$(true)" 2>err && fail "an empty pipe"
    cat t.stl | "$program" - $small $view -o out.png --memory 48M 2>err && fail "a pipe that does not fit"
    one_line
    says err '--passes 1'
    absent out.png
    cat t.stl | "$program" - $small $view -o piped.png --memory 48M --passes 1 || fail "once through"
    run 0 t.stl $small $view -o file.png --memory 48M --passes 1
    is_png piped.png
    [ "$(png_size piped.png)" = "$(png_size file.png)" ] || fail "sizes differ"
}
same_for_any_threads() {
    for threads in 1 2 7; do
        run 0 shape:gear --size 320x240 --threads $threads -o $threads.png
        cmp -s 1.png $threads.png || fail "$threads threads differ from one"
    done
}
equals_sign() {
    run 0 shape:cube --size=160x120 --width=silhouette=4,ridge=1 --color=valley=#f00 --output=out.png
    run 0 shape:cube $small --width silhouette=4,ridge=1 --color valley=#ff0000 -oother.png
    cmp -s out.png other.png || fail "--name=value differs from --name value"
}
every_option() {
    run 0 shape:boxes $small --samples 8 --threads 2 --eye 3,2,4 --target 0,0,0 --up 0,1,0 --fov 30 \
        --zoom 1.2 --lines silhouette,ridge,valley,intersection,border --width 3 --color '#204060' \
        --paper '#FFFDF5' --surface '#EEEEEE' --ridge-angle 140 --valley-angle 220 --method exact \
        --between plane --ink strokes --edge-table on --cull-back-faces --quiet -o out.png
    run 0 shape:boxes $small --view iso --ortho 0 --azimuth 30 --elevation -20 --lines all \
        --paper none --surface none -o out.png
    is_png out.png
}
views_differ() {
    for view in front back left right top bottom iso; do
        run 0 shape:bracket $small --view $view -o $view.png
    done
    cmp -s front.png right.png && fail "front and right are the same"
    cmp -s top.png bottom.png && fail "top and bottom are the same"
    run 0 shape:bracket $small --azimuth 90 --elevation 0 -o angles.png
    cmp -s right.png angles.png || fail "--view right differs from --azimuth 90 --elevation 0"
}
# What is up: by word, by numbers, by the file; views and angles turn with it.
what_is_up() {
    local pair
    for kind in ply stl; do run 0 make bracket --triangles 500 -o b.$kind; done
    for kind in ply stl; do
        run 0 b.$kind $small -o $kind.png
        silent err
    done
    for pair in 'ply y' 'ply +y' 'ply 0,3,0' 'stl z' 'stl 0,0,0.5'; do
        run 0 b.${pair% *} $small --up ${pair#* } -o other.png
        cmp -s ${pair% *}.png other.png || fail "b.${pair% *} does not stand on ${pair#* }"
    done
    "$program" - $small -o piped.png <b.stl || fail "in a pipe"
    cmp -s stl.png piped.png || fail "a piped STL does not stand on z"
    for up in x y z -x -y -z; do
        run 0 b.ply $small --up $up -o ./$up.png
        for view in 'front 0 0' 'right 90 0' 'back 180 0' 'left -90 0' 'top 0 90' 'bottom 0 -90'; do
            set -- $view
            run 0 b.ply $small --up $up --view $1 -o view.png
            run 0 b.ply $small --up $up --azimuth $2 --elevation $3 -o angles.png
            cmp -s view.png angles.png || fail "--up $up: --view $1 is not at $2, $3"
        done
    done
    [ "$(md5sum ./x.png ./y.png ./z.png ./-x.png ./-y.png ./-z.png | cut -c1-32 | sort -u | wc -l)" = 6 ] ||
        fail "two ups are one"
    run 0 b.ply $small --up 0,0,-1 -o other.png
    cmp -s ./-z.png other.png || fail "-z is not 0,0,-1"
    run 0 b.stl $small -o b.svg
    one_line
    says err '; up is +z, as usual in STL (--up y turns it)'
    run 0 b.ply $small -o b.svg
    says err '; up is +y, as the file does not say (--up z turns it)'
    for given in 'b.stl --up z' 'b.stl -q' shape:bracket; do
        run 0 $given $small -o b.svg
        grep -q 'up is' err && fail "$given: $(cat err)"
    done
    run 0 info b.stl
    says out '0 0 1 (as is usual: the file does not say)'
    run 0 info "$here/../unit/files/thumbnail.3mf" # read in a process of its own
    grep -q '^up  *0 0 1$' out || fail "3MF: $(tail -1 out)"
    run 0 info --json shape:bracket
    says out '"up": [0, 1, 0], "up_said": true'
    wrong b.ply --up w -o out.png -- '--up: "w" is no direction; give x, y, z, -x, -y, -z, or three numbers'
    wrong b.ply --up 0,0,0 -o out.png -- '--up: 0,0,0 has no direction'
    wrong b.ply --up 1,2 -o out.png -- '--up: "1,2" is not a point'
}
# Beside its edges lie polygons that are only seen beyond cracks.
distant_terrain() {
    run 0 shape:terrain:20000 $small --samples 1 --eye 3.22979594,1.05012956,0.458683927 \
        --target 2.32320177,0.659575166,0.298826913 -o out.png
}
eye_alone_looks_at_the_centre() {
    run 0 shape:cube $small --eye 5,3,5 --fov 30 -o a.png
    run 0 shape:cube $small --eye 5,3,5 --fov 30 --target 0,0,0 -o b.png
    cmp -s a.png b.png || fail "--eye alone does not look at the centre"
    run 0 shape:cube $small --target 0,0,0 --fov 30 -o a.png
    run 0 shape:cube $small --target 0,0,0.2 --fov 30 -o b.png
    cmp -s a.png b.png && fail "--target moves nothing"
}
made_models() {
    for shape in cube tetrahedron sphere torus cylinder gear bolt bracket stairs boxes flag torso terrain; do
        for ending in ply stl obj; do
            run 0 make $shape -o $shape.$ending --triangles 2000
            run 0 info --json $shape.$ending
            says out '"dropped": 0'
            [ $shape = terrain ] || [ $shape = flag ] || says out '"open_edges": 0'
            cp out $ending.json
        done
        [ "$(grep -o '"polygons": [0-9]*' stl.json)" = "$(grep -o '"polygons": [0-9]*' obj.json)" ] ||
            fail "$shape: STL and OBJ differ"
    done
}
sizes_and_seeds() {
    run 0 make cube --size 7 -o c.obj
    run 0 info --json c.obj
    says out '"min": [-3.5, -3.5, -3.5]'
    run 0 make terrain --seed 1 -o a.ply
    run 0 make terrain --seed 2 -o b.ply
    cmp -s a.ply b.ply && fail "seeds 1 and 2 are the same"
}
info_table() {
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nf 1 2 3\nf 1 2 4\nf 1 1 2\nf 1 2 9\n' >m.obj
    run 0 info m.obj
    says out 'polygons                         4'
    says out 'open edges met                   3'
    says out 'would be dropped                 3'
    run 0 info m.obj --json
    says out '"dropped_finite": 1'
    says out '"dropped_index": 1'
    says out '"dropped_area": 1'
}
# away X Y Z <OBJ: the model moved, all digits kept.
away() {
    awk -v x="$1" -v y="$2" -v z="$3" '$1 == "v" { printf "v %.3f %.3f %.3f\n", $2 + x, $3 + y, $4 + z; next } { print }'
}
# as_stl <OBJ: triangles as ASCII STL.
as_stl() {
    awk 'BEGIN { print "solid house" } END { print "endsolid house" } $1 == "v" { v[++n] = $2 " " $3 " " $4 }
        $1 == "f" { for (i = 3; i < NF; i++) printf "facet normal 0 0 0\nouter loop\nvertex %s\nvertex %s\nvertex %s\nendloop\nendfacet\n",
            v[$2], v[$i], v[$(i + 1)] }'
}
# A house in survey coordinates, where float32 has steps of half a metre: the picture of the same house at 0.
far_from_zero() {
    local view='--up 0,0,1 --size 320x240' x=692345 y=5334567 z=512 count
    cat >house.obj <<'EOF'
v 0.125 0 0
v 6.375 0 0
v 6.375 4.625 0
v 0.125 4.625 0
v 0.125 0 3.125
v 6.375 0 3.125
v 6.375 4.625 3.125
v 0.125 4.625 3.125
v 0.125 2.25 4.875
v 6.375 2.25 4.875
f 4 3 2 1
f 1 2 6 5
f 3 4 8 7
f 2 3 7 10 6
f 4 1 5 9 8
f 5 6 10 9
f 7 8 9 10
EOF
    away $x $y $z <house.obj >far.obj
    as_stl <house.obj >house.stl
    as_stl <far.obj >far.stl
    for kind in obj stl; do
        run 0 house.$kind $view --azimuth 30 --elevation 25 --ortho 0 -o near.png
        run 0 far.$kind $view --azimuth 30 --elevation 25 --ortho 0 -o far.png
        silent err
        cmp -s near.png far.png || fail "$kind: fitted pictures differ"
        run 0 house.$kind $view --eye 12,-9,7 --target 3,2,1 -o near.png
        run 0 far.$kind $view --eye 692357,5334558,519 --target 692348,5334569,513 -o far.png --stats=json
        silent err
        says out '"dropped": 0,'
        cmp -s near.png far.png || fail "$kind: placed pictures differ"
    done
    cat far.stl | "$program" - $view --eye 692357,5334558,519 --target 692348,5334569,513 -o piped.png 2>err || fail "piped"
    cmp -s far.png piped.png || fail "differs from a pipe"
    cat house.stl | "$program" - $view --eye 12,-9,7 --target 3,2,1 --passes 1 -o near.png || fail "once"
    cat far.stl | "$program" - $view --eye 692357,5334558,519 --target 692348,5334569,513 --passes 1 -o far.png ||
        fail "far, once"
    cmp -s near.png far.png || fail "read once, pictures differ"
    run 0 house.obj $view --mirror 0,0,1 --elevation 20 -o near.png
    run 0 far.obj $view --mirror 0,0,1 --elevation 20 -o far.png
    cmp -s near.png far.png || fail "mirrors differ"
    run 0 info far.obj
    silent err
    says out 'bounds from                      692345.125 5334567 512'
    says out 'bounds to                        692351.375 5334571.625 516.875'
    run 0 info far.obj --json
    says out '"min": [692345.125, 5334567, 512], "max": [692351.375, 5334571.625, 516.875]'
}
# float32 in the file itself: nothing brings the digits back, and that is said.
coarse_files_are_told() {
    {
        printf 'ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n'
        printf 'property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n'
        printf '\x80\xcb\xa4\x4a\x00\x00\x00\x00\x00\x00\x00\x00' # 5400000 0 0
        printf '\x84\xcb\xa4\x4a\x00\x00\x00\x00\x00\x00\x00\x00' # 5400002 0 0
        printf '\x80\xcb\xa4\x4a\x00\x00\x80\x3f\x00\x00\x00\x00' # 5400000 1 0
        printf '\x03\x00\x00\x00\x00\x01\x00\x00\x00\x02\x00\x00\x00'
    } >coarse.ply
    run 0 coarse.ply $small --view front -o out.png
    says err 'warning: coarse.ply: so far from 0 its coordinates are 0.5 apart as float32'
    run 0 coarse.ply $small --view front --quiet -o out.png
    silent err
    run 0 info coarse.ply
    says err 'are 0.5 apart'
    {
        printf 'AC3Db\nMATERIAL "m" rgb 1 1 1 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 0 trans 0\nOBJECT world\nkids 1\n'
        printf 'OBJECT poly\nname "far"\nnumvert 3\n0 5334567 0\n0.25 5334567 0\n0 5334567.7 0\nnumsurf 1\n'
        printf 'SURF 0x10\nmat 0\nrefs 3\n0 0 0\n1 0 0\n2 0 0\nkids 0\n'
    } >coarse.ac # through Assimp, in a process of its own
    run 0 info coarse.ac
    says err 'are 0.5 apart'
}
stats() {
    run 0 shape:cube $small --stats -o out.png
    says err 'polygons'
    silent out
    run 0 shape:cube $small --stats json -o out.png
    says out '"frame_ms"'
    silent err
    run 0 shape:cube $small --stats=json -o -
    says err '"frame_ms"'
    is_png out
}
bench_json() {
    run 0 bench shape:gear $small --frames 3
    silent err
    for key in frames frame_ms frame_ms_min frame_ms_max stages triangles added_polygons segments \
        width height samples threads; do
        says out "\"$key\": "
    done
    [ "$(wc -l <out)" = 1 ] || fail "not one line"
    ! command -v python3 >/dev/null || python3 -m json.tool <out >/dev/null || fail "no JSON"
}
helps() {
    run 0 --help all
    cp out all
    for command in '' info make bench; do
        run 0 $command --help
        [ -n "$command" ] || cp all out
        says out "Usage: drypoint $command"
        says out 'Examples:'
        silent err
        [ "$(awk 'length > 80' out | grep -vc '^  drypoint')" = 0 ] || fail "lines longer than 80"
    done
    run 0 --help make
    says out 'Usage: drypoint make'
    run 0 -h all
    for name in size samples threads eye target up fov ortho view azimuth elevation zoom lines width \
        color paper surface ridge-angle valley-angle method between ink passes stats quiet; do
        says out "--$name"
    done
    run 0 --version
    grep -qE '^drypoint [0-9]+\.[0-9]+\.[0-9]+$' out || fail "version: $(cat out)"
}
man_page() {
    run 0 --man
    cmp -s out "$here/../../docs/man/drypoint.1" ||
        fail "docs/man/drypoint.1 is out of date: build/drypoint --man > docs/man/drypoint.1"
}

# ---- wrong usage ----

nearest_option() {
    wrong shape:cube --widht 3 -o out.png -- 'unknown option --widht; did you mean --width?'
    wrong shape:cube --sample=8 -o out.png -- 'did you mean --samples?'
    wrong shape:cube -width 3 -o out.png -- 'did you mean --width?'
    wrong info --jsn x -- 'did you mean --json?'
    wrong shape:cube --vew top -o out.png -- 'did you mean --view?'
    wrong shape:cube --view topp -o out.png -- 'did you mean top?'
    wrong shape:cube --lines ridge,vally -o out.png -- 'did you mean valley?'
    wrong make geer -o out.ply -- 'did you mean "gear"?'
    wrong shape:gaer -o out.png -- 'did you mean "gear"?'
    wrong make pyramid -o out.ply -- 'no shape is called "pyramid"; there are cube, '
    wrong shape:cube --view under -o out.png -- '--view: "under" is none of front|back|'
}
wrong_values() {
    for value in nan inf 3x '' 1e999 0x10 180 0 -5; do
        wrong shape:cube --fov "$value" -o out.png -- '--fov: '
    done
    for value in 0 33000x10 10 x 10x 10x10x10 -1x5 1.5x2; do
        wrong shape:cube --size "$value" -o out.png -- '--size: '
    done
    for value in 1,2 1,2,3,4 1,2,x nan,0,0 ,,; do
        wrong shape:cube --eye "$value" -o out.png -- '--eye: '
    done
    for value in 0 65 ridge=0.1 ridge= =3 3,; do
        wrong shape:cube --width "$value" -o out.png -- '--width: '
    done
    for value in rde '#12345' '#GGGGGG' ridge=nonce; do
        wrong shape:cube --color "$value" -o out.png -- '--color: '
    done
    wrong shape:cube --samples 3 -o out.png -- '1|4|8|16'
    wrong shape:cube --threads 0 -o out.png -- '--threads: '
    wrong shape:cube --threads 257 -o out.png -- 'give 1 to 256'
    wrong shape:cube --elevation 91 -o out.png -- '--elevation: '
    wrong shape:cube --ridge-angle 360 -o out.png -- '--ridge-angle: '
    wrong shape:cube --stats=xml -o out.png -- '--stats: '
    wrong shape:cube --quiet=1 -o out.png -- 'takes no value'
    wrong bench shape:cube --frames 0 -- '--frames: '
    wrong make cube -o out.ply --triangles 99999999999999999999 -- '--triangles: '
    wrong shape:cube:12x -o out.png -- 'not a whole number'
}
missing_words() {
    wrong -- 'no model given'
    wrong shape:cube -- 'add -o OUT.png'
    wrong make -o out.ply -- 'no shape given'
    wrong make cube -- 'add -o OUT.ply'
    wrong shape:cube -o -- 'needs a value'
    wrong shape:cube --width --samples 4 -o out.png -- 'needs a value'
    wrong make cube sphere -o out.ply -- 'one shape at a time'
    wrong info shape:cube --width 3 -- 'does not belong to'
    wrong bench shape:cube -o out.png -- 'does not belong to'
}
wrong_endings() {
    wrong shape:cube -o out.jpg -- 'out.png'
    wrong shape:cube -o out -- 'out.png'
    wrong make cube -o out.off -- 'out.ply'
    absent out.jpg
    absent out.off
}
contradictions() {
    wrong shape:cube --fov 30 --ortho 2 -o out.png -- 'exclude each other'
    wrong shape:cube --eye 1,2,3 --view top -o out.png -- '--eye already says'
    wrong shape:cube --eye 1,2,3 --target 1,2,3 -o out.png -- 'the eye is where it looks at'
}
a_shape_is_no_file() {
    run 1 gear -o out.png
    one_line
    says err 'shape:gear'
    says err 'drypoint make gear'
}

# ---- bad input ----

bad_files() {
    bad missing.obj 'missing.obj: '
    mkdir -p folder
    bad folder 'folder: '
    : >empty.ply
    bad empty.ply 'empty.ply: '
    printf 'v 0 0 0\nv 1 0 0\nv 0 one 0\nf 1 2 3\n' >number.obj
    bad number.obj 'number.obj:3: '
    printf 'v 0 0 0\n' >points.obj
    bad points.obj 'points.obj: '
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n' >index.obj
    bad index.obj 'index.obj'
    printf 'v 0 0 0\nv 1 0 0\nv inf 1 0\nf 1 2 3\n' >infinite.obj
    bad infinite.obj 'infinite.obj'
    printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n' >flat.obj
    bad flat.obj 'flat.obj'
    head -c 3000 /dev/urandom >noise.xyz
    bad noise.xyz 'noise.xyz'
}
cut_files() {
    run 0 make gear -o whole.ply
    run 0 make gear -o whole.stl
    head -c 100000 whole.ply >cut.ply
    bad cut.ply 'cut.ply: byte '
    head -c 100000 whole.stl >cut.stl
    bad cut.stl 'cut.stl'
}
huge_counts() {
    printf 'ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\nproperty float z\nelement face 4000000000\nproperty list uchar int vertex_indices\nend_header\n1234' >huge.ply
    bad huge.ply 'huge.ply'
    printf 'OFF\n4000000000 4000000000 0\n0 0 0\n' >huge.off
    bad huge.off 'huge.off'
}
dropped_are_counted() {
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nf 1 2 3\nf 1 2 4\nf 1 1 2\nf 1 2 9\n' >some.obj
    run 0 some.obj $small -o out.png
    one_line
    says err 'warning: 3 of 4 polygons dropped'
    is_png out.png
    run 0 some.obj $small --quiet -o out.png
    silent err
}
# Few polygons without area are usual, and leave no hole.
flat_triangles_are_passed_over() {
    run 0 make gear -o gear.obj
    printf 'f 1 1 2\nf 1 2 2\n' >>gear.obj
    run 0 gear.obj $small -o out.png --stats
    grep -q 'no area *2$' err || fail "--stats: $(cat err)"
    grep -q warning err && fail "two triangles without area of many are worth a warning"
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 2\n' >half.obj
    run 0 half.obj $small -o out.png
    one_line
    says err 'warning: 1 of 2 polygons dropped: 1 without area'
    printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4 1 2 3 4 1 2 3 4\n' >repeated.obj
    run 0 repeated.obj $small -o out.png
    silent err
}
unclosed_solids_are_told() {
    printf 'solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\nendloop\nendfacet\n' >a.stl
    run 0 a.stl $small -o out.png
    one_line
    says err 'warning: ASCII STL without its last `endsolid`'
    run 0 info a.stl
    says err 'warning: ASCII STL without its last `endsolid`'
    "$program" - $small -o piped.png <a.stl 2>err || fail "not read from a pipe"
    says err 'warning: ASCII STL without its last `endsolid`'
    cmp -s out.png piped.png || fail "another picture from a pipe"
}
# What an error tells to do can be done.
advice() {
    printf 'Kaydara FBX' >scene
    cp scene scene.obj
    for model in scene scene.obj; do bad $model 'this is an FBX file: give its path, ending in .fbx'; done
    "$program" - -o out.png <scene 2>err && fail "FBX from a pipe"
    says err 'standard input: this is an FBX file: give its path, ending in .fbx'
    printf 'hello\n' >x.xyz
    bad x.xyz 'x.xyz: not in a known format: convert it to STL, PLY, OBJ or OFF, or, if it is a model, give a file whose name has its format'\''s ending (.stl, .obj, .gltf'
    printf '\377\376v\0 \0' >wide.obj
    bad wide.obj 'this is UTF-16 text: convert it to UTF-8, e.g. iconv -f UTF-16 -t UTF-8'
}
missing_materials_are_told() {
    printf 'mtllib gone.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >red.obj
    run 0 red.obj $small -o out.png # no colours are asked for
    silent err
    run 0 red.obj $small --style lambert -o plain.png
    one_line
    says err 'warning: no colours from gone.mtl: No such file'
    printf 'newmtl red\nKd 1 0 0\n' >gone.mtl
    run 0 red.obj $small --style lambert -o out.png
    silent err
    cmp -s out.png plain.png && fail "the material's colour is not seen"
}

colors_of_vertices_are_drawn() {
    printf 'v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nf 1 2 3\n' >red.obj
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >plain.obj
    for option in "--style lambert" "--style flat --model-colors on"; do
        run 0 red.obj $small $option -o red.png
        run 0 plain.obj $small $option -o plain.png
        cmp -s red.png plain.png && fail "$option: the vertices' colours are not seen"
    done
    run 0 red.obj $small -o red.png
    run 0 plain.obj $small -o plain.png
    cmp -s red.png plain.png || fail "the vertices' colours are seen where nobody asked for them"
    silent err
}

# broken CODE ARGS...: as run, with an Assimp that breaks.
broken() {
    local wanted=$1 code=0
    shift
    LD_PRELOAD=$broken_assimp "$program" "$@" >out 2>err </dev/null || code=$?
    [ "$code" = "$wanted" ] || fail "drypoint $*: exit code $code, not $wanted: $(head -c 300 err)"
}
# left WORD: processes whose command line holds WORD, but for the one that looks.
left() { grep -sl -e "[${1:0:1}]${1:1}" /proc/[0-9]*/cmdline; }
broken_readers() {
    [ -e "$broken_assimp" ] || return # not beside sanitizers
    local file
    for file in crash exit memory hang; do printf 'Kaydara FBX' >$file.fbx; done
    broken 1 crash.fbx -o out.png
    one_line
    says err "crash.fbx: Assimp's reader of .fbx files crashed on it (Aborted): export it again"
    silent out
    broken 1 info exit.fbx
    one_line
    says err "exit.fbx: Assimp's reader of .fbx files gave up on it"
    broken 1 memory.fbx -o out.png
    one_line
    says err "memory.fbx: Assimp's reader of .fbx files"
    broken 1 hang.fbx --read-time 0.5 -o out.png
    one_line
    says err "hang.fbx: Assimp's reader of .fbx files was not done after 0.5 s: give it more with --read-time"
    absent out.png
    [ -z "$(left hang.fbx)" ] || fail "a child is left after the time was over"
}
interrupted_readers() {
    [ -e "$broken_assimp" ] || return
    local signal file code
    for signal in INT TERM KILL; do
        file=hang-$$-$signal.fbx code=0
        printf 'Kaydara FBX' >$file
        # to the program alone: a terminal would send it to the child, too
        LD_PRELOAD=$broken_assimp timeout --foreground --preserve-status -s $signal 0.5 \
            "$program" info $file >out 2>err </dev/null || code=$?
        case $signal:$code in INT:130 | TERM:143 | KILL:137) ;; *) fail "SIG$signal: exit code $code" ;; esac
        sleep 0.2
        [ -z "$(left $file)" ] || fail "a child is left after SIG$signal"
    done
} 2>/dev/null # the shell tells who was killed

# ---- outputs ----

old_file_stays_on_error() {
    echo old >out.png
    run 1 missing.obj -o out.png
    [ "$(cat out.png)" = old ] || fail "the old file is gone"
    no_temporary
}
full_disk() {
    [ -w /dev/full ] || return
    run 1 shape:cube $small -o /dev/full
    one_line
    says err 'No space left on device'
    run 1 make cube -o /dev/full
    says err 'No space left on device'
    "$program" shape:cube $small -o - >/dev/full 2>err && fail "no error on a full standard output"
    says err 'No space left on device'
    "$program" info shape:cube >/dev/full 2>err && fail "no error from info"
    says err 'cannot write standard output'
}
devices() {
    run 0 shape:cube $small -o /dev/null
    [ -c /dev/null ] || fail "/dev/null is no device any more"
    mkfifo pipe.png
    cat pipe.png >through &
    run 0 shape:cube $small -o pipe.png
    wait $!
    is_png through
    [ -p pipe.png ] || fail "the pipe was replaced"
}
unwritable_places() {
    run 1 shape:cube $small -o none/out.png
    one_line
    says err 'none/out.png'
    [ "$(id -u)" = 0 ] && return # the superuser may write anywhere
    mkdir closed
    chmod a-w closed
    run 1 shape:cube $small -o closed/out.png
    says err 'closed/out.png'
    says err 'Permission denied'
}
strange_names() {
    run 0 shape:cube $small -o 'a b'\''c "d" – é.png'
    is_png 'a b'\''c "d" – é.png'
    run 0 make cube -o -x.obj
    run 0 info -- -x.obj
    local long
    long=$(printf 'n%.0s' $(seq 1 250)).png
    run 0 shape:cube $small -o "$long"
    is_png "$long"
    no_temporary
}

# interrupt SIGNAL SECONDS ARGS...: sends a signal that late; fills code.
interrupt() {
    local signal=$1 seconds=$2
    shift 2
    code=0
    timeout --preserve-status -s "$signal" "$seconds" "$program" "$@" >out 2>err </dev/null || code=$?
}
# A polygon of 100,000 corners takes a second at the most, and would take hours if all corners were looked at for
# each; the time limit is for sanitizers.
many_corners() {
    awk 'BEGIN { n = 100000
        for (i = 0; i < n; i++) {
            t = 6.283185307179586 * i / n
            r = 1 + 0.1 * sin(7 * t) + 0.05 * sin(61 * t) + 0.01 * sin(997 * t) + i % 2 * 0.002
            printf "v %.9g %.9g 0\n", r * cos(t), r * sin(t)
        }
        printf "f"
        for (i = 1; i <= n; i++) printf " %d", i
        print "" }' >coast.obj
    interrupt TERM 60 coast.obj -o out.png --stats=json
    [ "$code" = 0 ] || fail "exit code $code: $(head -c 400 err)"
    says out '"triangles": 99998'
    says out '"dropped": 0'
    is_png out.png
}
# A part in one pixel of a large scene: all pairs of its triangles would take minutes. Here, too, the limit is for
# sanitizers.
crowded_pixels() {
    printf 'v -1e9 -1e9 -1e9\nv 1e9 -1e9 -1e9\nv 1e9 1e9 -1e9\nf 1 2 3\n' >ground.obj
    interrupt TERM 60 ground.obj shape:torus:100000 -o out.png --hidden dashed
    [ "$code" = 0 ] || fail "exit code $code: $(head -c 400 err)"
    is_png out.png
}
interrupted() {
    echo old >out.png
    interrupt INT 0.7 shape:terrain:60000000 -o out.png
    [ "$code" = 130 ] || fail "drawing: exit code $code"
    [ "$(cat out.png)" = old ] || fail "drawing: the old file is gone"
    echo old >out.stl
    interrupt INT 0.7 make terrain --triangles 100000000 -o out.stl
    [ "$code" = 130 ] || fail "writing: exit code $code"
    [ "$(cat out.stl)" = old ] || fail "writing: the old file is gone"
    interrupt TERM 0.7 make terrain --triangles 100000000 -o other.ply
    [ "$code" = 143 ] || fail "SIGTERM: exit code $code"
    absent other.ply
    no_temporary
}
progress_on_a_terminal() {
    script -qec true /dev/null >seen 2>&1 </dev/null || return # no such program, or no terminals here
    script -qec "$program make terrain --triangles 12000000 -o /dev/null" /dev/null >seen </dev/null
    grep -q 'writing \[' seen || fail "no progress bar"
    grep -q '%' seen || fail "no percent"
    [ "$(tail -c 4 seen | od -An -c | tr -d ' \n')" = '\r033[K' ] || fail "the bar is not cleared"
    script -qec "$program make terrain --triangles 12000000 --quiet -o /dev/null" /dev/null >seen </dev/null
    [ ! -s seen ] || fail "--quiet shows something"
    run 0 make terrain --triangles 12000000 -o /dev/null
    silent err
}

# ---- strokes, adjacency, pencil ----

strokes() {
    local small="--size 200x150"
    run 0 shape:gear $small -o plain.png
    for name in pencil brush charcoal ink dashes dots; do
        run 0 shape:gear $small --stroke $name -o $name.png
        cmp -s plain.png $name.png && fail "--stroke $name changes nothing"
    done
    run 0 shape:gear $small --stroke pencil --seed 0 -o same.png
    cmp -s pencil.png same.png || fail "another picture with the same seed"
    run 0 shape:gear $small --stroke pencil --seed 5 -o other.png
    cmp -s pencil.png other.png && fail "the seed changes nothing"
    run 0 shape:gear $small --stroke plain.png -o own.png # any PNG is a texture
    is_png own.png
    for option in "--taper 20" "--jitter 2" "--overshoot 8" "--repeats 3" "--width-by-depth 0.8" "--width-by-light 0.8"; do
        run 0 shape:gear $small $option -o hand.png
        cmp -s plain.png hand.png && fail "$option changes nothing"
    done
    run 0 shape:gear $small --stroke pencil --stroke-u polar --stroke-k 0.2 --stroke-scale 2 -o polar.png
    cmp -s pencil.png polar.png && fail "--stroke-u polar changes nothing"
    silent err
    run 0 shape:gear $small --edges map --stroke pencil -o map.png
    says err 'warning: --stroke changes nothing: an edge map is of pixels and has no strokes'
    run 0 shape:gear $small --ink quads --stroke pencil -o quads.png
    says err 'warning: --stroke changes nothing: with --ink quads lines are plain'
    run 0 shape:gear $small --ink quads --stroke pencil --edges adjacency -o quads.png
    silent err
}
wrong_strokes() {
    wrong shape:cube -o out.png --stroke pencl -- 'one of pencil, brush'
    wrong shape:cube -o out.png --stroke-u spiral -- '--stroke-u'
    wrong shape:cube -o out.png --width-by-depth 2 -- '--width-by-depth'
    run 1 shape:cube -o out.png --stroke missing.png
    one_line
    says err 'missing.png'
    echo 'no picture' >text.png
    run 1 shape:cube -o out.png --stroke text.png
    one_line
    says err 'no PNG'
    absent out.png
}
adjacency() {
    local small="--size 200x150"
    for shape in cube torus bolt; do
        run 0 shape:$shape $small -o emergent.png
        run 0 shape:$shape $small --edges adjacency --ink strokes -o adjacent.png --stats=json
        cmp -s emergent.png adjacent.png || fail "$shape: lines by adjacency differ"
        grep -q '"adjacency_bytes": [1-9]' out || fail "statistics: $(cat out)"
    done
    run 0 shape:bolt $small --edges adjacency --method paper --width 8 --stroke ink -o one.png
    run 0 shape:bolt $small --edges adjacency --method paper --width 8 --stroke ink --passes 2 -o two.png
    cmp -s one.png two.png || fail "one pass differs from two"
}
pencil() {
    local small="--size 200x150"
    run 0 shape:torus $small --style pencil -o pencil.png --stats=json
    grep -q '"curvature_ms": [0-9]*\.[0-9]*[1-9]' out || fail "statistics: $(cat out)"
    for option in "--pencil-s 5" "--pencil-o 1" "--pencil-tones 6" "--pencil-turns printed" "--strokes pencil.png"; do
        run 0 shape:torus $small --style pencil $option -o other.png
        cmp -s pencil.png other.png && fail "$option changes nothing"
    done
    run 0 shape:torus $small --preset pencil -o preset.png
    is_png preset.png
    wrong shape:cube -o out.png --pencil-tones 1 -- '--pencil-tones'
}

# size_of FILE: bytes.
size_of() { stat -c %s "$1"; }
styles_and_edges() {
    for style in paper flat lambert gooch toon hatch halftone; do
        for edges in map emergent both none; do
            run 0 shape:bolt -o $style-$edges.png --size 120x90 --style $style --edges $edges
            silent err
            is_png $style-$edges.png
        done
    done
    cmp -s gooch-none.png toon-none.png && fail "gooch is toon"
    cmp -s gooch-map.png gooch-emergent.png && fail "the map's edges are emergent lines"
    run 0 shape:bolt -o c1.png --size 120x90 --edge-map c1
    run 0 shape:bolt -o paper.png --size 120x90 --edge-map diagonal --edge-measure paper --precision 8
    cmp -s c1.png paper.png && fail "C1 is the diagonal detector"
    run 0 shape:torus -o jagged.png --size 120x90 --style toon --cartoon-map off
    cmp -s jagged.png toon-emergent.png && fail "the cartoon map changes nothing"
}
outputs_beside() {
    run 0 shape:gear -o out.png -o edge-map=map.png --output normals=n.png --output=depth=z.png -o id=id.png --size 90x60
    for name in out map n z id; do
        is_png $name.png
        [ "$(png_size $name.png)" = 90x60 ] || fail "$name.png has another size"
    done
    cp out.png with.png
    run 0 shape:gear -o out.png --size 90x60
    cmp -s out.png with.png || fail "the outputs change the drawing"
    rm -f out.png
    run 1 shape:gear -o out.png -o normals=nowhere/n.png
    one_line
    says err nowhere
    absent out.png
    wrong shape:gear -o normals= -o out.png -- "a file is missing"
    wrong shape:gear -o normal=n.png -o out.png -- "did you mean normals?"
    run 0 shape:gear -o ./a=b.png --size 60x40
    is_png ./a=b.png
}
# A plane without the picture; and one of a kind.
planes_alone() {
    run 0 shape:cube $small -o depth=both.png -o out.png
    rm out.png
    run 0 shape:cube $small -o depth=depth.png
    silent out
    silent err
    absent out.png
    cmp -s depth.png both.png || fail "the picture changes the depth"
    run 0 shape:cube $small -o depth=- --stats=json
    cmp -s depth.png out || fail "standard output differs"
    says err '"frame_ms"'
    run 0 shape:cube $small -o edge-map=map.png
    is_png map.png
    wrong shape:cube -o depth=- -o id=- -- 'only one output can go to standard output'
    wrong shape:cube -o depth=a.png -o depth=b.png -- 'one depth at a time'
    wrong make cube -o a.ply -o b.ply -- 'one model at a time'
    absent a.png
    absent b.png
}
# The value for all classes comes first, or would undo the others.
widths_of_classes() {
    run 0 shape:cube $small -o first.png --width 3,ridge=1
    run 0 shape:cube $small -o each.png --width silhouette=3,valley=3,intersection=3,border=3,ridge=1
    cmp -s first.png each.png || fail "the classes' widths differ"
    wrong shape:cube -o out.png --width 2,3 -- 'only the first value can be for all classes'
    wrong shape:cube -o out.png --color 'ridge=#FF0000,#00FF00' -- 'which class "#00FF00" is for'
}
# Lines that something hides: their looks, levels, widths and colours.
hidden_lines() {
    run 0 shape:gear $small -o plain.png -o trace=plain.txt
    run 0 shape:gear $small -o none.png --hidden none --levels 3
    cmp -s plain.png none.png || fail "--hidden none changes the picture"
    says err 'add --hidden dashed'
    run 0 shape:gear $small -o none.png --optimize
    says err 'add -o drawing.svg'
    for look in dashed dotted thin solid; do
        run 0 shape:gear $small -o $look.png --hidden $look
        cmp -s plain.png $look.png && fail "--hidden $look changes nothing"
    done
    cmp -s thin.png solid.png && fail "thin is solid"
    cmp -s dashed.png dotted.png && fail "dashed is dotted"
    run 0 shape:gear $small -o trace=one.txt --hidden dashed --width 2
    says one.txt 'level 1 width 1'
    grep -q 'level 2' one.txt && fail "there is a second level"
    run 0 shape:gear $small -o trace=three.txt --hidden dashed --width 2 --levels 3
    says three.txt 'level 2 width 1'
    grep -q 'level 4' three.txt && fail "there is a fourth level"
    run 0 shape:gear $small -o trace=looks.txt --hidden solid --levels 3 --hidden-width '1.5,ridge=3,:2=4,ridge:2=5' \
        --hidden-color '#010203,:3=#040506'
    says looks.txt 'level 1 width 1.5 color #010203ff'
    says looks.txt 'level 1 width 3 color #010203ff'
    says looks.txt 'level 2 width 4 color #010203ff'
    says looks.txt 'level 2 width 5 color #010203ff'
    says looks.txt 'level 3 width 3 color #040506ff'
    run 0 shape:bolt $small -o smooth.png --hidden thin --hidden-smooth
    run 0 shape:bolt $small -o rough.png --hidden thin
    cmp -s smooth.png rough.png && fail "--hidden-smooth changes nothing"
    silent err
}
wrong_hidden_lines() {
    wrong shape:cube -o out.png --hidden dahsed -- 'did you mean dashed?'
    wrong shape:cube -o out.png --levels 9 -- '--levels: 9 is out of range'
    wrong shape:cube -o out.png --hidden-width 2,3 -- 'only the first value can be for all lines'
    wrong shape:cube -o out.png --hidden-width ridge:9=2 -- '":9" is no level'
    wrong shape:cube -o out.png --hidden-width ridge:=2 -- 'is no level'
    wrong shape:cube -o out.png --hidden-width rigde:1=2 -- 'did you mean ridge?'
    wrong shape:cube -o out.png --hidden-width 100 -- '--hidden-width: 100 is out of range'
    wrong shape:cube -o out.png --hidden-color :1=rde -- '--hidden-color: "rde" is not a colour; did you mean red?'
    for option in "--ink quads" "--edges adjacency"; do
        "$program" shape:cube $small -o out.png --hidden dashed $option 2>err && fail "$option is allowed"
        one_line
        says err 'hidden lines'
        absent out.png
    done
}
# The lines as text: alone, beside a picture, to standard output; and no half a file.
traces() {
    run 0 shape:cube $small -o trace=alone.txt
    silent out
    silent err
    absent out.png
    says alone.txt 'drypoint trace 1'
    says alone.txt 'picture 160 120 paper #ffffffff'
    run 0 shape:cube $small -o out.png -o trace=beside.txt
    is_png out.png
    cmp -s alone.txt beside.txt || fail "the picture changes the trace"
    run 0 shape:cube $small -o trace=-
    silent err
    cmp -s alone.txt out || fail "standard output differs"
    run 0 shape:cube $small -o trace=- --stats=json
    cmp -s alone.txt out || fail "statistics are in the trace"
    says err '"frame_ms"'
    run 0 shape:cube $small -o trace=alone.txt --stats=json
    says out '"frame_ms"'
    for threads in 1 2 7; do
        run 0 shape:gear $small --threads $threads -o trace=$threads.txt
        cmp -s 1.txt $threads.txt || fail "$threads threads differ from one"
    done
    run 0 shape:gear $small --ink quads -o trace=quads.txt
    says quads.txt 'end 0 strokes 0 segments'
}
traces_that_fail() {
    run 1 shape:cube $small -o trace=none/t.txt -o out.png
    one_line
    says err 'none/t.txt'
    absent out.png
    echo old >t.txt
    run 1 missing.obj -o trace=t.txt
    [ "$(cat t.txt)" = old ] || fail "the old file is gone"
    wrong shape:cube -o trace= -- 'a file is missing; give trace=FILE'
    wrong shape:cube -o trac=t.txt -o out.png -- 'did you mean trace?'
    wrong shape:cube -o - -o trace=- -- 'standard output'
    wrong shape:cube -o both.png -o trace=both.png -- 'two outputs go to both.png'
    run 0 make cube -o model.ply
    wrong model.ply -o trace=./model.ply -- 'is the model'
    wrong bench shape:cube -o trace=t.txt -- 'does not belong to'
    no_temporary
    [ -w /dev/full ] || return
    run 1 shape:cube $small -o trace=/dev/full
    one_line
    says err 'No space left on device'
}
traces_of_streamed_models() {
    local small="--size 160x120 --lines silhouette,ridge,valley"
    run 0 make terrain --triangles 600000 -o t.stl
    run 0 t.stl $small -o trace=streamed.txt --memory 48M
    silent err
    says streamed.txt 'layer silhouette'
    says streamed.txt ' hidden'
    grep -q 'hidden by' streamed.txt && fail "a streamed model's lines are hidden by polygons that nobody kept"
    run 0 t.stl $small -o trace=threads.txt --memory 48M --threads 3
    cmp -s streamed.txt threads.txt || fail "differs with three threads"
}
# Normals that are none, that contradict the winding or are not numbers; faces without area, and wound both ways.
odd_normals() {
    cat >odd.ply <<'END'
ply
format ascii 1.0
element vertex 5
property float x
property float y
property float z
property float nx
property float ny
property float nz
element face 7
property list uchar int vertex_indices
end_header
0 0 0 nan nan nan
1 0 0 inf 0 0
1 1 0 0 0 -1
0 1 0 0 0 0
0.5 0.5 1 1e38 1e38 1e38
3 0 1 4
3 1 2 4
3 2 3 4
3 3 0 4
3 0 0 1
3 0 1 2
3 2 1 0
END
    for style in lambert gooch toon hatch halftone; do
        run 0 odd.ply -q -o odd.png -o normals=odd-normals.png --size 60x40 --style $style --edges map
        is_png odd.png
    done
    run 0 odd.ply -q -o object.png --size 60x40 --style hatch --hatch-space object --mirror 0,1,0 --precision 8
    is_png object.png
}
mirrors() {
    run 0 shape:bolt -o floor.png --size 120x90 --mirror 0,1,0 --style toon
    run 0 shape:bolt -o wall.png --size 120x90 --mirror 1,0,0,-2 --mirror-size 4 --mirror-tint '#88AACC' --mirror-fade 3
    is_png floor.png
    cmp -s floor.png wall.png && fail "the mirror stays where it is"
    wrong shape:bolt -o out.png --mirror 0,1 -- "not a plane"
    wrong shape:bolt -o out.png --mirror 0,0,0,1 -- "normal is zero"
    wrong shape:bolt -o out.png --mirror 0,1,0,1,2 -- "not a plane"
}
presets() {
    for preset in technical illustration cartoon engraving blueprint sketch patent; do
        run 0 shape:bolt -o $preset.png --size 120x90 --preset $preset
        silent err
        is_png $preset.png
    done
    run 0 shape:bolt -o changed.png --size 120x90 --preset=patent --style gooch
    run 0 shape:bolt -o before.png --size 120x90 --style gooch --preset patent
    cmp -s changed.png before.png || fail "the preset's place matters"
    cmp -s changed.png patent.png && fail "options do not change presets"
    run 0 shape:cube -o two.png --size 120x90 --preset pencil --preset blueprint
    silent err
    wrong shape:bolt -o out.png --preset cartoons -- "did you mean cartoon?"
}
textures() {
    run 0 shape:bolt -o strokes.png --size 64x64 --lines silhouette
    run 0 shape:torus -o hatched.png --size 120x90 --style hatch --strokes strokes.png --hatch-space object
    run 0 shape:torus -o shaded.png --size 120x90 --style toon --shade-texture strokes.png
    echo "no picture" >text.png
    run 1 shape:torus -o out.png --style hatch --strokes text.png
    one_line
    says err "give a PNG file"
    run 1 shape:torus -o out.png --style toon --shade-texture missing.png
    one_line
    absent out.png
}
enhanced_objects() {
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 3 0 0\nv 2 1 0\no left\nf 1 2 3\no right\nusemtl red\nf 4 5 6\n' >two.obj
    run 0 two.obj -o all.png --size 120x90 --edges map
    run 0 two.obj -o left.png --size 120x90 --edges map --enhance left
    run 0 two.obj -o right.png --size 120x90 --edges map --enhance red
    run 0 two.obj -o both.png --size 120x90 --edges map --enhance left,right
    cmp -s all.png both.png || fail "both are not all"
    cmp -s left.png right.png && fail "left is right"
    run 1 two.obj -o out.png --edges map --enhance middle
    one_line
    says err 'no object called "middle"; it has left, right/red'
    absent out.png
}
smoothing() {
    run 0 shape:torus:576 -o plain.png --size 200x150
    run 0 shape:torus:576 -o off.png --size 200x150 --smooth off
    cmp -s plain.png off.png || fail "--smooth off changes the picture"
    run 0 shape:torus:576 -o auto.png --size 200x150 --smooth auto
    silent err
    cmp -s plain.png auto.png && fail "--smooth auto changes nothing"
    run 0 shape:torus:576 -o surface.png --size 200x150 --smooth auto --smooth-what surface
    cmp -s auto.png surface.png || fail "the surface is not the default"
    run 0 shape:torus:576 -o line.png --size 200x150 --smooth 3 --smooth-what silhouettes --hidden dashed --threads 2
    run 0 shape:torus:576 -o line1.png --size 200x150 --smooth 3 --smooth-what silhouettes --hidden dashed --threads 1
    cmp -s line.png line1.png || fail "threads matter"
    run 0 shape:cube -o cube.png --size 200x150
    run 0 shape:cube -o hard.png --size 200x150 --smooth 6
    cmp -s cube.png hard.png || fail "a cube does not stay one"
    run 0 shape:sphere:320 -o trace=sphere.txt --size 200x150 --smooth 2
    says sphere.txt ' within '
    run 0 shape:terrain:2000000 -o large.png --size 200x150 --smooth auto --smooth-what silhouettes --memory 48M
    run 0 shape:cube -o cube.png --size 200x150 --smooth-what silhouettes
    says err 'add --smooth auto'
    wrong shape:cube -o out.png --smooth 7 -- --smooth
    wrong shape:cube -o out.png --smooth auto --smooth-what edges -- --smooth-what
}
absurd_thresholds() {
    for option in "--inner-angle 0" "--inner-angle 181" "--profile-depth -1" "--edge-radius 5" "--profile-softness 2" \
        "--crease-angle nan" "--light 10" "--light 0,91" "--highlight 1.5" "--hatch-scale 0"; do
        # shellcheck disable=SC2086
        wrong shape:bolt -o out.png --edges map $option -- "${option%% *}"
    done
}

# ---- vectors, pages, sheets ----

# is_vector FORMAT FILE: the file begins and ends as that format does.
is_vector() {
    local first last
    case $1 in
    svg) first='<?xml' last='</svg>' ;;
    pdf) first='%PDF-1.' last='%%EOF' ;;
    eps) first='%!PS-Adobe-3.0 EPSF-3.0' last='%%EOF' ;;
    dxf) first='' last=EOF ;;
    json) first='{' last='"rules":[]}' ;;
    esac
    [ "$(head -c ${#first} "$2")" = "$first" ] || fail "$2 does not begin with $first"
    [ "$(tail -n 1 "$2" | tr -d '\r')" = "$last" ] || fail "$2 does not end with $last"
}
# png_dpi FILE: pixels per metre of its pHYs chunk; nothing without one.
png_dpi() {
    [ "$(tail -c +38 "$1" | head -c 4)" = pHYs ] || return
    od -An -tu1 -j41 -N9 "$1" | awk '{print $1*16777216+$2*65536+$3*256+$4 "x" $5*16777216+$6*65536+$7*256+$8 "x" $9}'
}
# svg_size FILE: as its head has it.
svg_size() { sed -n 's/.*<svg[^>]* width="\([^"]*\)" height="\([^"]*\)".*/\1x\2/p' "$1"; }

vectors_by_ending() {
    for format in svg pdf eps dxf json; do
        run 0 shape:gear $small -o out.$format
        silent out
        is_vector $format out.$format
        says err "drypoint: out.$format: "
        says err ' paths, '
        run 0 shape:gear $small -q -o - --format $format
        silent err
        cmp -s out out.$format || fail "$format: standard output differs"
        run 0 shape:gear $small -q -o "OUT.${format^^}"
        cmp -s "OUT.${format^^}" out.$format || fail "$format: capital letters differ"
    done
    run 0 shape:gear $small -o out.dxf
    says err 'a unit is a millimetre'
    run 0 shape:gear $small -q -o segments=paths.json
    cmp -s paths.json out.json || fail "segments= differs from -o out.json"
    run 0 shape:gear $small -o - --format png
    is_png out
    silent err
}
several_outputs() {
    run 0 shape:bolt $small -o a.png -o b.png -o a.svg -o b.SVG -o segments=a.json -o depth=z.png -o trace=t.txt
    is_png a.png
    cmp -s a.png b.png || fail "two pictures of one run differ"
    cmp -s a.svg b.SVG || fail "two drawings of one run differ"
    says err 'a.svg and 2 more: '
    is_vector svg a.svg
    is_png z.png
    run 0 shape:bolt $small -q -o alone.svg # no pixels are drawn
    cmp -s alone.svg a.svg || fail "the picture changes the paths"
    run 0 shape:bolt $small -q -o - -o both.svg
    is_png out
    cmp -s both.svg a.svg || fail "standard output changes the paths"
    run 0 shape:bolt $small -q -o - -o both.png --format svg
    cmp -s out a.svg || fail "--format svg for standard output alone"
    is_png both.png
}
wrong_outputs() {
    wrong shape:cube -o a.svg -o ./a.svg -o ./a.svg -- 'two outputs go to ./a.svg'
    wrong shape:cube -o - -o - -- 'only one output can go to standard output'
    wrong shape:cube -o - --format svg -o segments=- -- 'only one output can go to standard output'
    wrong shape:cube -o out.ai -- '-o out.ai: drawings are written as .png, .svg, .pdf, .eps, .dxf or .json; name it out.png'
    wrong shape:cube -o - --format ai -- '--format: "ai" is none of png|svg|pdf|eps|dxf|json'
    wrong shape:cube -o a.svg --format pdf -- '--format is for outputs whose name does not end in a format'
    wrong shape:cube -o segments= -- 'a file is missing; give segments=FILE.json'
    wrong shape:cube -o segment=a.json -- 'did you mean segments?'
    wrong make cube -o a.svg -- 'a.ply'
    wrong bench shape:cube --page A4 -- 'does not belong to'
    wrong info shape:cube --sheet iso -- 'does not belong to'
    run 0 make cube -o cube.obj
    wrong cube.obj -o ./cube.obj --format svg -- 'is the model'
    local many=()
    for k in $(seq 1 17); do many+=(-o $k.svg); done
    wrong shape:cube "${many[@]}" -- '17.svg is one too many'
    absent a.svg
}
# A disk that is full leaves the old file; so does a run that fails.
vectors_that_fail() {
    echo old >out.svg
    run 1 missing.obj -o out.svg
    [ "$(cat out.svg)" = old ] || fail "the old file is gone"
    (
        trap '' XFSZ
        ulimit -f 1
        "$program" shape:gear -q -o out.svg 2>err
    )
    [ $? = 1 ] || fail "a file that is too large for the disk"
    one_line
    says err 'cannot write out.svg'
    [ "$(cat out.svg)" = old ] || fail "the old file is gone"
    no_temporary
    run 1 shape:cube -o none/out.svg -o out.png
    says err 'none/out.svg'
    absent out.png
    [ -w /dev/full ] || return
    run 1 shape:gear $small -o /dev/full --format svg
    one_line
    says err 'No space left on device'
    "$program" shape:gear $small -o - --format svg >/dev/full 2>err && fail "no error on a full standard output"
    says err 'No space left on device'
}
empty_pictures() {
    run 0 shape:cube $small --eye 0,0,5 --target 0,0,9 -o out.png
    one_line
    says err 'out.png: no line is in it: nothing of the model is seen'
    run 0 shape:cube $small --eye 0,0,5 --target 0,0,9 -o -
    says err 'standard output: no line is in it'
    for option in '--quiet' '--lines none' '--edges map' '--ink quads'; do
        run 0 shape:cube $small --eye 0,0,5 --target 0,0,9 $option -o out.png
        grep -q 'no line is in it' err && fail "it is told with $option"
    done
    return 0
}
empty_vectors() {
    run 0 shape:cube $small --lines none -o out.svg
    is_vector svg out.svg
    says err 'out.svg: 0 paths'
    says err 'nothing of the model is seen'
    grep -q '<path' out.svg && fail "there is a path"
    run 0 shape:cube $small --eye 0,0,5 --target 0,0,9 -o out.svg
    says err 'nothing of the model is seen'
    run 0 shape:cube $small --ink quads -o out.svg
    says err 'with --ink quads there are no paths'
    run 0 shape:cube $small --style gooch --stroke pencil -o out.svg
    says err '--ground png puts it under the lines'
    says err 'paths are plain'
}
cleaning() {
    run 0 shape:gear $small -q -o all.svg --join 0 --min-length 0 --tolerance 0 --keep-coincident
    run 0 shape:gear $small -q -o less.svg --join 0.5mm --min-length 4 --tolerance 0.1 --join-classes
    [ "$(stat -c %s less.svg)" -lt "$(stat -c %s all.svg)" ] || fail "cleaning leaves out nothing"
    run 0 shape:gear $small -o short.svg --min-length 4 --detail exact # which leaves the short ones
    says err '% dropped as shorter than 4 px'
    run 0 shape:gear $small -o pen.svg --optimize
    says err 'the pen travels'
    wrong shape:cube -o out.svg --join -1 -- '--join: -1 is out of range'
    wrong shape:cube -o out.svg --tolerance 2km -- '--tolerance: "2km" is not a length; give pixels like 2.5, or 0.5mm or 1pt'
}
# Sizes on paper: of PNGs by --dpi and pHYs, of SVGs in mm.
pages() {
    run 0 shape:cube -q --page A4-landscape -o a.png -o a.svg
    [ "$(png_size a.png)" = 1754x1240 ] || fail "A4 at 150 dpi is $(png_size a.png)"
    [ "$(png_dpi a.png)" = 5906x5906x1 ] || fail "150 dpi is $(png_dpi a.png)"
    [ "$(svg_size a.svg)" = 297mmx210mm ] || fail "A4 is $(svg_size a.svg)"
    run 0 shape:cube -q --page letter-portrait --dpi 72 -o a.png -o a.svg
    [ "$(png_size a.png)" = 612x792 ] || fail "letter at 72 dpi is $(png_size a.png)"
    [ "$(png_dpi a.png)" = 2835x2835x1 ] || fail "72 dpi is $(png_dpi a.png)"
    [ "$(svg_size a.svg)" = 215.9mmx279.4mm ] || fail "letter is $(svg_size a.svg)"
    run 0 shape:cube -q --page 4x3in --dpi 100 -o a.png -o a.svg
    [ "$(png_size a.png)" = 400x300 ] || fail "4 x 3 in at 100 dpi is $(png_size a.png)"
    [ "$(svg_size a.svg)" = 101.6mmx76.2mm ] || fail "4 x 3 in is $(svg_size a.svg)"
    run 0 shape:bolt -q --page a5 --dpi 50 -o tall.svg # as the picture is
    [ "$(svg_size tall.svg)" = 148mmx210mm ] || fail "a bolt's A5 is $(svg_size tall.svg)"
    run 0 shape:bolt -q --page A5 --landscape --dpi 50 -o wide.svg
    [ "$(svg_size wide.svg)" = 210mmx148mm ] || fail "--landscape is $(svg_size wide.svg)"
    run 0 shape:cube -q $small -o plain.png
    [ -z "$(png_dpi plain.png)" ] || fail "a picture without a page has a size on paper"
    run 0 shape:cube -q $small --dpi 300 -o dense.png -o dense.svg
    [ "$(png_dpi dense.png)" = 11811x11811x1 ] || fail "300 dpi is $(png_dpi dense.png)"
    [ "$(svg_size dense.svg | cut -c 1-6)" = 13.546 ] || fail "160 px at 300 dpi are $(svg_size dense.svg)"
    run 0 shape:cube -q --page A4 --dpi 40 --paper none -o none.png
    run 0 shape:cube -q --page A4 --dpi 40 --eye 3,2,4 --fov 30 -o eye.png -o eye.svg
    run 0 shape:cube -q --page A4 --dpi 40 --preset iso --page none $small -o none.png
    [ "$(png_size none.png)" = 160x120 ] || fail "--page none: $(png_size none.png)"
}
wrong_pages() {
    wrong shape:cube -o out.png --page A9 -- 'none of A0 to A5, letter, legal, tabloid and sizes like 200x100mm; did you mean A0?'
    wrong shape:cube -o out.png --page ledger -- 'did you mean letter?'
    wrong shape:cube -o out.png --page 200x100 -- '"200x100" has no unit'
    wrong shape:cube -o out.png --page 200xmm -- 'is not a size'
    wrong shape:cube -o out.png --page 1x1mm -- 'each side can be 5 to 10000 mm'
    wrong shape:cube -o out.png --page A0 --dpi 1200 -- 'give another --dpi'
    wrong shape:cube -o out.png --page A4 --margin 110 -- '--margin: nothing is left'
    wrong shape:cube -o out.png --page A4 --margin 1,2,3 -- 'not one or four numbers'
    wrong shape:cube -o out.png --page A4 --margin 1,2,3,4,5 -- 'not one or four numbers'
    wrong shape:cube -o out.png --page A4 --margin -1 -- 'out of range'
    wrong shape:cube -o out.png --margin 10 -- 'add --page A4'
    wrong shape:cube -o out.png --landscape -- 'add --page A4'
    wrong shape:cube -o out.png --page A4-portrait --landscape -- 'exclude each other'
    wrong shape:cube -o out.png --page A4 --size 100x100 -- 'leave out --size'
    wrong shape:cube -o out.png --dpi 5 -- '--dpi: 5 is out of range'
    wrong shape:cube -o out.png --width 1km -- 'is not a width; give pixels like 2.5, or 0.5mm or 1pt'
    wrong shape:cube -o out.png --width 30mm -- 'give a smaller --dpi'
    wrong shape:cube -o out.png --width 300mm -- 'at most 100 mm'
    wrong shape:cube -o out.png --width 0mm -- 'above 0'
    run 0 shape:cube $small -o thin.svg --width 0.01mm
    says err 'lines are at least half a pixel wide, 0.132 mm at 96 dpi'
}
widths_on_paper() {
    run 0 shape:cube -q --page A5 --dpi 254 --width 0.5mm,ridge=1pt -o mm.png -o mm.svg
    run 0 shape:cube -q --page A5 --dpi 254 --width 5,ridge=3.527777777px -o px.png -o px.svg
    cmp -s mm.png px.png || fail "0.5 mm are not 5 pixels at 254 dpi"
    cmp -s mm.svg px.svg || fail "0.5 mm are not 5 pixels at 254 dpi"
    run 0 shape:cube -q --page A5 --dpi 254 -o usual.svg
    run 0 shape:cube -q --page A5 --dpi 254 -o same.svg --width 0.25mm,silhouette=0.5mm,border=0.5mm
    cmp -s usual.svg same.svg || fail "the usual widths on a page are not 0.5 and 0.25 mm"
    run 0 shape:cube -q --page A5 --hidden dashed --hidden-width 0.2mm,ridge:1=0.4mm -o hidden.png
}
# boxes FILE: the views of an SVG in mm; the test ends without Python.
boxes() { python3 "$here/svg_boxes.py" "$1" || fail "svg_boxes.py $1"; }
scales() {
    wrong shape:cube -o out.svg --scale 1 -- 'is not a scale; give one like 1:10 or 2:1, or fit'
    wrong shape:cube -o out.svg --scale 0:1 -- 'both sides are above 0'
    wrong shape:cube -o out.svg --unit mm -- '--unit says what a scale is of'
    wrong shape:cube -o out.svg --scale 1:2 --unit km -- '--unit: "km" is none of mm|cm|m|in|ft'
    wrong shape:cube -o out.svg --scale 1:2 --fov 30 -- 'a picture in perspective has no scale'
    wrong shape:cube -o out.svg --scale 1:2 --ortho 3 -- 'both say how large'
    wrong shape:cube -o out.svg --scale 1:2 --zoom 3 -- 'both say how large'
    wrong shape:cube -o out.svg --page A4 --scale 1000:1 --view front -- 'and the page has 277 x 190 mm between its margins: 50:1 is the largest standard scale'
    wrong shape:cube -o out.svg --page A4 --scale 2:1 --unit m --view front -- ': 1:20 is the largest standard scale'
    run 0 shape:cube -q --page A4 --scale 1:20 --unit m --view front -o fits.svg
    run 0 shape:cube -q --page A4 --scale 1000:1 --view front --target 1,1,1 -o detail.svg # a detail, on purpose
    run 0 shape:cube -q --page A4 --eye 3,4,5 --scale 20:1 -o eye.svg
    # 2.1 in at 85 dpi are 178.5 px: the view ends where the page does, whatever rounding says
    run 0 shape:cube -q --page 2.1x2.1in --dpi 85 --margin 12.7,0,0,12.7 -o half.png
    wrong shape:cube -o out.svg --page 5x5mm --margin 2.4 --scale 1:1 -- 'no standard scale fits; make them smaller'
    command -v python3 >/dev/null || return
    for camera in '--fov 50' '--ortho 0' '--view iso'; do # from margin to margin
        run 0 shape:stairs -q --page 160x120mm --margin 10 --width 0.2mm $camera -o whole.svg
        boxes whole.svg | awk '{ x = $3 - $1; y = $4 - $2; if (($1 + $3 - 160) ^ 2 > 0.1 || ($2 + $4 - 120) ^ 2 > 0.1) bad = 1
            if (!(x > 139.5 && x < 140 && y < 100) && !(y > 99.5 && y < 100 && x < 140)) bad = 1 } END { exit bad || NR != 1 }' ||
            fail "$camera does not fill the page: $(boxes whole.svg)"
    done
    boxes fits.svg >fits
    awk 'NF != 4 || $3 - $1 < 99.99 || $3 - $1 > 100.01 || $4 - $2 < 99.99 || $4 - $2 > 100.01 ||
        $1 + $3 < 296.8 || $1 + $3 > 297.2 { bad = 1 } END { exit bad || NR != 1 }' fits ||
        fail "2 m at 1:20 in the middle of A4: $(cat fits)"
    run 0 shape:cube -q --scale 10:1 --view front --margin 5 -o wrapped.svg -o wrapped.png
    boxes wrapped.svg >wrapped
    awk '$3 - $1 < 19.99 || $3 - $1 > 20.01 { bad = 1 } END { exit bad || NR != 1 }' wrapped ||
        fail "2 mm at 10:1: $(cat wrapped)"
    svg_size wrapped.svg | awk -F 'mm|x' '$1 < 30 || $1 > 31 { exit 1 }' || fail "a page around 20 mm: $(svg_size wrapped.svg)"
    run 0 shape:cube -q --scale 10:1 --size 400x400 --view front -o sized.svg
    boxes sized.svg >sized
    awk '$3 - $1 < 19.99 || $3 - $1 > 20.01 { bad = 1 } END { exit bad }' sized || fail "with --size: $(cat sized)"
}
sheets() {
    command -v python3 >/dev/null || return
    for angle in third first; do
        run 0 shape:bracket -q --sheet front,top,right,iso --angle $angle -o $angle.svg -o $angle.png
        boxes $angle.svg >$angle
        [ "$(wc -l <$angle)" = 4 ] || fail "$angle: not four views: $(cat $angle)"
    done
    # third angle: top above front, right to the right of it, iso in the corner; x0 y0 x1 y1
    awk 'function same(a, b) { return a - b < 0.06 && b - a < 0.06 }
        { for (k = 1; k <= 4; k++) v[NR, k] = $k }
        END { top = v[1, 2] < v[2, 2] ? 1 : 2; front = 3 - top; right = v[3, 2] > v[4, 2] ? 3 : 4
            exit !(same(v[top, 1], v[front, 1]) && same(v[top, 3], v[front, 3]) && v[top, 4] < v[front, 2] &&
                same(v[right, 2], v[front, 2]) && same(v[right, 4], v[front, 4]) && v[right, 1] > v[front, 3] &&
                same(v[right, 3] - v[right, 1], v[top, 4] - v[top, 2])) }' third || fail "third angle: $(cat third)"
    awk 'function same(a, b) { return a - b < 0.06 && b - a < 0.06 }
        { for (k = 1; k <= 4; k++) v[NR, k] = $k }
        END { right = 1; top = v[2, 2] > v[3, 2] ? 2 : 3; front = 5 - top
            exit !(same(v[top, 1], v[front, 1]) && same(v[top, 3], v[front, 3]) && v[top, 2] > v[front, 4] &&
                same(v[right, 2], v[front, 2]) && same(v[right, 4], v[front, 4]) && v[right, 3] < v[front, 1]) }' first ||
        fail "first angle: $(cat first)"
    cmp -s third.png first.png && fail "--angle changes nothing"
    [ "$(png_size third.png)" = 1754x1240 ] || fail "the sheet is $(png_size third.png)"
    run 0 shape:bracket -q --sheet front,back,left,right,top,bottom,iso --page A3 -o all.svg
    boxes all.svg >all
    [ "$(wc -l <all)" = 7 ] || fail "not seven views: $(cat all)"
    run 0 shape:bracket -q --sheet front,top,right,iso --scale 10:1 --title 'Bracket <1>' -o scaled.svg
    says scaled.svg '<title>Bracket &lt;1&gt;</title>'
    # z up: what was the front is seen from above
    run 0 shape:bracket -q --sheet front --scale 20:1 -o y.svg
    run 0 shape:bracket -q --sheet top --up 0,0,1 --scale 20:1 -o z.svg
    boxes y.svg | awk '{ print $3 - $1, $4 - $2 }' >y
    boxes z.svg | awk '{ print $3 - $1, $4 - $2 }' >z
    cmp -s y z || fail "--up 0,0,1: $(cat y z)"
    grep -q hidden y.svg || fail "no hidden lines"
    run 0 shape:bracket -q --sheet iso -o iso.svg
    grep -q hidden iso.svg && fail "hidden lines in the pictorial view"
    run 0 shape:bracket -q --sheet front --hidden none -o none.svg
    grep -q hidden none.svg && fail "--hidden none draws hidden lines"
    silent err
}
wrong_sheets() {
    wrong shape:cube -o out.svg --sheet front,topp -- 'did you mean top?'
    wrong shape:cube -o out.svg --sheet front,front -- 'front is there twice'
    wrong shape:cube -o out.svg --sheet front, -- '--sheet: "" is none of'
    wrong shape:cube -o out.svg --angle first -- '--angle says where the views of a sheet lie'
    wrong shape:cube -o out.svg --sheet front --view top -- '--sheet already says where from'
    wrong shape:cube -o out.svg --sheet front --fov 30 -- 'the views of a sheet have one scale'
    wrong shape:cube -o out.svg --sheet front --page none -- 'a sheet is a page'
    wrong shape:cube -o out.svg --sheet front --mirror 0,1,0 -- 'a sheet has no mirror'
    wrong shape:cube -o out.svg --sheet front -o depth=z.png -- '-o depth=z.png is of one view'
    wrong shape:cube -o out.svg --sheet front,iso --scale 100:1 -- 'is the largest standard scale that fits'
    wrong shape:cube -o out.svg --sheet front --page A5 --margin 60 -- 'fit at no standard scale'
    absent out.svg
}
# One run after another, and any number of threads: the same bytes, also of the title block.
sheets_for_any_threads() {
    for threads in 1 2 7; do
        run 0 shape:gear -q --sheet front,top,iso --dpi 60 --threads $threads -o $threads.svg -o $threads.png
        run 0 shape:gear -q --optimize $small --threads $threads -o plain-$threads.svg
        cmp -s 1.svg $threads.svg || fail "sheet: $threads threads differ from one"
        cmp -s 1.png $threads.png || fail "PNG: $threads threads differ from one"
        cmp -s plain-1.svg plain-$threads.svg || fail "$threads threads differ from one"
    done
    date=$(date +%Y)
    grep -q "$date" 1.svg && fail "the year is in the file"
}
paper_presets() {
    for preset in iso patent-us patent-epc axidraw laser; do
        run 0 shape:bracket -q --preset $preset -o $preset.svg -o $preset.png
        silent err
        is_png $preset.png
        run 0 bench shape:cube --preset $preset --frames 1 $small
    done
    [ "$(svg_size patent-us.svg)" = 215.9mmx279.4mm ] || fail "patent-us is $(svg_size patent-us.svg)"
    [ "$(svg_size patent-epc.svg)" = 210mmx297mm ] || fail "patent-epc is $(svg_size patent-epc.svg)"
    [ "$(grep -o 'stroke="#[0-9A-Fa-f]*"' laser.svg | sort -u | wc -l)" -ge 3 ] || fail "laser: one colour"
    grep -q hidden iso.svg || fail "iso: no hidden lines"
    run 0 shape:bracket -q --preset iso --sheet front,top -o sheet.svg # goes together
    run 0 shape:bracket -q --preset iso --page A3 -o large.svg
    svg_size large.svg | grep -q 420mm || fail "options do not change presets: $(svg_size large.svg)"
}

. "$here/look.sh"    # line weights, colours, presets, options without effect
. "$here/animations.sh" # which one plays, and whether models move
. "$here/deform.sh"  # models whose vertices move
. "$here/several.sh" # scenes, a drawing for each of several models
. "$here/objects.sh" # groups with styles of their own, left out, exploded
. "$here/sections.sh" # models cut open
. "$here/xray.sh"    # see-through surfaces
. "$here/gltf.sh"    # glTF
. "$here/promises.sh" # what docs/lines.md says that the paper promises
. "$here/shown.sh"   # the commands of README.md and docs
. "$here/helps.sh"   # --help and its topics, completions
. "$here/patterns.sh" # patterns and light on lines
. "$here/film.sh"    # films
. "$here/opengl.sh"  # --gl, and the viewer's absence

tests="$look_tests $animations_tests $deform_tests $film_tests $objects_tests $section_tests $xray_tests $pattern_tests $gltf_tests $promise_tests $shown_tests $several_tests $helps_tests $opengl_tests vectors_by_ending several_outputs wrong_outputs vectors_that_fail empty_pictures empty_vectors cleaning pages wrong_pages widths_on_paper scales sheets wrong_sheets sheets_for_any_threads paper_presets strokes wrong_strokes adjacency pencil styles_and_edges outputs_beside planes_alone widths_of_classes hidden_lines wrong_hidden_lines traces traces_that_fail traces_of_streamed_models odd_normals mirrors presets textures enhanced_objects smoothing absurd_thresholds draws default_size standard_output standard_input streamed streamed_from_a_pipe same_for_any_threads equals_sign every_option views_differ what_is_up distant_terrain eye_alone_looks_at_the_centre made_models sizes_and_seeds info_table stats bench_json helps far_from_zero coarse_files_are_told
    man_page nearest_option wrong_values missing_words wrong_endings contradictions a_shape_is_no_file bad_files
    cut_files huge_counts many_corners crowded_pixels dropped_are_counted flat_triangles_are_passed_over unclosed_solids_are_told advice missing_materials_are_told colors_of_vertices_are_drawn broken_readers interrupted_readers old_file_stays_on_error full_disk devices unwritable_places
    strange_names interrupted progress_on_a_terminal"

# These draw a picture for every row of a table, to compare what is said of options; ffmpeg is not ours.
repeats=" options_without_effect options_with_effect films_by_ffmpeg "

place=0
for test in $tests; do
    case $test in *"$pattern"*) ;; *) continue ;; esac
    case ${SANITIZED:+$repeats} in *" $test "*) continue ;; esac
    place=$((place + 1))
    [ $((place % parts)) = $((part % parts)) ] || continue
    number=$((number + 1))
    problem=
    began=$(date +%s%3N)
    mkdir "$work/$test" && cd "$work/$test" || exit 1
    $test
    cd "$work" || exit 1
    chmod -R u+w "$test"
    rm -rf "$test"
    [ -z "${CLI_TIMES:-}" ] || echo "# $(($(date +%s%3N) - began)) ms: $test"
    if [ -z "$problem" ]; then
        passed=$((passed + 1))
        echo "ok $number - $test"
    else
        failed=$((failed + 1))
        echo "not ok $number - $test"
        echo "# $problem" | tr '\n' ' '
        echo
    fi
done
echo "1..$number"
echo "$passed passed, $failed failed"
[ "$failed" = 0 ] && [ "$number" -gt 0 ]
