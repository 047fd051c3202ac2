/* The edge table of a tile: which two polygons meet at an edge, found while the tile is drawn.
 *
 * Every polygon that touches an edge within the tile is in the tile's bin, so an edge's polygons always
 * meet here, without adjacency (docs/architecture.md). Edges are named by the bits of their
 * ends' positions: an index buffer, split vertices and a bare soup give the same names.
 *
 * Data structure: open addressing; `edges` are the slots in order of first meeting, so that what is found
 * does not depend on the hash. Invariant: at most two thirds of the slots are used. Hidden polygons stay
 * away: their edges are hidden themselves, and a seen polygon that lacks one at its edge finds that too.
 * Not resolved here: edges whose neighbours share no corner with them (emerge.c). */
#include "kernel/kernels.h"
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

/* Numbers of edges that a slot can hold; those beyond are left to emerge. */
enum { EDGE_MAX = UINT16_MAX };

/* Corners of the polygons that are seen. */
static size_t count_corners(const dp_tile_worker *w) {
    const dp_polygons *const polygons = &w->frame->polygons;
    if (!polygons->firsts) return 3 * (size_t)w->seen_count;
    size_t corners = 0;
    for (uint32_t i = 0; i < w->seen_count; i++) corners += dp_corner_count(polygons, w->polygons[w->seen[i]].id);
    return corners;
}

static bool clear_table(dp_tile_worker *w) {
    const size_t corners = count_corners(w);
    const size_t slots = 2 * corners + 64;
    w->edge_count = w->meeting_count = 0;
    w->slot_count = (uint32_t)slots;
    if (slots >= DP_SLOT_FLAT || !DP_WORKER_RESERVE(w, edge_slots, slots_cap, slots) ||
        !DP_WORKER_RESERVE(w, edges, edges_cap, corners)) {
        w->failed = true;
        return false;
    }
    memset(w->edge_slots, 0, slots * sizeof *w->edge_slots);
    return true;
}

static uint32_t edge_hash(uint32_t ka, uint32_t kb) {
    return (ka + kb) * 0x9e3779b1u ^ (ka ^ kb);
}

static uint32_t place_of(uint32_t hash, uint32_t slots) { return (uint32_t)((uint64_t)hash * slots >> 32); }

typedef struct ends {
    uint32_t va, vb; /* vertices */
} ends;

static ends edge_ends(const dp_polygons *polygons, uint32_t id, uint32_t edge) {
    const uint32_t first = dp_first_corner(polygons, id), n = dp_corner_count(polygons, id);
    return (ends){dp_corner_vertex(polygons, first + edge), dp_corner_vertex(polygons, first + (edge + 1 == n ? 0 : edge + 1))};
}

/* Most edges are flatter than any threshold; one product tells. */
static bool is_flat(const dp_tile_worker *w, uint32_t a, uint32_t b) {
    const float *const p = w->normals[a], *const q = w->normals[b];
    return w->polygons[a].flags & w->polygons[b].flags & DP_POLYGON_FRONT &&
           p[0] * q[0] + p[1] * q[1] + p[2] * q[2] > w->frame->flat_cosine;
}

/* A third or later polygon at an edge. */
static void add_meeting(dp_tile_worker *w, uint32_t slot, uint32_t polygon, uint32_t edge) {
    if (!DP_WORKER_RESERVE(w, meetings, meetings_cap, w->meeting_count + 1u) ||
        !DP_WORKER_RESERVE(w, slot_meetings, slot_meetings_cap, w->slot_count))
        return;
    dp_edge_slot *const s = &w->edge_slots[slot];
    w->meetings[w->meeting_count] = (dp_meeting){polygon, edge, s->b & DP_SLOT_MORE ? w->slot_meetings[slot] : 0};
    w->slot_meetings[slot] = ++w->meeting_count;
    s->b |= DP_SLOT_MORE;
}

static void meet(dp_tile_worker *w, uint32_t slot, uint32_t polygon, uint32_t edge, bool opposed) {
    dp_edge_slot *const s = &w->edge_slots[slot];
    if (s->b) {
        add_meeting(w, slot, polygon, edge);
        return;
    }
    s->b = (polygon + 1) | (opposed ? is_flat(w, s->a - 1, polygon) ? DP_SLOT_FLAT : 0 : DP_SLOT_SAME_WAY);
    s->edge_b = (uint16_t)edge;
}

/* Enters an edge of a polygon, or meets the one that is there. */
static void insert(dp_tile_worker *w, uint32_t polygon, uint32_t edge, ends e, uint32_t hash) {
    const dp_polygons *const polygons = &w->frame->polygons;
    const uint32_t count = w->slot_count;
    for (uint32_t s = place_of(hash, count);; s = s + 1 == count ? 0 : s + 1) {
        dp_edge_slot *const slot = &w->edge_slots[s];
        if (!slot->a) {
            *slot = (dp_edge_slot){hash, polygon + 1, 0, (uint16_t)edge, 0};
            w->edges[w->edge_count++] = s;
            return;
        }
        if (slot->hash != hash) continue;
        const ends other = edge_ends(polygons, w->polygons[slot->a - 1].id, slot->edge_a);
        const bool opposed = same_position(polygons, other.va, e.vb) && same_position(polygons, other.vb, e.va);
        if (opposed || (same_position(polygons, other.va, e.va) && same_position(polygons, other.vb, e.vb))) {
            meet(w, s, polygon, edge, opposed);
            return;
        }
    }
}

static bool is_flagged(const dp_polygons *polygons, uint32_t corner) {
    return !polygons->edge_flags || polygons->edge_flags[corner];
}

static void leave(dp_tile_worker *w, uint32_t polygon, uint32_t edge) {
    if (!DP_WORKER_RESERVE(w, loose, loose_cap, w->loose_count + 1u)) return;
    w->loose[w->loose_count++] = (dp_loose_edge){polygon, edge};
}

/* Keys come from the tile's points where these are the corners, else from the vertices. */
static uint32_t key_of(const dp_tile_worker *w, const dp_tile_polygon *p, uint32_t i, uint32_t first) {
    if (!(p->flags & DP_POLYGON_CLIPPED)) return w->points[p->point + i].key;
    return w->frame->vertices[dp_corner_vertex(&w->frame->polygons, first + i)].key;
}

static void insert_polygon(dp_tile_worker *w, uint32_t index) {
    const dp_polygons *const polygons = &w->frame->polygons;
    const dp_tile_polygon *const p = &w->polygons[index];
    const uint32_t first = dp_first_corner(polygons, p->id), n = dp_corner_count(polygons, p->id);
    const uint32_t k0 = key_of(w, p, 0, first);
    uint32_t ka = k0;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t next = i + 1 == n ? 0 : i + 1, kb = next ? key_of(w, p, next, first) : k0;
        const uint32_t hash = edge_hash(ka, kb);
        const ends e = {dp_corner_vertex(polygons, first + i), dp_corner_vertex(polygons, first + next)};
        const bool real = ka != kb || !same_position(polygons, e.va, e.vb);
        ka = kb;
        if (!real || !is_flagged(polygons, first + i) || !near_tile(w, p, i)) continue;
        if (i > EDGE_MAX) leave(w, index, i);
        else insert(w, index, i, e, hash);
    }
}

/* A triangle without flags, all of whose edges belong into the table; false where it is not like that. */
static bool is_simple(const dp_tile_polygon *p, const dp_vertex *at) {
    return (p->flags & (DP_POLYGON_CLIPPED | DP_POLYGON_WITHIN)) == DP_POLYGON_WITHIN && at[0].key != at[1].key &&
           at[1].key != at[2].key && at[2].key != at[0].key;
}

/* `insert` for an edge of a triangle from corner number `edge` of its corners `c`: most edges meet the other
 * triangle that has the same two vertices, or nobody yet. */
static inline void insert_quick(dp_tile_worker *w, const dp_polygons *polygons, uint32_t polygon, uint32_t edge,
                                const uint32_t c[3], uint32_t hash) {
    static const uint8_t NEXT[3] = {1, 2, 0};
    uint32_t s = place_of(hash, w->slot_count);
    while (w->edge_slots[s].a && w->edge_slots[s].hash != hash) s = s + 1 == w->slot_count ? 0 : s + 1;
    dp_edge_slot *const slot = &w->edge_slots[s];
    if (!slot->a) {
        *slot = (dp_edge_slot){hash, polygon + 1, 0, (uint16_t)edge, 0};
        w->edges[w->edge_count++] = s;
        return;
    }
    if (!slot->b) {
        const uint32_t first = 3 * w->polygons[slot->a - 1].id;
        if (dp_corner_vertex(polygons, first + slot->edge_a) == c[NEXT[edge]] &&
            dp_corner_vertex(polygons, first + NEXT[slot->edge_a]) == c[edge]) {
            slot->b = (polygon + 1) | (is_flat(w, slot->a - 1, polygon) ? DP_SLOT_FLAT : 0);
            slot->edge_b = (uint16_t)edge;
            return;
        }
    }
    insert(w, polygon, edge, (ends){c[edge], c[NEXT[edge]]}, hash);
}

/* Some triangles ahead of where they are entered, their slots are asked for from memory. */
enum { AHEAD = 8 };

typedef struct pending {
    uint32_t hash[3];
    bool simple;
} pending;

static pending look_ahead(const dp_tile_worker *w, uint32_t index) {
    const dp_tile_polygon *const p = &w->polygons[index];
    const dp_vertex *const at = w->points + p->point;
    pending out = {{edge_hash(at[0].key, at[1].key), edge_hash(at[1].key, at[2].key), edge_hash(at[2].key, at[0].key)},
                   is_simple(p, at)};
    for (int k = 0; k < 3; k++) __builtin_prefetch(&w->edge_slots[place_of(out.hash[k], w->slot_count)], 1);
    return out;
}

/* The edges of all seen polygons of a frame of triangles without edge flags. */
static void insert_triangles(dp_tile_worker *w) {
    const dp_polygons *const polygons = &w->frame->polygons;
    pending ring[AHEAD];
    for (uint32_t i = 0; i < AHEAD && i < w->seen_count; i++) ring[i] = look_ahead(w, w->seen[i]);
    for (uint32_t i = 0; i < w->seen_count; i++) {
        const uint32_t index = w->seen[i], first = 3 * w->polygons[index].id;
        const pending p = ring[i % AHEAD];
        if (i + AHEAD < w->seen_count) ring[i % AHEAD] = look_ahead(w, w->seen[i + AHEAD]);
        if (!p.simple) {
            insert_polygon(w, index);
            continue;
        }
        const uint32_t c[3] = {dp_corner_vertex(polygons, first), dp_corner_vertex(polygons, first + 1),
                               dp_corner_vertex(polygons, first + 2)};
        for (uint32_t k = 0; k < 3; k++) insert_quick(w, polygons, index, k, c, p.hash[k]);
    }
}

/* The polygon that came first in the source owns the edge, in every tile. */
static dp_edge_entry owned_by_first(const dp_tile_worker *w, const dp_edge_entry *e) {
    if (w->polygons[e->a].id < w->polygons[e->b].id) return *e;
    const bool opposed = e->opposed;
    return (dp_edge_entry){opposed ? e->vb : e->va, opposed ? e->va : e->vb, e->b, e->a, e->edge_b, e->edge_a,
                           e->more, opposed};
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

/* The unit normal in float32, for a first look. */
static void set_normal(dp_tile_worker *w, uint32_t polygon) {
    const dp_vec3 n = dp_polygon_normal(w->frame, w->polygons[polygon].id);
    float *const out = w->normals[polygon];
    out[0] = (float)n.x, out[1] = (float)n.y, out[2] = (float)n.z;
}

static bool set_normals(dp_tile_worker *w) {
    if (!DP_WORKER_RESERVE(w, normals, normals_cap, (size_t)w->polygon_count)) return false;
    if (!w->frame->polygons.firsts) w->frame->kernels->normals(w);
    else
        for (uint32_t i = 0; i < w->seen_count; i++) set_normal(w, w->seen[i]);
    return true;
}

void dp_tile_exact_normal(dp_tile_worker *w, uint32_t polygon) { set_normal(w, polygon); }

/* What met at a slot. */
static dp_edge_entry entry_of(const dp_tile_worker *w, uint32_t slot) {
    const dp_edge_slot *const s = &w->edge_slots[slot];
    const ends e = edge_ends(&w->frame->polygons, w->polygons[s->a - 1].id, s->edge_a);
    return (dp_edge_entry){.va = e.va, .vb = e.vb, .a = s->a - 1, .b = (s->b & DP_SLOT_POLYGON) - 1, .edge_a = s->edge_a,
                           .edge_b = s->edge_b, .more = s->b & DP_SLOT_MORE ? w->slot_meetings[slot] : 0,
                           .opposed = !(s->b & DP_SLOT_SAME_WAY)};
}

/* An edge that lies hidden as polygons do; the other polygon at it may be one of these. */
static bool is_hidden_edge(const dp_tile_worker *w, const dp_edge_slot *s) {
    const dp_tile_polygon *const p = &w->polygons[s->a - 1];
    if (p->flags & DP_POLYGON_CLIPPED) return false;
    const dp_vertex a = w->points[p->point + s->edge_a];
    const dp_vertex b = w->points[p->point + (s->edge_a + 1u == p->points ? 0 : s->edge_a + 1u)];
    return dp_tile_hides(w, dp_minf(a.x, b.x), dp_minf(a.y, b.y), dp_maxf(a.x, b.x), dp_maxf(a.y, b.y), dp_maxf(a.d, b.d));
}

static void resolve_pair(dp_tile_worker *w, const dp_edge_entry *met) {
    const uint32_t front_a = w->polygons[met->a].flags & DP_POLYGON_FRONT;
    const uint32_t front_b = w->polygons[met->b].flags & DP_POLYGON_FRONT;
    if (!front_a && !front_b) return;
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
    if (!clear_table(w) || !set_normals(w)) return;
    if (!w->frame->polygons.firsts && !w->frame->polygons.edge_flags) insert_triangles(w);
    else
        for (uint32_t i = 0; i < w->seen_count; i++) insert_polygon(w, w->seen[i]);
    for (uint32_t i = 0; i < w->edge_count && !w->failed; i++) {
        const dp_edge_slot *const s = &w->edge_slots[w->edges[i]];
        w->stats.edges_resolved += s->b != 0;
        if (s->b & DP_SLOT_FLAT && !(s->b & DP_SLOT_MORE)) continue;
        if (!s->b) {
            if (!is_hidden_edge(w, s)) leave(w, s->a - 1, s->edge_a);
            continue;
        }
        const dp_edge_entry e = entry_of(w, w->edges[i]);
        if (e.more || !e.opposed) resolve_fan(w, &e);
        else resolve_pair(w, &e);
    }
}
