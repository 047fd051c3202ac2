/* The chains of a drawing: segments in an order of their own, joined, and numbered.
 *
 *     sort pieces by polygon, edge and sample points; segments and strokes go with them
 *     join ends (chain.c): equal ones, and for stylized strokes those over small gaps
 *     tell each segment its chain, its place there and whether it is drawn from b to a
 *
 * The order of segments, and with it that of chains, depends neither on tiles nor on threads. Plain
 * ink needs no chains; so they are made when somebody asks for them, once a picture. */
#include "strokes/lines.h"

#include "base/sort.h"
#include "features/silhouette_edge.h"
#include "strokes/hidden.h"
#include "texture/texture.h"

static const float GAP =
    4; /* px; smaller holes in an outline are rounding, or a fold of a single triangle */
static const float TURN = -0.7f; /* chains do not go on at turns above 135 degrees */

static int by_edge(const void *left, const void *right) { return dp_piece_order(left, right); }

/* Puts segments and strokes into the order of the pieces, whose `geometry` says where they were. */
static void follow_pieces(dp_lines *d) {
    for (size_t start = 0; start < d->count; start++) {
        if (d->pieces[start].geometry == start) continue;
        const dp_segment segment = d->segments[start];
        const dp_stroke stroke = d->strokes[start];
        size_t at = start, from;
        while ((from = d->pieces[at].geometry) != start) {
            d->segments[at] = d->segments[from], d->strokes[at] = d->strokes[from];
            d->pieces[at].geometry = (uint32_t)at;
            at = from;
        }
        d->segments[at] = segment, d->strokes[at] = stroke;
        d->pieces[at].geometry = (uint32_t)at;
    }
}

void dp_sort_segments(dp_lines *d) {
    for (size_t i = 0; i < d->count; i++) d->pieces[i].geometry = (uint32_t)i;
    if (d->count) dp_sort(d->pieces, d->count, sizeof *d->pieces, by_edge);
    follow_pieces(d);
}

/* Which side of an extruded line is outside, for chains to keep to. */
static int8_t side_of(const dp_frame *frame, const dp_lines *d, size_t i) {
    const dp_stroke *const k = &d->strokes[i];
    double out[2] = {0, 0};
    if (!(1u << k->line & DP_OUTLINES)) return 0;
    dp_find_outside(frame, d->pieces[i].a, (dp_pointd){k->a.x, k->a.y, 0},
                    (dp_pointd){k->b.x, k->b.y, 0}, out);
    return (k->b.x - k->a.x) * out[1] - (k->b.y - k->a.y) * out[0] < 0 ? -1 : 1;
}

static bool find_sides(const dp_frame *frame, dp_lines *d) {
    if (!dp_reserve(frame->memory, &d->sides, &d->sides_cap, d->count, sizeof *d->sides))
        return false;
    for (size_t i = 0; i < d->count; i++) d->sides[i] = d->lies_outside ? side_of(frame, d, i) : 0;
    return true;
}

/* Depth d of the nearest end of any visible segment. */
static double nearest_depth(const dp_lines *d) {
    double nearest = (double)DP_DEPTH_EMPTY;
    for (size_t i = 0; i < d->count; i++)
        if (!d->strokes[i].level)
            nearest = dp_max(nearest, (double)dp_maxf(d->strokes[i].a.d, d->strokes[i].b.d));
    return nearest;
}

/* Thin extruded lines must not run over what no edge does. */
static float gap_outside(const dp_lines *d) { return dp_minf(GAP, d->silhouette_width / 4); }

/* A pattern that begins anew is seen from farther off than the gap in a wide line. */
static float gap_of(const dp_lines *d) {
    return d->patterned ? dp_maxf(GAP, d->silhouette_width / 4) : GAP;
}

/* They are chained where their ends are equal, and nowhere else. */
dp_chain_rule dp_plain_chain_rule(void) { return (dp_chain_rule){.sharpest = TURN}; }

static dp_chain_rule rule_of(const dp_frame *frame, const dp_lines *d) {
    if (!d->stylizes) return dp_plain_chain_rule();
    return (dp_chain_rule){.sharpest = TURN,
                           .any_color = d->lit,
                           .side = d->sides,
                           .gap = gap_of(d),
                           .side_gap = gap_outside(d),
                           .step = (float)dp_depth_step(&frame->view, nearest_depth(d), 30)};
}

static void number_segments(dp_lines *d) {
    for (uint32_t c = 0; c < d->chains.chain_count; c++) {
        const dp_chain *const chain = &d->chains.chains[c];
        for (uint32_t i = 0; i < chain->count; i++) {
            const dp_link *const link = &d->chains.links[chain->first + i];
            dp_segment *const s = &d->segments[link->segment];
            s->chain = c, s->place = i, s->reversed = link->reversed;
        }
    }
}

bool dp_strokes_have_gaps(const dp_frame *frame) {
    const dp_style *const style = &frame->styles[0];
    float dash[2];
    return (style->stroke.texture && style->stroke.texture->has_gaps && !dp_lies_outside(frame)) ||
           (frame->hidden && dp_hidden_dash(frame->hidden_look, 1, dash));
}

bool dp_chain_lines(const dp_frame *frame, dp_lines *d) {
    if (d->chained) return true;
    dp_sort_segments(d);
    if (d->stylizes && !find_sides(frame, d)) return false;
    const dp_chain_rule rule = rule_of(frame, d);
    if (!dp_make_chains(d->strokes, (uint32_t)d->count, &rule, frame->memory, &d->chains))
        return false;
    number_segments(d);
    return d->chained = true;
}
