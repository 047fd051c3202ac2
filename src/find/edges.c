/* Lines along edges: what the edge table of a tile holds becomes candidates or is left to emerge.
 *
 *    for each marked edge of the table, DP_FOLDS at a time
 *        one polygon                          leave it to emerge (emerge.c)
 *        keys agree, positions do not         leave the edge of each polygon to emerge
 *        more than two, winding disagrees,
 *        or back faces are seen here          dp_resolve_fan: what the eye sees decides (fan.c)
 *        front and back                       silhouette
 *        front and front                      ridge or valley, by the dihedral angle (core/fold.c)
 *    a line beside which something else is seen is left to emerge (dispute.c)
 *
 * Where hidden lines are looked for (hidden.c), all polygons are in the table, nothing is disputed,
 * two back faces make the fold that they are wound for, and smooth folds are left out.
 *
 * Dihedral angles are those of (Raskar 2001, 2.2). Nearly all edges are flat and never come here
 * (edge_table.c). Invariant: the polygon that comes first in the source owns the edge, in every
 * tile, so tiles agree on its spine. */
#include "find/kernels.h"
#include "raster/kernels.h"
#include "core/fold.h"
#include "find/edge_table.h"
#include "find/fan.h"
#include "find/fold_batch.h"

#include <string.h>

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

/* Makes the spine, lifted along `normal`, and adds the line; `sides` as in dp_add_line. */
static void add_line(dp_finder *w, const dp_edge_entry *e, dp_line line, dp_vec3 normal,
                     const uint32_t sides[2]) {
    const dp_polygons *const polygons = &w->tile.frame->polygons;
    dp_spine spine;
    if (dp_spine_make(&w->tile.frame->view, dp_v3f(dp_vertex_position(polygons, e->va)),
                      dp_v3f(dp_vertex_position(polygons, e->vb)), normal, &spine))
        dp_add_line(w, e, line, &spine, NULL, sides);
}

/* The polygons to the left and to the right of the edge, in the direction of a, of two that run it
 * in opposite directions: UINT32_MAX where a back face is. */
static void sides_of_pair(const dp_finder *w, const dp_edge_entry *e, uint32_t sides[2]) {
    sides[0] = w->tile.polygons[e->a].flags & DP_POLYGON_FRONT ? e->a : UINT32_MAX;
    sides[1] = w->tile.polygons[e->b].flags & DP_POLYGON_FRONT ? e->b : UINT32_MAX;
}

/* Makes normals, the list and the table. */
static bool prepare(dp_finder *w) {
    const bool triangles = !w->tile.frame->polygons.firsts;
    if (w->finds_hidden) {
        if (!dp_tile_wound_normals(&w->tile)) return false;
    } else {
        if (!triangles && !dp_tile_exact_normals(&w->tile)) return false;
        if (w->tile.sees_backs) dp_tile_turn_normals(&w->tile);
    }
    if (!dp_edge_table_list(w)) return false;
    if (triangles) dp_raster_kernels_for(w->tile.frame->lanes)->normals(&w->tile);
    return dp_edge_table_fill(w);
}

/* Do the polygons of a pair face one way? Then they make a fold, else a silhouette. */
static bool is_fold(const dp_finder *w, const dp_edge_entry *e) {
    const uint32_t a = w->tile.polygons[e->a].flags, b = w->tile.polygons[e->b].flags;
    return w->finds_hidden ? !((a ^ b) & DP_POLYGON_FRONT) : a & b & DP_POLYGON_FRONT;
}

/* The class of line that the fold of a pair makes, or -1. */
static int fold_line(const dp_finder *w, const dp_edge_entry *e, const dp_fold *fold) {
    if (dp_edge_is_no_fold(w, e)) return -1;
    const dp_style *const style = dp_polygon_style(w->tile.frame, w->tile.polygons[e->a].id);
    if (w->finds_hidden && dp_is_smooth(w->tile.frame, fold)) return -1;
    return dp_fold_line(fold, style);
}

/* Two polygons that run the edge in opposite directions. */
static void resolve_pair(dp_finder *w, const dp_edge_entry *met) {
    const dp_edge_entry owned = owned_by_first(w, met), *const e = &owned;
    const dp_frame *const frame = w->tile.frame;
    const dp_fold fold = dp_fold_seen(frame, w->tile.polygons[e->a].id, true,
                                      w->tile.polygons[e->b].id, true, e->edge_b);
    uint32_t sides[2];
    sides_of_pair(w, e, sides);
    const int line = is_fold(w, e) ? fold_line(w, e, &fold) : DP_LINE_SILHOUETTE;
    if (line < 0) return;
    const dp_vec3 normal =
        dp_fold_is_flat(&fold) && dp_trusts_pair(w, e)
            ? dp_pair_normal(frame, w->tile.polygons[e->a].id, w->tile.polygons[e->b].id)
            : fold.normal;
    add_line(w, e, (dp_line)line, normal, sides);
}

/* Do all that have met at the edge face away, or is one of two the only one that does not, and are
 * these wound alike? Else resolve_fan must decide. */
static bool is_plain_pair(const dp_finder *w, const dp_edge_entry *e) {
    const uint32_t a = w->tile.polygons[e->a].flags, b = w->tile.polygons[e->b].flags;
    if (e->more || !e->opposed) return false;
    if (w->finds_hidden) return true;
    return w->tile.sees_backs ? a & b & DP_POLYGON_FRONT : (a | b) & DP_POLYGON_FRONT;
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
    if (polygons->firsts || e->b == UINT32_MAX || !is_plain_pair(w, e) || !is_shared(w, e))
        return false;
    *e = owned_by_first(w, e);
    dp_fold_put(polygons, w->tile.polygons[e->a].id, w->tile.polygons[e->b].id, e->va, e->vb, f, i);
    return true;
}

/* The class of line that edge i makes, or -1. */
static int pair_line(const dp_finder *w, const dp_edge_entry *e, const dp_fold_batch *f,
                     uint32_t i) {
    if (!is_fold(w, e)) return DP_LINE_SILHOUETTE;
    const dp_fold fold = dp_fold_between(
        w->tile.frame, dp_fold_vector(f->normal_a, i), dp_fold_vector(f->normal_b, i),
        dp_fold_vector(f->normal, i), w->tile.polygons[e->b].id, e->edge_b);
    return fold_line(w, e, &fold);
}

static void resolve_put(dp_finder *w, const dp_edge_entry *e, const dp_fold_batch *f, uint32_t i) {
    if (f->plain[i] == 0) {
        resolve_pair(w, e);
        return;
    }
    const int line = pair_line(w, e, f, i);
    const dp_vec3 normals[2] = {dp_fold_vector(f->normal_a, i), dp_fold_vector(f->normal_b, i)};
    dp_spine spine = dp_fold_spine(f, i);
    uint32_t sides[2];
    sides_of_pair(w, e, sides);
    if (line >= 0 && dp_spine_divide(&spine))
        dp_add_line(w, e, (dp_line)line, &spine, normals, sides);
}

/* ------- what is left ------- */

/* Leaves every edge of every polygon to emerge (dp_style.edge_table_off). */
static void leave_all(dp_finder *w) {
    const dp_polygons *const polygons = &w->tile.frame->polygons;
    for (uint32_t i = 0; i < w->tile.polygon_count && !w->tile.failed; i++) {
        const dp_tile_polygon *const p = &w->tile.polygons[i];
        const uint32_t first = dp_first_corner(polygons, p->id),
                       n = dp_corner_count(polygons, p->id);
        for (uint32_t e = 0; e < n; e++)
            if (dp_edge_is_flagged(polygons, first + e) && dp_tile_edge_is_near(&w->tile, p, e))
                dp_leave_to_emerge(w, (dp_unpaired_edge){i, e, 0, false});
    }
}

static void leave_all_of(dp_finder *w, const dp_edge_entry *e) {
    dp_leave_to_emerge(w, (dp_unpaired_edge){e->a, e->edge_a, 0, false});
    dp_leave_to_emerge(w, (dp_unpaired_edge){e->b, e->edge_b, 0, false});
    for (uint32_t i = e->more; i; i = w->table.meetings[i - 1].next) {
        const dp_half_edge at = dp_half_edge_of(w, w->table.meetings[i - 1].number);
        dp_leave_to_emerge(w, (dp_unpaired_edge){at.polygon, at.edge, 0, false});
    }
}

/* Is a pair of a front face and a back face what it seems, though back faces are seen in the tile? */
static bool is_trusted_outline(const dp_finder *w, const dp_edge_entry *e) {
    const uint32_t a = w->tile.polygons[e->a].flags, b = w->tile.polygons[e->b].flags;
    return (a ^ b) & DP_POLYGON_FRONT && dp_trusts_pair(w, e);
}

static void resolve(dp_finder *w, const dp_edge_entry *e) {
    if (e->b == UINT32_MAX) {
        if (!dp_edge_is_diagonal(w, e))
            dp_leave_to_emerge(w, (dp_unpaired_edge){e->a, e->edge_a, 0, false});
    } else if (!is_shared(w, e)) {
        leave_all_of(w, e);
    } else if (is_plain_pair(w, e) || is_trusted_outline(w, e)) {
        resolve_pair(w, e);
    } else {
        dp_resolve_fan(w, e);
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
    if (w->tile.frame->styles[0].edge_table_off && !w->finds_hidden) {
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
