/* From a picture's segments to a cleaned drawing, and what it tells of itself.
 *
 *     find the parts of segments that are drawn: what lies on each other once (coincide.c)
 *     join their ends: where they are equal (nodes.c), then over gaps (gaps.c)
 *     find the chains, in the order of their layers (strands.c)
 *     write each as a path: without folds (unfold.c), its points without those that change nothing
 *         (simplify.c); what is short then is dropped
 *     order the paths for a pen (order.c)
 *
 * All of it is done by one thread, in the order of the segments: so a drawing depends on them
 * alone. */
#include "vector/join.h"

#include "base/diag.h"
#include "strokes/hidden.h"

#include <math.h>

static const dp_array arrays[] = {DP_ARRAY(struct dp_drawing, paths, paths_cap),
                                  DP_ARRAY(struct dp_drawing, points, points_cap)};

void dp_drawing_destroy(dp_drawing *drawing) {
    if (!drawing) return;
    const dp_allocator memory = drawing->memory;
    dp_arrays_free(&memory, drawing, DP_ARRAYS(arrays));
    dp_free(&memory, drawing);
}

void dp_drawing_info_of(const dp_drawing *drawing, dp_drawing_info *info) {
    if (!info) return;
    *info = drawing ? drawing->info : (dp_drawing_info){0};
    if (drawing) info->bytes = sizeof *drawing + dp_arrays_bytes(drawing, DP_ARRAYS(arrays));
}

bool dp_drawing_path(const dp_drawing *drawing, size_t index, dp_path *path) {
    if (!drawing || !path || index >= drawing->info.paths) return false;
    const dp_stored_path *const p = &drawing->paths[index];
    *path = (dp_path){.line = p->line,
                      .level = p->level,
                      .group = p->group,
                      .width = p->width,
                      .color = p->color,
                      .dash = {p->dash[0], p->dash[1]},
                      .closed = p->closed,
                      .end = {p->end[0], p->end[1]},
                      .hider = {p->hider[0], p->hider[1]},
                      .points = drawing->points + p->first,
                      .count = p->count,
                      .length = p->length};
    return true;
}

/* ------- desc ------- */

static float or_default(float value, float standard) { return value == 0 ? standard : value; }

static dp_drawing_desc resolve(const dp_drawing_desc *desc) {
    dp_drawing_desc full = desc ? *desc : (dp_drawing_desc){0};
    full.join = or_default(full.join, 2);
    full.min_length = or_default(full.min_length, 1);
    full.tolerance = or_default(full.tolerance, 0.02f);
    return full;
}

static bool is_sound(const dp_drawing_desc *desc) {
    return !desc ||
           (isfinite(desc->join) && isfinite(desc->min_length) && isfinite(desc->tolerance));
}

/* ------- paths ------- */

static bool put_point(dp_drawing *d, const dp_path_point *point) {
    if (!dp_reserve(&d->memory, &d->points, &d->points_cap, d->info.points + 1, sizeof *d->points))
        return false;
    d->points[d->info.points++] = *point;
    return true;
}

/* Puts the points of a chain, with both ends of each gap; a closed one's first is not repeated. */
static bool put_points(dp_drawing *d, const dp_cleaning *c, const dp_strand *strand) {
    uint32_t end = strand->start;
    for (;;) {
        const dp_path_point from = dp_part_point(c, end);
        if (!put_point(d, &from)) return false;
        const uint32_t next = c->partner[end ^ 1];
        dp_path_point to = dp_part_point(c, end ^ 1);
        to.polygon = UINT64_MAX, to.edge = UINT32_MAX;
        if (next != DP_NOWHERE) {
            const dp_point on = dp_part_end(c, next);
            if ((on.x != to.x || on.y != to.y) && !put_point(d, &to)) return false;
        } else if (!put_point(d, &to)) {
            return false;
        }
        if (next == DP_NOWHERE || next == strand->start) return true;
        end = next;
    }
}

static double length_of(const dp_path_point *points, size_t count, bool closed) {
    double sum = 0;
    for (size_t i = 0; i + !closed < count; i++) {
        const dp_path_point *const a = &points[i], *const b = &points[(i + 1) % count];
        sum += dp_hypot((double)b->x - (double)a->x, (double)b->y - (double)a->y);
    }
    return sum;
}

/* `moved`: the path does not go to the end of its segment. */
static void put_end(const dp_cleaning *c, uint32_t end, bool moved, dp_stored_path *p, int k) {
    const dp_segment *const s = dp_segment_at(c, end);
    const bool other = dp_is_cut(c, end) || moved || p->closed;
    p->end[k] = other ? DP_END_VERTEX : s->end[end & 1];
    p->hider[k] = other ? UINT64_MAX : s->hider[end & 1];
}

static uint32_t last_end(const dp_cleaning *c, uint32_t start) {
    uint32_t end = start;
    while (c->partner[end ^ 1] != DP_NOWHERE && c->partner[end ^ 1] != start)
        end = c->partner[end ^ 1];
    return end ^ 1;
}

static bool put_path(dp_drawing *d, const dp_cleaning *c, const dp_strand *strand) {
    const size_t first = d->info.points;
    const dp_segment *const head = dp_segment_at(c, strand->start);
    if (!put_points(d, c, strand)) return false;
    dp_path_point *const points = d->points + first;
    size_t count = d->info.points - first;
    bool moved[2] = {false, false};
    const double drawn = length_of(points, count, strand->closed);
    if (!c->desc.keep_coincident) count = dp_unfold(points, count, strand->closed, moved);
    const double whole = length_of(points, count, strand->closed);
    d->info.coincident += drawn - whole;
    count = dp_simplify(points, count, strand->closed, c->desc.tolerance);
    const double length = length_of(points, count, strand->closed);
    d->info.points = first + count;
    if (count < 2 || length < (double)c->desc.min_length) {
        d->info.points = first;
        d->info.dropped++, d->info.dropped_length += whole;
        return true;
    }
    if (!dp_reserve(&d->memory, &d->paths, &d->paths_cap, d->info.paths + 1, sizeof *d->paths))
        return false;
    dp_stored_path *const p = &d->paths[d->info.paths++];
    *p = (dp_stored_path){.line = strand->line,
                          .level = head->level,
                          .group = head->group,
                          .width = head->width,
                          .length = (float)length,
                          .color = head->color,
                          .closed = strand->closed,
                          .first = first,
                          .count = count};
    if (p->level) (void)dp_hidden_dash(c->drawn->hidden_look, p->width, p->dash);
    put_end(c, strand->start, moved[0], p, 0);
    put_end(c, last_end(c, strand->start), moved[1], p, 1);
    d->info.length += length;
    if (p->level > d->info.levels) d->info.levels = p->level;
    return true;
}

/* ------- the story ------- */

static bool clean(dp_drawing *d, dp_cleaning *c) {
    bool ok = dp_find_parts(c) && (c->desc.keep_coincident || dp_drop_coincident(c)) &&
              dp_join_nodes(c, -2) && dp_join_gaps(c) && dp_find_strands(c);
    for (uint32_t i = 0; ok && i < c->strand_count; i++) ok = put_path(d, c, &c->strands[i]);
    d->info.coincident += c->coincident;
    d->info.joined = c->joined;
    d->info.joined_length = c->joined_length;
    dp_cleaning_free(c);
    return ok;
}

dp_result dp_drawing_make(const dp_drawn *drawn, const dp_drawing_desc *desc,
                          const dp_allocator *memory, dp_drawing **out, dp_diag *diag) {
    *out = NULL;
    if (!is_sound(desc))
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_drawing_desc: a number is not finite");
    if (drawn->count > DP_MOST_PARTS)
        return dp_fail(diag, DP_ERR_LIMIT, "%zu segments are more than a drawing takes",
                       drawn->count);
    dp_drawing *const d = dp_alloc_zeroed(memory, sizeof *d);
    if (!d) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a drawing");
    dp_cleaning c = {.memory = memory, .drawn = drawn, .desc = resolve(desc)};
    d->memory = *memory;
    d->info = (dp_drawing_info){.width = drawn->width,
                                .height = drawn->height,
                                .paper = drawn->paper,
                                .segments = drawn->count};
    if (!clean(d, &c) || !dp_order_paths(d, c.desc.optimize)) {
        dp_drawing_destroy(d);
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a drawing of %zu segments",
                       drawn->count);
    }
    *out = d;
    return DP_OK;
}
