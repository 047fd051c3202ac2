/* The looks of surfaces in plain C, one pixel at a time: the truth that the others are compared
 * with. */
#define DP_LANES   1
#define DP_SHADERS dp_shaders_plain
#include "shade/rows.inc"
