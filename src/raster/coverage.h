/* Which samples of a tile a triangle covers, and its depth there.
 *
 * A sample is covered if three edge functions a x + b y + c are at least their thresholds. Each is
 * computed from the edge's ends in one canonical order, and negated if the triangle runs the other
 * way. Invariant: two triangles that share an edge get exactly opposite values at every sample, in
 * plain float arithmetic, so no sample is missed and none is covered twice. A zero belongs to the
 * side that runs the canonical way: its threshold is 0, the other's is the least positive float.
 *
 * Faster kernels must do the same operations in the same order. Not handled: clipping
 * (core/outline.c). */
#ifndef DP_RASTER_COVERAGE_H
#define DP_RASTER_COVERAGE_H

#include "raster/samples.h"

/* Inlined into a loop that passes constant arguments; compilers do that only when they optimise. */
#ifdef __OPTIMIZE__
#define DP_INLINED static inline __attribute__((always_inline))
#else
#define DP_INLINED static inline
#endif

typedef struct dp_edge_function {
    float a, b, c; /* a x + b y + c; inside if >= threshold */
    float threshold;
} dp_edge_function;

/* d = min(d0 + dx * x + dy * y, nearest), tile space: a plane seen nearly edge-on must not
 * overshoot its polygon. */
typedef struct dp_plane {
    float d0, dx, dy, nearest;
} dp_plane;

/* A triangle ready to be filled. */
typedef struct dp_coverage {
    dp_edge_function e[3];
    int box[4]; /* px: x0 y0 x1 y1, inclusive */
} dp_coverage;

/* Takes four samples, the first of which is `lane`. `in` has all bits of a covered sample's lane
 * set. */
typedef void dp_cover(void *arg, size_t lane, dp_i4 in, dp_f4 depth);

static inline dp_edge_function dp_edge_function_make(dp_point p, dp_point q, bool flip) {
    const bool swap = p.y > q.y || (p.y == q.y && p.x > q.x);
    const dp_point s = swap ? q : p, t = swap ? p : q;
    const float a = s.y - t.y, b = t.x - s.x;
    const float c = -(a * s.x + b * s.y);
    const bool negative = swap != flip;
    return negative ? (dp_edge_function){-a, -b, -c, 1.1754944e-38f /* the least positive float */}
                    : (dp_edge_function){a, b, c, 0};
}

static inline int dp_tile_px(float v) {
    return v <= 0 ? 0 : v >= DP_TILE - 1 ? DP_TILE - 1 : (int)v;
}

/* False: the triangle lies beside the tile. */
static inline bool dp_coverage_make(dp_point a, dp_point b, dp_point c, dp_coverage *out) {
    const float x0 = dp_minf(a.x, dp_minf(b.x, c.x)), x1 = dp_maxf(a.x, dp_maxf(b.x, c.x));
    const float y0 = dp_minf(a.y, dp_minf(b.y, c.y)), y1 = dp_maxf(a.y, dp_maxf(b.y, c.y));
    if (!(x1 > 0 && y1 > 0 && x0 < DP_TILE && y0 < DP_TILE)) return false;
    const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    const bool flip = area < 0;
    *out = (dp_coverage){{dp_edge_function_make(a, b, flip), dp_edge_function_make(b, c, flip),
                          dp_edge_function_make(c, a, flip)},
                         {dp_tile_px(x0), dp_tile_px(y0), dp_tile_px(x1), dp_tile_px(y1)}};
    return true;
}

/* Cuts from [*x0, *x1] pixels of row y that an edge leaves uncovered. */
static inline void dp_trim_row(const dp_edge_function *e, float y, int *x0, int *x1) {
    const float by = e->b > 0 ? e->b * (y + 1) : e->b * y;
    const float x = -(e->c + by) / e->a;
    if (e->a > 0) {
        if (x > (float)*x0) *x0 = x < DP_TILE ? (int)x : DP_TILE;
    } else if (e->a < 0) {
        if (x < (float)*x1) *x1 = x >= 0 ? (int)x : -1;
    }
}

/* Calls cover(arg, …) for every vector of samples in the box, covered or not. `vectors` must equal
 * s->vectors; it is passed so that it can be a constant, as `cover` is, which is inlined. */
DP_INLINED void dp_coverage_fill(const dp_sampling *s, const dp_coverage *c, const dp_plane *p,
                                 const uint32_t vectors, dp_cover *const cover, void *arg) {
    const dp_edge_function *const e = c->e;
    const int width = (int)s->cell_width;
    dp_f4 le[3][4], ld[4]; /* what samples add to the value at their pixel's upper edge */
    for (uint32_t v = 0; v < vectors; v++) {
        for (int i = 0; i < 3; i++) le[i][v] = dp_splat(e[i].b) * s->y[v];
        ld[v] = dp_splat(p->dy) * s->y[v];
    }
    const dp_f4 nearest = dp_splat(p->nearest);
    const dp_f4 t0 = dp_splat(e[0].threshold), t1 = dp_splat(e[1].threshold),
                t2 = dp_splat(e[2].threshold);
    for (int y = c->box[1]; y <= c->box[3]; y++) {
        int x0 = c->box[0], x1 = c->box[2];
        if (x1 - x0 > 3)
            for (int i = 0; i < 3; i++) dp_trim_row(&e[i], (float)y, &x0, &x1);
        if (x0 > x1) continue;
        const float fy = (float)y;
        const float r0 = e[0].b * fy + e[0].c, r1 = e[1].b * fy + e[1].c, r2 = e[2].b * fy + e[2].c;
        const float rd = p->d0 + p->dy * fy;
        size_t lane = (size_t)4 * vectors * ((uint32_t)y * s->cells_x + (uint32_t)(x0 / width));
        for (int cx = x0 / width; cx <= x1 / width; cx++, lane += 4 * vectors) {
            for (uint32_t v = 0; v < vectors; v++) {
                const dp_f4 x = dp_splat((float)(cx * width)) + s->x[v];
                const dp_i4 in = ((dp_splat(e[0].a) * x + le[0][v]) + dp_splat(r0) >= t0) &
                                 ((dp_splat(e[1].a) * x + le[1][v]) + dp_splat(r1) >= t1) &
                                 ((dp_splat(e[2].a) * x + le[2][v]) + dp_splat(r2) >= t2);
                const dp_f4 d = (dp_splat(p->dx) * x + ld[v]) + dp_splat(rd);
                cover(arg, lane + 4 * v, in, dp_select(d < nearest, d, nearest));
            }
        }
    }
}

#endif
