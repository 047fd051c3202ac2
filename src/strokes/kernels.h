/* The kernels that make segments. */
#ifndef DP_STROKES_KERNELS_H
#define DP_STROKES_KERNELS_H

#include "core/view.h"
#include "base/kernels.h"

struct dp_segment_batch;

typedef struct dp_stroke_kernels {
    /* Ends and planes of the first `count` segments of a batch (segments.inc). */
    void (*segments)(const dp_view *view, struct dp_segment_batch *batch, uint32_t count);
} dp_stroke_kernels;

DP_KERNEL_TABLES(dp_stroke_kernels);

#endif
