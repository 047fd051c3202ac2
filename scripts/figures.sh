#!/bin/bash
# figures.sh PROGRAM accuracy [ORACLE-OPTIONS]... or times or vectors or film [MODEL]... or xray, or agree, steady, noise or
# whole [MODEL]...: the tables of figures in README.md and docs/: accuracy by the independent oracle (options:
# tests/accuracy/oracle.py --help), times of frames, FRAMES=20 of each model, what drawings as vectors hold and cost
# or how many frames of films are drawn a second, the best of RUNS=7 runs, or how well drawings of one shape agree (scripts/agreement.sh).
set -eu
program=$(realpath "$1") what=$2
shift 2
cd "$(dirname "$0")/.."
echo "$(date +%F), $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1), $(nproc) processors"
echo

# One row per class and width: the worst of all models and views.
summarise() {
    awk -F '|' '
    function worse(table, key, value, sign) {
        if (!(key in table) || sign * value < sign * table[key]) table[key] = value
    }
    $2 ~ /^ [a-z0-9-]+ $/ && $4 + 0 > 0 && $5 + 0 > 0 {
        key = $3 "|" $4
        if (!(key in cases)) order[++rows] = key
        cases[key] += $5
        split($6, recall, "/"); split($7, precision, "/"); split($8, uncovered, "/")
        worse(r, key, recall[1] + 0, 1); worse(p, key, precision[1] + 0, 1); worse(u, key, uncovered[1] + 0, -1)
        if ($9 + 0 > 0) { worse(thin, key, $9 + 0, 1); worse(thick, key, $9 + 0, -1) }
        missed[key] += $10
    }
    END {
        print "| class | width, px | pictures | least recall | least precision | most uncovered | median widths | below its figure |"
        print "|---|---|---|---|---|---|---|---|"
        for (i = 1; i <= rows; i++) {
            key = order[i]
            widths = key in thin ? sprintf("%.2f to %.2f", thin[key], thick[key]) : "–"
            printf "|%s| %d | %.4f | %.4f | %s | %s | %d |\n", key, cases[key], r[key], p[key],
                   key ~ /silhouette| all / ? "–" : sprintf("%.4f", u[key]), widths, missed[key]
        }
    }'
}
case $what in
accuracy)
    python3 tests/accuracy/oracle.py --drypoint "$program" "$@" | summarise
    exit
    ;;
times | vectors | film | xray) ;;
agree | steady | noise | whole) exec scripts/agreement.sh "$program" "$what" "$@" ;;
*)
    echo "figures: $what is none of accuracy, times, vectors, film, xray, agree, steady, noise and whole" >&2
    exit 2
    ;;
esac

field() { sed -n "s/.*\"$1\": *\([0-9.]*\).*/\1/p" <<<"$2" | head -n 1; }
row() {
    local result start
    result=$("$program" bench "$1" --frames "${FRAMES:-20}" --size 1680x1050)
    start=$(date +%s%N)
    "$program" "$1" -o build/figures.png --size 1680x1050 --quiet
    printf '| %s | %s | %.1f | %.1f | %.2f |\n' "$(basename "$1" .ply)" "$(field triangles "$result")" \
        "$(field frame_ms "$result")" "$(field frame_ms_min "$result")" \
        "$(awk "BEGIN { print ($(date +%s%N) - $start) / 1e9 }")"
}

# Models: generated ones, and the Stanford dragons where bench.sh or the accuracy tests have fetched them.
models() {
    local shape file
    mkdir -p build
    for shape in "$@"; do
        file=build/${shape%:*}-${shape#*:}.ply
        [ -e "$file" ] || "$program" make "${shape%:*}" --triangles "${shape#*:}" -o "$file" --quiet
        echo "$file"
    done
    for file in "${XDG_CACHE_HOME:-$HOME/.cache}"/drypoint/dragon-*.ply; do
        [ ! -e "$file" ] || echo "$file"
    done
}

# Least processor time of RUNS runs, in ms: by a model and options.
cost() {
    local run all=
    for ((run = 0; run < ${RUNS:-7}; run++)); do
        all+="$( { TIMEFORMAT='%U %S'; time "$program" "$@" --size 1680x1050 --quiet >/dev/null 2>&1; } 2>&1) "$'\n'
    done
    awk 'NF { t = 1000 * ($1 + $2); if (!n++ || t < least) least = t } END { printf "%.0f", least }' <<<"$all"
}
# What the program says of a drawing.
say() { "$program" "$@" --size 1680x1050 2>&1 | sed 's/^drypoint: //' | grep ' paths,'; }
paths() { say "$@" | sed -n 's/.*: \([0-9]*\) paths.*/\1/p'; }
share() { say "${@:2}" | grep -oE "[0-9.]+ % $1" | sed 's/ %.*//' | grep . || echo 0; }
vectors() {
    local model=$1 out=build/figures png svg hidden
    png=$(cost "$model" -o $out.png) svg=$(cost "$model" -o $out.svg) hidden=$(cost "$model" -o $out.png --hidden dashed)
    printf '| %s | %s | %s | %s | %s %% | %s %% | %s %% | %.1f | %.2f | %.2f |\n' "$(basename "${model%.*}")" \
        "$(paths "$model" -o $out.svg)" "$(paths "$model" -o $out.svg --join-classes)" \
        "$(($(paths "$model" -o $out.svg --join-classes --hidden dashed) - $(paths "$model" -o $out.svg --join-classes)))" \
        "$(share 'left out' "$model" -o $out.svg)" "$(share dropped "$model" -o $out.svg)" \
        "$(share less "$model" -o $out.svg --optimize)" \
        "$("$program" "$model" -o $out.svg --size 1680x1050 --quiet && stat -c %s $out.svg | awk '{ print $1 / 1000 }')" \
        "$(awk "BEGIN { print $svg / $png }")" "$(awk "BEGIN { print $hidden / $png }")"
}
# Frames a second of a turntable of 120 frames, 640x480, as raw pixels, without what is read before: the best of RUNS runs.
rate() {
    local run
    for ((run = 0; run < ${RUNS:-7}; run++)); do
        "$program" "$@" --turn 360 --frames 120 --size 640x480 --format rgba -o /dev/null --quiet --stats=json
    done | sed -n 's/.*"frames_per_second": \([0-9.]*\).*/\1/p' | sort -n | tail -n 1 | xargs printf '%.0f'
}
# Processor time of one of its frames in ms, with its share of reading and fitting: that of the best run.
effort() {
    local run all=
    for ((run = 0; run < ${RUNS:-7}; run++)); do
        all+="$( { TIMEFORMAT='%U %S'; time "$program" "$@" --turn 360 --frames 120 --size 640x480 --format rgba \
            -o /dev/null --quiet 2>/dev/null; } 2>&1)"$'\n'
    done
    awk 'NF { t = 1000 * ($1 + $2) / 120; if (!n++ || t < least) least = t } END { printf "%.1f", least }' <<<"$all"
}
film() {
    printf '| %s | %s | %s | %s | %s |\n' "$(basename "${1%.*}")" "$(rate "$1")" "$(rate "$1" --jobs 1)" \
        "$(rate "$1" --jobs 1 --threads 1)" "$(effort "$1")"
}
if [ "$what" = film ]; then
    [ $# -gt 0 ] || mapfile -t list < <(models gear:34000 terrain:200000)
    echo '| model | side by side | one after the other, as many threads | one thread | processor time of a frame, ms |'
    echo '|---|---|---|---|---|'
    for file in "${@:-${list[@]}}"; do film "$file"; done
    exit
fi
if [ "$what" = vectors ]; then
    [ $# -gt 0 ] || mapfile -t list < <(models gear:34000 terrain:200000)
    echo '| model | paths | with --join-classes | and hidden | left out: on others | dropped | less travel | SVG, kB | SVG/PNG | --hidden/PNG |'
    echo '|---|---|---|---|---|---|---|---|---|---|'
    for file in "${@:-${list[@]}}"; do vectors "$file"; done
    exit
fi
# Processor time of a frame of four nested spheres, opaque and as an x-ray, in turns, so that both meet the same
# machine: the least of RUNS, of 24 frames less 4.
processor_ms() {
    local TIMEFORMAT='%U %S'
    { time "$program" bench "$@" --threads 1 >/dev/null; } 2>&1 | awk '{ print 1e3 * ($1 + $2) }'
}
if [ "$what" = xray ]; then
    work=$(mktemp -d)
    trap 'rm -rf "$work"' EXIT
    "$program" make sphere --triangles 14000 -o "$work/one.obj" --quiet
    awk -f scripts/place.awk "$work/one.obj" SCALE=0.8 "$work/one.obj" SCALE=0.6 "$work/one.obj" \
        SCALE=0.4 "$work/one.obj" >"$work/four.obj"
    echo '| look | opaque, ms | x-ray, ms | ratio |'
    echo '|---|---|---|---|'
    for look in flat gooch; do
        for ((i = 0; i < ${RUNS:-5}; i++)); do
            for opacity in 0 0.4; do
                for frames in 4 24; do
                    echo $opacity $frames "$(processor_ms "$work/four.obj" --size 1680x1050 --style $look \
                        --xray $opacity --frames $frames)"
                done
            done
        done | awk -v look=$look '{ k = $1 " " $2; if (!(k in least) || $3 < least[k]) least[k] = $3 }
            END { opaque = (least["0 24"] - least["0 4"]) / 20; xray = (least["0.4 24"] - least["0.4 4"]) / 20
                  printf "| %s | %.1f | %.1f | %.2f |\n", look, opaque, xray, xray / opaque }'
    done
    exit
fi
echo '| model | triangles | frame, ms (median) | least | file to PNG, s |'
echo '|---|---|---|---|---|'
models gear:34000 terrain:1000000 | while read -r file; do row "$file"; done
