#!/bin/bash
# agreement.sh PROGRAM agree, steady, noise or whole [MODEL]...: how well drawings of one shape agree, as tables. Called by
# figures.sh.
#
#     agree    one shape at several resolutions, against the last one named
#     steady   a slow turn: which share of line pixels appear or vanish from frame to frame
#     noise    a model against itself with noise along its normals, SHARE=0.001 of its box's diagonal
#     whole    drawings with each of the options against those with the first: what is gained and lost
#
# F is the harmonic mean of the shares of either picture's ink that have ink of the other within PX=3 pixels; crumbs are
# the share of ink in pieces less than 12 px wide and high. OPTIONS are what is compared, ';' between them: --detail
# exact;--detail auto, or nothing where the program does not know --detail. Without models: the Stanford dragon, from npm,
# and generated ones, and the fandisk where it lies in $DRYPOINT_MODELS.
set -eu
program=$1 what=$2
shift 2
cd "$(dirname "$0")/.."
build=$(dirname "$program")
[ -e "$build/CMakeCache.txt" ] || build=build
bin=$build/bench/bin
out=$build/agreement
px=${PX:-3}
mkdir -p "$out"

say() { echo "agreement: $*" >&2; }

build_instruments() {
    [ -e "$build/CMakeCache.txt" ] || { say "$build is not configured: run make first"; exit 1; }
    cmake -S . -B "$build" -DDRYPOINT_BENCH=ON >/dev/null
    cmake --build "$build" --target bench_{agree,camera,noise,steady} --parallel "${JOBS:-2}" >"$out/build.log" ||
        { cat "$out/build.log" >&2; exit 1; }
}

# Sets `options`: what is compared.
choose_options() {
    local default=
    ! "$program" --help all | grep -q -e '--detail' || default='--detail exact;--detail auto'
    IFS=';' read -ra options <<<"${OPTIONS-$default}"
    [ ${#options[@]} -gt 0 ] || options=('')
}

# Sets `models`: to the files named or, where there are none, to generated shapes and dragons.
choose_models() { # SIZES-OF-DRAGONS SHAPE... -- MODEL...
    local dragons=$1 shape cache=${XDG_CACHE_HOME:-$HOME/.cache}/drypoint
    shift
    models=()
    for (( ; ; )); do
        shape=$1
        shift
        [ "$shape" != -- ] || break
        [ -e "$out/$shape.ply" ] || "$program" make "$shape" -o "$out/$shape.ply" --quiet
        models+=("$out/$shape.ply")
    done
    [ $# -eq 0 ] || { models=("$@"); return; }
    [ -n "$dragons" ] || return 0
    mkdir -p "$cache"
    scripts/dragons.sh "$cache" || { say "tables are without it"; return 0; }
    for shape in $dragons; do models+=("$cache/dragon-$shape.ply"); done
}

# The dragon is seen from near its head, everything else as it is by default.
camera() {
    case $(basename "$1") in
    dragon*) echo "--eye 0.15,0.25,0.35 --target=-0.01,0.12,0" ;;
    *) "$bin/camera" "$1" ;;
    esac
}

draw() { # MODEL PICTURE OPTIONS [MODEL-OF-THE-CAMERA]
    # shellcheck disable=SC2046,SC2086
    "$program" "$1" -o "$2" --size 1200x900 $(camera "${4:-$1}") $3 --quiet
}

name() { basename "${1%.*}"; }
shown() { [ -z "$1" ] || echo "\`$1\`"; }
compare() { "$bin/agree" "$1" "$2" "$px"; }
field() { awk -F "$1 " '{ printf "%.3f", $2 }' <<<"$2"; }

# One row: a model against another, seen by one camera, which is the first one's.
agreement_row() { # MODEL REFERENCE OPTIONS
    local all silhouettes lines
    for lines in all silhouette; do
        draw "$1" "$out/a-$lines.png" "$3 --lines $lines" "$2"
        draw "$2" "$out/b-$lines.png" "$3 --lines $lines"
    done
    all=$(compare "$out/a-all.png" "$out/b-all.png")
    silhouettes=$(compare "$out/a-silhouette.png" "$out/b-silhouette.png")
    printf '| %s | %s | %s | %s | %s | %s | %s |\n' "$(name "$1")" "$(name "$2")" "$(shown "$3")" "$(field F "$all")" \
        "$(field F "$silhouettes")" "$(field crumbs "$all")" "${all##* }"
}
agreement_head() {
    echo '| model | against | options | F, all classes | F, silhouettes | crumbs | against: crumbs |'
    echo '|---|---|---|---|---|---|---|'
}

agree() {
    local last=${models[-1]} file set
    [ ${#models[@]} -gt 1 ] || { say "one resolution alone agrees with nothing"; return 0; }
    agreement_head
    for file in "${models[@]:0:${#models[@]}-1}"; do
        for set in "${options[@]}"; do agreement_row "$file" "$last" "$set"; done
    done
}

noise() {
    local file set noisy
    agreement_head
    for file in "${models[@]}"; do
        noisy=$out/$(name "$file")-noisy.ply
        "$bin/noise" "$file" "$noisy" "${SHARE:-0.001}"
        for set in "${options[@]}"; do agreement_row "$noisy" "$file" "$set"; done
    done
}

steady() {
    local file set change first
    echo '| model | options | appear or vanish, of line pixels a frame | to the first |'
    echo '|---|---|---|---|'
    for file in "${models[@]}"; do
        first=
        for set in "${options[@]}"; do
            change=$("$bin/steady" "$program" "$set" "$file")
            first=${first:-$change}
            awk -v a="$first" -v b="$change" -v row="| $(name "$file") | $(shown "$set")" \
                'BEGIN { printf "%s | %.3f %% | %s |\n", row, 100 * b, (a > 0 ? sprintf("%.2f", b / a) : "–") }'
        done
    done
}

whole() {
    local file set result
    [ ${#options[@]} -gt 1 ] || { say "one set of options alone: nothing to compare"; return 0; }
    echo '| model | options | against | recall, 2 px | precision, 2 px | recall, 3 px | precision, 3 px |'
    echo '|---|---|---|---|---|---|---|'
    for file in "${models[@]}"; do
        draw "$file" "$out/a.png" "${options[0]}"
        for set in "${options[@]:1}"; do
            draw "$file" "$out/b.png" "$set"
            printf '| %s | %s | %s |' "$(name "$file")" "$(shown "$set")" "$(shown "${options[0]}")"
            for px in 2 3; do
                result=$(compare "$out/a.png" "$out/b.png")
                printf ' %s | %s |' "$(field 'A in B' "$result")" "$(field 'B in A' "$result")"
            done
            echo
        done
    done
}

build_instruments
choose_options
fandisk=()
[ -z "${DRYPOINT_MODELS:-}" ] || [ ! -e "$DRYPOINT_MODELS/fandisk.obj" ] || fandisk=("$DRYPOINT_MODELS/fandisk.obj")
case $what in
agree) choose_models '11k 48k 202k 871k' -- "$@" ;;
steady) choose_models '48k 871k' gear -- "$@" ;;
noise) choose_models '871k' -- "$@" ;;
whole)
    choose_models '' gear bolt bracket stairs boxes -- "$@"
    [ $# -gt 0 ] || models+=("${fandisk[@]}")
    ;;
*) say "$what is none of agree, steady, noise and whole"; exit 2 ;;
esac
[ ${#models[@]} -eq 0 ] || $what
