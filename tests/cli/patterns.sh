# patterns.sh: patterns and light on lines; sourced by run.sh.
# shellcheck shell=bash
pattern_tests="patterns patterns_on_quads wrong_patterns patterns_that_fail light_on_lines pattern_effects"

patterns() {
    local small="--size 200x150 --width 8" name
    run 0 shape:bracket $small -o plain.png
    for name in dashes dots hatch rope waves checks chevrons lace meander; do
        run 0 shape:bracket $small --pattern $name -o $name.png
        silent err
        cmp -s plain.png $name.png && fail "--pattern $name changes nothing"
    done
    run 0 shape:bracket $small --pattern rope --threads 3 -o again.png
    cmp -s rope.png again.png || fail "another picture with three threads"
    for option in "--pattern-length 40" "--pattern-length 3mm" "--pattern-units 0.3" "--pattern-space screen" "--stroke-scale 2"; do
        run 0 shape:bracket $small --pattern rope $option -o other.png
        silent err
        cmp -s rope.png other.png && fail "$option changes nothing"
    done
    run 0 shape:bracket $small --pattern plain.png -o own.png # any PNG is a pattern
    is_png own.png
    # it takes the place of a preset's strokes
    run 0 shape:bracket $small --preset pencil --pattern rope -o sketch.png
    silent err
    run 0 shape:bracket $small --pattern rope -o rope.svg
    says err 'paths are plain'
}

patterns_on_quads() {
    local small="--size 200x150 --width 8 --ink quads" between method
    run 0 shape:cube --size 1x1 --lines none --surface black --paper black -o black.png
    for method in exact paper; do
        for between in plane interval stencil; do
            run 0 shape:bracket $small --method $method --between $between -o plain.png
            run 0 shape:bracket $small --method $method --between $between --pattern checks -o checks.png
            silent err
            cmp -s plain.png checks.png && fail "$method $between: --pattern changes nothing"
            run 0 shape:bracket $small --method $method --between $between --pattern checks --threads 3 -o again.png
            cmp -s checks.png again.png || fail "$method $between: another picture with three threads"
            # a pattern that is ink all over inks what plain lines do
            run 0 shape:bracket $small --method $method --between $between --pattern black.png -o black-lines.png
            cmp -s plain.png black-lines.png || fail "$method $between: a black pattern is not plain ink"
        done
    done
}

wrong_patterns() {
    wrong shape:cube -o out.png --pattern ropes -- '--pattern: "ropes" is neither a PNG file nor one of pencil, brush'
    wrong shape:cube -o out.png --pattern rope --stroke pencil -- '--pattern and --stroke both say'
    wrong shape:cube -o out.png --pattern rope --edges adjacency -- 'give --stroke rope instead of --pattern, or add --ink strokes'
    wrong shape:cube -o out.png --pattern rope --pattern-length 9 --pattern-units 2 -- 'leave one out'
    wrong shape:cube -o out.png --pattern rope --pattern-length 0 -- '--pattern-length: 0 is out of range'
    wrong shape:cube -o out.png --pattern rope --pattern-length -3 -- '--pattern-length'
    wrong shape:cube -o out.png --pattern rope --pattern-length nan -- 'is not a length'
    wrong shape:cube -o out.png --pattern rope --pattern-units 0 -- '--pattern-units'
    wrong shape:cube -o out.png --pattern rope --pattern-units inf -- '--pattern-units'
    wrong shape:cube -o out.png --pattern rope --pattern-space world -- '--pattern-space'
    wrong shape:cube -o out.png --line-light phong -- '--line-light'
    run 0 shape:cube --size 100x80 --pattern rope --edges adjacency --ink strokes -o adjacent.png
    silent err
}

patterns_that_fail() {
    run 1 shape:cube -o out.png --pattern missing.png
    one_line
    says err 'missing.png: cannot be opened'
    echo 'no picture' >text.png
    run 1 shape:cube -o out.png --pattern text.png
    one_line
    says err 'no PNG'
    run 0 shape:cube --size 9000x1 -o long.png
    run 1 shape:cube -o out.png --pattern long.png
    one_line
    says err 'give one of at most 8192 x 8192'
    absent out.png
    run 0 shape:cube --size 1x1 --lines none --surface black -o dot.png
    for ink in strokes quads; do
        run 0 shape:cube --size 100x80 --ink $ink --pattern dot.png -o drawn.png
        silent err
        # more repeats than there are pixels, by far
        run 0 shape:cube --size 100x80 --ink $ink --pattern rope --pattern-units 1e-30 -o drawn.png
        run 0 shape:cube --size 100x80 --ink $ink --pattern rope --pattern-units 1e29 -o drawn.png
        run 0 shape:cube --size 100x80 --ink $ink --pattern rope --eye 0,0,0 --target 1,1,0.3 -o drawn.png
    done
}

light_on_lines() {
    local small="--size 200x150 --width 6" light ink
    for ink in strokes quads; do
        run 0 shape:bracket $small --ink $ink -o plain.png
        for light in lambert toon gooch; do
            run 0 shape:bracket $small --ink $ink --line-light $light -o $light.png
            silent err
            cmp -s plain.png $light.png && fail "$ink: --line-light $light changes nothing"
            run 0 shape:bracket $small --ink $ink --line-light $light --light 120,-20 -o below.png
            silent err
            cmp -s below.png $light.png && fail "$ink: --light changes nothing"
        done
        run 0 shape:bracket $small --ink $ink --line-light lambert --lit-color orange -o orange.png
        silent err
        cmp -s lambert.png orange.png && fail "$ink: --lit-color changes nothing"
        run 0 shape:bracket $small --ink $ink --line-light off -o off.png
        cmp -s plain.png off.png || fail "$ink: --line-light off changes something"
    done
    # paths of vector files have the segments' colours
    run 0 shape:bracket $small --line-light lambert -o lit.svg
    [ "$(grep -o 'stroke="#[0-9a-f]*"' lit.svg | sort -u | wc -l)" -gt 3 ] || fail "all paths of lit.svg have one colour"
}

pattern_effects() {
    local small="--size 100x80"
    run 0 shape:cube $small --pattern-length 30 --pattern-space screen -o out.png
    says err 'warning: --pattern-length, --pattern-space change nothing: lines have no pattern'
    run 0 shape:cube $small --lit-color red -o out.png
    says err 'warning: --lit-color changes nothing: no light falls on lines'
    run 0 shape:cube $small --line-light gooch --lit-color red -o out.png
    says err 'warning: --lit-color changes nothing: --line-light gooch'
    run 0 shape:cube $small --edges map --pattern rope -o out.png
    says err 'warning: --pattern changes nothing: an edge map'
    run 0 shape:cube $small --pattern rope --pattern-units 1 --stroke-scale 2 -o out.png
    says err 'warning: --stroke-scale changes nothing'
    run 0 shape:cube $small --pattern rope --stroke-u polar -o out.png
    says err 'warning: --stroke-u changes nothing'
}
