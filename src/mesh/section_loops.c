/* Chains a section's segments to closed loops.
 *
 *    sort the ends of all segments by place
 *    join ends that lie at one place: heads with tails; then heads with heads, tails with tails, which
 *        polygons leave that are wound differently
 *    while ends are loose: join each to the nearest one that is nearest to it in turn, if the gap is
 *        small against the chains that it joins
 *    walk: a chain that comes back to where it began is a loop; its direction is that of most of its
 *        length, so that single polygons that are turned do no harm
 *
 * What stays open is no outline of anything (a sheet), and bounds nothing. Data structure: end 2i is
 * the tail of segment i, 2i + 1 its head; `partner` joins two of them, or says NONE. Invariant: a
 * partner's partner is the end itself, so that the sum of windings around a loop is 0. */
#include "base/hostile.h"
#include "base/sort.h"
#include "mesh/section.h"

#include <string.h>

#define NONE UINT32_MAX

/* A gap may be this share of the shorter of the two chains that it joins. */
static const double GAP = 0.1;

/* A search for the nearest loose end looks at so many to either side; rounds of joining. */
enum { LOOK_MOST = DP_TUNED(512, 32), ROUNDS = 24 };

static dp_flat_point place_of(const dp_section_scratch *s, uint32_t end) {
    return s->cuts[end / 2].end[end & 1];
}

static int compare(double a, double b) { return (a > b) - (a < b); }

/* ------- ends at one place ------- */

static int by_place(const void *left, const void *right) {
    const dp_placed_end *const l = left, *const r = right;
    if (l->at.u != r->at.u) return compare(l->at.u, r->at.u);
    if (l->at.v != r->at.v) return compare(l->at.v, r->at.v);
    return (l->end > r->end) - (l->end < r->end);
}

static void join(dp_section_scratch *s, uint32_t a, uint32_t b) {
    s->partner[a] = b, s->partner[b] = a;
}

/* Joins the ends of one place, `ends` of them in order. */
static void join_place(dp_section_scratch *s, const dp_placed_end *ends, size_t count) {
    uint32_t waiting[2] = {NONE, NONE};  /* an earlier tail, and head, that has no partner */
    for (size_t i = 0; i < count; i++) { /* opposite ends */
        const uint32_t end = ends[i].end, other = waiting[~end & 1];
        if (other == NONE) {
            s->partner[end] = waiting[end & 1]; /* a list of those that wait */
            waiting[end & 1] = end;
        } else {
            waiting[~end & 1] = s->partner[other];
            join(s, end, other);
        }
    }
    for (int kind = 0; kind < 2; kind++) /* those that are left are of one kind */
        while (waiting[kind] != NONE) {
            const uint32_t a = waiting[kind], b = s->partner[a];
            waiting[kind] = b == NONE ? NONE : s->partner[b];
            s->partner[a] = NONE;
            if (b != NONE) join(s, a, b);
        }
}

static void join_places(dp_section_scratch *s) {
    const size_t count = 2 * s->cut_count;
    dp_placed_end *const ends = s->ends;
    for (size_t i = 0; i < count; i++)
        ends[i] = (dp_placed_end){place_of(s, (uint32_t)i), (uint32_t)i};
    dp_sort(ends, count, sizeof *ends, by_place);
    for (size_t i = 0, next; i < count; i = next) {
        for (next = i + 1;
             next < count && ends[next].at.u == ends[i].at.u && ends[next].at.v == ends[i].at.v;)
            next++;
        join_place(s, ends + i, next - i);
    }
}

/* ------- gaps ------- */

static double length_of(const dp_section_scratch *s, uint32_t segment) {
    const dp_flat_point a = s->cuts[segment].end[0], b = s->cuts[segment].end[1];
    return dp_hypot(b.u - a.u, b.v - a.v);
}

/* Notes both loose ends of the chain that begins with a loose end. */
static void note_chain(dp_section_scratch *s, uint32_t start) {
    double length = 0;
    uint32_t at = start;
    for (;;) {
        s->seen[at / 2] = 1;
        length += length_of(s, at / 2);
        if (s->partner[at ^ 1] == NONE) break;
        at = s->partner[at ^ 1];
    }
    const dp_flat_point p = place_of(s, start), q = place_of(s, at ^ 1);
    s->loose[s->loose_count++] = (dp_loose_end){p.u, p.v, length, start, at ^ 1};
    s->loose[s->loose_count++] = (dp_loose_end){q.u, q.v, length, at ^ 1, start};
}

static int by_u(const void *left, const void *right) {
    const dp_loose_end *const l = left, *const r = right;
    if (l->u != r->u) return compare(l->u, r->u);
    return (l->end > r->end) - (l->end < r->end);
}

static void list_loose(dp_section_scratch *s) {
    s->loose_count = 0;
    memset(s->seen, 0, s->cut_count);
    for (uint32_t end = 0; end < 2 * s->cut_count; end++)
        if (s->partner[end] == NONE && !s->seen[end / 2]) note_chain(s, end);
    if (s->loose_count) dp_sort(s->loose, s->loose_count, sizeof *s->loose, by_u);
}

/* The squared gap between two loose ends, or INFINITY where it is too wide to be closed. */
static double gap_between(const dp_loose_end *a, const dp_loose_end *b) {
    const double u = a->u - b->u, v = a->v - b->v, square = u * u + v * v,
                 most = GAP * dp_min(a->length, b->length);
    return square <= most * most ? square : INFINITY;
}

/* The loose end that the gap to is the least, or NONE. */
static uint32_t nearest_to(const dp_section_scratch *s, uint32_t i) {
    const dp_loose_end *const own = &s->loose[i];
    double best = INFINITY;
    uint32_t nearest = NONE;
    for (int step = -1; step <= 1; step += 2)
        for (uint32_t k = 1; k <= LOOK_MOST; k++) {
            const size_t at = i + (size_t)(step * (int)k);
            if (at >= s->loose_count) break;
            const double du = s->loose[at].u - own->u, square = du * du;
            if (square > best || square > GAP * GAP * own->length * own->length) break;
            const double gap = gap_between(own, &s->loose[at]);
            if (gap < best) best = gap, nearest = (uint32_t)at;
        }
    return nearest;
}

/* Joins ends that are nearest to each other; returns whether there were any. */
static bool close_gaps(dp_section_scratch *s) {
    bool any = false;
    for (uint32_t i = 0; i < s->loose_count; i++) s->nearest[i] = nearest_to(s, i);
    for (uint32_t i = 0; i < s->loose_count; i++) {
        const uint32_t k = s->nearest[i];
        if (k == NONE || k < i || s->nearest[k] != i) continue;
        join(s, s->loose[i].end, s->loose[k].end);
        any = true;
    }
    return any;
}

/* ------- loops ------- */

static bool add_edge(dp_section_scratch *s, dp_flat_point a, dp_flat_point b,
                     const dp_allocator *memory) {
    const bool up = a.v <= b.v, level = a.v == b.v;
    const dp_flat_point low = up ? a : b, high = up ? b : a;
    if (level && a.u == b.u) return true;
    if (!dp_reserve(memory, &s->edges, &s->edges_cap, s->edge_count + 1, sizeof *s->edges))
        return false;
    s->edges[s->edge_count++] =
        (dp_fill_edge){.u0 = low.u,
                       .v0 = low.v,
                       .u1 = high.u,
                       .v1 = high.v,
                       .slope = level ? 0 : (high.u - low.u) / (high.v - low.v),
                       .winding = up ? -1 : 1};
    return true;
}

/* Is the chain from this end closed? Says how long it is in its segments' own direction, less what
 * runs against it. */
static bool measure_loop(dp_section_scratch *s, uint32_t start, double *along) {
    uint32_t at = start;
    *along = 0;
    do {
        s->seen[at / 2] = 1;
        *along += at & 1 ? -length_of(s, at / 2) : length_of(s, at / 2);
        at = s->partner[at ^ 1];
    } while (at != NONE && at != start);
    return at == start;
}

/* Notes what closes a gap; it is drawn, too, as it bounds a face. */
static bool add_gap(dp_section_scratch *s, dp_flat_point a, dp_flat_point b,
                    const dp_allocator *memory) {
    const size_t at = s->cut_count + s->gap_count;
    if (a.u == b.u && a.v == b.v) return true;
    if (!dp_reserve(memory, &s->cuts, &s->cuts_cap, at + 1, sizeof *s->cuts)) return false;
    s->cuts[at] = (dp_cut_segment){{a, b}, s->cuts[0].group};
    s->gap_count++;
    return true;
}

static bool add_loop(dp_section_scratch *s, uint32_t start, bool turned,
                     const dp_allocator *memory) {
    uint32_t at = start;
    do {
        const uint32_t next = s->partner[at ^ 1];
        const dp_flat_point a = place_of(s, at), b = place_of(s, at ^ 1), c = place_of(s, next);
        if (!add_gap(s, b, c, memory)) return false;
        if (!(turned ? add_edge(s, b, a, memory) && add_edge(s, c, b, memory)
                     : add_edge(s, a, b, memory) && add_edge(s, b, c, memory)))
            return false;
        at = next;
    } while (at != start);
    return true;
}

static bool find_loops(dp_section_scratch *s, const dp_allocator *memory) {
    s->edge_count = s->gap_count = 0;
    list_loose(s); /* marks all open chains as seen */
    for (uint32_t i = 0; i < s->cut_count; i++) {
        double along;
        if (s->seen[i] || !measure_loop(s, 2 * i, &along)) continue;
        if (!add_loop(s, 2 * i, along < 0, memory)) return false;
    }
    s->cut_count += s->gap_count;
    return s->edge_count < NONE;
}

bool dp_section_chain(dp_section_scratch *s, const dp_allocator *memory) {
    const size_t count = s->cut_count;
    s->edge_count = 0;
    if (!count) return true;
    if (count >= NONE / 2 ||
        !dp_reserve(memory, &s->partner, &s->partner_cap, 2 * count, sizeof *s->partner) ||
        !dp_reserve(memory, &s->ends, &s->ends_cap, 2 * count, sizeof *s->ends) ||
        !dp_reserve(memory, &s->seen, &s->seen_cap, count, 1) ||
        !dp_reserve(memory, &s->loose, &s->loose_cap, 2 * count, sizeof *s->loose) ||
        !dp_reserve(memory, &s->nearest, &s->nearest_cap, 2 * count, sizeof *s->nearest))
        return false;
    join_places(s);
    for (int round = 0; round < ROUNDS; round++) {
        list_loose(s);
        if (!close_gaps(s)) break;
    }
    return find_loops(s, memory);
}
