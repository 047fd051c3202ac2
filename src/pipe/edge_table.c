/* The edge table of a tile: which two polygons meet at an edge, found while the tile is drawn.
 *
 * Every polygon that touches an edge within the tile is in the tile's bin, so an edge's polygons always
 * meet here, without adjacency (docs/architecture.md). Edges are named by the keys of their ends' positions: an
 * index buffer, split vertices and a bare soup give the same names. Keys are hashes; before an edge becomes a
 * line the positions themselves are compared. Of those that make no line that is not asked: two neighbours of
 * one vertex whose keys are equal would have to meet, which one mesh of a million triangles in a thousand has.
 *
 * Data structure: open addressing; edges have numbers in the order of the seen polygons, and a byte per number
 * tells whether the edge may be a line, so that what is found does not depend on the hash. Pairs are gathered and
 * told flat by many at once (kernel/flatten.inc). Invariant: at most half of the slots are used. Hidden
 * polygons stay away: their edges are hidden themselves, and a seen polygon that lacks one at its edge finds that
 * too. Not resolved here: edges whose neighbours share no corner with them (emerge.c). */
#include "pipe/edge_table.h"

#include "kernel/kernels.h"

#include <string.h>

/* A triangle's edges are numbered from four times its own number, those of other polygons one after the other. */
enum { TRIANGLE_STEP = 4 };

static uint32_t edge_hash(uint32_t ka, uint32_t kb) { return (ka + kb) * 0x9e3779b1u ^ (ka ^ kb); }

static uint32_t place_of(uint32_t hash, uint32_t slots) { return (uint32_t)((uint64_t)hash * slots >> 32); }

static bool is_of_triangles(const dp_tile_worker *w) { return !w->frame->polygons.firsts; }

dp_edge_place dp_edge_place_of(const dp_tile_worker *w, uint32_t number) {
    if (is_of_triangles(w)) return (dp_edge_place){number / TRIANGLE_STEP, number % TRIANGLE_STEP};
    const uint32_t polygon = w->edge_owners[number];
    return (dp_edge_place){polygon, number - w->first_edges[polygon]};
}

static bool same_position(const dp_polygons *polygons, uint32_t a, uint32_t b) {
    if (a == b) return true;
    const float *const p = dp_vertex_position(polygons, a), *const q = dp_vertex_position(polygons, b);
    return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
}

typedef struct ends {
    uint32_t va, vb; /* vertices */
} ends;

static ends ends_of(const dp_tile_worker *w, dp_edge_place at) {
    const dp_polygons *const polygons = &w->frame->polygons;
    const uint32_t id = w->polygons[at.polygon].id;
    const uint32_t first = dp_first_corner(polygons, id), n = dp_corner_count(polygons, id);
    return (ends){dp_corner_vertex(polygons, first + at.edge),
                  dp_corner_vertex(polygons, first + (at.edge + 1 == n ? 0 : at.edge + 1))};
}

bool dp_edge_runs_between(const dp_tile_worker *w, dp_edge_place edge, uint32_t va, uint32_t vb) {
    const dp_polygons *const polygons = &w->frame->polygons;
    const ends e = ends_of(w, edge);
    return (same_position(polygons, e.va, va) && same_position(polygons, e.vb, vb)) ||
           (same_position(polygons, e.va, vb) && same_position(polygons, e.vb, va));
}

/* ------- entering ------- */

/* A third or later polygon at an edge. */
static void add_meeting(dp_tile_worker *w, uint32_t slot, uint32_t number) {
    if (!DP_WORKER_RESERVE(w, meetings, meetings_cap, w->meeting_count + 1u) ||
        !DP_WORKER_RESERVE(w, slot_meetings, slot_meetings_cap, w->slot_count))
        return;
    dp_edge_slot *const s = &w->edge_slots[slot];
    w->meetings[w->meeting_count] = (dp_meeting){s->first - 1, number, s->second & DP_SLOT_MORE ? w->slot_meetings[slot] : 0};
    w->slot_meetings[slot] = ++w->meeting_count;
    s->second |= DP_SLOT_MORE;
}

/* The second polygon at a slot that runs the edge as the first does, or a later one. */
static void meet_otherwise(dp_tile_worker *w, uint32_t slot, uint32_t number) {
    dp_edge_slot *const s = &w->edge_slots[slot];
    if (s->second) {
        add_meeting(w, slot, number);
        return;
    }
    s->second = (number + 1) | DP_SLOT_SAME_WAY;
    w->stats.edges_resolved++;
}

/* The table while it is filled, apart from the worker so that compilers keep it in registers. */
typedef struct filling {
    dp_tile_worker *w;
    dp_edge_slot *slots;
    uint8_t *marks;
    uint32_t *first, *second;
    uint32_t count; /* slots */
    uint32_t pairs;
} filling;

/* Compilers know nothing of the value, so that they make no branches of what is computed from it. */
#define OPAQUE(value) __asm__("" : "+r"(value))

/* Is the slot taken by another edge? */
static inline __attribute__((always_inline)) uint32_t is_other(const dp_edge_slot *slot, uint64_t name, uint64_t opposed) {
    uint32_t other = (uint32_t)(slot->first != 0) & (uint32_t)(slot->name != opposed) & (uint32_t)(slot->name != name);
    OPAQUE(other);
    return other;
}

/* Enters edge `number` from the corner with key ka to that with kb, or meets the one that is there. Which of
 * the two it is cannot be foreseen, so no branch asks: both are written, selected. */
static inline __attribute__((always_inline)) void enter(filling *f, uint32_t number, uint32_t ka, uint32_t kb) {
    const uint64_t name = (uint64_t)ka << 32 | kb, opposed = name << 32 | name >> 32;
    uint32_t s = place_of(edge_hash(ka, kb), f->count);
    while (is_other(&f->slots[s], name, opposed)) s = s + 1 == f->count ? 0 : s + 1;
    dp_edge_slot *const slot = &f->slots[s];
    const uint64_t had = slot->name;
    uint32_t first = slot->first, otherwise = (uint32_t)(first != 0) & ((uint32_t)(had != opposed) | (uint32_t)(slot->second != 0));
    OPAQUE(otherwise);
    if (otherwise) {
        meet_otherwise(f->w, s, number);
        return;
    }
    OPAQUE(first);
    const uint32_t is_free = !first, mask = 0 - is_free;
    slot->name = had ^ ((had ^ name) & (0 - (uint64_t)is_free));
    slot->first = first | ((number + 1) & mask);
    slot->second = (number + 1) & ~mask;
    f->marks[number] = (uint8_t)is_free;
    f->first[f->pairs] = first - 1;
    f->second[f->pairs] = number;
    f->pairs += !is_free;
}

/* Keys come from the tile's points where these are the corners, else from the vertices. */
static uint32_t key_of(const dp_tile_worker *w, const dp_tile_polygon *p, uint32_t i, uint32_t first) {
    if (!(p->flags & DP_POLYGON_CLIPPED)) return w->points[p->point + i].key;
    return w->frame->vertices[dp_corner_vertex(&w->frame->polygons, first + i)].key;
}

static void enter_polygon(filling *f, uint32_t index, uint32_t number) {
    const dp_tile_worker *const w = f->w;
    const dp_polygons *const polygons = &w->frame->polygons;
    const dp_tile_polygon *const p = &w->polygons[index];
    const uint32_t first = dp_first_corner(polygons, p->id), n = dp_corner_count(polygons, p->id);
    const uint32_t k0 = key_of(w, p, 0, first);
    uint32_t ka = k0;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t next = i + 1 == n ? 0 : i + 1, kb = next ? key_of(w, p, next, first) : k0;
        const bool real = ka != kb || !same_position(polygons, dp_corner_vertex(polygons, first + i),
                                                     dp_corner_vertex(polygons, first + next));
        if (real && dp_edge_is_flagged(polygons, first + i) && dp_tile_edge_is_near(w, p, i)) enter(f, number + i, ka, kb);
        ka = kb;
    }
}

static void enter_polygons(filling *f) {
    const dp_tile_worker *const w = f->w;
    for (uint32_t i = 0; i < w->seen_count; i++) {
        const uint32_t index = w->seen[i];
        enter_polygon(f, index, is_of_triangles(w) ? TRIANGLE_STEP * index : w->first_edges[index]);
    }
}

/* The same for triangles without edge flags, most of which are not clipped and have three edges. */
static void enter_triangles(filling *out) {
    filling f = *out;
    const dp_tile_worker *const w = f.w;
    const uint32_t *const seen = w->seen, count = w->seen_count;
    const dp_tile_polygon *const polygons = w->polygons;
    const dp_vertex *const points = w->points;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t index = seen[i], number = TRIANGLE_STEP * index, flags = polygons[index].flags;
        const dp_vertex *const at = points + polygons[index].point;
        const uint32_t k0 = at[0].key, k1 = at[1].key, k2 = at[2].key;
        if ((flags & DP_POLYGON_CLIPPED) | (k0 == k1) | (k1 == k2) | (k2 == k0)) {
            *out = f;
            enter_polygon(out, index, number);
            f = *out;
            continue;
        }
        if (flags & DP_POLYGON_NEAR) enter(&f, number, k0, k1);
        if (flags & DP_POLYGON_NEAR << 1) enter(&f, number + 1, k1, k2);
        if (flags & DP_POLYGON_NEAR << 2) enter(&f, number + 2, k2, k0);
    }
    *out = f;
}

/* ------- filling ------- */

/* Numbers the edges of polygons that are not all triangles. */
static bool number_edges(dp_tile_worker *w, size_t *corners) {
    const dp_polygons *const polygons = &w->frame->polygons;
    *corners = 0;
    for (uint32_t i = 0; i < w->seen_count; i++) *corners += dp_corner_count(polygons, w->polygons[w->seen[i]].id);
    if (*corners >= DP_SLOT_MORE || !DP_WORKER_RESERVE(w, first_edges, first_edges_cap, (size_t)w->polygon_count) ||
        !DP_WORKER_RESERVE(w, edge_owners, edge_owners_cap, *corners))
        return false;
    uint32_t number = 0;
    for (uint32_t i = 0; i < w->seen_count; i++) {
        const uint32_t n = dp_corner_count(polygons, w->polygons[w->seen[i]].id);
        w->first_edges[w->seen[i]] = number;
        for (uint32_t e = 0; e < n; e++) w->edge_owners[number++] = w->seen[i];
    }
    return true;
}

static bool clear_table(dp_tile_worker *w) {
    const bool triangles = is_of_triangles(w);
    size_t corners = 3 * (size_t)w->seen_count;
    if (!triangles && !number_edges(w, &corners)) return false;
    const size_t numbers = triangles ? TRIANGLE_STEP * (size_t)w->polygon_count : corners;
    const size_t slots = 2 * corners + 64, marks = (numbers + 8) / 8 * 8;
    if (marks >= DP_SLOT_MORE || slots >= UINT32_MAX || !DP_WORKER_RESERVE(w, edge_slots, slots_cap, slots) ||
        !DP_WORKER_RESERVE(w, edge_marks, edge_marks_cap, marks) ||
        !DP_WORKER_RESERVE(w, pair_first, pair_first_cap, corners / 2 + DP_PAIRS_ROOM) ||
        !DP_WORKER_RESERVE(w, pair_second, pair_second_cap, corners / 2 + DP_PAIRS_ROOM))
        return false;
    w->meeting_count = w->edge_pairs = 0;
    w->slot_count = (uint32_t)slots;
    w->edge_mark_count = (uint32_t)marks;
    memset(w->edge_slots, 0, slots * sizeof *w->edge_slots);
    memset(w->edge_marks, 0, marks);
    return true;
}

/* Pairs of polygons that are not all triangles, one by one. */
static void flatten_polygons(dp_tile_worker *w) {
    for (uint32_t i = 0; i < w->edge_pairs; i++) {
        const float *const p = w->normals[w->edge_owners[w->pair_first[i]]];
        const float *const q = w->normals[w->edge_owners[w->pair_second[i]]];
        const float cosine = p[0] * q[0] + p[1] * q[1] + p[2] * q[2] + p[3] * q[3];
        w->edge_marks[w->pair_first[i]] = !(cosine > w->frame->flat_cosine);
    }
}

bool dp_edge_table_fill(dp_tile_worker *w) {
    if (!clear_table(w)) {
        w->failed = true;
        return false;
    }
    filling f = {w, w->edge_slots, w->edge_marks, w->pair_first, w->pair_second, w->slot_count, 0};
    if (is_of_triangles(w) && !w->frame->polygons.edge_flags) enter_triangles(&f);
    else enter_polygons(&f);
    w->edge_pairs = f.pairs;
    w->stats.edges_resolved += w->edge_pairs;
    if (is_of_triangles(w)) w->frame->kernels->flatten(w);
    else flatten_polygons(w);
    for (uint32_t i = 0; i < w->meeting_count; i++) w->edge_marks[w->meetings[i].first] = 1;
    return !w->failed;
}

/* ------- taking ------- */

uint32_t dp_edge_table_next(const dp_tile_worker *w, uint32_t number) {
    while (number < w->edge_mark_count) {
        uint64_t word;
        memcpy(&word, w->edge_marks + number / 8 * 8, sizeof word);
        if (!word) {
            number = (number / 8 + 1) * 8;
        } else {
            if (w->edge_marks[number]) return number;
            number++;
        }
    }
    return UINT32_MAX;
}

static uint32_t find_slot(const dp_tile_worker *w, uint32_t number, dp_edge_place at) {
    const dp_tile_polygon *const p = &w->polygons[at.polygon];
    const uint32_t first = dp_first_corner(&w->frame->polygons, p->id), n = dp_corner_count(&w->frame->polygons, p->id);
    const uint32_t ka = key_of(w, p, at.edge, first), kb = key_of(w, p, at.edge + 1 == n ? 0 : at.edge + 1, first);
    uint32_t s = place_of(edge_hash(ka, kb), w->slot_count);
    while (w->edge_slots[s].first != number + 1) s = s + 1 == w->slot_count ? 0 : s + 1;
    return s;
}

dp_edge_entry dp_edge_table_entry(const dp_tile_worker *w, uint32_t number) {
    const dp_edge_place a = dp_edge_place_of(w, number);
    const uint32_t at = find_slot(w, number, a);
    const dp_edge_slot *const s = &w->edge_slots[at];
    const ends e = ends_of(w, a);
    dp_edge_entry out = {.va = e.va, .vb = e.vb, .a = a.polygon, .b = UINT32_MAX, .edge_a = a.edge};
    if (!s->second) return out;
    const dp_edge_place b = dp_edge_place_of(w, (s->second & DP_SLOT_NUMBER) - 1);
    out.b = b.polygon, out.edge_b = b.edge;
    out.more = s->second & DP_SLOT_MORE ? w->slot_meetings[at] : 0;
    out.opposed = !(s->second & DP_SLOT_SAME_WAY);
    return out;
}
