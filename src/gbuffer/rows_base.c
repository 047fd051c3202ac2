/* The detectors for any processor, and which are chosen. */
#define DP_ROWS dp_detectors_base
#define DP_ROWS_LANES 4
#include "gbuffer/rows.inc"

const dp_detectors *dp_detectors_for(uint32_t lanes) {
#ifdef __x86_64__
    if (lanes >= 16) return &dp_detectors_avx512;
    if (lanes >= 8) return &dp_detectors_avx2;
#endif
    (void)lanes;
    return &dp_detectors_base;
}
