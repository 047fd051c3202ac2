/* The edge table of a tile: which two polygons meet at an edge, found while the tile is drawn.
 *
 * Every polygon that touches an edge within the tile is in the tile's bin, so an edge's polygons always
 * meet here, without adjacency (docs/architecture.md). Edges are named by the bits of their
 * ends' positions: an index buffer, split vertices and a bare soup give the same names.
 *
 * Data structure: open addressing over (hash, 1 + entry) pairs; entries in order of first meeting, so
 * that what is found does not depend on the hash. Invariant: at most half of the slots are used. Hidden
 * polygons come last and add no edges: an edge between two of them is hidden itself.
 * Not resolved here: edges whose neighbours share no corner with them (emerge.c). */
#include "pipe/classify.h"
#include "pipe/tile.h"

#include <string.h>

static bool same_position(const dp_polygons *polygons, uint32_t a, uint32_t b) {
    if (a == b) return true;
    const float *const p = dp_vertex_position(polygons, a), *const q = dp_vertex_position(polygons, b);
    return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
}

static bool near_tile(const dp_tile_worker *w, const dp_tile_polygon *p, uint32_t i) {
    if (p->flags & (DP_POLYGON_CLIPPED | DP_POLYGON_WITHIN)) return true;
    const dp_vertex a = w->points[p->point + i];
    const dp_vertex b = w->points[p->point + (i + 1 == p->points ? 0 : i + 1)];
    return dp_maxf(a.x, b.x) >= -DP_BESIDE && dp_minf(a.x, b.x) <= DP_TILE + DP_BESIDE &&
           dp_maxf(a.y, b.y) >= -DP_BESIDE && dp_minf(a.y, b.y) <= DP_TILE + DP_BESIDE;
}

/* Corners of the polygons that may add edges. */
static uint32_t count_edges(const dp_tile_worker *w) {
    uint32_t edges = 0;
    for (uint32_t i = 0; i < w->polygon_count; i++)
        if (!(w->polygons[i].flags & DP_POLYGON_HIDDEN)) edges += dp_corner_count(&w->frame->polygons, w->polygons[i].id);
    return edges;
}

static bool clear_table(dp_tile_worker *w) {
    const uint32_t edges = count_edges(w);
    uint32_t slots = 64;
    while (slots < 2 * edges) slots *= 2;
    w->slot_count = slots;
    w->edge_count = w->meeting_count = 0;
    if (!DP_WORKER_RESERVE(w, edge_slots, slots_cap, 2 * (size_t)slots) ||
        !DP_WORKER_RESERVE(w, normals, normals_cap, w->polygon_count))
        return false;
    memset(w->normals, 0, w->polygon_count * sizeof *w->normals);
    memset(w->edge_slots, 0, 2 * (size_t)slots * sizeof *w->edge_slots);
    return DP_WORKER_RESERVE(w, edges, edges_cap, edges);
}

static void meet(dp_tile_worker *w, dp_edge_entry *e, uint32_t polygon, uint32_t edge, bool opposed) {
    if (e->met++ == 1) {
        e->b = polygon, e->edge_b = edge, e->opposed = opposed;
        return;
    }
    if (!DP_WORKER_RESERVE(w, meetings, meetings_cap, w->meeting_count + 1u)) return;
    w->meetings[w->meeting_count] = (dp_meeting){polygon, edge, e->more};
    e->more = ++w->meeting_count;
}

static uint32_t edge_hash(uint32_t ka, uint32_t kb) {
    const uint32_t hash = (ka + kb) * 0x9e3779b1u ^ (ka ^ kb);
    return hash ^ hash >> 15;
}

/* Is the edge's place in the table free? Then no visible polygon has it. */
static bool is_free(const dp_tile_worker *w, uint32_t hash) {
    return !w->edge_slots[2 * (size_t)(hash & (w->slot_count - 1)) + 1];
}

/* Enters an edge, or only meets it where a polygon that is not hidden has it too. */
static void insert(dp_tile_worker *w, uint32_t polygon, uint32_t edge, uint32_t va, uint32_t vb, uint32_t hash) {
    const dp_polygons *const polygons = &w->frame->polygons;
    const uint32_t mask = w->slot_count - 1;
    for (uint32_t s = hash & mask;; s = (s + 1) & mask) {
        uint32_t *const slot = w->edge_slots + 2 * (size_t)s;
        if (!slot[1]) {
            if (w->polygons[polygon].flags & DP_POLYGON_HIDDEN) return;
            slot[0] = hash;
            slot[1] = ++w->edge_count;
            w->edges[w->edge_count - 1] = (dp_edge_entry){va, vb, polygon, UINT32_MAX, edge, 0, 1, 0, false};
            return;
        }
        if (slot[0] != hash) continue;
        dp_edge_entry *const e = &w->edges[slot[1] - 1];
        const bool opposed = same_position(polygons, e->va, vb) && same_position(polygons, e->vb, va);
        if (opposed || (same_position(polygons, e->va, va) && same_position(polygons, e->vb, vb))) {
            meet(w, e, polygon, edge, opposed);
            return;
        }
    }
}

static bool is_flagged(const dp_polygons *polygons, uint32_t corner) {
    return !polygons->edge_flags || polygons->edge_flags[corner];
}

/* Keys come from the tile's points where these are the corners, else from the vertices. */
static uint32_t key_of(const dp_tile_worker *w, const dp_tile_polygon *p, uint32_t i, uint32_t first) {
    if (!(p->flags & DP_POLYGON_CLIPPED)) return w->points[p->point + i].key;
    return w->frame->vertices[dp_corner_vertex(&w->frame->polygons, first + i)].key;
}

static void insert_edge(dp_tile_worker *w, const dp_tile_polygon *p, uint32_t index, uint32_t i, uint32_t next,
                        uint32_t ka, uint32_t kb) {
    const dp_polygons *const polygons = &w->frame->polygons;
    const uint32_t hash = edge_hash(ka, kb), first = dp_first_corner(polygons, p->id);
    if (p->flags & DP_POLYGON_HIDDEN && is_free(w, hash)) return;
    if (!is_flagged(polygons, first + i) || !near_tile(w, p, i)) return;
    const uint32_t va = dp_corner_vertex(polygons, first + i), vb = dp_corner_vertex(polygons, first + next);
    if (ka != kb || !same_position(polygons, va, vb)) insert(w, index, i, va, vb, hash);
}

static void insert_polygon(dp_tile_worker *w, uint32_t index) {
    const dp_polygons *const polygons = &w->frame->polygons;
    const dp_tile_polygon *const p = &w->polygons[index];
    const uint32_t first = dp_first_corner(polygons, p->id), n = dp_corner_count(polygons, p->id);
    const uint32_t k0 = key_of(w, p, 0, first);
    uint32_t ka = k0;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t next = i + 1 == n ? 0 : i + 1;
        const uint32_t kb = next ? key_of(w, p, next, first) : k0;
        insert_edge(w, p, index, i, next, ka, kb);
        ka = kb;
    }
}

/* The polygon that came first in the source owns the edge, in every tile. */
static dp_edge_entry owned_by_first(const dp_tile_worker *w, const dp_edge_entry *e) {
    if (w->polygons[e->a].id < w->polygons[e->b].id) return *e;
    const bool opposed = e->opposed;
    return (dp_edge_entry){opposed ? e->vb : e->va, opposed ? e->va : e->vb, e->b, e->a, e->edge_b, e->edge_a,
                           e->met, e->more, opposed};
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
    dp_tile_add_candidate(w, (dp_candidate){.a = a->id, .b = w->polygons[e->b].id, .edge = e->edge_a, .k1 = UINT32_MAX, .line = (uint8_t)line},
                          &spine);
}

static void add_fold(dp_tile_worker *w, const dp_edge_entry *e, const dp_fold *fold) {
    const dp_style *const style = dp_polygon_style(w->frame, w->polygons[e->a].id);
    const int line = dp_fold_line(fold, style);
    if (line >= 0) add_line(w, e, (dp_line)line, fold->normal);
}

/* A triangle's normal in float32; false where it is too thin for that to be within half a degree. */
static bool quick_triangle_normal(const dp_polygons *polygons, uint32_t id, float out[3]) {
    const float *const a = dp_vertex_position(polygons, dp_corner_vertex(polygons, 3 * id));
    const float *const b = dp_vertex_position(polygons, dp_corner_vertex(polygons, 3 * id + 1));
    const float *const c = dp_vertex_position(polygons, dp_corner_vertex(polygons, 3 * id + 2));
    const float ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
    const float vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
    const float nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    const float n2 = nx * nx + ny * ny + nz * nz;
    const float u2 = ux * ux + uy * uy + uz * uz, v2 = vx * vx + vy * vy + vz * vz;
    if (!(n2 > 1e-6f * u2 * v2) || !(n2 > FLT_MIN)) return false;
    const float inverse = 1 / sqrtf(n2);
    out[0] = nx * inverse, out[1] = ny * inverse, out[2] = nz * inverse;
    return true;
}

/* The unit normal in float32, for a first look; made when it is first asked for. */
static const float *quick_normal(dp_tile_worker *w, uint32_t polygon) {
    const uint32_t id = w->polygons[polygon].id;
    float *const normal = w->normals[polygon];
    if (normal[0] != 0 || normal[1] != 0 || normal[2] != 0) return normal;
    if (!w->frame->polygons.firsts && quick_triangle_normal(&w->frame->polygons, id, normal)) return normal;
    const dp_vec3 n = dp_polygon_normal(w->frame, id);
    normal[0] = (float)n.x, normal[1] = (float)n.y, normal[2] = (float)n.z;
    return normal;
}

/* Most edges are flatter than any threshold; one product tells. */
static bool is_flat(dp_tile_worker *w, const dp_edge_entry *e) {
    const float *const a = quick_normal(w, e->a), *const b = quick_normal(w, e->b);
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] > w->frame->flat_cosine;
}

static void resolve_pair(dp_tile_worker *w, const dp_edge_entry *met) {
    const uint32_t front_a = w->polygons[met->a].flags & DP_POLYGON_FRONT;
    const uint32_t front_b = w->polygons[met->b].flags & DP_POLYGON_FRONT;
    if (!front_a && !front_b) return;
    if (front_a && front_b && is_flat(w, met)) return;
    const dp_edge_entry owned = owned_by_first(w, met), *const e = &owned;
    const dp_fold fold = dp_fold_seen(w->frame, w->polygons[e->a].id, true, w->polygons[e->b].id, true, e->edge_b);
    if (front_a && front_b) add_fold(w, e, &fold);
    else add_line(w, e, DP_LINE_SILHOUETTE, fold.normal);
}

/* A polygon at an edge as the eye sees it: on which side of the edge it lies on the screen, and how fast
 * it comes nearer going away from the edge. */
typedef struct flap {
    uint32_t polygon, edge;
    bool front;
    double side;  /* px; the sign tells left or right of va -> vb */
    double rise;  /* change of depth per px away from the edge */
} flap;

static flap make_flap(const dp_tile_worker *w, const dp_spine *s, uint32_t polygon, uint32_t edge) {
    const dp_tile_polygon *const p = &w->polygons[polygon];
    flap f = {.polygon = polygon, .edge = edge, .front = p->flags & DP_POLYGON_FRONT};
    const double ex = s->b.x - s->a.x, ey = s->b.y - s->a.y, length = hypot(ex, ey);
    if (!(length > 0)) return f;
    const dp_vertex *const points = w->points + p->point;
    for (uint32_t i = 0; i < p->points; i++) {
        const double x = points[i].x + (double)w->tile_x - s->a.x, y = points[i].y + (double)w->tile_y - s->a.y;
        const double across = (ex * y - ey * x) / length;
        if (fabs(across) > fabs(f.side)) f.side = across;
    }
    const double sign = f.side < 0 ? -1 : 1;
    f.rise = sign * (ex * p->dy - ey * p->dx) / length;
    return f;
}

/* Keeps the flap that is nearest to the eye on its side. */
static void offer_flap(flap best[2], uint32_t count[2], flap f) {
    const int side = f.side < 0;
    if (!count[side]++ || f.rise > best[side].rise) best[side] = f;
}

/* Edges where the winding disagrees or more than two polygons meet: what the eye sees decides. The
 * nearest polygon on either side of the edge hides the others; the two make the line that two
 * polygons would make there, and when all lie on one side the edge is an outline. */
static void resolve_fan(dp_tile_worker *w, const dp_edge_entry *e) {
    dp_spine s;
    const dp_polygons *const polygons = &w->frame->polygons;
    if (!dp_spine_make(&w->frame->view, dp_v3f(dp_vertex_position(polygons, e->va)),
                       dp_v3f(dp_vertex_position(polygons, e->vb)), dp_v3(0, 0, 0), &s))
        return;
    flap best[2] = {{0}};
    uint32_t count[2] = {0, 0};
    offer_flap(best, count, make_flap(w, &s, e->a, e->edge_a));
    offer_flap(best, count, make_flap(w, &s, e->b, e->edge_b));
    for (uint32_t i = e->more; i; i = w->meetings[i - 1].next)
        offer_flap(best, count, make_flap(w, &s, w->meetings[i - 1].polygon, w->meetings[i - 1].edge));
    if (!count[0] || !count[1]) {
        const flap f = best[count[0] ? 0 : 1];
        dp_vec3 normal = dp_polygon_normal(w->frame, w->polygons[f.polygon].id);
        if (!f.front) normal = dp_scale(normal, -1);
        add_line(w, e, DP_LINE_SILHOUETTE, normal);
        return;
    }
    if (!best[0].front && !best[1].front) return;
    const dp_fold fold = dp_fold_seen(w->frame, w->polygons[best[0].polygon].id, best[0].front,
                                      w->polygons[best[1].polygon].id, best[1].front, best[1].edge);
    add_fold(w, e, &fold);
}

static void leave(dp_tile_worker *w, uint32_t polygon, uint32_t edge) {
    if (!DP_WORKER_RESERVE(w, loose, loose_cap, w->loose_count + 1u)) return;
    w->loose[w->loose_count++] = (dp_loose_edge){polygon, edge};
}

/* Every edge of every polygon is left to emerge (dp_style.edge_table_off). */
static void leave_all(dp_tile_worker *w) {
    const dp_polygons *const polygons = &w->frame->polygons;
    for (uint32_t i = 0; i < w->polygon_count && !w->failed; i++) {
        const dp_tile_polygon *const p = &w->polygons[i];
        const uint32_t first = dp_first_corner(polygons, p->id), n = dp_corner_count(polygons, p->id);
        for (uint32_t e = 0; e < n; e++)
            if (is_flagged(polygons, first + e) && near_tile(w, p, e)) leave(w, i, e);
    }
}

void dp_tile_edges(dp_tile_worker *w) {
    if (w->frame->styles[0].edge_table_off) {
        leave_all(w);
        return;
    }
    if (!clear_table(w)) return;
    for (uint32_t i = 0; i < w->polygon_count; i++)
        if (!(w->polygons[i].flags & DP_POLYGON_HIDDEN)) insert_polygon(w, i);
    for (uint32_t i = 0; i < w->polygon_count; i++)
        if (w->polygons[i].flags & DP_POLYGON_HIDDEN) insert_polygon(w, i);
    for (uint32_t i = 0; i < w->edge_count && !w->failed; i++) {
        const dp_edge_entry *const e = &w->edges[i];
        if (e->met == 1) leave(w, e->a, e->edge_a);
        else if (e->met == 2 && e->opposed) resolve_pair(w, e);
        else resolve_fan(w, e);
        w->stats.edges_resolved += e->met > 1;
    }
}
