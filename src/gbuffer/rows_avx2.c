/* The loops over rows for AVX2. */
#ifdef __x86_64__
#define DP_LANES     8
#define DP_DETECTORS dp_detectors_avx2
#define DP_FILLERS   dp_fillers_avx2
#include "gbuffer/rows.inc"
#endif
typedef int dp_not_empty; /* elsewhere */
