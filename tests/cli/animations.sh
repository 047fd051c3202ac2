# Tests of animations in files, for run.sh, which reads this file: which one plays, what is said where there is none,
# and whether every animated model of Debian's assimp-testmodels moves.
# shellcheck shell=bash disable=SC2034,SC2086,SC2154

animations_tests="animations_play animations_in_films animations_by_name no_animation animations_of_several animations_informed
    test_models_move"

# sliding [NAME [Y]]: an X file of a square that slides from x = 0 to 10 in 2 s; animations "Slide" and, back, "Return".
sliding() {
    cat >"${1:-sliding.x}" <<END
xof 0303txt 0032
AnimTicksPerSecond { 10; }
Frame square {
 FrameTransformMatrix { 1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0,0.0,0.0,0.0,0.0,1.0;; }
 Mesh face { 4; 0.0;0.0;0.0;, 1.0;0.0;0.0;, 1.0;${2:-1}.0;0.0;, 0.0;${2:-1}.0;0.0;; 1; 4;0,1,2,3;; }
}
AnimationSet Slide {
 Animation { {square} AnimationKey { 2; 2; 0;3;0.0,0.0,0.0;;, 20;3;10.0,0.0,0.0;;; } }
}
AnimationSet Return {
 Animation { {square} AnimationKey { 2; 2; 0;3;10.0,0.0,0.0;;, 10;3;0.0,0.0,0.0;;; } }
}
END
}

# left_is X ARGS...: the model's bounds begin at x = X.
left_is() {
    local wanted=$1
    shift
    run 0 info --json "$@"
    local left
    left=$(sed 's/.*"min": \[\([^,]*\),.*/\1/' out)
    [ "$left" = "$wanted" ] || fail "info $*: x from $left, not $wanted"
}

animations_play() {
    sliding
    left_is 0 sliding.x
    left_is 0 sliding.x --time 0
    left_is 5 sliding.x --time 1
    left_is 5 sliding.x --time 1 --animation Slide
    left_is 10 sliding.x --animation Return
    left_is 10 sliding.x --animation 2 --time -7 # holds its ends
    left_is 10 sliding.x --time 99
    left_is 0 sliding.x --time 1 --animation none
    local view='--eye 5,0,30 --target 5,0,0 --size 160x120 -q'
    run 0 sliding.x $view -o rest.png
    run 0 sliding.x $view --time 1 -o later.png
    run 0 sliding.x $view --time 1 --animation none -o none.png
    cmp -s rest.png later.png && fail "it does not move"
    cmp -s rest.png none.png || fail "--animation none moves"
    run 0 bench sliding.x $small --frames 2 --time 1
    for threads in 1 2 7; do
        run 0 sliding.x $view --time 1 --threads $threads -o $threads.png
        cmp -s later.png $threads.png || fail "$threads threads differ"
    done
}
# A film plays the first animation as long as it lasts; what else moves takes --time without a warning.
animations_in_films() {
    sliding
    run 0 sliding.x $small -q --fps 2 -o 'frame-%d.png'
    [ "$(ls frame-*.png | wc -l)" = 4 ] || fail "not 4 frames: $(ls)"
    run 0 sliding.x $small -q --fps 2 --animation Return -o 'back-%d.png'
    [ "$(ls back-*.png | wc -l)" = 2 ] || fail "not 2 frames: $(ls)"
    run 2 sliding.x $small --fps 2 --animation none -o 'none-%d.png'
    says err 'how long is the film?'
    run 0 shape:gear $small --deform wave --time 1 -o out.png
    silent err
}
animations_by_name() {
    sliding
    run 1 sliding.x --animation Slyde -o out.png
    one_line
    says err 'sliding.x: --animation Slyde: there is no such animation; did you mean "Slide"?'
    run 1 sliding.x --animation other -o out.png
    says err 'there is no such animation; "drypoint info" lists them'
    run 1 sliding.x --animation 3 -o out.png
    says err '--animation 3: there are only 2; "drypoint info" lists them'
    run 1 sliding.x --animation 0 -o out.png
    run 1 sliding.x --animation '' -o out.png
    absent out.png
    sed 's/AnimationSet Slide/AnimationSet A2/; s/AnimationSet Return/AnimationSet A1/' sliding.x >numbers.x
    left_is 0 numbers.x --animation A2
    left_is 10 numbers.x --animation A1
}
no_animation() {
    run 0 make cube -o cube.obj
    run 1 cube.obj --animation Walk -o out.png
    one_line
    says err 'cube.obj: --animation Walk: there is no animation in it'
    absent out.png
    run 0 cube.obj $small --time 2 -o out.png
    one_line
    says err 'warning: --time changes nothing: there is no animation in it'
    run 0 cube.obj $small --time 2 -q -o quiet.png
    silent err
    run 0 cube.obj $small -o rest.png
    cmp -s rest.png out.png || fail "a cube moves"
    run 0 cube.obj $small --animation none -o none.png
    silent err
    rm out.png
    wrong make cube --animation 1 -o x.ply -- 'does not belong to'
}
# Each of several models plays its own animation of that name or number; others stand still.
animations_of_several() {
    sliding
    sliding other.x 4
    sed -i 's/Slide/Jump/' other.x
    run 0 make cube -o cube.obj
    local view='--eye 5,0,30 --target 5,0,0 --size 160x120'
    run 0 cube.obj sliding.x other.x $view -o rest.png
    run 0 cube.obj sliding.x other.x $view --time 1 -o both.png
    run 0 cube.obj sliding.x other.x $view --time 1 --animation Slide -o one.png
    silent err
    cmp -s both.png rest.png && fail "--time: nothing moves"
    cmp -s one.png both.png && fail "the other one slides, too"
    run 1 cube.obj sliding.x other.x $view --animation Walk -o out.png
    says err 'cube.obj and 2 more: --animation Walk: there is no such animation'
    absent out.png
}
animations_informed() {
    sliding
    run 0 info sliding.x
    grep -q '^animations  *2$' out || fail "no number of animations: $(cat out)"
    grep -q '^  1  *2 s  Slide$' out || fail "no first animation: $(cat out)"
    grep -q '^  2  *1 s  Return$' out || fail "no second animation: $(cat out)"
    run 0 info --json sliding.x
    says out '"skins": 0, "morph_targets": 0, "animations": [{"name": "Slide", "seconds": 2}, {"name": "Return", "seconds": 1}]}'
    run 0 info --json shape:cube
    says out '"animations": []}'
    run 0 info shape:cube
    grep -q animations out && fail "a cube has animations: $(cat out)"
}

# stands_still NAME: is one of the animated models whose first animation does not show? A camera's, a single pose, keys
# that are all alike, or keys that Assimp's reader of old LightWave files misplaces.
stands_still() {
    case $1 in
    */chrome_sphere.mdl) return 1 ;;
    3DS/CameraRollAnim.3ds | */TargetCameraAnim.* | ASE/CameraRollAnim.ase | SMD/* | MDL/* | */move_x_oldformat_56.lws) ;;
    *) return 1 ;;
    esac
}
# Every model that says it has animations moves, in two pictures or in its bounds.
test_models_move() {
    local models=/usr/share/assimp/models folders='3DS ASE BVH CSM Collada FBX LWS MDL SMD X' count=0 seen=0 file name end time
    local least=40
    [ -z "${SANITIZED:-}" ] || least=5
    if [ ! -d $models ]; then
        echo "# skipped: no $models (install assimp-testmodels)"
        return
    fi
    while IFS= read -r file; do
        name=${file#"$models"/}
        seen=$((seen + 1)) # sanitizers look at every fourth
        [ -z "${SANITIZED:-}" ] || [ $((seen % 4)) = 0 ] || continue
        "$program" info --json -q "$file" >out 2>err </dev/null || continue
        grep -q '"seconds"' out || continue
        count=$((count + 1))
        end=$(sed 's/.*"animations": \[{[^}]*"seconds": \([0-9.e+-]*\)}.*/\1/' out)
        for share in 0 0.4; do
            time=$(awk "BEGIN { print $share * $end }")
            run 0 info --json -q "$file" --time "$time"
            mv out "bounds$share"
            run 0 "$file" -q --size 100x80 --time "$time" -o "at$share.png"
        done
        if ! cmp -s bounds0 bounds0.4 || ! cmp -s at0.png at0.4.png; then
            stands_still "$name" && fail "$name moves"
        else
            stands_still "$name" || fail "$name stands still"
        fi
    done < <(cd $models && find $folders -type f | sort | sed "s|^|$models/|")
    [ "$count" -ge "$least" ] || fail "only $count animated models"
}
