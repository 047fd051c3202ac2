/* The stages of a frame, in the order in which draw.c runs them (Raskar 2001, Figure 2). */
#ifndef DP_RASTER_STAGES_H
#define DP_RASTER_STAGES_H

#include "core/frame.h"
#include "core/outline.h"

/* Fills frame->vertices (allocated). */
void dp_transform_vertices(dp_frame *frame);

/* Polygons to tiles widened by `margin` px, those that are outlined by frame->fin_reach where that is
 * more; adds dropped and clipped polygons to `stats`. False when memory is out. `scratch` and
 * `stats` hold one entry per worker. */
typedef struct dp_bin_worker {
    dp_outline_scratch scratch;
    dp_stats stats;
    bool failed;
} dp_bin_worker;
bool dp_bin_polygons(dp_frame *frame, float margin, dp_bin_worker *workers);

#endif
