/* One group's part of a section: chained, filled, outlined and hatched. What the steps have in common
 * is here, and the memory of all.
 *
 *    chain     cut segments → edges of closed loops                          section_loops.c
 *    fill      edges → trapezoids of the inside, cut by the other planes     section_fill.c
 *    outline   segments, each once; where another plane bounds the inside    section_hatch.c
 *    hatch     parallel lines inside                                         section_hatch.c
 *
 * Invariant: all of it is computed from the segments' ends in double precision, in the order in which
 * they came, so that every reading gives the same bits. */
#include "mesh/section.h"

static const dp_array arrays[] = {DP_ARRAY(dp_section_scratch, cuts, cuts_cap),
                                  DP_ARRAY(dp_section_scratch, ends, ends_cap),
                                  DP_ARRAY(dp_section_scratch, partner, partner_cap),
                                  DP_ARRAY(dp_section_scratch, seen, seen_cap),
                                  DP_ARRAY(dp_section_scratch, loose, loose_cap),
                                  DP_ARRAY(dp_section_scratch, nearest, nearest_cap),
                                  DP_ARRAY(dp_section_scratch, edges, edges_cap),
                                  DP_ARRAY(dp_section_scratch, events, events_cap),
                                  DP_ARRAY(dp_section_scratch, crossings, crossings_cap),
                                  DP_ARRAY(dp_section_scratch, active, active_cap),
                                  DP_ARRAY(dp_section_scratch, hatches, hatches_cap)};

void dp_section_scratch_free(dp_section_scratch *scratch, const dp_allocator *memory) {
    dp_arrays_free(memory, scratch, DP_ARRAYS(arrays));
    *scratch = (dp_section_scratch){0};
}

/* How far a point lies beyond the border of a half plane. */
static double beyond(const dp_half_plane *h, dp_flat_point p) {
    return h->a * p.u + h->b * p.v - h->c;
}

static dp_flat_point mix(dp_flat_point a, dp_flat_point b, double t) {
    return (dp_flat_point){a.u + (b.u - a.u) * t, a.v + (b.v - a.v) * t};
}

bool dp_section_cut_line(const dp_section_sink *sink, uint32_t except, dp_flat_point *a,
                         dp_flat_point *b) {
    double t0 = 0, t1 = 1;
    for (uint32_t i = 0; i < sink->half_count; i++) {
        if (i == except) continue;
        const double p = beyond(&sink->halves[i], *a), q = beyond(&sink->halves[i], *b);
        if (p > 0 && q > 0) return false;
        if (p > 0) t0 = dp_max(t0, p / (p - q));
        if (q > 0) t1 = dp_min(t1, p / (p - q));
    }
    if (!(t0 < t1)) return false;
    const dp_flat_point from = *a, to = *b;
    if (t0 > 0) *a = mix(from, to, t0);
    if (t1 < 1) *b = mix(from, to, t1);
    return a->u != b->u || a->v != b->v;
}

bool dp_section_make(dp_section_scratch *s, const dp_cut_segment *segments, size_t count,
                     const dp_hatching *hatching, const dp_section_sink *sink,
                     const dp_allocator *memory) {
    if (!dp_reserve(memory, &s->cuts, &s->cuts_cap, count, sizeof *s->cuts)) return false;
    s->cut_count = 0;
    for (size_t i = 0; i < count; i++) s->cuts[s->cut_count++] = segments[i];
    if (!dp_section_chain(s, memory)) return false;
    if (hatching->look != DP_SECTION_OPEN && !dp_section_fill(s, sink, memory)) return false;
    if (!dp_section_outline(s, sink, memory)) return false;
    return hatching->look > DP_SECTION_CROSSED || dp_section_hatch(s, hatching, sink, memory);
}
