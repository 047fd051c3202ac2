/* Pencil rendering (pencil.c): its two stages. */
#ifndef DP_SHADE_PENCIL_H
#define DP_SHADE_PENCIL_H

#include "shade/shade.h"

/* Vertex stage: directions of least curvature (world space, [vertices]) to unit directions on the screen, y up. */
void dp_pencil_vertices(const dp_frame *frame, const float (*along)[3], float (*turns)[2]);

/* Pixel stage. */
dp_shade_operator dp_shade_pencil;

#endif
