#!/bin/sh
# run.sh CC SOURCES PREFIX LIBDIR [static]: builds both consumers by what pkg-config says, and runs them.
set -eu
cc=$1 sources=$2 prefix=$3 libdir=$4 kind=${5:-shared}
export PKG_CONFIG_PATH="$prefix/$libdir/pkgconfig"
if [ "$kind" = static ]; then
    # Only Drypoint's own libraries: Assimp is not installed as an archive.
    flags() { pkg-config --cflags --libs --static "$1" | sed "s|-ldrypoint[a-z_]*|-l:lib&.a|g; s|lib-l|lib|g"; }
else
    flags() { pkg-config --cflags --libs "$1"; }
    export LD_LIBRARY_PATH="$prefix/$libdir"
fi
# shellcheck disable=SC2046
$cc -std=c99 "$sources/triangle.c" -o triangle $(flags drypoint)
./triangle
# shellcheck disable=SC2046
$cc -std=c99 "$sources/moving.c" -o moving $(flags drypoint)
./moving
# shellcheck disable=SC2046
$cc -std=c99 "$sources/files.c" -o files $(flags drypoint-io)
./files
if pkg-config --exists drypoint-gl; then
    # shellcheck disable=SC2046
    $cc -std=c99 -DDRYPOINT_HAS_GL "$sources/context.c" -o context $(flags drypoint-gl)
    ./context
fi
