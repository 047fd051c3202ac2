#!/bin/sh
# fuzz.sh: runs every fuzzer for MINUTES (10) each, on all processors. What it finds is kept in
# build/fuzz/found, and the corpus it grows in build/fuzz/corpus, from run to run.
set -eu
cd "$(dirname "$0")/.."
minutes=${MINUTES:-10}
jobs=${JOBS:-$(nproc)}
# shellcheck disable=SC2046
cmake --preset check-fuzz $([ -e build/check-fuzz/CMakeCache.txt ] || scripts/generator.sh) >/dev/null
cmake --build build/check-fuzz --parallel "$jobs" --target fuzzers
mkdir -p build/fuzz/found
status=0
for source in tests/fuzz/fuzz_*.c; do
    name=$(basename "$source" .c)
    mkdir -p "build/fuzz/corpus/$name"
    echo "$name: $minutes min on $jobs processors"
    "build/check-fuzz/tests/$name" -fork="$jobs" -max_total_time=$((minutes * 60)) -timeout=20 \
        -rss_limit_mb=2560 -verbosity=0 -print_final_stats=1 -artifact_prefix="build/fuzz/found/$name-" \
        "build/fuzz/corpus/$name" "tests/fuzz/corpus/${name#fuzz_}" || status=1
done
if [ "$status" -ne 0 ]; then
    echo "fuzz: inputs that fail are in build/fuzz/found; add what you mend to tests/fuzz/corpus" >&2
fi
exit $status
