/* Pencil rendering's textures: strokes, and the paper under them. */
#ifndef DP_TEXTURE_GRAPHITE_H
#define DP_TEXTURE_GRAPHITE_H

#include <stdint.h>

enum { DP_GRAPHITE_SIZE = 512 };

/* Brightness [tones][DP_GRAPHITE_SIZE][DP_GRAPHITE_SIZE], strokes along u, the same after half a
 * turn; from bare paper to dark, each with the last one's strokes and more. `scratch` holds as many
 * values as one tone. */
void dp_make_graphite(uint8_t *values, uint32_t tones, float *scratch);

/* The paper's tooth: how much more graphite each place takes than the mean, -127 to 127. */
void dp_make_tooth(int8_t *values);

#endif
