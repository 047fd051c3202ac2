#!/bin/bash
# tables.sh PROGRAM MODEL...: Tables 2.1 and 2.2 of Hermosilla and Vázquez 2010 on this machine: median frame of FRAMES=10
# at 1680x1050, SAMPLES=1 per pixel. Silhouettes 8 px wide with a charcoal texture; pencil without lines.
set -eu
program=$(realpath "$1")
shift
field() { sed -n "s/.*\"$1\": *\([0-9.]*\).*/\1/p" <<<"$2" | head -n 1; }
bench() { "$program" bench "$@" --size 1680x1050 --samples "${SAMPLES:-1}" --frames "${FRAMES:-10}"; }
cell() { # frames per second, of a result
    awk -v ms="$(field frame_ms "$1")" 'BEGIN { printf " %.1f |", 1000 / ms }'
}
echo "$(date +%F), $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), $(nproc) processors; frames per second"
echo
echo '| model | triangles | emergent, plain | adjacency, plain | extruded | printed, 1 pass | printed, 2 passes | million triangles/s | adjacency, MB | built in, ms | pencil | pencil, printed | million triangles/s |'
echo '|---|---|---|---|---|---|---|---|---|---|---|---|---|'
for model; do
    textured=(--lines silhouette --edges adjacency --stroke charcoal --width 8)
    emergent=$(bench "$model" --lines silhouette)
    triangles=$(field triangles "$emergent")
    printf '| %s | %s |' "$(basename "${model%.*}")" "$triangles"
    cell "$emergent"
    cell "$(bench "$model" --lines silhouette --edges adjacency --ink strokes)"
    cell "$(bench "$model" "${textured[@]}")"
    cell "$(bench "$model" "${textured[@]}" --method paper)"
    two=$(bench "$model" "${textured[@]}" --method paper --passes 2)
    cell "$two"
    awk -v ms="$(field frame_ms "$two")" -v n="$triangles" 'BEGIN { printf " %.1f |", n / ms / 1000 }'
    stats=$("$program" "$model" -o /dev/null --size 1680x1050 --edges adjacency --lines silhouette --stats json --quiet)
    awk -v b="$(field adjacency_bytes "$stats")" -v ms="$(field adjacency_ms "$stats")" 'BEGIN { printf " %.1f | %.0f |", b / 1e6, ms }'
    pencil=$(bench "$model" --style pencil --lines none)
    cell "$pencil"
    cell "$(bench "$model" --style pencil --lines none --pencil-turns printed)"
    awk -v ms="$(field frame_ms "$pencil")" -v n="$triangles" 'BEGIN { printf " %.1f |\n", n / ms / 1000 }'
done
