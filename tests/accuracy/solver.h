/* Which stretches of a model's edges are hidden, and by how many polygons: solved, not sampled.
 *
 * An edge is lifted off its polygons by a tenth of a pixel, along their mean normal, or not at all
 * where the two cancel. A polygon other than these hides the stretch of it that it covers on the
 * screen and where it is nearer by a twentieth of a pixel: both are linear along the edge, so the
 * stretch is an interval. All intervals are found by brute force with a grid, in double precision, and
 * swept. Shares no code with the library. Polygons must be convex, and lie before the eye. */
#ifndef DP_TEST_SOLVER_H
#define DP_TEST_SOLVER_H

#include "mesh.h"

typedef struct solver solver;

/* A stretch of an edge, from 0 at its a to 1 at its b. */
typedef struct solver_stretch {
    double from, to;
    uint32_t surfaces; /* polygons that hide it; 0: it is visible */
    uint32_t fronts;   /* those of them that face the eye */
} solver_stretch;

/* px: stretches shorter than this are left out, those beside them joined. */
#define SOLVER_SLIVER 1e-4

/* Borrows the model. */
solver *solver_create(const ref_model *model, const dp_camera *camera, uint32_t width,
                      uint32_t height);
void solver_destroy(solver *made); /* NULL allowed */

/* Sine of the angle at which a polygon is seen: below zero if it faces the eye. */
double solver_sine(const solver *made, uint32_t polygon);

/* An edge's ends on the screen, px, not lifted. */
void solver_ends(const solver *made, uint32_t edge, double a[2], double b[2]);

/* The edge's stretches in order, without gaps; equal ones are joined. Valid until the next call. */
size_t solver_edge(solver *made, uint32_t edge, const solver_stretch **out);

/* The stretch that one polygon hides; false: none. */
bool solver_hidden_by(const solver *made, uint32_t edge, uint32_t polygon, double *from,
                      double *to);

#endif
