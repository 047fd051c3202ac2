/* One tile from its polygons to its surface and the visible pieces of its lines. */
#ifndef DP_DRAW_TILE_H
#define DP_DRAW_TILE_H

#include "find/finder.h"
#include "printed/quads.h"

/* Fills frame->tile_pieces[index]; what fails, finder->tile.failed remembers. */
void dp_draw_tile(dp_finder *finder, dp_printer *printer, uint32_t index);

#endif
