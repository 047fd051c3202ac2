/* Pencil's pixel stage for AVX2. */
#ifdef __x86_64__
#define DP_ROWS dp_pencil_avx2
#include "shade/pencil_rows.inc"
#endif
typedef int dp_not_empty; /* elsewhere */
