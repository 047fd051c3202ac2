# Tests of several models in one call, for run.sh, which reads this file: scenes, a drawing for each, patterns, and
# what is said of outputs that are folders.
# shellcheck shell=bash disable=SC2034,SC2086,SC2154

several_tests="scenes scenes_of_any_source scenes_have_colors_and_normals scenes_with_origins large_scenes scenes_that_fail
    groups_of_scenes drawings_of_each each_that_fails wrong_patterns quoted_patterns several_informed several_stats
    folders_as_outputs outputs_without_a_model"

# wall X0 Z0 X1 Z1: an OBJ of an upright square above the line.
wall() { printf 'v %s -1 %s\nv %s -1 %s\nv %s 1 %s\nv %s 1 %s\nf 1 2 3 4\n' "$1" "$2" "$3" "$4" "$3" "$4" "$1" "$2"; }

# Two walls that cross, in two files and in one: the same drawing.
scenes() {
    wall -1 0 1 0 >a.obj
    wall 0 -1 0 1 >b.obj
    { grep -h v a.obj b.obj; echo 'f 1 2 3 4'; echo 'f 5 6 7 8'; } >both.obj
    run 0 both.obj $small -q -o whole.png -o whole.svg --title walls
    run 0 a.obj b.obj $small -o out.png
    silent out
    silent err
    cmp -s whole.png out.png || fail "the scene differs from one file"
    run 0 a.obj -o out.svg b.obj $small -q --title walls
    cmp -s whole.svg out.svg || fail "the order of words matters"
    grep -q intersection out.svg || fail "the walls do not cross"
    run 0 a.obj b.obj $small -q -o out.svg
    says out.svg '<title>a.obj and b.obj</title>'
    run 0 a.obj b.obj both.obj -q -o out.svg --sheet front --dpi 50
    says out.svg '<title>a.obj and 2 more</title>'
    run 0 bench a.obj both.obj $small --frames 1
    says out '"triangles": 6'
}
# Files, generated models, other formats, a pipe; each as a part of a scene.
scenes_of_any_source() {
    run 0 make cube -o cube.stl
    run 0 make cube -o cube.obj
    run 0 shape:gear cube.obj $small -o first.png
    run 0 cube.obj shape:gear $small -o second.png
    cmp -s first.png second.png || fail "the order of models matters"
    cat cube.stl | "$program" shape:gear - $small -o piped.png 2>err || fail "a pipe: $(cat err)"
    cmp -s first.png piped.png || fail "the pipe is no part of the scene"
    wrong - shape:gear - -o out.png -- 'only one model can come from standard input'
    printf '<mesh/>' >broken.3mf
    run 1 cube.obj broken.3mf -o out.png
    says err 'broken.3mf: '
    absent out.png
    for threads in 1 2 7; do
        run 0 shape:gear shape:bolt cube.stl $small --threads $threads -o $threads.png
        cmp -s 1.png $threads.png || fail "$threads threads differ from one"
    done
}
# A red triangle of a PLY, and a sphere beside it that has neither colours nor normals.
scenes_have_colors_and_normals() {
    printf '%s\n' ply 'format ascii 1.0' 'element vertex 3' 'property float x' 'property float y' 'property float z' \
        'property float nx' 'property float ny' 'property float nz' 'property uchar red' 'property uchar green' \
        'property uchar blue' 'element face 1' 'property list uchar int vertex_indices' end_header \
        '2 0 0 0 0 1 255 0 0' '3 0 0 0 0 1 255 0 0' '2 1 0 0 0 1 255 0 0' '3 0 1 2' >red.ply
    local view='--eye 0,0,9 --target 0,0,0 --style lambert --lines none --size 160x120'
    run 0 make sphere -o sphere.ply
    run 0 red.ply sphere.ply $view --fov 40 -o scene.png
    run 0 red.ply sphere.ply $view --fov 40 -o plain.png --model-colors off
    cmp -s scene.png plain.png && fail "the colour is lost"
    # the triangle lies beyond the picture: the sphere is as smooth as alone
    run 0 sphere.ply $view --fov 12 -o alone.png
    run 0 red.ply sphere.ply $view --fov 12 -o beside.png
    cmp -s alone.png beside.png || fail "a sphere is shaded in another way beside a model with normals"
}
# Two halves of a scene in survey coordinates, each with an origin of its own, look as the whole at 0 does.
scenes_with_origins() {
    local view='--size 160x120'
    wall -1 0 1 0 >a.obj
    wall 0 -1 0 1 >b.obj
    for part in a b; do
        awk '$1 == "v" { printf "v %.3f %.3f %.3f\n", $2 + 692345.25, $3 + 5334567.5, $4 + 512; next } { print }' $part.obj >far-$part.obj
    done
    run 0 a.obj b.obj $view -o near.png
    run 0 far-a.obj far-b.obj $view -o far.png
    silent err
    cmp -s near.png far.png || fail "the scene changes far from 0"
}
# Binary STLs that do not fit together are read in parts.
large_scenes() {
    local small="--size 160x120 --lines silhouette,ridge,valley"
    run 0 make sphere --triangles 330000 -o a.stl
    run 0 make terrain --triangles 330000 -o b.stl
    run 0 a.stl b.stl $small -o held.png --stats=json
    run 0 a.stl b.stl $small -o streamed.png --memory 48M --stats=json
    silent err
    grep -q '"edges_lost": 0,' out || fail "edges are lost: $(cat out)"
    run 0 a.stl b.stl $small -o threads.png --memory 48M --threads 3
    cmp -s streamed.png threads.png || fail "differs with three threads"
    head -c 5000000 b.stl >cut.stl
    run 1 a.stl cut.stl $small -o out.png --memory 48M
    says err 'cut.stl: '
    absent out.png
    # ASCII among them: in parts as well, one batch after the other
    { echo solid x; echo 'facet normal 0 0 0 outer loop vertex 0 0 0 vertex 3 0 0 vertex 0 3 0 endloop endfacet'; echo endsolid x; } >c.stl
    run 0 a.stl b.stl c.stl $small -o mixed.png --memory 48M
    is_png mixed.png
}
scenes_that_fail() {
    run 0 make cube -o cube.stl
    printf 'v 0 0 0\n' >points.obj
    printf 'v 0 0 0\nv 1 0 0\nv 0 one 0\nf 1 2 3\n' >number.obj
    bad_scene() {
        run 1 cube.stl "$1" -o out.png
        one_line
        says err "$2"
        absent out.png
    }
    bad_scene missing.stl 'drypoint: missing.stl: cannot be read'
    bad_scene points.obj 'drypoint: points.obj: '
    bad_scene number.obj 'drypoint: number.obj:3: '
    { echo solid x; echo 'facet normal 0 0 0 outer loop vertex 0 0 0 vertex 3 0 0 vertex 0 oops 0 endloop endfacet'; } >late.stl
    bad_scene late.stl 'late.stl:2: '
    wrong cube.stl points.obj -o points.obj --format svg -- 'points.obj is a model'
    { echo solid x; echo 'facet normal 0 0 0 outer loop vertex 0 0 0 vertex 3 0 0 vertex 0 3 0 endloop endfacet'; } >open.stl
    run 0 cube.stl open.stl $small -o out.png
    says err 'warning: open.stl: ASCII STL without'
}
groups_of_scenes() {
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\no wing\nf 1 2 3\n' >a.obj
    printf 'v 2 0 0\nv 3 0 0\nv 2 1 0\no wing\nusemtl red\nf 1 2 3\n' >b.obj
    local view='--size 120x90 --edges map'
    run 0 a.obj b.obj $view -o all.png
    run 0 a.obj b.obj $view -o both.png --enhance wing
    cmp -s all.png both.png || fail "wing is not in both"
    run 0 a.obj b.obj $view -o first.png --enhance a.obj
    run 0 a.obj b.obj $view -o second.png --enhance wing/red
    cmp -s first.png both.png && fail "a.obj is both"
    cmp -s first.png second.png && fail "a.obj is wing/red"
    run 0 a.obj b.obj $view -o other.png --enhance b.obj/wing
    cmp -s second.png other.png || fail "b.obj/wing is not wing/red"
    run 1 a.obj b.obj $view -o out.png --enhance tail
    says err 'it has a.obj/wing, b.obj/wing/red'
}

# ---- a drawing for each ----

drawings_of_each() {
    mkdir parts
    run 0 make gear -o parts/gear.v2.ply
    run 0 make bolt -o 'parts/big bolt.stl'
    run 1 parts/gear.v2.ply shape:cube $small -o '%s.png' -o 'paths/%s.svg'
    one_line
    absent gear.v2.png # nothing is drawn before all is known to have a place
    mkdir paths
    run 0 parts/gear.v2.ply parts/big\ bolt.stl shape:cube:12 $small -o '%s.png' -o 'paths/%s-100%%.svg' -o depth=%s-depth.png
    for stem in gear.v2 'big bolt' cube; do
        is_png "$stem.png"
        is_png "$stem-depth.png"
        is_vector svg "paths/$stem-100%.svg"
        says err "paths/$stem-100%.svg: "
    done
    says paths/cube-100%.svg '<title>shape:cube:12</title>'
    run 0 parts/gear.v2.ply $small -q -o alone.png -o alone.svg # ends are exact beside paths
    cmp -s alone.png gear.v2.png || fail "differs from a run of its own"
    run 0 parts/gear.v2.ply $small -o alone.png
    run 0 parts/gear.v2.ply $small -o '%s-one.png' -o other.png # one model: names without %s are fine
    cmp -s alone.png gear.v2-one.png || fail "%s of one model"
    cmp -s alone.png other.png || fail "a name without %s beside one with it"
    run 0 shape:cube $small -o '50%.png' # no %s, no pattern
    is_png '50%.png'
    cat parts/gear.v2.ply | "$program" - $small -o %s.png || fail "a pipe"
    cmp -s alone.png stdin.png || fail "a pipe's drawing is not stdin.png"
    run 0 shape:cube shape:gear $small --levels 2 -o %s.png
    [ "$(grep -c 'warning: --levels' err)" = 1 ] || fail "a warning of options is not there once: $(cat err)"
}
each_that_fails() {
    printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 9\nf 1 2 3\nf 1 2 9\n' >index.obj
    run 1 shape:cube missing.stl index.obj nothing.ply shape:gear $small -o '%s.png'
    is_png cube.png
    is_png gear.png
    is_png index.png
    says err 'drypoint: missing.stl: cannot be read'
    says err 'drypoint: warning: index.obj: 1 of 2 polygons dropped'
    [ "$(tail -n 1 err)" = 'drypoint: 2 of 5 models failed: missing.stl, nothing.ply' ] || fail "last: $(tail -n 1 err)"
    run 1 missing.stl $small -o '%s.png'
    one_line
    run 2 shape:cube shape:gear -o '%s.svg' --scale 100000:1 --page A4 # wrong for each of them
    says err '2 of 2 models failed'
    no_temporary
}
wrong_patterns() {
    wrong shape:cube shape:gear -o %s.png -o out.png -- '-o out.png would be written for each of 2 models'
    wrong shape:cube shape:gear -o %s.png -o - -- '-o - would be written for each of 2 models'
    mkdir a b
    run 0 make cube -o a/part.stl
    run 0 make cube -o b/part.obj
    wrong a/part.stl shape:gear b/part.obj -o %s.png -- 'a/part.stl and b/part.obj would be drawn to the same file'
    absent gear.png
    cp b/part.obj xpart.dxf
    wrong b/part.obj xpart.dxf -o 'x%s.dxf' -- 'xpart.dxf, the drawing of b/part.obj, is a model'
    wrong a/part.stl -o 'a/%s.stl' --format png -- 'a/part.stl is the model'
    wrong shape:cube shape:gear -o %s.ai -- 'drawings are written as'
    run 1 shape:cube shape:gear -o 'none/%s.png'
    one_line
    says err 'none/cube.png'
}
quoted_patterns() {
    mkdir parts
    run 0 make cube -o parts/a.stl
    run 0 make gear -o parts/b.stl
    run 0 make bolt -o 'parts/[c].stl'
    run 0 'parts/*.stl' $small -o '%s.png'
    is_png a.png
    is_png b.png
    is_png '[c].png'
    run 0 'parts/[c].stl' $small -o named.png # a file of that very name
    cmp -s named.png '[c].png' || fail "a name with brackets is taken for a pattern"
    run 0 'parts/[ab].stl' $small -o pair.png
    run 0 parts/a.stl parts/b.stl $small -o same.png
    cmp -s pair.png same.png || fail "the pattern's scene differs"
    run 1 'parts/*.obj' -o out.png
    one_line
    says err 'parts/*.obj: '
    run 0 info 'parts/?.stl'
    [ "$(grep -c '^model  ' out)" = 2 ] || fail "info: $(cat out)"
}
several_informed() {
    run 0 info shape:cube shape:gear
    [ "$(grep -c '^polygons  ' out)" = 2 ] || fail "not two tables: $(cat out)"
    run 0 info --json shape:cube shape:gear
    [ "$(wc -l <out)" = 2 ] || fail "not two lines"
    says out '{"model": "shape:gear", '
    run 1 info shape:cube missing.stl shape:gear
    says out 'shape:gear'
    says err '1 of 3 models failed: missing.stl'
}
several_stats() {
    run 0 shape:cube shape:gear $small -o %s.png --stats
    [ "$(grep -c '^frame ' err)" = 2 ] || fail "not two tables"
    grep -qE '^model +shape:gear$' err || fail "the second table does not say what it is of"
    run 0 shape:cube shape:gear $small -o %s.png --stats=json
    [ "$(grep -c '"model": "shape:' out)" = 2 ] || fail "not two models: $(cat out)"
    run 0 shape:cube shape:gear $small -o out.png --stats=json
    [ "$(wc -l <out)" = 1 ] || fail "not one line"
    says out '{"models": 2, "width": 160'
    run 0 shape:cube $small -o out.png --stats=json
    says out '{"width": 160'
}

# ---- outputs ----

folders_as_outputs() {
    mkdir folder folder.png
    wrong shape:cube -o . -- '-o .: that is a folder; name a file in it: -o ./cube.png'
    wrong shape:cube -o folder/ -- 'name a file in it: -o folder/cube.png'
    wrong shape:cube -o none/ -- 'name a file in it: -o none/cube.png'
    wrong shape:cube -o folder.png -- 'name a file in it: -o folder.png/cube.png'
    wrong shape:cube -o depth=folder -- 'name a file in it: -o depth=folder/cube.png'
    wrong shape:cube -o segments=folder -- 'name a file in it: -o segments=folder/cube.json'
    wrong shape:cube -o trace=folder -- 'name a file in it: -o trace=folder/cube.txt'
    wrong shape:cube shape:gear -o folder -- "name a file in it: -o 'folder/%s.png'"
    wrong make cube -o . -- 'name a file in it: -o ./cube.ply'
}
outputs_without_a_model() {
    wrong -o depth=d.png -- 'no model given; usage: drypoint MODEL'
    wrong -o out.png -- 'no model given'
    wrong shape:cube out.png -- 'no output given; did you mean -o out.png?'
    wrong shape:cube shape:gear -- "or -o '%s.png' for a drawing of each"
    run 0 shape:cube $small -o depth=d.png
    is_png d.png
    wrong inof x.obj -- 'inof: there is no such file or command; did you mean "drypoint info"?'
    wrong mkae gear -o gear.ply -- 'did you mean "drypoint make"?'
    wrong benhc -o out.png -- 'did you mean "drypoint bench"?'
    wrong hlep -- 'did you mean "drypoint help"?'
    run 0 make cube -o inof.obj
    mv inof.obj inof
    run 0 inof $small -o out.png # a file of that name is a model
    is_png out.png
    run 1 nothing -o out2.png
    says err 'nothing: cannot be read'
}
