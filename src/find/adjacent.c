/* A tile's candidates from the mesh's adjacency, instead of from the tile's edge table (edges.c).
 *
 *    for each polygon of the tile that is not hidden
 *        for each of its edges near the tile
 *            outline?  front face beside a back face or nothing (frame->outlined)
 *            crease?   the first of two polygons in the source adds it
 *
 * Outlines are detected as in (Hermosilla and Vázquez 2010, Listing 2.1), from the front-facing
 * side. The polygon that comes first in the source owns the edge, whatever its class, as in the
 * table; so both ways make the same segments.
 *
 * Not handled: neighbours that share no corner with an edge. The edge is then a border; the table
 * would look for what lies across (emerge.c). */
#include "core/facing.h"

#include "mesh/adjacency.h"
#include "core/fold.h"
#include "find/finder.h"

typedef struct shared_edge {
    uint32_t a, b;           /* owner; partner or UINT32_MAX */
    uint32_t edge_a, edge_b; /* corner numbers within the polygons */
    bool flipped;
} shared_edge;

static shared_edge owned(const dp_frame *frame, uint32_t polygon, uint32_t corner) {
    const dp_adjacency *const adjacency = frame->adjacency;
    const uint32_t across = adjacency->across[corner];
    shared_edge e = {.a = polygon,
                     .b = UINT32_MAX,
                     .edge_a = corner - dp_first_corner(&frame->polygons, polygon)};
    if (!dp_is_across(across)) return e;
    e.b = dp_polygon_of_corner(adjacency, dp_across_corner(across));
    e.edge_b = dp_across_corner(across) - dp_first_corner(&frame->polygons, e.b);
    e.flipped = across & DP_ACROSS_FLIPPED;
    if (e.b < e.a) return (shared_edge){e.b, e.a, e.edge_b, e.edge_a, e.flipped};
    return e;
}

static void add_line(dp_finder *w, const shared_edge *e, dp_line line, dp_vec3 normal,
                     uint32_t seen) {
    const dp_polygons *const polygons = &w->tile.frame->polygons;
    if (!(dp_polygon_style(w->tile.frame, e->a)->lines & (1u << line))) return;
    if (1u << line & DP_OUTLINES && dp_draws_fins(w->tile.frame)) return; /* fins.c draws them */
    const uint32_t first = dp_first_corner(polygons, e->a), n = dp_corner_count(polygons, e->a);
    const uint32_t va = dp_corner_vertex(polygons, first + e->edge_a);
    const uint32_t vb = dp_corner_vertex(polygons, first + (e->edge_a + 1) % n);
    dp_spine spine;
    if (!dp_spine_make(&w->tile.frame->view, dp_v3f(dp_vertex_position(polygons, va)),
                       dp_v3f(dp_vertex_position(polygons, vb)), normal, &spine))
        return;
    dp_add_candidate(w,
                     (dp_candidate){.a = e->a,
                                    .b = e->b,
                                    .edge = e->edge_a,
                                    .k1 = UINT32_MAX,
                                    .line = line & 63,
                                    .seen = seen},
                     &spine, NULL);
}

/* The fold as the eye sees it: if the polygons are wound differently, one normal is reversed. */
static dp_fold fold_of(const dp_frame *frame, const shared_edge *e, bool turned) {
    return dp_fold_seen(frame, e->a, !turned, e->b, turned == e->flipped, e->edge_b);
}

static void add_outline(dp_finder *w, const shared_edge *e, dp_line line) {
    dp_vec3 normal;
    if (e->b == UINT32_MAX) {
        normal = dp_polygon_normal(w->tile.frame, e->a);
        if (!dp_faces_front(w->tile.frame, e->a)) normal = dp_scale(normal, -1);
    } else {
        normal = fold_of(w->tile.frame, e, false).normal;
    }
    add_line(w, e, line, normal, dp_faces_front(w->tile.frame, e->a) ? 1 : 2);
}

/* A crease lies between two front faces, or between two polygons of different winding that show the
 * eye the same side. */
static void add_crease(dp_finder *w, uint32_t polygon, uint32_t corner) {
    const dp_frame *const f = w->tile.frame;
    if (!dp_is_across(f->adjacency->across[corner])) return;
    const shared_edge e = owned(f, polygon, corner);
    if (e.a != polygon || (f->facing[e.b] & DP_FACING_NO_AREA)) return;
    const bool front_a = dp_faces_front(f, e.a), front_b = dp_faces_front(f, e.b) != e.flipped;
    if (front_a != front_b || (!front_a && !e.flipped)) return;
    const dp_fold fold = fold_of(f, &e, !front_a);
    if (dp_dot(fold.normal_a, fold.normal_b) > (double)f->flat_cosine) return;
    const int line = dp_fold_line(&fold, dp_polygon_style(f, e.a));
    if (line >= 0) add_line(w, &e, (dp_line)line, fold.normal, 3);
}

/* Only for polygons that are not hidden: a hidden one has all its edges well behind the surface. */
static void add_polygon(dp_finder *w, const dp_tile_polygon *p, bool creases) {
    const dp_polygons *const polygons = &w->tile.frame->polygons;
    const uint32_t first = dp_first_corner(polygons, p->id), n = dp_corner_count(polygons, p->id);
    for (uint32_t i = 0; i < n && !w->tile.failed; i++) {
        if (!dp_edge_may_be_line(polygons, first + i)) continue;
        if (!dp_tile_edge_is_near(&w->tile, p, i)) continue;
        const int line = dp_outline_of_edge(w->tile.frame, p->id, first + i);
        if (line >= 0) {
            const shared_edge e = owned(w->tile.frame, p->id, first + i);
            add_outline(w, &e, (dp_line)line);
        } else if (creases && dp_edge_is_flagged(polygons, first + i) &&
                   !dp_edge_is_smooth(polygons, first + i)) {
            add_crease(w, p->id, first + i);
        }
        w->tile.stats.edges_resolved++;
        w->tile.stats.open_edges += line == DP_LINE_BORDER;
    }
}

void dp_find_adjacent_edges(dp_finder *w) {
    const bool creases = w->tile.frame->lines & (DP_RIDGE | DP_VALLEY);
    for (uint32_t i = 0; i < w->tile.polygon_count && !w->tile.failed; i++) {
        const dp_tile_polygon *const p = &w->tile.polygons[i];
        if (p->flags & DP_POLYGON_HIDDEN) continue;
        if (creases || w->tile.frame->outlined[p->id]) add_polygon(w, p, creases);
    }
}
