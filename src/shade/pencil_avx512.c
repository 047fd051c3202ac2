/* Pencil's pixel stage for AVX-512. */
#ifdef __x86_64__
#define DP_ROWS dp_pencil_avx512
#include "shade/pencil_rows.inc"
#endif
typedef int dp_not_empty; /* elsewhere */
