/* The loops over rows in plain C, one pixel at a time: the truth that the others are compared
 * with. */
#define DP_LANES     1
#define DP_DETECTORS dp_detectors_plain
#define DP_FILLERS   dp_fillers_plain
#include "gbuffer/rows.inc"
