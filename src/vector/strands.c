/* Parts and their ends, and the chains that joined parts make, in the order in which they are drawn
 * without `optimize`: layer by layer, and in each by their first part. */
#include "vector/clean.h"

#include "base/sort.h"
#include "sink/raster.h"

#include <math.h>
#include <string.h>

static const dp_array arrays[] = {DP_ARRAY(dp_cleaning, parts, parts_cap),
                                  DP_ARRAY(dp_cleaning, partner, partner_cap),
                                  DP_ARRAY(dp_cleaning, strands, strands_cap)};

void dp_cleaning_free(dp_cleaning *c) { dp_arrays_free(c->memory, c, DP_ARRAYS(arrays)); }

/* ------- ends ------- */

static float mix(float a, float b, double t) {
    return (float)((double)a + ((double)b - (double)a) * t);
}

/* In perspective 1 / distance is what grows evenly along a line on the screen. */
static double share_in_space(const dp_cleaning *c, const dp_segment *s, double at) {
    if (!c->drawn->perspective || !(s->a[2] > 0) || !(s->b[2] > 0)) return at;
    const double a = (1 - at) / (double)s->a[2], b = at / (double)s->b[2];
    return b / (a + b);
}

dp_point dp_cut_end(const dp_cleaning *c, uint32_t end) {
    const dp_part *const part = &c->parts[end / 2];
    const dp_segment *const s = &c->drawn->segments[part->segment];
    const double at = part->at[end & 1];
    return (dp_point){mix(s->a[0], s->b[0], at), mix(s->a[1], s->b[1], at),
                      mix(s->a[2], s->b[2], share_in_space(c, s, at))};
}

dp_path_point dp_part_point(const dp_cleaning *c, uint32_t end) {
    const dp_segment *const s = dp_segment_at(c, end);
    const dp_point p = dp_part_end(c, end);
    const double at = share_in_space(c, s, c->parts[end / 2].at[end & 1]);
    dp_path_point out = {
        .x = p.x, .y = p.y, .distance = p.d, .edge = s->edge, .polygon = s->polygon};
    for (int i = 0; i < 3; i++)
        out.world[i] = at <= 0   ? s->world_a[i]
                       : at >= 1 ? s->world_b[i]
                                 : s->world_a[i] + (s->world_b[i] - s->world_a[i]) * at;
    return out;
}

bool dp_find_parts(dp_cleaning *c) {
    const dp_drawn *const drawn = c->drawn;
    if (!dp_reserve(c->memory, &c->parts, &c->parts_cap, drawn->count, sizeof *c->parts))
        return false;
    for (size_t i = 0; i < drawn->count; i++) {
        const dp_segment *const s = &drawn->segments[i];
        if (s->a[0] != s->b[0] || s->a[1] != s->b[1])
            c->parts[c->part_count++] = (dp_part){.at = {0, 1}, .segment = (uint32_t)i};
    }
    return true;
}

/* ------- chains ------- */

/* The end at which the chain through a part begins; that of the part itself where it is closed. */
static uint32_t find_start(const dp_cleaning *c, uint32_t part, bool *closed) {
    uint32_t end = 2 * part; /* going backwards */
    *closed = false;
    while (c->partner[end] != DP_NOWHERE) {
        end = c->partner[end] ^ 1;
        if (end != 2 * part) continue;
        *closed = true;
        return end;
    }
    return end;
}

static double length_of(const dp_cleaning *c, uint32_t part) {
    const dp_point p = dp_part_end(c, 2 * part), q = dp_part_end(c, 2 * part + 1);
    return dp_hypot((double)p.x - (double)q.x, (double)p.y - (double)q.y);
}

/* Marks a chain's parts; the class that most of its length has. */
static dp_line walk(const dp_cleaning *c, uint32_t start, uint8_t *visited, float *length) {
    double lengths[DP_LINE_COUNT] = {0};
    uint32_t end = start;
    do {
        visited[end / 2] = 1;
        lengths[dp_segment_at(c, end)->line] += length_of(c, end / 2);
        end = c->partner[end ^ 1];
    } while (end != DP_NOWHERE && end != start);
    int most = (int)dp_segment_at(c, start)->line;
    double sum = 0;
    for (int i = 0; i < DP_LINE_COUNT; i++) {
        sum += lengths[i];
        if (lengths[i] > lengths[most]) most = i;
    }
    *length = (float)sum;
    return (dp_line)most;
}

static int rank_of(dp_line line) {
    int rank = 0;
    while (dp_layers[rank] != line) rank++;
    return rank;
}

static int by_layer(const void *left, const void *right) {
    const dp_strand *const l = left, *const r = right;
    if (l->layer != r->layer) return l->layer < r->layer ? -1 : 1;
    return (l->first > r->first) - (l->first < r->first);
}

bool dp_find_strands(dp_cleaning *c) {
    uint32_t deepest = 0;
    uint8_t *const visited = dp_alloc_zeroed(c->memory, c->part_count);
    bool ok = visited;
    for (uint32_t i = 0; i < c->part_count; i++)
        if (dp_segment_at(c, 2 * i)->level > deepest) deepest = dp_segment_at(c, 2 * i)->level;
    for (uint32_t i = 0; ok && i < c->part_count; i++) {
        if (visited[i]) continue;
        ok = dp_reserve(c->memory, &c->strands, &c->strands_cap, c->strand_count + (size_t)1,
                        sizeof *c->strands);
        if (!ok) break;
        dp_strand *const s = &c->strands[c->strand_count++];
        s->first = i, s->start = find_start(c, i, &s->closed);
        s->line = walk(c, s->start, visited, &s->length);
        s->level = dp_segment_at(c, s->start)->level;
        s->layer = (deepest - s->level) * DP_LINE_COUNT + (uint32_t)rank_of(s->line);
    }
    if (ok && c->strand_count) dp_sort(c->strands, c->strand_count, sizeof *c->strands, by_layer);
    dp_free(c->memory, visited);
    return ok;
}
