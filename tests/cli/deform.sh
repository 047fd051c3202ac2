# Tests of models that are deformed and blended, for run.sh, which reads this file.
# shellcheck shell=bash disable=SC2034,SC2086,SC2154

deform_tests="deformed_models deformed_alike wrong_deformations deformed_scenes deformed_pipes blended_models wrong_blends
    deformed_figures deformed_info"

deformed_models() {
    run 0 shape:torus $small -o still.png
    for deform in wave breathe twist:speed=1; do
        run 0 shape:torus $small --deform $deform --time 1 -o ${deform%:*}.png
        silent out
        silent err
        cmp -s still.png ${deform%:*}.png && fail "$deform changes nothing"
    done
    run 0 shape:torus $small --deform breathe -o out.png
    says err '--deform changes nothing: at time 0 what breathes is at rest; add --time 1'
    cmp -s still.png out.png || fail "what breathes is not at rest at first"
    run 0 shape:torus $small --deform breathe --time 2 -q -o out.png
    cmp -s breathe.png out.png && fail "the time changes nothing"
    run 0 shape:torus $small --deform wave --time 1 -o out.svg
    says out.svg '<path'
}
# The same, said in other ways, and by any number of threads.
deformed_alike() {
    run 0 shape:flag:4000 $small --deform wave -o a.png
    for words in wave:amplitude=0.08 wave:length=0.6,speed=1 wave:axis=x wave:across=z; do
        run 0 shape:flag:4000 $small --deform $words -o b.png
        cmp -s a.png b.png || fail "$words is not what wave is"
    done
    for words in wave:amplitude=0.2 wave:length=0.3 wave:axis=-x wave:axis=y wave:across=-z wave:slant=0.5; do
        run 0 shape:flag:4000 $small --deform $words -o b.png
        cmp -s a.png b.png && fail "$words is wave"
    done
    run 0 shape:torus $small --deform twist:angle=90 --time 5 -o a.png
    run 0 shape:torus $small --deform twist -o b.png
    cmp -s a.png b.png || fail "a twist does not stand, or is not of 90 degrees"
    silent err
    run 0 shape:torus $small --deform twist --time 5 -o a.png
    says err '--time changes nothing: a twist stands still without a speed; add speed=1 to it, say'
    run 0 shape:torus $small --deform twist --frames 2 -o f-%d.png
    says err 'all frames are alike: a twist stands still without a speed'
    run 0 shape:torus $small --frames 2 -o f-%d.png
    says err 'all frames are alike: nothing moves; add --turn 360, say'
    run 0 shape:torus $small --deform twist --turn 90 --frames 2 -o f-%d.png
    silent err
    run 0 shape:terrain:100000 $small --deform wave --threads 1 -o a.png
    run 0 shape:terrain:100000 $small --deform wave --threads 3 -o b.png
    cmp -s a.png b.png || fail "threads matter"
    run 0 make torus -o torus.ply
    run 0 make torus -o torus.stl
    run 0 torus.ply $small --deform twist:speed=1 --time 0.1 -o a.png
    run 0 torus.stl $small --deform twist:speed=1 --time 0.1 --up y -o b.png
    cmp -s a.png b.png || fail "batches matter"
}
wrong_deformations() {
    wrong shape:cube --deform wav -o out.png -- '"wav" is none of wave|breathe|twist; did you mean wave?'
    wrong shape:cube --deform xyz -o out.png -- '"xyz" is none of wave|breathe|twist'
    wrong shape:cube --deform '' -o out.png -- 'is none of wave|breathe|twist'
    wrong shape:cube --deform wave:amplitud=1 -o out.png -- \
        '"amplitud" is none of amplitude|length|speed|axis|across|slant; did you mean amplitude?'
    wrong shape:cube --deform twist:amplitude=1 -o out.png -- 'none of angle|length|speed|axis'
    wrong shape:cube --deform wave:amplitude -o out.png -- 'amplitude has no value; write amplitude=0.1, say'
    wrong shape:cube --deform wave:axis -o out.png -- 'write axis=x, say'
    wrong shape:cube --deform wave:amplitude=much -o out.png -- 'amplitude=much is no number other than 0'
    wrong shape:cube --deform wave:amplitude=nan -o out.png -- 'amplitude=nan is no number'
    wrong shape:cube --deform wave:length=0 -o out.png -- 'length=0 is no number other than 0'
    wrong shape:cube --deform wave:axis=up -o out.png -- 'axis=up is none of x, y, z, -x, -y and -z'
    wrong shape:cube --deform wave:length=1,length=2 -o out.png -- 'length is there twice'
    wrong shape:cube --deform wave: -o out.png -- '"" is none of amplitude'
    wrong shape:cube --deform wave:amplitude=11 -o out.png -- 'wave: amplitude is 11; it must lie between -10 and 10'
    wrong shape:cube --deform breathe:at=1e9 --time 1 -o out.png -- 'breathe: at is 1e+09'
    run 1 shape:cube --deform wave --time 1e300 -o out.png
    one_line
    says err 'give a time within 1e+12 s of 0'
    wrong make cube --deform wave -o out.ply -- 'does not belong to'
    printf 'v 1 2 3\nv 1 2 3\nv 1 2 3\nf 1 2 3\n' >point.obj
    run 1 point.obj --deform wave -o out.png
    printf 'v 1 2 3\n' >empty.obj
    bad empty.obj 'points but no polygons'
    run 1 empty.obj --deform wave -o out.png
    one_line
    printf 'v nan 2 3\nv 1 2 3\nv 1 2 4\nf 1 2 3\n' >torn.obj
    run 1 torn.obj --deform twist -o out.png
    one_line
    absent out.png
}
# Parts of a scene move as one: the scene as one file is the same.
deformed_scenes() {
    printf 'v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nf 1 2 3 4\n' >a.obj
    printf 'v 2 0 0\nv 4 0 0\nv 4 1 0\nv 2 1 0\nf 1 2 3 4\n' >b.obj
    { cat a.obj b.obj | grep v; echo 'f 1 2 3 4'; echo 'f 5 6 7 8'; } >both.obj
    run 0 a.obj b.obj $small --deform wave:length=2,amplitude=0.3 -o out.png
    run 0 both.obj $small --deform wave:length=2,amplitude=0.3 -o whole.png
    cmp -s whole.png out.png || fail "parts of a scene are deformed one by one"
}
# What can be read only once is kept, as it must be measured.
deformed_pipes() {
    run 0 make gear -o gear.stl
    run 0 gear.stl $small --deform twist -o file.png
    "$program" - $small --deform twist -o pipe.png <gear.stl 2>err || fail "a pipe: $(cat err)"
    cmp -s file.png pipe.png || fail "a pipe is drawn otherwise"
    "$program" - $small --deform twist --passes 1 --eye 3,3,3 --target 0,0,0 -o pipe.png <gear.stl 2>err ||
        fail "a pipe that is read once: $(cat err)"
}
blended_models() {
    run 0 make cylinder --triangles 500 -o a.obj
    awk '/^v /{$2 *= 1 + $3 / 2} {print}' a.obj >b.obj
    awk '/^v /{$2 *= 1 + $3 / 4} {print}' a.obj >half.obj
    run 0 a.obj $small -o a.png
    run 0 b.obj $small -o b.png
    run 0 half.obj $small --detail exact -o half.svg --title half
    run 0 a.obj $small --morph b.obj --blend 0 -o out.png
    silent err
    cmp -s a.png out.png || fail "a blend of 0 is not the model"
    run 0 a.obj $small --morph b.obj --blend 1 -o out.png
    cmp -s b.png out.png || fail "a blend of 1 is not the other model"
    run 0 a.obj $small --morph b.obj -o out.png
    run 0 a.obj $small --morph b.obj --blend 0.5 -o other.png
    cmp -s out.png other.png || fail "it is not half way"
    run 0 a.obj $small --morph b.obj --time 0.5 -o out.png
    cmp -s out.png other.png || fail "within half a second it is not half way"
    run 0 a.obj $small --morph b.obj --time 7 -o out.png
    cmp -s b.png out.png || fail "it goes on"
    run 0 a.obj $small --morph b.obj --blend 2 --deform twist -o out.png
    run 0 shape:torus $small --morph shape:torus --blend 0.3 -o out.png
    run 0 shape:torus $small -o other.png
    cmp -s out.png other.png || fail "between a model and itself is another"
}
wrong_blends() {
    run 0 make cube -o a.obj
    run 0 make cube --triangles 48 -o b.obj
    sed '$d' a.obj >fewer.obj
    sed 's/^f 1 /f 2 /' a.obj >other.obj
    for other in b fewer other shape:cube:48 gone; do
        case $other in shape:*) name=$other ;; *) name=$other.obj ;; esac
        run 1 a.obj --morph $name -o out.png
        one_line
        says err "$name"
        absent out.png
    done
    run 1 a.obj --morph b.obj -o out.png
    says err 'a.obj and b.obj: two models can be blended only vertex by vertex: the first has 12 polygons, the second 48'
    run 1 a.obj --morph other.obj -o out.png
    says err 'the corners of polygon'
    wrong a.obj --morph b.obj --blend x -o out.png -- '--blend'
    wrong a.obj --morph b.obj --blend 1e9 -o out.png -- '--blend'
    wrong a.obj b.obj --morph a.obj -o out.png -- '--morph blends one model with another, but 2 are given'
    run 0 a.obj $small --blend 0.5 -o out.png
    says err '--blend changes nothing: there is nothing to blend with; add --morph MODEL'
}
deformed_figures() {
    run 0 bench shape:torus $small --deform breathe --frames 2
    silent err
    for key in frame_ms still_ms read_ms; do says out "\"$key\": "; done
    [ "$(wc -l <out)" = 1 ] || fail "not one line"
    ! command -v python3 >/dev/null || python3 -m json.tool <out >/dev/null || fail "no JSON"
    run 0 bench shape:torus $small --frames 2
    grep -q still_ms out && fail "a model that stands has no figures of motion"
    run 0 bench shape:torus $small --morph shape:torus --time 0:1 --frames 2
    says out '"still_ms": '
}
deformed_info() {
    run 0 info --json shape:cube --deform twist:angle=45,axis=y
    says out '"polygons": 12'
    cp out twisted
    run 0 info --json shape:cube
    cmp -s out twisted && fail "info does not know of --deform"
}
