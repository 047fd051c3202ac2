/* Does something that the polygons of an edge do not know change what the eye sees there? A part that
 * stands on another, a flush wall, a face that is there twice.
 *
 *    for each STEP-th sample point of the edge, on either side of it on the screen
 *        for each polygon that has won a sample beside the point, on this side
 *            it is not the polygon expected there, nor in its plane,
 *            its plane passes through the edge there, and it reaches the edge;
 *            or it covers the edge from just above:    the edge is disputed
 *
 * With exact ends a pair of polygons that met at an edge between closed vertices, wound alike, with
 * front faces seen beside it, is trusted: what shares a vertex with it disputes it only where it
 * lies along the edge in space (dp_trusts_pair, dp_merely_meets).
 *
 * Disputed edges are left to emergence, which looks at every polygon and every sample point. Invariant:
 * an edge is disputed too where all samples beside it are another tile's. Not handled: what is so
 * thin that no sample shows it, or touches less than a pixel of the edge. */
#include "find/fan.h"

#include "core/closed.h"
#include "core/precision.h"

enum { STEP = 4 };

/* px: where samples are looked at, to either side of the edge; one that lies nearer to it than
 * LEAST may be won by either side. */
static const float BESIDE = 0.5f, LEAST = 0.02f;

typedef struct place {
    dp_lookout at;     /* a point of the edge, and the side */
    uint32_t expected; /* polygon; UINT32_MAX: none */
    dp_unpaired_edge own;
} place;

/* Sine of the angle below which an edge that runs near another is the same line. */
static const double PARALLEL = 0.1;

uint32_t dp_edge_along(const dp_tile *w, const dp_tile_polygon *p, const dp_lookout *at,
                       double reach) {
    const dp_polygons *const polygons = &w->frame->polygons;
    const dp_vertex *const v = w->points + p->point;
    if (p->flags & DP_POLYGON_CLIPPED) return UINT32_MAX;
    for (uint32_t i = 0; i < p->points; i++) {
        const dp_vertex a = v[i], b = v[i + 1 == p->points ? 0 : i + 1];
        const double ex = (double)b.x - a.x, ey = (double)b.y - a.y, length = dp_hypot(ex, ey);
        const double x = (double)at->x - a.x, y = (double)at->y - a.y, away = ex * y - ey * x,
                     on = ex * x + ey * y;
        if (fabs(ex * at->ox + ey * at->oy) <= PARALLEL * length && fabs(away) <= reach * length &&
            on >= -reach * length && on <= (length + reach) * length &&
            dp_edge_is_flagged(polygons, dp_first_corner(polygons, p->id) + i))
            return i;
    }
    return UINT32_MAX;
}

/* A polygon beside the one that is expected must lie over that right at the edge. */
static bool reaches(const dp_tile *t, const dp_tile_polygon *p, const place *here) {
    const bool past_cracks = here->expected == UINT32_MAX && !dp_is_beside_pair(t, p, here->own);
    const int count = past_cracks ? 2 : 1;
    const float reach[2] = {DP_LOOK_NEAR, dp_look_far(t)};
    for (int i = 0; i < count; i++)
        if (dp_tile_covers(t, p, here->at.x + reach[i] * here->at.ox,
                           here->at.y + reach[i] * here->at.oy))
            return true;
    return false;
}

/* Does the surface that is expected there go on at the sample (x, y), whose depth is d? */
static bool goes_on(const dp_tile *t, float x, float y, float d, const place *here) {
    if (here->expected == UINT32_MAX) return false;
    const dp_tile_polygon *const p = &t->polygons[here->expected];
    return fabsf(dp_plane_at(p, x, y) - d) <= dp_touching(t, p, here->at.d);
}

/* Sine of the angle to an edge, at the end that they share, from which on a polygon leaves it; and
 * where coordinates are rounded to few decimals. */
static const double LEAVES = 2e-3, LEAVES_ROUNDED = 0.1;

/* Does a polygon that has a corner between `last` and `next`, seen from there, leave the direction
 * `along`? The corner may be straight. `along` and `normal` are unit vectors. */
static bool leaves(dp_vec3 along, dp_vec3 normal, dp_vec3 last, dp_vec3 next, double least) {
    const dp_vec3 sides[2] = {dp_unit(next), dp_unit(last)};
    if (dp_dot(dp_cross(next, along), normal) > 0 && dp_dot(dp_cross(along, last), normal) > 0)
        return fabs(dp_dot(along, normal)) > least;
    for (int i = 0; i < 2; i++)
        if (dp_dot(sides[i], along) > 0 && dp_length(dp_cross(sides[i], along)) <= least)
            return false;
    return true;
}

static dp_vec3 corner_at(const dp_tile *t, const dp_tile_polygon *p, uint32_t i) {
    const dp_polygons *const polygons = &t->frame->polygons;
    return dp_v3f(dp_vertex_position(
        polygons, dp_corner_vertex(polygons, dp_first_corner(polygons, p->id) + i % p->points)));
}

/* Around a vertex of a fine mesh, where it is seen nearly edge-on, all triangles pass within a part of
 * a pixel of its edges on the screen. In space those that do not lie in the edge leave it. */
bool dp_merely_meets(const dp_tile *t, const dp_tile_polygon *p, dp_unpaired_edge edge) {
    if (!edge.trusted || dp_shared_ends(t, p, edge) != 1) return false;
    const dp_tile_polygon *const q = &t->polygons[edge.polygon];
    const dp_vertex *const v = t->points + p->point, *const u = t->points + q->point;
    const dp_vec3 normal = dp_polygon_normal(t->frame, p->id);
    const double least = t->frame->precision > 0 ? LEAVES_ROUNDED : LEAVES;
    const uint32_t from = u[edge.edge].key, to = u[(edge.edge + 1) % q->points].key;
    const dp_vec3 along =
        dp_unit(dp_sub(corner_at(t, q, edge.edge + 1), corner_at(t, q, edge.edge)));
    for (uint32_t i = 0; i < p->points; i++) {
        if (v[i].key != from && v[i].key != to) continue;
        const dp_vec3 at = corner_at(t, p, i);
        if (!leaves(v[i].key == from ? along : dp_scale(along, -1), normal,
                    dp_sub(corner_at(t, p, i + p->points - 1u), at),
                    dp_sub(corner_at(t, p, i + 1), at), least))
            return false;
    }
    return true;
}

/* Does polygon `index` lie in the edge there, and reach it; or just over it? */
static bool disputes(const dp_tile *t, uint32_t index, const place *here) {
    const dp_tile_polygon *const p = &t->polygons[index];
    const float gap = dp_plane_at(p, here->at.x, here->at.y) - here->at.d,
                tolerance = dp_touching(t, p, here->at.d);
    if (gap < -tolerance || gap > dp_maxf(tolerance, dp_over(t, p, here->at.d))) return false;
    if (t->frame->precision > 0 && dp_is_sliver(t->frame, p->id)) return false;
    if (dp_merely_meets(t, p, here->own)) return false;
    if (gap > tolerance)
        return dp_lies_over(t, p, &here->at) && dp_tile_covers(t, p, here->at.x, here->at.y) &&
               !dp_are_neighbours(t, p, &t->polygons[here->own.polygon]);
    const uint32_t shared = dp_shared_ends(t, p, here->own);
    return shared < 2 && reaches(t, p, here) &&
           (dp_holds_edge(t, p, &here->at, shared > 0) ||
            dp_edge_along(t, p, &here->at, (double)dp_look_far(t)) != UINT32_MAX);
}

/* Depths of a point and of a sample beside it differ by no more pixel sizes, where a plane passes
 * through both; a steeper one is seen edge-on. */
static const float STEEPEST = 64;

static bool is_disputed_at(const dp_tile *t, const place *here, const uint32_t sides[2]) {
    const float last = DP_TILE - 1, x = floorf(here->at.x + BESIDE * here->at.ox),
                y = floorf(here->at.y + BESIDE * here->at.oy);
    const float px = dp_minf(dp_maxf(x, 0), last), py = dp_minf(dp_maxf(y, 0), last);
    const uint32_t samples = t->sampling.samples;
    const size_t lane = dp_pixel_lane(&t->sampling, (uint32_t)px, (uint32_t)py);
    const float most = fabsf(dp_depth_steps(t->frame, here->at.d, STEEPEST));
    bool looked = px == x && py == y; /* else the pixel is another tile's */
    for (uint32_t i = 0; i < samples; i++) {
        const float sx = px + (samples == 1 ? 0.5f : t->sampling.x[i / 4][i % 4]),
                    sy = py + (samples == 1 ? 0.5f : t->sampling.y[i / 4][i % 4]);
        if ((sx - here->at.x) * here->at.ox + (sy - here->at.y) * here->at.oy < LEAST) continue;
        looked = true;
        const uint32_t won = t->winner[lane + i];
        const float d = t->depth[lane + i];
        if (won == UINT32_MAX || won == sides[0] || won == sides[1] ||
            fabsf(d - here->at.d) > most || goes_on(t, sx, sy, d, here))
            continue;
        if (disputes(t, won, here)) return true;
    }
    return !looked;
}

bool dp_is_disputed(const dp_finder *w, dp_unpaired_edge own, const dp_spine *s,
                    const uint32_t sides[2]) {
    const dp_tile *const t = &w->tile;
    const double ex = s->b.x - s->a.x, ey = s->b.y - s->a.y, length = dp_hypot(ex, ey);
    uint32_t k0, k1;
    if (!(length > 0) || w->lines.streamed || !dp_spine_range(s, t->tile_x, t->tile_y, 0, &k0, &k1))
        return false;
    const float right[2] = {(float)(-ey / length), (float)(ex / length)},
                along = (float)((s->b.d - s->a.d) / length);
    for (uint32_t k = k1 - k0 > 2 ? k0 + 1 : k0; k < k1; k += STEP) {
        const dp_pointd p = dp_point_mix(s->a, s->b, (k + 0.5) / s->n);
        for (int side = 0; side < 2; side++) {
            const float sign = side ? 1 : -1;
            const place here = {{(float)(p.x - t->tile_x), (float)(p.y - t->tile_y), (float)p.d,
                                 sign * right[0], sign * right[1], sign * along},
                                sides[side],
                                own};
            if (is_disputed_at(t, &here, sides)) return true;
        }
    }
    return false;
}

/* ------- which side of a surface is seen ------- */

/* Back faces less front faces among the samples of the pixel at (x, y). */
static int32_t backs_at(const dp_tile *t, float x, float y) {
    int32_t sum = 0;
    if (!(x >= 0 && y >= 0 && x < DP_TILE && y < DP_TILE)) return 0;
    const uint32_t *const winner =
        t->winner + dp_pixel_lane(&t->sampling, (uint32_t)x, (uint32_t)y);
    for (uint32_t i = 0; i < t->sampling.samples; i++)
        if (winner[i] != UINT32_MAX)
            sum += t->polygons[winner[i]].flags & DP_POLYGON_FRONT ? -1 : 1;
    return sum;
}

/* px from the edge, whose pixels are asked: a fold of a fine mesh, below what is seen, is not to
 * decide. */
static const float AROUND[] = {0.5f, 1.5f, 2.5f};

/* Back faces less front faces among the samples beside the spine, to its right or to its left. */
static int32_t backs_beside(const dp_finder *w, const dp_spine *s, bool right) {
    const dp_tile *const t = &w->tile;
    const double ex = s->b.x - s->a.x, ey = s->b.y - s->a.y, length = dp_hypot(ex, ey);
    uint32_t k0, k1;
    int32_t sum = 0;
    if (!(length > 0) || !dp_spine_range(s, t->tile_x, t->tile_y, 1, &k0, &k1)) return 0;
    const float ox = (float)((right ? -ey : ey) / length),
                oy = (float)((right ? ex : -ex) / length);
    for (uint32_t k = k1 - k0 > 2 ? k0 + 1 : k0; k < k1; k += STEP) {
        const dp_pointd p = dp_point_mix(s->a, s->b, (k + 0.5) / s->n);
        const float x = (float)(p.x - t->tile_x), y = (float)(p.y - t->tile_y);
        for (size_t i = 0; i < sizeof AROUND / sizeof *AROUND; i++)
            sum += backs_at(t, x + AROUND[i] * ox, y + AROUND[i] * oy);
    }
    return sum;
}

bool dp_shows_back_beside(const dp_finder *w, const dp_spine *s, bool right) {
    return backs_beside(w, s, right) > 0;
}

/* ------- pairs that are trusted ------- */

bool dp_trusts_pair(const dp_finder *w, const dp_edge_entry *e) {
    const dp_frame *const f = w->tile.frame;
    dp_spine s;
    if (!f->exact_ends || w->finds_hidden || e->b == UINT32_MAX || e->more || !e->opposed ||
        !dp_is_closed_at(f, f->vertices[e->va].key) || !dp_is_closed_at(f, f->vertices[e->vb].key))
        return false;
    if (!w->tile.sees_backs) return true;
    if (!dp_spine_ends(&f->view, dp_v3f(dp_vertex_position(&f->polygons, e->va)),
                       dp_v3f(dp_vertex_position(&f->polygons, e->vb)), &s))
        return false;
    const int32_t left = backs_beside(w, &s, false), right = backs_beside(w, &s, true);
    return left <= 0 && right <= 0 && left + right < 0;
}
