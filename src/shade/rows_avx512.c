/* The looks of surfaces for AVX-512. */
#ifdef __x86_64__
#define DP_LANES   16
#define DP_SHADERS dp_shaders_avx512
#include "shade/rows.inc"
#endif
typedef int dp_not_empty; /* elsewhere */
