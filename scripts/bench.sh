#!/bin/bash
# bench.sh PROGRAM: the median time of a frame, on generated models, as a table. FRAMES=20 each.
set -eu
program=$1
cd "$(dirname "$0")/.."
mkdir -p build/bench
printf '%-10s %10s %10s %10s %10s\n' model triangles frame_ms min max
for model in gear:10000 torus:100000 terrain:1000000; do
    shape=${model%:*} triangles=${model#*:}
    file=build/bench/$shape-$triangles.ply
    [ -e "$file" ] || "$program" make "$shape" --triangles "$triangles" -o "$file" --quiet
    result=$("$program" bench "$file" --frames "${FRAMES:-20}")
    field() { sed -n "s/.*\"$1\": *\([0-9.]*\).*/\1/p" <<<"$result" | head -n 1; }
    printf '%-10s %10s %10s %10s %10s\n' "$shape" "$(field triangles)" "$(field frame_ms)" \
        "$(field frame_ms_min)" "$(field frame_ms_max)"
done
