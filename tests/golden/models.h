/* Hand-made models for golden pictures: what generated ones do not have. They fit a camera whose
 * world units are pixels: x from -120 to 120, y from -90 to 90, the eye at +z. */
#ifndef DP_GOLDEN_MODELS_H
#define DP_GOLDEN_MODELS_H

#include <stddef.h>
#include <stdint.h>

enum { MODEL_CORNERS = 8192, MODEL_POLYGONS = 4096 };

/* Polygons one after the other, every corner with a vertex of its own. */
typedef struct model {
    float positions[MODEL_CORNERS][3];
    uint8_t flags[MODEL_CORNERS]; /* of the edge to the next corner */
    uint32_t firsts[MODEL_POLYGONS + 1];
    uint16_t groups[MODEL_POLYGONS];
    size_t corners, polygons;
    uint16_t group; /* of polygons that are added */
} model;

typedef void model_maker(model *m);

/* Three pages at an edge, wound in all eight ways: all to one side on the screen, two and one, one
 * and two. */
void make_fans(model *m);
/* Triangles that cross each other, some of which share a corner, some with the back to the eye. */
void make_crossing(model *m);
/* Tilted rectangles that lie in one plane, one upon the other, each of a group of its own; some of
 * them twice, some of those with the back to the eye. */
void make_sheets(model *m);
/* Upright rectangles in one plane that is seen face on, of several groups: where they overlap all
 * samples of both are at exactly one depth. */
void make_flush(model *m);
/* Planes seen nearly edge-on that cut through a floor: what they trap lies far behind it. */
void make_steep(model *m);
/* Floors and walls that meet in valleys, from shallow to steep. */
void make_valleys(model *m);
/* Pairs of lines that would be one, were they not far apart in depth; and pairs that are. */
void make_gaps(model *m);
/* Bars that end behind others, at many angles: wide strokes end there. */
void make_bars(model *m);
/* A wavy sheet of obtuse triangles. */
void make_waves(model *m);
/* Boxes that touch: faces twice in one place, four polygons at an edge. */
void make_touching(model *m);
/* Open boxes of walls without thickness, each a polygon with its back to another in its place: four
 * polygons at every edge, of which two and two have the same angle. */
void make_double(model *m);
/* Polygons that are not convex, with corners that lie on the diagonals between others, or that
 * touch their own edges. */
void make_concave(model *m);
/* Prisms some of whose faces are wound the wrong way: none, every third, every other, all. */
void make_badly_wound(model *m);
/* Open boxes and trays, a strip of T-junctions, a folded sheet. */
void make_open(model *m);

#endif
