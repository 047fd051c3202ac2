/* Rasterizing convex polygons into a tile's depth samples. */
#include "pipe/coverage.h"
#include "pipe/tile.h"

typedef struct face {
    dp_tile_worker *worker;
    const dp_tile_polygon *polygon;
    uint32_t index;
} face;

DP_INLINED void draw(void *arg, size_t lane, dp_i4 in, dp_f4 d) {
    const face *const f = arg;
    const int32_t id = (int32_t)f->index;
    dp_f4 *const depth = (dp_f4 *)(void *)(f->worker->depth + lane);
    dp_i4 *const winner = (dp_i4 *)(void *)(f->worker->winner + lane);
    const dp_i4 win = in & (d > *depth);
    *depth = dp_select(win, d, *depth);
    *winner = dp_selecti(win, (dp_i4){id, id, id, id}, *winner);
}

/* The same, and tells where the polygon comes close to what was there (intersect.c). */
DP_INLINED void draw_watching(void *arg, size_t lane, dp_i4 in, dp_f4 d) {
    const face *const f = arg;
    const dp_f4 gap = d - *(const dp_f4 *)(const void *)(f->worker->depth + lane);
    const dp_i4 close = in & (gap < dp_splat(f->polygon->watch)) & (gap > dp_splat(-f->polygon->watch));
    if (dp_any(close)) dp_tile_watch(f->worker, f->index, lane, close, d);
    draw(arg, lane, in, d);
}

static void raster_triangle(face *f, dp_point a, dp_point b, dp_point c) {
    const dp_tile_polygon *const p = f->polygon;
    const dp_plane plane = {p->d0, p->dx, p->dy, p->nearest};
    const dp_sampling *const s = &f->worker->sampling;
    dp_coverage area;
    if (!dp_coverage_make(a, b, c, &area)) return;
    const bool watch = f->worker->frame->lines & DP_INTERSECTION && f->worker->frame->styles[0].ink == DP_INK_STROKES;
    switch (s->vectors + watch * 8u) {
    case 1: dp_coverage_fill(s, &area, &plane, 1, draw, f); break;
    case 2: dp_coverage_fill(s, &area, &plane, 2, draw, f); break;
    case 4: dp_coverage_fill(s, &area, &plane, 4, draw, f); break;
    case 9: dp_coverage_fill(s, &area, &plane, 1, draw_watching, f); break;
    case 10: dp_coverage_fill(s, &area, &plane, 2, draw_watching, f); break;
    default: dp_coverage_fill(s, &area, &plane, 4, draw_watching, f); break;
    }
}

void dp_tile_raster(dp_tile_worker *worker, const dp_tile_polygon *polygon, uint32_t index) {
    const dp_vertex *const p = worker->points + polygon->point;
    face f = {worker, polygon, index};
    for (uint32_t i = 2; i < polygon->points; i++)
        raster_triangle(&f, dp_place(p[0]), dp_place(p[i - 1]), dp_place(p[i]));
}
