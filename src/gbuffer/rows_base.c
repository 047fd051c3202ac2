/* The loops over rows for any processor, and which are chosen. */
#define DP_LANES     4
#define DP_DETECTORS dp_detectors_base
#define DP_FILLERS   dp_fillers_base
#include "gbuffer/rows.inc"

const dp_detectors *dp_detectors_for(uint32_t lanes) {
#ifdef __x86_64__
    if (lanes >= 16) return &dp_detectors_avx512;
    if (lanes >= 8) return &dp_detectors_avx2;
#endif
    return lanes >= 4 ? &dp_detectors_base : &dp_detectors_plain;
}

const dp_fillers *dp_fillers_for(uint32_t lanes) {
#ifdef __x86_64__
    if (lanes >= 16) return &dp_fillers_avx512;
    if (lanes >= 8) return &dp_fillers_avx2;
#endif
    return lanes >= 4 ? &dp_fillers_base : &dp_fillers_plain;
}
