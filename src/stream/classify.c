/* Classifies a chunk's triangles, before anything is binned.
 *
 * In a model larger than memory nearly all triangles are far below a sample; this file decides what
 * they cost.
 *
 *     outside the picture                              -> dropped
 *     well behind the surface drawn so far             -> dropped
 *     first reading: the box holds no sample point     -> covers nothing; may still have edges
 *     second reading: touches no pixel of interest     -> dropped
 *
 * Kernels decide most triangles (classify.inc). This file decides the others: those to be clipped,
 * seen nearly edge-on, or wider than two pixels or blocks. Invariant: both decide alike. */
#include "stream/chunk.h"

enum { NOT_FINITE = 128 };

/* A corner's position on the screen. *outcode: dp_outcode, or NOT_FINITE; if not 0, x is NaN. */
static dp_point place_corner(const dp_view *view, const float *p, int *outcode) {
    const dp_clip_point c = dp_to_clip(view, dp_v3f(p));
    *outcode = isfinite(c.x + c.y + c.z + c.w) ? dp_outcode(view, c) : NOT_FINITE;
    if (*outcode) return (dp_point){NAN, 0, 0};
    const dp_pointd s = dp_to_screen(view, c);
    return (dp_point){(float)s.x, (float)s.y, (float)s.d};
}

typedef struct box {
    float x0, y0, x1, y1; /* px */
    float nearest;        /* d */
} box;

static box box_of(dp_point a, dp_point b, dp_point c) {
    return (box){dp_minf(a.x, dp_minf(b.x, c.x)), dp_minf(a.y, dp_minf(b.y, c.y)),
                 dp_maxf(a.x, dp_maxf(b.x, c.x)), dp_maxf(a.y, dp_maxf(b.y, c.y)),
                 dp_maxf(a.d, dp_maxf(b.d, c.d))};
}

static bool is_outside(const box *b, const dp_view *view) {
    return b->x1 < -DP_CLASSIFY_MARGIN || b->y1 < -DP_CLASSIFY_MARGIN ||
           b->x0 > (float)view->width + DP_CLASSIFY_MARGIN ||
           b->y0 > (float)view->height + DP_CLASSIFY_MARGIN;
}

/* Does the box lie well behind the surface in every block around it? */
static bool is_hidden(const box *b, const dp_chunk_view *v) {
    const float x0 = b->x0 - 1, y0 = b->y0 - 1, x1 = b->x1 + 1, y1 = b->y1 + 1;
    if (!(x0 >= 0 && y0 >= 0 && x1 < (float)(v->tiles_x * DP_TILE) &&
          y1 < (float)(v->tiles_y * DP_TILE)))
        return false;
    const uint32_t bx0 = (uint32_t)x0 / DP_BLOCK, bx1 = (uint32_t)x1 / DP_BLOCK;
    const uint32_t by0 = (uint32_t)y0 / DP_BLOCK, by1 = (uint32_t)y1 / DP_BLOCK;
    if (bx1 - bx0 > 16 || by1 - by0 > 16) return false;
    const float nearest =
        b->nearest + (float)fabs(dp_depth_step(v->view, b->nearest, DP_CLASSIFY_SLACK));
    for (uint32_t by = by0; by <= by1; by++)
        for (uint32_t bx = bx0; bx <= bx1; bx++) {
            const size_t tile = (size_t)(by / DP_BLOCKS) * v->tiles_x + bx / DP_BLOCKS;
            const size_t block = (size_t)(by % DP_BLOCKS) * DP_BLOCKS + bx % DP_BLOCKS;
            if (!(nearest < v->farthest[tile * DP_BLOCKS * DP_BLOCKS + block])) return false;
        }
    return true;
}

bool dp_triangle_is_hidden(const dp_chunk_view *view, const float *a, const float *b,
                           const float *c) {
    int outcodes[3];
    const box at =
        box_of(place_corner(view->view, a, &outcodes[0]), place_corner(view->view, b, &outcodes[1]),
               place_corner(view->view, c, &outcodes[2]));
    return !(outcodes[0] | outcodes[1] | outcodes[2]) && is_hidden(&at, view);
}

/* Does the box hold a sample point? Also true for boxes wider than two pixels. */
static bool holds_sample(const box *b, const dp_sampling *s) {
    const float x0 = b->x0 - DP_CLASSIFY_ROUNDING, y0 = b->y0 - DP_CLASSIFY_ROUNDING,
                x1 = b->x1 + DP_CLASSIFY_ROUNDING, y1 = b->y1 + DP_CLASSIFY_ROUNDING;
    const float px0 = floorf(x0), py0 = floorf(y0), px1 = floorf(x1), py1 = floorf(y1);
    if (px1 - px0 > 1 || py1 - py0 > 1) return true;
    const bool single = s->samples == 1;
    for (float py = py0; py <= py1; py++)
        for (float px = px0; px <= px1; px++)
            for (uint32_t i = 0; i < s->vectors; i++) {
                const dp_f4 half = dp_splat(0.5f);
                const dp_f4 x = dp_splat(px) + (single ? half : s->x[i]),
                            y = dp_splat(py) + (single ? half : s->y[i]);
                if (dp_any((x >= dp_splat(x0)) & (x <= dp_splat(x1)) & (y >= dp_splat(y0)) &
                           (y <= dp_splat(y1))))
                    return true;
            }
    return false;
}

/* Does the box touch one of the pixels? */
static bool holds_pixel(const box *b, const dp_chunk_view *v, const uint64_t *pixels) {
    const float w = (float)(v->tiles_x * DP_TILE - 1), h = (float)(v->tiles_y * DP_TILE - 1);
    const uint32_t x0 = (uint32_t)dp_minf(dp_maxf(b->x0 - DP_CLASSIFY_ROUNDING, 0), w),
                   x1 = (uint32_t)dp_minf(dp_maxf(b->x1 + DP_CLASSIFY_ROUNDING, 0), w);
    const uint32_t y0 = (uint32_t)dp_minf(dp_maxf(b->y0 - DP_CLASSIFY_ROUNDING, 0), h),
                   y1 = (uint32_t)dp_minf(dp_maxf(b->y1 + DP_CLASSIFY_ROUNDING, 0), h);
    for (uint32_t y = y0; y <= y1; y++)
        for (uint32_t tile = x0 / DP_TILE; tile <= x1 / DP_TILE; tile++) {
            const uint64_t row =
                pixels[((size_t)(y / DP_TILE) * v->tiles_x + tile) * DP_TILE + y % DP_TILE];
            const uint32_t from = tile == x0 / DP_TILE ? x0 % DP_TILE : 0;
            const uint32_t to = tile == x1 / DP_TILE ? x1 % DP_TILE : DP_TILE - 1;
            if (row >> from & (~(uint64_t)0 >> (63 - (to - from)))) return true;
        }
    return false;
}

static box box_of_corners(const float corners[9], const dp_view *view, int *any, int *all) {
    int outcodes[3];
    const box at = box_of(place_corner(view, corners, &outcodes[0]),
                          place_corner(view, corners + 3, &outcodes[1]),
                          place_corner(view, corners + 6, &outcodes[2]));
    *any = outcodes[0] | outcodes[1] | outcodes[2];
    *all = outcodes[0] & outcodes[1] & outcodes[2];
    return at;
}

uint32_t dp_chunk_pixel(const float corners[9], const dp_chunk_view *view) {
    int any, all;
    const box at = box_of_corners(corners, view->view, &any, &all);
    const uint32_t x = (uint32_t)dp_minf(dp_maxf(at.x0, 0),
                                         (float)(view->tiles_x * DP_TILE - 1)); /* NaN gives 0 */
    const uint32_t y = (uint32_t)dp_minf(dp_maxf(at.y0, 0), (float)(view->tiles_y * DP_TILE - 1));
    return ((y / DP_TILE * view->tiles_x + x / DP_TILE) * DP_TILE + y % DP_TILE) * DP_TILE +
           x % DP_TILE;
}

bool dp_edge_may_be_seen(const float *p, const float *q, const dp_view *view) {
    int outcodes[2];
    const dp_point a = place_corner(view, p, &outcodes[0]), b = place_corner(view, q, &outcodes[1]);
    if (outcodes[0] || outcodes[1]) return true;
    const box at = box_of(a, b, b);
    return !is_outside(&at, view);
}

static void classify_triangle(dp_chunk *chunk, uint32_t t, const dp_triangles *triangles,
                              const dp_chunk_view *view, dp_stats *stats) {
    float corners[9];
    int any, all;
    dp_triangle_corners(triangles, t, corners);
    const box at = box_of_corners(corners, view->view, &any, &all);
    chunk->state[t] = 0;
    if (any & NOT_FINITE) {
        stats->dropped_finite++;
        return;
    }
    if (all || (!any && is_outside(&at, view->view))) return;
    if (view->wanted) { /* few pixels are, so this drops most triangles */
        const uint8_t state =
            (any || holds_pixel(&at, view, view->wanted) ? DP_TRIANGLE_COVERS : 0) |
            (any || holds_pixel(&at, view, view->flagged) ? DP_TRIANGLE_FLAGGED : 0);
        if (state && (any || !is_hidden(&at, view))) chunk->state[t] = state;
        return;
    }
    if (!any && is_hidden(&at, view)) return;
    uint8_t facing;
    if (!dp_triangle_facing(view->view, corners, corners + 3, corners + 6, chunk->normal[t],
                            &facing)) {
        stats->dropped_area++;
        return;
    }
    chunk->state[t] = facing | DP_TRIANGLE_LIVE;
    if (any || holds_sample(&at, &view->sampling)) chunk->state[t] |= DP_TRIANGLE_COVERS;
}

void dp_chunk_classify(dp_chunk *chunk, const dp_triangles *triangles, const dp_chunk_view *view,
                       dp_stats *stats) {
    chunk->count = triangles->count;
    chunk->unsure_count = 0;
    if (view->wanted)
        view->kernels->touch(chunk, triangles, view);
    else
        view->kernels->classify(chunk, triangles, view);
    for (uint32_t i = 0; i < chunk->unsure_count; i++)
        classify_triangle(chunk, chunk->unsure[i], triangles, view, stats);
}

/* ------- maps of pixels ------- */

/* Sets one of the two bits of every pixel in `rows`, which may have bits beyond the tile. */
static void mark_pixels(const dp_chunk_view *v, const uint64_t *rows, uint32_t bit) {
    const uint64_t in = ~(uint64_t)0 >> (64 - DP_TILE);
    for (uint32_t tile = 0; tile < v->tiles_x * v->tiles_y; tile++)
        for (uint32_t i = 0; i < DP_TILE; i++)
            for (uint64_t left = rows[(size_t)tile * DP_TILE + i] & in; left; left &= left - 1) {
                const uint32_t x = tile % v->tiles_x * DP_TILE + (uint32_t)__builtin_ctzll(left);
                const uint32_t y = tile / v->tiles_x * DP_TILE + i;
                v->maps.words[(size_t)y * v->maps.row + x / 16] |= bit << x % 16 * 2;
            }
}

void dp_pixel_maps_fill(const dp_chunk_view *v) {
    uint32_t *const words = v->maps.words;
    const size_t map = v->maps.map, row = v->maps.row;
    memset(words, 0, map * sizeof *words);
    mark_pixels(v, v->wanted, 1);
    mark_pixels(v, v->flagged, 2);
    for (size_t i = 0; i < map; i++) {
        const uint32_t right = (i + 1) % row ? words[i + 1] : 0;
        words[map + i] = words[i] | words[i] >> 2 | right << 30;
    }
    for (size_t i = 0; i < map; i++) {
        words[2 * map + i] = words[i] | (i + row < map ? words[i + row] : 0);
        words[3 * map + i] = words[map + i] | (i + row < map ? words[map + i + row] : 0);
    }
}
