/* The edge table of a tile: which polygons meet at an edge, found while the tile is drawn.
 *
 *    list     half-edges of seen polygons, except those at flat vertices (one_rings.inc, edges.inc)
 *    fill     each half-edge looks up its edge's slot:
 *               free        it waits there, alone
 *               one there   the two are a pair
 *               two there   it is a meeting: a third or later polygon
 *    flatten  unmark pairs too flat for a line (edges.inc);
 *             if a pair's half-edges are of two edges: fill again, comparing whole keys
 *    unmark   half-edges that stayed alone and are hidden (edges.inc)
 *    take     what is still marked, in the order of the list (edges.c)
 *
 * Every polygon that touches an edge within the tile is in the tile's bin, so all of an edge's
 * polygons meet here, without adjacency. An edge's key is the xor of its ends' keys, which are
 * hashes of positions: an index buffer, split vertices and a polygon soup give the same keys.
 * Before an edge becomes a line, positions are compared. They are not compared for edges found
 * flat: that goes wrong only if two neighbours of one vertex have equal keys, as in one mesh of a
 * million triangles in a thousand.
 *
 * Data structure: the list, and a hash table with open addressing. A slot has 8 bytes: the key, and
 * what met there; a key's sum, which chooses the slot, is not stored. So two edges can be taken for
 * one, in one tile of a million; `flatten` sees that in the pair. A byte per half-edge marks what
 * may be a line, so results do not depend on the hash. Invariant: at most two of three slots are
 * used.
 *
 * Hidden polygons are not listed: their edges are hidden too, and a seen polygon whose partner is
 * hidden just keeps an unpaired edge. Not handled: neighbours that share no corner with the edge
 * (emerge.c). */
#include "find/edge_table.h"

#include "core/precision.h"

#include "base/elementary.h"
#include "base/hostile.h"
#include "find/kernels.h"

#include <string.h>

dp_half_edge dp_half_edge_of(const dp_finder *w, uint32_t number) {
    return (dp_half_edge){w->table.edges.polygon[number], w->table.edges.edge[number]};
}

static bool same_position(const dp_polygons *polygons, uint32_t a, uint32_t b) {
    if (a == b) return true;
    const float *const p = dp_vertex_position(polygons, a);
    const float *const q = dp_vertex_position(polygons, b);
    return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
}

typedef struct ends {
    uint32_t va, vb; /* vertices */
} ends;

static ends ends_of(const dp_finder *w, dp_half_edge at) {
    const dp_polygons *const polygons = &w->tile.frame->polygons;
    const uint32_t id = w->tile.polygons[at.polygon].id;
    const uint32_t first = dp_first_corner(polygons, id), n = dp_corner_count(polygons, id);
    return (ends){dp_corner_vertex(polygons, first + at.edge),
                  dp_corner_vertex(polygons, first + (at.edge + 1 == n ? 0 : at.edge + 1))};
}

void dp_edge_ends(const dp_finder *w, dp_half_edge edge, uint32_t *va, uint32_t *vb) {
    const ends e = ends_of(w, edge);
    *va = e.va, *vb = e.vb;
}

bool dp_edge_runs_between(const dp_finder *w, dp_half_edge edge, uint32_t va, uint32_t vb) {
    const dp_polygons *const polygons = &w->tile.frame->polygons;
    const ends e = ends_of(w, edge);
    return (same_position(polygons, e.va, va) && same_position(polygons, e.vb, vb)) ||
           (same_position(polygons, e.va, vb) && same_position(polygons, e.vb, va));
}

/* ------- listing ------- */

/* The key of corner i: from the tile's points where these are the corners (not clipped), else from
 * the frame's vertices. */
static uint32_t key_of(const dp_finder *w, const dp_tile_polygon *p, uint32_t i, uint32_t first) {
    if (!(p->flags & DP_POLYGON_CLIPPED)) return w->tile.points[p->point + i].key;
    return w->tile.frame->vertices[dp_corner_vertex(&w->tile.frame->polygons, first + i)].key;
}

void dp_edge_list_polygon(dp_finder *w, uint32_t index) {
    const dp_polygons *const polygons = &w->tile.frame->polygons;
    const dp_tile_polygon *const p = &w->tile.polygons[index];
    dp_edge_list *const list = &w->table.edges;
    const uint32_t first = dp_first_corner(polygons, p->id), n = dp_corner_count(polygons, p->id);
    const uint32_t k0 = key_of(w, p, 0, first);
    uint32_t ka = k0;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t next = i + 1 == n ? 0 : i + 1, kb = next ? key_of(w, p, next, first) : k0,
                       at = list->count;
        const bool real =
            ka != kb || !same_position(polygons, dp_corner_vertex(polygons, first + i),
                                       dp_corner_vertex(polygons, first + next));
        list->polygon[at] = index, list->edge[at] = i;
        list->from[at] = ka, list->key[at] = ka ^ kb;
        list->count += real && dp_edge_may_be_line(polygons, first + i) &&
                       dp_tile_edge_is_near(&w->tile, p, i);
        ka = kb;
    }
    w->tile.unsure[w->tile.unsure_count] = index;
    w->tile.unsure_count += w->tile.normals[index][3] > DP_AWAY;
}

static bool reserve_list(dp_finder *w, size_t edges) {
    return edges < DP_SLOT_MORE &&
           DP_TILE_RESERVE(&w->tile, w, table.edges.polygon, table.edges.polygon_cap, edges) &&
           DP_TILE_RESERVE(&w->tile, w, table.edges.edge, table.edges.edge_cap, edges) &&
           DP_TILE_RESERVE(&w->tile, w, table.edges.from, table.edges.from_cap, edges) &&
           DP_TILE_RESERVE(&w->tile, w, table.edges.key, table.edges.key_cap, edges) &&
           DP_TILE_RESERVE(&w->tile, &w->tile, unsure, unsure_cap,
                           (size_t)w->tile.seen_count + DP_EDGES_ROOM);
}

/* One-rings for each seen triangle. There are about half as many vertices as triangles, or more.
 * The number is halved when the one-rings do not fit the cache. */
static const uint32_t RINGS = DP_TUNED(2, 1);

static bool reserve_rings(dp_finder *w) {
    const uint64_t least = (uint64_t)RINGS * w->tile.seen_count;
    uint32_t bits = 4;
    while (bits < 31 && (uint64_t)1 << bits < least) bits++;
    if ((uint64_t)sizeof(dp_one_ring) << bits > DP_RINGS_FAR) bits--;
    w->rings.shift = 32 - bits;
    return DP_TILE_RESERVE(&w->tile, w, rings.of, rings.cap, (size_t)1 << bits);
}

static bool make_list(dp_finder *w) {
    const dp_polygons *const polygons = &w->tile.frame->polygons;
    dp_edge_list *const list = &w->table.edges;
    size_t corners = 3 * (size_t)w->tile.seen_count;
    if (polygons->firsts) {
        corners = 0;
        for (uint32_t i = 0; i < w->tile.seen_count; i++)
            corners += dp_corner_count(polygons, w->tile.polygons[w->tile.seen[i]].id);
    }
    list->count = w->tile.unsure_count = w->table.flat_edges = 0;
    if (!reserve_list(w, corners + DP_EDGES_ROOM)) return false;
    if (!polygons->firsts && !polygons->edge_flags && !(w->tile.frame->precision > 0)) {
        if (!reserve_rings(w)) return false;
        dp_find_kernels_for(w->tile.frame->lanes)->list_edges(w);
    } else {
        for (uint32_t i = 0; i < w->tile.seen_count; i++)
            if (!(w->tile.frame->precision > 0) ||
                !dp_is_sliver(w->tile.frame, w->tile.polygons[w->tile.seen[i]].id))
                dp_edge_list_polygon(w, w->tile.seen[i]);
    }
    for (uint32_t i = 0; i < DP_EDGES_ROOM; i++)
        list->from[list->count + i] = list->key[list->count + i] = 0;
    return true;
}

/* ------- entering ------- */

/* A hash of the sum of both ends' keys: the same from either end, and independent of the edge's
 * key, which is their xor. */
static inline uint32_t slot_of(uint32_t from, uint32_t key, uint32_t slots) {
    const uint32_t sum = from + (from ^ key);
    return (uint32_t)((uint64_t)(sum * 0x9e3779b1u) * slots >> 32);
}

static inline uint32_t met_at(dp_edge_slot slot) { return (uint32_t)(slot >> 32); }

/* The half-edge that came first to a slot. */
static uint32_t first_of(const dp_finder *w, uint32_t met) {
    return met & DP_SLOT_PAIR ? w->table.pair_first[met & DP_SLOT_NUMBER] : met - 1;
}

static bool is_same_edge(const dp_edge_list *list, uint32_t a, uint32_t b) {
    return list->key[a] == list->key[b] &&
           (list->from[a] == list->from[b] || list->from[a] == (list->from[b] ^ list->key[b]));
}

/* A third or later polygon at an edge. */
static void add_meeting(dp_finder *w, uint32_t slot, uint32_t number) {
    if (!DP_TILE_RESERVE(&w->tile, w, table.meetings, table.meetings_cap,
                         w->table.meeting_count + 1u) ||
        !DP_TILE_RESERVE(&w->tile, w, table.slot_meetings, table.slot_meetings_cap,
                         w->table.slot_count))
        return;
    const uint32_t met = met_at(w->table.slots[slot]);
    w->table.meetings[w->table.meeting_count] = (dp_meeting){
        first_of(w, met), number, met & DP_SLOT_MORE ? w->table.slot_meetings[slot] : 0};
    w->table.slot_meetings[slot] = ++w->table.meeting_count;
    w->table.slots[slot] |= (dp_edge_slot)DP_SLOT_MORE << 32;
}

/* Hides a value from the compiler, so that it does not turn what is computed from it into a
 * branch. */
#define OPAQUE(value) __asm__("" : "+r"(value))

/* At first only these bits of the keys are compared: all of them, or, in the hostile build, so few
 * that most tables must be filled again. */
static const uint32_t COMPARED = DP_TUNED(UINT32_MAX, 15);

/* Does another edge have the slot? */
static inline __attribute__((always_inline)) uint32_t is_other(dp_edge_slot slot, uint32_t key) {
    uint32_t other =
        (uint32_t)(met_at(slot) != 0) & (uint32_t)((((uint32_t)slot ^ key) & COMPARED) != 0);
    OPAQUE(other);
    return other;
}

/* Where the search for an edge begins: at its own slot, or at the next if another edge has that. */
static inline __attribute__((always_inline)) uint32_t
first_slot(const dp_edge_slot *slots, uint32_t count, uint32_t from, uint32_t key) {
    const uint32_t s = slot_of(from, key, count);
    return s + is_other(slots[s], key); /* the last slot is no edge's own, so s + 1 exists */
}

/* From slot s on, the slot of half-edge `number` or a free one. Unless `exact`, it may belong to
 * another edge whose key agrees in the compared bits. */
static inline __attribute__((always_inline)) uint32_t
find_slot(const dp_finder *w, const dp_edge_slot *slots, uint32_t count, uint32_t s,
          uint32_t number, uint32_t key, const bool exact) {
    while (is_other(slots[s], key) ||
           (exact && slots[s] &&
            !is_same_edge(&w->table.edges, first_of(w, met_at(slots[s])), number)))
        s = s == count ? 0 : s + 1;
    return s;
}

enum { AHEAD = 8 };

/* Enters all half-edges of the list. Whether one is the first or the second at its edge cannot be
 * predicted, so both results are computed and one is selected, without a branch. Slots are looked
 * up AHEAD half-edges at a time; what these enter in the meantime, find_slot sees when their turn
 * comes. */
static inline __attribute__((always_inline)) void enter_all(dp_finder *w, const bool exact) {
    const dp_edge_list *const list = &w->table.edges;
    const uint32_t *const starts = list->from, *const keys = list->key, count = list->count,
                          last = w->table.slot_count - 1;
    dp_edge_slot *const slots = w->table.slots;
    uint32_t *const first = w->table.pair_first, *const second = w->table.pair_second, pairs = 0;
    for (uint32_t start = 0; start < count; start += AHEAD) {
        uint32_t look[AHEAD];
        for (uint32_t k = 0; k < AHEAD; k++)
            look[k] = first_slot(slots, last, starts[start + k], keys[start + k]);
        for (uint32_t k = 0; k < AHEAD && start + k < count; k++) {
            const uint32_t i = start + k, key = keys[i];
            const uint32_t at = find_slot(w, slots, last, look[k], i, key, exact),
                           met = met_at(slots[at]);
            if (met & DP_SLOT_PAIR) {
                add_meeting(w, at, i);
                continue;
            }
            uint32_t is_free = !met;
            OPAQUE(is_free);
            first[pairs] = met - 1, second[pairs] = i;
            const uint32_t paired = DP_SLOT_PAIR | pairs,
                           meets = paired ^ ((paired ^ (i + 1)) & (0 - is_free));
            slots[at] = key | (dp_edge_slot)meets << 32;
            pairs += 1 - is_free;
        }
    }
    w->table.pairs = pairs;
}

static bool clear_table(dp_finder *w) {
    const size_t count = w->table.edges.count, slots = count + count / 2 + 64,
                 marks = (count + 8) / 8 * 8;
    if (slots >= UINT32_MAX || !DP_TILE_RESERVE(&w->tile, w, table.slots, table.slots_cap, slots) ||
        !DP_TILE_RESERVE(&w->tile, w, table.marks, table.marks_cap, marks) ||
        !DP_TILE_RESERVE(&w->tile, w, table.pair_first, table.pair_first_cap,
                         count / 2 + DP_EDGES_ROOM) ||
        !DP_TILE_RESERVE(&w->tile, w, table.pair_second, table.pair_second_cap,
                         count / 2 + DP_EDGES_ROOM))
        return false;
    w->table.meeting_count = w->table.pairs = 0;
    w->table.slot_count = (uint32_t)slots;
    memset(w->table.slots, 0, slots * sizeof *w->table.slots);
    memset(w->table.marks, DP_MARK_ALONE, count);
    memset(w->table.marks + count, 0, marks - count);
    return true;
}

/* Is every meeting at its own edge? Meetings are few, so this is checked one by one. */
static bool are_meetings_sound(const dp_finder *w) {
    for (uint32_t i = 0; i < w->table.meeting_count; i++)
        if (!is_same_edge(&w->table.edges, w->table.meetings[i].first, w->table.meetings[i].number))
            return false;
    return true;
}

static bool fill(dp_finder *w, bool exact) {
    if (!clear_table(w)) return !(w->tile.failed = true);
    if (exact)
        enter_all(w, true);
    else
        enter_all(w, false);
    return !w->tile.failed;
}

bool dp_edge_table_list(dp_finder *w) { return make_list(w) || !(w->tile.failed = true); }

bool dp_edge_table_fill(dp_finder *w) {
    if (!fill(w, false)) return false;
    if (!dp_find_kernels_for(w->tile.frame->lanes)->flatten(w) || !are_meetings_sound(w)) {
        if (!fill(w, true)) return false;
        dp_find_kernels_for(w->tile.frame->lanes)->flatten(w);
    }
    w->tile.stats.edges_resolved += w->table.pairs + w->table.flat_edges / 2;
    for (uint32_t i = 0; i < w->table.meeting_count; i++)
        w->table.marks[w->table.meetings[i].first] = DP_MARK_PAIR,
        w->table.marks[w->table.meetings[i].number] = 0;
    if (!w->finds_hidden) dp_find_kernels_for(w->tile.frame->lanes)->unmark_alone(w);
    return true;
}

/* ------- taking ------- */

uint32_t dp_edge_table_next(const dp_finder *w, uint32_t number) {
    while (number < w->table.edges.count) {
        uint64_t word;
        memcpy(&word, w->table.marks + number / 8 * 8, sizeof word);
        if (!word) {
            number = (number / 8 + 1) * 8;
        } else {
            if (w->table.marks[number]) return number;
            number++;
        }
    }
    return UINT32_MAX;
}

dp_edge_entry dp_edge_table_entry(const dp_finder *w, uint32_t number) {
    const dp_edge_list *const list = &w->table.edges;
    const dp_half_edge a = dp_half_edge_of(w, number);
    const uint32_t key = list->key[number], last = w->table.slot_count - 1;
    const uint32_t at =
        find_slot(w, w->table.slots, last,
                  first_slot(w->table.slots, last, list->from[number], key), number, key, true);
    const uint32_t met = met_at(w->table.slots[at]);
    dp_edge_entry out = {.a = a.polygon, .b = UINT32_MAX, .edge_a = a.edge};
    if (!(met & DP_SLOT_PAIR)) return out;
    const uint32_t second = w->table.pair_second[met & DP_SLOT_NUMBER];
    const dp_half_edge b = dp_half_edge_of(w, second);
    out.b = b.polygon, out.edge_b = b.edge;
    out.more = met & DP_SLOT_MORE ? w->table.slot_meetings[at] : 0;
    out.opposed = list->from[second] == (list->from[number] ^ list->key[number]);
    return out;
}

/* ------- memory ------- */

/* A box of normals this small makes no fold. Each normal may be off by DP_ROUGH_ANGLE; half a
 * degree more is for rounding. */
void dp_one_rings_init(dp_one_rings *rings, float flat_cosine) {
    rings->spread = 0;
    if (flat_cosine > 1) return;
    const double angle =
        dp_acos((double)flat_cosine) - (2 * DP_ROUGH_ANGLE + 0.5) * 3.14159265358979323846 / 180;
    const double chord = angle > 0 ? 2 * dp_sin(angle / 2) * DP_RING_ONE : 0;
    rings->spread = (float)(chord * chord);
}

static const dp_array ring_arrays[] = {DP_ARRAY(dp_one_rings, of, cap)};

void dp_one_rings_free(dp_one_rings *rings, const dp_allocator *memory) {
    dp_arrays_free(memory, rings, DP_ARRAYS(ring_arrays));
}

uint64_t dp_one_rings_bytes(const dp_one_rings *rings) {
    return dp_arrays_bytes(rings, DP_ARRAYS(ring_arrays));
}

static const dp_array store_arrays[] = {DP_ARRAY(dp_edge_store, edges.polygon, edges.polygon_cap),
                                        DP_ARRAY(dp_edge_store, edges.edge, edges.edge_cap),
                                        DP_ARRAY(dp_edge_store, edges.from, edges.from_cap),
                                        DP_ARRAY(dp_edge_store, edges.key, edges.key_cap),
                                        DP_ARRAY(dp_edge_store, slots, slots_cap),
                                        DP_ARRAY(dp_edge_store, marks, marks_cap),
                                        DP_ARRAY(dp_edge_store, pair_first, pair_first_cap),
                                        DP_ARRAY(dp_edge_store, pair_second, pair_second_cap),
                                        DP_ARRAY(dp_edge_store, meetings, meetings_cap),
                                        DP_ARRAY(dp_edge_store, slot_meetings, slot_meetings_cap)};

void dp_edge_store_free(dp_edge_store *store, const dp_allocator *memory) {
    dp_arrays_free(memory, store, DP_ARRAYS(store_arrays));
}

uint64_t dp_edge_store_bytes(const dp_edge_store *store) {
    return dp_arrays_bytes(store, DP_ARRAYS(store_arrays));
}
