/* A batch of edges, each between two triangles (find/folds.inc, edges.c). */
#ifndef DP_FIND_FOLD_BATCH_H
#define DP_FIND_FOLD_BATCH_H

#include "core/spine.h"

enum { DP_FOLDS = 32 };

/* Arrays are indexed by member, axis and edge. */
typedef struct dp_fold_batch {
    float a[3][3][DP_FOLDS],
        b[3][3][DP_FOLDS]; /* the triangles' corners: [corner][axis], world space */
    float from[3][DP_FOLDS], to[3][DP_FOLDS]; /* the edge, in a's direction */
    double normal_a[3][DP_FOLDS], normal_b[3][DP_FOLDS], normal[3][DP_FOLDS]; /* as in dp_fold */
    double end_a[3][DP_FOLDS], end_b[3][DP_FOLDS], probe_a[3][DP_FOLDS],
        probe_b[3][DP_FOLDS]; /* as in dp_spine: x, y, d */
    double plain[DP_FOLDS];   /* 0: to be clipped, or without a mean normal: left to resolve_pair */
} dp_fold_batch;

static inline void dp_fold_put_position(const dp_polygons *polygons, uint32_t vertex,
                                        float out[3][DP_FOLDS], uint32_t i) {
    const float *const p = dp_vertex_position(polygons, vertex);
    for (int k = 0; k < 3; k++) out[k][i] = p[k];
}

/* Puts the edge `from`–`to` of frame triangles a and b at index i. */
static inline void dp_fold_put(const dp_polygons *polygons, uint32_t a, uint32_t b, uint32_t from,
                               uint32_t to, dp_fold_batch *f, uint32_t i) {
    for (uint32_t k = 0; k < 3; k++) {
        dp_fold_put_position(polygons, dp_corner_vertex(polygons, 3 * a + k), f->a[k], i);
        dp_fold_put_position(polygons, dp_corner_vertex(polygons, 3 * b + k), f->b[k], i);
    }
    dp_fold_put_position(polygons, from, f->from, i);
    dp_fold_put_position(polygons, to, f->to, i);
}

static inline dp_vec3 dp_fold_vector(const double v[3][DP_FOLDS], uint32_t i) {
    return dp_v3(v[0][i], v[1][i], v[2][i]);
}
static inline dp_pointd dp_fold_point(const double v[3][DP_FOLDS], uint32_t i) {
    return (dp_pointd){v[0][i], v[1][i], v[2][i]};
}

/* Edge i's spine, without its number of sample points. */
static inline dp_spine dp_fold_spine(const dp_fold_batch *f, uint32_t i) {
    return (dp_spine){dp_fold_point(f->end_a, i), dp_fold_point(f->end_b, i),
                      dp_fold_point(f->probe_a, i), dp_fold_point(f->probe_b, i), 0};
}

#endif
