/* Which chains of a drawing are hard edges, and drawn whatever they look like in places.
 *
 *     it has enough evidence, or is long and regular        it is, however much it weakens on its way
 *     it is good all along, and both its ends are held: by
 *         others that are drawn, or as it goes on behind something      it is; again until nothing changes
 *
 * And how much evidence there is, all along a chain, of an outline: its weight.
 *
 * So the small parts of machines stay, which hang together, and crumbs of a scan do not.
 *
 * Invariant: chains are gone through in their order, and once one is drawn, it stays so. */
#include "strokes/detail_parts.h"

#include "strokes/evidence.h"

enum { FEW = 4 /* segments of a chain that do not tell whether it is regular */ };
static const float ENOUGH = 24 /* evidence of a hard edge that a chain needs */,
                   LONG = 40 /* of a regular chain, which is an edge however little it is folded */,
                   EDGE = 20 /* of one between others, which need not be as good */,
                   CRUMB = 8 /* shorter chains between others are not drawn for their sake */;

bool dp_is_hard(const dp_detail *c, float hard) { return hard > ENOUGH * c->unit; }

bool dp_is_good(const dp_detail *c, float hard, float length) {
    return length >= CRUMB * c->unit && hard >= (length < EDGE * c->unit ? 0.7f : 0.3f) * length;
}

/* The mean of a segment's samples. */
static float mean_hard(const dp_detail *c, const dp_line_trait *t) {
    float sum = 0;
    for (uint32_t i = t->first; i < t->end; i++) sum += c->own->samples[i].hard;
    return sum / (float)(t->end - t->first);
}

/* A segment's evidence for its whole chain to be an outline: smaller gaps will do. */
static float outline_length(const dp_detail *c, const dp_line_trait *t) {
    float sum = 0;
    for (uint32_t i = t->first; i < t->end; i++)
        sum += dp_smooth_step(2, 8, c->own->samples[i].gap);
    return sum * t->length / (float)(t->end - t->first);
}

static void judge_chain(const dp_detail *c, uint32_t number) {
    const dp_chain *const chain = &c->own->chains.chains[number];
    const dp_link *const links = dp_links_of(c, chain);
    float hard = 0, outline = 0, regular = 0;
    for (uint32_t i = 0; i < chain->count; i++) {
        dp_line_trait *const t = &c->own->trait[links[i].segment];
        t->chain = number;
        t->hard = mean_hard(c, t);
        hard += t->hard * t->length;
        regular += dp_maxf(2 * t->regular - 1, 0) * t->length;
        if (c->lines->strokes[links[i].segment].line == DP_LINE_SILHOUETTE)
            outline += outline_length(c, t);
    }
    for (uint32_t i = 0; i < chain->count; i++) {
        dp_line_trait *const t = &c->own->trait[links[i].segment];
        t->drawn = dp_is_hard(c, hard) || (chain->count >= FEW && regular > LONG * c->unit);
        t->weight = dp_smooth_step(40 * c->unit, 80 * c->unit, outline);
    }
}

/* Does a chain's end lie at another chain that is drawn, or does it go on behind something? */
static bool is_held(const dp_detail *c, const dp_link *link, bool last) {
    const uint32_t end = 2 * link->segment + (link->reversed != last),
                   chain = c->own->trait[link->segment].chain;
    const dp_line_end why = c->lines->segments[link->segment].end[end & 1];
    /* a hidden line that ends so becomes visible there, or has another level: crumbs do, too */
    const dp_stroke *const s = &c->lines->strokes[link->segment];
    if (why == DP_END_HIDDEN && (!s->level || s->turn > 60)) return true;
    if (why == DP_END_PICTURE) return true;
    uint32_t e =
        dp_first_end_at(&c->own->chains, c->lines->strokes, c->count, &dp_detail_rule, end);
    for (; e != UINT32_MAX; e = dp_next_end_at(&c->own->chains, e)) {
        const dp_line_trait *const t = &c->own->trait[e / 2];
        if (t->chain != chain && (t->drawn || c->own->samples[t->first].outline > 1)) return true;
    }
    return false;
}

/* Draws a chain that lies between others that are drawn, if it is good all along. Returns whether it
 * changes. */
static bool hold_chain(const dp_detail *c, const dp_chain *chain) {
    const dp_link *const links = dp_links_of(c, chain);
    float hard = 0, length = 0;
    if (c->own->trait[links->segment].drawn) return false;
    for (uint32_t i = 0; i < chain->count; i++) {
        const dp_line_trait *const t = &c->own->trait[links[i].segment];
        hard += t->hard * t->length, length += t->length;
    }
    if (!dp_is_good(c, hard, length)) return false;
    if (!chain->closed && !(is_held(c, links, false) && is_held(c, links + chain->count - 1, true)))
        return false;
    for (uint32_t i = 0; i < chain->count; i++) c->own->trait[links[i].segment].drawn = true;
    return true;
}

void dp_judge_chains(dp_detail *c) {
    enum { PASSES = 4 };
    const dp_chain_store *const store = &c->own->chains;
    bool any = true;
    for (uint32_t i = 0; i < store->chain_count; i++) judge_chain(c, i);
    for (int pass = 0; pass < PASSES && any; pass++) {
        any = false;
        for (uint32_t i = 0; i < store->chain_count; i++)
            if (hold_chain(c, &store->chains[i])) any = true;
    }
}
