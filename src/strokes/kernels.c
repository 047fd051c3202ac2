/* This folder's kernels at the width DP_LANES; compiled once for each width (CMakeLists.txt). */
#include "strokes/kernels.h"

#include "base/lanes.h"

#include "core/ld3.inc"
#include "strokes/segments.inc"

const dp_stroke_kernels DP_KERNEL_TABLE(dp_stroke_kernels) = {
    .segments = segments,
};
