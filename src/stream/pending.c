/* Triangles carried from chunk to chunk of a stream, and their edges that wait for another
 * triangle.
 *
 *     for each new triangle, each edge that is alone:
 *         of another share              -> plain: put off to a later reading
 *         a partner waits               -> plain, or a line for both
 *         otherwise                     -> waits
 *     drop triangles whose edges are all plain
 *     if there are too many:            settle
 *         drop those behind the surface drawn so far
 *         thin the lines, if they are most
 *         put half of the edges, by hash, off to another reading, as often as needed
 *         give up the oldest edges      only after DP_SHARES_MOST readings; counted
 *
 * What is left at the end is a small mesh that holds all lines; the ordinary stages draw it. A
 * source whose triangles come in any order gives the same lines, in more readings. Thinning leaves
 * one line to a pixel, then to a square of pixels (a noisy scan, with triangles far below a pixel,
 * is black there already).
 *
 * Data structure: triangles in stream order; open addressing over (hash and edge, triangle number)
 * pairs. A slot holds a triangle's number in the stream, as its index changes when others are
 * dropped. Invariant: every DP_EDGE_ALONE edge of a joined triangle has exactly one slot. */
#include "stream/pending.h"

#include "base/sort.h"

#include <string.h>

static const uint32_t FREE = UINT32_MAX, TAKEN_OUT = UINT32_MAX - 1;

static const dp_array arrays[] = {
    DP_ARRAY(dp_pending, triangles, cap), DP_ARRAY(dp_pending, earlier, earlier_cap),
    DP_ARRAY(dp_pending, slots, slots_cap), DP_ARRAY(dp_pending, cells, cells_cap)};

void dp_pending_free(dp_pending *kept) {
    if (!kept->memory) return;
    dp_arrays_free(kept->memory, kept, DP_ARRAYS(arrays));
    *kept = (dp_pending){0};
}

uint64_t dp_pending_bytes(const dp_pending *kept) {
    return dp_arrays_bytes(kept, DP_ARRAYS(arrays));
}

static const float *corner(const dp_pending_triangle *t, uint32_t i) {
    return t->corners + 3 * (i % 3);
}

static uint32_t position_hash(const float *p) {
    uint32_t b[3];
    memcpy(b, p, sizeof b);
    const uint64_t h = ((uint64_t)b[0] * 0x9e3779b97f4a7c15u) ^
                       ((uint64_t)b[1] * 0xc2b2ae3d27d4eb4fu) ^
                       ((uint64_t)b[2] * 0x165667b19e3779f9u);
    return (uint32_t)((h * 0xff51afd7ed558ccdu) >> 32);
}

/* The two lowest bits are left free for the edge's number. */
uint32_t dp_edge_hash_bits(const float *p, const float *q) {
    const uint32_t sum = position_hash(p) + position_hash(q);
    return (sum ^ sum >> 15) * 0x9e3779b1u & ~(uint32_t)3;
}

static uint32_t edge_hash(const dp_pending_triangle *t, uint32_t edge) {
    return dp_edge_hash_bits(corner(t, edge), corner(t, edge + 1));
}

static bool is_of_share(dp_pending_share share, uint32_t hash) {
    return (hash >> 20 & share.mask) == share.value;
}

bool dp_pending_follows(dp_pending_share share, const dp_pending_triangle *triangle,
                        uint32_t edge) {
    return !share.mask || is_of_share(share, edge_hash(triangle, edge));
}

/* Hashes again, as the edges of one share have some bits of their hash in common. */
static uint32_t first_slot(const dp_pending *pending, uint32_t hash) {
    return (uint32_t)((uint64_t)(hash * 0x85ebca6bu) * pending->slot_count >> 32);
}

static void put(dp_pending *pending, uint32_t hash, uint32_t number, uint32_t edge) {
    uint32_t s = first_slot(pending, hash);
    while (pending->slots[2 * (size_t)s + 1] != FREE) s = (s + 1) & (pending->slot_count - 1);
    pending->slots[2 * (size_t)s] = hash | edge;
    pending->slots[2 * (size_t)s + 1] = number;
    pending->slots_used++;
}

/* Builds the table from the first `count` triangles, with room for `more` edges. */
static bool rebuild(dp_pending *pending, size_t count, size_t more) {
    size_t edges = more;
    for (size_t i = 0; i < count; i++)
        for (int e = 0; e < 3; e++) edges += pending->triangles[i].edges[e] == DP_EDGE_ALONE;
    uint32_t slots = 64;
    while (slots < 2 * edges) slots *= 2;
    if (!dp_reserve(pending->memory, &pending->slots, &pending->slots_cap, 2 * (size_t)slots,
                    sizeof *pending->slots))
        return false;
    memset(pending->slots, 0xff, 2 * (size_t)slots * sizeof *pending->slots);
    pending->slot_count = slots;
    pending->slots_used = 0;
    for (size_t i = 0; i < count; i++)
        for (uint32_t e = 0; e < 3; e++)
            if (pending->triangles[i].edges[e] == DP_EDGE_ALONE)
                put(pending, edge_hash(&pending->triangles[i], e), pending->triangles[i].number, e);
    return true;
}

/* Interpolation search (numbers are spread evenly, about), with every other step a bisection. */
static dp_pending_triangle *find_number(const dp_pending *pending, uint32_t number) {
    dp_pending_triangle *const all = pending->triangles;
    if (!pending->count || number < all[0].number || number > all[pending->count - 1].number)
        return NULL;
    size_t lo = 0, hi = pending->count - 1;
    for (bool guess = true; lo < hi; guess = !guess) {
        const uint64_t span = all[hi].number - all[lo].number, ahead = number - all[lo].number;
        const size_t mid = guess ? lo + (size_t)((double)(hi - lo) * (double)ahead / (double)span)
                                 : lo + (hi - lo) / 2;
        if (all[mid].number == number) return &all[mid];
        if (all[mid].number < number)
            lo = mid + 1;
        else if (mid == lo)
            return NULL;
        else
            hi = mid - 1;
        if (lo > hi || number < all[lo].number || number > all[hi].number) return NULL;
    }
    return all[lo].number == number ? &all[lo] : NULL;
}

/* 1: one edge in opposite directions, as it should be; -1: in the same direction; 0: two edges. */
static int compare_edges(const dp_pending_triangle *t, uint32_t e, const dp_pending_triangle *u,
                         uint32_t f) {
    const size_t size = 3 * sizeof(float);
    if (!memcmp(corner(t, e), corner(u, f + 1), size) &&
        !memcmp(corner(t, e + 1), corner(u, f), size))
        return 1;
    if (!memcmp(corner(t, e), corner(u, f), size) &&
        !memcmp(corner(t, e + 1), corner(u, f + 1), size))
        return -1;
    return 0;
}

static bool is_plain(const dp_pending *pending, const dp_pending_triangle *t,
                     const dp_pending_triangle *u) {
    float n[2][4];
    uint8_t state[2];
    const dp_view *const view = pending->view->view;
    return dp_triangle_facing(view, corner(t, 0), corner(t, 1), corner(t, 2), n[0], &state[0]) &&
           dp_triangle_facing(view, corner(u, 0), corner(u, 1), corner(u, 2), n[1], &state[1]) &&
           dp_edge_is_plain(state[0], n[0], state[1], n[1], pending->view->flat_cosine);
}

/* Joins an edge to the one that waits for it, or lets it wait. */
static void join_edge(dp_pending *pending, dp_pending_triangle *t, uint32_t edge, uint32_t hash) {
    for (uint32_t s = first_slot(pending, hash);; s = (s + 1) & (pending->slot_count - 1)) {
        uint32_t *const slot = pending->slots + 2 * (size_t)s;
        if (slot[1] == FREE) break;
        if (slot[1] == TAKEN_OUT || (slot[0] & ~(uint32_t)3) != hash) continue;
        const uint32_t other_edge = slot[0] & 3;
        dp_pending_triangle *const other = find_number(pending, slot[1]);
        const int same = other ? compare_edges(t, edge, other, other_edge) : 0;
        if (!same || other == t) continue;
        const uint8_t found =
            same > 0 && is_plain(pending, t, other) ? DP_EDGE_PLAIN : DP_EDGE_LINE;
        t->edges[edge] = other->edges[other_edge] = found;
        slot[1] = TAKEN_OUT;
        return;
    }
    put(pending, hash, t->number, edge);
}

static bool matters(const dp_pending_triangle *t) {
    return t->edges[0] | t->edges[1] | t->edges[2];
}

/* Drops triangles from [first, count) whose edges are all plain. */
static void drop_plain(dp_pending *pending, size_t first) {
    size_t left = first;
    for (size_t i = first; i < pending->count; i++) {
        if (!matters(&pending->triangles[i])) continue;
        if (i != left) pending->triangles[left] = pending->triangles[i];
        left++;
    }
    pending->count = left;
}

/* Gives up waiting edges, the oldest first, until at most `most` triangles are left. */
static void give_up_oldest(dp_pending *pending, size_t most) {
    size_t left = pending->count;
    for (size_t i = 0; i < pending->count && left > most; i++) {
        dp_pending_triangle *const t = &pending->triangles[i];
        for (int e = 0; e < 3; e++) {
            if (t->edges[e] != DP_EDGE_ALONE) continue;
            t->edges[e] = DP_EDGE_PLAIN;
            pending->lost++;
        }
        left -= !matters(t);
    }
}

static void drop_hidden(dp_pending *pending) {
    for (size_t i = 0; i < pending->count; i++) {
        dp_pending_triangle *const t = &pending->triangles[i];
        if (dp_triangle_is_hidden(pending->view, corner(t, 0), corner(t, 1), corner(t, 2)))
            memset(t->edges, DP_EDGE_PLAIN, sizeof t->edges);
    }
    drop_plain(pending, 0);
}

/* Puts half of the waiting edges off to another reading; false if there are too many readings. */
static bool halve_share(dp_pending *pending) {
    const dp_pending_share old = pending->share;
    if (pending->shares == DP_SHARES_MOST) return false;
    pending->share.mask = 2 * old.mask + 1;
    pending->later[pending->later_count++] =
        (dp_pending_share){pending->share.mask, old.value + old.mask + 1};
    pending->shares++;
    for (size_t i = 0; i < pending->count; i++) {
        dp_pending_triangle *const t = &pending->triangles[i];
        for (uint32_t e = 0; e < 3; e++)
            if (t->edges[e] == DP_EDGE_ALONE && !is_of_share(pending->share, edge_hash(t, e)))
                t->edges[e] = DP_EDGE_PLAIN;
    }
    drop_plain(pending, 0);
    return true;
}

static bool has_edge(const dp_pending_triangle *t, uint8_t state) {
    return t->edges[0] == state || t->edges[1] == state || t->edges[2] == state;
}

static size_t count_lines(const dp_pending *pending) {
    size_t count = 0;
    for (size_t i = 0; i < pending->count; i++)
        count += has_edge(&pending->triangles[i], DP_EDGE_LINE);
    return count;
}

/* The square of 2^shift pixels that holds the edge's middle, clamped to the picture; the same from
 * both sides. */
static size_t cell_of(const dp_pending *pending, const dp_pending_triangle *t, uint32_t edge,
                      int shift) {
    const dp_chunk_view *const v = pending->view;
    const dp_vec3 middle =
        dp_scale(dp_add(dp_v3f(corner(t, edge)), dp_v3f(corner(t, edge + 1))), 0.5);
    const dp_clip_point c = dp_to_clip(v->view, middle);
    if (!(c.w > 0)) return 0;
    const dp_pointd p = dp_to_screen(v->view, c);
    const double w = v->tiles_x * DP_TILE - 1, h = v->tiles_y * DP_TILE - 1;
    const size_t x = (size_t)dp_min(dp_max(p.x, 0), w), y = (size_t)dp_min(dp_max(p.y, 0), h);
    return (y >> shift) * ((size_t)v->tiles_x * DP_TILE >> shift) + (x >> shift);
}

/* Late triangles rank first, as they may hide early ones; then the hash decides. Both triangles of
 * an edge give it the same rank if they came close enough together. */
static uint32_t rank_of(const dp_pending_triangle *t, uint32_t edge) {
    const uint32_t age = ~(t->number >> 18) & 0x3fff;
    return age << 18 | edge_hash(t, edge) >> 14;
}

enum { THINNING_MOST = 6 };

/* Leaves one line to a square of 1, 2, 4, … px: the first in rank, with both of its triangles as a
 * rule. An edge left with only one of them does not emerge (tiles.c). */
static bool thin(dp_pending *pending) {
    const dp_chunk_view *const v = pending->view;
    const int shift = pending->thinning - 1;
    const size_t cells = (size_t)v->tiles_x * v->tiles_y * DP_TILE * DP_TILE;
    if (!dp_reserve(pending->memory, &pending->cells, &pending->cells_cap, cells,
                    sizeof *pending->cells))
        return false;
    memset(pending->cells, 0xff, cells * sizeof *pending->cells);
    for (int pass = 0; pass < 2; pass++)
        for (size_t i = 0; i < pending->count; i++)
            for (uint32_t e = 0; e < 3; e++) {
                dp_pending_triangle *const t = &pending->triangles[i];
                if (t->edges[e] != DP_EDGE_LINE) continue;
                uint32_t *const first = &pending->cells[cell_of(pending, t, e, shift)];
                const uint32_t rank = rank_of(t, e);
                if (pass == 0 && rank < *first) *first = rank;
                if (pass == 0 || rank == *first) continue;
                t->edges[e] = DP_EDGE_PLAIN;
                pending->thinned++;
            }
    drop_plain(pending, 0);
    return true;
}

/* Thins until lines take at most a third of the room. */
static bool thin_lines(dp_pending *pending, size_t room) {
    if (pending->thinning && !thin(pending)) return false;
    while (count_lines(pending) > room / 3 && pending->thinning < THINNING_MOST) {
        pending->thinning++;
        if (!thin(pending)) return false;
    }
    return true;
}

/* Makes room, when many triangles have come since the last time. */
static bool settle(dp_pending *pending) {
    const size_t least = DP_TUNED(4096, 8) + pending->limit / 4;
    const size_t room = pending->limit > pending->earlier_count + least
                            ? pending->limit - pending->earlier_count
                            : least;
    if (pending->count <= 2 * pending->settled + DP_TUNED(65536, 4) && pending->count <= room)
        return true;
    drop_plain(pending, 0);
    if (pending->count > room / 4 * 3) drop_hidden(pending);
    if (pending->count > room / 4 * 3 && count_lines(pending) > room / 2 &&
        !thin_lines(pending, room))
        return false;
    if (pending->count > room / 8 * 7)
        while (pending->count > room / 2 && halve_share(pending)) continue;
    if (pending->count > room / 8 * 7) give_up_oldest(pending, room / 4 * 3);
    drop_plain(pending, 0);
    pending->settled = pending->count;
    return rebuild(pending, pending->count, 0);
}

enum { AHEAD = 16 }; /* triangles whose slots are prefetched before the first is joined */

static void join_some(dp_pending *pending, dp_pending_triangle *triangles, size_t count) {
    uint32_t hashes[AHEAD][3] = {{0}};
    for (size_t i = 0; i < count; i++)
        for (uint32_t e = 0; e < 3; e++) {
            if (triangles[i].edges[e] != DP_EDGE_ALONE) continue;
            hashes[i][e] = edge_hash(&triangles[i], e);
            __builtin_prefetch(pending->slots + 2 * (size_t)first_slot(pending, hashes[i][e]));
        }
    for (size_t i = 0; i < count; i++)
        for (uint32_t e = 0; e < 3; e++) {
            if (triangles[i].edges[e] != DP_EDGE_ALONE) continue;
            if (is_of_share(pending->share, hashes[i][e]))
                join_edge(pending, &triangles[i], e, hashes[i][e]);
            else
                triangles[i].edges[e] =
                    DP_EDGE_PLAIN; /* put off after this triangle was classified */
        }
}

bool dp_pending_join(dp_pending *pending, size_t first) {
    const size_t edges = 3 * (pending->count - first);
    if (2 * (pending->slots_used + edges) > pending->slot_count && !rebuild(pending, first, edges))
        return false;
    for (size_t i = first; i < pending->count; i += AHEAD)
        join_some(pending, pending->triangles + i,
                  pending->count - i < AHEAD ? pending->count - i : AHEAD);
    drop_plain(pending, first);
    return settle(pending);
}

/* ------- from reading to reading ------- */

static int by_number(const void *left, const void *right) {
    const dp_pending_triangle *const l = left, *const r = right;
    return (l->number > r->number) - (l->number < r->number);
}

/* Merges what readings found: each triangle once. */
static void merge_earlier(dp_pending *pending) {
    size_t left = 0;
    if (!pending->earlier_count) return;
    dp_sort(pending->earlier, pending->earlier_count, sizeof *pending->earlier, by_number);
    for (size_t i = 0; i < pending->earlier_count; i++) {
        const dp_pending_triangle t = pending->earlier[i];
        if (!left || pending->earlier[left - 1].number != t.number) {
            pending->earlier[left++] = t;
            continue;
        }
        for (int e = 0; e < 3; e++)
            if (t.edges[e] != DP_EDGE_PLAIN) pending->earlier[left - 1].edges[e] = t.edges[e];
    }
    pending->earlier_count = left;
}

bool dp_pending_next_share(dp_pending *pending, bool *enough) {
    drop_plain(pending, 0);
    *enough = dp_reserve(pending->memory, &pending->earlier, &pending->earlier_cap,
                         pending->earlier_count + pending->count, sizeof *pending->earlier);
    if (!*enough) return false;
    if (pending->count)
        memcpy(pending->earlier + pending->earlier_count, pending->triangles,
               pending->count * sizeof *pending->triangles);
    pending->earlier_count += pending->count;
    pending->count = pending->settled = 0;
    merge_earlier(pending);
    if (!pending->later_count) return false;
    pending->share = pending->later[--pending->later_count];
    return *enough = rebuild(pending, 0, 0);
}
