#!/bin/sh
# hostile.sh HOSTILE REFERENCE ALIKE: both builds of the program draw the same pictures: tiles, batches and
# chunks may be of any size. By adjacency all lines byte for byte; else but for a few points of them, as what touches an
# edge is asked of the samples beside it, which may be another tile's, and as cleaning takes its samples along chains,
# which begin where the tiles have them begin. 77 where the reference has not been built.
set -eu
hostile=$1 reference=$2 alike=$3
[ -x "$reference" ] || exit 77
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0
same() {
    name=$1
    shift
    "$hostile" "$@" --size 500x400 --threads 3 --quiet -o "$work/hostile.png"
    "$reference" "$@" --size 500x400 --quiet -o "$work/reference.png"
    case $name in
    *cleaned*) compare=$alike ;;
    *adjacency* | *extruded*) compare="cmp -s" ;;
    *) compare=$alike ;;
    esac
    if $compare "$work/hostile.png" "$work/reference.png"; then
        echo "ok $name"
    else
        echo "not ok $name"
        failed=1
    fi
}
for shape in $("$reference" make --help | sed -n 's/^  \([a-z]*\)  .*/\1/p'); do
    "$reference" make "$shape" -o "$work/$shape.ply" --quiet 2>/dev/null || continue
    same "$shape" "$work/$shape.ply"
    same "$shape, 12 px, orthographic" "$work/$shape.ply" --width 12 --ortho 3
    same "$shape, by adjacency" "$work/$shape.ply" --edges adjacency --ink strokes --detail exact
    same "$shape, by adjacency, cleaned" "$work/$shape.ply" --edges adjacency --ink strokes
    same "$shape, extruded" "$work/$shape.ply" --edges adjacency --width 12 --stroke charcoal --detail exact
    same "$shape, extruded as printed" "$work/$shape.ply" --edges adjacency --method paper --width 12 --stroke dots
    same "$shape, patterns on quads" "$work/$shape.ply" --ink quads --pattern checks --line-light toon --width 12
    # repeats are seeded by the number of a chain, which a point more or less may change
    [ "$shape" = terrain ] || same "$shape, by hand" "$work/$shape.ply" --stroke pencil --repeats 2
done
# two of its edges agree in as much of their names as the hostile build compares at first
printf 'OFF\n3 1 0\n-0.681 -0.528 0\n0.654 -0.584 0\n0.193 0.730 0\n3 0 1 2\n' >"$work/lone.off"
same "lone triangle" "$work/lone.off" --eye 0,0,4 --target 0,0,0
exit $failed
