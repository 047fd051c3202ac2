#!/bin/bash
# python.sh [BUILD]: makes the wheel of the libraries in BUILD (build) and runs the package's tests with it, in a fresh virtual
# environment that sees NumPy and cffi of the system. Prints a line `ok …` or `not ok …` for each test.
#
# Exit status 77: something that this needs is not there; it says what.
set -eu
cd "$(dirname "$0")/.."
python=${PYTHON:-/usr/bin/python3}
lacking() { # what the tests need beyond the wheel, as Debian calls it
    [ -x "$python" ] || { echo python3; return; }
    for module in numpy cffi setuptools wheel build; do
        "$python" -c "import $module" 2>/dev/null || echo "python3-$module"
    done
    "$python" -c 'import ensurepip' 2>/dev/null || echo python3-venv
    "$python" -c 'import os, sysconfig; exit(not os.path.exists(sysconfig.get_path("include") + "/Python.h"))' || echo python3-dev
}
missing=$(lacking | xargs)
if [ -n "$missing" ]; then
    echo "no $missing"
    exit 77
fi
scripts/wheel.sh "${1:-build}"
rm -rf build/python/venv
"$python" -m venv --system-site-packages build/python/venv
build/python/venv/bin/pip install --quiet --no-index --no-deps build/python/dist/*.whl
cd build/python # not where the package's sources lie
venv/bin/python -X faulthandler -W error ../../python/tests/run.py
