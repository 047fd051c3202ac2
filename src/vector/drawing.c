/* From a picture's lines to a cleaned drawing, and what it tells of itself. */
#include "vector/drawing.h"

#include "base/diag.h"
#include "sink/raster.h"

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

/* The point at which a segment begins in its chain, or ends. */
static dp_path_point point_of(const dp_segment *s, int end) {
    const float *const at = end ? s->b : s->a;
    const double *const world = end ? s->world_b : s->world_a;
    return (dp_path_point){at[0], at[1], at[2], s->edge, s->polygon, {world[0], world[1], world[2]}};
}

static float length_of(const dp_drawing *d, const dp_stored_path *p) {
    double sum = 0;
    for (size_t i = 0; i + !p->closed < p->count; i++) {
        const dp_path_point *const a = &d->points[p->first + i],
                            *const b = &d->points[p->first + (i + 1) % p->count];
        const double x = (double)b->x - (double)a->x, y = (double)b->y - (double)a->y;
        sum += sqrt(x * x + y * y);
    }
    return (float)sum;
}

static void put_chain(dp_drawing *d, const dp_lines *lines, const dp_chain *chain) {
    const dp_link *const links = lines->chains.links + chain->first;
    const dp_segment *const head = &lines->segments[links->segment],
                     *const tail = &lines->segments[links[chain->count - 1].segment];
    const int start = links->reversed, end = !links[chain->count - 1].reversed;
    dp_stored_path *const p = &d->paths[d->info.paths++];
    *p = (dp_stored_path){.line = head->line,
                          .level = head->level,
                          .group = head->group,
                          .width = head->width,
                          .color = head->color,
                          .closed = chain->closed,
                          .end = {head->end[start], tail->end[end]},
                          .hider = {head->hider[start], tail->hider[end]},
                          .first = d->info.points,
                          .count = chain->count + !chain->closed};
    for (uint32_t i = 0; i < chain->count; i++)
        d->points[d->info.points++] =
            point_of(&lines->segments[links[i].segment], links[i].reversed);
    if (!chain->closed) d->points[d->info.points++] = point_of(tail, end);
    if (!chain->closed) d->points[d->info.points - 1].polygon = UINT64_MAX;
    p->length = length_of(d, p);
    d->info.length += (double)p->length;
}

static bool put_chains(dp_drawing *d, const dp_lines *lines) {
    const uint32_t count = lines->chains.chain_count;
    if (!dp_reserve(&d->memory, &d->paths, &d->paths_cap, count, sizeof *d->paths) ||
        !dp_reserve(&d->memory, &d->points, &d->points_cap, lines->count + count,
                    sizeof *d->points))
        return false;
    for (int k = 0; k < DP_LINE_COUNT; k++)
        for (uint32_t c = 0; c < count; c++) {
            const dp_chain *const chain = &lines->chains.chains[c];
            if (lines->segments[lines->chains.links[chain->first].segment].line == dp_layers[k])
                put_chain(d, lines, chain);
        }
    return true;
}

dp_result dp_drawing_make(const dp_lines *lines, uint32_t width, uint32_t height,
                          const dp_drawing_desc *desc, const dp_allocator *memory, dp_drawing **out,
                          dp_diag *diag) {
    dp_drawing *const d = dp_alloc_zeroed(memory, sizeof *d);
    (void)desc;
    if (!d) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a drawing");
    d->memory = *memory;
    d->info = (dp_drawing_info){
        .width = width, .height = height, .paper = lines->paper, .segments = lines->count};
    if (!put_chains(d, lines)) {
        dp_drawing_destroy(d);
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a drawing");
    }
    *out = d;
    return DP_OK;
}
