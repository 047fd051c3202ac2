#!/bin/sh
# hacks.sh LIBRARY GRAB: glxgears and six of xscreensaver's GL hacks, which never heard of lines, get them: each lives
# and shows dark lines on paper within a while. Those that are not installed are named; none at all: 77.
set -eu
library=$1 grab=$2
log=$(mktemp)
trap 'rm -f "$log"' EXIT
shown=0 failed=0
for name in glxgears gears moebiusgears glknots morph3d superquadrics topblock; do
    program='' size="-geometry 300x300+0+0"
    for folder in /usr/libexec/xscreensaver /usr/lib/xscreensaver; do
        [ ! -x $folder/$name ] || program="$folder/$name -window"
    done
    [ $name != glxgears ] || program=$(command -v glxgears || true)
    if [ -z "$program" ]; then
        echo "not installed: $name"
        continue
    fi
    # shellcheck disable=SC2086
    LD_PRELOAD=$library DRYPOINT_LINES=1 $program $size >"$log" 2>&1 &
    pid=$!
    tries=0 seen=
    while [ $tries -lt 60 ] && kill -0 $pid 2>/dev/null; do
        sleep 0.25
        tries=$((tries + 1))
        if seen=$("$grab" 10 10 280 280); then break; fi
    done
    if kill -0 $pid 2>/dev/null && "$grab" 10 10 280 280 >/dev/null; then
        echo "ok $name: $seen"
        shown=$((shown + 1))
    else
        echo "not ok $name: $seen"
        sed 's/^/    /' "$log"
        failed=1
    fi
    kill $pid 2>/dev/null || true
    wait $pid 2>/dev/null || true
done
[ $((shown + failed)) -gt 0 ] || exit 77
exit $failed
