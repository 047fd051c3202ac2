#!/bin/sh
# exports.sh INCLUDE LIBRARY HEADER...: what the headers declare and what the shared library exports are the
# same set of names, and the core library needs nothing but libc, libm and pthreads, nor does that for OpenGL but the core.
set -eu
include=$1 library=$2
shift 2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for header; do
    grep -v '^#' "$include/drypoint/$header" | tr '\n' ' ' | sed 's/DP_API/\n&/g' | grep '^DP_API [^(]*(' |
        sed 's/(.*//; s/.*[ *]//'
done | sort -u >"$work/declared"
nm -D --defined-only "$library" | awk '$2 ~ /[TDBR]/ { print $3 }' | sort -u >"$work/exported"
test -s "$work/declared"
if ! diff -u "$work/declared" "$work/exported"; then
    echo "lines with -: declared with DP_API but not defined; with +: exported but not declared" >&2
    exit 1
fi
case $library in
*drypoint_io*) ;;
*)
    others=$(readelf -d "$library" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p' |
        grep -Ev '^(libc|libm|libpthread|ld-linux.*)\.so|^libdrypoint\.so' || true)
    if [ -n "$others" ]; then
        echo "$library needs more than libc, libm and pthreads: $others" >&2
        exit 1
    fi
    ;;
esac
