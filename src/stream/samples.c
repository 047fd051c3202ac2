/* One reading: the picture's depth samples hide sample points of lines.
 *
 * A point is visible when a sample of its pixel or of the four beside it is no nearer than the
 * planes of the line's own polygons there: it then shows the surface that the line lies on, or what
 * is behind it.
 *
 * Not exact: behind the outline of something nearer, lines end up to a pixel late, and lines may
 * show through what is narrower than a pixel. */
#include "stream/draw.h"

/* Pixel sizes: a sample that is nearer by at most SLACK does not hide; planes steeper than STEEPEST
 * per px count as level. */
static const double SLACK = 2, STEEPEST = 8;

/* Depth d0 + dx x + dy y of a pending triangle's plane, x and y in the tile; level where it is seen
 * nearly edge-on. */
typedef struct plane {
    double d0, dx, dy;
} plane;

static plane plane_of(const dp_finder *w, uint32_t polygon, float x, float y, float d) {
    plane p = {d, 0, 0};
    if (polygon == UINT32_MAX) return p;
    const dp_vertex *const v = w->tile.frame->vertices + 3 * (size_t)polygon;
    const double bx = (double)v[1].x - v[0].x, by = (double)v[1].y - v[0].y,
                 bd = (double)v[1].d - v[0].d;
    const double cx = (double)v[2].x - v[0].x, cy = (double)v[2].y - v[0].y,
                 cd = (double)v[2].d - v[0].d;
    const double area = bx * cy - by * cx,
                 most = fabs(dp_depth_step(&w->tile.frame->view, d, STEEPEST));
    const double dx = (bd * cy - by * cd) / area, dy = (bx * cd - bd * cx) / area;
    if (!(fabs(dx) + fabs(dy) <= most)) return p; /* also NaN: clipped */
    return (plane){d - dx * x - dy * y, dx, dy};
}

static const float *samples_at(const dp_frame *frame, uint32_t x, uint32_t y) {
    const size_t tile = (size_t)(y / DP_TILE) * frame->tiles_x + x / DP_TILE;
    return frame->depth + tile * frame->tile_samples +
           (size_t)(y % DP_TILE * DP_TILE + x % DP_TILE) * frame->target.samples;
}

/* Does some sample of pixel (px, py) of the tile leave the point visible? */
static bool is_clear(const dp_finder *w, const plane own[2], double slack, int px, int py) {
    const int x = px + (int)w->tile.tile_x, y = py + (int)w->tile.tile_y;
    if (x < 0 || y < 0 || x >= (int)w->tile.frame->target.width ||
        y >= (int)w->tile.frame->target.height)
        return false;
    const float *const d = samples_at(w->tile.frame, (uint32_t)x, (uint32_t)y);
    const uint32_t samples = w->tile.frame->target.samples;
    for (uint32_t i = 0; i < samples; i++) {
        const double sx = px + (samples == 1 ? 0.5 : (double)w->tile.sampling.x[i / 4][i % 4]);
        const double sy = py + (samples == 1 ? 0.5 : (double)w->tile.sampling.y[i / 4][i % 4]);
        for (int k = 0; k < 2; k++)
            if (d[i] <= own[k].d0 + own[k].dx * sx + own[k].dy * sy + slack) return true;
    }
    return false;
}

static bool is_visible(const dp_finder *w, const dp_candidate *c, uint32_t probe) {
    static const int beside[5][2] = {{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    const float x = w->lines.probes.x[probe], y = w->lines.probes.y[probe],
                d = w->lines.probes.limit[probe];
    const plane own[2] = {plane_of(w, c->a, x, y, d), plane_of(w, c->b, x, y, d)};
    const double slack = fabs(dp_depth_step(&w->tile.frame->view, d, SLACK));
    const int px = (int)floorf(x), py = (int)floorf(y);
    for (int i = 0; i < 5; i++)
        if (is_clear(w, own, slack, px + beside[i][0], py + beside[i][1])) return true;
    return false;
}

void dp_stream_hide_by_samples(dp_finder *w) {
    dp_hide_points(w); /* the pending triangles hide exactly */
    for (uint32_t i = 0; i < w->lines.candidate_count; i++) {
        const dp_candidate *const c = &w->lines.candidates[i];
        for (uint32_t k = 0; k < c->k1 - c->k0; k++) {
            float *const limit = &w->lines.probes.limit[c->probe + k];
            if (*limit < INFINITY && !is_visible(w, c, c->probe + k)) *limit = INFINITY;
        }
    }
}
