/* The kernels four lanes: what every processor has. */
#define DP_LANES        4
#define DP_KERNELS      dp_kernels_base
#define DP_KERNELS_NAME "base"
#include "kernel/all.inc"
