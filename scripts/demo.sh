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

A line drawing is in $(pwd)/demo.png

Next, try:
  $program MODEL.stl -o drawing.png                 your own STL, PLY, OBJ, OFF, glTF, FBX, 3MF, …
  $program $model -o demo.png --width silhouette=6 --color valley=#c03020
  $program make gear -o gear.ply                    more models: bolt, torus, stairs, terrain, …
  $program --help                                   everything else
  make check                                          run all tests
END
