/* Sheets: what generated models consist of, and how they become batches of triangles.
 *
 * A model is a list of sheets. A sheet is a grid of nu x nv cells of two triangles each, or, for
 * triangular faces, half of an nu x nu grid. Its points are a function of integers. */
#ifndef DP_MESH_SHEET_H
#define DP_MESH_SHEET_H

#include "base/memory.h"
#include <drypoint/source.h>

enum { DP_MODEL_SHEETS = 192, DP_MODEL_PARAMETERS = 16 };

typedef struct dp_model dp_model;
typedef struct dp_sheet dp_sheet;

/* Point i of a closed or open curve; sheets span between curves. */
typedef void dp_curve(const dp_model *model, int which, uint32_t i, double p[3]);

struct dp_sheet {
    void (*point)(const dp_model *model, const dp_sheet *sheet, uint32_t i, uint32_t j,
                  double p[3]);
    uint32_t nu, nv;     /* cells; (u, v, outward) is right-handed */
    bool reversed;       /* (u, v, outward) is left-handed instead */
    bool triangular;     /* only points with i + j <= nu; nv = nu */
    bool shrinks;        /* cells inside may shrink to a line or point */
    int from, to;        /* parameters of the point function: curves, say */
    dp_curve *curve;     /* of dp_model_loft */
    double corner[4][3]; /* of dp_model_quad and _triangle */
};

struct dp_model {
    dp_sheet sheets[DP_MODEL_SHEETS];
    uint32_t sheet_count;
    uint32_t fine; /* fineness, >= 1, from which all counts of cells follow */
    uint32_t seed;
    double extent;    /* largest side of the box, in the units of the point functions */
    double centre[3]; /* of the box, same units */
    uint32_t n[DP_MODEL_PARAMETERS]; /* the shape's own counts */
};

/* Adds a zeroed sheet to the model; never fails (the table is large enough for every shape). */
dp_sheet *dp_model_add(dp_model *model, uint32_t nu, uint32_t nv);

/* A ruled sheet: straight from point i of curve `from` to point i of curve `to`. */
dp_sheet *dp_model_loft(dp_model *model, dp_curve *curve, int from, int to, uint32_t nu,
                        uint32_t nv);
/* A flat or twisted quadrangle by its corners, counter-clockwise seen from outside. */
dp_sheet *dp_model_quad(dp_model *model, double corners[4][3], uint32_t nu, uint32_t nv);
/* A triangle by its corners, n * n small ones. */
dp_sheet *dp_model_triangle(dp_model *model, double corners[3][3], uint32_t n);

/* p = a * (1 - k / n) + b * (k / n): the same bits from both ends, and exactly a or b there. */
void dp_between_points(const double a[3], const double b[3], uint32_t k, uint32_t n, double p[3]);
/* cos and sin of 2 pi k / n, the same bits for k and k + n, and exact at quarter turns. */
void dp_turn(uint32_t k, uint32_t n, double *c, double *s);
/* Point (i, j) of a disc of radius 1 in n x n cells; its outline is dp_turn(k, 4 n) from (1, 0)
 * on. */
void dp_disc(uint32_t i, uint32_t j, uint32_t n, double *x, double *y);

/* The most triangles that the model may have (cells that shrink to a line lose one or two). */
uint64_t dp_model_triangles(const dp_model *model);

/* Makes a source of a model (copied). `scale` multiplies every coordinate. */
dp_result dp_model_source(const dp_model *model, double scale, const dp_allocator *memory,
                          dp_source **out, dp_diag *diag);

#endif
