/* The looks of surfaces for AVX2. */
#ifdef __x86_64__
#define DP_LANES   8
#define DP_SHADERS dp_shaders_avx2
#include "shade/rows.inc"
#endif
typedef int dp_not_empty; /* elsewhere */
