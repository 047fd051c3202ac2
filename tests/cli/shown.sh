# The commands that README.md and the docs show, for run.sh, which reads this file: each runs as it stands there, but
# for its size, and without a warning. Models are made for the names that they use.
# shellcheck shell=bash disable=SC2034,SC2086,SC2154

shown_tests="shown_in_readme shown_in_docs"

# shown FILE: its commands in code blocks, without remarks; not those that go on in another line or program.
shown() {
    sed -n 's/^ *\(drypoint .*\)/\1/p' "$here/../../$1" | sed 's/  *# .*//' | grep -v '[|<\\]\|| *$'
}
shown_models() {
    local parts_before=0
    for part in part.stl part.ply part.obj bracket.stl bracket.obj; do run 0 make bracket -o $part; done
    run 0 make terrain -o scan.ply
    run 0 make gear -o gear.stl
    run 0 make bolt -o shaft.obj
    run 0 make bolt --size 40 -o bolt.stl
    run 0 make cube --size 40 -o plate.stl
    run 0 make stairs --size 4 -o house.obj
    run 0 make cube -o hall.obj
    run 0 make cylinder -o hall.ply
    mkdir parts
    cp gear.stl part.stl parts
    promised_models
    for name in bolt_1 housing piston crank; do # each beside the one before
        echo "o $name"
        awk -v n=$((parts_before++)) '
            $1 == "v" { count++; print "v", $2 + 2.5 * n, $3, $4; next }
            $1 == "f" { for (i = 2; i <= NF; i++) $i = int($i); print }' cylinder.obj
    done >row.obj
    # every object has as many vertices: indices go on from the ones before
    awk -v each="$(grep -c '^v ' cylinder.obj)" '
        $1 == "o" { n++ }
        $1 == "f" { for (i = 2; i <= NF; i++) $i += each * (n - 1) }
        { print }' row.obj >engine.obj
    # two animations: the bar bends, and does so again
    local turn='{"channels": [{"sampler": 0, "target": {"node": 2, "path": "rotation"}}]'
    turn+=', "samplers": [{"input": 4, "output": 5}]}, '
    bending_bar | sed "s/\"Bend\"/\"Walk\"/; s/\"animations\": \[/&$turn/" >walk.glb
    cp walk.glb dancer.gltf
    cp walk.glb part.glb
    cp walk.glb engine.glb
    cp engine.obj machine.obj
    cat >way.json <<END
{"views": [{"time": 0, "eye": [3, 2, 4], "target": [0, 0, 0]}, {"time": 0.1, "eye": [-3, 2, 4], "target": [0, 0, 0]}]}
END
}
# try_shown COMMAND: small, films with few frames and where there is ffmpeg.
try_shown() {
    local command=${1#drypoint }
    command=${command//dancer.fbx/dancer.gltf} command=${command//hall.dae/hall.ply}
    command=${command//--frames 3000/--frames 3}
    case $command in
    *.mp4* | *.webm* | *.gif*) command -v ffmpeg >/dev/null || return ;;&
    view*) return ;; # a window: tests/view
    *--gl*) has_opengl || return ;;&
    *'--turn 360'*) [[ $command = *--frame* ]] || command+=" --frames 2" ;;&
    info* | make* | --help* | *--list* | *--size* | *--page* | *--sheet*) ;;
    *) command+=" $small" ;;
    esac
    eval "run 0 $command"
    grep -q warning err && fail "$1: $(cat err)"
}
try_all() {
    shown_models
    for page; do
        shown "$page" >commands
        [ -s commands ] || fail "$page shows no commands"
        while read -r command; do try_shown "$command"; done <commands
    done
}
shown_in_readme() { try_all README.md; }
shown_in_docs() { try_all docs/{moving,films,objects,sections,xray,patterns}.md; }
