/* Textured silhouettes as printed (Hermosilla and Vázquez 2010, 2.3; fins.c). */
#ifndef DP_PRINTED_FINS_H
#define DP_PRINTED_FINS_H

#include "features/extrude.h"
#include "printed/quads.h"

/* Draws faces, silhouettes, surface and ink of a tile, in one or two passes; creases and
 * intersections are drawn by other stages. */
void dp_printed_fins_one_pass(dp_printer *worker);
void dp_printed_fins_two_passes(dp_printer *worker);

/* How far beyond their polygons the widest silhouettes reach, px. */
float dp_fin_reach(const dp_frame *frame);

#endif
