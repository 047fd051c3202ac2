/* Pencil rendering (pencil.c): its two stages. */
#ifndef DP_SHADE_PENCIL_H
#define DP_SHADE_PENCIL_H

#include "shade/shade.h"

/* Vertex stage: directions of least curvature (world space, [vertices]) to turns on the screen. */
void dp_pencil_vertices(const dp_frame *frame, const float (*along)[3], dp_turn *turns);

/* (value / 255) ^ (dark / 255 S + O), powers[256][256] by dark, then value. */
void dp_make_powers(uint8_t *powers, float s, float o);

void dp_make_pencil_table(dp_pencil_table *table);

/* Pixel stage. */
dp_shade_operator dp_shade_pencil;

#endif
