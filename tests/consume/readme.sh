#!/bin/sh
# readme.sh CC README PREFIX LIBDIR: takes the C out of the README, compiles it by what pkg-config says, and
# runs the first piece, which draws a picture.
set -eu
cc=$1 readme=$2 prefix=$3 libdir=$4
export PKG_CONFIG_PATH="$prefix/$libdir/pkgconfig" LD_LIBRARY_PATH="$prefix/$libdir"
rm -f readme-*.c ./*.png
awk '/^```c$/ { n++; on = 1; next } /^```$/ { on = 0 } on { print > "readme-" n ".c" }' "$readme"
for piece in readme-*.c; do
    # shellcheck disable=SC2046
    $cc -std=c17 -Wall -Wextra -Werror -c "$piece" $(pkg-config --cflags drypoint-io)
done
# shellcheck disable=SC2046
$cc readme-1.o -o readme $(pkg-config --libs drypoint-io)
./readme
set -- ./*.png
[ "$(wc -c <"$1")" -gt 2000 ] # a blank picture of that size has far less
