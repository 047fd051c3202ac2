/* The kernels AVX2, eight lanes. */
#ifdef __x86_64__
#define DP_LANES        8
#define DP_KERNELS      dp_kernels_avx2
#define DP_KERNELS_NAME "avx2"
#include "kernel/all.inc"
#endif
