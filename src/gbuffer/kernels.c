/* The loops over rows at the width DP_LANES; compiled once for each width (CMakeLists.txt). */
#include "gbuffer/detect.h"
#include "gbuffer/fill.h"

#include "base/vec.h"
#include "base/lanes.h"

#include "gbuffer/diagonal.inc"

#include "gbuffer/c1.inc"

#include "gbuffer/strengths.inc"

#include "gbuffer/fill.inc"

const dp_detectors DP_KERNEL_TABLE(dp_detectors) = {
    DP_LANES, diagonal_normals, diagonal_depth_printed, diagonal_scaled, c1_printed, c1_scaled,
    c1_slope, strengths};

const dp_fillers DP_KERNEL_TABLE(dp_fillers) = {DP_LANES, pick, find, touch, collect, finish};
