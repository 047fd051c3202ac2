/* Lines along edges: what the edge table of a tile holds becomes candidates or is left to emerge.
 *
 *    for each marked edge of the table, DP_FOLDS at a time
 *        one polygon                          leave it to emerge (emerge.c)
 *        keys agree, positions do not         leave the edge of each polygon to emerge
 *        more than two, or winding disagrees  resolve_fan: what the eye sees decides
 *        front and back                       silhouette
 *        front and front                      ridge or valley, by the dihedral angle (core/fold.c)
 *
 * Dihedral angles are those of (Raskar 2001, 2.2). Nearly all edges are flat and never come here
 * (edge_table.c). Invariant: the polygon that comes first in the source owns the edge, in every
 * tile, so tiles agree on its spine. */
#include "find/kernels.h"
#include "raster/kernels.h"
#include "core/fold.h"
#include "find/edge_table.h"
#include "find/fold_batch.h"

#include <string.h>

static void leave(dp_finder *w, uint32_t polygon, uint32_t edge) {
    if (!DP_TILE_RESERVE(&w->tile, w, emergence.unpaired, emergence.unpaired_cap,
                         w->emergence.unpaired_count + 1u))
        return;
    w->emergence.unpaired[w->emergence.unpaired_count++] = (dp_unpaired_edge){polygon, edge};
}

/* The edge as owned by the polygon that comes first in the source. */
static dp_edge_entry owned_by_first(const dp_finder *w, const dp_edge_entry *e) {
    if (w->tile.polygons[e->a].id < w->tile.polygons[e->b].id) return *e;
    const bool opposed = e->opposed;
    return (dp_edge_entry){opposed ? e->vb : e->va,
                           opposed ? e->va : e->vb,
                           e->b,
                           e->a,
                           e->edge_b,
                           e->edge_a,
                           e->more,
                           opposed};
}

static bool draws(const dp_finder *w, const dp_edge_entry *e, dp_line line) {
    return dp_polygon_style(w->tile.frame, w->tile.polygons[e->a].id)->lines & (1u << line);
}

/* Adds a line of class `line` along an edge of polygon a. */
static void add_spine(dp_finder *w, const dp_edge_entry *e, dp_line line, const dp_spine *spine,
                      const dp_vec3 normals[2]) {
    dp_add_candidate(
        w,
        (dp_candidate){.a = w->tile.polygons[e->a].id,
                       .b = e->b == UINT32_MAX ? UINT32_MAX : w->tile.polygons[e->b].id,
                       .edge = e->edge_a,
                       .k1 = UINT32_MAX,
                       .line = (uint8_t)line},
        spine, normals);
}

/* Makes the spine, lifted along `normal`, and adds the line. */
static void add_line(dp_finder *w, const dp_edge_entry *e, dp_line line, dp_vec3 normal) {
    const dp_polygons *const polygons = &w->tile.frame->polygons;
    dp_spine spine;
    if (draws(w, e, line) &&
        dp_spine_make(&w->tile.frame->view, dp_v3f(dp_vertex_position(polygons, e->va)),
                      dp_v3f(dp_vertex_position(polygons, e->vb)), normal, &spine))
        add_spine(w, e, line, &spine, NULL);
}

static void add_fold(dp_finder *w, const dp_edge_entry *e, const dp_fold *fold) {
    const dp_style *const style = dp_polygon_style(w->tile.frame, w->tile.polygons[e->a].id);
    const int line = dp_fold_line(fold, style);
    if (line >= 0) add_line(w, e, (dp_line)line, fold->normal);
}

/* Makes normals, the list and the table. */
static bool prepare(dp_finder *w) {
    const bool triangles = !w->tile.frame->polygons.firsts;
    if ((!triangles && !dp_tile_exact_normals(&w->tile)) || !dp_edge_table_list(w)) return false;
    if (triangles) dp_raster_kernels_for(w->tile.frame->lanes)->normals(&w->tile);
    return dp_edge_table_fill(w);
}

static void resolve_pair(dp_finder *w, const dp_edge_entry *met) {
    const uint32_t front_a = w->tile.polygons[met->a].flags & DP_POLYGON_FRONT;
    const uint32_t front_b = w->tile.polygons[met->b].flags & DP_POLYGON_FRONT;
    if (!front_a && !front_b) return;
    const dp_edge_entry owned = owned_by_first(w, met), *const e = &owned;
    const dp_fold fold = dp_fold_seen(w->tile.frame, w->tile.polygons[e->a].id, true,
                                      w->tile.polygons[e->b].id, true, e->edge_b);
    if (front_a && front_b)
        add_fold(w, e, &fold);
    else
        add_line(w, e, DP_LINE_SILHOUETTE, fold.normal);
}

/* Keys are hashes of positions (edge_table.c): do all that met here really share this edge? */
static bool is_shared(const dp_finder *w, const dp_edge_entry *e) {
    bool shared = dp_edge_runs_between(w, (dp_half_edge){e->b, e->edge_b}, e->va, e->vb);
    for (uint32_t i = e->more; i && shared; i = w->table.meetings[i - 1].next)
        shared = dp_edge_runs_between(w, dp_half_edge_of(w, w->table.meetings[i - 1].number), e->va,
                                      e->vb);
    return shared;
}

/* ------- pairs of triangles, many at once ------- */

/* Puts edge i into the batch if it lies between two triangles; returns whether it does. The polygon
 * that comes first in the source then owns it. */
static bool put_pair(const dp_finder *w, dp_edge_entry *e, dp_fold_batch *f, uint32_t i) {
    const dp_polygons *const polygons = &w->tile.frame->polygons;
    if (polygons->firsts || e->b == UINT32_MAX || e->more || !e->opposed || !is_shared(w, e))
        return false;
    if (!((w->tile.polygons[e->a].flags | w->tile.polygons[e->b].flags) & DP_POLYGON_FRONT))
        return false;
    *e = owned_by_first(w, e);
    dp_fold_put(polygons, w->tile.polygons[e->a].id, w->tile.polygons[e->b].id, e->va, e->vb, f, i);
    return true;
}

/* The class of line that edge i makes, or -1. */
static int pair_line(const dp_finder *w, const dp_edge_entry *e, const dp_fold_batch *f,
                     uint32_t i) {
    if (!(w->tile.polygons[e->a].flags & w->tile.polygons[e->b].flags & DP_POLYGON_FRONT))
        return DP_LINE_SILHOUETTE;
    const dp_fold fold = dp_fold_between(
        w->tile.frame, dp_fold_vector(f->normal_a, i), dp_fold_vector(f->normal_b, i),
        dp_fold_vector(f->normal, i), w->tile.polygons[e->b].id, e->edge_b);
    return dp_fold_line(&fold, dp_polygon_style(w->tile.frame, w->tile.polygons[e->a].id));
}

static void resolve_put(dp_finder *w, const dp_edge_entry *e, const dp_fold_batch *f, uint32_t i) {
    if (f->plain[i] == 0) {
        resolve_pair(w, e);
        return;
    }
    const int line = pair_line(w, e, f, i);
    const dp_vec3 normals[2] = {dp_fold_vector(f->normal_a, i), dp_fold_vector(f->normal_b, i)};
    dp_spine spine = dp_fold_spine(f, i);
    if (line >= 0 && draws(w, e, (dp_line)line) && dp_spine_divide(&spine))
        add_spine(w, e, (dp_line)line, &spine, normals);
}

/* ------- fans ------- */

/* A polygon at an edge, as seen on the screen: the side of the edge it lies on, and its depth away
 * from the edge. */
typedef struct incident_face {
    uint32_t polygon, edge;
    bool front;
    double side; /* px; the sign tells left or right of va -> vb */
    double rise; /* change of depth per px away from the edge */
} incident_face;

static incident_face make_incident_face(const dp_finder *w, const dp_spine *s, uint32_t polygon,
                                        uint32_t edge) {
    const dp_tile_polygon *const p = &w->tile.polygons[polygon];
    incident_face f = {.polygon = polygon, .edge = edge, .front = p->flags & DP_POLYGON_FRONT};
    const double ex = s->b.x - s->a.x, ey = s->b.y - s->a.y, length = dp_hypot(ex, ey);
    if (!(length > 0)) return f;
    const dp_vertex *const points = w->tile.points + p->point;
    for (uint32_t i = 0; i < p->points; i++) {
        const double x = points[i].x + (double)w->tile.tile_x - s->a.x,
                     y = points[i].y + (double)w->tile.tile_y - s->a.y;
        const double across = (ex * y - ey * x) / length;
        if (fabs(across) > fabs(f.side)) f.side = across;
    }
    const double sign = f.side < 0 ? -1 : 1;
    f.rise = sign * (ex * p->dy - ey * p->dx) / length;
    return f;
}

/* Keeps the face that is nearest to the eye on its side; of coplanar ones, the first in the
 * source. */
static void offer_incident_face(const dp_finder *w, incident_face best[2], uint32_t count[2],
                                incident_face f) {
    const int side = f.side < 0;
    const incident_face had = best[side];
    const bool is_earlier = count[side] && f.rise == had.rise &&
                            w->tile.polygons[f.polygon].id < w->tile.polygons[had.polygon].id;
    if (!count[side]++ || f.rise > had.rise || is_earlier) best[side] = f;
}

/* The edge of these two faces, owned by the first in the source; `q` may be NULL. */
static dp_edge_entry owned_by_faces(const dp_finder *w, const incident_face *p,
                                    const incident_face *q) {
    const bool swap = q && w->tile.polygons[q->polygon].id < w->tile.polygons[p->polygon].id;
    const incident_face *const a = swap ? q : p, *const b = swap ? p : q;
    dp_edge_entry e = {.a = a->polygon,
                       .edge_a = a->edge,
                       .b = b ? b->polygon : UINT32_MAX,
                       .edge_b = b ? b->edge : 0};
    dp_edge_ends(w, (dp_half_edge){e.a, e.edge_a}, &e.va, &e.vb);
    return e;
}

/* An edge where more than two polygons meet or the winding disagrees. The nearest polygon on each
 * side of the edge hides the others there. The two nearest make the line that two polygons would
 * make; if all polygons lie on one side, the edge is an outline. */
static void resolve_fan(dp_finder *w, const dp_edge_entry *e) {
    dp_spine s;
    const dp_polygons *const polygons = &w->tile.frame->polygons;
    if (!dp_spine_make(&w->tile.frame->view, dp_v3f(dp_vertex_position(polygons, e->va)),
                       dp_v3f(dp_vertex_position(polygons, e->vb)), dp_v3(0, 0, 0), &s))
        return;
    incident_face best[2] = {{0}};
    uint32_t count[2] = {0, 0};
    offer_incident_face(w, best, count, make_incident_face(w, &s, e->a, e->edge_a));
    offer_incident_face(w, best, count, make_incident_face(w, &s, e->b, e->edge_b));
    for (uint32_t i = e->more; i; i = w->table.meetings[i - 1].next) {
        const dp_half_edge at = dp_half_edge_of(w, w->table.meetings[i - 1].number);
        offer_incident_face(w, best, count, make_incident_face(w, &s, at.polygon, at.edge));
    }
    if (!count[0] || !count[1]) {
        const incident_face f = best[count[0] ? 0 : 1];
        const dp_edge_entry owned = owned_by_faces(w, &f, NULL);
        dp_vec3 normal = dp_polygon_normal(w->tile.frame, w->tile.polygons[f.polygon].id);
        if (!f.front) normal = dp_scale(normal, -1);
        add_line(w, &owned, DP_LINE_SILHOUETTE, normal);
        return;
    }
    if (!best[0].front && !best[1].front) return;
    const dp_edge_entry owned = owned_by_faces(w, &best[0], &best[1]);
    const dp_fold fold =
        dp_fold_seen(w->tile.frame, w->tile.polygons[best[0].polygon].id, best[0].front,
                     w->tile.polygons[best[1].polygon].id, best[1].front, best[1].edge);
    add_fold(w, &owned, &fold);
}

/* Leaves every edge of every polygon to emerge (dp_style.edge_table_off). */
static void leave_all(dp_finder *w) {
    const dp_polygons *const polygons = &w->tile.frame->polygons;
    for (uint32_t i = 0; i < w->tile.polygon_count && !w->tile.failed; i++) {
        const dp_tile_polygon *const p = &w->tile.polygons[i];
        const uint32_t first = dp_first_corner(polygons, p->id),
                       n = dp_corner_count(polygons, p->id);
        for (uint32_t e = 0; e < n; e++)
            if (dp_edge_is_flagged(polygons, first + e) && dp_tile_edge_is_near(&w->tile, p, e))
                leave(w, i, e);
    }
}

static void leave_all_of(dp_finder *w, const dp_edge_entry *e) {
    leave(w, e->a, e->edge_a);
    leave(w, e->b, e->edge_b);
    for (uint32_t i = e->more; i; i = w->table.meetings[i - 1].next) {
        const dp_half_edge at = dp_half_edge_of(w, w->table.meetings[i - 1].number);
        leave(w, at.polygon, at.edge);
    }
}

static void resolve(dp_finder *w, const dp_edge_entry *e) {
    if (e->b == UINT32_MAX) {
        leave(w, e->a, e->edge_a);
    } else if (!is_shared(w, e)) {
        leave_all_of(w, e);
    } else if (e->more || !e->opposed) {
        resolve_fan(w, e);
    } else {
        resolve_pair(w, e);
    }
}

/* Takes up to DP_FOLDS edges from the table, from `*number` on, and prefetches their polygons. */
static uint32_t take_entries(const dp_finder *w, uint32_t *number,
                             dp_edge_entry entries[DP_FOLDS]) {
    const dp_polygons *const polygons = &w->tile.frame->polygons;
    uint32_t count = 0;
    while (count < DP_FOLDS && (*number = dp_edge_table_next(w, *number)) != UINT32_MAX) {
        const dp_edge_entry e = dp_edge_table_entry(w, (*number)++);
        dp_prefetch_corners(polygons, w->tile.polygons[e.a].id);
        if (e.b != UINT32_MAX) dp_prefetch_corners(polygons, w->tile.polygons[e.b].id);
        entries[count++] = e;
    }
    for (uint32_t i = 0; i < count; i++) {
        dp_edge_entry *const e = &entries[i];
        dp_edge_ends(w, (dp_half_edge){e->a, e->edge_a}, &e->va, &e->vb);
        dp_prefetch_positions(polygons, w->tile.polygons[e->a].id);
        if (e->b != UINT32_MAX) dp_prefetch_positions(polygons, w->tile.polygons[e->b].id);
    }
    return count;
}

static void resolve_entries(dp_finder *w, dp_edge_entry entries[DP_FOLDS], uint32_t count,
                            dp_fold_batch *folds) {
    bool put[DP_FOLDS];
    for (uint32_t i = 0; i < count; i++) put[i] = put_pair(w, &entries[i], folds, i);
    dp_find_kernels_for(w->tile.frame->lanes)->folds(&w->tile.frame->view, folds, count);
    for (uint32_t i = 0; i < count && !w->tile.failed; i++) {
        if (put[i])
            resolve_put(w, &entries[i], folds, i);
        else
            resolve(w, &entries[i]);
    }
}

void dp_find_edges(dp_finder *w) {
    if (!(w->tile.frame->lines & ~DP_INTERSECTION)) return;
    if (w->tile.frame->styles[0].edge_table_off) {
        leave_all(w);
        return;
    }
    if (!prepare(w)) return;
    dp_edge_entry entries[DP_FOLDS];
    dp_fold_batch folds = {0};
    uint32_t number = 0;
    for (uint32_t count; !w->tile.failed && (count = take_entries(w, &number, entries)) > 0;)
        resolve_entries(w, entries, count, &folds);
}
