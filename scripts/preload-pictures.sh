#!/bin/bash
# preload-pictures.sh [LIBRARY]: draws docs/gallery/preload-*.png again: glxgears and six of xscreensaver's GL hacks under
# libdrypoint-preload.so, on an X server of their own. They move and choose at random, so no two runs give the same
# pictures; that is why `make gallery` does not do this. Needs Xvfb, ImageMagick, mesa-utils and xscreensaver-gl.
set -eu
here=$(cd "$(dirname "$0")/.." && pwd)
if [ -z "${PRELOAD_PICTURES:-}" ]; then
    PRELOAD_PICTURES=1 exec "$here/tests/preload/run.sh" "$0" "$@"
fi
library=$(realpath "${1:-$here/build/libdrypoint-preload.so}")
gallery=$here/docs/gallery
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
side=280 # px
convert=/usr/bin/convert montage=/usr/bin/montage

# shot FILE SECONDS PROGRAM [VARIABLE...]: what its window shows after so long.
shot() {
    local file=$work/$1.png seconds=$2 program=$3 pid
    shift 3
    case $program in
    glxgears) set -- "$@" glxgears ;;
    *) for folder in /usr/libexec/xscreensaver /usr/lib/xscreensaver; do
        [ ! -x "$folder/$program" ] || set -- "$@" "$folder/$program" -window
    done ;;
    esac
    env "$@" -geometry $((side + 2))x$((side + 2))+0+0 >"$work/log" 2>&1 &
    pid=$!
    sleep "$seconds"
    kill -0 $pid || { cat "$work/log"; exit 1; }
    /usr/bin/import -window root -crop "${side}x$side+1+1" +repage "$file"
    kill $pid
    wait $pid || true
}

lines=(LD_PRELOAD="$library" DRYPOINT_LINES=1)
shot 0 3 glxgears
shot 1 4 glxgears "${lines[@]}"
shot 2 6 gears "${lines[@]}"
shot 3 6 moebiusgears "${lines[@]}"
shot 4 6 glknots "${lines[@]}"
shot 5 15 queens "${lines[@]}" DRYPOINT_ALSO=blended
shot 6 8 superquadrics "${lines[@]}"
shot 7 6 polyhedra "${lines[@]}"
sheet() { # FILE COLUMNS PICTURE...
    local file=$gallery/$1.png columns=$2
    shift 2
    $montage "$@" -tile "${columns}x" -geometry "${side}x$side+3+3" -background white "$work/sheet.png"
    $convert "$work/sheet.png" +dither -colors 128 -define png:compression-level=9 -strip "$file"
}
sheet preload-hacks 4 "$work"/[0-7].png

# The three inks, on the program's own picture and on paper.
inks=(DRYPOINT_SILHOUETTE_INK=#000000 DRYPOINT_RIDGE_INK=#c00000 DRYPOINT_VALLEY_INK=#0050d0)
shot 0 4 glxgears "${lines[@]}" "${inks[@]}"
shot 1 4 glxgears "${lines[@]}" DRYPOINT_SHADED=1 DRYPOINT_INK=#ffffff
shot 2 4 glxgears "${lines[@]}" DRYPOINT_WIDTH=5 DRYPOINT_PAPER=#fff4dc DRYPOINT_INK=#402000
sheet preload-inks 3 "$work"/[0-2].png
ls -l "$gallery"/preload-*.png
