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

/* A row of a tile's pixels beside a stroke: the share of each that it covers; where along the spine the pixel's centre
 * lies, 0 to 1, and how far from it, px. Kernels write whole vectors. */
typedef struct dp_row_coverage {
    float share[64 + 16], t[64 + 16], distance[64 + 16];
} dp_row_coverage;

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

/* From the bottom up: the order in which classes are laid over each other. */
extern const dp_line dp_layers[DP_LINE_COUNT];

/* Tiles that a stroke reaches. */
dp_tile_rect dp_stroke_rect(const dp_stroke *stroke);

/* Inks one tile over what the target holds already. */
typedef struct dp_ink_worker {
    float coverage[64 * 64];
    uint64_t row[64]; /* pixels of `coverage` that are set */
    float nearest[64 * 64];    /* brush.c: px from the spine; colour */
    dp_color color[64 * 64];
    uint32_t *strokes;
    size_t strokes_cap;
    bool failed;
} dp_ink_worker;
/* Which strokes a tile holds, into worker->strokes. False when memory is out. */
bool dp_fetch_strokes(const dp_frame *frame, dp_ink_worker *worker, uint32_t tile, size_t *count);

/* Share of the samples of pixel (x, y) that do not hide the stroke, `distance` px beside its spine's point t.
 * `tile_depth`: the samples of the tile at (x0, y0); NULL: there is no surface. */
float dp_visible_share(const dp_frame *frame, const float *tile_depth, uint32_t x0, uint32_t y0, const dp_stroke *stroke,
                       uint32_t x, uint32_t y, float t, float distance);

void dp_ink_tile(const dp_frame *frame, dp_ink_worker *worker, uint32_t tile);

#endif
