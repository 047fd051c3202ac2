/* Edge detection in the G-buffer (Nienhaus and Döllner 2003, 4.1.2): small functions over runs of
 * pixels. The samples around pixel X, `radius` px away, are named as in the paper's Figure 2:
 *
 *     A B C
 *     D X E
 *     F G H
 */
#ifndef DP_GBUFFER_DETECT_H
#define DP_GBUFFER_DETECT_H

#include "base/kernels.h"
#include "gbuffer/gbuffer.h"

#include <stdbool.h>
#include <stdint.h>

/* Three rows of one plane: above, at and below a run of pixels. [0] is the first pixel; [-radius]
 * may be read. */
typedef struct dp_rows {
    const float *above, *at, *below;
} dp_rows;

/* How differences of distance are measured. */
typedef struct dp_depth_measure {
    float scale;      /* difference to share of a whole step, 0 to 1:
                         printed             1 / (far - near), times a difference of distance
                         scaled              fy / profile_depth, times a difference of depth
                         scaled, perspective the same, divided by the depth */
    bool perspective; /* scaled: pixel sizes grow with distance */
    bool both_sides;  /* scaled: edges on the far side of a step too */
} dp_depth_measure;

/* The camera, as in dp_gbuffer. */
typedef struct dp_rays {
    bool perspective;
    float cx, cy, fx, fy;
} dp_rays;

/* A run of pixels of one row; whole vectors are read. */
typedef struct dp_pixel_run {
    const uint16_t *id; /* `stride` from row to row; `radius` around may be read */
    const float *distance;
    size_t stride;
    uint32_t n;
} dp_pixel_run;

/* strength = clamp((1 - I - at) scale). */
typedef struct dp_threshold {
    float at, scale;
} dp_threshold;

/* A run of the edge map. Strengths: 0 no edge, 1 a full one. */
typedef struct dp_edge_run {
    float inner[DP_TILE], profile[DP_TILE];
    uint64_t strong;  /* bits: pixels with any strength */
    uint64_t meeting; /* bits: pixels with a diagonal neighbour of another group */
} dp_edge_run;

/* The operators, compiled for each width of vectors (kernels.c): the same C, and so the same
 * bits. */
typedef struct dp_detectors {
    uint32_t lanes; /* floats per vector */

    /* I_N = 1/2 ((A · H) + (C · F)) of unit normals: 1 where they agree, -1 where opposite. */
    void (*diagonal_normals)(dp_rows nx, dp_rows ny, dp_rows nz, int radius, uint32_t n,
                             float *i_n);

    /* I_Z = (1 - 1/2 |A - H|)^2 (1 - 1/2 |C - F|)^2 of distances times `scale`. */
    void (*diagonal_depth_printed)(dp_rows z, const dp_depth_measure *m, int radius, uint32_t n,
                                   float *i_z);

    /* Both, but instead of |A - H| with what the slope does not explain (beyond the paper):
     *
     *     step(A, H) = clamp(3/2 (|A + H - 2 X| - 7/4 min(|A - X|, |H - X|)) - 1/2)
     *     I_N        = 1 - 1/2 ((1 - A · H) (1 - step(A, H)) + (1 - C · F) (1 - step(C, F)))
     *
     * in whole steps at X (`scale`). `d` is depth on the screen, 1 / distance in perspective: the
     * second difference is zero on planes of any slope, and negative on the near side of a step.
     * Across a step normals tell nothing of a crease, so A · H counts as 1 there. */
    void (*diagonal_scaled)(dp_rows nx, dp_rows ny, dp_rows nz, dp_rows d,
                            const dp_depth_measure *m, int radius, uint32_t n, float *i_n,
                            float *i_z);

    /* The C1-discontinuity operator I_Z = 1/8 (|A - X| + 2 |B - X| + |C - X| + …) in the paper's
     * three passes, each of which adds its part to i_z:
     *     0   1/8 |A - X| + 1/4 |B - X| + 1/8 |C - X|
     *     1   1/4 |D - X| + 1/4 |E - X|
     *     2   1/8 |F - X| + 1/4 |G - X| + 1/8 |H - X| */
    void (*c1_printed)(dp_rows z, const dp_depth_measure *m, int pass, int radius, uint32_t n,
                       float *i_z);

    /* The same, but each difference is what exceeds slope[i] (shares of a whole step), clamped to
     * [0, 1]. */
    void (*c1_scaled)(dp_rows d, const float *slope, const dp_depth_measure *m, int pass,
                      int radius, uint32_t n, float *i_z);

    /* Slope of the surface, pixel sizes per px, from its normals. (x, y): first pixel of the run.
     * */
    void (*c1_slope)(const dp_rays *rays, const float *nx, const float *ny, const float *nz,
                     uint32_t x, uint32_t y, uint32_t n, float *slope);

    /* Replaces I_N, I_Z in `out` by strengths. A partial pixel is a full profile edge; a pixel
     * without surface is no edge. */
    void (*strengths)(const dp_pixel_run *p, dp_threshold inner, dp_threshold profile, int radius,
                      dp_edge_run *out);
} dp_detectors;

DP_KERNEL_TABLES(dp_detectors);

#endif
