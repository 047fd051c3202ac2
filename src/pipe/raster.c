/* Rasterizing convex polygons into a tile's depth samples.
 *
 * Coverage is the sign of three edge functions. Each is computed from its end points in one canonical
 * order and then negated where the triangle runs the other way, so that two triangles that share an
 * edge get exactly opposite values at every sample, in plain float arithmetic: no sample is missed
 * and none is covered twice. A zero belongs to the side that runs the canonical way.
 * This is the truth for any faster kernel: same operations, same order. */
#include "pipe/tile.h"

typedef struct edge {
    float a, b, c; /* a x + b y + c; inside where >= threshold */
    float threshold;
} edge;

static edge edge_setup(dp_vertex p, dp_vertex q, bool flip) {
    const bool swap = p.y > q.y || (p.y == q.y && p.x > q.x);
    const dp_vertex s = swap ? q : p, t = swap ? p : q;
    const float a = s.y - t.y, b = t.x - s.x;
    const float c = -(a * s.x + b * s.y);
    const bool negative = swap != flip;
    return negative ? (edge){-a, -b, -c, 1.1754944e-38f /* the least above zero */} : (edge){a, b, c, 0};
}

/* Pixels of row y that an edge may leave uncovered are cut from [*x0, *x1]. */
static void trim_row(const edge *e, float y, int *x0, int *x1) {
    const float by = e->b > 0 ? e->b * (y + 1) : e->b * y;
    const float x = -(e->c + by) / e->a;
    if (e->a > 0) {
        if (x > (float)*x0) *x0 = x < DP_TILE ? (int)x : DP_TILE;
    } else if (e->a < 0) {
        if (x < (float)*x1) *x1 = x >= 0 ? (int)x : -1;
    }
}

static inline __attribute__((always_inline)) void
fill(dp_tile_worker *w, const edge e[3], const dp_tile_polygon *p, uint32_t index, const int box[4],
     const uint32_t vectors, const bool watch) {
    const dp_sampling *const s = &w->sampling;
    const int width = (int)s->cell_width;
    dp_f4 le[3][4], ld[4]; /* what lane offsets add */
    for (uint32_t v = 0; v < vectors; v++) {
        for (int i = 0; i < 3; i++)
            le[i][v] = dp_splat(e[i].a) * s->x[v] + dp_splat(e[i].b) * s->y[v];
        ld[v] = dp_splat(p->dx) * s->x[v] + dp_splat(p->dy) * s->y[v];
    }
    const dp_f4 nearest = dp_splat(p->nearest);
    const int32_t id = (int32_t)index;
    const dp_i4 ids = {id, id, id, id};
    for (int y = box[1]; y <= box[3]; y++) {
        int x0 = box[0], x1 = box[2];
        if (x1 - x0 > 3)
            for (int i = 0; i < 3; i++) trim_row(&e[i], (float)y, &x0, &x1);
        for (int cx = x0 / width; cx <= x1 / width && x0 <= x1; cx++) {
            const float fx = (float)(cx * width), fy = (float)y;
            const size_t lane = (size_t)4 * vectors * ((uint32_t)y * s->cells_x + (uint32_t)cx);
            const dp_f4 b0 = dp_splat(e[0].a * fx + e[0].b * fy + e[0].c);
            const dp_f4 b1 = dp_splat(e[1].a * fx + e[1].b * fy + e[1].c);
            const dp_f4 b2 = dp_splat(e[2].a * fx + e[2].b * fy + e[2].c);
            const dp_f4 bd = dp_splat(p->d0 + p->dx * fx + p->dy * fy);
            for (uint32_t v = 0; v < vectors; v++) {
                const dp_i4 in = (b0 + le[0][v] >= dp_splat(e[0].threshold)) &
                                 (b1 + le[1][v] >= dp_splat(e[1].threshold)) &
                                 (b2 + le[2][v] >= dp_splat(e[2].threshold));
                dp_f4 *const depth = (dp_f4 *)(void *)(w->depth + lane + 4 * v);
                dp_i4 *const winner = (dp_i4 *)(void *)(w->winner + lane + 4 * v);
                dp_f4 d = bd + ld[v];
                d = dp_select(d < nearest, d, nearest); /* a plane seen edge-on must not overshoot */
                if (watch) {
                    const dp_f4 gap = d - *depth;
                    const dp_i4 close = in & (gap < dp_splat(p->watch)) & (gap > dp_splat(-p->watch));
                    if (dp_any(close)) dp_tile_watch(w, index, lane + 4 * v, close, d);
                }
                const dp_i4 win = in & (d > *depth);
                *depth = dp_select(win, d, *depth);
                *winner = dp_selecti(win, ids, *winner);
            }
        }
    }
}

static float min3(float a, float b, float c) { return dp_minf(a, dp_minf(b, c)); }
static float max3(float a, float b, float c) { return dp_maxf(a, dp_maxf(b, c)); }
static int clamp_px(float v) { return v <= 0 ? 0 : v >= DP_TILE - 1 ? DP_TILE - 1 : (int)v; }

static void raster_triangle(dp_tile_worker *w, dp_vertex a, dp_vertex b, dp_vertex c,
                            const dp_tile_polygon *p, uint32_t index) {
    const float x0 = min3(a.x, b.x, c.x), x1 = max3(a.x, b.x, c.x);
    const float y0 = min3(a.y, b.y, c.y), y1 = max3(a.y, b.y, c.y);
    if (!(x1 > 0 && y1 > 0 && x0 < DP_TILE && y0 < DP_TILE)) return;
    const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    const bool flip = area < 0;
    const edge e[3] = {edge_setup(a, b, flip), edge_setup(b, c, flip), edge_setup(c, a, flip)};
    const int box[4] = {clamp_px(x0), clamp_px(y0), clamp_px(x1), clamp_px(y1)};
    const bool watch = w->frame->lines & DP_INTERSECTION;
    switch (w->sampling.vectors + watch * 8u) {
    case 1: fill(w, e, p, index, box, 1, false); break;
    case 2: fill(w, e, p, index, box, 2, false); break;
    case 4: fill(w, e, p, index, box, 4, false); break;
    case 9: fill(w, e, p, index, box, 1, true); break;
    case 10: fill(w, e, p, index, box, 2, true); break;
    default: fill(w, e, p, index, box, 4, true); break;
    }
}

void dp_tile_raster(dp_tile_worker *worker, const dp_tile_polygon *polygon, uint32_t index) {
    const dp_vertex *const p = worker->points + polygon->point;
    for (uint32_t i = 2; i < polygon->points; i++)
        raster_triangle(worker, p[0], p[i - 1], p[i], polygon, index);
}
