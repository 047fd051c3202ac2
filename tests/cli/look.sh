# Tests of how lines look, for run.sh, which reads this file: weights, colours, presets, and options that
# change nothing.
# shellcheck shell=bash disable=SC2034

look_tests="weights weights_of_sizes weights_on_paper shares_of_the_picture wrong_shares
    colors_by_name colors_with_alpha wrong_colors"

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
    run 0 shape:terrain -q -o trace=terrain.txt --lines border,valley
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
    weighs "ridge 5 silhouette 10" --lines silhouette,ridge --size 4000x4000
    weighs "ridge 40 silhouette 64" --lines silhouette,ridge --size 32000x32000
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
    run 0 shape:bracket -q --size 400x400 --hidden dashed --hidden-width 0.5% -o trace=hidden.txt
    says hidden.txt "level 1 width 2 "
    run 0 shape:bracket -q --size 400x400 --min-length 5% -o share.svg
    run 0 shape:bracket -q --size 400x400 --min-length 20 -o px.svg
    cmp -s share.svg px.svg || fail "5 % of 400 pixels are not 20"
}
wrong_shares() {
    wrong shape:cube -o out.png --width 0% -- 'give above 0% and at most 100%'
    wrong shape:cube -o out.png --width % -- 'is not a width'
    wrong shape:cube -o out.png --width 20% -- '20% of 1200 pixels are 240, and 64 are the most'
    wrong shape:cube -o out.svg --scale 1:1 --width 1% -- 'has nothing to be a share of'
    wrong shape:cube -o out.svg --tolerance 101% -- 'give 0% to 100%'
    run 0 shape:cube -o in.svg --scale 1:1 --page A4 --width 1%
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
