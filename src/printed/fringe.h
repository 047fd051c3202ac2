/* Textured silhouettes of Hermosilla and Vázquez 2010, as printed (fringe.c). */
#ifndef DP_PRINTED_FRINGE_H
#define DP_PRINTED_FRINGE_H

#include "features/extrude.h"
#include "printed/quads.h"

/* Faces, silhouettes, surface and ink of a tile; creases and intersections are for other stages
 * (tile.c). */
void dp_tile_fringe_one_pass(dp_printer *worker);
void dp_tile_fringe_two_passes(dp_printer *worker);

/* How far beyond their polygons the widest silhouettes reach, px. */
float dp_fringe_reach(const dp_frame *frame);

#endif
