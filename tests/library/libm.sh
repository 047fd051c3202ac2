#!/bin/sh
# libm.sh LIST FILE...: of <math.h> the archives and objects call only what LIST allows (libm.txt), so that the
# same picture comes out with any C library.
set -eu
list=$1
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# C's functions, each for double, float and long double, and what compilers and glibc make of them: sincos, the
# vectors of libmvec, and names like __sin_finite.
for name in acos asin atan atan2 cos sin tan acosh asinh atanh cosh sinh tanh exp exp2 expm1 frexp ilogb ldexp log \
    log10 log1p log2 logb modf scalbn scalbln cbrt fabs hypot pow sqrt erf erfc lgamma tgamma ceil floor nearbyint \
    rint lrint llrint round lround llround trunc fmod remainder remquo copysign nan nextafter nexttoward fdim fmax \
    fmin fma sincos exp10 pow10 drem gamma j0 j1 jn y0 y1 yn significand scalb; do
    printf '%s\n' "$name" "${name}f" "${name}l"
done | sort -u >"$work/math"
grep -v '^#' "$list" | cut -f 1 | sort -u >"$work/allowed"
nm -u "$@" | awk '$1 == "U" { print $2 }' | sed 's/@.*//; s/^__\(.*\)_finite$/\1/' | sort -u >"$work/called"
test -s "$work/called"
{
    comm -12 "$work/called" "$work/math" | comm -23 - "$work/allowed"
    grep '^_ZGV' "$work/called" || true
} >"$work/strange"
test -s "$work/strange" || exit 0
nm -A -u "$@" | grep -wF -f "$work/strange" || true
echo "not in $(basename "$list"): $(tr '\n' ' ' <"$work/strange")- use src/base/elementary.h, or say there why none of its bits is open" >&2
exit 1
