/* Edge detection in the G-buffer (Nienhaus and Döllner 2003, 4.1.2): small functions over runs of
 * pixels.
 *
 * The pixels around X are named as in the paper's Figure 2, `radius` px away:   A B C
 *                                                                               D X E
 *                                                                               F G H */
#ifndef DP_GBUFFER_DETECT_H
#define DP_GBUFFER_DETECT_H

#include "base/kernels.h"
#include "gbuffer/gbuffer.h"

#include <stdbool.h>
#include <stdint.h>

/* Three rows of one plane: above, through and below the pixels; [0] is the first pixel, [-radius]
 * may be read. */
typedef struct dp_rows {
    const float *above, *at, *below;
} dp_rows;

/* How differences of distance are measured. */
typedef struct dp_depth_measure {
    float scale;      /* printed: 1 / (far - near); scaled: px per unit at distance 1 over the pixel
                         sizes that      count whole, so that times a difference of depth, and in
                         perspective      over the depth, it      is the share of a whole step */
    bool perspective; /* scaled: pixel sizes grow with distance */
    bool both_sides;  /* scaled: the further side of a step too */
} dp_depth_measure;

/* How pixels see: as in dp_gbuffer. */
typedef struct dp_rays {
    bool perspective;
    float cx, cy, fx, fy;
} dp_rays;

/* A run of one row's pixels in the G-buffer; whole vectors of them are read. */
typedef struct dp_pixel_run {
    const uint16_t *id; /* `stride` from row to row; `radius` around may be read */
    const float *distance;
    size_t stride;
    uint32_t n;
} dp_pixel_run;

/* Where an edge begins, and one over how much further it is whole. */
typedef struct dp_threshold {
    float at, scale;
} dp_threshold;

/* A run of one row of the edge map: strengths, 0: no edge, 1: full. */
typedef struct dp_edge_run {
    float inner[DP_TILE], profile[DP_TILE];
    uint64_t strong;  /* pixels that have any */
    uint64_t meeting; /* pixels of a group with a diagonal neighbour of another one */
} dp_edge_run;

/* The operators, compiled for several kinds of processors (rows_….c): the same C, and so the same
 * bits. */
typedef struct dp_detectors {
    uint32_t lanes; /* floats per vector */

    /* I_N = 1/2 ((A · H) + (C · F)) of unit normals: 1 where all agree, -1 at most apart. */
    void (*diagonal_normals)(dp_rows nx, dp_rows ny, dp_rows nz, int radius, uint32_t n,
                             float *i_n);

    /* I_Z = (1 - 1/2 |A - H|)^2 (1 - 1/2 |C - F|)^2, distances times `scale`. */
    void (*diagonal_depth_printed)(dp_rows z, const dp_depth_measure *m, int radius, uint32_t n,
                                   float *i_z);

    /* Both with the same formulas, but the difference of distance is what slope does not explain:
     * for the pair A, H around X step = 3/2 (|A + H - 2 X| - 7/4 min(|A - X|, |H - X|)) - 1/2 in
     * whole steps at X (`scale`), clamped to [0, 1]. `d` is depth on the screen, 1 / distance in
     * perspective: the second difference is zero on planes, whatever their slope and distance, and
     * below zero on the nearer side of a step. Across a step normals say nothing of a crease: A · H
     * counts as 1 there, as far as it is one. */
    void (*diagonal_scaled)(dp_rows nx, dp_rows ny, dp_rows nz, dp_rows d,
                            const dp_depth_measure *m, int radius, uint32_t n, float *i_n,
                            float *i_z);

    /* The C1-discontinuity operator 1/8 (|A - X| + 2 |B - X| + … + |H - X|) in the paper's three
     * passes, each of which adds its part to i_z: 0: A, B, C; 1: D, E; 2: F, G, H. */
    void (*c1_printed)(dp_rows z, const dp_depth_measure *m, int pass, int radius, uint32_t n,
                       float *i_z);

    /* The same of differences of depth in pixel sizes beyond what the slope explains, `slope` pixel
     * sizes per px, each clamped to [0, 1]. */
    void (*c1_scaled)(dp_rows d, const float *slope, const dp_depth_measure *m, int pass,
                      int radius, uint32_t n, float *i_z);

    /* Slope of the surface at a run of pixels that begins at (x, y), in pixel sizes per px, from
     * its normals. */
    void (*c1_slope)(const dp_rays *rays, const float *nx, const float *ny, const float *nz,
                     uint32_t x, uint32_t y, uint32_t n, float *slope);

    /* `out` holds intensities I_N, I_Z and gets strengths: 1 - I, from the thresholds on. A partial pixel
     * is a whole profile edge, a pixel without surface none. */
    void (*strengths)(const dp_pixel_run *p, dp_threshold inner, dp_threshold profile, int radius,
                      dp_edge_run *out);
} dp_detectors;

DP_KERNEL_TABLES(dp_detectors);

#endif
