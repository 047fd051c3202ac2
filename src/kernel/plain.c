/* The kernels in plain C: the truth that the others are compared with. */
#define DP_LANES        1
#define DP_KERNELS      dp_kernels_plain
#define DP_KERNELS_NAME "plain"
#include "kernel/all.inc"
