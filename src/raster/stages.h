/* Stages of a frame that come before its tiles, in the order in which draw.c runs them: the vertex
 * stage, and binning (compare Raskar 2001, Figure 2). */
#ifndef DP_RASTER_STAGES_H
#define DP_RASTER_STAGES_H

#include "core/frame.h"
#include "core/outline.h"

/* Fills frame->vertices, which are allocated. */
void dp_transform_vertices(dp_frame *frame);

/* One worker's scratch, and what it has counted. */
typedef struct dp_bin_worker {
    dp_outline_scratch scratch;
    dp_stats stats;
    bool failed;
} dp_bin_worker;
void dp_bin_worker_begin(dp_bin_worker *worker); /* before a frame */
void dp_bin_worker_free(dp_bin_worker *worker, const dp_allocator *memory);
uint64_t dp_bin_worker_bytes(const dp_bin_worker *worker);

/* Sorts polygons into tiles widened by `margin` px, and by frame->fin_reach for polygons with
 * outlines if that is more. Adds dropped and clipped polygons to each worker's `stats`. `workers`
 * has one entry per worker. False: out of memory. */
bool dp_bin_polygons(dp_frame *frame, float margin, dp_bin_worker *workers);

#endif
