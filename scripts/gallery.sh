#!/bin/sh
# gallery.sh PROGRAM: draws every picture of docs/gallery again.
set -eu
cd "$(dirname "$0")/.."
exec docs/gallery/make.sh "$@"
