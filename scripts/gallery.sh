#!/bin/bash
# gallery.sh PROGRAM: draws every picture of docs/gallery again, by the commands that stand beside them in
# docs/gallery/README.md. Models are kept in build/gallery. Without the Stanford dragon, from npm, its pictures stay as they are.
set -eu
program=$(realpath "$1")
cd "$(dirname "$0")/.."
mkdir -p build/gallery
commands() { sed -n '/^```sh$/,/^```$/{/^```/d;p}' docs/gallery/README.md; }
noise() { ../bench/bin/noise "$@"; }
drypoint() { "$program" "$@" --quiet; }
if scripts/dragons.sh build/gallery; then
    cmake -S . -B build -DDRYPOINT_BENCH=ON >/dev/null
    cmake --build build --target bench_noise --parallel "${JOBS:-2}" >/dev/null
else
    echo 'gallery: pictures of the dragon are left as they are' >&2
fi
cp scripts/place.awk build/gallery
cd build/gallery
rm -f ./*.png ./*.gif
# shellcheck disable=SC1090
. <(cd ../.. && commands)
# films, in blocks of bash, are ffmpeg's
films() { sed -n '/^```bash$/,/^```$/{/^```/d;p}' ../../docs/gallery/README.md; }
if command -v ffmpeg >/dev/null; then
    # shellcheck disable=SC1090
    . <(films)
    cp ./*.gif ../../docs/gallery
else
    echo 'gallery: there is no ffmpeg; films are left as they are' >&2
fi
cp ./*.png ../../docs/gallery
du -b ./*.png ./*.gif 2>/dev/null
