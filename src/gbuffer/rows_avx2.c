/* The detectors for AVX2. */
#ifdef __x86_64__
#define DP_ROWS dp_detectors_avx2
#define DP_ROWS_LANES 8
#include "gbuffer/rows.inc"
#endif
typedef int dp_not_empty; /* elsewhere */
