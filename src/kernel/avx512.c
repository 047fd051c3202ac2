/* The kernels AVX-512, sixteen lanes. */
#ifdef __x86_64__
#define DP_LANES        16
#define DP_KERNELS      dp_kernels_avx512
#define DP_KERNELS_NAME "avx512"
#include "kernel/all.inc"
#endif
