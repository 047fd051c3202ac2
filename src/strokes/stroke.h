/* Strokes: visible feature segments as they are inked. */
#ifndef DP_STROKES_STROKE_H
#define DP_STROKES_STROKE_H

#include "pipe/frame.h"

/* A capsule on the screen: all points within half_width of the spine. */
typedef struct dp_stroke {
    dp_point a, b;     /* ends of the spine; screen space */
    float half_width;  /* px */
    float plane[2][3]; /* d0, dx, dy of the polygons that meet at the spine; NaN: none */
    dp_color color;
    uint8_t line;      /* dp_line */
} dp_stroke;

/* Joins the tiles' pieces and makes frame->segments and frame->strokes (context->owned arrays);
 * `store` keeps their memory. */
typedef struct dp_stroke_store {
    dp_piece *pieces;
    dp_segment *segments;
    dp_stroke *strokes;
    size_t pieces_cap, segments_cap, strokes_cap;
} dp_stroke_store;

void dp_stroke_store_free(dp_stroke_store *store, const dp_allocator *memory);

struct dp_tile_worker;
bool dp_make_segments(dp_frame *frame, const struct dp_tile_worker *workers, dp_stroke_store *store);

/* Strokes to tiles. False when memory is out. */
bool dp_bin_strokes(dp_frame *frame);

/* Inks one tile over what the target holds already. */
typedef struct dp_ink_worker {
    float coverage[64 * 64];
    uint64_t row[64]; /* pixels of `coverage` that are set */
    uint32_t *strokes;
    size_t strokes_cap;
    bool failed;
} dp_ink_worker;
void dp_ink_tile(const dp_frame *frame, dp_ink_worker *worker, uint32_t tile);

#endif
