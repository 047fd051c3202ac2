#!/bin/sh
# accuracy.sh [MODEL or FOLDER]...: how well pictures agree with exact visible lines, as tables: by the project's own
# reference, then how well drawings of one shape agree with each other, then, where the independent oracle is at hand,
# by that.
set -eu
cd "$(dirname "$0")/.."
scripts/check.sh accuracy
build/check-gcc/tests/bench_accuracy "$@"
for table in whole agree noise steady; do
    echo
    scripts/figures.sh build/check-gcc/drypoint $table
done
echo
exec python3 tests/accuracy/oracle.py --build build/check-gcc --quick
