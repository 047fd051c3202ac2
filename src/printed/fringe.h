/* Textured silhouettes of Hermosilla and Vázquez 2010, as printed (fringe.c). */
#ifndef DP_PRINTED_FRINGE_H
#define DP_PRINTED_FRINGE_H

#include "features/extrude.h"
#include "printed/quads.h"

/* Classes that have an outside. */
enum { DP_OUTLINES = DP_SILHOUETTE | DP_BORDER };

/* Is the picture drawn so? Else the same geometry lies beside visible pieces of lines
 * (strokes/). */
static inline bool dp_is_fringed(const dp_frame *frame) {
    const dp_style *const s = &frame->styles[0];
    return frame->adjacency && s->ink == DP_INK_QUADS && s->method == DP_METHOD_PAPER;
}

/* Faces, silhouettes, surface and ink of a tile; creases and intersections are for other stages
 * (tile.c). */
void dp_tile_fringe_one_pass(dp_printer *worker);
void dp_tile_fringe_two_passes(dp_printer *worker);

/* How far beyond their polygons the widest silhouettes reach, px. */
float dp_fringe_reach(const dp_frame *frame);

#endif
