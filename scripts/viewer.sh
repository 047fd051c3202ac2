#!/bin/bash
# viewer.sh PROGRAM OUT.png: a picture of the viewer's window, from a screen nobody sees. PROGRAM is drypoint-view.
set -eu
viewer=$(realpath "$1") out=$(realpath "$2")
work=$(mktemp -d)
server='' viewing=''
end() {
    [ -z "$viewing" ] || kill "$viewing" 2>/dev/null || true
    [ -z "$server" ] || kill "$server" 2>/dev/null || true
    wait 2>/dev/null || true
    rm -rf "$work"
}
trap end EXIT
cd "$work"
Xvfb -displayfd 3 -screen 0 1280x960x24 -nolisten tcp -noreset 3>display 2>/dev/null &
server=$!
for _ in $(seq 100); do [ -s display ] && break; sleep 0.1; done
DISPLAY=:$(cat display)
export DISPLAY
unset WAYLAND_DISPLAY
window() { xdotool search --onlyvisible --name "$1" 2>/dev/null | head -n 1; }
"$viewer" shape:bracket --size 1120x760 --preset illustration --azimuth 50 --elevation 24 --zoom 0.8 &
viewing=$!
for _ in $(seq 300); do [ -n "$(window 'bracket - Drypoint')" ] && break; sleep 0.1; done
xdotool windowfocus "$(window 'bracket - Drypoint')"
sleep 1
# to the right of the panel, and the words of the beginning gone
xdotool keydown shift mousemove 500 400 mousedown 1 mousemove 600 400 mousemove 690 390 mouseup 1 keyup shift
sleep 1
xdotool key c mousemove 1100 50
sleep 7
xdotool key c
sleep 2
import -window "$(window 'bracket - Drypoint')" shot.png
convert shot.png +dither -colors 255 PNG8:"$out"
xdotool key q
wait "$viewing"
viewing=''
