/* Lines, read back from the device: segments as dp_draw finds them.
 *
 *    dp_gl_segment → a piece, a stroke and a dp_segment → sorted and chained by strokes/lines.c
 *
 * Triangles lead back to polygons of the source by what the meshes keep on the host; edges of a fan's triangles get the
 * polygon's numbers. Invariant: the order is that of polygons, edges and sample points (dp_piece_order), whatever the
 * order on the device. Not handled: groups of several meshes are not numbered anew, as dp_source_join does. */
#include "gl/lines.h"

#include "draw/context.h"
#include "strokes/lines.h"

#include <math.h>

/* A triangle of the scene: its mesh, and where that begins. */
typedef struct place {
    const dp_gl_mesh *mesh;
    uint32_t first_triangle;
    uint64_t first_polygon;
} place;

static place place_of(const dp_gl *gl, uint32_t triangle) {
    place p = {0};
    for (size_t i = 0; i < gl->scene.count; i++) {
        p.mesh = gl->scene.meshes[i];
        if (triangle - p.first_triangle < p.mesh->triangle_count) break;
        p.first_triangle += p.mesh->triangle_count, p.first_polygon += p.mesh->polygons;
    }
    return p;
}

static uint64_t source_number(const dp_gl *gl, uint32_t triangle) {
    if (triangle >= gl->scene.triangle_count) return UINT64_MAX;
    const place p = place_of(gl, triangle);
    const uint32_t at = triangle - p.first_triangle;
    return p.first_polygon + (p.mesh->source_polygon ? p.mesh->source_polygon[at] : at);
}

/* The first triangle of its polygon, which stands for that. */
static uint32_t first_of(const dp_gl *gl, uint32_t triangle) {
    if (triangle >= gl->scene.triangle_count) return UINT32_MAX;
    const place p = place_of(gl, triangle);
    return p.mesh->polygon_firsts
               ? p.first_triangle + p.mesh->polygon_firsts[triangle - p.first_triangle]
               : triangle;
}

/* Edge k of the polygon's triangle number i: a fan around corner 0 (mesh.c). */
static uint32_t polygon_edge(uint32_t i, uint32_t k) { return k == 0 ? 0 : i + k; }

static dp_piece piece_of(const dp_gl *gl, const dp_gl_segment *s) {
    const uint32_t a = first_of(gl, s->triangle);
    return (dp_piece){.a = a,
                      .b = first_of(gl, s->other),
                      .edge = s->edge == UINT32_MAX ? DP_CROSSING
                                                    : polygon_edge(s->triangle - a, s->edge),
                      .k0 = s->k0,
                      .k1 = s->k1,
                      .n = s->n,
                      .line = (uint8_t)s->line,
                      .seen = s->seen & 3};
}

static dp_point take_end(const dp_gl *gl, const float at[3], float screen[3], double world[3]) {
    const dp_pointd p = {(double)at[0], (double)at[1], (double)at[2]};
    const dp_vec3 w = dp_unproject(&gl->view, p);
    const double where[3] = {w.x, w.y, w.z};
    screen[0] = at[0], screen[1] = at[1], screen[2] = (float)dp_distance(&gl->view, p.d);
    for (int c = 0; c < 3; c++) world[c] = gl->scene.origin[c] + (double)(float)where[c];
    return (dp_point){at[0], at[1], at[2]};
}

/* Why a segment ends there: as in strokes/segments.c. */
static void take_line_end(const dp_gl *gl, const dp_gl_segment *s, int k, dp_segment *out) {
    const bool whole = k ? s->k1 == s->n : !s->k0;
    const double *const at = k ? out->world_b : out->world_a;
    out->hider[k] = UINT64_MAX;
    if (whole) {
        const float world[3] = {(float)(at[0] - gl->scene.origin[0]),
                                (float)(at[1] - gl->scene.origin[1]),
                                (float)(at[2] - gl->scene.origin[2])};
        out->end[k] = dp_lies_on_plane(&gl->view, world) ? DP_END_PICTURE
                      : s->edge == UINT32_MAX            ? DP_END_CROSSING
                                                         : DP_END_VERTEX;
    } else if (s->hider[k] == UINT32_MAX - 1) {
        out->end[k] = DP_END_PICTURE;
    } else {
        out->end[k] = DP_END_HIDDEN;
        out->hider[k] = source_number(gl, s->hider[k]);
    }
}

static void take_segment(const dp_gl *gl, const dp_gl_segment *s, const dp_piece *piece,
                         dp_segment *out, dp_stroke *stroke) {
    const dp_line_style *const look = &gl->style.line[s->line];
    *out = (dp_segment){.line = (dp_line)s->line,
                        .polygon = source_number(gl, s->triangle),
                        .other = source_number(gl, s->other),
                        .edge = piece->edge,
                        .group = s->seen >> 16,
                        .width = look->width,
                        .color = look->color};
    *stroke = (dp_stroke){.half_width = look->width / 2,
                          .plane = {{NAN, 0, 0}, {NAN, 0, 0}},
                          .color = look->color,
                          .line = piece->line};
    stroke->a = take_end(gl, s->a, out->a, out->world_a);
    stroke->b = take_end(gl, s->b, out->b, out->world_b);
    for (int k = 0; k < 2; k++) take_line_end(gl, s, k, out);
    stroke->stops = (uint8_t)((out->end[0] == DP_END_HIDDEN) | (out->end[1] == DP_END_HIDDEN) << 1);
}

/* The device's segments, in its order; NULL: there are none, or no memory. */
static dp_gl_segment *read_all(dp_gl *gl, size_t *count, dp_diag *diag) {
    dp_gl_counters c = {0};
    dp_gl_segment *out = NULL;
    if (gl->lines.counters.name) dp_gl_buffer_read(gl, &gl->lines.counters, 0, sizeof c, &c);
    *count = gl->stats.segments ? c.segments : 0;
    if (*count && !(out = dp_alloc_array(&gl->memory, *count, sizeof *out)))
        dp_fail(diag, DP_ERR_MEMORY, "out of memory for %zu segments", *count);
    if (out) dp_gl_buffer_read(gl, &gl->lines.segments, 0, *count * sizeof *out, out);
    return out;
}

static bool reserve(const dp_allocator *memory, dp_lines *d, size_t count) {
    return dp_reserve(memory, &d->pieces, &d->pieces_cap, count, sizeof *d->pieces) &&
           dp_reserve(memory, &d->segments, &d->segments_cap, count, sizeof *d->segments) &&
           dp_reserve(memory, &d->strokes, &d->strokes_cap, count, sizeof *d->strokes);
}

/* Fills `d`, whose memory is `memory`; neither sorted nor chained. */
static dp_result fill(dp_gl *gl, const dp_allocator *memory, dp_lines *d, dp_diag *diag) {
    size_t count;
    dp_gl_segment *const read = read_all(gl, &count, diag);
    dp_result result = count && !read ? DP_ERR_MEMORY : dp_gl_check(gl, "reading lines", diag);
    if (!result && !reserve(memory, d, count))
        result = dp_fail(diag, DP_ERR_MEMORY, "out of memory for %zu segments", count);
    d->count = result ? 0 : count;
    d->chained = d->inks_hidden = d->stylizes = d->patterned = d->lit = d->lies_outside = false;
    d->silhouette_width = gl->style.line[DP_LINE_SILHOUETTE].width;
    d->paper = gl->style.paper, d->surface = gl->style.surface;
    d->hidden_look = DP_HIDDEN_NONE;
    for (size_t i = 0; i < d->count; i++) {
        d->pieces[i] = piece_of(gl, &read[i]);
        take_segment(gl, &read[i], &d->pieces[i], &d->segments[i], &d->strokes[i]);
    }
    dp_free(&gl->memory, read);
    return result;
}

static dp_result read_lines(dp_gl *gl, const dp_allocator *memory, dp_lines *d, dp_diag *diag) {
    dp_gl_state *state;
    dp_result result = dp_gl_enter(gl, &state, diag);
    if (result) return result;
    result = dp_gl_find_hiders(gl, diag);
    if (!result) result = fill(gl, memory, d, diag);
    dp_gl_leave(gl, state);
    return result;
}

static dp_result read_once(dp_gl *gl, dp_diag *diag) {
    const dp_frame frame = {.memory = &gl->memory, .view = gl->view};
    if (gl->lines.have_read) return DP_OK;
    if (!gl->lines.read && !(gl->lines.read = dp_alloc_zeroed(&gl->memory, sizeof *gl->lines.read)))
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a drawing");
    const dp_result result = read_lines(gl, &gl->memory, gl->lines.read, diag);
    if (result) return result;
    if (!dp_chain_lines(&frame, gl->lines.read))
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for the chains of a drawing");
    gl->lines.have_read = true;
    return DP_OK;
}

dp_result dp_gl_segments(dp_gl *gl, const dp_segment **segments, size_t *count, dp_diag *diag) {
    if (!gl || !segments || !count)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_gl_segments: gl, segments or count is NULL");
    *segments = NULL, *count = 0;
    if (!gl->drawn) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_gl_segments: nothing has been drawn");
    const dp_result result = read_once(gl, diag);
    if (result) return result;
    *count = gl->lines.read->count;
    *segments = *count ? gl->lines.read->segments : NULL;
    return DP_OK;
}

/* What of a context's frame sinks and pages ask for. */
static void take_frame(const dp_gl *gl, dp_frame *f, const dp_allocator *memory,
                       dp_threads *threads) {
    f->memory = memory, f->threads = threads;
    f->view = gl->view;
    for (int k = 0; k < 3; k++) f->origin[k] = gl->scene.origin[k];
    f->target =
        (dp_target){.width = gl->target.width, .height = gl->target.height, .samples = gl->samples};
    f->styles = NULL, f->style_count = 0;
    f->lines = gl->style.lines & DP_ALL_LINES;
    f->hidden = f->xray = 0;
    f->hidden_look = DP_HIDDEN_NONE;
    f->adjacency = NULL;
}

dp_result dp_gl_hand_over(dp_gl *gl, dp_context *context, dp_diag *diag) {
    if (!gl || !context)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_gl_hand_over: gl or context is NULL");
    dp_forget_drawing(context);
    if (!gl->drawn)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_gl_hand_over: nothing has been drawn");
    const dp_result result = read_lines(gl, &context->memory, &context->drawing, diag);
    if (!result) {
        take_frame(gl, &context->frame, &context->memory, context->threads);
        context->stats = (dp_stats){.segments = context->drawing.count};
        context->inks_once = false;
        context->drawn = true;
    }
    return dp_context_settle(context, result, diag);
}

void dp_gl_read_free(dp_gl *gl) {
    if (gl->lines.read) dp_lines_free(gl->lines.read, &gl->memory);
    dp_free(&gl->memory, gl->lines.read);
    gl->lines.read = NULL, gl->lines.have_read = false;
}
