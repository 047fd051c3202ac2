/* Edges as the eye sees them, where winding cannot tell: more than two polygons meet, they are wound
 * differently, or their back faces are seen.
 *
 *    for each polygon at the edge
 *        to the left or to the right of the edge on the screen, by facing and direction
 *        its normal turned to the eye; how steeply it recedes from the edge     core/fold.c
 *    on either side the polygon that recedes least hides the others
 *    one on each side   the line that two polygons would make: ridge, valley or none
 *    all on one side    an outline: border if they lie in one plane and face one way and none is seen
 *                       edge-on, else silhouette
 *
 * Invariant: neither winding nor doubled faces matter. Not handled: polygons that touch the edge
 * but do not have it (emerge.c). */
#include "find/fan.h"

#include "core/fold.h"

bool dp_edge_is_diagonal(const dp_finder *w, const dp_edge_entry *e) {
    const dp_polygons *const polygons = &w->tile.frame->polygons;
    const uint32_t *const source =
        polygons->source_polygon; /* what it splits is one polygon there */
    if (source && e->b != UINT32_MAX &&
        source[w->tile.polygons[e->a].id] == source[w->tile.polygons[e->b].id])
        return true;
    if (!polygons->has_diagonals) return false;
    const uint32_t a = dp_first_corner(polygons, w->tile.polygons[e->a].id) + e->edge_a;
    if (dp_edge_is_flagged(polygons, a)) return false;
    return e->b == UINT32_MAX ||
           !dp_edge_is_flagged(polygons,
                               dp_first_corner(polygons, w->tile.polygons[e->b].id) + e->edge_b);
}

bool dp_edge_is_no_fold(const dp_finder *w, const dp_edge_entry *e) {
    const dp_polygons *const polygons = &w->tile.frame->polygons;
    return dp_edge_is_diagonal(w, e) ||
           dp_edge_is_smooth(polygons,
                             dp_first_corner(polygons, w->tile.polygons[e->a].id) + e->edge_a);
}

bool dp_emerges_smooth(const dp_finder *w, dp_unpaired_edge e) {
    const dp_polygons *const polygons = &w->tile.frame->polygons;
    return e.partner &&
           dp_edge_is_smooth(polygons,
                             dp_first_corner(polygons, w->tile.polygons[e.polygon].id) + e.edge);
}

void dp_add_line(dp_finder *w, const dp_edge_entry *e, dp_line line, const dp_spine *spine,
                 const dp_vec3 normals[2], const uint32_t sides[2]) {
    const uint32_t id = w->tile.polygons[e->a].id;
    dp_unpaired_edge edge = {e->a, e->edge_a, e->b == UINT32_MAX ? 0 : e->b + 1, false};
    bool disputed = !w->finds_hidden && dp_is_disputed(w, edge, spine, sides);
    /* what is trusted is disputed less; most edges are not, and need not be asked for */
    edge.trusted = disputed && dp_trusts_pair(w, e);
    if (edge.trusted) disputed = dp_is_disputed(w, edge, spine, sides);
    if (disputed) {
        dp_leave_to_emerge(w, edge);
    } else if (dp_polygon_style(w->tile.frame, id)->lines & (1u << line) &&
               dp_note_drawn(w, e->a, e->edge_a) &&
               (e->b == UINT32_MAX || dp_note_drawn(w, e->b, e->edge_b))) {
        dp_add_candidate(
            w,
            (dp_candidate){.a = id,
                           .b = e->b == UINT32_MAX ? UINT32_MAX : w->tile.polygons[e->b].id,
                           .edge = e->edge_a,
                           .k1 = UINT32_MAX,
                           .line = line & 63,
                           .seen = dp_seen_beside(sides, e->a) | dp_seen_beside(sides, e->b) << 1},
            spine, normals);
    }
}

/* What lies on one side of the edge: the nearest polygon, and the one furthest behind it. */
typedef struct side {
    dp_half_edge nearest, furthest; /* of tile polygons; polygon UINT32_MAX: none */
    dp_beside near, far;
} side;

typedef struct fan {
    uint32_t owner, edge; /* the polygon that comes first in the source, and its edge */
    uint32_t va, vb;      /* the edge, in its direction */
    dp_sight sight;
    side sides[2]; /* left, right */
    bool edge_on;  /* a polygon there is seen edge-on, and lies on neither side */
} fan;

static void find_owner(const dp_finder *w, fan *f, dp_half_edge at) {
    if (f->owner == UINT32_MAX || w->tile.polygons[at.polygon].id < w->tile.polygons[f->owner].id)
        f->owner = at.polygon, f->edge = at.edge;
}

/* Does the polygon run the edge from va to vb? */
static bool runs_forward(const dp_finder *w, const fan *f, dp_half_edge at) {
    const dp_polygons *const polygons = &w->tile.frame->polygons;
    uint32_t from, to;
    dp_edge_ends(w, at, &from, &to);
    const float *const p = dp_vertex_position(polygons, from), *const q = dp_vertex_position(
                                                                   polygons, f->va);
    return from == f->va || (p[0] == q[0] && p[1] == q[1] && p[2] == q[2]);
}

static bool face_alike(const dp_finder *w, uint32_t a, uint32_t b) {
    return !((w->tile.polygons[a].flags ^ w->tile.polygons[b].flags) & DP_POLYGON_FRONT);
}

/* Of polygons in one plane the first in the source counts as the nearest. */
static void offer(const dp_finder *w, fan *f, dp_half_edge at) {
    const dp_tile_polygon *const p = &w->tile.polygons[at.polygon];
    if (p->flags & DP_POLYGON_EDGE_ON) {
        f->edge_on = true;
        return;
    }
    const bool front = p->flags & DP_POLYGON_FRONT, right = front != runs_forward(w, f, at);
    side *const s = &f->sides[right];
    const dp_beside beside = dp_beside_edge(w->tile.frame, &f->sight, p->id, front);
    const double sign = right ? 1 : -1, recedes = sign * beside.recedes;
    const bool same = s->nearest.polygon != UINT32_MAX && dp_is_one_plane(&beside, &s->near);
    if (s->nearest.polygon == UINT32_MAX ||
        (same ? p->id < w->tile.polygons[s->nearest.polygon].id : recedes < sign * s->near.recedes))
        s->nearest = at, s->near = beside;
    /* of two in one plane, that which faces another way than the nearest: the other side */
    const bool level = s->furthest.polygon != UINT32_MAX && dp_is_one_plane(&beside, &s->far);
    if (s->furthest.polygon == UINT32_MAX ||
        (level ? face_alike(w, s->nearest.polygon, s->furthest.polygon)
               : recedes > sign * s->far.recedes))
        s->furthest = at, s->far = beside;
}

static void for_each(dp_finder *w, const dp_edge_entry *e, fan *f,
                     void (*visit)(const dp_finder *, fan *, dp_half_edge)) {
    visit(w, f, (dp_half_edge){e->a, e->edge_a});
    visit(w, f, (dp_half_edge){e->b, e->edge_b});
    for (uint32_t i = e->more; i; i = w->table.meetings[i - 1].next)
        visit(w, f, dp_half_edge_of(w, w->table.meetings[i - 1].number));
}

static void find_sides(dp_finder *w, const dp_edge_entry *e, fan *f) {
    const side none = {.nearest = {UINT32_MAX, 0}, .furthest = {UINT32_MAX, 0}};
    f->sides[0] = f->sides[1] = none;
    for_each(w, e, f, offer);
}

/* Adds a line along the fan's edge; `across`: a second polygon that does not hide it. */
static void add(dp_finder *w, const fan *f, dp_line line, dp_half_edge across, dp_vec3 normal) {
    const dp_polygons *const polygons = &w->tile.frame->polygons;
    dp_spine spine;
    if (!dp_spine_make(&w->tile.frame->view, dp_v3f(dp_vertex_position(polygons, f->va)),
                       dp_v3f(dp_vertex_position(polygons, f->vb)), normal, &spine))
        return;
    const dp_edge_entry e = {.va = f->va,
                             .vb = f->vb,
                             .a = f->owner,
                             .b = across.polygon,
                             .edge_a = f->edge,
                             .edge_b = across.edge};
    const uint32_t sides[2] = {f->sides[0].nearest.polygon, f->sides[1].nearest.polygon};
    dp_add_line(w, &e, line, &spine, NULL, sides);
}

/* Is a back face seen beside the fan's edge, on this side? */
static bool shows_back(const dp_finder *w, const fan *f, bool right) {
    const dp_polygons *const polygons = &w->tile.frame->polygons;
    dp_spine spine;
    if (w->finds_hidden) return false; /* samples tell only what is seen */
    return dp_spine_ends(&w->tile.frame->view, dp_v3f(dp_vertex_position(polygons, f->va)),
                         dp_v3f(dp_vertex_position(polygons, f->vb)), &spine) &&
           dp_shows_back_beside(w, &spine, right);
}

/* Of a front face and a back face, wound alike, the front one is the nearest where the surface is
 * seen from its front; it may not seem so where a fine mesh is folded below what is seen. */
static void trust_winding(const dp_finder *w, const dp_edge_entry *e, fan *f, bool right) {
    side *const s = &f->sides[right];
    const uint32_t front = DP_POLYGON_FRONT;
    if (e->more || !e->opposed || !dp_may_be_folded(&w->tile.polygons[s->nearest.polygon]) ||
        !(w->tile.polygons[s->furthest.polygon].flags & front) || shows_back(w, f, right))
        return;
    const side had = *s;
    s->nearest = had.furthest, s->near = had.far;
    s->furthest = had.nearest, s->far = had.near;
}

static void add_outline(dp_finder *w, const dp_edge_entry *e, fan *f, bool right) {
    side *const s = &f->sides[right];
    const bool border =
        dp_is_one_side(&w->tile, s->nearest.polygon, s->furthest.polygon, &s->near, &s->far);
    if (!border) trust_winding(w, e, f, right);
    const bool own = s->nearest.polygon == f->owner;
    const dp_half_edge none = {UINT32_MAX, 0}, behind = border ? none : s->furthest;
    add(w, f, border && !f->edge_on ? DP_LINE_BORDER : DP_LINE_SILHOUETTE,
        own ? behind : s->nearest,
        border ? s->near.normal : dp_outline_normal(&f->sight, &s->near, &s->far, right));
}

static void add_fold(dp_finder *w, const fan *f) {
    const side *const left = &f->sides[0], *const right = &f->sides[1];
    const dp_fold fold = dp_fold_of_sides(&f->sight, &left->near, &right->near);
    const int line =
        dp_fold_line(&fold, dp_polygon_style(w->tile.frame, w->tile.polygons[f->owner].id));
    if (line >= 0 && !(w->finds_hidden && dp_is_smooth(w->tile.frame, &fold)))
        add(w, f, (dp_line)line, left->nearest.polygon == f->owner ? right->nearest : left->nearest,
            fold.normal);
}

/* All polygons of the edge are served by its line, whichever two it is made for. */
static bool note_all(dp_finder *w, const dp_edge_entry *e) {
    if (!dp_note_served(w, e->a, e->edge_a)) return false;
    if (e->b != UINT32_MAX && !dp_note_served(w, e->b, e->edge_b)) return false;
    for (uint32_t i = e->more; i; i = w->table.meetings[i - 1].next) {
        const dp_half_edge at = dp_half_edge_of(w, w->table.meetings[i - 1].number);
        if (!dp_note_served(w, at.polygon, at.edge)) return false;
    }
    return true;
}

void dp_resolve_fan(dp_finder *w, const dp_edge_entry *e) {
    const dp_polygons *const polygons = &w->tile.frame->polygons;
    fan f = {.owner = UINT32_MAX};
    for_each(w, e, &f, find_owner);
    dp_edge_ends(w, (dp_half_edge){f.owner, f.edge}, &f.va, &f.vb);
    if (!dp_sight_make(&w->tile.frame->view, dp_v3f(dp_vertex_position(polygons, f.va)),
                       dp_v3f(dp_vertex_position(polygons, f.vb)), &f.sight))
        return;
    find_sides(w, e, &f);
    if (!note_all(w, e)) return;
    const bool left = f.sides[0].nearest.polygon != UINT32_MAX,
               right = f.sides[1].nearest.polygon != UINT32_MAX;
    if (left && right) {
        if (!dp_edge_is_no_fold(w, e)) add_fold(w, &f);
    } else if (left || right) {
        add_outline(w, e, &f, right);
    }
}
