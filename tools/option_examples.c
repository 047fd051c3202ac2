/* Examples of --help TOPIC, and of the man page. tests/cli/helps.sh runs them all. */
#include "options.h"

#include <stddef.h>

#define PART "drypoint part.stl -o part.png "

const option_example option_examples[] = {
    {GROUP_PICTURE, PART "--preset blueprint", "a look"},
    {GROUP_PICTURE, PART "-o normals=n.png --size 3200x2400 --paper none", "large, on nothing"},
    {GROUP_PAGE, "drypoint part.stl --page A4 --scale 1:2 -o part.pdf", "half its size"},
    {GROUP_PAGE, "drypoint part.stl --sheet front,top,right,iso --title Bracket -o sheet.pdf",
     "four views with a title block"},
    {GROUP_CAMERA, PART "--view iso --ortho 0", "without perspective"},
    {GROUP_CAMERA, PART "--eye 3,2,4 --target 0,0,0 --fov 30", "from a point to another"},
    {GROUP_LINES, PART "--hidden dashed --width silhouette=4,ridge=2",
     "hidden lines, bold outlines"},
    {GROUP_LINES, PART "--xray 0.3 --style gooch", "see-through: a ghosted view"},
    {GROUP_PATHS, "drypoint part.stl -o part.svg --join-classes --optimize", "for a plotter"},
    {GROUP_STROKES, PART "--stroke pencil --jitter 1", "drawn by hand"},
    {GROUP_STROKES, PART "--pattern rope --width 14 --line-light lambert", "ropes in light"},
    {GROUP_SURFACE, PART "--style hatch --light 30,50", "hatched, lit from the right"},
    {GROUP_SURFACE, PART "--style gooch --mirror 0,0,1", "cool to warm, on a mirror"},
    {GROUP_SECTION, PART "--clip 1,0,0", "cut through the middle"},
    {GROUP_SECTION, PART "--clip 1,0,0 --clip 0,0,1,0.2 --section crossed", "a corner cut out"},
    {GROUP_OBJECTS, "drypoint engine.obj --list", "what there is"},
    {GROUP_OBJECTS, "drypoint engine.obj -o a.png --object 'bolt*:color=red' --without housing",
     "red bolts, no housing"},
    {GROUP_OBJECTS, "drypoint engine.obj -o a.png --explode 1 --explode-axis y", "pulled apart"},
    {GROUP_EDGE_MAP, PART "--edges both --style gooch --inner-color white", "soft white creases"},
    {GROUP_METHOD, PART "--ink quads --method paper --between interval", "Raskar 2001 as printed"},
    {GROUP_MOTION, "drypoint walk.glb --animation Walk --time 0.4 -o walk.png", "a pose"},
    {GROUP_MOTION, "drypoint shape:flag --deform wave:amplitude=0.1 --time 0.3 -o flag.png",
     "a flag that waves"},
    {GROUP_MOTION, "drypoint cylinder.obj --morph vase.obj --blend 0.5 -o half.png",
     "halfway from one to the other"},
    {GROUP_FILM, "drypoint part.stl --turn 360 -o part.mp4", "once round it, 120 frames"},
    {GROUP_FILM, "drypoint walk.glb --time 0:2 -o walk-%04d.png", "two seconds, frame by frame"},
    {GROUP_FILM, "drypoint part.stl --path way.json -o way.gif --size 480x360",
     "the camera goes through views"},
    {GROUP_PROGRAM, PART "--stats", "what was drawn, and how long it took"},
    {GROUP_PROGRAM, "drypoint scan.stl -o scan.png --memory 100M", "a file larger than memory"}};
const size_t option_example_count = sizeof option_examples / sizeof *option_examples;
