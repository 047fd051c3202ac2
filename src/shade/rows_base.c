/* The looks of surfaces for any processor, and which are chosen. */
#define DP_LANES   4
#define DP_SHADERS dp_shaders_base
#include "shade/rows.inc"

const dp_shaders *dp_shaders_for(uint32_t lanes) {
#ifdef __x86_64__
    if (lanes >= 16) return &dp_shaders_avx512;
    if (lanes >= 8) return &dp_shaders_avx2;
#endif
    return lanes >= 4 ? &dp_shaders_base : &dp_shaders_plain;
}
