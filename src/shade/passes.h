/* The screen-space passes besides shading, over one tile each (called by passes.c). */
#ifndef DP_SHADE_PASSES_H
#define DP_SHADE_PASSES_H

#include "shade/shade.h"

/* Cartoon map, color -> smooth: each pixel is the mean of itself and its neighbours of the same
 * surface. */
void dp_cartoon_map_tile(dp_shade_store *store, uint32_t tile);
/* Edge map -> the target's edge map; its edges over `shown`, inner first, then profile. */
void dp_edges_tile(dp_shade_store *store, uint32_t tile);
/* shown -> target; mixes the colours of pixels that several surfaces share. */
void dp_resolve_tile(dp_shade_store *store, uint32_t tile);

#endif
