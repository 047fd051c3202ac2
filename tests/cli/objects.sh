# Tests of objects (groups of a model), for run.sh, which reads this file: styles of their own, what is left out,
# exploded views, lists.
# shellcheck shell=bash disable=SC2034,SC2086,SC2154

objects_tests="listed_objects objects_left_out objects_left_out_of_fits objects_styled objects_by_pattern odd_names_of_objects
    later_objects_win exploded_parts exploded_scenes objects_everywhere wrong_objects unknown_objects many_objects
    objects_of_pipes"

# cuboid NAME X: an OBJ of a cuboid of side 1, an object of that name, whose middle is at x = X.
cuboid() {
    awk -v name="$1" -v x="$2" 'BEGIN {
        print "o " name
        for (i = 0; i < 8; i++) print "v", x - 0.5 + i % 2, int(i / 2) % 2, int(i / 4)
        print "f -8 -6 -5 -7\nf -4 -3 -1 -2\nf -8 -7 -3 -4\nf -6 -2 -1 -5\nf -8 -4 -2 -6\nf -7 -5 -1 -3" }'
}
# Three boxes in a row: left, middle/core and right.
row() { { cuboid left 0; cuboid middle/core 2; cuboid right 6; } >row.obj; }
# colors FILE.svg: the colours of its lines.
colors() { grep -oE 'stroke="#[0-9a-f]*' "$1" | cut -c 9- | sort -u | tr '\n' ' '; }

listed_objects() {
    row
    printf 'mtllib row.mtl\n' | cat - row.obj >colored.obj
    sed -i 's/^o right/o right\nusemtl red/' colored.obj
    printf 'newmtl red\nKd 1 0 0\n' >row.mtl
    run 0 colored.obj --list
    silent err
    says out '  polygons  colour   name'
    says out '         6  -        left'
    says out '         6  -        middle/core'
    says out '         6  #ff0000  right/red'
    run 0 --list colored.obj row.obj
    says out 'colored.obj/right/red'
    says out 'row.obj/right'
    [ "$(wc -l <out)" = 7 ] || fail "not six objects"
    run 0 colored.obj --list --json
    ! command -v python3 >/dev/null || python3 -c 'import json, sys
objects = json.load(sys.stdin)
assert [o["name"] for o in objects] == ["left", "middle/core", "right/red"]
assert objects[2]["color"] == "#ff0000ff" and objects[0]["color"] is None
assert objects[1]["min"] == [1.5, 0, 0] and objects[1]["polygons"] == 6' <out || fail "the JSON differs"
    run 0 colored.obj --list --only 'm*,right'
    [ "$(wc -l <out)" = 3 ] || fail "--list does not leave out what --only does"
    run 0 colored.obj --list -o out.png --color red --time 0
    says err 'warning: --output, --color change nothing: --list draws nothing'
    absent out.png
    run 0 shape:cube --list
    says out '        12  -        (no name)'
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\no a\033[31mb\nf 1 2 3\n' >sly.obj
    run 0 sly.obj --list
    says out 'a?[31mb'
    : >empty.stl
    run 1 empty.stl --list
    one_line
}
objects_left_out() {
    row
    { cuboid left 0; cuboid right 6; } >two.obj
    run 0 two.obj $small -o want.png
    set -f
    for options in '--without middle' '--without core' '--only left,right' '--only left --only right' '--only *t' \
        '--object middle/core:hide' '--only * --without ?iddle'; do
        run 0 row.obj $small $options -o out.png
        silent err
        cmp -s want.png out.png || fail "$options: the picture differs"
    done
    set +f
    run 0 info row.obj --without left
    says out 'polygons                         12'
}
# What is left out has no say in the camera.
objects_left_out_of_fits() {
    row
    cuboid right 6 >one.obj
    run 0 one.obj $small -o want.svg --title x
    run 0 row.obj $small --only right -o out.svg --title x
    cmp -s want.svg out.svg || fail "the drawing differs"
}
objects_styled() {
    row
    run 0 row.obj $small -o out.svg --color '#0000ff' --object 'left:color=red,ridge=lime,width=3' --object right:lines=silhouette
    [ "$(colors out.svg)" = '#00f #0f0 #f00 ' ] || fail "the colours are $(colors out.svg)"
    run 0 row.obj $small -o plain.png
    run 0 row.obj $small -o out.png --object '*:color=black'
    cmp -s plain.png out.png || fail "the same style for all objects draws something else"
    run 0 row.obj $small -o red.png --surface red --lines none
    run 0 row.obj $small -o out.png --lines none --object '*:surface=red'
    cmp -s red.png out.png || fail "the surfaces differ"
    run 0 row.obj $small -o toon.png --style toon --surface red
    run 0 row.obj $small -o out.png --style toon --object 'left,middle,right:surface=red'
    cmp -s toon.png out.png || fail "the shaded surfaces differ"
    run 0 row.obj $small -o out.svg --hidden dashed --object 'right:hidden-color=#ff0000,hidden-width=ridge=3'
    says out.svg 'stroke="#f00"'
    run 0 row.obj $small -o out.svg --ridge-angle 60 --lines ridge --object 'right:ridge-angle=100,color=red'
    [ "$(colors out.svg)" = '#f00 ' ] || fail "ridges of other objects are drawn"
    # the ground of a vector file has no lines
    run 0 row.obj $small -o out.svg --ground png --object left:surface=red
    says out.svg '<image'
    # widths on paper
    run 0 row.obj -q -o out.svg --page A5 --object left:width=2mm
    says out.svg 'stroke-width="11.811"' # px of 150 dpi
}
objects_by_pattern() {
    { cuboid bolt1 0; cuboid bolt2 2; cuboid 'nut*' 4; cuboid 'Bolt3' 6; } >many.obj
    only() { # PATTERN LINES: how many objects it leaves
        run 0 many.obj --list --only "$1"
        [ "$(wc -l <out)" = $(($2 + 1)) ] || fail "--only $1 leaves $(cat out)"
    }
    only 'bolt*' 2
    only 'bolt?' 2
    only '?olt?' 3
    only 'nut\*' 1
    only '*' 4
    only '*ut?' 1
    only 'bolt1,nut*' 2
    only 'b**1' 1
    run 1 many.obj --list --only 'bolt'
    says err 'did you mean bolt1'
}
odd_names_of_objects() {
    { cuboid 'a:b, c' 0; cuboid 'shape:bolt' 2; cuboid 'x:color=red' 4; } >odd.obj
    run 0 odd.obj $small -o out.svg --object 'a:b\, c:color=red' --object shape:bolt:color=blue --object 'x\:color=red:color=lime'
    [ "$(colors out.svg)" = '#00f #0f0 #f00 ' ] || fail "the colours are $(colors out.svg)"
    run 0 odd.obj --list --only 'a:b\, c'
    [ "$(wc -l <out)" = 2 ] || fail "a comma in a name: $(cat out)"
    # one part of a name, or more that follow each other
    { cuboid a/b/c 0; cuboid a/bc 2; } >deep.obj
    for name in a/b/c a/b b/c b c; do
        run 0 deep.obj --list --only $name
        [ "$(wc -l <out)" = 2 ] || fail "--only $name leaves $(cat out)"
    done
    run 1 deep.obj --list --only a/c
}
later_objects_win() {
    row
    run 0 row.obj $small -o want.svg --title x --object 'left:color=red,width=3'
    run 0 row.obj $small -o out.svg --title x --object 'left:color=blue,width=3' --object 'l*:color=red'
    cmp -s want.svg out.svg || fail "a later --object does not change an earlier one"
    run 0 row.obj $small -o out.svg --title x --object 'left:color=blue,width=3,color=red'
    cmp -s want.svg out.svg || fail "a later setting does not change an earlier one"
}
exploded_parts() {
    row
    # centres at 0, 2 and 6, and the model's at 3
    { cuboid left -3; cuboid middle/core 1; cuboid right 9; } >apart.obj
    run 0 apart.obj $small -o want.png
    for options in '--explode 1' '--explode 1 --explode-axis x'; do
        run 0 row.obj $small $options -o out.png
        silent err
        cmp -s want.png out.png || fail "$options: the picture differs"
    done
    run 0 row.obj $small -o want.png
    run 0 row.obj $small -o out.png --explode 0
    silent err
    cmp -s want.png out.png || fail "--explode 0 moves something"
    run 0 row.obj $small -o out.png --explode 2 --explode-axis y
    says err 'warning: --explode changes nothing: no part lies away from the model'
    cmp -s want.png out.png || fail "parts move along y"
    run 0 row.obj $small -o out.png --explode-axis y
    says err '--explode-axis changes nothing'
    run 0 row.obj --list --json --explode 1 --only right
    says out '"min": [8.5, 0, 0]'
    run 0 shape:cube $small -o out.png --explode 1
    says err '--explode changes nothing'
}
# Parts of a scene are its models; a binary STL's triangles are moved, too.
exploded_scenes() {
    { cuboid a/one 0; cuboid b/two 2; } >first.obj
    cuboid c 8 >second.obj
    run 0 first.obj second.obj --list --json --explode 1
    says out '"min": [-3.5, 0, 0]'
    says out '"min": [-1.5, 0, 0]'
    says out '"min": [11.5, 0, 0]'
    run 0 make cube -o cube.stl
    run 0 make sphere -o sphere.stl
    run 0 cube.stl sphere.stl --list --json --without sphere.stl
    says out '"name": "cube.stl"'
    [ "$(grep -c polygons out)" = 1 ] || fail "the sphere is still there"
    run 0 cube.stl $small -o want.png
    run 0 cube.stl sphere.stl $small -o out.png --without sphere.stl
    cmp -s want.png out.png || fail "the picture differs"
}
# Objects in every kind of drawing.
objects_everywhere() {
    row
    local styled='--object left:color=red,width=4 --object right:surface=steelblue,lines=silhouette,ridge --explode 0.5'
    for options in '--style gooch' '--style hatch' '--ink quads' '--edges adjacency' '--edges both' '--hidden dashed' \
        '--mirror 0,1,0' '--stroke pencil' '--smooth 2' '--detail exact' '--edges map --enhance left'; do
        run 0 row.obj $small $styled $options -o 1.png --threads 1
        run 0 row.obj $small $styled $options -o 2.png --threads 3
        cmp -s 1.png 2.png || fail "$options: threads matter"
        run 0 row.obj $small $options -o plain.png
        cmp -s 1.png plain.png && fail "$options: nothing changes"
    done
    for ending in pdf eps dxf json; do
        run 0 row.obj $small $styled -o out.$ending
        [ -s out.$ending ] || fail "no .$ending"
    done
    run 0 row.obj -o out.pdf --sheet front,top,iso $styled
    run 0 bench row.obj $small $styled --frames 1
    says out '"triangles": 36'
    # a drawing for each
    cp row.obj other.obj
    run 0 row.obj other.obj $small --only left -o '%s.png'
    cmp -s row.png other.png || fail "drawings of each differ"
}
wrong_objects() {
    row
    for value in '' left left: ':color=red' ',:hide' 'left,:hide' left:color left:color= left:color=rde left:width=0 \
        left:hide=1 left:colour=red left:color=red,widht=2 left:width=2,ridgge=1 left:lines=none,ridge left:xyz=1 \
        left:surface=nil left:ridge-angle=0 left:hide,hide=; do
        wrong row.obj --object "$value" -o out.png -- '--object'
    done
    wrong row.obj --object left:colour=red -o out.png -- 'did you mean color=?'
    wrong row.obj --object left:color=red,widht=2 -o out.png -- '"widht" is no setting of an object; did you mean width=?'
    wrong row.obj --object left:texture=red -o out.png -- '"texture" is no setting of an object; those are color|'
    wrong row.obj --object left:width=x -o out.png -- '--object left:width: "x" is not a width'
    wrong row.obj --object "left:color=$(head -c 3000 /dev/zero | tr '\0' 1)" -o out.png -- 'more than 512 letters'
    for option in --only --without; do
        for value in '' , left, ,left; do
            wrong row.obj $option "$value" -o out.png -- "$option: a name is empty"
        done
    done
    for value in nan inf -1 x 1e9 ''; do
        wrong row.obj --explode "$value" -o out.png -- '--explode: '
    done
    wrong row.obj --explode-axis w -o out.png -- '--explode-axis: "w" is none of x|y|z'
    run 0 row.obj $small --json -o out.png
    says err '--json changes nothing'
}
unknown_objects() {
    row
    for option in --only --without; do
        run 1 row.obj $option lfet -o out.png
        one_line
        says err "$option: the model has no object called \"lfet\"; did you mean left? --list prints all"
        absent out.png
    done
    run 1 row.obj --object 'left,centre*:hide' -o out.png
    says err '"centre*"; it has left, middle/core, right; --list prints all'
    run 1 row.obj --enhance lfet --edges map -o out.png
    one_line
    run 1 row.obj --only left --without left -o out.png
    says err 'row.obj: nothing is left of it'
    run 1 row.obj --object '*:hide' -o out.png
    says err 'nothing is left'
    run 1 shape:cube --only cube -o out.png
    says err 'the objects of shape:cube have no names'
    absent out.png
}
# As many groups as batches can number, and more.
many_objects() {
    awk 'BEGIN { for (i = 0; i < 66000; i++) {
        x = i % 300; y = int(i / 300)
        printf "v %d %d 0\nv %g %d 0\nv %d %g 0\no part%d\nf -3 -2 -1\n", x, y, x + 0.8, y, x, y + 0.8, i } }' >many.obj
    run 0 many.obj --list
    [ "$(wc -l <out)" = 65537 ] || fail "$(wc -l <out) lines"
    run 0 many.obj $small -o out.png --object 'part1*:surface=red,lines=none' --without 'part2*' --object part65534:color=red --explode 0.1
    run 1 many.obj --only part7000x -o absent.png
    one_line
}
# A pipe is read into memory, where objects must be known before they are drawn.
objects_of_pipes() {
    row
    run 0 row.obj $small --only left -o want.png --eye 3,4,9 --target 0,0,0
    "$program" - $small --only left -o out.png --eye 3,4,9 --target 0,0,0 --passes 1 <row.obj 2>err || fail "$(cat err)"
    cmp -s want.png out.png || fail "the picture differs"
}
