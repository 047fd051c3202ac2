/* The loops over rows for AVX-512. */
#ifdef __x86_64__
#define DP_LANES     16
#define DP_DETECTORS dp_detectors_avx512
#define DP_FILLERS   dp_fillers_avx512
#include "gbuffer/rows.inc"
#endif
typedef int dp_not_empty; /* elsewhere */
