/* What a line drawing should show: the visible feature lines of a model, computed by brute force.
 *
 * The reference has what the library does without: adjacency (positions that are the same bit for
 * bit are one vertex), every pair of crossing polygons, and a ray to the eye for every quarter
 * pixel of every line. It shares no code with the library, in double precision throughout. Polygons
 * must be convex. Running out of memory aborts: this is for tests. */
#ifndef DP_TEST_REFERENCE_H
#define DP_TEST_REFERENCE_H

#include <drypoint/drypoint.h>

/* A line's class is a dp_line, or: */
enum {
    REF_NEUTRAL = DP_LINE_COUNT, /* may be drawn or not: non-manifold or inconsistently wound edges,
                                    dihedral angles within a degree of a threshold, polygons seen
                                    edge-on, outlines of backs, contacts that are no crossings */
    REF_CLASS_COUNT
};
#define REF_MARGIN 40.0 /* px around the picture in which lines are followed too */

typedef struct ref_model ref_model;

/* Reads the source from its start; `crossings`: finds them. NULL: the source cannot be read. */
ref_model *ref_model_create(dp_source *source, bool crossings);
void ref_model_destroy(ref_model *model); /* NULL allowed */
/* How many edges have this many polygons (2: counts those consistently wound). */
size_t ref_model_edges(const ref_model *model, uint32_t polygons);
size_t ref_model_crossings(const ref_model *model);

/* A visible point of a line. */
typedef struct ref_sample {
    float x, y;    /* px, y down */
    float nx, ny;  /* unit normal of the line on the screen */
    float along;   /* 0 to 1 along the whole line on the screen */
    float length;  /* of the whole line, px */
    uint32_t line; /* the same for all samples of one line */
    uint8_t kind;  /* dp_line or REF_NEUTRAL */
    bool inside;   /* at least 2 px inside the picture */
} ref_sample;

/* A maximal visible piece of a line. */
typedef struct ref_piece {
    double a[3], b[3]; /* px, px, distance along the line of sight */
    uint32_t line;
    uint8_t kind;
} ref_piece;

typedef struct ref_truth {
    ref_sample *samples;
    size_t sample_count, sample_room;
    ref_piece *pieces;
    size_t piece_count, piece_room;
    uint32_t line_count;
    uint32_t width, height; /* px */
    const ref_model *model; /* borrowed */
    dp_camera camera;
} ref_truth;

/* Angles in degrees. */
ref_truth *ref_truth_create(const ref_model *model, const dp_camera *camera, uint32_t width,
                            uint32_t height, double ridge_angle, double valley_angle);
void ref_truth_destroy(ref_truth *truth); /* NULL allowed */
/* Samples of a class inside the picture. */
size_t ref_truth_count(const ref_truth *truth, unsigned kind);

/* Distance along the line of sight of the surface seen at a point of the picture, or INFINITY. */
double ref_truth_surface(const ref_truth *truth, double x, double y);
/* World units per pixel at such a distance. */
double ref_truth_pixel(const ref_truth *truth, double depth);

#endif
