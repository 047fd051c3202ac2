#!/bin/bash
# hashes.sh PROGRAM: a line `hash name` for each of some hundred pictures: every kind of line, ink, look and
# reading, with several thread counts and, where the program has them (builds with tests), all vector widths.
# Two builds draw the same when their lines are the same:
#   scripts/hashes.sh old/drypoint >old.txt; scripts/hashes.sh build/drypoint | diff old.txt -
# It takes less than a minute on two processors.
set -eu
program=$(realpath "$1")
cd "$(dirname "$0")/.."
[ -d ../shared/models ] || echo "hashes: no ../shared/models; their pictures are left out" >&2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export program work

# One picture: NAME [VARIABLE=VALUE] ARGUMENTS...
picture() {
    local name=$1 cpu=
    shift
    case $1 in DRYPOINT_CPU=*) cpu=${1#*=} && shift ;; esac
    local out=$work/${name//[ \/]/-}.png
    DRYPOINT_CPU=$cpu "$program" "$@" --size 480x360 --quiet -o "$out" 2>"$out.err" || echo "failed: $(cat "$out.err")" >"$out"
    printf '%s %s\n' "$(sha256sum <"$out" | cut -c 1-16)" "$name"
    rm -f "$out" "$out.err"
}
export -f picture

cases() {
    local shape threads cpu
    for shape in bolt bracket gear torus; do
        echo "$shape|shape:$shape"
        echo "$shape quads|shape:$shape|--ink|quads|--width|7"
        echo "$shape quads paper interval|shape:$shape|--ink|quads|--method|paper|--between|interval"
        echo "$shape quads stencil|shape:$shape|--ink|quads|--between|stencil|--samples|1"
        echo "$shape adjacency|shape:$shape|--edges|adjacency|--ink|strokes"
        echo "$shape extruded|shape:$shape|--edges|adjacency|--width|12|--stroke|charcoal"
        echo "$shape extruded as printed|shape:$shape|--edges|adjacency|--method|paper|--width|12|--stroke|dots"
        echo "$shape stylized|shape:$shape|--stroke|pencil|--repeats|2|--jitter|2|--overshoot|9|--taper|20"
        echo "$shape table off|shape:$shape|--edge-table|off|--width|9"
        echo "$shape ortho|shape:$shape|--ortho|0|--view|iso|--samples|16"
        echo "$shape close|shape:$shape|--zoom|5|--cull-back-faces"
        echo "$shape c1|shape:$shape|--edge-map|c1|--style|gooch"
        echo "$shape pencil|shape:$shape|--style|pencil"
        echo "$shape mirror|shape:$shape|--style|toon|--edges|both|--mirror|0,1,0"
        echo "$shape hatch|shape:$shape|--style|hatch|--hatch-space|object|--normals|smooth"
        for threads in 1 2 7; do
            for cpu in plain base avx2 avx512; do
                echo "$shape $cpu $threads|DRYPOINT_CPU=$cpu|shape:$shape|--threads|$threads|--width|silhouette=5,ridge=2"
            done
            echo "$shape streamed twice $threads|$work/$shape.stl|--memory|48M|--passes|2|--threads|$threads"
            echo "$shape streamed once $threads|-|--passes|1|--eye|3,2,3|--target|0,0,0|--threads|$threads"
        done
        for cpu in plain base avx2; do
            echo "$shape gooch $cpu|DRYPOINT_CPU=$cpu|shape:$shape|--style|gooch|--edge-map|diagonal|--edges|both"
            echo "$shape pencil $cpu|DRYPOINT_CPU=$cpu|shape:$shape|--style|pencil|--edges|adjacency"
        done
    done
    local model
    for model in ../shared/cases/*/*.obj ../shared/cases/*.obj ../shared/models/{cow,fandisk,rocker-arm,stanford-bunny}.obj; do
        [ ! -e "$model" ] || echo "$(basename "$(dirname "$model")") $(basename "$model")|$model"
    done
}

for shape in bolt bracket gear torus; do
    "$program" make "$shape" --triangles 900000 -o "$work/$shape.stl" --quiet
    "$program" make "$shape" -o "$work/$shape.small.stl" --quiet
done
run() {
    IFS='|' read -r -a words <<<"$1"
    case $1 in
    *'|-|'*) picture "${words[@]}" <"$work/${1%% *}.small.stl" ;;
    *) picture "${words[@]}" ;;
    esac
}
export -f run
cases | tr '\n' '\0' | xargs -0 -P "$(nproc)" -I {} bash -c 'run "$1"' _ {} | sort -k 2

# and the gallery, by its own commands
mkdir -p "$work/build/gallery"
ln -s "$PWD/tests" "$work/tests" # which they name from build/gallery
cp scripts/place.awk "$work/build/gallery"
drypoint() { "$program" "$@" --quiet; }
commands=$(sed -n '/^```sh$/,/^```$/{/^```/d;p}' docs/gallery/README.md)
cd "$work/build/gallery"
. /dev/stdin <<<"$commands" >/dev/null
sha256sum ./*.png | cut -c 1-16,65- | sed 's/ *\.\// gallery /'
