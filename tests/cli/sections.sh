# Tests of models cut open, for run.sh, which reads this file.
# shellcheck shell=bash disable=SC2034

section_tests="sections sections_that_miss sections_of_parts sections_in_files sections_and_looks sections_of_moving_eyes
    wrong_sections sections_that_take_all sections_of_streams"

# layers_of TRACE: its layers from the bottom up.
layers_of() { awk '$1 == "layer" { print $2 }' "$1" | tr '\n' ' '; }

sections() {
    run 0 shape:cube $small -q --clip 0,1,0 -o trace=cut.txt
    [ "$(layers_of cut.txt)" = "hatching ridge silhouette section " ] || fail "layers: $(layers_of cut.txt)"
    run 0 shape:cube $small -q --clip 0,1,0,0 -o trace=same.txt
    cmp -s cut.txt same.txt || fail "the middle of the cube is not at 0"
    run 0 shape:cube $small -q --clip 0,7,0,0 -o trace=same.txt
    cmp -s cut.txt same.txt || fail "the normal's length matters"
    run 0 shape:cube $small -q --clip 0,1,0 --section plain -o trace=plain.txt
    [ "$(layers_of plain.txt)" = "ridge silhouette section " ] || fail "plain: $(layers_of plain.txt)"
    run 0 shape:cube $small -q --clip 0,1,0 --section open -o trace=open.txt
    [ "$(layers_of open.txt)" = "valley ridge silhouette section " ] || fail "open: $(layers_of open.txt)"
    run 0 shape:cube $small -q --clip 0,1,0 --lines silhouette,section -o trace=some.txt
    [ "$(layers_of some.txt)" = "silhouette section " ] || fail "some: $(layers_of some.txt)"
    # hatching is narrow, outlines of sections are wide; all can be said
    run 0 shape:cube -q --clip 0,1,0 --width 4 -o trace=all.txt
    grep -A9 'layer hatching' all.txt | grep -q 'width 2 ' || fail "hatching is not half as wide"
    grep -A9 'layer section' all.txt | grep -q 'width 4 ' || fail "a section is not as wide as the others"
    run 0 shape:cube -q --clip 0,1,0 --width section=5 --color hatching=#F00 -o trace=wide.txt
    weights_of wide.txt >weights.txt
    says weights.txt "hatching 1.5 ridge 1.5 section 5 silhouette 3"
    says wide.txt "#ff0000ff"
    run 0 shape:cube -q --clip 0,1,0 --width 4 -o trace=wide.txt
    weights_of wide.txt >weights.txt
    says weights.txt "hatching 2 ridge 4 section 4 silhouette 4"
    run 0 shape:cube -q --clip 0,1,0 --width 4,hatching=3 -o trace=wide.txt
    weights_of wide.txt >weights.txt
    says weights.txt "hatching 3 ridge 4 section 4 silhouette 4"
    # lines lie at half the distance, so there are about twice as many
    run 0 shape:cube -q --clip 0,1,0 --section-spacing 2% --lines hatching -o trace=wide.txt
    run 0 shape:cube -q --clip 0,1,0 --section-spacing 1% --lines hatching -o trace=narrow.txt
    local wide narrow
    wide=$(grep -c '^stroke' wide.txt) narrow=$(grep -c '^stroke' narrow.txt)
    [ "$narrow" -ge $((2 * wide - 2)) ] && [ "$narrow" -le $((2 * wide + 2)) ] || fail "lines: $wide, $narrow"
    for threads in 1 2 5; do
        run 0 shape:bracket $small -q --clip 1,0,0.3 --clip 0,1,0 --threads $threads -o $threads.png
        cmp -s 1.png $threads.png || fail "$threads threads differ from one"
    done
}
sections_that_miss() {
    run 0 shape:gear $small -q -o whole.png
    run 0 shape:gear $small -q --clip 0,0,1,99 --clip 1,0,0,99 -o missed.png
    cmp -s whole.png missed.png || fail "a plane that misses changes the picture"
    run 0 shape:gear $small --clip 0,0,1,99 -o missed.png
    says err 'warning: the clip planes take nothing away: all of the model lies on the side that is kept'
    one_line
    run 0 shape:gear $small --clip 0,0,1,99 --clip 1,0,0 -o met.png
    silent err
    # a film of what moves into the plane later says nothing
    run 0 shape:flag $small --deform wave --clip 0,0,1,0.01 --time 0:1 --frames 2 -o f-%d.png
    silent err
}
# Each part has its own hatching.
sections_of_parts() {
    run 0 make bolt -o bolt.ply
    run 0 make bracket -o bracket.ply
    run 0 bolt.ply bracket.ply -q --clip 1,0,0 -o trace=both.txt
    awk '$1 == "layer" { class = $2 } $1 == "stroke" { print class, $4 }' both.txt | sort -u >groups.txt
    for line in "section 0" "section 1" "hatching 0" "hatching 1"; do says groups.txt "$line"; done
}
sections_in_files() {
    run 0 shape:bracket -q --clip 1,0,0 -o a.svg -o a.pdf -o a.eps -o a.dxf -o a.json -o segments=b.json
    for file in a.svg a.eps a.json b.json; do says $file section; done
    says a.svg hatching
    says a.dxf SECTION
    says a.json '"line":"hatching"'
    run 0 shape:bracket -q --sheet front,top,iso --clip 1,0,0 -o sheet.svg
    says sheet.svg hatching
}
sections_and_looks() {
    run 0 shape:cube $small --clip 0,1,0 --edges map --section-angle 30 -o map.png
    says err '--section-angle changes nothing: --edges map and none draw no such lines'
    local look
    for look in '--style gooch' '--preset technical' '--preset engraving' '--hidden dashed' '--stroke pencil' \
        '--mirror 0,1,0' '--edges adjacency' '--edges both' '--section crossed --section-color #FC0' '--samples 1'; do
        run 0 shape:bolt $small -q --clip 1,0,0 $look -o out.png
        is_png out.png
        silent err
    done
    run 0 shape:bolt $small -q --clip 1,0,0 --section plain -o white.png
    run 0 shape:bolt $small -q --clip 1,0,0 --section plain --section-color red -o red.png
    cmp -s white.png red.png && fail "--section-color changes nothing"
    run 0 shape:bolt $small -q --clip 1,0,0 --section plain --style gooch -o white.png
    run 0 shape:bolt $small -q --clip 1,0,0 --section plain --style gooch --section-color red -o red.png
    cmp -s white.png red.png && fail "--section-color changes nothing of a shaded picture"
    run 0 bench shape:bolt $small --clip 1,0,0 --frames 1
}
# The camera fits what is left.
sections_of_moving_eyes() {
    run 0 shape:torus $small -q --view front --ortho 0 --lines silhouette,section -o trace=whole.txt
    run 0 shape:torus $small -q --view front --ortho 0 --lines silhouette,section --clip 1,0,0,-0.9 -o trace=part.txt
    cmp -s whole.txt part.txt && fail "nothing is cut"
    awk '$1 == "from" || $1 == "to" { if ($2 > x) x = $2; if ($3 > y) y = $3 } END { exit !(x > 100 || y > 100) }' part.txt ||
        fail "the part is small in the picture"
}
wrong_sections() {
    local plane
    for plane in 0,0 0,0,1,2,3 up '' 0,0,x 0,0,1, 0,0,nan 0,0,1,inf; do
        wrong shape:gear -o out.png --clip "$plane" -- '--clip'
    done
    for plane in 0,0,0 0,0,0,1 1e200,0,0; do
        wrong shape:gear -o out.png --clip $plane -- 'no direction'
    done
    local many=()
    for plane in 1 2 3 4 5 6 7 8; do many+=(--clip "0,$plane,1,9"); done
    run 0 shape:gear $small "${many[@]}" -o out.png
    rm out.png
    wrong shape:gear "${many[@]}" --clip 1,0,0 -o out.png -- 'one plane too many'
    for spacing in 0 -1 0% 101% x % ''; do
        wrong shape:gear -o out.png --clip 0,0,1 --section-spacing "$spacing" -- '--section-spacing'
    done
    wrong shape:gear -o out.png --clip 0,0,1 --section dotted -- 'none of hatched'
    wrong shape:gear -o out.png --clip 0,0,1 --section-angle x -- '--section-angle'
    wrong shape:gear -o out.png --clip 0,0,1 --smooth auto -- '--smooth'
    wrong shape:gear -o out.png --clip 0,0,1 --ink quads -- '--ink quads'
    run 0 shape:gear $small --section plain -o out.png
    says err '--section changes nothing'
    run 0 shape:gear $small --clip 0,0,1 --section plain --section-angle 30 -o out.png
    says err '--section-angle changes nothing'
    run 0 make gear -o gear.stl
    "$program" - $small --clip 0,0,1 --passes 1 --eye 3,2,3 --target 0,0,0 -o pipe.png 2>err < <(cat gear.stl) &&
        fail "the middle of a pipe"
    says err 'give --clip a fourth number'
    absent pipe.png
}
sections_that_take_all() {
    run 1 shape:gear --clip 0,0,1,-99 -o out.png
    one_line
    says err 'the clip planes leave nothing of the model'
    absent out.png
    no_temporary
    run 1 shape:gear --clip 0,0,1,-0.01 --clip 0,0,-1,-0.01 -o out.png
    says err 'the clip planes leave nothing of the model'
}
# What is left of a large model may fit; else lines of sections cannot be drawn.
sections_of_streams() {
    run 0 make sphere --triangles 1300000 -o t.stl
    run 0 t.stl $small -q --clip 0,0,1,-0.9 -o held.png
    run 0 t.stl $small -q --clip 0,0,1,-0.9 -o little.png --memory 48M
    cmp -s held.png little.png || fail "a small part of a large model differs"
    run 1 t.stl $small -q --clip 0,0,1,0.9 -o out.png --memory 48M
    one_line
    says err 'allow more memory'
    absent out.png
}
