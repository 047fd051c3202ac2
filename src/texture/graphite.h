/* Pencil rendering's textures: strokes, and the paper under them. */
#ifndef DP_TEXTURE_GRAPHITE_H
#define DP_TEXTURE_GRAPHITE_H

#include <stdint.h>

enum { DP_GRAPHITE_SIZE = 512 };

/* Fills brightness [tones][DP_GRAPHITE_SIZE][DP_GRAPHITE_SIZE]: strokes along u, the same after
 * half a turn; from empty paper to dark, each tone with the strokes of the one before and more.
 * scratch: [DP_GRAPHITE_SIZE][DP_GRAPHITE_SIZE]. */
void dp_make_graphite(uint8_t *values, uint32_t tones, float *scratch);

/* Fills [DP_GRAPHITE_SIZE][DP_GRAPHITE_SIZE] with the paper's tooth: how much more graphite than
 * the mean each place takes, -127 to 127. */
void dp_make_tooth(int8_t *values);

#endif
