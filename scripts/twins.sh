#!/bin/sh
# twins.sh [OPTION VALUE]...: draws random scenes and their twins, 10000 seeds unless --seeds says otherwise, and tells
# which pictures and lines differ. Options are those of test_twins (tests/twins/test_twins.c); for one seed:
#   scripts/twins.sh --seed 17 --kind fan --write FOLDER
set -eu
cd "$(dirname "$0")/.."
[ -e build/check-gcc/CMakeCache.txt ] || generator=$(scripts/generator.sh)
# shellcheck disable=SC2086
cmake --preset check-gcc ${generator:-} >/dev/null
cmake --build build/check-gcc --target test_twins >/dev/null
exec build/check-gcc/tests/test_twins --seeds 10000 --threads "${JOBS:-$(nproc)}" "$@"
