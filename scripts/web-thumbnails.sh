#!/bin/sh
# web-thumbnails.sh DRYPOINT: draws the small pictures of the page's galleries, web/icons/shapes/NAME.webp (ink on
# nothing, so that they fit light and dark pages) and web/icons/looks/NAME.webp. Needs ImageMagick with WebP.
set -eu
[ $# -eq 1 ] || { echo "usage: scripts/web-thumbnails.sh DRYPOINT" >&2; exit 2; }
program=$(realpath "$1")
icons=$(realpath "$(dirname "$0")/../web/icons")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$icons/shapes" "$icons/looks"

# take NAME FOLDER: the drawing as a small picture of few colours
take() {
    convert "$work/large.png" -filter Lanczos -resize 50% -dither None -colors 48 \
        -define webp:lossless=true -define webp:method=6 -strip "$icons/$2/$1.webp"
}

ink='--size 352x264 --paper none --surface none --width 2.2,silhouette=4.4,border=4.4'
for shape in cube tetrahedron sphere torus cylinder gear bolt bracket stairs boxes flag torso terrain; do
    model=$shape
    more=
    case $shape in
        terrain) model=terrain:4000 more='--detail 0.5' ;;
        flag) more='--deform wave --time 0.3' ;;
    esac
    "$program" "shape:$model" -o "$work/large.png" $ink $more --quiet
    take $shape shapes
done

for look in none technical illustration cartoon engraving blueprint sketch pencil patent; do
    preset="--preset $look"
    [ $look = none ] && preset=
    # what is a share of a picture is too thin in a small one
    case $look in none | technical | blueprint | patent) preset="$preset --width 1.8,silhouette=3.6" ;; esac
    [ $look = technical ] && preset="$preset --hidden-width 1.2"
    "$program" shape:bracket -o "$work/large.png" --size 352x264 $preset --zoom 1.02 --quiet
    take $look looks
done
du -cb "$icons"/shapes/* "$icons"/looks/* | tail -1
