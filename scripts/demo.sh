#!/bin/sh
# demo.sh PROGRAM: draws a generated model to demo.png and says what to try next.
set -eu
program=$1
cd "$(dirname "$0")/.."
model=build/demo/bracket.ply
mkdir -p build/demo
"$program" make bracket -o "$model" --quiet
"$program" "$model" -o demo.png --quiet
cat <<END

A line drawing of a generated model is in $(pwd)/demo.png

What to try next:
  $program $model -o demo.png --width silhouette=6 --color valley=#c03020
  $program your-model.stl -o drawing.png     (or PLY, OBJ, OFF, glTF, FBX, 3MF, …)
  $program make gear -o gear.ply             (bolt, torus, stairs, terrain, … too)
  $program --help
  make check
END
