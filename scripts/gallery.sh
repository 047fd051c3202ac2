#!/bin/bash
# gallery.sh PROGRAM: draws every picture of docs/gallery again, by the commands that stand beside them in
# docs/gallery/README.md. Models are kept in build/gallery.
set -eu
program=$(realpath "$1")
cd "$(dirname "$0")/.."
mkdir -p build/gallery
commands() { sed -n '/^```sh$/,/^```$/{/^```/d;p}' docs/gallery/README.md; }
drypoint() { "$program" "$@" --quiet; }
cp scripts/place.awk build/gallery
cd build/gallery
rm -f ./*.png
# shellcheck disable=SC1090
. <(cd ../.. && commands)
cp ./*.png ../../docs/gallery
du -b ./*.png
