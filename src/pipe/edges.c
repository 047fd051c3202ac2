/* The edge table of a tile: which two polygons meet at an edge, found while the tile is drawn.
 *
 * Every polygon that touches an edge within the tile is in the tile's bin, so an edge's polygons always
 * meet here, without adjacency (DESIGN: docs/architecture.md). Edges are named by the bits of their
 * ends' positions: an index buffer, split vertices and a bare soup give the same names.
 *
 * Data structure: open addressing over (hash, 1 + entry) pairs; entries in order of first meeting, so
 * that what is found does not depend on the hash. Invariant: at most half of the slots are used.
 * Not resolved here: edges where one or more than two polygons meet (emerge.c). */
#include "pipe/classify.h"
#include "pipe/tile.h"

#include <string.h>

/* Edges further than this from the tile hold no sample point of it (px; the lift is far less). */
static const float MARGIN = 1.5f;

static bool same_position(const dp_polygons *polygons, uint32_t a, uint32_t b) {
    if (a == b) return true;
    const float *const p = dp_vertex_position(polygons, a), *const q = dp_vertex_position(polygons, b);
    return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
}

static bool near_tile(const dp_tile_worker *w, const dp_tile_polygon *p, uint32_t i) {
    if (p->flags & DP_POLYGON_CLIPPED) return true;
    const dp_point a = w->points[p->point + i];
    const dp_point b = w->points[p->point + (i + 1 == p->points ? 0 : i + 1)];
    return fmaxf(a.x, b.x) >= -MARGIN && fminf(a.x, b.x) <= DP_TILE + MARGIN &&
           fmaxf(a.y, b.y) >= -MARGIN && fminf(a.y, b.y) <= DP_TILE + MARGIN;
}

static bool clear_table(dp_tile_worker *w) {
    uint32_t slots = 64;
    while (slots < 2 * w->point_count) slots *= 2;
    w->slot_count = slots;
    w->edge_count = 0;
    if (!DP_WORKER_RESERVE(w, edge_slots, slots_cap, 2 * (size_t)slots)) return false;
    memset(w->edge_slots, 0, 2 * (size_t)slots * sizeof *w->edge_slots);
    return DP_WORKER_RESERVE(w, edges, edges_cap, (size_t)w->point_count + 3 * (size_t)w->polygon_count);
}

static void meet(dp_edge_entry *e, uint32_t polygon, uint32_t edge, bool opposed) {
    if (e->met == 1) e->b = polygon, e->edge_b = edge, e->opposed = opposed;
    e->met++;
}

static void insert(dp_tile_worker *w, uint32_t polygon, uint32_t edge, uint32_t va, uint32_t vb) {
    const dp_polygons *const polygons = &w->frame->polygons;
    const uint32_t ka = w->frame->vertices[va].key, kb = w->frame->vertices[vb].key;
    uint32_t hash = (ka + kb) * 0x9e3779b1u ^ (ka ^ kb);
    hash ^= hash >> 15;
    const uint32_t mask = w->slot_count - 1;
    for (uint32_t s = hash & mask;; s = (s + 1) & mask) {
        uint32_t *const slot = w->edge_slots + 2 * (size_t)s;
        if (!slot[1]) {
            slot[0] = hash;
            slot[1] = ++w->edge_count;
            w->edges[w->edge_count - 1] = (dp_edge_entry){va, vb, polygon, UINT32_MAX, edge, 0, 1, false};
            return;
        }
        if (slot[0] != hash) continue;
        dp_edge_entry *const e = &w->edges[slot[1] - 1];
        const bool opposed = same_position(polygons, e->va, vb) && same_position(polygons, e->vb, va);
        if (opposed || (same_position(polygons, e->va, va) && same_position(polygons, e->vb, vb))) {
            meet(e, polygon, edge, opposed);
            return;
        }
    }
}

static void insert_polygon(dp_tile_worker *w, uint32_t index) {
    const dp_polygons *const polygons = &w->frame->polygons;
    const dp_tile_polygon *const p = &w->polygons[index];
    const uint32_t first = dp_first_corner(polygons, p->id), n = dp_corner_count(polygons, p->id);
    uint32_t va = dp_corner_vertex(polygons, first);
    const uint32_t v0 = va;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t vb = i + 1 == n ? v0 : dp_corner_vertex(polygons, first + i + 1);
        const bool flagged = !polygons->edge_flags || polygons->edge_flags[first + i];
        if (flagged && near_tile(w, p, i) && !same_position(polygons, va, vb)) insert(w, index, i, va, vb);
        va = vb;
    }
}

/* A line of class `line` along an edge of polygon a, facing along `normal`. */
static void add_line(dp_tile_worker *w, const dp_edge_entry *e, dp_line line, dp_vec3 normal) {
    const dp_polygons *const polygons = &w->frame->polygons;
    const dp_tile_polygon *const a = &w->polygons[e->a];
    if (!(dp_polygon_style(w->frame, a->id)->lines & (1u << line))) return;
    dp_spine spine;
    if (!dp_spine_make(&w->frame->view, dp_v3f(dp_vertex_position(polygons, e->va)),
                       dp_v3f(dp_vertex_position(polygons, e->vb)), normal, &spine))
        return;
    const uint32_t b = e->b == UINT32_MAX ? UINT32_MAX : w->polygons[e->b].id;
    dp_tile_add_candidate(w, (dp_candidate){.a = a->id, .b = b, .edge = e->edge_a, .line = (uint8_t)line},
                          &spine);
}

static void resolve_pair(dp_tile_worker *w, const dp_edge_entry *e) {
    const uint32_t front_a = w->polygons[e->a].flags & DP_POLYGON_FRONT;
    const uint32_t front_b = w->polygons[e->b].flags & DP_POLYGON_FRONT;
    if (!front_a && !front_b) return;
    const dp_edge_geometry g = dp_edge_geometry_of(w->frame, e, w->polygons[e->a].id, w->polygons[e->b].id);
    if (front_a && front_b) {
        const dp_style *const style = dp_polygon_style(w->frame, w->polygons[e->a].id);
        const double dihedral = dp_edge_dihedral(&g);
        if (dihedral <= style->ridge_angle) add_line(w, e, DP_LINE_RIDGE, g.normal);
        else if (dihedral > style->valley_angle) add_line(w, e, DP_LINE_VALLEY, g.normal);
        return;
    }
    add_line(w, e, DP_LINE_SILHOUETTE, g.normal);
}

static void resolve_border(dp_tile_worker *w, const dp_edge_entry *e) {
    dp_vec3 normal = dp_polygon_normal(w->frame, w->polygons[e->a].id);
    if (!(w->polygons[e->a].flags & DP_POLYGON_FRONT)) normal = dp_scale(normal, -1);
    w->stats.open_edges++;
    add_line(w, e, DP_LINE_BORDER, normal);
}

void dp_tile_edges(dp_tile_worker *w) {
    if (!clear_table(w)) return;
    for (uint32_t i = 0; i < w->polygon_count; i++) insert_polygon(w, i);
    for (uint32_t i = 0; i < w->edge_count && !w->failed; i++) {
        const dp_edge_entry *const e = &w->edges[i];
        if (e->met == 1) resolve_border(w, e);
        else resolve_pair(w, e);
        w->stats.edges_resolved++;
    }
}
