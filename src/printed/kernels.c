/* The kernels of src/printed at the width DP_LANES; compiled once for each width
 * (CMakeLists.txt). */
#include "printed/kernels.h"

#include "base/lanes.h"

#include "printed/ink.inc"

const dp_printed_kernels DP_KERNEL_TABLE(dp_printed_kernels) = {
    .ink = ink,
};
