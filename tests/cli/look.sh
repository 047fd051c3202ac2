# Tests of how lines look, for run.sh, which reads this file: weights, colours, presets, and options that
# change nothing.
# shellcheck shell=bash disable=SC2034

look_tests="weights weights_of_sizes weights_on_paper shares_of_the_picture wrong_shares
    colors_by_name colors_with_alpha wrong_colors options_without_effect options_with_effect presets_change_nothing_unasked
    angles_that_overlap detail wrong_details detail_and_outputs lengths_of_strokes gaps_and_paths presets_of_sizes technical"

# weights_of TRACE: the classes of a trace with their widths, in order: "border 3 silhouette 3 ...".
weights_of() {
    awk '$1 == "layer" { class = $2 } $1 == "stroke" { for (i = 3; i < NF; i++) if ($i == "width") print class, $(i + 1) }' "$1" |
        sort -u | tr '\n' ' '
}
# weighs TEXT ARGUMENTS...: shape:bracket's lines have these widths.
weighs() {
    local wanted=$1
    shift
    run 0 shape:bracket -q "$@" -o trace=weights.txt
    [ "$(weights_of weights.txt)" = "$wanted " ] || fail "widths with $*: $(weights_of weights.txt)"
    rm weights.txt
}

# Outlines are twice as wide as creases; --width is for all classes, or for those it names.
weights() {
    weighs "ridge 1.5 silhouette 3" --lines silhouette,ridge
    weighs "ridge 4 silhouette 4" --lines silhouette,ridge --width 4
    weighs "ridge 1.5 silhouette 5" --lines silhouette,ridge --width silhouette=5
    weighs "ridge 1 silhouette 3" --lines silhouette,ridge --width ridge=1
    run 0 shape:boxes -q -o trace=boxes.txt
    [ "$(weights_of boxes.txt)" = "intersection 1.5 ridge 1.5 silhouette 3 " ] ||
        fail "boxes: $(weights_of boxes.txt)"
    run 0 shape:terrain -q -o trace=terrain.txt --lines border,valley --detail exact
    [ "$(weights_of terrain.txt)" = "border 3 valley 1.5 " ] || fail "terrain: $(weights_of terrain.txt)"
    # hidden lines are narrow, all alike, so that their dashes are
    run 0 shape:bracket -q --hidden dashed -o trace=dashed.txt
    grep -v "level 0" dashed.txt | weights_of /dev/stdin >hidden.txt
    says hidden.txt "silhouette 1.5"
    grep -q "[23]$" hidden.txt && fail "hidden lines: $(cat hidden.txt)"
    run 0 shape:bracket -q --hidden thin -o trace=thin.txt
    grep -v "level 0" thin.txt | weights_of /dev/stdin >hidden.txt
    says hidden.txt "silhouette 0.75"
}
# By the smaller side of the picture, but neither too thin to be seen nor wider than can be.
weights_of_sizes() {
    weighs "ridge 0.65 silhouette 1.1" --lines silhouette,ridge --size 80x60
    weighs "ridge 0.75 silhouette 1.5" --lines silhouette,ridge --size 800x600
    weighs "ridge 0.75 silhouette 1.5" --lines silhouette,ridge --size 600x900
    # small in large pictures, whose paper is cheap
    weighs "ridge 5 silhouette 10" --lines silhouette,ridge --size 4000x4000 --zoom 0.05 --detail exact
    weighs "ridge 40 silhouette 64" --lines silhouette,ridge --size 32000x32000 --zoom 0.02 --detail exact
}
weights_on_paper() {
    weighs "ridge 2.5 silhouette 5" --lines silhouette,ridge --page A4 --dpi 254
    weighs "ridge 2.5 silhouette 5" --lines silhouette,ridge --scale 1:1 --dpi 254
    run 0 shape:bracket -q --sheet front,top --dpi 254 -o usual.svg
    run 0 shape:bracket -q --sheet front,top --dpi 254 -o same.svg --width 0.5mm
    cmp -s usual.svg same.svg || fail "the usual width on a sheet is not 0.5 mm"
}
shares_of_the_picture() {
    weighs "ridge 6 silhouette 3" --lines silhouette,ridge --size 1600x1200 --width 0.25%,ridge=0.5%
    weighs "ridge 1.5 silhouette 1.5" --lines silhouette,ridge --size 300x900 --width 0.5%
    run 0 shape:bracket -q --page A4-landscape --dpi 254 -o share.svg --width 0.5%
    run 0 shape:bracket -q --page A4-landscape --dpi 254 -o mm.svg --width 1.05mm
    cmp -s share.svg mm.svg || fail "0.5 % of A4 are not 1.05 mm"
    run 0 shape:cube -q --view front --ortho 0 --scale 50:1 --margin 0 --dpi 254 --width 1% -o trace=wrapped.txt
    grep -q 'width 10\.11 ' wrapped.txt || fail "1 % of a page made for the drawing: $(weights_of wrapped.txt)"
    run 0 shape:bracket -q --size 400x400 --hidden dashed --hidden-width 0.5% -o trace=hidden.txt
    says hidden.txt "level 1 width 2 "
    run 0 shape:bracket -q --size 400x400 --min-length 5% -o share.svg
    run 0 shape:bracket -q --size 400x400 --min-length 20 -o px.svg
    cmp -s share.svg px.svg || fail "5 % of 400 pixels are not 20"
}
wrong_shares() {
    wrong shape:cube -o out.png --width 0% -- 'give above 0% and at most 100%'
    wrong shape:cube -o out.png --width % -- 'is not a width'
    run 0 shape:cube -o thick.png --width 20%
    says err 'lines are at most 64 pixels wide, 5.3% of 1200'
    one_line
    wrong shape:cube -o out.svg --tolerance 101% -- 'give 0% to 100%'
}

# same TEXT FIRST... -- SECOND...: the same picture of a cube twice.
same() {
    local text=$1 first=()
    shift
    while [ "$1" != -- ]; do first+=("$1"); shift; done
    shift
    run 0 shape:cube $small "${first[@]}" -o first.png
    run 0 shape:cube $small "$@" -o second.png
    cmp -s first.png second.png || fail "$text"
}
colors_by_name() {
    same "red is not #f00" --color red -- --color '#f00'
    same "names are of small letters" --color SteelBlue -- --color '#4682B4'
    same "gray is not grey" --surface gray -- --surface grey
    same "rebeccapurple" --paper rebeccapurple -- --paper '#663399ff'
    same "the last name" --color yellowgreen -- --color '#9ACD32'
    same "of classes" --color 'black,ridge=tomato' -- --color '#000,ridge=#ff6347'
    same "of hidden lines" --hidden thin --hidden-color ':1=navy' -- --hidden thin --hidden-color '#000080'
    same "transparent is not none" --paper transparent --surface none -- --paper none --surface '#0000'
    same "of strokes" --style hatch --hatch-color navy -- --style hatch --hatch-color '#000080'
}
colors_with_alpha() {
    run 0 shape:cube $small --color '#ff000080' -o trace=alpha.txt -o alpha.svg -o alpha.json
    says alpha.txt 'color #ff000080'
    says alpha.svg 'stroke-opacity="0.502"'
    says alpha.json '"color":"#ff000080"'
    silent out
    same "short alpha" --color '#f008' -- --color '#ff000088'
    same "half black on white is not grey" --color '#00000080' --lines ridge -- --color '#7f7f7f' --lines ridge
    same "a surface is not mixed with the paper" --surface '#0000ff80' --paper red -- --surface '#7f0080' --paper red
    same "hatching" --style hatch --hatch-color '#00000080' -- --style hatch --hatch-color '#7f7f7f'
    same "pencil" --style pencil --hatch-color '#00000080' -- --style pencil --hatch-color '#7f7f7f'
    same "a mirror's tint" --mirror 0,1,0 --mirror-tint '#ff000080' --mirror-tint-share 1 -- \
        --mirror 0,1,0 --mirror-tint red --mirror-tint-share 0.50196078431372548
    same "lines that are not seen" --color 'red,ridge=transparent' -- --color red --lines silhouette,valley,intersection,border
    run 0 shape:cube $small --color '#ff000080' -o alpha.eps
    says err 'EPS has no transparency: colours with alpha are mixed with the paper'
    run 0 shape:cube $small --color none -o none.svg
    says err 'no line is in it'
}
wrong_colors() {
    wrong shape:cube -o out.png --color stelblue -- '--color: "stelblue" is not a colour; did you mean steelblue?'
    wrong shape:cube -o out.png --color ridge=blakc -- 'did you mean black?'
    wrong shape:cube -o out.png --color xyzzy -- 'give one like #3060A0, #3060A080 with its alpha, or a name like steelblue'
    local value
    for value in '#12' '#12345' '#1234567' '#123456789' '#ggg' '' '#'; do
        wrong shape:cube -o out.png --color "$value" -- 'is not a colour; give one like #3060A0'
        wrong shape:cube -o out.png --paper "$value" -- 'is not a colour; give one like #3060A0'
    done
}

# Each line: OPTION [VALUE] | other options beside which it changes nothing | other options beside which it
# does | what is said.
effects() {
    cat <<'END'
--method paper || --ink quads | add --ink quads
--between stencil || --ink quads | add --ink quads
--between stencil | --edges adjacency | --ink quads | add --ink quads
--edge-table off | --ink quads || only emergent strokes have that table
--width 5 | --edges map | --edges both | --edges both adds them
--color red | --lines none || leave out --lines none
--detail 0.05 | --ink quads | --ink strokes | with --ink quads the added polygons are the lines
--detail 2 | --edges none | --edges both | --edges both adds them
--detail 2 | --lines none || leave out --lines none
--ridge-angle 80 | --lines silhouette || add them to --lines
--valley-angle 300 | --lines ridge || add them to --lines
--levels 3 | --hidden none | --hidden dashed --hidden-color :2=red | add --hidden dashed
--hidden-width 4 || --hidden dashed | add --hidden dashed
--hidden-color red || --hidden dashed | add --hidden dashed
--hidden-smooth ||| add --hidden dashed
--xray-layers 1 || --xray 0.5 | add --xray 0.5
--tolerance 2 ||| add -o drawing.svg
--join 20 ||| add -o drawing.svg
--min-length 20 ||| add -o drawing.svg
--optimize ||| add -o drawing.svg
--join-classes ||| add -o drawing.svg
--keep-coincident ||| add -o drawing.svg
--ground png ||| add -o drawing.svg
--title Bracket ||| a picture has no title
--jitter 3 | --ink quads | --ink strokes | with --ink quads lines are plain
--taper 20 | --edges none || --edges both draws lines
--stroke-u polar || --stroke pencil | add --stroke pencil
--stroke-scale 3 || --stroke pencil | add --stroke pencil
--stroke-k 3 | --stroke pencil | --stroke pencil --stroke-u polar | add --stroke-u polar
--seed 4 || --stroke pencil | add --stroke pencil or --jitter 1
--seed 4 | --stroke dashes | --jitter 2 | add --stroke pencil or --jitter 1
--light 60,10 || --style lambert | add --style lambert
--light 60,10 | --width-by-light 1 | --style toon | add --style lambert
--normals facet || --style lambert | add --style lambert
--crease-angle 5 || --style lambert | add --style lambert
--surface tan | --style paper | --style toon | surfaces have the paper's colour
--surface tan | --style gooch --gooch-plain | --style gooch | --gooch-plain leaves
--highlight 1 || --style lambert --light 0,0 --surface gray --view front | only --style lambert, gooch and toon
--highlight 1 | --style hatch || only --style lambert, gooch and toon
--gooch-plain || --style gooch | add --style gooch
--cartoon-map off || --style toon | add --style toon
--hatch-scale 3 || --style halftone | add --style hatch, halftone or pencil
--hatch-color red | --style toon | --style pencil | add --style hatch, halftone or pencil
--hatch-space object | --style pencil | --style hatch | add --style hatch or halftone
--pencil-s 6 || --style pencil | add --style pencil
--pencil-o 2 | --style hatch | --style pencil | add --style pencil
--pencil-tones 4 || --style pencil | add --style pencil
--pencil-turns printed || --style pencil | add --style pencil
--pencil-s 6 | --style pencil --pencil-tones 4 || --pencil-tones stands for it
--mirror-tint red || --mirror 0,1,0 | add --mirror 0,1,0
--mirror-tint red | --mirror 0,1,0 --mirror-tint-share 0 || --mirror-tint-share is 0
--mirror-size 1 || --mirror 0,1,0 | add --mirror 0,1,0
--mirror-fade 0.1 || --mirror 0,1,0 | add --mirror 0,1,0
--mirror-tint-share 1 || --mirror 0,1,0 --mirror-tint red | add --mirror 0,1,0
--edge-map c1 | --edges emergent | --edges both | add --edges both
--c1-passes 1 | --edges both | --edges both --edge-map c1 | add --edge-map c1
--edge-measure paper || --edges both | add --edges both
--precision 8 || --edges both --edge-measure paper | add --edges both
--edge-radius 4 || --edges both | add --edges both
--edge-sides both || --edges both | add --edges both
--inner-angle 80 || --edges both | add --edges both
--inner-angle 80 | --edges both --edge-measure paper || has no thresholds
--profile-depth 400 || --edges both | add --edges both
--inner-color red || --edges both | add --edges both
--profile-color red || --edge-map diagonal | add --edges both
END
}
# trim TEXT: without the spaces around it.
trim() { sed 's/^ *//; s/ *$//' <<<"$1"; }
# picture NAME ARGUMENTS...: a bracket.
bracket() {
    local name=$1
    shift
    run 0 shape:bracket --size 240x180 "$@" -o "$name"
}
# An option that is said to change nothing changes nothing, and says so in one line.
options_without_effect() {
    local option beside works text
    while IFS='|' read -r option beside works text; do
        # shellcheck disable=SC2086 # words
        {
            bracket base.png $beside
            bracket other.png $beside $option
        }
        one_line
        says err "drypoint: warning: ${option%% *} changes nothing: "
        says err "$(trim "$text")"
        cmp -s base.png other.png || fail "$option changes the picture beside \"$beside\""
        # shellcheck disable=SC2086
        bracket other.png $beside $option --quiet
        silent err
    done < <(effects)
    bracket two.png --mirror-tint red --mirror-fade 0.1
    says err '--mirror-fade, --mirror-tint change nothing: there is no mirror'
    one_line
    run 0 shape:boxes $small --lines border,intersection -o base.png
    run 0 shape:boxes $small --lines border,intersection --detail 0.01 -o other.png
    says err '--detail changes nothing: borders and intersections are all drawn; add others to --lines'
    one_line
    cmp -s base.png other.png || fail "--detail leaves out intersections"
    run 0 shape:boxes $small --lines silhouette,intersection --detail 0.5 -o other.png
    silent err
    run 0 shape:cube $small --title Cube -o titled.svg
    grep -q 'changes nothing' err && fail "an SVG has a title: $(cat err)"
    run 0 make cube --seed 3 -o cube.ply
    says err '--seed changes nothing: only terrains differ by their seed'
    run 0 make terrain --seed 3 -o terrain.ply
    silent err
}
# Where it counts nothing is said, and the picture is another.
options_with_effect() {
    local option beside works text
    while IFS='|' read -r option beside works text; do
        [ -n "$(trim "$works")" ] || continue
        # shellcheck disable=SC2086
        {
            bracket base.png $works
            bracket other.png $works $option
        }
        silent err
        cmp -s base.png other.png && fail "$option changes nothing beside \"$works\""
    done < <(effects)
}
presets_change_nothing_unasked() {
    run 0 shape:cube $small --preset pencil --ink quads -o quads.png
    silent err
    run 0 shape:cube $small --preset pencil --ink quads --taper 3 -o quads.png
    says err '--taper changes nothing'
    run 0 bench shape:cube $small --frames 1 --preset sketch --pencil-s 2
    says err '--pencil-s changes nothing'
}
angles_that_overlap() {
    bracket both.png --ridge-angle 220
    says err '--ridge-angle 220 is above --valley-angle 210: edges between the two are drawn as ridges'
    bracket both.png --valley-angle 120
    says err '--ridge-angle 150 is above --valley-angle 120'
    bracket one.png --ridge-angle 220 --lines silhouette,ridge
    silent err
}
lengths_of_strokes() {
    run 0 shape:cube -q --size 400x400 --taper 5% --jitter 0.5% --overshoot 2% -o share.png
    run 0 shape:cube -q --size 400x400 --taper 20 --jitter 2 --overshoot 8 -o px.png
    cmp -s share.png px.png || fail "5 % of 400 pixels are not 20"
    run 0 shape:cube -q --page A5 --dpi 254 --taper 2mm -o mm.png
    run 0 shape:cube -q --page A5 --dpi 254 --taper 20 -o px.png
    cmp -s mm.png px.png || fail "2 mm are not 20 pixels at 254 dpi"
    run 0 shape:cube $small --stroke pencil -o usual.png
    run 0 shape:cube $small --stroke pencil --taper 0 -o none.png
    cmp -s usual.png none.png && fail "--taper 0 leaves the pencil's taper"
    wrong shape:cube -o out.png --taper 1km -- 'is not a length; give pixels like 2.5, or 0.5mm or 1pt, or 0.2%'
}

# segments_of ARGUMENTS...: of a terrain's drawing.
segments_of() {
    run 0 shape:terrain:5000 --size 240x180 "$@" -q -o trace=segments.txt
    sed -n 's/^end .* strokes \([0-9]*\) segments$/\1/p' segments.txt
}
# What is drawn of a rough model: everything, what a person would draw, finer, coarser.
detail() {
    local value before=0 count
    for value in 0.2 0.5 1 3; do
        count=$(segments_of --detail $value)
        [ "$count" -gt "$before" ] || fail "--detail $value: $count segments, not more than $before"
        before=$count
    done
    [ "$(segments_of --detail exact)" -ge "$before" ] || fail "--detail exact has less than 3"
    segments_of --detail exact --lines border >all.txt
    segments_of --detail 0.01 --lines border >few.txt
    cmp -s all.txt few.txt || fail "borders are left out"
    for value in '' '--detail=1' '--detail 1.0'; do
        # shellcheck disable=SC2086
        segments_of $value >count.txt
        mv segments.txt "other$value.txt"
        segments_of --detail auto >count.txt
        cmp -s segments.txt "other$value.txt" || fail "the default is not auto, or \"$value\" is not"
    done
    run 0 shape:bracket $small --detail auto -o auto.png
    run 0 shape:bracket $small -o usual.png
    cmp -s auto.png usual.png || fail "auto is not the default of pictures"
    run 0 bench shape:terrain:5000 $small --detail 0.5 --frames 1
    silent err
    for preset in technical pencil patent; do
        run 0 shape:terrain:2000 $small --preset $preset -q -o few.png
        run 0 shape:terrain:2000 $small --preset $preset --detail exact -q -o all.png
        cmp -s few.png all.png && fail "--detail changes nothing beside --preset $preset"
    done
}
wrong_details() {
    local value
    for value in fine Exact 'auto ' nan inf; do
        wrong shape:cube -o out.png --detail "$value" -- "--detail: \"$value\" is neither exact nor auto nor a number like 0.5"
    done
    for value in 0 -1 0.001 1000 100.5; do
        wrong shape:cube -o out.png --detail=$value -- "--detail: $value is out of range; give a number between 0.01 and 100"
    done
    for value in 2x 1e ''; do wrong shape:cube -o out.png --detail "$value" -- '--detail: '; done
    wrong shape:cube -o out.png --detail -- '--detail'
    wrong make cube -o out.ply --detail 1 -- '--detail'
}
# Every kind of output, the same for any number of threads; streamed, in a pipe.
detail_and_outputs() {
    local kind threads
    run 0 make terrain --triangles 5000 -o t.stl
    for threads in 1 2 7; do
        for kind in png svg pdf eps dxf json; do
            run 0 t.stl --size 320x240 --hidden dashed -q --threads $threads -o $threads.$kind
            cmp -s 1.$kind $threads.$kind || fail "$kind: $threads threads differ from one"
        done
    done
    run 0 t.stl --size 320x240 --hidden dashed -q --detail exact -o all.svg
    [ "$(stat -c %s 1.svg)" -lt "$(stat -c %s all.svg)" ] || fail "an SVG has all lines"
    "$program" - --size 320x240 --hidden dashed -q -o trace=piped.txt <t.stl || fail "in a pipe"
    run 0 t.stl --size 320x240 --hidden dashed -q -o trace=file.txt
    cmp -s file.txt piped.txt || fail "a pipe's drawing is another"
    run 0 t.stl --sheet front,iso --dpi 60 -q -o sheet.svg
    run 0 t.stl --sheet front,iso --dpi 60 -q --detail exact -o all.svg
    cmp -s sheet.svg all.svg && fail "a sheet has all lines"
}

# Textures with gaps are chained only when paths are asked for, after the picture.
gaps_and_paths() {
    run 0 shape:bracket -q --size 240x180 --stroke dashes -o dashes.svg -o trace=dashes.txt
    run 0 shape:bracket -q --size 240x180 --stroke dashes -o dashes.png -o with.svg
    cmp -s dashes.svg with.svg || fail "the paths differ beside a picture"
    run 0 shape:bracket -q --size 240x180 --edges adjacency --ink strokes --stroke dots -o dots.svg
    run 0 shape:bracket -q --size 240x180 --edges adjacency --stroke dots -o dots.svg
}

# Presets keep their look at all sizes, and go with pages, scales and sheets.
presets_of_sizes() {
    local preset
    for preset in technical illustration cartoon engraving blueprint sketch pencil patent; do
        run 0 shape:bolt -q --preset $preset --size 32x32 -o small.png
        run 0 shape:bolt -q --preset $preset --scale 10:1 --dpi 40 -o scaled.png -o scaled.svg
        run 0 shape:bolt -q --preset $preset --page A5 --dpi 40 -o page.png -o page.pdf
        run 0 shape:bolt -q --preset $preset --sheet front,iso --dpi 40 -o sheet.png -o sheet.dxf
    done
    weighs "silhouette 6" --lines silhouette --preset cartoon --size 1000x1000
    weighs "silhouette 30" --lines silhouette --preset cartoon --size 5000x5000 --zoom 0.05
}
# Black lines of three weights, dashed where they are hidden; the Gooch shading that it once had is illustration.
technical() {
    run 0 shape:bracket --size 1000x1000 --preset technical -o trace=technical.txt -o technical.svg
    silent out
    [ "$(grep -v "level [1-9]" technical.txt | weights_of /dev/stdin)" = "ridge 1.5 silhouette 3 valley 1.5 " ] ||
        fail "widths: $(weights_of technical.txt)"
    says technical.txt "level 1 width 0.9 color #000000ff"
    says technical.svg stroke-dasharray
    run 0 shape:bracket --size 160x160 --preset illustration -o one.png
    run 0 shape:bracket --size 160x160 --preset technical -o other.png
    silent err
    cmp -s one.png other.png && fail "technical is illustration"
}
