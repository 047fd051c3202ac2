/* The loops of pencil rendering: over vertices, and over a run of pixels. Compiled for each width
 * of vectors (kernels.c) from the same C, and so with the same bits. */
#ifndef DP_SHADE_PENCIL_ROWS_H
#define DP_SHADE_PENCIL_ROWS_H

#include "base/kernels.h"
#include "shade/shade.h"

enum { DP_STRANDS_PER_PIXEL = 6, DP_STRANDS_MOST = DP_STRANDS_PER_PIXEL * DP_TILE };

/* The texture look-ups of a run of pixels, in order of pixels. Each is along a direction (c, s),
 * the cosine and sine of its angle, and has a weight in its pixel. A pixel without surface has
 * none. */
typedef struct dp_strands {
    uint32_t count;
    int32_t pixel[DP_STRANDS_MOST]; /* index in the run */
    float c[DP_STRANDS_MOST], s[DP_STRANDS_MOST], weight[DP_STRANDS_MOST];
} dp_strands;

typedef struct dp_pencil_rows {
    /* Directions along a surface to turns on the screen, whose axes are `right` and `up` (world
     * space): in steps; exactly. */
    void (*turn)(const float (*along)[3], const float right[3], const float up[3], uint32_t n,
                 dp_turn *turns);
    void (*turn_exactly)(const float (*along)[3], const float right[3], const float up[3],
                         uint32_t n, dp_turn *turns);
    /* Draws look-ups with their tone (Hermosilla and Vázquez 2010, Listing 2.5) and the paper's
     * tooth over the run's colours. */
    void (*shade)(const dp_shading_setup *setup, const dp_strands *strands, dp_shade_run *run);
} dp_pencil_rows;

DP_KERNEL_TABLES(dp_pencil_rows);

#endif
