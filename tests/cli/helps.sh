# Tests of what helps at the keyboard, for run.sh, which reads this file: --help and its topics, completions.
# shellcheck shell=bash disable=SC2034,SC2086,SC2154

helps_tests="first_screen topics topic_examples wrong_topics versions bash_completion zsh_completion fish_completion"

first_screen() {
    run 0 --help
    silent err
    [ "$(wc -l <out)" -le 24 ] || fail "$(wc -l <out) lines"
    [ "$(awk 'length > 80' out | wc -l)" = 0 ] || fail "lines longer than 80: $(awk 'length > 80' out)"
    says out 'Usage: drypoint MODEL...'
    cp out first
    run 0 help
    cmp -s out first || fail "drypoint help is something else"
    run 0 shape:gear -h
    cmp -s out first || fail "-h after a model is something else"
    # its examples work
    mkdir parts
    run 0 make cube -o part.stl
    run 0 make cube -o gear.stl
    run 0 make cube -o shaft.obj
    run 0 make cube -o parts/a.stl
    sed -n 's/^  drypoint \(.*[^ ]\)   .*/\1/p' first >examples
    [ "$(wc -l <examples)" -ge 4 ] || fail "no examples"
    for word in --clip --xray --explode --turn; do says examples "$word"; done
    while read -r example; do run_example "$example"; done <examples
    is_png a.png
}
# run_example ARGS: runs an example of --help; films with two small frames, where there is ffmpeg.
run_example() {
    case $1 in
    *.mp4 | *.gif*)
        command -v ffmpeg >/dev/null || return
        eval "run 0 ${1% --size*} --frames 2 --size 100x80 -q" </dev/null
        ;;
    *) eval "run 0 $1 -q" </dev/null ;;
    esac
}
# Every topic of options has examples, all of which run without a warning.
topic_examples() {
    run 0 make bracket -o part.stl
    run 0 make terrain -o scan.stl
    promised_models
    bending_bar | sed 's/"Bend"/"Walk"/' >walk.glb
    sed 's/below/bolt 1/; s/above/housing/' engine.obj >named.obj
    mv named.obj engine.obj
    echo '{"views": [{"eye": [3, 2, 4], "target": [0, 0, 0]}, {"eye": [-3, 2, 4], "target": [0, 0, 0]}]}' >way.json
    for topic in picture page camera lines paths strokes surface sections objects edge-map method motion films program; do
        run 0 --help $topic
        sed -n '/^Examples:/,$p' out | sed -n 's/^  drypoint //p' >examples
        [ -s examples ] || fail "--help $topic has no examples"
        [ "$(awk 'length > 80' examples | wc -l)" = 0 ] || fail "--help $topic: an example is longer than 80"
        while read -r example; do
            run_example "$example"
            grep -q warning err && fail "$example: $(cat err)"
        done <examples
    done
}
# Every topic that the first screen names is one, and every option is in one of them.
topics() {
    run 0 --help
    sed -n '/Topics:/,$p' out | tr -d . | tr -s '\n ' ' ' | sed 's/.*Topics://; s/, or the name.*//' | tr -s ', ' '\n' | grep . >words
    for word in picture page camera lines paths strokes surface sections objects motion films method program models shapes info make bench view all; do
        grep -qx "$word" words || fail "$word is no topic: $(tr '\n' ' ' <words)"
    done
    : >each
    while read -r word; do
        run 0 --help "$word"
        silent err
        [ -s out ] || fail "--help $word says nothing"
        [ "$(awk 'length > 80' out | grep -vc '^  drypoint')" = 0 ] || fail "--help $word: lines longer than 80"
        [ "$word" = all ] || cat out >>each
        cp out by-option
        run 0 help "$word" </dev/null
        cmp -s out by-option || fail "drypoint help $word is not --help $word"
    done <words
    run 0 --help all
    grep -oE '^  (-., )?--[a-z0-9-]+' out | grep -oE -e '--.*' | sort -u >options
    [ "$(wc -l <options)" -gt 90 ] || fail "all: $(wc -l <options) options"
    while read -r name; do
        grep -qE -e "^  (-., )?$name( |\$)" each || fail "$name is in no topic"
    done <options
    run 0 --help camera
    says out '--azimuth'
    grep -q -e '--hatch' out && fail "--hatch… is of the camera"
    run 0 --help cameras
    says out '--azimuth'
    run 0 --help path
    says out 'Paths:'
    says out '--path FILE'
    run 0 --help paths
    grep -q -e '--path FILE' out && fail "--path is of paths"
    run 0 --help hidden-width
    says out '--hidden-width W'
    [ "$(grep -c -e '^  --' out)" = 1 ] || fail "not one option: $(cat out)"
    run 0 --help --hidden-width
    says out '--hidden-width W'
    run 0 help o
    says out '--output'
    for command in info make bench view; do
        run 0 $command --help
        cp out first
        run 0 --help $command
        cmp -s out first || fail "--help $command is not $command --help"
    done
}
wrong_topics() {
    wrong --help camra -- '--help: "camra" is no topic; did you mean camera?'
    wrong --help nosuch -- '--help: "nosuch" is neither a topic nor an option'
    wrong help linse -- 'did you mean lines?'
    wrong --help x-ray -- '"x-ray" is no topic; did you mean --help xray?'
    wrong help xyzzyxyzzy -- 'neither a topic nor an option; "drypoint --help" lists topics'
}
versions() {
    run 0 --version
    cp out version
    run 0 -V
    cmp -s out version || fail "-V is not --version"
    run 0 info -V
    cmp -s out version || fail "info -V is not --version"
}

# ---- completions ----

# completes LINE WORDS: what bash offers at the end of a line, once the script is read.
completes() {
    COMP_LINE=$1 COMP_POINT=${#1} COMPREPLY=()
    _drypoint 2>/dev/null # compopt has nothing to do here
    [ "${COMPREPLY[*]}" = "$2" ] || fail "\"$1\" is completed as \"${COMPREPLY[*]}\", not \"$2\""
}
bash_completion() {
    run 0 --completions bash
    silent err
    cp out script
    bash -n script 2>err || fail "bash -n: $(cat err)"
    # shellcheck disable=SC1091
    . ./script
    run 0 --completions=bash
    cmp -s out script || fail "--completions=bash is something else"
    wrong --completions tcsh -- '--completions: "tcsh" is none of bash|zsh|fish'
    rm out err script
    mkdir parts
    touch parts/a.stl 'parts/b c.stl' depths.txt
    completes 'drypoint in' info
    completes 'drypoint --vi' --view
    completes 'drypoint info --js' --json
    completes 'drypoint info --vi' ''
    completes 'drypoint a --view ' 'front back left right top bottom iso'
    completes 'drypoint a --view=t' top
    completes 'drypoint bench a --samples 1' '1 16'
    completes 'drypoint view a --backen' --backend
    completes 'drypoint-view a --backend ' 'cpu gl'
    completes '/usr/bin/drypoint-view --backen' --backend
    completes 'drypoint-view --js' '' # an option of info
    completes 'drypoint a --preset bl' blueprint
    completes 'drypoint a --lines ridge,va' ridge,valley
    completes 'drypoint a --sheet front,to' front,top
    completes 'drypoint a --page lett' letter
    completes 'drypoint a --stroke char' charcoal
    completes 'drypoint a --eye ' ''
    completes 'drypoint parts/' "parts/a.stl parts/b c.stl"
    completes 'drypoint -o dep' 'depth= depths.txt'
    completes 'drypoint a -o depth=de' depths.txt
    completes 'drypoint a --output=dep' 'depth= depths.txt'
    completes 'drypoint shape:gea' gear
    completes 'drypoint make gea' gear
    completes 'drypoint help cam' camera
    completes 'drypoint --help surf' surface
    local COMP_WORDBREAKS=' '
    completes 'drypoint a --view=t' --view=top
    completes 'drypoint shape:gea' shape:gear
    # every option is offered, and none that is hidden
    completes 'drypoint --ma' --margin
    run 0 --help all
    grep -oE '^  (-., )?--[a-z0-9-]+' out | grep -oE -e '--.*' | sort -u >options
    COMP_LINE='drypoint --' COMP_POINT=11 COMPREPLY=()
    _drypoint 2>/dev/null
    printf '%s\n' "${COMPREPLY[@]}" | sort -u >offered
    cmp -s options offered || fail "not the options of --help: $(diff options offered | head -n 5 | tr '\n' ' ')"
}
# skip SHELL: says so, where it is not installed.
skip() { echo "# $1 is not installed: its completions are not tried"; }
zsh_completion() {
    run 0 --completions zsh
    [ "$(head -n 1 out)" = '#compdef drypoint drypoint-view' ] || fail "no #compdef"
    command -v zsh >/dev/null || { skip zsh; return; }
    zsh -n out 2>err || fail "zsh -n: $(cat err)"
}
fish_completion() {
    run 0 --completions fish
    cp out script.fish
    command -v fish >/dev/null || { skip fish; return; }
    export HOME=$PWD XDG_CONFIG_HOME=$PWD XDG_DATA_HOME=$PWD # fish keeps files there
    fish -n script.fish 2>err || fail "fish -n: $(cat err)"
    offers() {
        fish -c "source script.fish; complete -C '$1'" 2>err | cut -f 1 | tr '\n' ' ' >offered
        [ "$(cat offered)" = "$2 " ] || fail "\"$1\" is completed as \"$(cat offered)\", not \"$2\": $(cat err)"
    }
    offers 'drypoint a --view t' top
    offers 'drypoint a --lines ridge,va' ridge,valley
    offers 'drypoint make gea' gear
    offers 'drypoint a --pres' --preset
    offers 'drypoint info --js' --json
    offers 'drypoint view --backen' --backend
    offers 'drypoint-view --backen' --backend
    offers 'drypoint help cam' camera
}
