/* Hidden lines between finding and drawing.
 *
 *     set visible strokes aside, in the order in which plain ink has always taken them
 *     chain hidden segments, whatever their level: a run shorter than CRUMB takes the level of the
 *         longer run beside it
 *     chain them, whatever their class: what is shorter than CRUMB altogether is dropped, and
 *         segments of one edge that have one level now are joined
 *     chain all (lines.c)
 *     cut each hidden chain at its corners, and each part into dashes: of chains without what lies on
 *         other lines, where these would fill the gaps (vector/once.c)
 *
 * A dash is as long as ISO 128-2 has it, but the pattern is stretched or shrunk so that a part begins
 * and ends with a whole dash, as a draughtsman would have lines meet: corners are closed. A part too
 * short for two dashes is one. Corners that follow each other more closely than that are no cuts; the
 * pattern runs on around them.
 *
 * Invariant: nothing visible changes. Data structure: a list of dashes behind the visible strokes,
 * lines->inked. */
#include "strokes/hidden.h"

#include <string.h>

/* px: a shorter run of one level, or a shorter hidden line, is rounding: where surfaces touch, or a
 * line grazes an outline. */
static const float CRUMB = 2;

bool dp_hidden_dash(dp_hidden_look look, float width, float dash[2]) {
    switch (look) {
    case DP_HIDDEN_DASHED:
        dash[0] = 11 * width, dash[1] = 4 * width;
        return true;
    case DP_HIDDEN_DOTTED:
        dash[0] = 0, dash[1] = 3 * width;
        return true;
    default:
        return false;
    }
}

static float length_of(const dp_stroke *s) { return dp_hypotf(s->b.x - s->a.x, s->b.y - s->a.y); }

/* ------- levels and crumbs ------- */

/* The hidden segments, as strokes that differ in nothing that is not to keep them apart. */
typedef struct hidden_part {
    const dp_frame *frame;
    dp_lines *lines;
    dp_hidden_scratch *own;
    uint32_t count;
} hidden_part;

static bool make_chains(const hidden_part *h) {
    const dp_chain_rule rule = dp_plain_chain_rule();
    return dp_make_chains(h->own->strokes, h->count, &rule, h->frame->memory, &h->own->chains);
}

/* A run of links of one level. */
typedef struct run {
    uint32_t first, end;
    float length;
} run;

static dp_piece *piece_of(const hidden_part *h, uint32_t link) {
    return &h->lines->pieces[h->own->segment[h->own->chains.links[link].segment]];
}

static bool same_level(const hidden_part *h, uint32_t link, uint32_t other) {
    const dp_piece *const p = piece_of(h, link), *const q = piece_of(h, other);
    return p->level == q->level && p->through == q->through;
}

static run run_from(const hidden_part *h, uint32_t first, uint32_t end) {
    run r = {first, first, 0};
    while (r.end < end && same_level(h, r.end, first))
        r.length += length_of(&h->own->strokes[h->own->chains.links[r.end++].segment]);
    return r;
}

/* Gives a run the level of a link. */
static void set_level(const hidden_part *h, const run *r, uint32_t link) {
    const dp_piece *const from = piece_of(h, link);
    for (uint32_t i = r->first; i < r->end; i++)
        piece_of(h, i)->level = from->level, piece_of(h, i)->through = from->through;
}

/* Gives short runs the level of the longer one beside them. Returns whether any changed. */
static bool smooth_chain(const hidden_part *h, const dp_chain *chain) {
    const uint32_t end = chain->first + chain->count;
    run before = run_from(h, chain->first, end), here;
    bool any = false;
    if (before.end == end) return false;
    for (here = before, before.length = -1; here.first < end;) {
        const bool last = here.end == end;
        const run after = last ? (run){end, end, -1} : run_from(h, here.end, end);
        if (here.length < CRUMB && (before.length >= 0 || !last)) {
            const bool back = before.length >= after.length;
            set_level(h, &here, back ? here.first - 1 : here.end);
            any = true;
            if (back) { /* it is part of the run before it */
                before.end = here.end, before.length += here.length;
                here = after;
                continue;
            }
            here = run_from(h, here.first, end);
            continue;
        }
        before = here, here = after;
    }
    return any;
}

static bool smooth_levels(hidden_part *h) {
    enum { PASSES = 8 };
    if (h->frame->hidden < 2) return true;
    if (!make_chains(h)) return false;
    for (uint32_t i = 0; i < h->own->chains.chain_count; i++)
        for (int k = 0; k < PASSES && smooth_chain(h, &h->own->chains.chains[i]); k++) {
        }
    return true;
}

/* Marks what is short, whatever its classes. */
static bool find_crumbs(hidden_part *h) {
    for (uint32_t i = 0; i < h->count; i++) h->own->strokes[i].line = 0;
    if (!make_chains(h)) return false;
    for (uint32_t c = 0; c < h->own->chains.chain_count; c++) {
        const dp_chain *const chain = &h->own->chains.chains[c];
        float length = 0;
        for (uint32_t i = 0; i < chain->count; i++)
            length += length_of(&h->own->strokes[h->own->chains.links[chain->first + i].segment]);
        for (uint32_t i = 0; i < chain->count; i++)
            h->own->dropped[h->own->chains.links[chain->first + i].segment] = length < CRUMB;
    }
    return true;
}

/* Appends segment i to segment `to`, which it goes on. */
static void append(dp_lines *d, size_t to, size_t i) {
    const dp_segment *const from = &d->segments[i];
    dp_segment *const s = &d->segments[to];
    d->pieces[to].k1 = d->pieces[i].k1, d->pieces[to].hider[1] = d->pieces[i].hider[1];
    d->strokes[to].b = d->strokes[i].b;
    memcpy(s->b, from->b, sizeof s->b);
    memcpy(s->world_b, from->world_b, sizeof s->world_b);
    s->end[1] = from->end[1], s->hider[1] = from->hider[1];
}

/* Drops what is marked, and joins what has one level now. */
static void drop_crumbs(const hidden_part *h) {
    dp_lines *const d = h->lines;
    size_t kept = 0;
    for (size_t i = 0, k = 0; i < d->count; i++) {
        if (k < h->count && h->own->segment[k] == i && h->own->dropped[k++]) continue;
        if (d->pieces[i].level && kept && dp_piece_goes_on(&d->pieces[kept - 1], &d->pieces[i])) {
            append(d, kept - 1, i);
            continue;
        }
        if (kept < i)
            d->pieces[kept] = d->pieces[i], d->segments[kept] = d->segments[i],
            d->strokes[kept] = d->strokes[i];
        kept++;
    }
    d->count = kept;
}

/* What segments and strokes have by their level. */
static void take_levels(const dp_frame *frame, dp_lines *d) {
    for (size_t i = 0; i < d->count; i++)
        if (d->pieces[i].level) dp_take_look(frame, &d->pieces[i], &d->segments[i], &d->strokes[i]);
}

static void list_hidden(hidden_part *h) {
    dp_lines *const d = h->lines;
    for (size_t i = 0; i < d->count; i++) {
        if (!d->pieces[i].level) continue;
        h->own->strokes[h->count] = d->strokes[i];
        h->own->strokes[h->count].level = 1, h->own->strokes[h->count].color = 0;
        h->own->segment[h->count++] = (uint32_t)i;
    }
}

static bool reserve(const dp_frame *frame, dp_hidden_scratch *own, size_t count) {
    return dp_reserve(frame->memory, &own->strokes, &own->strokes_cap, count,
                      sizeof *own->strokes) &&
           dp_reserve(frame->memory, &own->segment, &own->segment_cap, count,
                      sizeof *own->segment) &&
           dp_reserve(frame->memory, &own->dropped, &own->dropped_cap, count, 1);
}

static bool smooth_hidden(const dp_frame *frame, dp_lines *d, size_t count) {
    hidden_part h = {.frame = frame, .lines = d, .own = &d->hidden};
    if (!reserve(frame, h.own, count)) return false;
    list_hidden(&h);
    if (!smooth_levels(&h) || !find_crumbs(&h)) return false;
    drop_crumbs(&h);
    take_levels(frame, d);
    return true;
}

/* ------- dashes ------- */

/* A hidden chain as points on the screen; what is inked follows its arc length. */
typedef struct path {
    const dp_frame *frame;
    const dp_lines *chained;
    dp_lines *lines;       /* to which dashes are appended */
    const dp_stroke *look; /* its first stroke: width, colour, class, level */
    dp_point *points;      /* [count] */
    float *arc;
    uint32_t count;
    bool closed;
} path;

static bool put_stroke(path *p, dp_point a, dp_point b) {
    dp_lines *const d = p->lines;
    if (!dp_reserve(p->frame->memory, &d->inked, &d->inked_cap, d->inked_count + 1,
                    sizeof *d->inked))
        return false;
    dp_stroke *const s = &d->inked[d->inked_count++];
    *s = *p->look;
    s->a = a, s->b = b;
    return true;
}

static dp_point point_at(const path *p, uint32_t i, float arc) {
    const dp_point a = p->points[i], b = p->points[i + 1];
    const float length = p->arc[i + 1] - p->arc[i];
    const float t = length > 0 ? dp_minf(dp_maxf((arc - p->arc[i]) / length, 0), 1) : 0;
    return (dp_point){a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.d + (b.d - a.d) * t};
}

/* The part of the path between two arc lengths. `*at`: a point before `from`, moved on. */
static bool put_dash(path *p, uint32_t *at, float from, float to) {
    while (*at + 2 < p->count && p->arc[*at + 1] <= from) ++*at;
    dp_point a = point_at(p, *at, from);
    for (uint32_t i = *at; i + 1 < p->count; i++) {
        const bool last = p->arc[i + 1] >= to || i + 2 == p->count;
        const dp_point b = last ? point_at(p, i, to) : p->points[i + 1];
        if (!put_stroke(p, a, b)) return false;
        if (last) break;
        a = b;
    }
    return true;
}

/* Dashes along [from, to] of the path: `gaps` of them are left out, and a dash is at either end; of a
 * ring, only at its start. */
static bool dash_part(path *p, uint32_t *at, float from, float to, const float dash[2], bool ring) {
    const float length = to - from, period = dash[0] + dash[1];
    const float fit = floorf((ring ? length : length - dash[0]) / period + 0.5f);
    const float gaps = fit > 0 ? fit : 0, dashes = ring ? gaps : gaps + 1;
    if (gaps < 1) return put_dash(p, at, from, to);
    const float stretch = length / (dashes * dash[0] + gaps * dash[1]);
    for (float i = 0; i < dashes; i++) {
        const float start = from + i * period * stretch;
        if (!put_dash(p, at, start, dp_minf(start + dash[0] * stretch, to))) return false;
    }
    return true;
}

/* Cosine of the turn at point i, between what lies `beside` px before and after it. */
static float turn_at(const path *p, uint32_t i, float beside) {
    uint32_t j = i, k = i;
    while (j > 0 && p->arc[i] - p->arc[j] < beside) j--;
    while (k + 1 < p->count && p->arc[k] - p->arc[i] < beside) k++;
    const float ax = p->points[i].x - p->points[j].x, ay = p->points[i].y - p->points[j].y,
                bx = p->points[k].x - p->points[i].x, by = p->points[k].y - p->points[i].y;
    const float length = sqrtf((ax * ax + ay * ay) * (bx * bx + by * by));
    return length > 0 ? (ax * bx + ay * by) / length : 1;
}

static const float CORNER = 0.77f; /* cosine of 40 degrees */

/* From corner to corner, each part at least `least` px long. */
static bool dash_path(path *p, const float dash[2]) {
    const float total = p->arc[p->count - 1], beside = 3 * p->look->half_width + 1,
                least = 1.5f * (dash[0] + dash[1]);
    float from = 0;
    uint32_t at = 0;
    bool cut = false;
    for (uint32_t i = 1; i + 1 < p->count; i++) {
        if (p->arc[i] - from < least || total - p->arc[i] < least) continue;
        if (turn_at(p, i, beside) > CORNER) continue;
        if (!dash_part(p, &at, from, p->arc[i], dash, false)) return false;
        from = p->arc[i], cut = true;
    }
    return dash_part(p, &at, from, total, dash, p->closed && !cut);
}

static void add_point(path *p, dp_point at) {
    const dp_point last = p->points[p->count ? p->count - 1 : 0];
    const float step = p->count ? dp_hypotf(at.x - last.x, at.y - last.y) : 0;
    p->arc[p->count] = p->count ? p->arc[p->count - 1] + step : 0;
    p->points[p->count++] = at;
}

static void take_path(path *p, const dp_chain *chain) {
    const dp_lines *const d = p->chained;
    p->count = 0;
    p->closed = chain->closed;
    for (uint32_t i = 0; i < chain->count; i++) {
        const dp_link *const link = &d->chains.links[chain->first + i];
        const dp_stroke *const s = &d->strokes[link->segment];
        if (i == 0) p->look = s;
        const dp_point a = link->reversed ? s->b : s->a;
        const dp_point last = p->points[p->count ? p->count - 1 : 0];
        if (i == 0 || last.x != a.x || last.y != a.y) add_point(p, a);
        add_point(p, link->reversed ? s->a : s->b);
    }
}

static bool ink_chain(path *p, const dp_chain *chain, dp_hidden_look look) {
    float dash[2];
    take_path(p, chain);
    if (dp_hidden_dash(look, 2 * p->look->half_width, dash)) return dash_path(p, dash);
    for (uint32_t i = 0; i + 1 < p->count; i++)
        if (!put_stroke(p, p->points[i], p->points[i + 1])) return false;
    return true;
}

static bool is_hidden(const dp_lines *d, const dp_chain *chain) {
    return d->segments[d->chains.links[chain->first].segment].level;
}

bool dp_ink_hidden(const dp_frame *frame, const dp_lines *chained, dp_lines *lines) {
    dp_hidden_scratch *const own = &lines->hidden;
    const dp_chain_store *const store = &chained->chains;
    size_t most = 0;
    for (uint32_t i = 0; i < store->chain_count; i++)
        if (is_hidden(chained, &store->chains[i]) && 2 * (size_t)store->chains[i].count > most)
            most = 2 * (size_t)store->chains[i].count;
    if (!dp_reserve(frame->memory, &own->points, &own->points_cap, most, sizeof *own->points) ||
        !dp_reserve(frame->memory, &own->arc, &own->arc_cap, most, sizeof *own->arc))
        return false;
    path p = {
        .frame = frame, .chained = chained, .lines = lines, .points = own->points, .arc = own->arc};
    for (uint32_t i = 0; i < store->chain_count; i++)
        if (is_hidden(chained, &store->chains[i]) &&
            !ink_chain(&p, &store->chains[i], frame->hidden_look))
            return false;
    return lines->inked_count < UINT32_MAX;
}

/* ------- all of it ------- */

/* Sets visible strokes aside, unless stylized ones stand for them. */
static bool keep_visible(const dp_frame *frame, dp_lines *d, size_t *hidden) {
    *hidden = 0;
    d->inked_count = 0;
    if (!dp_reserve(frame->memory, &d->inked, &d->inked_cap, d->count, sizeof *d->inked))
        return false;
    for (size_t i = 0; i < d->count; i++) {
        if (d->pieces[i].level)
            ++*hidden;
        else if (!d->stylizes)
            d->inked[d->inked_count++] = d->strokes[i];
    }
    return true;
}

bool dp_finish_hidden(const dp_frame *frame, dp_lines *d) {
    size_t hidden;
    if (!frame->hidden) return true;
    if (!keep_visible(frame, d, &hidden)) return false;
    dp_sort_segments(d);
    d->inks_hidden = true;
    return smooth_hidden(frame, d, hidden) && dp_chain_lines(frame, d);
}
