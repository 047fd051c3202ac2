#!/bin/sh
# accuracy.sh [OPTIONS]: the accuracy tests, then, where the independent oracle is at hand, its scores.
set -eu
cd "$(dirname "$0")/.."
scripts/check.sh accuracy
if [ -e tests/accuracy/oracle.py ]; then exec python3 tests/accuracy/oracle.py --build build/check-gcc "$@"; fi
