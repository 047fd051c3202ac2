#!/bin/bash
# wheel.sh [BUILD]: makes build/python/dist/drypoint-….whl of the libraries in BUILD (build), which are built first.
#
# Everything that is made lies below build/python; the sources are copied there.
set -eu
cd "$(dirname "$0")/.."
build=${1:-build}
python=${PYTHON:-/usr/bin/python3}
lacking=$(for module in cffi setuptools wheel build; do "$python" -c "import $module" 2>/dev/null || echo "python3-$module"; done | xargs)
if [ -n "$lacking" ]; then
    echo "wheel: $python lacks Debian's $lacking: apt-get install $lacking" >&2
    exit 1
fi
# shellcheck disable=SC2046
[ -e "$build/CMakeCache.txt" ] || cmake --preset release $(scripts/generator.sh)
target=drypoint_io # and what it needs, the core
! grep -q '^DRYPOINT_IO:BOOL=OFF' "$build/CMakeCache.txt" || target=drypoint
cmake --build "$build" --parallel "${JOBS:-$(nproc)}" --target "$target"
rm -rf build/python/tree build/python/dist
mkdir -p build/python/tree build/python/dist
cp -r --parents include tools/colors.c python LICENSE build/python/tree
cp LICENSE build/python/tree/python
DRYPOINT_BUILD=$(realpath "$build") "$python" -m build --wheel --no-isolation --outdir build/python/dist build/python/tree/python \
    >build/python/wheel.log 2>&1 || { tail -n 30 build/python/wheel.log >&2; exit 1; }
ls -s build/python/dist/*.whl
