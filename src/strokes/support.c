/* What support the samples of outlines have: the evidence of all samples near by, weighted by how well
 * one smooth curve runs through both, as in tensor voting (Guy and Medioni 1996). A crumb has little more than its
 * own length; where an outline is broken into pieces, these support each other.
 *
 * Data structure: what samples give, sorted by cell of a grid as wide as the neighbourhood. Invariant:
 * within a cell they are in the order of samples, so that sums do not depend on threads. */
#include "strokes/detail_parts.h"

#include "strokes/evidence.h"

#include <string.h>

static const float NEIGHBOURHOOD = 24; /* px from which a sample has support */

/* px; not so small that cells are more than what lies in them. */
static float cell_size(const dp_detail *c) { return dp_maxf(NEIGHBOURHOOD * c->unit, 8); }

static uint32_t cell_along(const dp_detail *c, float px, uint32_t count) {
    const float cell = px / cell_size(c);
    return !(cell > 0) ? 0 : cell >= (float)count ? count - 1 : (uint32_t)cell;
}

static uint32_t cell_of(const dp_detail *c, const dp_line_sample *s) {
    return cell_along(c, s->y, c->rows) * c->columns + cell_along(c, s->x, c->columns);
}

/* Sorts what outlines' samples give by cell of the picture: those of cell i are voters [cells[i],
 * cells[i + 1]). */
static bool sort_voters(dp_detail *c) {
    dp_detail_store *const own = c->own;
    c->columns = (uint32_t)(c->frame->view.width / (double)cell_size(c)) + 1;
    c->rows = (uint32_t)(c->frame->view.height / (double)cell_size(c)) + 1;
    const size_t cells = (size_t)c->columns * c->rows;
    if (!dp_reserve(c->frame->memory, &own->cells, &own->cells_cap, cells + 2,
                    sizeof *own->cells) ||
        !dp_reserve(c->frame->memory, &own->voters, &own->voters_cap, c->sample_count,
                    sizeof *own->voters))
        return false;
    memset(own->cells, 0, (cells + 2) * sizeof *own->cells);
    for (uint32_t i = 0; i < c->sample_count; i++)
        if (own->samples[i].outline > 0) own->cells[cell_of(c, &own->samples[i]) + 2]++;
    for (size_t i = 2; i < cells + 2; i++) own->cells[i] += own->cells[i - 1];
    for (uint32_t i = 0; i < c->sample_count; i++) {
        const dp_line_sample *const s = &own->samples[i];
        if (!(s->outline > 0)) continue;
        own->voters[own->cells[cell_of(c, s) + 1]++] =
            (dp_voter){s->x, s->y, {s->along[0], s->along[1]}, s->length * s->outline};
    }
    return true;
}

/* How much of its evidence a sample gives to another: more the nearer it is, and the better one circle
 * touches both; none beside it, so that what runs along a rim has nothing of the rim's. */
static float support_from(const dp_line_sample *s, const dp_voter *from, float reach, float unit) {
    const float beside = 1.5f * unit;
    const float dx = from->x - s->x, dy = from->y - s->y, square = dx * dx + dy * dy;
    if (square >= reach * reach) return 0;
    const float cosine = s->along[0] * from->along[0] + s->along[1] * from->along[1],
                sign = cosine < 0 ? -1 : 1;
    const float off = s->along[0] * dy - s->along[1] * dx,
                off_from = sign * (from->along[0] * dy - from->along[1] * dx);
    /* on a circle the two are equal and opposite: half their sum is how far the lines miss, half
     * their difference how far they turn */
    const float miss = (off + off_from) / 2, turn = (off - off_from) / 2;
    const float most_miss = beside * beside + 0.03f * square, most_turn = 0.5f * square + 1e-6f;
    if (miss * miss >= most_miss || turn * turn >= most_turn) return 0;
    const float near = 1 - square / (reach * reach);
    return from->evidence * near * near * sign * cosine * (1 - miss * miss / most_miss) *
           (1 - turn * turn / most_turn);
}

/* More than enough changes nothing, and is not counted: nearest cells first. */
static float support_of(const dp_detail *c, const dp_line_sample *s) {
    static const int8_t cells[9][2] = {{0, 0},   {-1, 0}, {1, 0},  {0, -1}, {0, 1},
                                       {-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
    const uint32_t x = cell_along(c, s->x, c->columns), y = cell_along(c, s->y, c->rows);
    const float reach = NEIGHBOURHOOD * c->unit, enough = DP_FULL_SUPPORT * c->unit;
    float sum = 0;
    for (uint32_t k = 0; k < 9 && sum < enough; k++) {
        const uint32_t column = x + (uint32_t)cells[k][0], row = y + (uint32_t)cells[k][1];
        if (column >= c->columns || row >= c->rows) continue; /* below 0, too */
        const uint32_t *const cell = c->own->cells + row * c->columns + column;
        for (uint32_t i = cell[0]; i < cell[1] && sum < enough; i++)
            sum += support_from(s, &c->own->voters[i], reach, c->unit);
    }
    return sum / c->unit;
}

static void support_block(void *arg, uint32_t index, uint32_t worker) {
    const dp_detail *const c = arg;
    const uint32_t first = index * DP_DETAIL_BLOCK;
    (void)worker;
    for (uint32_t i = first; i < first + DP_DETAIL_BLOCK && i < c->sample_count; i++)
        if (c->own->samples[i].outline > 0)
            c->own->samples[i].support = support_of(c, &c->own->samples[i]);
}

bool dp_find_support(dp_detail *c) {
    if (!sort_voters(c)) return false;
    dp_in_blocks(c, c->sample_count, support_block);
    return true;
}
