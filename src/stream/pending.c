/* Triangles carried from chunk to chunk of a stream, and their edges that wait for another
 * triangle.
 *
 * An edge whose two triangles lie in different chunks is found here: by the bits of its ends'
 * positions, as in a tile's table. When they meet and it is plain, both forget it; a triangle
 * without any edge that matters is dropped. What is left at the end is a small mesh with the lines
 * in it, and the ordinary stages draw it.
 *
 * Data structure: triangles in stream order; open addressing over (hash and edge, triangle number)
 * pairs. A slot names a triangle by its number in the stream, which dropping others does not
 * change; it is found by that number. Invariant: every DP_EDGE_ALONE edge of a triangle that was
 * joined has one slot.
 *
 * Memory is bounded. Where a source names the triangles of an edge far apart (in any order, at
 * worst), more may wait than `limit`: those are dropped that lie behind the surface as known so
 * far, and then half of the edges, by their hash, are put off to another reading of the source; and
 * so on. So the lines are the same for any order, and disorder costs time. Only after
 * DP_SHARES_MOST readings are edges given up, the oldest first, and counted. Where lines themselves
 * are too many (a noisy scan whose triangles are far below a pixel), they are thinned: one to a
 * pixel, then one to a square of pixels, as it takes; it is black there already. */
#include "stream/pending.h"

#include "base/sort.h"

#include <string.h>

static const uint32_t FREE = UINT32_MAX, TAKEN_OUT = UINT32_MAX - 1;

void dp_pending_free(dp_pending *kept) {
    if (!kept->memory) return;
    dp_free(kept->memory, kept->triangles);
    dp_free(kept->memory, kept->slots);
    dp_free(kept->memory, kept->earlier);
    dp_free(kept->memory, kept->cells);
    *kept = (dp_pending){0};
}

uint64_t dp_pending_bytes(const dp_pending *kept) {
    return (kept->cap + kept->earlier_cap) * sizeof *kept->triangles +
           kept->slots_cap * sizeof *kept->slots;
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

/* Two bits are left free for the edge's number. */
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

/* The edges of one share have some bits of their hash in common. */
static uint32_t first_slot(const dp_pending *kept, uint32_t hash) {
    return (uint32_t)((uint64_t)(hash * 0x85ebca6bu) * kept->slot_count >> 32);
}

static void put(dp_pending *kept, uint32_t hash, uint32_t number, uint32_t edge) {
    uint32_t s = first_slot(kept, hash);
    while (kept->slots[2 * (size_t)s + 1] != FREE) s = (s + 1) & (kept->slot_count - 1);
    kept->slots[2 * (size_t)s] = hash | edge;
    kept->slots[2 * (size_t)s + 1] = number;
    kept->slots_used++;
}

/* Makes the table anew from the first `count` triangles, with room for `more` edges. */
static bool rebuild(dp_pending *kept, size_t count, size_t more) {
    size_t edges = more;
    for (size_t i = 0; i < count; i++)
        for (int e = 0; e < 3; e++) edges += kept->triangles[i].edges[e] == DP_EDGE_ALONE;
    uint32_t slots = 64;
    while (slots < 2 * edges) slots *= 2;
    if (!dp_reserve(kept->memory, &kept->slots, &kept->slots_cap, 2 * (size_t)slots,
                    sizeof *kept->slots))
        return false;
    memset(kept->slots, 0xff, 2 * (size_t)slots * sizeof *kept->slots);
    kept->slot_count = slots;
    kept->slots_used = 0;
    for (size_t i = 0; i < count; i++)
        for (uint32_t e = 0; e < 3; e++)
            if (kept->triangles[i].edges[e] == DP_EDGE_ALONE)
                put(kept, edge_hash(&kept->triangles[i], e), kept->triangles[i].number, e);
    return true;
}

/* Numbers are spread more or less evenly, so every other step guesses the place from the numbers at
 * both ends; the steps between bisect. */
static dp_pending_triangle *find_number(const dp_pending *kept, uint32_t number) {
    dp_pending_triangle *const all = kept->triangles;
    if (!kept->count || number < all[0].number || number > all[kept->count - 1].number) return NULL;
    size_t lo = 0, hi = kept->count - 1;
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

/* 1: the edges run opposite ways, as they should; -1: the same way; 0: they are different edges. */
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

static bool is_plain(const dp_pending *kept, const dp_pending_triangle *t,
                     const dp_pending_triangle *u) {
    float n[2][4];
    uint8_t state[2];
    const dp_view *const view = kept->view->view;
    return dp_triangle_facing(view, corner(t, 0), corner(t, 1), corner(t, 2), n[0], &state[0]) &&
           dp_triangle_facing(view, corner(u, 0), corner(u, 1), corner(u, 2), n[1], &state[1]) &&
           dp_edge_is_plain(state[0], n[0], state[1], n[1], kept->view->flat_cosine);
}

/* An edge meets the one that waits for it, or waits itself. */
static void join_edge(dp_pending *kept, dp_pending_triangle *t, uint32_t edge, uint32_t hash) {
    for (uint32_t s = first_slot(kept, hash);; s = (s + 1) & (kept->slot_count - 1)) {
        uint32_t *const slot = kept->slots + 2 * (size_t)s;
        if (slot[1] == FREE) break;
        if (slot[1] == TAKEN_OUT || (slot[0] & ~(uint32_t)3) != hash) continue;
        const uint32_t other_edge = slot[0] & 3;
        dp_pending_triangle *const other = find_number(kept, slot[1]);
        const int same = other ? compare_edges(t, edge, other, other_edge) : 0;
        if (!same || other == t) continue;
        const uint8_t found = same > 0 && is_plain(kept, t, other) ? DP_EDGE_PLAIN : DP_EDGE_LINE;
        t->edges[edge] = other->edges[other_edge] = found;
        slot[1] = TAKEN_OUT;
        return;
    }
    put(kept, hash, t->number, edge);
}

static bool matters(const dp_pending_triangle *t) {
    return t->edges[0] | t->edges[1] | t->edges[2];
}

/* Drops what does not matter from triangles [first, count). */
static void drop_plain(dp_pending *kept, size_t first) {
    size_t left = first;
    for (size_t i = first; i < kept->count; i++) {
        if (!matters(&kept->triangles[i])) continue;
        if (i != left) kept->triangles[left] = kept->triangles[i];
        left++;
    }
    kept->count = left;
}

/* Gives up waiting edges from the oldest on, until the triangles left are no more than `most`. */
static void give_up_oldest(dp_pending *kept, size_t most) {
    size_t left = kept->count;
    for (size_t i = 0; i < kept->count && left > most; i++) {
        dp_pending_triangle *const t = &kept->triangles[i];
        for (int e = 0; e < 3; e++) {
            if (t->edges[e] != DP_EDGE_ALONE) continue;
            t->edges[e] = DP_EDGE_PLAIN;
            kept->lost++;
        }
        left -= !matters(t);
    }
}

static void drop_hidden(dp_pending *kept) {
    for (size_t i = 0; i < kept->count; i++) {
        dp_pending_triangle *const t = &kept->triangles[i];
        if (dp_triangle_is_hidden(kept->view, corner(t, 0), corner(t, 1), corner(t, 2)))
            memset(t->edges, DP_EDGE_PLAIN, sizeof t->edges);
    }
    drop_plain(kept, 0);
}

/* Puts half of the edges off to another reading. */
static bool halve_share(dp_pending *kept) {
    const dp_pending_share old = kept->share;
    if (kept->shares == DP_SHARES_MOST) return false;
    kept->share.mask = 2 * old.mask + 1;
    kept->later[kept->later_count++] =
        (dp_pending_share){kept->share.mask, old.value + old.mask + 1};
    kept->shares++;
    for (size_t i = 0; i < kept->count; i++) {
        dp_pending_triangle *const t = &kept->triangles[i];
        for (uint32_t e = 0; e < 3; e++)
            if (t->edges[e] == DP_EDGE_ALONE && !is_of_share(kept->share, edge_hash(t, e)))
                t->edges[e] = DP_EDGE_PLAIN;
    }
    drop_plain(kept, 0);
    return true;
}

static bool has_edge(const dp_pending_triangle *t, uint8_t state) {
    return t->edges[0] == state || t->edges[1] == state || t->edges[2] == state;
}

static size_t count_lines(const dp_pending *kept) {
    size_t count = 0;
    for (size_t i = 0; i < kept->count; i++) count += has_edge(&kept->triangles[i], DP_EDGE_LINE);
    return count;
}

/* The square of 2^shift pixels that holds the edge's middle, the picture's nearest; the same from
 * both sides. */
static size_t cell_of(const dp_pending *kept, const dp_pending_triangle *t, uint32_t edge,
                      int shift) {
    const dp_chunk_view *const v = kept->view;
    const dp_vec3 middle =
        dp_scale(dp_add(dp_v3f(corner(t, edge)), dp_v3f(corner(t, edge + 1))), 0.5);
    const dp_clip_point c = dp_to_clip(v->view, middle);
    if (!(c.w > 0)) return 0;
    const dp_pointd p = dp_to_screen(v->view, c);
    const double w = v->tiles_x * DP_TILE - 1, h = v->tiles_y * DP_TILE - 1;
    const size_t x = (size_t)dp_min(dp_max(p.x, 0), w), y = (size_t)dp_min(dp_max(p.y, 0), h);
    return (y >> shift) * ((size_t)v->tiles_x * DP_TILE >> shift) + (x >> shift);
}

/* What comes late goes first, since what came early may be hidden by it; then the hash decides.
 * Both triangles of an edge give it the same rank, if only they came close enough together. */
static uint32_t rank_of(const dp_pending_triangle *t, uint32_t edge) {
    const uint32_t age = ~(t->number >> 18) & 0x3fff;
    return age << 18 | edge_hash(t, edge) >> 14;
}

enum { THINNING_MOST = 6 };

/* Leaves one line to a square of 1, 2, 4, … px: the first in rank. An edge is left with both its
 * triangles or with neither; those that are not, do not emerge (tiles.c). */
static bool thin(dp_pending *kept) {
    const dp_chunk_view *const v = kept->view;
    const int shift = kept->thinning - 1;
    const size_t cells = (size_t)v->tiles_x * v->tiles_y * DP_TILE * DP_TILE;
    if (!dp_reserve(kept->memory, &kept->cells, &kept->cells_cap, cells, sizeof *kept->cells))
        return false;
    memset(kept->cells, 0xff, cells * sizeof *kept->cells);
    for (int pass = 0; pass < 2; pass++)
        for (size_t i = 0; i < kept->count; i++)
            for (uint32_t e = 0; e < 3; e++) {
                dp_pending_triangle *const t = &kept->triangles[i];
                if (t->edges[e] != DP_EDGE_LINE) continue;
                uint32_t *const first = &kept->cells[cell_of(kept, t, e, shift)];
                const uint32_t rank = rank_of(t, e);
                if (pass == 0 && rank < *first) *first = rank;
                if (pass == 0 || rank == *first) continue;
                t->edges[e] = DP_EDGE_PLAIN;
                kept->thinned++;
            }
    drop_plain(kept, 0);
    return true;
}

/* Until lines take no more than a third of the room. */
static bool thin_lines(dp_pending *kept, size_t room) {
    if (kept->thinning && !thin(kept)) return false;
    while (count_lines(kept) > room / 3 && kept->thinning < THINNING_MOST) {
        kept->thinning++;
        if (!thin(kept)) return false;
    }
    return true;
}

/* Looks at all when many have come since the last time. */
static bool settle(dp_pending *kept) {
    const size_t least = DP_TUNED(4096, 8) + kept->limit / 4;
    const size_t room =
        kept->limit > kept->earlier_count + least ? kept->limit - kept->earlier_count : least;
    if (kept->count <= 2 * kept->settled + DP_TUNED(65536, 4) && kept->count <= room) return true;
    drop_plain(kept, 0);
    if (kept->count > room / 4 * 3) drop_hidden(kept);
    if (kept->count > room / 4 * 3 && count_lines(kept) > room / 2 && !thin_lines(kept, room))
        return false;
    if (kept->count > room / 8 * 7)
        while (kept->count > room / 2 && halve_share(kept)) continue;
    if (kept->count > room / 8 * 7) give_up_oldest(kept, room / 4 * 3);
    drop_plain(kept, 0);
    kept->settled = kept->count;
    return rebuild(kept, kept->count, 0);
}

enum { AHEAD = 16 /* triangles whose slots are prefetched before the first is looked at */ };

static void join_some(dp_pending *kept, dp_pending_triangle *triangles, size_t count) {
    uint32_t hashes[AHEAD][3] = {{0}};
    for (size_t i = 0; i < count; i++)
        for (uint32_t e = 0; e < 3; e++) {
            if (triangles[i].edges[e] != DP_EDGE_ALONE) continue;
            hashes[i][e] = edge_hash(&triangles[i], e);
            __builtin_prefetch(kept->slots + 2 * (size_t)first_slot(kept, hashes[i][e]));
        }
    for (size_t i = 0; i < count; i++)
        for (uint32_t e = 0; e < 3; e++) {
            if (triangles[i].edges[e] != DP_EDGE_ALONE) continue;
            if (is_of_share(kept->share, hashes[i][e]))
                join_edge(kept, &triangles[i], e, hashes[i][e]);
            else
                triangles[i].edges[e] =
                    DP_EDGE_PLAIN; /* put off after this triangle was classified */
        }
}

bool dp_pending_join(dp_pending *kept, size_t first) {
    const size_t edges = 3 * (kept->count - first);
    if (2 * (kept->slots_used + edges) > kept->slot_count && !rebuild(kept, first, edges))
        return false;
    for (size_t i = first; i < kept->count; i += AHEAD)
        join_some(kept, kept->triangles + i, kept->count - i < AHEAD ? kept->count - i : AHEAD);
    drop_plain(kept, first);
    return settle(kept);
}

/* ------- from reading to reading ------- */

static int by_number(const void *left, const void *right) {
    const dp_pending_triangle *const l = left, *const r = right;
    return (l->number > r->number) - (l->number < r->number);
}

/* Each triangle once, with what any reading found. */
static void merge_earlier(dp_pending *kept) {
    size_t left = 0;
    if (!kept->earlier_count) return;
    dp_sort(kept->earlier, kept->earlier_count, sizeof *kept->earlier, by_number);
    for (size_t i = 0; i < kept->earlier_count; i++) {
        const dp_pending_triangle t = kept->earlier[i];
        if (!left || kept->earlier[left - 1].number != t.number) {
            kept->earlier[left++] = t;
            continue;
        }
        for (int e = 0; e < 3; e++)
            if (t.edges[e] != DP_EDGE_PLAIN) kept->earlier[left - 1].edges[e] = t.edges[e];
    }
    kept->earlier_count = left;
}

bool dp_pending_next_share(dp_pending *kept, bool *enough) {
    drop_plain(kept, 0);
    *enough = dp_reserve(kept->memory, &kept->earlier, &kept->earlier_cap,
                         kept->earlier_count + kept->count, sizeof *kept->earlier);
    if (!*enough) return false;
    if (kept->count)
        memcpy(kept->earlier + kept->earlier_count, kept->triangles,
               kept->count * sizeof *kept->triangles);
    kept->earlier_count += kept->count;
    kept->count = kept->settled = 0;
    merge_earlier(kept);
    if (!kept->later_count) return false;
    kept->share = kept->later[--kept->later_count];
    return *enough = rebuild(kept, 0, 0);
}
