/* Does something that the polygons of an edge do not know change what the eye sees there? A part that
 * stands on another, a flush wall, a face that is there twice.
 *
 *    for each second sample point of the edge, on either side of it on the screen
 *        for each polygon that has won a sample beside the point, on this side
 *            its plane passes through the edge there,
 *            it is not the polygon expected there, nor goes on in its plane,
 *            and it reaches the edge:                  the edge is disputed
 *
 * Such edges are left to emergence, which looks at every polygon and every sample point. Invariant:
 * an edge is disputed too where the samples beside it are another tile's. Not handled: what is so
 * thin that no sample shows it. */
#include "find/fan.h"

/* px: where samples are looked at, to either side of the edge; one that lies nearer to it than
 * LEAST may be won by either side. */
static const double BESIDE = 0.5;
static const float LEAST = 0.02f;

/* px: how near to the edge a polygon must come to reach it. */
static const float REACHES[2] = {DP_LOOK_NEAR, DP_LOOK_FAR};

typedef struct place {
    float x, y, d;   /* a point of the edge, tile space */
    float ox, oy;    /* px: unit vector to the side */
    uint32_t expected; /* polygon; UINT32_MAX: none */
} place;

static bool reaches(const dp_tile *t, const dp_tile_polygon *p, const place *at) {
    for (int i = 0; i < 2; i++)
        if (dp_tile_covers(t, p, at->x + REACHES[i] * at->ox, at->y + REACHES[i] * at->oy))
            return true;
    return false;
}

/* Does polygon `index`, which has won the sample at (x, y), dispute the edge? */
static bool disputes(const dp_tile *t, uint32_t index, float x, float y, const place *at) {
    const dp_tile_polygon *const p = &t->polygons[index];
    if ((x - at->x) * at->ox + (y - at->y) * at->oy < LEAST) return false;
    const float tolerance = dp_touching(t, p, at->d);
    if (fabsf(dp_plane_at(p, at->x, at->y) - at->d) > tolerance) return false;
    if (at->expected != UINT32_MAX) {
        const dp_tile_polygon *const q = &t->polygons[at->expected];
        if (fabsf(dp_plane_at(p, x, y) - dp_plane_at(q, x, y)) <= tolerance) return false;
    }
    return reaches(t, p, at);
}

static bool is_disputed_at(const dp_tile *t, const place *at, const uint32_t sides[2]) {
    const float x = at->x + (float)BESIDE * at->ox, y = at->y + (float)BESIDE * at->oy;
    if (!(x >= 0 && y >= 0 && x < DP_TILE && y < DP_TILE)) return true;
    const uint32_t px = (uint32_t)x, py = (uint32_t)y, samples = t->sampling.samples;
    const uint32_t *const winner = t->winner + dp_pixel_lane(&t->sampling, px, py);
    for (uint32_t i = 0; i < samples; i++) {
        const uint32_t won = winner[i];
        if (won == UINT32_MAX || won == sides[0] || won == sides[1]) continue;
        const float sx = samples == 1 ? 0.5f : t->sampling.x[i / 4][i % 4],
                    sy = samples == 1 ? 0.5f : t->sampling.y[i / 4][i % 4];
        if (disputes(t, won, (float)px + sx, (float)py + sy, at)) return true;
    }
    return false;
}

bool dp_is_disputed(const dp_finder *w, const dp_spine *s, const uint32_t sides[2]) {
    const dp_tile *const t = &w->tile;
    const double ex = s->b.x - s->a.x, ey = s->b.y - s->a.y, length = dp_hypot(ex, ey);
    uint32_t k0, k1;
    if (!(length > 0) || w->lines.streamed || !dp_spine_range(s, t->tile_x, t->tile_y, 0, &k0, &k1))
        return false;
    const float right[2] = {(float)(-ey / length), (float)(ex / length)};
    for (uint32_t k = k0; k < k1; k += 2) {
        const dp_pointd p = dp_point_mix(s->a, s->b, (k + 0.5) / s->n);
        for (int side = 0; side < 2; side++) {
            const float sign = side ? 1 : -1;
            const place at = {(float)(p.x - t->tile_x), (float)(p.y - t->tile_y), (float)p.d,
                              sign * right[0], sign * right[1], sides[side]};
            if (is_disputed_at(t, &at, sides)) return true;
        }
    }
    return false;
}
