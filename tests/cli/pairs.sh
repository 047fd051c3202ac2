#!/usr/bin/env bash
# Every two features of the program, together: a small picture of each pair. Usage: pairs.sh PATH/TO/drypoint [PATTERN]
#
# A pair draws (exit code 0, its files there), with the same bytes for one thread and for three; or it is one of `refused`,
# and says so, with exit code 2 or 1, and leaves nothing. Prints TAP, a line for each feature, and a closing count.
set -u
program=$(realpath "${1:?usage: pairs.sh PATH/TO/drypoint [PATTERN]}")
pattern=${2:-}
work=$(mktemp -d "${TMPDIR:-/tmp}/drypoint-pairs-XXXXXX")
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1

# ---- the model ----

# corners BYTE: corners of a cube, 8 of three signed bytes and one to fill up; four of them at z = BYTE.
corners() {
    for i in 0 1 2 3 4 5 6 7; do
        for k in 0 1; do [ $((i >> k & 1)) = 1 ] && printf '\1' || printf '\377'; done
        # shellcheck disable=SC2059
        [ $((i >> 2)) = 1 ] && printf "$1" || printf '\377'
        printf '\0'
    done
}
# model BYTE: glTF of an assembly: a core in a housing, and a lid that moves up within a second.
model() {
    local data
    data=$({
        printf '\0\2\1\1\2\3\4\5\6\5\7\6\0\1\4\1\5\4\2\6\3\3\6\7\0\4\2\2\4\6\1\3\5\3\7\5'
        corners "$1"
        printf '\0\0\0\0\0\0\200\77'
        printf '\0\0\0\0\0\0\300\77\0\0\0\0\0\0\0\0\0\0\40\100\0\0\0\0'
    } | base64 | tr -d '\n')
    cat <<END
{"asset": {"version": "2.0"},
 "nodes": [{"name": "housing", "mesh": 0}, {"name": "core", "mesh": 0, "scale": [0.5, 0.7, 0.4], "translation": [0.1, 0, 0.2]},
           {"name": "lid", "mesh": 0, "scale": [1.1, 0.2, 1.1], "translation": [0, 1.5, 0]}],
 "meshes": [{"name": "box", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
 "animations": [{"name": "open", "channels": [{"sampler": 0, "target": {"node": 2, "path": "translation"}}],
                 "samplers": [{"input": 2, "output": 3}]}],
 "buffers": [{"byteLength": 100, "uri": "data:;base64,$data"}],
 "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 32, "byteStride": 4},
                 {"buffer": 0, "byteOffset": 68, "byteLength": 8}, {"buffer": 0, "byteOffset": 76, "byteLength": 24}],
 "accessors": [{"bufferView": 1, "componentType": 5120, "count": 8, "type": "VEC3"},
               {"bufferView": 0, "componentType": 5121, "count": 36, "type": "SCALAR"},
               {"bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
               {"bufferView": 3, "componentType": 5126, "count": 2, "type": "VEC3"}]}
END
}
model '\1' >parts.gltf
model '\3' >longer.gltf
cat >way.json <<'END'
{"views": [{"time": 0, "eye": [6, 4, 8], "target": [0, 0, 0]}, {"time": 1, "eye": [8, 4, -6], "target": [0, 0, 0]}]}
END

# ---- features: name, options ----

features=(
    'time       --time 0.4'
    'film       --time 0:1 --frames 2 -o film-%d.png'
    'turn       --turn 90 --frames 2 -o turn-%d.png'
    'path       --path ../way.json --fps 2 -o path-%d.png'
    'raw        --frames 2 --time 0.1 -o film.rgba'
    'deform     --deform twist:angle=60 --time 0.1'
    'breathe    --deform breathe --time 0.6'
    'morph      --morph ../longer.gltf --blend 0.5'
    'object     --object lid:color=red,width=2,surface=#eed --object core:surface=#fc8'
    'seen       --object housing:xray=0.3'
    'only       --only housing,lid'
    'without    --without core'
    'explode    --explode 1'
    'clip       --clip 1,0,0'
    'clips      --clip 1,0,1 --clip 0,1,0,0.2 --section crossed'
    'open       --clip 0,0,1 --section open'
    'xray       --xray 0.4'
    'pattern    --pattern rope --width 5'
    'light      --line-light lambert'
    'hidden     --hidden dashed'
    'mirror     --mirror 0,1,0'
    'smooth     --smooth 2'
    'detail     --detail exact'
    'stroke     --stroke charcoal'
    'pens       --taper 5 --jitter 1 --overshoot 2'
    'polar      --stroke dashes --stroke-u polar'
    'quads      --ink quads'
    'stencil    --ink quads --between stencil'
    'adjacency  --edges adjacency'
    'both       --edges both'
    'map        --edges map'
    'gooch      --style gooch'
    'paper      --style paper'
    'hatch      --style hatch'
    'pencil     --style pencil'
    'once       --passes 1'
    'memory     --memory 48M'
    'sheet      --sheet front,iso --dpi 20'
    'page       --page A5 --dpi 20'
    'vectors    -o out.svg -o out.pdf -o out.eps -o out.dxf -o out.json'
    'ground     -o ground.svg --ground png'
    'trace      -o trace=out.txt'
    'planes     -o normals=n.png -o depth=d.png -o edge-map=e.png'
    'stats      --stats'
    'preset     --preset patent'
    'engraving  --preset engraving'
    'colors     --model-colors on'
    'up         --up z'
    'ortho      --ortho 0 --view front'
    'several    shape:cube'
)

# ---- pairs that do not go together: both names, and a part of the message ----

refused=(
    'turn path|--turn and --path both move the camera; leave one out'
    'turn sheet|--sheet already says where from; leave out --turn, or --sheet'
    'path sheet|--sheet already says where from; leave out --path, or --sheet'
    'path ortho|--path already says where from'
    'morph several|--morph blends one model with another, but 2 are given'
    'seen quads|leave out --ink quads or xray'
    'seen stencil|leave out --ink quads or xray'
    'seen adjacency|leave out --edges adjacency or xray'
    'xray quads|leave out --ink quads or xray'
    'xray stencil|leave out --ink quads or xray'
    'xray adjacency|leave out --edges adjacency or xray'
    'hidden quads|hidden lines are drawn as strokes; with quads as ink there are none'
    'hidden stencil|hidden lines are drawn as strokes; with quads as ink there are none'
    'hidden adjacency|hidden lines emerge from the tiles; with lines by adjacency there are none'
    'clip smooth|--clip cuts polygons, and --smooth would draw another surface than was cut; leave one out'
    'clips smooth|leave one out'
    'open smooth|leave one out'
    'clip quads|--ink quads has no lines of sections; leave it out, or --clip'
    'clip stencil|--ink quads has no lines of sections; leave it out, or --clip'
    'clips quads|--ink quads has no lines of sections; leave it out, or --clip'
    'clips stencil|--ink quads has no lines of sections; leave it out, or --clip'
    'open quads|--ink quads has no lines of sections; leave it out, or --clip'
    'open stencil|--ink quads has no lines of sections; leave it out, or --clip'
    'pattern stroke|--pattern and --stroke both say what lines look like; leave one out'
    'pattern polar|--pattern and --stroke both say what lines look like; leave one out'
    'pattern adjacency|give --stroke rope instead of --pattern, or add --ink strokes'
    'quads once|one pass needs the interval test (--between interval)'
    'stencil once|one pass needs the interval test (--between interval)'
    'sheet quads|a sheet draws hidden lines'
    'sheet stencil|a sheet draws hidden lines'
    'sheet adjacency|a sheet draws hidden lines'
    'sheet ortho|--sheet already says where from'
    'sheet mirror|a sheet has no mirror'
    'sheet trace|is of one view'
    'sheet planes|is of one view'
)

# draw FOLDER THREADS OPTIONS: exit code in code.
draw() {
    mkdir "$1" && cd "$1" || exit 1
    code=0
    # shellcheck disable=SC2086
    timeout 120 "$program" ../parts.gltf $3 --threads "$2" >out 2>err </dev/null || code=$?
    case $3 in *--stats*) : >err ;; esac # times differ
    cd ..
}

wanted() { # what the pair's message must hold; empty: it draws
    local r
    for r in "${refused[@]+"${refused[@]}"}"; do
        case $r in "$1 $2|"* | "$2 $1|"*) echo "${r#*|}" ; return ;; esac
    done
}

# pair A B OPTIONS: fills problem.
pair() {
    local message
    message=$(wanted "$1" "$2")
    options=$3
    case $3 in
    *-%d.png* | *.rgba*) # a film has files for each frame
        options=$(sed -E 's/-o ([^ %]*)\.(png|svg|pdf|eps|dxf|json|txt)/-o \1-%d.\2/g' <<<"$3") ;;
    *) options+=' -o out.png' ;;
    esac
    case $3 in *--sheet* | *--page*) ;; *) options+=' --size 96x72' ;; esac
    rm -rf one three
    draw one 1 "$options"
    if [ -n "$message" ]; then
        [ $code = 2 ] || [ $code = 1 ] || problem+=" $1+$2: exit code $code, and no refusal;"
        grep -qF -e "$message" one/err || problem+=" $1+$2: no \"$message\" but: $(head -n 1 one/err 2>/dev/null);"
        [ "$(find one -type f | wc -l)" = 2 ] || problem+=" $1+$2: files are left;"
        return
    fi
    [ $code = 0 ] || { problem+=" $1+$2: exit code $code: $(head -n 1 one/err 2>/dev/null);"; return; }
    [ "$(find one -type f -size +0 ! -name err ! -name out | wc -l)" -gt 0 ] || problem+=" $1+$2: no file;"
    draw three 3 "$options"
    diff -r one three >/dev/null || problem+=" $1+$2: three threads differ from one;"
}

# tell NAME: one line of TAP, by problem.
passed=0 failed=0 number=0
tell() {
    number=$((number + 1))
    if [ -z "$problem" ]; then
        passed=$((passed + 1))
        echo "ok $number - $1"
    else
        failed=$((failed + 1))
        echo "not ok $number - $1"
        echo "#$problem" | tr '\n' ' ' | sed 's/; /;\n# /g'
        echo
    fi
}

# ---- films of several features at once: a frame is the picture at its time ----

whole=(
    '--deform twist --clip 1,0,0 --explode 1 --object housing:xray=0.4 --object lid:color=red'
    '--clip 0,1,0,1.6 --object lid:width=3 --pattern rope'
    '--clip 0,1,0,1.6 --explode 1 --style gooch --hidden dashed --without core'
    '--deform breathe --xray 0.4 --line-light toon --edges both'
    '--morph ../longer.gltf --clip 0,0,1 --explode 0.5 --stroke charcoal'
)
frames_are_pictures() {
    local view='--eye 6,5,9 --target 0,1,0 --size 96x72 -q --animation 1' options
    for options in "${whole[@]}"; do
        problem=
        rm -rf film && mkdir film && cd film || exit 1
        # shellcheck disable=SC2086
        "$program" ../parts.gltf $view $options --time 0:1 --frames 4 -o f-%d.png -o f-%d.svg 2>err &&
            "$program" ../parts.gltf $view $options --time 0.75 -o f.png -o f.svg 2>err &&
            "$program" ../parts.gltf $view $options --time 0:1 --frames 4 --frame 3 -o alone-%d.png -o alone-%d.svg 2>err ||
            problem=" $(head -n 1 err)"
        cmp -s f-3.png f.png || problem+=" frame 3 is not the picture at its time;"
        cmp -s f-3.svg f.svg || problem+=" frame 3 is not the drawing at its time;"
        cmp -s f-3.png alone-3.png || problem+=" frame 3 alone is another;"
        cmp -s f-0.png f-3.png && problem+=" nothing moves;"
        cd ..
        tell "film: $options"
    done
}
# What a section takes away at one time is there at another, and may be named, left out or all that is drawn.
objects_come_and_go() {
    problem=
    rm -rf gone && mkdir gone && cd gone || exit 1
    local cut='--clip 0,1,0,1.8 --size 96x72 --eye 6,5,9 --target 0,1,0'
    # shellcheck disable=SC2086
    "$program" ../parts.gltf $cut --only lid --time 1:0 --frames 4 -q -o f-%d.png 2>err || problem+=" $(head -n 1 err);"
    cmp -s f-0.png f-3.png && problem+=" the lid does not come;"
    # shellcheck disable=SC2086
    "$program" ../parts.gltf $cut --without lid --time 1:0 --frames 4 -o g-%d.png 2>err || problem+=" $(head -n 1 err);"
    cmp -s g-0.png g-3.png || problem+=" the lid is not left out;"
    # shellcheck disable=SC2086
    "$program" ../parts.gltf $cut --only lid --time 1 -o no.png 2>err && problem+=" a picture of nothing;"
    grep -q 'the clip planes leave nothing of what is to be drawn' err || problem+=" says: $(head -n 1 err);"
    [ ! -e no.png ] || problem+=" no.png is there;"
    cd ..
    tell 'objects come and go'
}
if [[ film == *"$pattern"* ]]; then
    frames_are_pictures
    objects_come_and_go
fi

# ---- all pairs ----

for a in "${!features[@]}"; do
    read -r first first_options <<<"${features[$a]}"
    problem=
    for ((b = a; b < ${#features[@]}; b++)); do
        read -r second second_options <<<"${features[$b]}"
        case "$first+$second" in *"$pattern"*) ;; *) continue ;; esac
        [ "$a" = "$b" ] && second_options=
        pair "$first" "$second" "$first_options $second_options"
    done
    tell "$first"
done
echo "1..$number"
echo "$passed passed, $failed failed"
[ $failed = 0 ]
