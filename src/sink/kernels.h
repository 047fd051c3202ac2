/* The kernels that ink strokes. */
#ifndef DP_SINK_KERNELS_H
#define DP_SINK_KERNELS_H

#include "core/frame.h"
#include "base/kernels.h"

struct dp_frame;
struct dp_ink_patch;
struct dp_ink_worker;
struct dp_stroke;

typedef struct dp_sink_kernels {
    /* Covers a patch of a tile with a stroke, where that covers more than what did before
     * (cover.inc). */
    void (*cover)(const struct dp_frame *frame, const struct dp_stroke *stroke,
                  const struct dp_ink_patch *patch, struct dp_ink_worker *worker);
    /* Lays ink over pixels of a row of a tile, of which `width` lie in the picture (cover.inc). */
    void (*blend)(uint8_t *row, uint32_t width, const float *coverage, uint64_t pixels,
                  dp_color color);
} dp_sink_kernels;

DP_KERNEL_TABLES(dp_sink_kernels);

#endif
