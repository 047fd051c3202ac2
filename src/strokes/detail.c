/* What of a drawing a person would draw: exact lines of a scan or of a coarse model are true to its
 * polygons, but most of them say nothing of its shape. Works on segments, before ink.
 *
 *     chain the segments, whatever their class (chain.c)
 *     traits of each: how regular its chain is there, as that of a real edge is: it does not zigzag,
 *         and its fold turns by the same from segment to segment
 *     samples, one every few px of a chain: the evidence there (evidence.c)
 *         of an outline    how far it stands before what is beyond
 *         of a hard edge   how clearly the surface is folded, times how regular the chain is
 *     which chains are hard edges and are drawn as a whole (hard_edges.c)
 *     what support the samples of outlines have from others near by (support.c)
 *     draw hard edges; and outlines, as wide as their support allows, or the evidence of their whole chain;
 *         cut where both fail
 *
 * Of hidden lines only the chains are known, not the surface beside them: they are drawn as a whole
 * or not at all.
 *
 * Lengths are in px of a picture whose smaller side is 900 px, and grow with it: the same is drawn in a
 * thumbnail and on a poster. All that is decided by thresholds is a smooth step, and support changes
 * little when the view does, so that lines of a film come and go by growing and shrinking.
 *
 * Data structure: samples lie in the order of chains; a segment has the run [first, end) of them,
 * which it shares with its neighbours if it is short. Invariant: what is drawn is a part of the exact
 * drawing; borders and intersections are not touched. Nothing depends on threads. */
#include "strokes/detail_parts.h"

#include "strokes/evidence.h"

/* Lengths, px at a smaller side of 900. */
static const float PICTURE = 900, STEP = 5 /* between samples */,
                   BEYOND = 3 /* beside an outline, where its gap is measured */,
                   KINK = 20 /* what of a chain a kink makes doubtful, to either side of it */;

enum { NONE = UINT32_MAX };

/* A segment, and what goes with it. */
typedef struct dp_whole_segment {
    dp_piece piece;
    dp_segment segment;
    dp_stroke stroke;
} whole;

static const dp_array arrays[] = {
    DP_ARRAY(dp_detail_store, trait, trait_cap), DP_ARRAY(dp_detail_store, samples, samples_cap),
    DP_ARRAY(dp_detail_store, cells, cells_cap), DP_ARRAY(dp_detail_store, voters, voters_cap),
    DP_ARRAY(dp_detail_store, turns, turns_cap), DP_ARRAY(dp_detail_store, aside, aside_cap)};

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
static bool is_judged(const dp_stroke *s) { return s->line == DP_LINE_SILHOUETTE || is_crease(s); }

/* ------- traits ------- */

static void measure_lengths(const dp_detail *c, const dp_chain *chain) {
    const dp_link *const links = dp_links_of(c, chain);
    for (uint32_t i = 0; i < chain->count; i++) {
        const dp_stroke *const s = &c->lines->strokes[links[i].segment];
        c->own->trait[links[i].segment] =
            (dp_line_trait){.length = dp_hypotf(s->b.x - s->a.x, s->b.y - s->a.y), .regular = 1};
    }
}

/* Degrees by which a chain turns to the left from one link to the next. */
static float bend_of(const dp_detail *c, const dp_link *from, const dp_link *to) {
    const dp_stroke *const s = &c->lines->strokes[from->segment];
    const dp_stroke *const t = &c->lines->strokes[to->segment];
    const float back = from->reversed == to->reversed ? 1 : -1;
    const float sx = s->b.x - s->a.x, sy = s->b.y - s->a.y, tx = back * (t->b.x - t->a.x),
                ty = back * (t->b.y - t->a.y);
    const float along = sx * tx + sy * ty, across = sx * ty - sy * tx,
                length = sqrtf(along * along + across * across);
    if (!(length > 0)) return 0;
    return dp_degrees_of_cosine(along / length) * (across < 0 ? -1 : 1);
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
    float *const turns = c->own->turns + chain->first;
    for (uint32_t i = 0; i + 1 < chain->count; i++) turns[i] = bend_of(c, &links[i], &links[i + 1]);
    for (uint32_t i = 0; i + 1 < chain->count; i++) {
        const uint32_t s = links[i].segment, t = links[i + 1].segment;
        const float kink = dp_smooth_step(10, 40, kink_at(turns, i, chain->count - 1)),
                    change = dp_smooth_step(
                        8, 30, fabsf(c->lines->strokes[s].turn - c->lines->strokes[t].turn));
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

/* px; the surface is known by the pixel. */
static float step_of(const dp_detail *c) { return dp_maxf(STEP * c->unit, 1); }

static bool put_sample(dp_detail *c, uint32_t segment, float at, float length) {
    dp_detail_store *const own = c->own;
    const dp_stroke *const s = &c->lines->strokes[segment];
    const float l = own->trait[segment].length;
    if (!dp_reserve(c->frame->memory, &own->samples, &own->samples_cap, c->sample_count + 1u,
                    sizeof *own->samples))
        return false;
    own->samples[c->sample_count++] = (dp_line_sample){
        .x = s->a.x + (s->b.x - s->a.x) * at,
        .y = s->a.y + (s->b.y - s->a.y) * at,
        .along = {l > 0 ? (s->b.x - s->a.x) / l : 0, l > 0 ? (s->b.y - s->a.y) / l : 0},
        .length = length,
        .at = at,
        .segment = segment};
    return true;
}

/* Several samples of a long segment, in the order in which a goes to b; of a crease one, as it is as
 * sharp all along. */
static bool sample_long(dp_detail *c, uint32_t segment) {
    dp_line_trait *const t = &c->own->trait[segment];
    const float parts = ceilf(t->length / step_of(c));
    const uint32_t n = c->lines->strokes[segment].line != DP_LINE_SILHOUETTE ? 1
                       : parts < 65536                                       ? (uint32_t)parts
                                                                             : 65536;
    t->first = c->sample_count;
    for (uint32_t i = 0; i < n; i++)
        if (!put_sample(c, segment, ((float)i + 0.5f) / (float)n, t->length / (float)n))
            return false;
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
    while (end < chain->count && length < 0.75f * step_of(c) &&
           c->own->trait[links[end].segment].length <= step_of(c) &&
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
        if (c->own->trait[links[i].segment].length > step_of(c)) {
            if (!sample_long(c, links[i++].segment)) return false;
        } else if (!(i = sample_short(c, chain, i))) {
            return false;
        }
    }
    return true;
}

/* How regular a segment's chain is where that matters: an edge as sharp as of a box is good in any
 * case, and that begins at 0.7 (hard_edges.c). */
static float regular_or_sharp(const dp_line_trait *t, const dp_stroke *s) {
    return dp_maxf(t->regular, 0.705f * dp_smooth_step(65, 88, s->turn));
}

/* Nothing is known of the surface beside hidden lines: what is not broken into pieces is an outline. */
static const float HIDDEN = 0.75f; /* evidence per px */

static bool is_hidden_outline(const dp_stroke *s) {
    return s->level && s->line == DP_LINE_SILHOUETTE;
}

/* Can a chain still be a hard edge, whatever the surface beside it is like? Most of a scan's cannot,
 * and that need not be looked at. */
static void find_hope(const dp_detail *c, const dp_chain *chain) {
    const dp_link *const links = dp_links_of(c, chain);
    float hard = 0, length = 0;
    for (uint32_t i = 0; i < chain->count; i++) {
        dp_line_trait *const t = &c->own->trait[links[i].segment];
        const dp_stroke *const s = &c->lines->strokes[links[i].segment];
        t->hard = !is_judged(s)          ? 1
                  : is_hidden_outline(s) ? HIDDEN
                                         : dp_most_clarity(s) * regular_or_sharp(t, s);
        hard += t->hard * t->length, length += t->length;
    }
    if (dp_is_hard(c, hard) || dp_is_good(c, hard, length)) return;
    for (uint32_t i = 0; i < chain->count; i++) c->own->trait[links[i].segment].hard = 0;
}

static void find_traits(void *arg, uint32_t index, uint32_t worker) {
    const dp_detail *const c = arg;
    const dp_chain_store *const store = &c->own->chains;
    const uint32_t first = index * DP_DETAIL_BLOCK;
    (void)worker;
    for (uint32_t i = first; i < first + DP_DETAIL_BLOCK && i < store->chain_count; i++) {
        measure_lengths(c, &store->chains[i]);
        find_regularity(c, &store->chains[i]);
        find_hope(c, &store->chains[i]);
    }
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
    if (!is_judged(stroke) || stroke->level) { /* as well as it can be */
        s->hard = trait->hard;
        return;
    }
    const bool is_outline = stroke->line == DP_LINE_SILHOUETTE;
    if (!(trait->length > 0) || !(is_outline || trait->hard > 0)) return;
    const dp_stroke_point point = dp_stroke_point_at(c->frame, stroke, s->at);
    /* of an outline the one that is seen; where that is not known, either */
    const bool either = !is_outline || !piece->seen;
    const uint32_t polygons[2] = {either || piece->seen & 1 ? piece->a : NONE,
                                  either || piece->seen & 2 ? piece->b : NONE};
    if (is_outline) {
        s->gap = dp_outline_gap(c->frame, &point, dp_maxf(BEYOND * c->unit, 2)) / c->unit;
        s->outline = outline_evidence(s->gap);
    }
    if (trait->hard > 0)
        s->hard = dp_fold_clarity(c->frame, stroke, &point, polygons, c->unit) *
                  regular_or_sharp(trait, stroke);
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
static float share_of(const dp_line_sample *s, const dp_stroke *stroke, const dp_line_trait *t) {
    static const float LEAST = 0.3f;
    if (!is_judged(stroke)) return 1;
    if (t->drawn && (is_crease(stroke) || s->hard > 0.15f)) return 1;
    if (is_crease(stroke) || stroke->level) return 0;
    const float share = dp_maxf(dp_smooth_step(8, DP_FULL_SUPPORT, s->support),
                                t->weight * dp_smooth_step(0, 3, s->gap));
    return share < LEAST ? 0 : ceilf(16 * share) / 16;
}

static void cut_end(const dp_detail *c, const whole *from, whole *to, int end, float at) {
    const dp_stroke *const k = &from->stroke;
    const dp_point p = {k->a.x + (k->b.x - k->a.x) * at, k->a.y + (k->b.y - k->a.y) * at,
                        k->a.d + (k->b.d - k->a.d) * at};
    /* positions are affine in the share of the screen, weighted by 1 / distance */
    const double a = c->frame->view.perspective ? (double)k->a.d : 1,
                 b = c->frame->view.perspective ? (double)k->b.d : 1, t = (double)at,
                 share = t * b / ((1 - t) * a + t * b);
    float *const screen = end ? to->segment.b : to->segment.a;
    double *const world = end ? to->segment.world_b : to->segment.world_a;
    *(end ? &to->stroke.b : &to->stroke.a) = p;
    screen[0] = p.x, screen[1] = p.y, screen[2] = (float)dp_distance(&c->frame->view, (double)p.d);
    for (int i = 0; i < 3; i++)
        world[i] = from->segment.world_a[i] +
                   share * (from->segment.world_b[i] - from->segment.world_a[i]);
    to->segment.end[end] = DP_END_DETAIL;
    to->segment.hider[end] = UINT64_MAX;
}

static whole part_of(const dp_detail *c, const whole *from, float start, float end, float share) {
    whole part = *from;
    const float probes = (float)(from->piece.k1 - from->piece.k0);
    if (start > 0) {
        part.piece.k0 = from->piece.k0 + (uint32_t)(start * probes);
        cut_end(c, from, &part, 0, start);
    }
    if (end < 1) {
        part.piece.k1 = from->piece.k0 + (uint32_t)(end * probes);
        cut_end(c, from, &part, 1, end);
    }
    if (!c->lines->stylizes)
        part.stroke.half_width *= share; /* a hand's strokes taper themselves */
    return part;
}

static void put_whole(dp_lines *d, size_t at, const whole *w) {
    d->pieces[at] = w->piece, d->segments[at] = w->segment, d->strokes[at] = w->stroke;
}

/* Keeps the first part that is drawn in the drawing, at *kept, and further ones aside. */
static bool cut_segment(dp_detail *c, uint32_t i, size_t *kept, size_t *aside) {
    dp_detail_store *const own = c->own;
    const dp_line_trait *const t = &own->trait[i];
    const dp_line_sample *const samples = own->samples + t->first;
    const uint32_t n = t->end - t->first;
    const whole from = {c->lines->pieces[i], c->lines->segments[i], c->lines->strokes[i]};
    bool first = true;
    for (uint32_t start = 0, end; start < n; start = end) {
        const float share = share_of(&samples[start], &from.stroke, t);
        for (end = start + 1; end < n && share_of(&samples[end], &from.stroke, t) == share; end++) {
        }
        if (!(share > 0)) continue;
        const whole part = part_of(c, &from, (float)start / (float)n, (float)end / (float)n, share);
        if (first) {
            put_whole(c->lines, (*kept)++, &part);
        } else {
            if (!dp_reserve(c->frame->memory, &own->aside, &own->aside_cap, *aside + 1,
                            sizeof *own->aside))
                return false;
            own->aside[(*aside)++] = part;
        }
        first = false;
    }
    return true;
}

/* The same where it is all one sample, as nearly all segments of a scan are. */
static void keep_segment(const dp_detail *c, uint32_t i, size_t *kept) {
    dp_lines *const d = c->lines;
    const dp_line_trait *const t = &c->own->trait[i];
    const float share = share_of(&c->own->samples[t->first], &d->strokes[i], t);
    if (!(share > 0)) return;
    const size_t at = (*kept)++;
    if (at < i)
        d->pieces[at] = d->pieces[i], d->segments[at] = d->segments[i],
        d->strokes[at] = d->strokes[i];
    if (!d->stylizes) d->strokes[at].half_width *= share;
}

static bool keep_what_is_drawn(dp_detail *c) {
    dp_lines *const d = c->lines;
    const dp_allocator *const memory = c->frame->memory;
    size_t kept = 0, aside = 0;
    for (uint32_t i = 0; i < c->count; i++) {
        const dp_line_trait *const t = &c->own->trait[i];
        if (t->end - t->first == 1)
            keep_segment(c, i, &kept);
        else if (!cut_segment(c, i, &kept, &aside))
            return false;
    }
    const size_t all = kept + aside;
    if (all >= UINT32_MAX ||
        !dp_reserve(memory, &d->pieces, &d->pieces_cap, all, sizeof *d->pieces) ||
        !dp_reserve(memory, &d->segments, &d->segments_cap, all, sizeof *d->segments) ||
        !dp_reserve(memory, &d->strokes, &d->strokes_cap, all, sizeof *d->strokes))
        return false;
    for (size_t i = 0; i < aside; i++) put_whole(d, kept + i, &c->own->aside[i]);
    d->count = all;
    return true;
}

/* ------- all of it ------- */

static bool reserve(const dp_detail *c) {
    dp_detail_store *const own = c->own;
    const dp_allocator *const memory = c->frame->memory;
    return dp_reserve(memory, &own->trait, &own->trait_cap, c->count, sizeof *own->trait) &&
           dp_reserve(memory, &own->turns, &own->turns_cap, c->count, sizeof *own->turns);
}

/* px of this picture for one of the lengths above. */
static float unit_of(const dp_frame *frame, float detail) {
    const float side = (float)dp_min(frame->view.width, frame->view.height);
    return dp_maxf(side / PICTURE, 0.25f) / detail;
}

bool dp_clean_lines(const dp_frame *frame, dp_lines *lines, dp_detail_store *store) {
    const float detail = frame->styles[0].detail;
    if (!(detail > 0) || !lines->count) return true;
    dp_detail c = {.frame = frame,
                   .lines = lines,
                   .own = store,
                   .count = (uint32_t)lines->count,
                   .unit = unit_of(frame, detail)};
    if (!reserve(&c)) return false;
    if (!dp_make_chains(lines->strokes, c.count, &dp_detail_rule, frame->memory, &store->chains))
        return false;
    dp_in_blocks(&c, store->chains.chain_count, find_traits);
    for (uint32_t i = 0; i < store->chains.chain_count; i++)
        if (!sample_chain(&c, &store->chains.chains[i])) return false;
    dp_in_blocks(&c, c.sample_count, look_block);
    dp_judge_chains(&c);
    if (!dp_find_support(&c)) return false;
    return keep_what_is_drawn(&c);
}
