/* Pencil's pixel stage for any processor, and which one is chosen. */
#define DP_ROWS dp_pencil_base
#include "shade/pencil_rows.inc"

const dp_pencil_rows *dp_pencil_rows_for(uint32_t lanes) {
#ifdef __x86_64__
    if (lanes >= 16) return &dp_pencil_avx512;
    if (lanes >= 8) return &dp_pencil_avx2;
#endif
    (void)lanes;
    return &dp_pencil_base;
}
