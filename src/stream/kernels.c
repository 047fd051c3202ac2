/* This folder's kernels at the width DP_LANES; compiled once for each width (CMakeLists.txt). */
#include "stream/kernels.h"

#include "base/lanes.h"

#include "core/keys.inc"
#include "core/ld3.inc"
#include "core/to_screen.inc"
#include "stream/classify.inc"

const dp_stream_kernels DP_KERNEL_TABLE(dp_stream_kernels) = {
    .classify = classify,
    .touch = touch,
};
