/* The detectors for AVX-512. */
#ifdef __x86_64__
#define DP_ROWS dp_detectors_avx512
#define DP_ROWS_LANES 16
#include "gbuffer/rows.inc"
#endif
typedef int dp_not_empty; /* elsewhere */
