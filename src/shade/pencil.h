/* Pencil rendering (Hermosilla and Vázquez 2010, 2.4; pencil.c): its memory and its two stages. */
#ifndef DP_SHADE_PENCIL_H
#define DP_SHADE_PENCIL_H

#include "shade/shade.h"

void dp_pencil_store_free(dp_pencil_store *store, const dp_allocator *memory);
uint64_t dp_pencil_store_bytes(const dp_pencil_store *store);

/* Once polygons are gathered and the G-buffer has begun: textures, the plane that says which
 * polygon a pixel shows, and the vertex stage, all for `setup`. False when memory is out. */
bool dp_pencil_begin(dp_pencil_store *store, const dp_frame *frame, dp_gbuffer *g,
                     dp_shading_setup *setup);

/* Vertex stage: directions of minimal curvature (world space, [vertices]) to turns on the
 * screen. */
void dp_pencil_vertices(const dp_frame *frame, const float (*along)[3], dp_turn *turns);

/* Fills powers[256 dark][256 value] with 255 (value / 255) ^ (dark / 255 S + O). */
void dp_make_powers(uint8_t *powers, float s, float o);

void dp_make_pencil_table(dp_pencil_table *table);

/* Pixel stage (Hermosilla and Vázquez 2010, Listing 2.5). */
dp_shade_operator dp_shade_pencil;

#endif
