/* Strokes: visible feature segments as they are inked. */
#ifndef DP_STROKES_STROKE_H
#define DP_STROKES_STROKE_H

#include "core/frame.h"
#include "core/piece.h"

/* A capsule on the screen: all points within half_width of the spine. */
typedef struct dp_stroke {
    dp_point a, b;     /* ends of the spine; screen space */
    float half_width;  /* px */
    float plane[2][3]; /* d0, dx, dy of the polygons that meet at the spine; NaN: none */
    dp_color color;
    uint8_t line; /* dp_line */
} dp_stroke;

/* How near a surface may come to a stroke without hiding it: depth, at (x, y) on the screen,
 * `distance` px beside the spine's point t. It may be nearer than the spine, in pixel sizes, by
 *
 *     2 + 8 distance + sqrt(picture height * distance), the last of outlines alone:
 *
 * sides that rise by up to eight to one, and outlines that curve towards the eye with a radius of
 * up to half the picture (a circle rises by sqrt(2 r x)). And it may lie behind one of the stroke's
 * own polygons, carried on over the pixel; where that is steep, behind its depth at the pixel's
 * nearest part. A NaN for no polygon. */
static inline float dp_stroke_limit(const dp_frame *frame, const dp_stroke *s, float x, float y,
                                    float t, float distance) {
    const float spine = s->a.d + (s->b.d - s->a.d) * t,
                step = fabsf(spine) * frame->step_scale + frame->step_offset;
    const float rounded =
        s->line == DP_LINE_SILHOUETTE ? sqrtf((float)frame->view.height * distance) : 0;
    float limit = spine + step * (2 + 8 * distance + rounded);
    for (int i = 0; i < 2; i++) {
        const float *const p = s->plane[i];
        const float own =
            p[0] + p[1] * x + p[2] * y + 0.5f * (fabsf(p[1]) + fabsf(p[2])) + 2 * step;
        limit = dp_maxf(own, limit);
    }
    return limit;
}

/* Pixels of a tile beside a stroke, at most DP_PATCH columns and rows. */
enum { DP_PATCH = 8 };
typedef struct dp_ink_patch {
    uint32_t tile_x, tile_y; /* px of the tile's corner */
    uint32_t x0, y0, x1, y1; /* in the tile; from the first to before the last */
    const float *depth;      /* the tile's samples, which hide; NULL: nothing does */
} dp_ink_patch;

/* Joins the tiles' pieces and makes frame->segments and frame->strokes (context->owned arrays);
 * `store` keeps their memory. */
typedef struct dp_stroke_store {
    dp_piece *pieces;
    dp_segment *segments;
    dp_stroke *strokes;
    size_t pieces_cap, segments_cap, strokes_cap;
} dp_stroke_store;

void dp_stroke_store_free(dp_stroke_store *store, const dp_allocator *memory);

/* `found`: by worker. False when memory is out. */
bool dp_make_segments(dp_frame *frame, const dp_found *found, dp_stroke_store *store);

/* Strokes to tiles. False when memory is out. */
bool dp_bin_strokes(dp_frame *frame);

/* From the bottom up: the order in which classes are laid over each other. */
extern const dp_line dp_layers[DP_LINE_COUNT];

/* Tiles that a stroke reaches. */
dp_tile_rect dp_stroke_rect(const dp_stroke *stroke);

/* Inks one tile over what the target holds already. */
typedef struct dp_ink_worker {
    float coverage[64 * 64];
    uint64_t row[64];       /* pixels of `coverage` that are set */
    float nearest[64 * 64]; /* brush.c: px from the spine; colour */
    dp_color color[64 * 64];
    uint32_t *strokes, *sorted; /* of the tile: as they come; ink.c: by class */
    size_t strokes_cap, sorted_cap;
    bool failed;
} dp_ink_worker;
/* Which strokes a tile holds, into worker->strokes. False when memory is out. */
bool dp_fetch_strokes(const dp_frame *frame, dp_ink_worker *worker, uint32_t tile, size_t *count);

/* Share of the samples of pixel (x, y) that do not hide the stroke, `distance` px beside its
 * spine's point t. `tile_depth`: the samples of the tile at (x0, y0); NULL: there is no surface. */
float dp_visible_share(const dp_frame *frame, const float *tile_depth, uint32_t x0, uint32_t y0,
                       const dp_stroke *stroke, uint32_t x, uint32_t y, float t, float distance);

void dp_ink_tile(const dp_frame *frame, dp_ink_worker *worker, uint32_t tile);

#endif
