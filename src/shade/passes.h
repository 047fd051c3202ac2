/* The screen-space passes besides shading, over one tile each (passes.c conducts). */
#ifndef DP_SHADE_PASSES_H
#define DP_SHADE_PASSES_H

#include "shade/shade.h"

/* Cartoon map: the toon colours, each the mean of itself and its neighbours of the same surface:
 * color -> smooth. */
void dp_cartoon_map_tile(dp_shade_store *store, uint32_t tile);
/* Edge map, and its edges over `color`: inner first, then profile. Fills the target's edge map
 * too. */
void dp_edges_tile(dp_shade_store *store, uint32_t tile);
/* Colours of pixels that several surfaces share are put together: color -> target. */
void dp_resolve_tile(dp_shade_store *store, uint32_t tile);

#endif
