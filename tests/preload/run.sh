#!/bin/sh
# run.sh COMMAND...: runs it with a DISPLAY of its own, Xvfb's; 77 (skipped) where there is none.
set -eu
command -v Xvfb >/dev/null 2>&1 || { echo "skipped: Xvfb is not installed"; exit 77; }
work=$(mktemp -d)
server=
trap '[ -z "$server" ] || kill "$server" 2>/dev/null || true; rm -rf "$work"' EXIT
trap 'exit 1' INT TERM
Xvfb -displayfd 3 -screen 0 640x480x24 -nolisten tcp 3>"$work/display" >"$work/log" 2>&1 &
server=$!
tries=0
while [ ! -s "$work/display" ]; do
    tries=$((tries + 1))
    if [ $tries -gt 100 ] || ! kill -0 "$server" 2>/dev/null; then
        echo "skipped: Xvfb does not start: $(tail -n 1 "$work/log")"
        exit 77
    fi
    sleep 0.1
done
DISPLAY=:$(cat "$work/display")
export DISPLAY
"$@"
