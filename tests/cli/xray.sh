# Tests of x-rays, for run.sh, which reads this file: lines fade by level, in every kind of file; what goes with
# them and what does not.
# shellcheck shell=bash disable=SC2034

xray_tests="xrays opaque_xrays wrong_xrays xrays_in_vectors xrays_with_looks xrays_from_memory xrays_for_any_threads xrays_of_objects"

xrays() {
    run 0 shape:bracket $small -q --xray 0.5 -o out.png -o trace=out.txt --stats
    is_png out.png
    says err 'layers of an x-ray                          2'
    says err 'samples with more layers                  0'
    says out.txt 'level 0 width 1.1 color #000000ff'
    says out.txt 'level 1 width 0.65 color #808080ff'
    grep -q 'level [1-9].*color #000000ff' out.txt && fail "a line behind a surface has its own colour"
    run 0 shape:gear $small -q --xray 0.5 --xray-layers 1 -o out.png --stats
    says err 'layers of an x-ray                          1'
    grep -q 'samples with more layers  *[1-9]' err || fail "no layers are lost: $(grep layers err)"
    run 0 shape:gear $small -q --xray 0.5 --xray-layers 1 --stats=json -o out.png
    says out '"xray_layers": 1,'
}
opaque_xrays() {
    run 0 shape:gear $small -o opaque.png
    for opacity in 0 1; do
        run 0 shape:gear $small --xray $opacity -o out.png
        cmp -s opaque.png out.png || fail "--xray $opacity is not opaque"
    done
    run 0 shape:gear $small --xray 0.999 -o out.png
    cmp -s opaque.png out.png && fail "--xray 0.999 is opaque"
}
wrong_xrays() {
    wrong shape:gear -o out.png --xray 1.5 -- '--xray: 1.5 is out of range'
    wrong shape:gear -o out.png --xray -0.5 -- '--xray: -0.5 is out of range'
    wrong shape:gear -o out.png --xray half -- '--xray'
    wrong shape:gear -o out.png --xray 0.5 --xray-layers 9 -- '--xray-layers'
    wrong shape:gear -o out.png --xray 0.5 --ink quads -- 'leave out --ink quads'
    wrong shape:gear -o out.png --xray 0.5 --edges adjacency -- 'leave out --edges adjacency'
}
xrays_in_vectors() {
    local file
    run 0 shape:gear $small -q --xray 0.4 -o out.svg -o out.pdf -o out.eps -o out.dxf -o out.json -o out.png
    says out.svg '#666'
    says out.svg '#a3a3a3'
    says out.json '"color":"#666666ff"'
    run 0 shape:gear $small -q --xray 0.4 --style gooch --ground png -o ground.svg
    says ground.svg 'data:image/png'
    # as the surface that lies over them leaves them
    run 0 shape:bracket $small -q --xray 0.5 --surface '#ff0000' -o red.json
    says red.json '"color":"#800000ff"'
    run 0 shape:bracket $small -q --xray 0.5 --hidden dashed --hidden-color :1=blue -o dashed.json
    says dashed.json '"color":"#8080ffff"'
}
xrays_with_looks() {
    local style
    for style in flat paper lambert gooch toon hatch halftone pencil; do
        for samples in 1 16; do
            run 0 shape:boxes $small -q --xray 0.4 --style $style --samples $samples -o out.png
            is_png out.png
        done
    done
    for style in '--edges both' '--edges map' '--stroke charcoal' '--stroke dashes' '--hidden dotted' \
        '--mirror 0,1,0' '--smooth auto' '--detail exact' '--paper none' '--surface none' '--cull-back-faces'; do
        # shellcheck disable=SC2086
        run 0 shape:boxes $small -q --xray 0.4 $style -o out.png
        is_png out.png
    done
}
# Nothing is streamed: all lies in memory.
xrays_from_memory() {
    run 0 make terrain --triangles 40000 -o terrain.stl
    run 0 terrain.stl $small -q --xray 0.4 --memory 48M -o usual.png
    "$program" - $small -q --xray 0.4 --passes 1 -o piped.png <terrain.stl || fail "in a pipe"
    cmp -s usual.png piped.png || fail "a pipe is drawn in another way"
}
xrays_for_any_threads() {
    for style in flat toon; do
        for threads in 1 2 7; do
            run 0 shape:gear --size 320x240 --xray 0.3 --style $style --threads $threads -o $threads.png
            cmp -s 1.png $threads.png || fail "$threads threads differ from one"
        done
    done
}
# A see-through box around an opaque one, and one beside it that hides nothing.
xrays_of_objects() {
    local look
    awk 'function box(name, x, s) {
        print "o " name
        for (i = 0; i < 8; i++) print "v", x + s * (i % 2 - 0.5), s * (int(i / 2) % 2 - 0.5), s * (int(i / 4) - 0.5)
        print "f -8 -6 -5 -7\nf -4 -3 -1 -2\nf -8 -7 -3 -4\nf -6 -2 -1 -5\nf -8 -4 -2 -6\nf -7 -5 -1 -3" }
        BEGIN { box("house", 0, 2); box("core", 0, 1); box("beside", 3, 1) }' >boxes.obj
    run 0 boxes.obj $small -q -o plain.png
    run 0 boxes.obj $small -q --object house:xray=1 -o opaque.png
    cmp -s plain.png opaque.png || fail "xray=1 is not opaque"
    run 0 boxes.obj $small -q --object house:xray=0.4 -o out.png -o out.svg -o out.json -o trace=out.txt
    silent err
    # the core's lines fade by one layer, which its own surface does not let through
    says out.json '"color":"#666666ff"'
    grep -q 'level 2' out.txt && fail "a line shows behind an opaque surface and a see-through one"
    run 0 boxes.obj $small -q --xray 0.4 -o both.png -o trace=both.txt
    grep -q 'level 2' both.txt || fail "no line shows through two surfaces"
    run 0 boxes.obj $small -q --xray 0.4 --object core,beside:xray=1 -o other.png
    cmp -s out.png other.png || fail "an x-ray with opaque objects is another than one of the housing"
    for look in '--style gooch' '--style toon' '--style pencil' '--hidden dashed' '--xray-layers 2' '--edges both'; do
        for threads in 1 3; do
            run 0 boxes.obj $small $look --object house:xray=0.4 --threads $threads -o $threads.png
            silent err
        done
        cmp -s 1.png 3.png || fail "$look: threads change the picture"
        cmp -s 1.png plain.png && fail "$look: the picture is a plain one"
    done
    rm out.png
    wrong boxes.obj -o out.png --object house:xray=1.5 -- '--object house:xray: 1.5 is out of range'
    wrong boxes.obj -o out.png --object house:xray=0.5 --ink quads -- 'leave out --ink quads'
    wrong boxes.obj -o out.png --object house:xray=0.5 --edges adjacency -- 'leave out --edges adjacency'
    # cut faces of an object have a colour of its own
    run 0 boxes.obj $small --clip 0,0,1 --section plain --lines none --object core:section-color=#f00 -o cut.png
    run 0 boxes.obj $small --clip 0,0,1 --section plain --lines none -o bare.png
    cmp -s cut.png bare.png && fail "an object's cut faces have no colour of their own"
}
