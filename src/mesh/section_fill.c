/* Fills a section: the inside of its loops as trapezoids, by a sweep.
 *
 *    for each v at which an edge begins, ends or crosses its neighbour, from below
 *        take edges that end out of the active ones, exchange those that cross, put new ones in
 *        where that changed something: count windings from left to right; where they leave 0 and come
 *            back to 0 an edge and the next such one bound the inside: a trapezoid goes on between the
 *            same two, ends where they are others, and begins where there was none
 *
 * Active edges are sorted from left to right. Rounding may sort two wrongly that all but touch; then a
 * sliver is filled that should not be, or is not. It cannot do more: windings are counted anew from the
 * order that there is; those beyond the change stay, as what a loop takes away at a v it also adds;
 * and two edges are exchanged once at most, as which of them is left at the end of the shorter one does
 * not depend on the order. Where there are more crossings than CROSSINGS per edge the rest is filled as
 * if there were none. */
#include "base/sort.h"
#include "mesh/section.h"

#define NONE UINT32_MAX

/* Crossings that are found, beside so many for each edge: enough for parts that overlap; a model of
 * thousands of needles through each other has millions. */
static const uint64_t CROSSINGS = 1 << 18, CROSSINGS_PER_EDGE = 64;

typedef struct sweep {
    dp_section_scratch *s;
    const dp_section_sink *sink;
    const dp_allocator *memory;
    double v;
    uint32_t low, high; /* active edges that changed, low > high: none */
    bool bounds_change; /* an edge that bounded the inside does so no more, or another does */
    bool failed;        /* memory is out */
} sweep;

static double at(const dp_fill_edge *e, double v) {
    return v <= e->v0 ? e->u0 : v >= e->v1 ? e->u1 : e->u0 + (v - e->v0) * e->slope;
}

/* ------- faces ------- */

/* Room for the corners of a trapezoid cut by all other planes. */
enum { CORNERS = 4 + DP_CLIP_PLANES };

/* Clips a convex polygon by a half plane (Sutherland and Hodgman 1974). */
static uint32_t clip(const dp_half_plane *h, const dp_flat_point *p, uint32_t n,
                     dp_flat_point *out) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < n; i++) {
        const dp_flat_point a = p[i], b = p[i + 1 == n ? 0 : i + 1];
        const double da = h->a * a.u + h->b * a.v - h->c, db = h->a * b.u + h->b * b.v - h->c;
        if (da <= 0) out[count++] = a;
        if ((da <= 0) == (db <= 0)) continue;
        const double t = da / (da - db);
        out[count++] = (dp_flat_point){a.u + (b.u - a.u) * t, a.v + (b.v - a.v) * t};
    }
    return count;
}

/* Hands over the trapezoid that edge `e` began, up to v. */
static void end_trapezoid(sweep *w, dp_fill_edge *e, double v) {
    const dp_fill_edge *const r = &w->s->edges[e->right];
    const double v0 = e->since, l0 = at(e, v0), r0 = dp_max(l0, at(r, v0)), l1 = at(e, v),
                 r1 = dp_max(l1, at(r, v));
    e->begun = false;
    if (!(v > v0) || (l0 == r0 && l1 == r1)) return;
    dp_flat_point points[2][CORNERS] = {{{l0, v0}}};
    uint32_t n = 1, now = 0;
    if (r0 > l0) points[0][n++] = (dp_flat_point){r0, v0};
    points[0][n++] = (dp_flat_point){r1, v};
    if (r1 > l1) points[0][n++] = (dp_flat_point){l1, v};
    for (uint32_t i = 0; i < w->sink->half_count; i++, now ^= 1)
        n = clip(&w->sink->halves[i], points[now], n, points[now ^ 1]);
    if (n > 2 && !w->sink->face(w->sink->user, points[now], n)) w->failed = true;
}

/* ------- active edges ------- */

static void changed(sweep *w, uint32_t place) {
    if (w->low > w->high) w->low = w->high = place;
    if (place < w->low) w->low = place;
    if (place > w->high) w->high = place;
}

static void renumber(sweep *w, uint32_t from) {
    for (uint32_t i = from; i < w->s->active_count; i++) w->s->edges[w->s->active[i]].place = i;
}

static void take_out(sweep *w, uint32_t edge) {
    dp_section_scratch *const s = w->s;
    dp_fill_edge *const e = &s->edges[edge];
    w->bounds_change |= e->begun || e->ends;
    if (e->begun) end_trapezoid(w, e, w->v);
    s->active_count--;
    for (uint32_t i = e->place; i < s->active_count; i++) {
        s->active[i] = s->active[i + 1];
        s->edges[s->active[i]].place = i;
    }
    if (w->low <= w->high) {
        w->low -= w->low > e->place;
        w->high -= w->high > e->place;
    }
    changed(w, e->place);
}

/* Does the new edge belong to the right of an active one? */
static bool is_right_of(const sweep *w, const dp_fill_edge *e, const dp_fill_edge *active) {
    const double u = at(active, w->v);
    return e->u0 != u ? e->u0 > u : e->slope > active->slope;
}

static void put_in(sweep *w, uint32_t edge) {
    dp_section_scratch *const s = w->s;
    uint32_t low = 0, high = (uint32_t)s->active_count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (is_right_of(w, &s->edges[edge], &s->edges[s->active[middle]]))
            low = middle + 1;
        else
            high = middle;
    }
    for (size_t i = s->active_count; i > low; i--) s->active[i] = s->active[i - 1];
    s->active[low] = edge;
    s->active_count++;
    renumber(w, low);
    if (w->low <= w->high) {
        w->low += w->low >= low;
        w->high += w->high >= low;
    }
    changed(w, low);
}

/* ------- crossings ------- */

static bool comes_first(const dp_fill_crossing *a, const dp_fill_crossing *b) {
    if (a->v != b->v) return a->v < b->v;
    return a->left != b->left ? a->left < b->left : a->right < b->right;
}

static void push_crossing(sweep *w, dp_fill_crossing c) {
    dp_section_scratch *const s = w->s;
    if (!dp_reserve(w->memory, &s->crossings, &s->crossings_cap, s->crossing_count + 1,
                    sizeof *s->crossings)) {
        w->failed = true;
        return;
    }
    size_t i = s->crossing_count++;
    for (; i && comes_first(&c, &s->crossings[(i - 1) / 2]); i = (i - 1) / 2)
        s->crossings[i] = s->crossings[(i - 1) / 2];
    s->crossings[i] = c;
}

static dp_fill_crossing pop_crossing(dp_section_scratch *s) {
    const dp_fill_crossing first = s->crossings[0], last = s->crossings[--s->crossing_count];
    size_t i = 0;
    for (size_t child; (child = 2 * i + 1) < s->crossing_count; i = child) {
        if (child + 1 < s->crossing_count &&
            comes_first(&s->crossings[child + 1], &s->crossings[child]))
            child++;
        if (!comes_first(&s->crossings[child], &last)) break;
        s->crossings[i] = s->crossings[child];
    }
    s->crossings[i] = last;
    return first;
}

/* Notes where two neighbours cross: if the left one is the right one where the shorter one ends. */
static void look_ahead(sweep *w, uint32_t left, uint32_t right) {
    dp_fill_edge *const a = &w->s->edges[left];
    const dp_fill_edge *const b = &w->s->edges[right];
    const double end = dp_min(a->v1, b->v1), after = at(a, end) - at(b, end);
    if (!(after > 0) || a->crosses == right || !w->s->crossings_left) return;
    const double before = dp_max(at(b, w->v) - at(a, w->v), 0),
                 v = w->v + (end - w->v) * (before / (before + after));
    if (!(v < end)) return;
    a->crosses = right;
    w->s->crossings_left--;
    push_crossing(w, (dp_fill_crossing){dp_max(v, w->v), left, right});
}

static void exchange(sweep *w, const dp_fill_crossing *c) {
    dp_fill_edge *const a = &w->s->edges[c->left], *const b = &w->s->edges[c->right];
    if (a->crosses == c->right) a->crosses = NONE; /* it is noted again if another lies between */
    if (a->v1 <= w->v || b->v1 <= w->v || b->place != a->place + 1) return;
    w->s->active[a->place] = c->right;
    w->s->active[b->place] = c->left;
    b->place = a->place++;
    changed(w, b->place);
    changed(w, a->place);
}

/* ------- windings ------- */

/* Edge `left` bounds the inside, up to edge `right`. */
static void bound(sweep *w, uint32_t left, uint32_t right) {
    dp_fill_edge *const e = &w->s->edges[left];
    if (e->begun && e->right == right) return;
    if (e->begun) end_trapezoid(w, e, w->v);
    e->begun = true, e->right = right, e->since = w->v;
}

/* The number of the first active edge from which windings must be counted again: where they are 0 to
 * the left of it. */
static uint32_t find_start(const sweep *w) {
    const dp_section_scratch *const s = w->s;
    uint32_t i = w->low < s->active_count ? w->low : (uint32_t)s->active_count;
    while (i && s->edges[s->active[i - 1]].after != 0) i--;
    if (i) i--; /* that edge may have been a right bound */
    while (i && s->edges[s->active[i - 1]].after != 0) i--;
    return i;
}

static void find_bounds(sweep *w) {
    const dp_section_scratch *const s = w->s;
    uint32_t left = NONE;
    int32_t winding = 0;
    for (uint32_t i = find_start(w); i < s->active_count; i++) {
        dp_fill_edge *const e = &s->edges[s->active[i]];
        const int32_t before = winding;
        winding = e->after;
        e->ends = before != 0 && winding == 0;
        if (before == 0 && winding != 0)
            left = s->active[i];
        else if (e->begun)
            end_trapezoid(w, e, w->v);
        if (e->ends) bound(w, left, s->active[i]);
        if (i > w->high && winding == 0) break;
    }
}

/* Counts windings of the edges that changed; most lie inside and bound nothing, as before. */
static void count_windings(sweep *w) {
    const dp_section_scratch *const s = w->s;
    const uint32_t from = w->low ? w->low - 1 : 0;
    int32_t winding = from ? s->edges[s->active[from - 1]].after : 0;
    for (uint32_t i = from; i < s->active_count && i <= w->high + 1; i++) {
        dp_fill_edge *const e = &s->edges[s->active[i]];
        const int32_t before = winding;
        winding = e->after = before + e->winding;
        w->bounds_change |=
            e->begun != (before == 0 && winding != 0) || e->ends != (before != 0 && winding == 0);
        if (i > from) look_ahead(w, s->active[i - 1], s->active[i]);
    }
    if (w->bounds_change) find_bounds(w);
}

/* ------- the sweep ------- */

static int by_v(const void *left, const void *right) {
    const dp_fill_event *const l = left, *const r = right;
    if (l->v != r->v) return l->v < r->v ? -1 : 1;
    if (l->begins != r->begins) return l->begins ? 1 : -1;
    return (l->edge > r->edge) - (l->edge < r->edge);
}

static bool begin(sweep *w) {
    dp_section_scratch *const s = w->s;
    const size_t count = s->edge_count;
    if (!dp_reserve(w->memory, &s->events, &s->events_cap, 2 * count, sizeof *s->events) ||
        !dp_reserve(w->memory, &s->active, &s->active_cap, count, sizeof *s->active))
        return false;
    s->event_count = 0;
    for (uint32_t i = 0; i < count; i++) {
        dp_fill_edge *const e = &s->edges[i];
        if (e->v0 == e->v1) continue;
        e->begun = e->ends = false, e->after = 0, e->crosses = NONE;
        s->events[s->event_count++] = (dp_fill_event){e->v0, i, true};
        s->events[s->event_count++] = (dp_fill_event){e->v1, i, false};
    }
    if (s->event_count) dp_sort(s->events, s->event_count, sizeof *s->events, by_v);
    s->active_count = s->crossing_count = 0;
    s->crossings_left = CROSSINGS + CROSSINGS_PER_EDGE * count;
    return true;
}

bool dp_section_fill(dp_section_scratch *s, const dp_section_sink *sink,
                     const dp_allocator *memory) {
    sweep w = {.s = s, .sink = sink, .memory = memory};
    if (!s->edge_count) return true;
    if (!begin(&w)) return false;
    const size_t count = s->event_count;
    for (size_t i = 0; (i < count || s->crossing_count) && !w.failed;) {
        const bool crosses =
            s->crossing_count && (i == count || s->crossings[0].v < s->events[i].v);
        w.v = crosses ? s->crossings[0].v : s->events[i].v;
        w.low = 1, w.high = 0, w.bounds_change = false;
        while (s->crossing_count && s->crossings[0].v <= w.v) {
            const dp_fill_crossing c = pop_crossing(s);
            exchange(&w, &c);
        }
        for (; i < count && s->events[i].v == w.v && !s->events[i].begins; i++)
            take_out(&w, s->events[i].edge);
        for (; i < count && s->events[i].v == w.v; i++) put_in(&w, s->events[i].edge);
        if (w.low <= w.high) count_windings(&w);
    }
    return !w.failed;
}
