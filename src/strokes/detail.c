/* What of a drawing a person would draw: exact lines of a scan or of a coarse model are true to its
 * polygons, but most of them say nothing of its shape. Works on visible segments, before ink.
 *
 *     chain the segments, whatever their class
 *     traits of each: how much its fold turns, and how regular its chain is there, as that of a real
 *         edge is: it does not zigzag, and its fold turns by the same from segment to segment
 *     samples, one every few px of a chain: the evidence there (evidence.c)
 *         of an outline    how far it stands before what is beyond
 *         of a hard edge   how clearly the surface is folded, times how regular the chain is
 *     chains with enough evidence of a hard edge are drawn, however much they weaken on their way; so
 *         are chains between two others that are drawn, if all of their evidence is good
 *     outlines have support: the evidence of samples on one smooth curve with them, near by, as in
 *         tensor voting (Guy and Medioni 1996); so crumbs have little, and gaps and joints do not
 *         matter. Or their whole chain has enough
 *     lines are as wide as their support allows, cut where it fails
 *
 * Lengths are in px of a picture whose smaller side is 900 px, and grow with it: the same is drawn in a
 * thumbnail and on a poster. All that is decided by thresholds is a smooth step, and support changes
 * little when the view does, so that lines of a film come and go by growing and shrinking.
 *
 * Data structure: samples lie in the order of chains; a segment has the run [first, end) of them,
 * which it shares with its neighbours if it is short. Invariant: what is drawn is a part of the exact
 * drawing; borders and intersections, hidden lines and the order of segments are not touched. */
#include "strokes/detail_parts.h"

#include "base/elementary.h"
#include "core/outline.h"
#include "core/spine.h"
#include "strokes/evidence.h"

#include <string.h>

static const float DEGREES = 57.29577951f;

/* Lengths, px at a smaller side of 900. */
static const float PICTURE = 900, STEP = 4 /* between samples */,
                   BEYOND = 3 /* beside an outline, where its gap is measured */,
                   KINK = 20 /* what of a chain a kink makes doubtful, to either side of it */;

enum { NONE = UINT32_MAX };

static const dp_array arrays[] = {
    DP_ARRAY(dp_detail_store, strokes, strokes_cap),   DP_ARRAY(dp_detail_store, trait, trait_cap),
    DP_ARRAY(dp_detail_store, samples, samples_cap),   DP_ARRAY(dp_detail_store, rings, rings_cap),
    DP_ARRAY(dp_detail_store, cells, cells_cap),       DP_ARRAY(dp_detail_store, next, next_cap),
    DP_ARRAY(dp_detail_store, turns, turns_cap),       DP_ARRAY(dp_detail_store, pieces, pieces_cap),
    DP_ARRAY(dp_detail_store, segments, segments_cap), DP_ARRAY(dp_detail_store, kept, kept_cap)};

void dp_detail_store_free(dp_detail_store *store, const dp_allocator *memory) {
    dp_arrays_free(memory, store, DP_ARRAYS(arrays));
    dp_chain_store_free(&store->chains, memory);
}

uint64_t dp_detail_store_bytes(const dp_detail_store *store) {
    return dp_arrays_bytes(store, DP_ARRAYS(arrays)) + dp_chain_store_bytes(&store->chains);
}

static bool is_crease(const dp_stroke *s) {
    return s->line == DP_LINE_RIDGE || s->line == DP_LINE_VALLEY;
}

/* Is it for this stage to say whether the segment is drawn? */
static bool is_judged(const dp_stroke *s) {
    return !s->level && (s->line == DP_LINE_SILHOUETTE || is_crease(s));
}

/* ------- traits ------- */

static float turn_between(const dp_frame *frame, const dp_piece *piece) {
    if (piece->b == NONE || piece->edge == DP_CROSSING) return 0;
    const double cosine =
        dp_dot(dp_polygon_normal(frame, piece->a), dp_polygon_normal(frame, piece->b));
    return (float)dp_acos(dp_min(dp_max(cosine, -1), 1)) * DEGREES;
}

static void find_turns(void *arg, uint32_t index, uint32_t worker) {
    const dp_detail *const c = arg;
    const uint32_t first = index * DP_DETAIL_BLOCK, end = first + DP_DETAIL_BLOCK < c->count ? first + DP_DETAIL_BLOCK : c->count;
    (void)worker;
    for (uint32_t i = first; i < end; i++) {
        const dp_stroke *const s = &c->lines->strokes[i];
        c->own->trait[i] = (dp_line_trait){.length = dp_hypotf(s->b.x - s->a.x, s->b.y - s->a.y),
                                           .turn = turn_between(c->frame, &c->lines->pieces[i]),
                                           .regular = 1};
    }
}

static bool make_chains(dp_detail *c) {
    static const dp_chain_rule rule = {.sharpest = 0.5f}; /* up to 60 degrees */
    for (uint32_t i = 0; i < c->count; i++) {
        c->own->strokes[i] = c->lines->strokes[i];
        c->own->strokes[i].line = 0, c->own->strokes[i].color = 0;
    }
    return dp_make_chains(c->own->strokes, c->count, &rule, c->frame->memory, &c->own->chains);
}

/* Degrees by which a chain turns to the left from one link to the next. */
static float bend_of(const dp_detail *c, const dp_link *from, const dp_link *to) {
    const dp_stroke *const s = &c->lines->strokes[from->segment],
                    *const t = &c->lines->strokes[to->segment];
    const float back = from->reversed == to->reversed ? 1 : -1;
    const float sx = s->b.x - s->a.x, sy = s->b.y - s->a.y, tx = back * (t->b.x - t->a.x),
                ty = back * (t->b.y - t->a.y);
    return (float)dp_atan2((double)(sx * ty - sy * tx), (double)(sx * tx + sy * ty)) * DEGREES;
}

/* Degrees by which the chain kinks where it turns by turns[i], of `count`: not where it turns as much
 * before or after, as a round one does, unless these turns alternate. */
static float kink_at(const float *turns, uint32_t i, uint32_t count) {
    const bool before = i > 0, after = i + 1 < count;
    float kink = fabsf(turns[i]);
    if (before) kink = dp_minf(kink, fabsf(turns[i] - turns[i - 1]));
    if (after) kink = dp_minf(kink, fabsf(turns[i] - turns[i + 1]));
    if (before && after && turns[i] * turns[i - 1] < 0 && turns[i] * turns[i + 1] < 0)
        kink = dp_maxf(kink, fabsf(turns[i]));
    return kink;
}

static void doubt(const dp_detail *c, uint32_t segment, float share) {
    dp_line_trait *const t = &c->own->trait[segment];
    if (t->length > 0) t->regular *= 1 - share * dp_minf(1, KINK * c->unit / t->length);
}

static void find_regularity(const dp_detail *c, const dp_chain *chain) {
    const dp_link *const links = dp_links_of(c, chain);
    float *const turns = c->own->turns;
    for (uint32_t i = 0; i + 1 < chain->count; i++) turns[i] = bend_of(c, &links[i], &links[i + 1]);
    for (uint32_t i = 0; i + 1 < chain->count; i++) {
        const uint32_t s = links[i].segment, t = links[i + 1].segment;
        const float kink = dp_smooth_step(10, 40, kink_at(turns, i, chain->count - 1)),
                    change = dp_smooth_step(8, 30, fabsf(c->own->trait[s].turn - c->own->trait[t].turn));
        doubt(c, s, dp_maxf(kink, change));
        doubt(c, t, dp_maxf(kink, change));
    }
    /* of one segment alone nothing is known */
    if (chain->count == 1) {
        dp_line_trait *const t = &c->own->trait[links->segment];
        if (t->length > 0) t->regular *= 1 - 0.5f * dp_minf(1, 2 * KINK * c->unit / t->length);
    }
}

/* ------- samples ------- */

static bool put_sample(dp_detail *c, uint32_t segment, float at, float length) {
    dp_detail_store *const own = c->own;
    const dp_stroke *const s = &c->lines->strokes[segment];
    const float whole = own->trait[segment].length;
    if (!dp_reserve(c->frame->memory, &own->samples, &own->samples_cap, c->sample_count + 1u,
                    sizeof *own->samples))
        return false;
    own->samples[c->sample_count++] = (dp_line_sample){
        .x = s->a.x + (s->b.x - s->a.x) * at,
        .y = s->a.y + (s->b.y - s->a.y) * at,
        .along = {whole > 0 ? (s->b.x - s->a.x) / whole : 0, whole > 0 ? (s->b.y - s->a.y) / whole : 0},
        .length = length,
        .at = at,
        .segment = segment};
    return true;
}

/* Several samples of a long segment; in the order in which a goes to b. */
static bool sample_long(dp_detail *c, uint32_t segment) {
    dp_line_trait *const t = &c->own->trait[segment];
    const float parts = ceilf(t->length / (STEP * c->unit));
    const uint32_t n = parts < 65536 ? (uint32_t)parts : 65536;
    t->first = c->sample_count;
    for (uint32_t i = 0; i < n; i++)
        if (!put_sample(c, segment, ((float)i + 0.5f) / (float)n, t->length / (float)n)) return false;
    t->end = c->sample_count;
    return true;
}

/* Do two links of a chain share a sample, if they are short? */
static bool is_alike(const dp_detail *c, uint32_t s, uint32_t t) {
    const dp_stroke *const a = &c->lines->strokes[s], *const b = &c->lines->strokes[t];
    return a->line == b->line && a->level == b->level;
}

/* One sample of the short segments from link i on, in the middle one; returns the link after them, or
 * 0 when memory is out. */
static uint32_t sample_short(dp_detail *c, const dp_chain *chain, uint32_t i) {
    const dp_link *const links = dp_links_of(c, chain);
    float length = 0, half = 0;
    uint32_t end = i, middle = i;
    while (end < chain->count && length < STEP * c->unit / 2 &&
           c->own->trait[links[end].segment].length <= STEP * c->unit &&
           is_alike(c, links[i].segment, links[end].segment))
        length += c->own->trait[links[end++].segment].length;
    while (middle + 1 < end && half + c->own->trait[links[middle].segment].length < length / 2)
        half += c->own->trait[links[middle++].segment].length;
    for (uint32_t k = i; k < end; k++) {
        c->own->trait[links[k].segment].first = c->sample_count;
        c->own->trait[links[k].segment].end = c->sample_count + 1;
    }
    return put_sample(c, links[middle].segment, 0.5f, length) ? end : 0;
}

static bool sample_chain(dp_detail *c, const dp_chain *chain) {
    const dp_link *const links = dp_links_of(c, chain);
    for (uint32_t i = 0; i < chain->count;) {
        if (c->own->trait[links[i].segment].length > STEP * c->unit) {
            if (!sample_long(c, links[i++].segment)) return false;
        } else if (!(i = sample_short(c, chain, i))) {
            return false;
        }
    }
    return true;
}

/* Evidence of an outline: at a gap of 30 all that its length is worth, and more where it is the rim
 * of something before something else: nobody leaves that out. */
static float outline_evidence(float gap) {
    return dp_smooth_step(2, 30, gap) + 3 * dp_smooth_step(16, 60, gap);
}

static void look(const dp_detail *c, dp_line_sample *s) {
    const dp_stroke *const stroke = &c->lines->strokes[s->segment];
    const dp_piece *const piece = &c->lines->pieces[s->segment];
    const dp_line_trait *const trait = &c->own->trait[s->segment];
    if (!is_judged(stroke)) {
        s->hard = 1;
        return;
    }
    if (!(trait->length > 0)) return;
    const dp_stroke_point point = dp_stroke_point_at(c->frame, stroke, s->at);
    const bool outline = stroke->line == DP_LINE_SILHOUETTE;
    const dp_fold_sides sides = {{!outline || piece->seen & 1 ? piece->a : NONE,
                                  !outline || piece->seen & 2 ? piece->b : NONE},
                                 trait->turn};
    if (outline) {
        s->gap = dp_outline_gap(c->frame, &point, dp_maxf(BEYOND * c->unit, 2)) / c->unit;
        s->outline = outline_evidence(s->gap);
    }
    /* an edge as sharp as of a box is one, if it is short, too */
    const float regular = dp_maxf(trait->regular, 0.6f * dp_smooth_step(60, 85, trait->turn));
    s->hard = dp_fold_clarity(c->frame, stroke, &point, &sides, c->unit) * regular;
}

static void look_block(void *arg, uint32_t index, uint32_t worker) {
    const dp_detail *const c = arg;
    const uint32_t first = index * DP_DETAIL_BLOCK;
    (void)worker;
    for (uint32_t i = first; i < first + DP_DETAIL_BLOCK && i < c->sample_count; i++)
        look(c, &c->own->samples[i]);
}

/* ------- what is drawn ------- */

/* The share of its width that a sample's line has, in sixteenths: equal neighbours stay one. */
static float share_of(const dp_detail *c, const dp_line_sample *s, uint32_t segment) {
    static const float LEAST = 0.1f;
    const dp_stroke *const stroke = &c->lines->strokes[segment];
    const dp_line_trait *const t = &c->own->trait[segment];
    if (!is_judged(stroke)) return 1;
    if (t->drawn && (is_crease(stroke) || s->hard > 0.15f)) return 1;
    if (is_crease(stroke)) return 0;
    const float share = dp_maxf(dp_smooth_step(8, 48, s->support),
                                t->weight * dp_smooth_step(0, 3, s->gap));
    return share < LEAST ? 0 : ceilf(16 * share) / 16;
}

static void cut_end(const dp_detail *c, uint32_t from, uint32_t to, int end, float at) {
    const dp_segment *const s = &c->lines->segments[from];
    const dp_stroke *const k = &c->lines->strokes[from];
    dp_segment *const out = &c->own->segments[to];
    const dp_point p = {k->a.x + (k->b.x - k->a.x) * at, k->a.y + (k->b.y - k->a.y) * at,
                        k->a.d + (k->b.d - k->a.d) * at};
    /* world space is affine in what depth is, times that: in perspective, 1 / distance */
    const double a = c->frame->view.perspective ? (double)k->a.d : 1,
                 b = c->frame->view.perspective ? (double)k->b.d : 1, t = (double)at,
                 share = t * b / ((1 - t) * a + t * b);
    float *const screen = end ? out->b : out->a;
    double *const world = end ? out->world_b : out->world_a;
    *(end ? &c->own->kept[to].b : &c->own->kept[to].a) = p;
    screen[0] = p.x, screen[1] = p.y, screen[2] = (float)dp_distance(&c->frame->view, (double)p.d);
    for (int i = 0; i < 3; i++) world[i] = s->world_a[i] + share * (s->world_b[i] - s->world_a[i]);
    out->end[end] = DP_END_DETAIL;
    out->hider[end] = UINT64_MAX;
}

static bool keep_part(dp_detail *c, size_t *count, uint32_t i, float from, float to, float share) {
    dp_detail_store *const own = c->own;
    const dp_allocator *const memory = c->frame->memory;
    const uint32_t at = (uint32_t)*count;
    if (*count >= UINT32_MAX / 2 ||
        !dp_reserve(memory, &own->pieces, &own->pieces_cap, *count + 1, sizeof *own->pieces) ||
        !dp_reserve(memory, &own->segments, &own->segments_cap, *count + 1, sizeof *own->segments) ||
        !dp_reserve(memory, &own->kept, &own->kept_cap, *count + 1, sizeof *own->kept))
        return false;
    const dp_piece *const piece = &c->lines->pieces[i];
    const float probes = (float)(piece->k1 - piece->k0);
    own->pieces[at] = *piece, own->segments[at] = c->lines->segments[i];
    own->kept[at] = c->lines->strokes[i];
    if (from > 0) own->pieces[at].k0 = piece->k0 + (uint32_t)(from * probes), cut_end(c, i, at, 0, from);
    if (to < 1) own->pieces[at].k1 = piece->k0 + (uint32_t)(to * probes), cut_end(c, i, at, 1, to);
    if (!c->lines->stylizes) own->kept[at].half_width *= share; /* strokes of the hand taper on their own */
    ++*count;
    return true;
}

static bool keep_segment(dp_detail *c, size_t *count, uint32_t i) {
    const dp_line_trait *const t = &c->own->trait[i];
    const dp_line_sample *const samples = c->own->samples + t->first;
    const uint32_t n = t->end - t->first;
    for (uint32_t from = 0, to; from < n; from = to) {
        const float share = share_of(c, &samples[from], i);
        for (to = from + 1; to < n && share_of(c, &samples[to], i) == share; to++) {
        }
        if (share > 0 &&
            !keep_part(c, count, i, (float)from / (float)n, (float)to / (float)n, share))
            return false;
    }
    return true;
}

static bool take_result(dp_detail *c, size_t count) {
    dp_lines *const d = c->lines;
    const dp_allocator *const memory = c->frame->memory;
    if (!dp_reserve(memory, &d->pieces, &d->pieces_cap, count, sizeof *d->pieces) ||
        !dp_reserve(memory, &d->segments, &d->segments_cap, count, sizeof *d->segments) ||
        !dp_reserve(memory, &d->strokes, &d->strokes_cap, count, sizeof *d->strokes))
        return false;
    d->count = count;
    if (!count) return true;
    memcpy(d->pieces, c->own->pieces, count * sizeof *d->pieces);
    memcpy(d->segments, c->own->segments, count * sizeof *d->segments);
    memcpy(d->strokes, c->own->kept, count * sizeof *d->strokes);
    return true;
}

/* ------- all of it ------- */

static bool reserve(const dp_detail *c) {
    dp_detail_store *const own = c->own;
    const dp_allocator *const memory = c->frame->memory;
    return dp_reserve(memory, &own->strokes, &own->strokes_cap, c->count, sizeof *own->strokes) &&
           dp_reserve(memory, &own->trait, &own->trait_cap, c->count, sizeof *own->trait) &&
           dp_reserve(memory, &own->turns, &own->turns_cap, c->count, sizeof *own->turns);
}

static void in_blocks(dp_detail *c, uint32_t count, dp_task *task) {
    dp_parallel(c->frame->threads, count / DP_DETAIL_BLOCK + (count % DP_DETAIL_BLOCK != 0), task, c);
}

/* px of this picture for one of the lengths above. */
static float unit_of(const dp_frame *frame, float detail) {
    const float side = (float)dp_min(frame->view.width, frame->view.height);
    return dp_maxf(side / PICTURE, 0.5f) / detail;
}

bool dp_clean_lines(const dp_frame *frame, dp_lines *lines, dp_detail_store *store) {
    const float detail = frame->styles[0].detail;
    size_t kept = 0;
    if (!(detail > 0) || !lines->count) return true;
    dp_detail c = {.frame = frame,
                  .lines = lines,
                  .own = store,
                  .count = (uint32_t)lines->count,
                  .unit = unit_of(frame, detail)};
    if (!reserve(&c)) return false;
    in_blocks(&c, c.count, find_turns);
    if (!make_chains(&c)) return false;
    for (uint32_t i = 0; i < store->chains.chain_count; i++) {
        find_regularity(&c, &store->chains.chains[i]);
        if (!sample_chain(&c, &store->chains.chains[i])) return false;
    }
    in_blocks(&c, c.sample_count, look_block);
    if (!dp_judge_chains(&c) || !dp_find_support(&c)) return false;
    for (uint32_t i = 0; i < c.count; i++)
        if (!keep_segment(&c, &kept, i)) return false;
    return take_result(&c, kept);
}
