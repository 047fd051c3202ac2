/* This folder's kernels at the width DP_LANES; compiled once for each width (CMakeLists.txt). */
#include "sink/kernels.h"

#include "base/lanes.h"
#include "sink/raster.h"

#include "sink/cover.inc"

const dp_sink_kernels DP_KERNEL_TABLE(dp_sink_kernels) = {
    .cover = cover,
    .blend = blend,
};
