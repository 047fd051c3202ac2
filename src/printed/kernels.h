/* The kernels of added polygons as ink. */
#ifndef DP_PRINTED_KERNELS_H
#define DP_PRINTED_KERNELS_H

#include "base/kernels.h"

struct dp_brush;
struct dp_ink_shape;

typedef struct dp_printed_kernels {
    /* Inks the samples under an added polygon where the brush's test is true (ink.inc). */
    void (*ink)(struct dp_brush *brush, const struct dp_ink_shape *shape);
} dp_printed_kernels;

DP_KERNEL_TABLES(dp_printed_kernels);

#endif
