#!/bin/bash
# bench-big.sh PROGRAM [TRIANGLES]: draws a binary STL larger than most, and holds its time against reading
# the file twice by cat and its memory against 300 MB; fails where it takes more (in time only from 50 million
# triangles on: below, the picture takes longer than the file). 100 million are 5 GB; the file stays in
# build/bench/big (BENCH_BIG_DIR) for the next time. BENCH_RUNS (3) of each, in turn.
set -eu
cd "$(dirname "$0")/.."
program=$(realpath "$1")
triangles=${2:-100000000}
build=$(dirname "$program")
out=$build/bench
folder=${BENCH_BIG_DIR:-$out/big}
file=$folder/terrain-$triangles.stl
run=$out/bin/run
mkdir -p "$folder"

say() { echo "bench-big: $*" >&2; }
field() { sed -n "s/.*\"$2\": \([0-9.]*\).*/\1/p" <<<"$1"; }
median() { printf '%s\n' "$@" | sort -g | sed -n "$((($# + 1) / 2))p"; }
calculate() { awk "BEGIN {printf \"%.2f\", $1}"; }

cmake -S . -B "$build" -DDRYPOINT_BENCH=ON >/dev/null
cmake --build "$build" --target bench_run >/dev/null

if [ ! -e "$file" ]; then
    need_mb=$((triangles / 20000 + 100)) # 50 bytes per triangle
    free_mb=$(df -Pm "$folder" | awk 'NR == 2 {print $4}')
    if [ "$free_mb" -lt "$need_mb" ]; then
        say "$folder has $free_mb MB left, $need_mb are needed; BENCH_BIG_DIR names another folder"
        exit 1
    fi
    say "writing $file"
    made=$("$run" "$program" make terrain --triangles "$triangles" -o "$file" --quiet)
    say "written in $(field "$made" seconds) s with $(field "$made" peak_mb) MB"
fi

cat "$file" >/dev/null # into the page cache, if it fits there
read_s=() draw_s=() draw_cpu=() peak=()
for round in $(seq "${BENCH_RUNS:-3}"); do
    say "round $round"
    result=$("$run" cat "$file" "$file")
    read_s+=("$(field "$result" seconds)")
    result=$("$run" "$program" "$file" --size 1680x1050 --quiet -o "$out/big.png")
    draw_s+=("$(field "$result" seconds)")
    draw_cpu+=("$(field "$result" processor_seconds)")
    peak+=("$(field "$result" peak_mb)")
done
# A peak is a peak: the largest of all.
memory=$(printf '%s\n' "${peak[@]}" | sort -g | tail -n 1)
seconds=$(median "${draw_s[@]}") reading=$(median "${read_s[@]}")
size=$(stat -c %s "$file")
printf '{"file_mb": %s, "draw_s": %s, "draw_cpu_s": %s, "read_twice_s": %s, "peak_mb": %s}\n' \
    "$(calculate "$size / 1e6")" "$seconds" "$(median "${draw_cpu[@]}")" "$reading" "$memory" |
    tee "$out/big.json"
printf '%s MB of STL drawn in %s s, %s times reading it twice (at most 8), with %s MB (at most 300)\n' \
    "$(calculate "$size / 1e6")" "$seconds" "$(calculate "$seconds / $reading")" "$memory"
if awk "BEGIN {exit !(($seconds > 8 * $reading && $triangles >= 5e7) || $memory > 300)}"; then
    say "missed"
    exit 1
fi
