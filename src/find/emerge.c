/* Edges of which the table does not know everything: what lies beside them is looked up on the
 * screen.
 *
 *    for each such edge, for each sample point of its spine in or beside the tile
 *        the polygons whose planes pass through it and that cover places NEAR and FAR px to the left
 *        and to the right of the edge                                          look.inc
 *        on either side the one that lies nearest to the eye a little way off hides the others
 *            on both sides, of one plane    no line
 *            on both sides                  fold: ridge, valley or flat (core/fold.c)
 *            on one side                    silhouette if several planes meet there, else border
 *        of several polygons with an edge here only one makes the line         find_owner
 *        and none if the table has made it, or a surface lies just over it
 *    runs of points with the same line and polygons become candidates
 *
 * An edge with one polygon is a border, or its neighbours share no corner with it: T-junctions,
 * cracks, parts that touch. With (Raskar 2001, 2.2 and 2.3) the added quads tell these apart, as a
 * neighbour hides or traps them right beside the edge. Here the neighbour is looked up where the
 * quads would lie, and then classified exactly, so folds appear by the same thresholds as
 * elsewhere.
 *
 * Data structure: sample points sorted by cell. Invariant: neither winding nor the order of polygons
 * matters. Not handled: cracks wider than FAR px on the screen (they become two borders). */
#include "core/fold.h"
#include "find/fan.h"
#include "find/kernels.h"

#include <string.h>

/* px from the edge at which it is compared which polygon lies nearest to the eye. */
static const float OFF = 0.25f;

/* Pixel sizes there by which a polygon must lie nearer: less is rounding, and of such the first in
 * the source counts. */
static const float NEARER = 1e-3f;

/* Pixel sizes: more than any two polygons at one edge differ by. */
static const float BEYOND = 1e5f;

/* px: an edge of another polygon that runs so near by, with the polygon NEAR or FAR of here, is the
 * same line. */
static const double ALONG_NEAR = (double)DP_ALONG_NEAR;
static double along_far(const dp_finder *w) { return 1.2 * (double)dp_look_far(&w->tile); }

#define NO_EDGE                                                                                    \
    { UINT32_MAX, UINT32_MAX, 0, false }

typedef struct dp_emerging {
    dp_unpaired_edge unpaired;
    uint32_t id;  /* frame polygon */
    dp_vec3 a, b; /* ends, world space */
    dp_spine spine;
    uint32_t k0, k1; /* sample points [k0, k1) in the tile or right beside it */
    uint32_t first;  /* number of the first place where it is looked */
    uint32_t step;   /* sample points for one place */
    dp_sight sight;
} emerging;

void dp_leave_to_emerge(dp_finder *w, dp_unpaired_edge edge) {
    if (!DP_TILE_RESERVE(&w->tile, w, emergence.unpaired, emergence.unpaired_cap,
                         w->emergence.unpaired_count + 1u))
        return;
    w->emergence.unpaired[w->emergence.unpaired_count++] = edge;
}

/* Sample points in and beside the tile are consecutive, as the tile is convex. False: there are
 * none. */
static bool begin_edge(dp_finder *w, dp_unpaired_edge unpaired, emerging *e) {
    const dp_polygons *const polygons = &w->tile.frame->polygons;
    e->unpaired = unpaired;
    e->id = w->tile.polygons[unpaired.polygon].id;
    const uint32_t first = dp_first_corner(polygons, e->id), n = dp_corner_count(polygons, e->id);
    const uint32_t va = dp_corner_vertex(polygons, first + unpaired.edge);
    const uint32_t vb = dp_corner_vertex(polygons, first + (unpaired.edge + 1) % n);
    e->a = dp_v3f(dp_vertex_position(polygons, va));
    e->b = dp_v3f(dp_vertex_position(polygons, vb));
    return dp_spine_make(&w->tile.frame->view, e->a, e->b, dp_v3(0, 0, 0), &e->spine) &&
           dp_spine_range(&e->spine, w->tile.tile_x, w->tile.tile_y, (double)DP_BESIDE, &e->k0,
                          &e->k1) &&
           dp_sight_make(&w->tile.frame->view, e->a, e->b, &e->sight);
}

/* ------- placing the sample points ------- */

/* Of edges this short, in sample points, every other one will do. */
enum { SHORT = 8 };

static uint32_t places(const emerging *e) { return (e->k1 - e->k0 + e->step - 1) / e->step; }

static uint32_t look_cell(float x, float y) {
    const uint32_t last = DP_LOOK_CELLS - 1;
    const uint32_t cx = x <= 0 ? 0 : dp_minf(x / DP_LOOK_CELL, (float)last),
                   cy = y <= 0 ? 0 : dp_minf(y / DP_LOOK_CELL, (float)last);
    return cy * DP_LOOK_CELLS + cx;
}

/* The polygon's own side of its edge, 0 is the left: polygons are wound counter-clockwise as seen
 * from their front. */
static int own_side(const dp_finder *w, uint32_t polygon) {
    return !(w->tile.polygons[polygon].flags & DP_POLYGON_FRONT);
}

static bool place_points(dp_finder *w, const emerging *e, uint32_t *count) {
    const size_t need = (size_t)*count + places(e);
    if (!DP_TILE_RESERVE(&w->tile, w, emergence.placed, emergence.placed_cap, need) ||
        !DP_TILE_RESERVE(&w->tile, w, emergence.beheld, emergence.beheld_cap, need))
        return false;
    const double ex = e->spine.b.x - e->spine.a.x, ey = e->spine.b.y - e->spine.a.y,
                 length = dp_hypot(ex, ey);
    const float ox = length > 0 ? (float)(-ey / length) : 1,
                oy = length > 0 ? (float)(ex / length) : 0,
                along = length > 0 ? (float)((e->spine.b.d - e->spine.a.d) / length) : 0;
    for (uint32_t k = e->k0; k < e->k1; k += e->step) {
        const double middle = k + (k + e->step <= e->k1 ? e->step : 1) / 2.0;
        const dp_pointd p = dp_point_mix(e->spine.a, e->spine.b, middle / e->spine.n);
        w->emergence.beheld[*count] = (dp_beheld){.own = e->unpaired,
                                                  .first = e->unpaired,
                                                  .nearest = {NO_EDGE, NO_EDGE},
                                                  .furthest = {UINT32_MAX, UINT32_MAX}};
        w->emergence.placed[(*count)++] = (dp_lookout){(float)(p.x - w->tile.tile_x),
                                                       (float)(p.y - w->tile.tile_y),
                                                       (float)p.d,
                                                       ox,
                                                       oy,
                                                       along};
    }
    return true;
}

static bool reserve_lookouts(dp_finder *w, uint32_t count) {
    const size_t room = (size_t)count + DP_LOOK_ROOM;
    return DP_TILE_RESERVE(&w->tile, w, emergence.lookouts.x, emergence.lookouts.x_cap, room) &&
           DP_TILE_RESERVE(&w->tile, w, emergence.lookouts.y, emergence.lookouts.y_cap, room) &&
           DP_TILE_RESERVE(&w->tile, w, emergence.lookouts.d, emergence.lookouts.d_cap, room) &&
           DP_TILE_RESERVE(&w->tile, w, emergence.lookouts.ox, emergence.lookouts.ox_cap, room) &&
           DP_TILE_RESERVE(&w->tile, w, emergence.lookouts.oy, emergence.lookouts.oy_cap, room) &&
           DP_TILE_RESERVE(&w->tile, w, emergence.lookouts.step, emergence.lookouts.step_cap,
                           room) &&
           DP_TILE_RESERVE(&w->tile, w, emergence.lookouts.own, emergence.lookouts.own_cap, room) &&
           DP_TILE_RESERVE(&w->tile, w, emergence.lookouts.point, emergence.lookouts.point_cap,
                           room);
}

static uint32_t pixel_of(float px) {
    return px <= 0 ? 0 : px >= DP_TILE ? DP_TILE - 1 : (uint32_t)px;
}

/* Marks the pixels in and around which points lie, cells of DP_CELL px, and blocks of these. */
static void mark_cells(dp_finder *w, uint32_t count) {
    dp_lookouts *const out = &w->emergence.lookouts;
    const uint32_t all = DP_CELLS * DP_CELLS;
    memset(out->there, 0, sizeof out->there);
    memset(out->row, 0, sizeof out->row);
    const float reach = dp_look_far(&w->tile);
    for (uint32_t i = 0; i < count; i++)
        for (int k = 0; k < 4; k++) {
            const uint32_t x = pixel_of(w->emergence.placed[i].x + (k & 1 ? reach : -reach)),
                           y = pixel_of(w->emergence.placed[i].y + (k & 2 ? reach : -reach));
            out->row[y] |= (uint64_t)1 << x;
            out->there[0][0][y / DP_CELL * DP_CELLS + x / DP_CELL] = 1;
        }
    for (uint32_t s = 1; s < DP_CELL_SPANS; s++)
        for (uint32_t i = 0; i < all; i++)
            out->there[0][s][i] = out->there[0][s - 1][i] | out->there[0][0][i + s];
    for (uint32_t s = 1; s < DP_CELL_SPANS; s++)
        for (uint32_t k = 0; k < DP_CELL_SPANS; k++)
            for (uint32_t i = 0; i < all; i++)
                out->there[s][k][i] = out->there[s - 1][k][i] | out->there[0][k][i + s * DP_CELLS];
}

/* Sorts the points by cell (counting sort). */
static bool sort_points(dp_finder *w, uint32_t count) {
    dp_lookouts *const out = &w->emergence.lookouts;
    const dp_lookout *const placed = w->emergence.placed;
    uint32_t sum = 0;
    if (!reserve_lookouts(w, count)) return false;
    memset(out->first, 0, sizeof out->first);
    for (uint32_t i = 0; i < count; i++) out->first[look_cell(placed[i].x, placed[i].y)]++;
    for (uint32_t i = 0; i < DP_LOOK_CELLS * DP_LOOK_CELLS; i++)
        out->first[i] = sum += out->first[i];
    out->first[DP_LOOK_CELLS * DP_LOOK_CELLS] = sum;
    for (uint32_t i = count; i-- > 0;) {
        const dp_lookout *const p = &placed[i];
        const uint32_t at = --out->first[look_cell(p->x, p->y)];
        out->x[at] = p->x, out->y[at] = p->y, out->d[at] = p->d;
        out->ox[at] = p->ox, out->oy[at] = p->oy;
        out->step[at] = fabsf(dp_depth_steps(w->tile.frame, p->d, w->tile.frame->touching));
        out->point[at] = i, out->own[at] = w->emergence.beheld[i].own.polygon;
    }
    mark_cells(w, count);
    return true;
}

/* ------- what is found ------- */

/* Keeps the polygon if it lies nearer at a side than what is there. */
static void keep_nearest(const dp_finder *w, dp_unpaired_edge *nearest, float *nearest_d,
                         dp_unpaired_edge here, float d, float rounding) {
    const bool there = nearest->polygon != UINT32_MAX,
               is_first = there &&
                          w->tile.polygons[here.polygon].id < w->tile.polygons[nearest->polygon].id;
    if (there && !(d > *nearest_d + rounding) && !(is_first && d >= *nearest_d - rounding)) return;
    *nearest = here, *nearest_d = d;
}

static bool face_alike(const dp_finder *w, uint32_t a, uint32_t b) {
    return !((w->tile.polygons[a].flags ^ w->tile.polygons[b].flags) & DP_POLYGON_FRONT);
}

/* Of two in one plane, the one that faces another way than the nearest. */
static void keep_furthest(const dp_finder *w, dp_beheld *b, int side, uint32_t index, float d,
                          float rounding) {
    const uint32_t near = b->nearest[side].polygon, had = b->furthest[side];
    const bool other = had != UINT32_MAX && d <= b->furthest_d[side] + rounding &&
                       face_alike(w, near, had) && !face_alike(w, near, index);
    if (had != UINT32_MAX && !(d < b->furthest_d[side] - rounding) && !other) return;
    b->furthest[side] = index, b->furthest_d[side] = d;
}

/* The polygon's edge along here, by the places that it covers NEAR and FAR; edge UINT32_MAX: it has
 * none. Where the sides of a crack overlap, what a polygon covers is what it covers FAR. */
static dp_unpaired_edge edge_here(const dp_finder *w, uint32_t index, const dp_lookout *at,
                                  uint32_t *near, uint32_t far) {
    const dp_tile_polygon *const p = &w->tile.polygons[index];
    const bool overlaps = *near == 3 && (far == 1 || far == 2), beyond = !*near && far != 3;
    dp_unpaired_edge here = {index, UINT32_MAX, 0, false};
    if (overlaps || beyond)
        here.edge = dp_edge_along(&w->tile, p, at, along_far(w));
    else if (*near != 3 && *near)
        here.edge = dp_edge_along(&w->tile, p, at, ALONG_NEAR);
    if (overlaps && here.edge != UINT32_MAX) *near = far;
    return here;
}

/* A polygon beyond a crack has an edge along it; others there merely come near. */
static void behold(dp_finder *w, uint32_t point, uint32_t index, uint32_t sides) {
    dp_beheld *const b = &w->emergence.beheld[point];
    const dp_lookout *const at = &w->emergence.placed[point];
    const dp_tile_polygon *const p = &w->tile.polygons[index];
    const float gap = dp_plane_at(p, at->x, at->y) - at->d, slope = p->dx * at->ox + p->dy * at->oy,
                rounding = fabsf(dp_depth_steps(w->tile.frame, at->d, NEARER));
    /* Where cracks are not to be expected, what lies beyond one counts only if nothing else is there. */
    const float beyond =
        w->tile.frame->precision > 0 ? 0 : fabsf(dp_depth_steps(w->tile.frame, at->d, BEYOND));
    uint32_t near = sides & 3;
    const uint32_t far = sides >> 2;
    if (gap > dp_touching(&w->tile, p, at->d)) {
        b->is_hidden |= near == 3 && dp_lies_over(&w->tile, p, at) &&
                        !dp_are_neighbours(&w->tile, p, &w->tile.polygons[b->own.polygon]);
        return;
    }
    const bool is_partner = index + 1 == b->own.partner;
    if (dp_merely_meets(&w->tile, p, b->own) ||
        (!near && !is_partner && dp_is_beside_pair(&w->tile, p, b->own)))
        return;
    const dp_unpaired_edge here = edge_here(w, index, at, &near, far);
    if (here.edge == UINT32_MAX &&
        !dp_holds_edge(&w->tile, p, at, dp_shared_ends(&w->tile, p, b->own) > 0))
        return;
    for (int side = 0; side < 2; side++) {
        const bool is_near = near >> side & 1;
        const float d = gap + OFF * (side ? slope : -slope) - (is_near ? 0 : beyond);
        if (!is_near && !(!near && far >> side & 1 && here.edge != UINT32_MAX)) continue;
        b->is_foreign |= !is_partner;
        keep_nearest(w, &b->nearest[side], &b->nearest_d[side], here, d, rounding);
        if (is_near || !(beyond > 0)) keep_furthest(w, b, side, index, d, rounding);
    }
    if (here.edge == UINT32_MAX) return;
    if (p->id < w->tile.polygons[b->first.polygon].id && dp_emerges(w, here)) b->first = here;
    b->is_drawn |= dp_is_drawn(w, here);
}

void dp_behold(dp_finder *w, uint32_t lookout, uint32_t index, uint32_t sides) {
    behold(w, w->emergence.lookouts.point[lookout], index, sides);
}

/* An edge's own polygon lies on its own side, even where it is too thin to cover a place there. */
static void behold_own(dp_finder *w, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) {
        dp_beheld *const b = &w->emergence.beheld[i];
        const dp_lookout *const at = &w->emergence.placed[i];
        const dp_tile_polygon *const p = &w->tile.polygons[b->own.polygon];
        if (p->flags & DP_POLYGON_EDGE_ON) continue;
        const int side = own_side(w, b->own.polygon);
        const float slope = p->dx * at->ox + p->dy * at->oy;
        b->nearest[side] = b->own, b->furthest[side] = b->own.polygon;
        b->nearest_d[side] = b->furthest_d[side] = OFF * (side ? slope : -slope);
    }
}

/* ------- what it means ------- */

/* What a sample point turned out to be. */
typedef struct finding {
    int line;               /* dp_line, or -1: no line */
    uint32_t sides[2];      /* tile polygons that are seen to the left and right, or UINT32_MAX */
    uint32_t behind;        /* of an outline: the one furthest behind it, or UINT32_MAX */
    dp_unpaired_edge owner; /* whose edge it is */
    dp_vec3 normal;
} finding;

static const finding NOTHING = {
    .line = -1, .sides = {UINT32_MAX, UINT32_MAX}, .behind = UINT32_MAX};

static dp_beside beside(const dp_finder *w, const dp_sight *sight, uint32_t polygon) {
    const dp_tile_polygon *const p = &w->tile.polygons[polygon];
    return dp_beside_edge(w->tile.frame, sight, p->id, p->flags & DP_POLYGON_FRONT);
}

static void judge_outline(const dp_finder *w, const dp_sight *sight, int side, finding *f) {
    const dp_beside near = beside(w, sight, f->sides[side]);
    const dp_beside far =
        f->behind == f->sides[side] || f->behind == UINT32_MAX ? near : beside(w, sight, f->behind);
    const bool is_border =
        f->behind == UINT32_MAX || dp_is_one_side(&w->tile, f->sides[side], f->behind, &near, &far);
    f->line = is_border ? DP_LINE_BORDER : DP_LINE_SILHOUETTE;
    f->normal = is_border ? near.normal : dp_outline_normal(sight, &near, &far, side);
}

/* Does the surface go on from the edge, in a polygon that is seen edge-on? */
static bool goes_on_edge_on(const dp_finder *w, const emerging *e) {
    const dp_tile_polygon *const p = w->tile.polygons;
    return e->unpaired.partner &&
           (p[e->unpaired.polygon].flags | p[e->unpaired.partner - 1].flags) & DP_POLYGON_EDGE_ON;
}

static void judge_fold(const dp_finder *w, const emerging *e, finding *f) {
    const dp_beside left = beside(w, &e->sight, f->sides[0]),
                    right = beside(w, &e->sight, f->sides[1]);
    const dp_fold fold = dp_fold_of_sides(&e->sight, &left, &right);
    f->line = dp_fold_line(&fold, dp_polygon_style(w->tile.frame, e->id));
    if ((w->finds_hidden && dp_is_smooth(w->tile.frame, &fold)) ||
        dp_emerges_smooth(w, e->unpaired))
        f->line = -1;
    f->normal = fold.normal;
}

/* Which of the polygons that have an edge here makes the line: of those that are seen, else of all,
 * the one that comes first in the source. It must be looked at here, or nobody would. */
static dp_unpaired_edge find_owner(const dp_finder *w, const dp_beheld *b) {
    const dp_unpaired_edge *const sides = b->nearest;
    const dp_tile_polygon *const polygons = w->tile.polygons;
    const bool left = sides[0].edge != UINT32_MAX && dp_emerges(w, sides[0]),
               right = sides[1].edge != UINT32_MAX && dp_emerges(w, sides[1]);
    if (left && right) return sides[polygons[sides[1].polygon].id < polygons[sides[0].polygon].id];
    return left ? sides[0] : right ? sides[1] : b->first;
}

/* Is that the edge that is looked at, or another polygon's between the same ends? The table leaves
 * only one of these over; without it each is looked at. */
static bool is_own_edge(const dp_finder *w, const emerging *e, dp_unpaired_edge owner) {
    if (owner.polygon == e->unpaired.polygon) return owner.edge == e->unpaired.edge;
    if (w->tile.frame->styles[0].edge_table_off || owner.edge == UINT32_MAX) return false;
    const dp_polygons *const polygons = &w->tile.frame->polygons;
    const uint32_t id = w->tile.polygons[owner.polygon].id, n = dp_corner_count(polygons, id);
    dp_vec3 end[2];
    for (uint32_t i = 0; i < 2; i++)
        end[i] = dp_v3f(dp_vertex_position(
            polygons,
            dp_corner_vertex(polygons, dp_first_corner(polygons, id) + (owner.edge + i) % n)));
    const dp_vec3 a = e->a, b = e->b;
    const bool same = !dp_length(dp_sub(end[0], a)) && !dp_length(dp_sub(end[1], b)),
               turned = !dp_length(dp_sub(end[1], a)) && !dp_length(dp_sub(end[0], b));
    return same || turned;
}

static bool has_same_sides(const finding *a, const finding *b) {
    return a->sides[0] == b->sides[0] && a->sides[1] == b->sides[1] && a->behind == b->behind &&
           a->owner.polygon == b->owner.polygon && a->owner.edge == b->owner.edge;
}

/* Of what lies on one side, the nearest and the furthest: does a front face lie behind a back face? That
 * counts as nearer than a front face only where back faces are seen (fan.c). */
static bool is_wrong_way(const dp_finder *w, const emerging *e, uint32_t near, uint32_t far,
                         bool right) {
    return !(w->tile.polygons[near].flags & DP_POLYGON_FRONT) &&
           w->tile.polygons[far].flags & DP_POLYGON_FRONT &&
           !(w->tile.sees_backs && dp_shows_back_beside(w, &e->spine, right));
}

/* Do both face away, where no back face is seen? */
static bool are_hidden_backs(const dp_finder *w, uint32_t near, uint32_t far) {
    const uint32_t flags = w->tile.polygons[near].flags | w->tile.polygons[far].flags;
    return !w->tile.sees_backs && !w->finds_hidden && !(flags & DP_POLYGON_FRONT);
}

/* Nothing lies on the other side: an outline, with the nearest polygon and the one furthest behind it,
 * if any does not lie beyond a crack. */
static void see_outline(const dp_finder *w, const emerging *e, const dp_beheld *b, bool right,
                        finding *f) {
    const uint32_t near = f->sides[right], own = e->unpaired.polygon;
    f->behind = b->furthest[right];
    /* a partner seen edge-on, or nearly, covers nothing, but it is there */
    const bool is_thin = f->behind == near && e->unpaired.partner;
    if (is_thin) f->behind = near == own ? e->unpaired.partner - 1 : own;
    const uint32_t far = f->behind == UINT32_MAX ? near : f->behind;
    if ((is_thin || dp_may_be_folded(&w->tile.polygons[near])) &&
        is_wrong_way(w, e, near, far, right))
        f->behind = near, f->sides[right] = far;
    if (are_hidden_backs(w, near, far)) *f = NOTHING;
}

/* Does nothing lie at the point but the two polygons of an edge that are trusted? The table has left
 * it only as it could not look beside it, or as something lies elsewhere along it. */
static bool is_plain_pair(const dp_beheld *b) {
    return b->own.trusted && !b->is_foreign && !b->is_hidden;
}

/* Of two polygons beside an edge, as they are wound: a back face lies behind the front face. */
static finding judge_pair(const dp_finder *w, const emerging *e) {
    const uint32_t own = e->unpaired.polygon, other = e->unpaired.partner - 1;
    const bool front = w->tile.polygons[own].flags & DP_POLYGON_FRONT,
               other_front = w->tile.polygons[other].flags & DP_POLYGON_FRONT;
    if (!front && !other_front) return NOTHING;
    return (finding){.line = -1,
                     .behind = front == other_front ? UINT32_MAX : (front ? other : own),
                     .owner = e->unpaired,
                     .sides = {front ? own : UINT32_MAX, other_front ? other : UINT32_MAX}};
}

/* What sample point k is. Most are what the one `before` is: returns false, and leaves *f. */
static bool judge(const dp_finder *w, const emerging *e, uint32_t k, const finding *before,
                  finding *f) {
    const dp_beheld *const b = &w->emergence.beheld[e->first + (k - e->k0) / e->step];
    const uint32_t own = e->unpaired.polygon;
    finding here = {.line = -1, .behind = UINT32_MAX};
    for (int i = 0; i < 2; i++) here.sides[i] = b->nearest[i].polygon;
    const bool left = here.sides[0] != UINT32_MAX, right = here.sides[1] != UINT32_MAX;
    here.owner = find_owner(w, b);
    if (left != right) see_outline(w, e, b, right, &here);
    /* else a sheet seen edge-on: both its borders are one line */
    if (!left && !right) here.sides[0] = own, here.owner = e->unpaired;
    if (here.sides[0] == here.sides[1] || b->is_drawn || b->is_hidden ||
        !is_own_edge(w, e, here.owner))
        here = NOTHING;
    if (is_plain_pair(b)) here = judge_pair(w, e);
    /* as the table would have it, so that tiles agree */
    if (here.sides[0] == own || here.sides[1] == own || here.behind == own)
        here.owner = e->unpaired;
    if (has_same_sides(&here, before)) return false;
    *f = here;
    if (f->sides[0] != UINT32_MAX && f->sides[1] != UINT32_MAX)
        judge_fold(w, e, f);
    else if (f->sides[0] != f->sides[1])
        judge_outline(w, &e->sight, f->sides[0] == UINT32_MAX, f);
    if (f->line == DP_LINE_BORDER && goes_on_edge_on(w, e)) f->line = DP_LINE_SILHOUETTE;
    if (is_plain_pair(b))
        f->normal = dp_pair_normal(w->tile.frame, w->tile.polygons[own].id,
                                   w->tile.polygons[e->unpaired.partner - 1].id);
    return true;
}

/* Adds the candidate of a run of sample points, along the owner's edge. */
static void add_run(dp_finder *w, const emerging *e, const finding *f, uint32_t k0, uint32_t k1) {
    const dp_polygons *const polygons = &w->tile.frame->polygons;
    if (f->line < 0 || k0 >= k1) return;
    if (f->line == DP_LINE_BORDER && k1 - k0 == 1 && e->spine.n > SHORT) return; /* a dot */
    const uint32_t owner = f->owner.polygon, id = w->tile.polygons[owner].id;
    if (!(dp_polygon_style(w->tile.frame, id)->lines & (1u << f->line))) return;
    const uint32_t first = dp_first_corner(polygons, id), n = dp_corner_count(polygons, id);
    const dp_vec3 a = dp_v3f(dp_vertex_position(polygons,
                                                dp_corner_vertex(polygons, first + f->owner.edge))),
                  b = dp_v3f(dp_vertex_position(
                      polygons, dp_corner_vertex(polygons, first + (f->owner.edge + 1) % n)));
    const bool turned = dp_length(dp_sub(a, e->a)) > 0;
    dp_spine spine;
    if (!dp_spine_make(&w->tile.frame->view, a, b, f->normal, &spine)) return;
    const uint32_t other =
        f->sides[0] == owner || f->sides[0] == UINT32_MAX ? f->sides[1] : f->sides[0];
    const uint32_t across = other != UINT32_MAX && other != owner ? other
                            : f->behind != owner                  ? f->behind
                                                                  : UINT32_MAX;
    dp_add_candidate(
        w,
        (dp_candidate){.a = id,
                       .b = across == UINT32_MAX ? UINT32_MAX : w->tile.polygons[across].id,
                       .edge = f->owner.edge,
                       .k0 = turned ? spine.n - k1 : k0,
                       .k1 = turned ? spine.n - k0 : k1,
                       .line = f->line & 63,
                       .seen = dp_seen_beside(f->sides, owner) | dp_seen_beside(f->sides, across)
                                                                     << 1},
        &spine, NULL);
}

static bool is_same(const finding *a, const finding *b) {
    if (a == b) return true;
    if (a->line != b->line || a->line < 0) return a->line == b->line;
    return has_same_sides(a, b);
}

/* A single sample point that differs from two neighbours that agree, or from its neighbour at the
 * edge's end: something merely passes through the edge or touches its corner there. It follows
 * them. */
static const finding *settle(const emerging *e, uint32_t k, const finding *before,
                             const finding *here, const finding *after) {
    if (e->spine.n < 3) return here;
    if (k == 0) return after;
    if (k + 1 == e->spine.n) return before;
    return is_same(before, after) ? before : here;
}

/* The findings of consecutive sample points: those that are looked at together stay. */
enum { KEPT = 8 };
typedef struct findings {
    finding of[KEPT];
    uint32_t count;
} findings;

static const finding *next_finding(const dp_finder *w, const emerging *e, uint32_t k,
                                   const finding *before, findings *all) {
    finding *const f = &all->of[all->count % KEPT];
    if (!judge(w, e, k, before, f)) return before;
    all->count++;
    return f;
}

/* Adds a candidate for each run of sample points with the same line and neighbour. */
static void add_lines(dp_finder *w, const emerging *e) {
    findings all;
    all.count = 0;
    finding last = NOTHING;
    const finding *before, *here = next_finding(w, e, e->k0, &NOTHING, &all), *after = here;
    uint32_t start = e->k0;
    for (uint32_t k = e->k0; k < e->k1 && !w->tile.failed; k++) {
        before = k > e->k0 ? here : after;
        here = k > e->k0 ? after : here;
        after = k + 1 < e->k1 ? next_finding(w, e, k + 1, here, &all) : here;
        const finding *const f = settle(e, k, before, here, after);
        if (is_same(f, &last)) continue;
        add_run(w, e, &last, start, k);
        last = *f, start = k;
    }
    add_run(w, e, &last, start, e->k1);
    if (last.line == DP_LINE_BORDER) w->tile.stats.open_edges++;
}

/* The edges that have sample points here, and these. */
static bool place_all(dp_finder *w, uint32_t *edges, uint32_t *points) {
    dp_emergence *const own = &w->emergence;
    *edges = *points = 0;
    if (!DP_TILE_RESERVE(&w->tile, own, edges, edges_cap, own->unpaired_count)) return false;
    for (uint32_t i = 0; i < own->unpaired_count; i++) {
        emerging *const e = &own->edges[*edges];
        if (!begin_edge(w, own->unpaired[i], e)) continue;
        e->first = *points;
        e->step = e->spine.n <= SHORT ? 2 : 1;
        if (!place_points(w, e, points)) return false;
        dp_mark_emerging(w, e->unpaired);
        ++*edges;
    }
    return true;
}

void dp_find_emergent(dp_finder *w) {
    uint32_t edges, points;
    if (!w->emergence.unpaired_count || !dp_mark_drawn(w) || !place_all(w, &edges, &points) ||
        !points)
        return;
    if (!sort_points(w, points)) return;
    behold_own(w, points);
    dp_find_kernels_for(w->tile.frame->lanes)->look(w);
    w->tile.stats.edges_emergent += edges;
    for (uint32_t i = 0; i < edges && !w->tile.failed; i++) add_lines(w, &w->emergence.edges[i]);
}

/* ------- memory ------- */

static const dp_array arrays[] = {DP_ARRAY(dp_emergence, unpaired, unpaired_cap),
                                  DP_ARRAY(dp_emergence, edges, edges_cap),
                                  DP_ARRAY(dp_emergence, placed, placed_cap),
                                  DP_ARRAY(dp_emergence, beheld, beheld_cap),
                                  DP_ARRAY(dp_emergence, drawn, drawn_cap),
                                  DP_ARRAY(dp_emergence, drawn_of, drawn_of_cap),
                                  DP_ARRAY(dp_emergence, emerging_of, emerging_of_cap),
                                  DP_ARRAY(dp_emergence, served, served_cap),
                                  DP_ARRAY(dp_emergence, lookouts.x, lookouts.x_cap),
                                  DP_ARRAY(dp_emergence, lookouts.y, lookouts.y_cap),
                                  DP_ARRAY(dp_emergence, lookouts.d, lookouts.d_cap),
                                  DP_ARRAY(dp_emergence, lookouts.ox, lookouts.ox_cap),
                                  DP_ARRAY(dp_emergence, lookouts.oy, lookouts.oy_cap),
                                  DP_ARRAY(dp_emergence, lookouts.step, lookouts.step_cap),
                                  DP_ARRAY(dp_emergence, lookouts.own, lookouts.own_cap),
                                  DP_ARRAY(dp_emergence, lookouts.point, lookouts.point_cap)};

void dp_emergence_free(dp_emergence *store, const dp_allocator *memory) {
    dp_arrays_free(memory, store, DP_ARRAYS(arrays));
}

uint64_t dp_emergence_bytes(const dp_emergence *store) {
    return dp_arrays_bytes(store, DP_ARRAYS(arrays));
}
