/* Which chains of a drawing are hard edges, and drawn whatever they look like in places.
 *
 *     a chain has enough evidence     it is drawn, however much it weakens on its way
 *     it lies between two that are drawn, or goes on behind something, and is good all along
 *                                     it is drawn, too; again until nothing changes
 *
 * So the small parts of machines stay, which hang together, and crumbs of a scan do not.
 *
 * Data structure: rings of ends that have the same bits, through `rings`. Invariant: chains are gone
 * through in their order, and once one is drawn, it stays so; nothing depends on hashes. */
#include "strokes/detail_parts.h"

#include "strokes/evidence.h"

#include <string.h>

static const float ENOUGH = 24 /* evidence of a hard edge that a chain needs */,
                   CRUMB = 8 /* shorter chains between others are not drawn for their sake */;

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
    float hard = 0, outline = 0;
    for (uint32_t i = 0; i < chain->count; i++) {
        dp_line_trait *const t = &c->own->trait[links[i].segment];
        t->chain = number;
        t->hard = mean_hard(c, t);
        hard += t->hard * t->length;
        if (c->lines->strokes[links[i].segment].line == DP_LINE_SILHOUETTE)
            outline += outline_length(c, t);
    }
    for (uint32_t i = 0; i < chain->count; i++) {
        dp_line_trait *const t = &c->own->trait[links[i].segment];
        t->drawn = hard > ENOUGH * c->unit;
        t->weight = dp_smooth_step(40 * c->unit, 80 * c->unit, outline);
    }
}

static uint32_t hash_of(dp_point p) {
    uint32_t bits[3];
    memcpy(bits, &p, sizeof bits);
    uint32_t h = bits[0] * 0x9e3779b1u ^ bits[1] * 0x85ebca77u ^ bits[2] * 0xc2b2ae3du;
    h ^= h >> 15, h *= 0x2c1b3c6du;
    return h ^ h >> 13;
}

static dp_point end_point(const dp_detail *c, uint32_t end) {
    const dp_stroke *const s = &c->lines->strokes[end / 2];
    return end & 1 ? s->b : s->a;
}

/* Makes rings of the ends that have equal bits: 2 i at a of segment i, 2 i + 1 at b. */
static bool find_rings(const dp_detail *c) {
    dp_detail_store *const own = c->own;
    size_t slots = 64;
    while (slots < 4 * (size_t)c->count) slots *= 2;
    if (!dp_reserve(c->frame->memory, &own->rings, &own->rings_cap, 2 * (size_t)c->count,
                    sizeof *own->rings) ||
        !dp_reserve(c->frame->memory, &own->cells, &own->cells_cap, slots, sizeof *own->cells))
        return false;
    memset(own->cells, 0, slots * sizeof *own->cells);
    for (uint32_t e = 0; e < 2 * c->count; e++) {
        const dp_point p = end_point(c, e);
        size_t at = hash_of(p) & (slots - 1);
        for (; own->cells[at]; at = (at + 1) & (slots - 1)) {
            const dp_point q = end_point(c, own->cells[at] - 1);
            if (p.x == q.x && p.y == q.y && p.d == q.d) break;
        }
        const uint32_t other = own->cells[at] ? own->cells[at] - 1 : e;
        own->rings[e] = other == e ? e : own->rings[other];
        own->rings[other] = e;
        own->cells[at] = other + 1;
    }
    return true;
}

/* Does a chain's end lie at another chain that is drawn, or does it go on behind something? */
static bool is_held(const dp_detail *c, const dp_link *link, bool last) {
    const uint32_t end = 2 * link->segment + (link->reversed != last),
                   chain = c->own->trait[link->segment].chain;
    const dp_line_end why = c->lines->segments[link->segment].end[end & 1];
    if (why == DP_END_HIDDEN || why == DP_END_PICTURE) return true;
    for (uint32_t e = c->own->rings[end]; e != end; e = c->own->rings[e]) {
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
    if (length < CRUMB * c->unit || hard < 0.7f * length) return false;
    if (!chain->closed && !(is_held(c, links, false) && is_held(c, links + chain->count - 1, true)))
        return false;
    for (uint32_t i = 0; i < chain->count; i++) c->own->trait[links[i].segment].drawn = true;
    return true;
}

bool dp_judge_chains(dp_detail *c) {
    enum { PASSES = 4 };
    const dp_chain_store *const store = &c->own->chains;
    bool any = true;
    if (!find_rings(c)) return false;
    for (uint32_t i = 0; i < store->chain_count; i++) judge_chain(c, i);
    for (int pass = 0; pass < PASSES && any; pass++) {
        any = false;
        for (uint32_t i = 0; i < store->chain_count; i++)
            if (hold_chain(c, &store->chains[i])) any = true;
    }
    return true;
}
