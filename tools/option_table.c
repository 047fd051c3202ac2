/* The tables: options, commands, groups. A new option is added here and to tool_settings. */
#include "options.h"

#include <stddef.h>

#define DRAW       (1u << COMMAND_DRAW)
#define INFO       (1u << COMMAND_INFO)
#define MAKE       (1u << COMMAND_MAKE)
#define BENCH      (1u << COMMAND_BENCH)
#define VIEW       (1u << COMMAND_VIEW)
#define PICTURE    (DRAW | BENCH | VIEW)
#define EVERY      (DRAW | INFO | MAKE | BENCH | VIEW)
#define AT(member) offsetof(tool_settings, member)

const char *const output_names[OUTPUT_COUNT] = {"edge-map", "normals", "depth",
                                                "id",       "trace",   "segments"};

const char *const group_names[GROUP_COUNT] = {"Picture",
                                              "Pages",
                                              "Camera",
                                              "Lines",
                                              "Paths",
                                              "Strokes",
                                              "Surface",
                                              "Sections",
                                              "Objects",
                                              "Edge map",
                                              "How lines are found",
                                              "Motion",
                                              "Films",
                                              "Model",
                                              "Program",
                                              NULL};

const char *const group_topics[GROUP_COUNT] = {
    "picture", "page",     "camera", "lines",  "paths", "strokes", "surface", "sections",
    "objects", "edge-map", "method", "motion", "films", NULL,      "program", NULL};

const char *const models_text[] = {
    "MODEL is a file (STL, PLY, OBJ, OFF, glTF; FBX, 3MF, COLLADA and more through Assimp), - for "
    "standard input, or a generated model: shape:gear, or shape:terrain:1000000 with a number of "
    "triangles.",
    "A quoted pattern like 'parts/*.stl' stands for the files that it fits.",
    "Several models are one scene: what one of them hides of another is hidden, and where they "
    "cross "
    "is a line. With %s in the name of each output, as in -o '%s.png', each model has a drawing of "
    "its own, and %s is its file's name without folder and ending; %% is a percent sign there. One "
    "that fails does not stop the others.",
    NULL};

/* clang-format off */
const option option_table[] = {
    {"output", 'o', "FILE or NAME=FILE", OPTION_OUTPUT, GROUP_PICTURE, DRAW | MAKE, AT(output), 0, 0, 0,
     "Where the result goes: a drawing to FILE.png, .svg, .pdf, .eps, .dxf or .json, once for each file; a film as --frames says; a model to "
     "FILE.ply, .stl or .obj. An old file stays until the new one is whole. - is standard output (a PNG unless "
     "--format says otherwise, or a PLY). NAME=FILE.png, once for each "
     "NAME, writes what shading and edges are made from, beside the drawing or alone: edge-map (inner edges in RGB, "
     "profile edges in A), normals, depth, id. trace=FILE writes the visible lines as text: chains of segments, "
     "with their edges and what ends them. segments=FILE.json writes the paths of the drawing. %s in a name stands for the "
     "model's, for a drawing of each of several models."},
    {"format", 0, "png|svg|pdf|eps|dxf|json|rgba|mp4|webm|gif|apng", OPTION_WORD, GROUP_PICTURE, DRAW, AT(format), 0, 0, 0,
     "How outputs are written whose name does not end so: -, devices and pipes. Default: png."},
    {"preset", 0, "technical|illustration|cartoon|engraving|blueprint|sketch|pencil|patent|iso|patent-us|patent-epc|axidraw|laser",
     OPTION_WORD, GROUP_PICTURE, PICTURE, AT(preset), 0, 0, 0,
     "A look: options that go together; those on the command line change it."},
    {"size", 0, "WxH", OPTION_SIZE, GROUP_PICTURE, DRAW | BENCH, AT(width), 0, 1, 32768,
     "Width and height of the picture in pixels. Default: 1600x1200. With --page, the page says it."},
    {"size", 0, "WxH", OPTION_SIZE, GROUP_PICTURE, VIEW, AT(width), 0, 64, 16384,
     "Width and height of the picture in the window, in pixels. Default: 1200x900, or what the screen has room for."},
    {"samples", 0, "1|4|8|16", OPTION_WORD, GROUP_PICTURE, PICTURE, AT(samples), 0, 0, 0,
     "Samples per pixel. Default: 4."},
    {"paper", 0, "COLOR|none", OPTION_COLOR, GROUP_PICTURE, PICTURE, AT(style.paper), 0, 0, 0,
     "Colour of the background; none is transparent. Default: white."},
    {"surface", 0, "COLOR|none", OPTION_COLOR, GROUP_PICTURE, PICTURE, AT(style.surface), 0, 0, 0,
     "Colour of the model's faces; none lets the paper show through, but still hides lines; "
     "with alpha it is mixed with the paper. Default: white."},

    {"page", 0, "NAME|WxHmm|none", OPTION_PAGE, GROUP_PAGE, DRAW, AT(page), 0, 0, 0,
     "Draw on a page: A0 to A5, letter, legal, tabloid, or a size like 200x100mm (or cm, in). A4-landscape and "
     "A4-portrait say how it lies; else it lies as the model's picture does, and a sheet is wide. A PNG is the "
     "whole page. Default: none, or A4 with --sheet."},
    {"landscape", 0, NULL, OPTION_FLAG, GROUP_PAGE, DRAW, AT(landscape), 0, 0, 0,
     "The page is wider than tall."},
    {"margin", 0, "MM or TOP,RIGHT,BOTTOM,LEFT", OPTION_MARGIN, GROUP_PAGE, DRAW, AT(margin), AT(has_margin), 0, 1000,
     "Margins of the page in millimetres. Default: 10."},
    {"scale", 0, "PAPER:MODEL|fit", OPTION_SCALE, GROUP_PAGE, DRAW, AT(scale), AT(has_scale), 0, 0,
     "1:10 draws a tenth of the model's size, 2:1 twice it, with an orthographic camera; fit makes it as large as "
     "the page allows (on a sheet: the largest standard scale). Without --page and --size the page is as large as "
     "the drawing and its margins. Default: fit."},
    {"unit", 0, "mm|cm|m|in|ft", OPTION_WORD, GROUP_PAGE, DRAW, AT(unit), 0, 0, 0,
     "With --scale or --sheet: what one unit of the model is. Default: mm."},
    {"dpi", 0, "N", OPTION_COUNT, GROUP_PAGE, DRAW, AT(dpi), 0, 10, 4800,
     "Pixels per inch: of PNGs, and of lengths in pixels. Default: 150 with --page, --scale or --sheet, else 96."},
    {"sheet", 0, "VIEW,...", OPTION_SHEET, GROUP_PAGE, DRAW, AT(sheet), 0, 0, 0,
     "Draw several views on one page, aligned and in one scale, with frame and title block: any of front, back, "
     "left, right, top, bottom, iso. --up says what is up in the front view, and the other views turn with it."},
    {"angle", 0, "first|third", OPTION_WORD, GROUP_PAGE, DRAW, AT(angle), 0, 0, 0,
     "With --sheet: in first-angle projection the top view lies below the front view, in third-angle projection "
     "above it. Default: third."},
    {"title", 0, "TEXT", OPTION_TEXT, GROUP_PAGE, DRAW, AT(title), 0, 0, 0,
     "Title of the drawing, in the title block and in the file. Default: the model's name."},

    {"eye", 0, "X,Y,Z", OPTION_POINT, GROUP_CAMERA, PICTURE, AT(eye), AT(has_eye), 0, 0,
     "Where the eye is. With --target as well nothing is fitted to the model; alone, the eye looks at "
     "the model's centre."},
    {"target", 0, "X,Y,Z", OPTION_POINT, GROUP_CAMERA, PICTURE, AT(target), AT(has_target), 0, 0,
     "The point the eye looks at; alone, the eye moves back until the model is seen whole."},
    {"up", 0, "x|y|z|-x|-y|-z|X,Y,Z", OPTION_UP, GROUP_CAMERA, PICTURE, AT(up), AT(has_up), 0, 0,
     "What is up in the picture; --view, --azimuth, --elevation and --sheet turn with it. Default: what the file "
     "says (glTF, COLLADA, FBX), z for STL and 3MF, else y."},
    {"fov", 0, "DEG", OPTION_INSIDE, GROUP_CAMERA, PICTURE, AT(fov), AT(has_fov), 0, 180,
     "Vertical field of view. Default: 35; with --eye alone, what shows the model whole."},
    {"ortho", 0, "HEIGHT", OPTION_NUMBER, GROUP_CAMERA, PICTURE, AT(ortho), AT(has_ortho), 0, 1e30,
     "Orthographic projection; HEIGHT is what is seen, in the model's units, 0 is fitted."},
    {"view", 0, "front|back|left|right|top|bottom|iso",
     OPTION_WORD, GROUP_CAMERA, PICTURE, AT(view), 0, 0, 0,
     "Look from this side. With y up, front is +z and right +x; with z up, front is -y and right +x. Default: a "
     "three-quarter view from the right, the front and above (1,0.6,1 with y up)."},
    {"azimuth", 0, "DEG",
     OPTION_NUMBER, GROUP_CAMERA, PICTURE, AT(azimuth), AT(has_azimuth), -1e6, 1e6,
     "Walk round the model: 0 is the front, 90 the right side. Default: 45, or the view's."},
    {"elevation", 0, "DEG",
     OPTION_NUMBER, GROUP_CAMERA, PICTURE, AT(elevation), AT(has_elevation), -90, 90,
     "Look from above (90) or below (-90). Default: 23, or the view's."},
    {"zoom", 0, "F", OPTION_INSIDE, GROUP_CAMERA, PICTURE, AT(zoom), 0, 0, 1e6,
     "2 shows everything twice as large. Default: 1."},

    {"lines", 0, "CLASS,...|all|none", OPTION_LINES, GROUP_LINES, PICTURE, AT(style), 0, 0, 0,
     "Classes to draw: silhouette, ridge, valley, intersection, border, section, hatching. Default: all."},
    {"width", 0, "W or CLASS=W,...", OPTION_WIDTHS, GROUP_LINES, PICTURE, AT(width_of), 0, 0.5, 64,
     "Whole width of the lines, of all classes (hatching has half of it) or of each: pixels, 0.5mm or 1pt (without --page "
     "and --dpi an inch is 96 pixels), or 0.2%, a share of the picture's smaller side. Default: outlines, borders and "
     "sections 0.25%, the others half of it; on pages 0.5mm and 0.25mm, on sheets 0.5mm, hatching 0.25mm."},
    {"color", 0, "COLOR or CLASS=COLOR,...",
     OPTION_COLORS, GROUP_LINES, PICTURE, AT(style), 0, 0, 0,
     "Colour of the lines, of all classes or of each: #RRGGBB or #RGB, with alpha #RRGGBBAA or #RGBA, or a CSS name "
     "like steelblue. Default: black."},
    {"ridge-angle", 0, "DEG", OPTION_INSIDE, GROUP_LINES, PICTURE, AT(ridge_angle), 0, 0, 360,
     "Edges whose dihedral angle is at most this are ridges; 180 is flat. Default: 150."},
    {"valley-angle", 0, "DEG", OPTION_INSIDE, GROUP_LINES, PICTURE, AT(valley_angle), 0, 0, 360,
     "Edges whose dihedral angle is above this are valleys. Default: 210."},

    {"detail", 0, "exact|auto|F", OPTION_DETAIL, GROUP_LINES, PICTURE, AT(detail), AT(has_detail), 0.01, 100,
     "How much is drawn of scans, sculptures and coarse models. exact draws every line that the polygons make; auto "
     "what a person would draw at this size: it leaves out creases and outlines that come of noise or of the mesh, and "
     "lets weak ones thin out; F is times as fine: 2 draws more, 0.5 less. Machine parts stay as they are. Default: "
     "auto."},
    {"smooth", 0, "off|auto|1|2|3|4|5|6", OPTION_WORD, GROUP_LINES, PICTURE, AT(smooth), 0, 0, 0,
     "Round off coarse models: triangles become curved patches (PN triangles, Vlachos et al. 2001) over their corners' "
     "normals, each curved edge with that many points between its ends, or as many as its size in the picture needs. "
     "Hard edges stay. Default: off."},
    {"smooth-what", 0, "surface|silhouettes", OPTION_WORD, GROUP_LINES, PICTURE, AT(smooth_what), 0, 0, 0,
     "With --smooth: the whole surface, with its folds and shading, or only what lies near silhouettes, as Raskar 2001 "
     "has it, which is faster. Default: surface."},

    {"hidden", 0, "dashed|dotted|thin|solid|none", OPTION_WORD, GROUP_LINES, PICTURE, AT(hidden), 0, 0, 0,
     "Draw lines that something hides, too, below the visible ones: dashed, dotted, whole but thin, or as wide as "
     "these. Default: none; on sheets dashed, but for the pictorial view."},
    {"levels", 0, "N", OPTION_COUNT, GROUP_LINES, PICTURE, AT(levels), 0, 1, DP_LEVELS,
     "With --hidden: how many surfaces are counted before a line; what lies behind N or more has level N. "
     "Default: 1."},
    {"hidden-smooth", 0, NULL, OPTION_FLAG, GROUP_LINES, PICTURE, AT(hidden_smooth), 0, 0, 0,
     "With --hidden: draw folds of less than 40 degrees as well."},
    {"hidden-width", 0, "W or [CLASS][:LEVEL]=W,...",
     OPTION_HIDDEN_WIDTHS, GROUP_LINES, PICTURE, AT(hidden_width), 0, 0.5, 64,
     "Width of hidden lines, of all, or of a class, a level or both, as in ridge:2=1mm. Default: that of ridges; half of "
     "a --width, or of that with --hidden thin; with --hidden solid, the visible line's."},
    {"hidden-color", 0, "COLOR or [CLASS][:LEVEL]=COLOR,...",
     OPTION_HIDDEN_COLORS, GROUP_LINES, PICTURE, AT(style), 0, 0, 0,
     "Colour of hidden lines, in the same way. Default: the visible line's."},

    {"xray", 0, "ALPHA", OPTION_NUMBER, GROUP_LINES, PICTURE, AT(xray), 0, 0, 1,
     "X-ray: surfaces are see-through, each of this opacity, and lines behind them shine through, fainter with each "
     "surface above; 1: opaque. --hidden and its options say how those lines look. Default: 0, which is off."},
    {"xray-layers", 0, "N", OPTION_COUNT, GROUP_LINES, PICTURE, AT(xray_layers), 0, 1, DP_LEVELS,
     "With --xray: how many surfaces are told apart in a pixel's sample; what lies deeper is not drawn. Default: 8."},

    {"join", 0, "PX", OPTION_LENGTH, GROUP_PATHS, DRAW, AT(join), 0, 0, 10000,
     "Close gaps between paths up to this (or 0.5mm, 1pt, 0.2%); 0 closes none. Default: 2."},
    {"min-length", 0, "PX", OPTION_LENGTH, GROUP_PATHS, DRAW, AT(min_length), 0, 0, 10000,
     "Leave out paths shorter than this; 0 leaves out none. Default: 1."},
    {"tolerance", 0, "PX", OPTION_LENGTH, GROUP_PATHS, DRAW, AT(tolerance), 0, 0, 10000,
     "Leave out points where the path stays this near to them; 0 leaves out none. Default: 0.02."},
    {"join-classes", 0, NULL, OPTION_FLAG, GROUP_PATHS, DRAW, AT(join_classes), 0, 0, 0,
     "Let paths go on from one class of lines to another."},
    {"keep-coincident", 0, NULL, OPTION_FLAG, GROUP_PATHS, DRAW, AT(keep_coincident), 0, 0, 0,
     "Write lines that lie on other lines, too."},
    {"optimize", 0, NULL, OPTION_FLAG, GROUP_PATHS, DRAW, AT(optimize), 0, 0, 0,
     "Put paths in an order in which a pen travels little between them, and say what that saves."},
    {"ground", 0, "png|none", OPTION_WORD, GROUP_PATHS, DRAW, AT(ground), 0, 0, 0,
     "Put the surface under the lines of vector files, as pixels. Default: none."},

    {"stroke", 0, "NAME|FILE.png", OPTION_TEXT, GROUP_STROKES, PICTURE, AT(stroke), 0, 0, 0,
     "Draw lines with a texture: pencil, brush, charcoal, ink, dashes, dots (and those of --pattern), or any PNG (black is ink, or its alpha)."},
    {"stroke-u", 0, "arc|polar", OPTION_WORD, GROUP_STROKES, PICTURE, AT(stroke_u), 0, 0, 0,
     "Lay textures along lines by their length, or by the angle and distance from the model's centre (Hermosilla and "
     "Vazquez 2010). Default: arc; with --edges adjacency, polar."},
    {"stroke-k", 0, "F", OPTION_NUMBER, GROUP_STROKES, PICTURE, AT(stroke_k), AT(has_stroke_k), -100, 100,
     "Polar: weight of the distance, per half a picture height; 0 for round models. Default: 0.5."},
    {"stroke-scale", 0, "F", OPTION_INSIDE, GROUP_STROKES, PICTURE, AT(stroke_scale), 0, 0, 1000,
     "How many times longer than natural textures are. Default: 1."},
    {"pattern", 0, "NAME|FILE.png", OPTION_TEXT, GROUP_STROKES, PICTURE, AT(pattern), 0, 0, 0,
     "Lay a texture on lines as if it were on the model, in perspective: dashes, dots, rope, waves, checks, chevrons, "
     "lace, meander, any other of --stroke, or any PNG. In place of --stroke; and with --ink quads too, where outlines "
     "have its top at the edge and its bottom outside."},
    {"pattern-length", 0, "PX", OPTION_LENGTH, GROUP_STROKES, PICTURE, AT(pattern_length), 0, 1, 100000,
     "Length of one repeat in the middle of the model (or 5mm, 10pt, 1%); farther off it is shorter. Default: natural, "
     "as the texture is to its height, so it is to the line's width."},
    {"pattern-units", 0, "F", OPTION_INSIDE, GROUP_STROKES, PICTURE, AT(pattern_units), 0, 0, 1e30,
     "Length of one repeat in the model's own units, in place of --pattern-length."},
    {"pattern-space", 0, "object|screen", OPTION_WORD, GROUP_STROKES, PICTURE, AT(pattern_space), 0, 0, 0,
     "Patterns lie on the model, or are equally long all over the picture. Default: object."},
    {"line-light", 0, "off|lambert|toon|gooch", OPTION_WORD, GROUP_STROKES, PICTURE, AT(line_light), 0, 0, 0,
     "Light (--light) on lines, by what they lie on: from the line's colour to the paper's, smoothly or in three "
     "steps; or from cool to warm. Default: off."},
    {"lit-color", 0, "COLOR", OPTION_COLOR, GROUP_STROKES, PICTURE, AT(lit_color), 0, 0, 0,
     "With --line-light: the colour of lines in full light. Default: four fifths of the way to the paper's."},
    {"taper", 0, "PX", OPTION_LENGTH, GROUP_STROKES, PICTURE, AT(taper), 0, 0, 10000,
     "Strokes thin out over this length (or 5mm, 10pt, 1%) at both ends. Default: what suits --stroke."},
    {"jitter", 0, "PX", OPTION_LENGTH, GROUP_STROKES, PICTURE, AT(jitter), 0, 0, 64,
     "How far the hand is off the line, about. Default: what suits --stroke."},
    {"overshoot", 0, "PX", OPTION_LENGTH, GROUP_STROKES, PICTURE, AT(overshoot), 0, 0, 1000,
     "How far strokes run on beyond their ends. Default: what suits --stroke."},
    {"repeats", 0, "N", OPTION_COUNT, GROUP_STROKES, PICTURE, AT(repeats), 0, 1, 8,
     "Draw each line so often, each time with other small errors. Default: 1."},
    {"width-by-depth", 0, "F", OPTION_NUMBER, GROUP_STROKES, PICTURE, AT(width_by_depth), 0, 0, 1,
     "How much thinner the farthest lines are than the nearest, from 0 to 1. Default: 0."},
    {"width-by-light", 0, "F", OPTION_NUMBER, GROUP_STROKES, PICTURE, AT(width_by_light), 0, 0, 1,
     "How much thinner lines on the lit side are, from 0 to 1. Default: 0."},
    {"seed", 0, "N", OPTION_COUNT, GROUP_STROKES, PICTURE, AT(seed), 0, 0, 4294967295.0,
     "Another number makes other errors of the hand, and another texture of the same kind. Default: 0."},

    {"style", 0, "paper|flat|lambert|gooch|toon|hatch|halftone|pencil",
     OPTION_WORD, GROUP_SURFACE, PICTURE, AT(shading), 0, 0, 0,
     "How surfaces look: the paper's colour, one colour, in light, cool to warm, cartoon, strokes, dots, pencil. "
     "Default: flat."},
    {"light", 0, "AZ,EL", OPTION_ANGLES, GROUP_SURFACE, PICTURE, AT(light), AT(has_light), -1e6, 1e6,
     "Where the light comes from, in degrees as the camera sees it: 0,0 from the eye, AZ to the right, EL from "
     "above. Default: -40,42."},
    {"model-colors", 0, "on|off", OPTION_WORD, GROUP_SURFACE, PICTURE, AT(model_colors), 0, 0, 0,
     "Surfaces have the model's colours: of its vertices (PLY, OFF, OBJ, glTF, and formats read through Assimp), faces (PLY, OFF) or "
     "materials (an OBJ's .mtl files, and those formats); textures are not drawn. "
     "Default: on where there is light (lambert, gooch, toon, hatch, halftone) and no --surface."},
    {"normals", 0, "model|smooth|facet", OPTION_WORD, GROUP_SURFACE, PICTURE, AT(normals), 0, 0, 0,
     "What is shaded: the model's normals (made where it has none), made ones, or those of its polygons. "
     "Default: model."},
    {"crease-angle", 0, "DEG", OPTION_INSIDE, GROUP_SURFACE, PICTURE, AT(crease_angle), 0, 0, 180,
     "Where normals are made: folds up to this are smoothed. Default: 40."},
    {"highlight", 0, "F", OPTION_NUMBER, GROUP_SURFACE, PICTURE, AT(highlight), 0, 0, 1,
     "Strength of a highlight. Default: 0."},
    {"gooch-plain", 0, NULL, OPTION_FLAG, GROUP_SURFACE, PICTURE, AT(gooch_plain), 0, 0, 0,
     "With --style gooch: leave the surface's colour out."},
    {"shade-texture", 0, "FILE", OPTION_TEXT, GROUP_SURFACE, PICTURE, AT(shade_texture), 0, 0, 0,
     "With --style toon: a PNG whose middle row holds the shades, from dark to light."},
    {"cartoon-map", 0, "on|off", OPTION_WORD, GROUP_SURFACE, PICTURE, AT(cartoon_map), 0, 0, 0,
     "With --style toon: smooth the jaggies between shades. Default: on."},
    {"strokes", 0, "FILE", OPTION_TEXT, GROUP_SURFACE, PICTURE, AT(strokes), 0, 0, 0,
     "With --style hatch or halftone: a PNG of strokes, repeated; darker ones are drawn first. With --style pencil: "
     "a PNG of pencil strokes from left to right."},
    {"pencil-s", 0, "F", OPTION_NUMBER, GROUP_SURFACE, PICTURE, AT(pencil_s), AT(has_pencil_s), 0, 100,
     "With --style pencil: how much darker shadows are; tone = brightness ^ ((1 - N.L) S + O). Default: 2.6."},
    {"pencil-o", 0, "F", OPTION_NUMBER, GROUP_SURFACE, PICTURE, AT(pencil_o), AT(has_pencil_o), 0, 100,
     "With --style pencil: how dark all is. Default: 0.12."},
    {"pencil-tones", 0, "N", OPTION_COUNT, GROUP_SURFACE, PICTURE, AT(pencil_tones), 0, 2, 8,
     "With --style pencil: that many textures from bare to dark, instead of S and O (Lee et al. 2006)."},
    {"pencil-turns", 0, "steps|printed", OPTION_WORD, GROUP_SURFACE, PICTURE, AT(pencil_turns), 0, 0, 0,
     "With --style pencil: let neighbours share directions, or turn strokes by each exact angle, as printed. "
     "Default: steps."},
    {"hatch-space", 0, "screen|object", OPTION_WORD, GROUP_SURFACE, PICTURE, AT(hatch_space), 0, 0, 0,
     "Strokes lie on the picture, or stick to the surface. Default: screen."},
    {"hatch-scale", 0, "F", OPTION_NUMBER, GROUP_SURFACE, PICTURE, AT(hatch_scale), 0, 0.05, 50,
     "2: strokes twice as wide and as far apart. Default: 1."},
    {"hatch-color", 0, "COLOR", OPTION_COLOR, GROUP_SURFACE, PICTURE, AT(hatch_color), 0, 0, 0,
     "Colour of strokes and dots. Default: black."},

    {"edges", 0, "emergent|adjacency|map|both|none", OPTION_WORD, GROUP_LINES, PICTURE, AT(edges), 0, 0, 0,
     "Where lines come from: found in each tile as they emerge, with nothing known about neighbours; by adjacency "
     "that is built once per model (Hermosilla and Vazquez 2010); the edge map (Nienhaus and Doellner 2003); emergent "
     "lines and the map; nowhere. Default: emergent; both with --edge-map."},
    {"clip", 0, "NX,NY,NZ[,D]", OPTION_CLIP, GROUP_SECTION, PICTURE, AT(section), 0, 0, 0,
     "Cut the model open, up to eight times: takes away what lies on the side that N points to, of the plane through "
     "all points whose product with N is D; without D, through the model's middle. N points to the eye, then: 0,0,1,2 "
     "takes away what lies above z = 2. What was cut through is filled and hatched."},
    {"section", 0, "hatched|crossed|plain|open", OPTION_WORD, GROUP_SECTION, PICTURE, AT(section.look), 0, 0, 0,
     "With --clip: cut faces show parallel lines, crossed ones, only their colour; or are left open, so that one looks "
     "into the model. Default: hatched."},
    {"section-angle", 0, "DEG", OPTION_NUMBER, GROUP_SECTION, PICTURE, AT(section.angle), AT(section.has_angle), -360, 360,
     "With --clip: the lines' angle to the horizontal. Parts beside each other have them at another angle or distance. "
     "Default: 45."},
    {"section-spacing", 0, "D|N%", OPTION_SPACING, GROUP_SECTION, PICTURE, AT(section), 0, 0, 0,
     "With --clip: distance of the lines in the model's units, or as a share of its size. Default: 1.7%."},
    {"section-color", 0, "COLOR", OPTION_COLOR, GROUP_SECTION, PICTURE, AT(style.section), 0, 0, 0,
     "With --clip: colour of cut faces. Default: that of the model's faces."},
    {"mirror", 0, "NX,NY,NZ[,D]", OPTION_PLANE, GROUP_SURFACE, PICTURE, AT(mirror), 0, 0, 0,
     "A square mirror in the plane through all points whose product with N is D; without D, where the model touches "
     "it. 0,1,0 is a floor."},
    {"mirror-size", 0, "S", OPTION_INSIDE, GROUP_SURFACE, PICTURE, AT(mirror_size), 0, 0, 1e30,
     "Side of the mirror, in the model's units. Default: half as much again as the model's largest side."},
    {"mirror-fade", 0, "S", OPTION_NUMBER, GROUP_SURFACE, PICTURE, AT(mirror_fade), 0, 0, 1e30,
     "Distance from the mirror at which images have faded away. Default: they do not fade."},
    {"mirror-tint", 0, "COLOR", OPTION_COLOR, GROUP_SURFACE, PICTURE, AT(mirror_tint), 0, 0, 0,
     "Colour of the mirror. Default: white."},
    {"mirror-tint-share", 0, "F", OPTION_NUMBER, GROUP_SURFACE, PICTURE, AT(mirror_tint_share), AT(has_mirror_tint_share), 0, 1,
     "How much of it there is, from 0 to 1. Default: 0; with --mirror-tint, 0.25."},

    {"object", 0, "NAME,...:SETTING,...", OPTION_OBJECT, GROUP_OBJECTS, PICTURE, AT(objects), 0, 0, 0,
     "Give objects of the model (its groups, nodes, or models of a scene) a look of their own, as in "
     "'bolt*:color=#c03020,width=2,ridge=1' and 'housing:xray=0.3'. Settings are color, width, lines, surface, xray, "
     "section-color, hidden-color, hidden-width, ridge-angle and valley-angle, with the values of these options, and hide. "
     "May be given several times: a later one changes what an earlier one said. In names * stands for any letters, ? for one; \\ takes its meaning from the "
     "next letter, as in \\, or \\*. A name is a whole one or a part between slashes: car/wheel, car or wheel of "
     "car/wheel/tyre."},
    {"only", 0, "NAME,...", OPTION_NAMES, GROUP_OBJECTS, PICTURE | INFO, AT(only), 0, 0, 0,
     "Draw these objects alone. May be given several times."},
    {"without", 0, "NAME,...", OPTION_NAMES, GROUP_OBJECTS, PICTURE | INFO, AT(without), 0, 0, 0,
     "Leave these objects out. May be given several times."},
    {"explode", 0, "F", OPTION_NUMBER, GROUP_OBJECTS, PICTURE | INFO, AT(explode), AT(has_explode), 0, 1e6,
     "Pull the model apart: each part is moved away from the model's centre by F times its distance from there. Parts are "
     "the models of a scene, or objects whose names begin alike, up to a slash."},
    {"explode-axis", 0, "x|y|z", OPTION_WORD, GROUP_OBJECTS, PICTURE | INFO, AT(explode_axis), 0, 0, 0,
     "With --explode: move parts along this axis alone."},
    {"list", 0, NULL, OPTION_FLAG, GROUP_OBJECTS, DRAW, AT(list), 0, 0, 0,
     "Draw nothing, but print the model's objects: polygons, colour and name of each; with --json as JSON."},

    {"edge-map", 0, "diagonal|c1", OPTION_WORD, GROUP_EDGE_MAP, PICTURE, AT(edge_map), 0, 0, 0,
     "How steps in the G-buffer are found: four diagonal samples, or the C1-discontinuity operator in three "
     "passes. Default: diagonal."},
    {"c1-passes", 0, "N", OPTION_COUNT, GROUP_EDGE_MAP, PICTURE, AT(c1_passes), 0, 1, 3,
     "With --edge-map c1: only the first passes, to look at them. Default: 3."},
    {"edge-measure", 0, "scaled|paper", OPTION_WORD, GROUP_EDGE_MAP, PICTURE, AT(edge_measure), 0, 0, 0,
     "Measure steps in pixel sizes beyond what the slope explains, or as printed, between near and far and "
     "without thresholds. Default: scaled."},
    {"precision", 0, "float|8", OPTION_WORD, GROUP_EDGE_MAP, PICTURE, AT(precision), 0, 0, 0,
     "Keep normals and distances as floats or, as the paper does, in 8 bits. Default: float."},
    {"edge-radius", 0, "PX", OPTION_COUNT, GROUP_EDGE_MAP, PICTURE, AT(edge_radius), 0, 1, 4,
     "How far the samples lie from the pixel: about the width of edges. Default: 1."},
    {"edge-sides", 0, "near|both", OPTION_WORD, GROUP_EDGE_MAP, PICTURE, AT(edge_sides), 0, 0, 0,
     "Profile edges on the nearer side of a step, or on both. Default: near."},
    {"edge-groups", 0, "on|off", OPTION_WORD, GROUP_EDGE_MAP, PICTURE, AT(group_edges), 0, 0, 0,
     "Profile edges where objects or materials meet. Default: on."},
    {"inner-angle", 0, "DEG", OPTION_INSIDE, GROUP_EDGE_MAP, PICTURE, AT(inner_angle), 0, 0, 180,
     "Angle between neighbouring normals at which an inner edge begins. Default: 24."},
    {"inner-softness", 0, "F", OPTION_NUMBER, GROUP_EDGE_MAP, PICTURE, AT(inner_softness), 0, 0.001, 2,
     "How slowly inner edges become strong. Default: 0.25."},
    {"profile-depth", 0, "PX", OPTION_NUMBER, GROUP_EDGE_MAP, PICTURE, AT(profile_depth), 0, 0.01, 1e6,
     "Step in distance, in pixel sizes, that makes a whole profile edge. Default: 6."},
    {"profile-softness", 0, "F", OPTION_NUMBER, GROUP_EDGE_MAP, PICTURE, AT(profile_softness), 0, 0.001, 1,
     "How slowly profile edges become strong. Default: 0.5."},
    {"inner-color", 0, "COLOR", OPTION_COLOR, GROUP_EDGE_MAP, PICTURE, AT(inner_color), 0, 0, 0,
     "Colour of inner edges. Default: black."},
    {"profile-color", 0, "COLOR", OPTION_COLOR, GROUP_EDGE_MAP, PICTURE, AT(profile_color), 0, 0, 0,
     "Colour of profile edges. Default: black."},
    {"enhance", 0, "NAME,...", OPTION_TEXT, GROUP_EDGE_MAP, PICTURE, AT(enhance), 0, 0, 0,
     "Only these objects, groups or materials have edges from the map; names as those of --only. Default: all."},

    {"method", 0, "exact|paper", OPTION_WORD, GROUP_METHOD, PICTURE, AT(method), 0, 0, 0,
     "With --ink quads: build added polygons on the screen, exact in pixels, or by the formulas of "
     "Raskar 2001 as printed. Default: exact."},
    {"between", 0, "plane|interval|stencil",
     OPTION_WORD, GROUP_METHOD, PICTURE, AT(between), 0, 0, 0,
     "With --ink quads: how valleys and intersections are told from what is hidden: by planes, by the "
     "paper's two depth buffers, or by its appendix's stencil. Default: plane."},
    {"ink", 0, "strokes|quads", OPTION_WORD, GROUP_METHOD, PICTURE, AT(ink), 0, 0, 0,
     "Draw the visible pieces of lines as strokes, or let the added polygons be the line, as in the "
     "paper. Default: strokes."},
    {"passes", 0, "1|2", OPTION_WORD, GROUP_METHOD, PICTURE, AT(passes), 0, 0, 0,
     "With --ink quads: passes over the polygons of a tile; --between plane takes 2, interval 1 or 2, "
     "stencil its own 3. Default: what --between needs. With --ink strokes: how often a model that does "
     "not fit into --memory is read; 1 is faster, works in a pipe with --eye and --target, and judges "
     "what is hidden by the picture's samples. Default: 2."},
    {"edge-table", 0, "on|off", OPTION_WORD, GROUP_METHOD, PICTURE, AT(edge_table), 0, 0, 0,
     "With --ink strokes: resolve edges by a small table per tile where that is possible, or look for "
     "what lies across every edge on the screen. Default: on."},
    {"gl", 0, NULL, OPTION_FLAG, GROUP_METHOD, DRAW, AT(gl), 0, 0, 0,
     "Draw by OpenGL 4.3 or later, without a window (through EGL): the same lines, found and drawn by the graphics "
     "hardware or by Mesa's llvmpipe. --detail is exact there. What OpenGL does not draw fails and is named; without "
     "--gl it is drawn. The first picture takes seconds longer: shaders are compiled, and kept by the driver."},
    {"backend", 0, "cpu|gl", OPTION_WORD, GROUP_METHOD, VIEW, AT(backend), 0, 0, 0,
     "What draws at first: the processor, or OpenGL 4.3, which has exact lines and not all looks. The key g changes "
     "it. Default: cpu."},
    {"cull-back-faces", 0, NULL, OPTION_FLAG, GROUP_METHOD, PICTURE, AT(cull_back_faces), 0, 0, 0,
     "Do not paint back faces: faster for closed models, holes in open ones."},

    {"animation", 0, "NAME|N|none", OPTION_TEXT, GROUP_MOTION, PICTURE | INFO, AT(animation), 0, 0, 0,
     "The animation that plays, by its name or number (\"drypoint info\" lists them); before its start and past its end "
     "it stands still. Of several models each plays its own. Default: none, and with --time, or in a film whose camera stands, the first."},
    {"time", 0, "T or T0:T1", OPTION_TIME, GROUP_MOTION, PICTURE | INFO, AT(time), AT(has_time), 0, 0,
     "Seconds at which a model that moves is drawn; of a film, from and to: of N frames, frame 0 is at T0, and frame k at "
     "T0 + (T1 - T0) k / N, so that a film of one round loops. Default: 0; of a film, from 0 on as long as it lasts."},
    {"deform", 0, "KIND[:NAME=VALUE,...]", OPTION_DEFORM, GROUP_MOTION, PICTURE | INFO, AT(deform),
     AT(has_deform), 0, 0,
     "Move the model's vertices: wave, like a flag in the wind; breathe: it swells and sinks, like a chest; twist: it is "
     "turned around its axis, further and further. Settings, with their defaults: amplitude=0.08: how far, as a share "
     "of the model's length along its axis (wave), or of its girth (breathe); angle=90: how far a twist turns, in "
     "degrees. length: from crest to crest (0.6), how far breathing reaches to either side (0.5), over what a twist "
     "grows (1), as shares of that length. speed: waves (1), breaths (0.25) or swings (0: it stands) in a second. "
     "axis=x, y, z, -x ...: along which it goes (the longest side). across=x ...: which way waves move (the shortest "
     "side). slant=0: how much their crests lean. at=0.5: where breathing is deepest, from 0 to 1 along the axis. Of "
     "several models all parts are one. --time says when; at 0 a chest is at rest."},
    {"morph", 0, "MODEL", OPTION_TEXT, GROUP_MOTION, PICTURE | INFO, AT(morph), 0, 0, 0,
     "Blend the model with another of the same polygons (with --blend), or let it become that within a "
     "second (with --time)."},
    {"blend", 0, "F", OPTION_NUMBER, GROUP_MOTION, PICTURE | INFO, AT(blend), AT(has_blend), -1000, 1000,
     "With --morph: 0 is the model, 1 the other; below and beyond, what tells them apart is exaggerated. "
     "Default: 0.5, or the seconds of --time."},
    {"frames", 0, "N", OPTION_COUNT, GROUP_FILM, DRAW, AT(frames), 0, 1, 1000000,
     "Draw a film of that many frames: to out-%04d.png (or .svg, trace=...: any output, where %04d is the frame's number, from 0 "
     "on), or to out.mp4, .webm, .gif or .apng, by ffmpeg, or as plain pixels to .rgba. Default: as many as --time, --path "
     "or the model's own motion last, or 120 with --turn."},
    {"fps", 0, "F", OPTION_INSIDE, GROUP_FILM, DRAW, AT(fps), 0, 0, 1001,
     "Frames a second. Default: 25."},
    {"turn", 0, "DEG", OPTION_NUMBER, GROUP_FILM, DRAW, AT(turn), AT(has_turn), -36000, 36000,
     "A film in which the camera walks round the model, or round --target, from where it stands, in the sense of --azimuth. Whole "
     "rounds (360) loop; any other turn ends with its last frame."},
    {"path", 0, "FILE", OPTION_TEXT, GROUP_FILM, DRAW, AT(path), 0, 0, 0,
     "A film in which the camera goes smoothly through the views of a JSON file: {\"views\": [{\"time\": 0, \"eye\": [3, 2, 4], "
     "\"target\": [0, 0, 0], \"fov\": 35}, ...]}, with up where it is not the model's, and height instead of fov without "
     "perspective. The first view twice, at the end too, makes it loop."},
    {"frame", 0, "K", OPTION_COUNT, GROUP_FILM, DRAW, AT(frame), AT(has_frame), 0, 999999,
     "Draw only this one of a film's frames, from 0 on, as a picture."},
    {"resume", 0, NULL, OPTION_FLAG, GROUP_FILM, DRAW, AT(resume), 0, 0, 0,
     "Draw only those frames whose files are not there yet."},
    {"jobs", 0, "N", OPTION_COUNT, GROUP_FILM, DRAW, AT(jobs), 0, 1, 256,
     "Frames that are drawn side by side, in processes that share --threads. The film is the same for any number. Default: "
     "what is faster: one for each thread, or one after the other where frames are large."},

    {"triangles", 0, "N", OPTION_COUNT64, GROUP_MODEL, MAKE, AT(triangles), 0, 1, 1e11,
     "About how many triangles. Default: the shape's own number."},
    {"size", 0, "S", OPTION_INSIDE, GROUP_MODEL, MAKE, AT(shape_size), 0, 0, 1e30,
     "Largest side of the model's box. Default: 2."},
    {"seed", 0, "N", OPTION_COUNT, GROUP_MODEL, MAKE, AT(seed), 0, 0, 4294967295.0,
     "Another number makes another terrain. Default: 0."},

    {"frames", 0, "N", OPTION_COUNT, GROUP_PROGRAM, BENCH, AT(frames), 0, 1, 1000000,
     "Frames to time, after one that is not counted. Default: 10."},
    {"threads", 0, "N", OPTION_COUNT, GROUP_PROGRAM, PICTURE, AT(threads), 0, 1, 256,
     "Threads that draw. The picture is the same for any number. Default: one per processor."},
    {"memory", 0, "SIZE", OPTION_BYTES, GROUP_PROGRAM, PICTURE, AT(memory), 0, 48.0 * (1 << 20), 1e15,
     "Memory beyond the picture's own: bytes, or a number with K, M or G. A model that does not fit is "
     "not held in memory but read twice, in parts. Default: 256M; the least is 48M."},
    {"read-time", 0, "SECONDS", OPTION_INSIDE, GROUP_PROGRAM, PICTURE | INFO, AT(read_time), 0, 0, 1e6,
     "How long Assimp may take to read a file (in a process of its own: it may hang or crash on broken ones). "
     "Default: 60, and one more for each MB."},
    {"stats", 0, "[json]", OPTION_STATS, GROUP_PROGRAM, DRAW, AT(stats), 0, 0, 0,
     "Say what was drawn and how long each stage took: as a table on stderr, or as JSON on stdout "
     "(on stderr with -o -)."},
    {"json", 0, NULL, OPTION_FLAG, GROUP_PROGRAM, INFO | DRAW, AT(json), 0, 0, 0,
     "With --list, or of info: print JSON instead of a table."},
    {"quiet", 'q', NULL, OPTION_FLAG, GROUP_PROGRAM, EVERY, AT(quiet), 0, 0, 0,
     "No progress bar and no warnings."},
    {"help", 'h', NULL, OPTION_QUESTION, GROUP_PROGRAM, EVERY, QUESTION_HELP, 0, 0, 0,
     "Print a summary; followed by a topic, a command, the name of an option or \"all\", more about that."},
    {"version", 'V', NULL, OPTION_QUESTION, GROUP_PROGRAM, EVERY, QUESTION_VERSION, 0, 0, 0,
     "Print the version."},
    {"completions", 0, "bash|zsh|fish", OPTION_WORD, GROUP_PROGRAM, DRAW, AT(completions), 0, 0, 0,
     "Print what completes these options in a shell, to be read by it: source <(drypoint --completions bash)."},
    {"spin", 0, "N", OPTION_COUNT, GROUP_PROGRAM, VIEW, AT(spin), 0, 1, 1000000,
     "Turn the model once round in N frames, as fast as they can be drawn, print how many a second that are, and end."},
    {"dropped", 0, "FILE", OPTION_TEXT, GROUP_HIDDEN, VIEW, AT(dropped), 0, 0, 0,
     "Take a file as if it was dropped on the window, once the model is there."},
    {"man", 0, NULL, OPTION_QUESTION, GROUP_HIDDEN, EVERY, QUESTION_MAN, 0, 0, 0,
     "Print the man page."},
};
const size_t option_count = sizeof option_table / sizeof *option_table;
_Static_assert(sizeof option_table / sizeof *option_table <= OPTIONS_MOST, "make OPTIONS_MOST more");

const command_text command_table[COMMAND_COUNT] = {
    [COMMAND_DRAW] = {"",
                      "MODEL... -o OUT.png|svg|pdf|... [options]",
                      "Draw a model's silhouettes, ridges, valleys, intersections and borders.",
                      {"drypoint fandisk.obj -o fandisk.png", "good defaults",
                       "drypoint part.stl -o part.png --view iso --ortho 0 --width silhouette=4,ridge=2",
                       "technical drawing, bold outline",
                       "drypoint part.stl -o part.svg -o part.dxf", "the lines as paths",
                       "drypoint part.stl --page A4 --scale 1:2 -o part.pdf", "half its size, to print",
                       "drypoint part.stl --sheet front,top,right,iso --title Bracket -o sheet.pdf",
                       "four views with a title block",
                       "drypoint gear.stl shaft.obj -o scene.png", "two files, one scene",
                       "drypoint 'parts/*.stl' -o '%s.svg'", "a drawing for each of many files",
                       "drypoint shape:gear -o gear.png --color valley=#3060A0 --surface '#F4F0E8'",
                       "a generated model, in colour",
                       "drypoint gear.stl --turn 360 -o gear.mp4", "a film, by ffmpeg",
                       "drypoint scan.stl -o scan.png --memory 100M", "a file larger than memory",
                       "drypoint - -o - < model.ply > model.png", "in a pipe", NULL}},
    [COMMAND_INFO] = {"info",
                      "MODEL... [--json]",
                      "Say what is in a model: polygons, extent, open edges, what would be dropped.",
                      {"drypoint info engine.glb", "a table",
                       "drypoint info --json part.stl | jq .polygons", "for programs", NULL}},
    [COMMAND_MAKE] = {"make",
                      "SHAPE -o FILE [options]",
                      "Write a generated model: PLY, STL or OBJ, by the file's ending.",
                      {"drypoint make gear -o gear.ply", "the shape's own number of triangles",
                       "drypoint make terrain -o hills.stl --triangles 10000000 --seed 7",
                       "ten million triangles", NULL}},
    [COMMAND_BENCH] = {"bench",
                       "MODEL... [--frames N] [options]",
                       "Time the drawing of a model; JSON on stdout, times in milliseconds.",
                       {"drypoint bench dragon.ply --frames 20 --size 1680x1050", "median of twenty",
                        "drypoint bench shape:terrain:1000000 --threads 1", "a generated model",
                        NULL}},
    [COMMAND_VIEW] = {"view",
                      "[MODEL...] [options]",
                      "Show a model in a window: turn it, change its look, save what is seen.",
                      {"drypoint view part.stl", "the mouse turns it; ? lists the keys",
                       "drypoint view engine.glb --preset illustration --size 1680x1050", "in a look, in a large window",
                       "drypoint view gear.stl shaft.obj --backend gl", "two files, one scene, drawn by OpenGL",
                       "drypoint view", "an empty window: drop files on it", NULL}},
};
/* clang-format on */
