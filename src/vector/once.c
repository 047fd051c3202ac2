/* A picture's lines without what lies on others on the screen (coincide.c): where strokes have gaps,
 * dashes that lie on other dashes would fill them.
 *
 * Invariant: what is kept is in the order of the segments that it is of, and has their bits where it
 * is not cut. */
#include "vector/once.h"

#include "core/spine.h"
#include "vector/clean.h"

static dp_point mix_points(dp_point a, dp_point b, double t) {
    const dp_pointd p = dp_point_mix((dp_pointd){(double)a.x, (double)a.y, (double)a.d},
                                     (dp_pointd){(double)b.x, (double)b.y, (double)b.d}, t);
    return (dp_point){(float)p.x, (float)p.y, (float)p.d};
}

/* Puts part i at place i: its segment, with other ends where it is cut. */
static void put_part(const dp_cleaning *c, uint32_t i, const dp_lines *from, dp_lines *to) {
    const dp_part *const part = &c->parts[i];
    const dp_stroke *const whole = &from->strokes[part->segment];
    to->pieces[i] = from->pieces[part->segment];
    to->segments[i] = from->segments[part->segment];
    to->strokes[i] = *whole;
    for (int k = 0; k < 2; k++) {
        if (!dp_is_cut(c, 2 * i + (uint32_t)k)) continue;
        const dp_path_point p = dp_part_point(c, 2 * i + (uint32_t)k);
        float *const at = k ? to->segments[i].b : to->segments[i].a;
        double *const world = k ? to->segments[i].world_b : to->segments[i].world_a;
        at[0] = p.x, at[1] = p.y, at[2] = p.distance;
        for (int m = 0; m < 3; m++) world[m] = p.world[m];
        *(k ? &to->strokes[i].b : &to->strokes[i].a) = mix_points(whole->a, whole->b, part->at[k]);
    }
}

bool dp_lines_once(const dp_frame *frame, dp_lines *from, dp_lines *to, dp_pool *pool) {
    const dp_allocator memory = dp_pool_allocator(pool, frame->memory);
    dp_sort_segments(from);
    const dp_drawn drawn = {.segments = from->segments,
                            .count = from->count,
                            .width = frame->target.width,
                            .height = frame->target.height,
                            .perspective = frame->view.perspective,
                            .focal = frame->view.focal};
    dp_cleaning c = {.memory = &memory, .drawn = &drawn, .nearer_first = true};
    bool ok = from->count <= DP_MOST_PARTS && dp_find_parts(&c) && dp_drop_coincident(&c);
    ok =
        ok &&
        dp_reserve(frame->memory, &to->pieces, &to->pieces_cap, c.part_count, sizeof *to->pieces) &&
        dp_reserve(frame->memory, &to->segments, &to->segments_cap, c.part_count,
                   sizeof *to->segments) &&
        dp_reserve(frame->memory, &to->strokes, &to->strokes_cap, c.part_count,
                   sizeof *to->strokes);
    for (uint32_t i = 0; ok && i < c.part_count; i++) put_part(&c, i, from, to);
    to->count = ok ? c.part_count : 0;
    to->chained = to->inks_hidden = false;
    to->stylizes = from->stylizes, to->lies_outside = from->lies_outside, to->lit = from->lit;
    to->patterned = from->patterned;
    to->silhouette_width = from->silhouette_width;
    to->paper = from->paper, to->surface = from->surface;
    to->hidden_look = from->hidden_look;
    dp_cleaning_free(&c);
    return ok;
}
