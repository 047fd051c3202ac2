#!/bin/bash
# figures.sh PROGRAM accuracy [ORACLE-OPTIONS]... or times: the tables of figures in README.md and
# docs/lines.md: accuracy by the independent oracle (options: tests/accuracy/oracle.py --help), or times of
# frames, FRAMES=20 of each model.
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
times) ;;
*)
    echo "figures: $what is neither accuracy nor times" >&2
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
mkdir -p build
echo '| model | triangles | frame, ms (median) | least | file to PNG, s |'
echo '|---|---|---|---|---|'
for shape in gear:34000 terrain:1000000; do
    file=build/${shape%:*}-${shape#*:}.ply
    [ -e "$file" ] || "$program" make "${shape%:*}" --triangles "${shape#*:}" -o "$file" --quiet
    row "$file"
done
for file in "${XDG_CACHE_HOME:-$HOME/.cache}"/drypoint/dragon-*.ply; do
    [ ! -e "$file" ] || row "$file"
done
