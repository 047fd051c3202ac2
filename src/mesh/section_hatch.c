/* Lines of a section: its outline, and hatching.
 *
 *    outline   each segment once, cut by the other planes; and where another plane bounds the inside,
 *              the part of that border that lies inside
 *    hatch     parallel lines at multiples of their distance from the origin: where each one meets the
 *              loops, sorted along it; a line is drawn between where windings leave 0 and come back
 *
 * Invariant: a line meets a loop as often one way as the other, as an edge is met from its lower end on,
 * and not at its upper one. */
#include "base/elementary.h"
#include "base/sort.h"
#include "mesh/section.h"

/* Lines across one section at most; what is finer is grey. */
static const double LINES = 8192;

static int compare(double a, double b) { return (a > b) - (a < b); }

/* ------- lines inside ------- */

/* A set of parallel lines: `along` is their direction, `across` is at right angles to it; the lines lie
 * at whole multiples of `spacing` plus `offset`. */
typedef struct lines {
    dp_flat_point along, across;
    double spacing, offset;
    dp_edge_kind flag;
    uint32_t except; /* the half plane whose border it is */
} lines;

static double dot(dp_flat_point a, dp_flat_point b) { return a.u * b.u + a.v * b.v; }

static int by_line(const void *left, const void *right) {
    const dp_hatch_crossing *const l = left, *const r = right;
    if (l->line != r->line) return compare(l->line, r->line);
    if (l->at != r->at) return compare(l->at, r->at);
    return (l->winding > r->winding) - (l->winding < r->winding);
}

/* Notes where the lines meet an edge. */
static bool meet(dp_section_scratch *s, const lines *l, const dp_fill_edge *e,
                 const dp_allocator *memory) {
    const dp_flat_point a = {e->u0, e->v0}, b = {e->u1, e->v1};
    const double ya = (dot(a, l->across) - l->offset) / l->spacing,
                 yb = (dot(b, l->across) - l->offset) / l->spacing, xa = dot(a, l->along),
                 xb = dot(b, l->along);
    const double from = ceil(dp_min(ya, yb)), to = ceil(dp_max(ya, yb));
    for (double k = from; k < to; k++) {
        if (!dp_reserve(memory, &s->hatches, &s->hatches_cap, s->hatch_count + 1,
                        sizeof *s->hatches))
            return false;
        const double t = (k - ya) / (yb - ya);
        s->hatches[s->hatch_count++] =
            (dp_hatch_crossing){k, xa + (xb - xa) * t, ya < yb ? e->winding : -e->winding};
    }
    return true;
}

static bool put(const lines *l, double line, double from, double to, const dp_section_sink *sink) {
    const double y = line * l->spacing + l->offset;
    dp_flat_point a = {l->along.u * from + l->across.u * y, l->along.v * from + l->across.v * y},
                  b = {l->along.u * to + l->across.u * y, l->along.v * to + l->across.v * y};
    return !dp_section_cut_line(sink, l->except, &a, &b) || sink->line(sink->user, a, b, l->flag);
}

static bool put_inside(dp_section_scratch *s, const lines *l, const dp_section_sink *sink,
                       const dp_allocator *memory) {
    s->hatch_count = 0;
    for (size_t i = 0; i < s->edge_count; i++)
        if (!meet(s, l, &s->edges[i], memory)) return false;
    if (!s->hatch_count) return true;
    dp_sort(s->hatches, s->hatch_count, sizeof *s->hatches, by_line);
    int32_t winding = 0;
    double from = 0;
    for (size_t i = 0; i < s->hatch_count; i++) {
        const dp_hatch_crossing *const c = &s->hatches[i];
        const int32_t before = i && s->hatches[i - 1].line == c->line ? winding : 0;
        winding = before + c->winding;
        if (!before) from = c->at;
        if (before && !winding && from < c->at && !put(l, c->line, from, c->at, sink)) return false;
    }
    return true;
}

/* ------- hatching ------- */

/* So far apart that there are not more lines than LINES. */
static double spacing_of(const dp_section_scratch *s, const dp_hatching *hatching) {
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (size_t i = 0; i < s->edge_count; i++) {
        const dp_fill_edge *const e = &s->edges[i];
        low[0] = dp_min(low[0], dp_min(e->u0, e->u1)), low[1] = dp_min(low[1], e->v0);
        high[0] = dp_max(high[0], dp_max(e->u0, e->u1)), high[1] = dp_max(high[1], e->v1);
    }
    return dp_max(hatching->spacing, dp_hypot(high[0] - low[0], high[1] - low[1]) / LINES);
}

bool dp_section_hatch(dp_section_scratch *s, const dp_hatching *hatching,
                      const dp_section_sink *sink, const dp_allocator *memory) {
    const double x = dp_cos(hatching->angle), y = dp_sin(hatching->angle);
    lines l = {.along = {x, y},
               .across = {-y, x},
               .spacing = s->edge_count ? spacing_of(s, hatching) : 1,
               .flag = DP_EDGE_HATCHING,
               .except = DP_CLIP_PLANES};
    if (!put_inside(s, &l, sink, memory)) return false;
    l.along = (dp_flat_point){-y, x}, l.across = (dp_flat_point){-x, -y};
    return hatching->look != DP_SECTION_CROSSED || put_inside(s, &l, sink, memory);
}

/* ------- outlines ------- */

/* Ends in one order, whichever way the segment runs. */
static dp_cut_segment ordered(const dp_cut_segment *s) {
    const dp_flat_point a = s->end[0], b = s->end[1];
    const bool turned = a.u != b.u ? a.u > b.u : a.v > b.v;
    return turned ? (dp_cut_segment){{b, a}, s->group} : *s;
}

static int by_ends(const void *left, const void *right) {
    const dp_cut_segment l = ordered(left), r = ordered(right);
    for (int i = 0; i < 2; i++) {
        if (l.end[i].u != r.end[i].u) return compare(l.end[i].u, r.end[i].u);
        if (l.end[i].v != r.end[i].v) return compare(l.end[i].v, r.end[i].v);
    }
    return 0;
}

static bool put_border(dp_section_scratch *s, const dp_section_sink *sink, uint32_t i,
                       const dp_allocator *memory) {
    const dp_half_plane *const h = &sink->halves[i];
    const double length = dp_hypot(h->a, h->b);
    if (!(length > 0)) return true; /* a parallel plane */
    const dp_flat_point across = {h->a / length, h->b / length};
    double reach = 1;
    for (size_t k = 0; k < s->edge_count; k++)
        reach = dp_max(reach, fabs(s->edges[k].u0) + fabs(s->edges[k].u1) + fabs(s->edges[k].v0) +
                                  fabs(s->edges[k].v1) + fabs(h->c) / length);
    const lines border = {.along = {across.v, -across.u},
                          .across = across,
                          .spacing = 4 * reach, /* only line 0 is met */
                          .offset = h->c / length,
                          .flag = DP_EDGE_SECTION,
                          .except = i};
    return put_inside(s, &border, sink, memory);
}

/* Sorts the segments. */
bool dp_section_outline(dp_section_scratch *s, const dp_section_sink *sink,
                        const dp_allocator *memory) {
    if (s->cut_count) dp_sort(s->cuts, s->cut_count, sizeof *s->cuts, by_ends);
    for (size_t i = 0; i < s->cut_count; i++) {
        dp_flat_point a = s->cuts[i].end[0], b = s->cuts[i].end[1];
        if (i && !by_ends(&s->cuts[i - 1], &s->cuts[i])) continue;
        if (dp_section_cut_line(sink, DP_CLIP_PLANES, &a, &b) &&
            !sink->line(sink->user, a, b, DP_EDGE_SECTION))
            return false;
    }
    for (uint32_t i = 0; i < sink->half_count; i++)
        if (sink->outlined >> i & 1 && !put_border(s, sink, i, memory)) return false;
    return true;
}
