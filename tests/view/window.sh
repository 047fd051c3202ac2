#!/usr/bin/env bash
# Presses the viewer's keys in a window that nobody sees, and compares what it saves with what the program draws by the
# command line that it copies. Usage: window.sh PATH/TO/drypoint-view PATH/TO/drypoint. Prints TAP; 77: skipped.
set -u
viewer=$(realpath "$1") program=$(realpath "$2")
for tool in Xvfb xdotool import; do
    command -v $tool >/dev/null || { echo "skipped: there is no $tool"; exit 77; }
done
work=$(mktemp -d "${TMPDIR:-/tmp}/drypoint-view-XXXXXX")
cd "$work" || exit 1
server='' viewing=''
end() {
    [ -z "$viewing" ] || kill "$viewing" 2>/dev/null
    [ -z "$server" ] || kill "$server" 2>/dev/null
    wait 2>/dev/null
    rm -rf "$work"
}
trap end EXIT

# until_true SECONDS COMMAND...: waits until it succeeds, as long as what it waits for runs.
until_true() {
    local last=$((SECONDS + $1))
    shift
    until "$@" >/dev/null 2>&1; do
        [ $SECONDS -lt $last ] || return 1
        [ -z "$viewing" ] || kill -0 "$viewing" 2>/dev/null || return 1
        sleep 0.05
    done
}

Xvfb -displayfd 3 -screen 0 640x480x24 -nolisten tcp -noreset 3>display >xvfb.log 2>&1 &
server=$!
until_true 20 test -s display || { echo "skipped: Xvfb does not start: $(tail -n 1 xvfb.log)"; exit 77; }
DISPLAY=:$(cat display)
export DISPLAY
unset WAYLAND_DISPLAY

number=0 failed=0 line='' saved=''
# ok NAME CONDITION...: one test.
ok() {
    local name=$1
    shift
    number=$((number + 1))
    if "$@" >/dev/null 2>&1; then
        echo "ok $number - $name"
    else
        failed=$((failed + 1))
        echo "not ok $number - $name"
        tail -n 3 err out 2>/dev/null | sed 's/^/# /'
    fi
}

# look ARGS...: starts the viewer; its window has the model when its title says so.
look() {
    : >out
    : >err
    "$viewer" "$@" --size 320x240 >out 2>err &
    viewing=$!
    until_true 60 focus
}
focus() {
    local window
    window=$(xdotool search --onlyvisible --name Drypoint | head -n 1)
    [ -n "$window" ] && xdotool windowfocus "$window"
}
press() { xdotool key --delay 20 "$@"; }
# leave CODE: quits by a key; the exit code must be that.
leave() {
    press q
    wait "$viewing"
    local code=$?
    viewing=''
    [ $code = "$1" ]
}

newest() { find . -maxdepth 1 -name "bolt-*.$1" | sort | tail -n 1; }
count() { find . -maxdepth 1 -name "bolt-*.$1" | wc -l; }
more_lines() { [ "$(wc -l <out)" -gt "$1" ]; }
more_files() { [ "$(count "$1")" -gt "$2" ]; }
# save KEY ENDING: saves the picture and copies its command line; sets `saved` and `line`.
save() {
    local before lines
    before=$(count "$2") lines=$(wc -l <out)
    press "$1" c
    until_true 30 more_files "$2" "$before" && until_true 30 more_lines "$lines" || return 1
    saved=$(newest "$2")
    line=$(tail -n 1 out)
}
# same KEY ENDING: what is saved is what the copied command line draws, byte for byte.
same() {
    save "$1" "$2" || return 1
    local words
    eval "words=(${line#drypoint })"
    "$program" "${words[@]:0:${#words[@]}-1}" "drawn.$2" --quiet && cmp "$saved" "drawn.$2"
}
# other NAME: the picture saved last is another than the one before it.
other() {
    local before=$last
    last=$saved
    ! cmp -s "$before" "$saved"
}
# Is another picture on the screen than bare.png?
screen_changes() {
    import -window root now.png || return 1
    compare -metric AE bare.png now.png null:
    [ $? = 1 ] # 2: it could not compare them
}
says() { [[ $line == *$1* ]]; }

# ------- keys -------

until_true 20 xdotool getdisplaygeometry || { echo "skipped: Xvfb does not answer"; exit 77; }
ok 'a window opens' look shape:bolt
[ $failed = 0 ] || exit 1
ok 'the model is read' until_true 60 xdotool search --name 'bolt - Drypoint'
ok 'what it saves is what the program draws' same s png
ok 'the command line is short' [ "$line" = 'drypoint shape:bolt --size 320x240 -o bolt.png' ]
last=$saved
press 1 o
ok 'a view from the front, orthographic' same s png
ok 'is another picture' other
ok 'and says so' says '--view front --ortho 0'
press Left Up Prior
ok 'turned and nearer by keys' same s png
ok 'is another picture' other
xdotool mousemove 160 120 mousedown 1 mousemove 200 130 mousemove 220 140 mouseup 1
xdotool keydown shift mousedown 1 mousemove 210 130 mouseup 1 keyup shift
xdotool mousemove 100 80 click 4 click 5 click 4
ok 'turned, moved and zoomed by the mouse' same s png
ok 'is another picture' other
ok 'and has an eye' says '--eye'
press f
ok 'fitted again' same s png
ok 'is another picture' other
press F2 plus h d r
ok 'without ridges, wider, with hidden lines' same s png
ok 'is another picture' other
ok 'and says so' says '--hidden dashed'
ok 'its lines as SVG' same S svg
press l x 0 o
ok 'a shaded look, see-through' same s png
ok 'is another picture' other
press p p
ok 'a preset' same s png
ok 'and says so' says '--preset illustration'
import -window root bare.png
press question
ok 'help is shown' until_true 30 screen_changes
press Escape
ok 'it ends well' leave 0

# ------- files -------

printf 'solid x\nfacet\n' >broken.stl
ok 'a file is dropped that is broken' look shape:bolt --dropped broken.stl
ok 'it says why' until_true 60 grep -q broken.stl err
ok 'the old model stays' same s png
ok 'it ends well' leave 0

"$program" make gear -o gear.stl --quiet
ok 'a file is dropped' look shape:bolt --dropped gear.stl --time 0
ok 'it takes the place of the model' until_true 60 xdotool search --name 'gear.stl - Drypoint'
ok 'it ends well' leave 0

ok 'a model that is not there' look nosuch.stl
ok 'is told' until_true 60 grep -q nosuch.stl err
ok 'in the exit code, too' leave 1

# ------- OpenGL, if there is a version that draws -------

if "$program" shape:cube --gl -o gl.png --quiet 2>/dev/null; then
    look shape:bolt --backend gl
    until_true 60 xdotool search --name 'bolt - Drypoint'
    ok 'OpenGL draws what the program draws by it' same s png
    ok 'and says so' says '--gl'
    press h
    ok 'the processor draws what OpenGL does not' same s png
    ok 'and says so' says '--hidden dashed'
    ok 'it ends well' leave 0
fi
echo "1..$number"
[ $failed = 0 ]
