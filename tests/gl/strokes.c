/* Lines of the CPU's on the device. */
#include "gl/strokes.h"

#include "draw/context.h"
#include "gl/ink.h"
#include "gl/scene.h"
#include "gl/surface.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* What the device keeps of a stroke: where it is, its class, and the triangles beside it that are seen. */
static dp_gl_segment record_of(const dp_stroke *s, const dp_piece *piece) {
    dp_gl_segment out = {.a = {s->a.x, s->a.y, s->a.d},
                         .line = s->line,
                         .b = {s->b.x, s->b.y, s->b.d},
                         .triangle = piece->a,
                         .other = piece->b,
                         .edge = piece->edge};
    for (int k = 0; k < 2; k++)
        if (!isnan(s->plane[k][0])) out.seen |= 1u << k;
    return out;
}

static void upload(dp_gl *gl, const dp_lines *lines) {
    dp_gl_segment *const records = malloc((lines->count + 1) * sizeof *records);
    const dp_gl_counters counters = {.segments = (uint32_t)lines->count};
    for (size_t i = 0; i < lines->count; i++)
        records[i] = record_of(&lines->strokes[i], &lines->pieces[i]);
    assert_int_equal(dp_gl_buffer_fill(gl, &gl->lines.segments, records,
                                       lines->count * sizeof *records, "segments", NULL),
                     DP_OK);
    assert_int_equal(
        dp_gl_buffer_fill(gl, &gl->lines.counters, &counters, sizeof counters, "counters", NULL),
        DP_OK);
    free(records);
}

static uint8_t *draw_gpu(gl_test *t, dp_source *source, const dp_camera *camera,
                         const dp_style *style, const dp_gl_target *target, const dp_lines *lines,
                         dp_gl_mesh **kept) {
    dp_gl *const gl = t->gl;
    uint8_t *const rgba = malloc((size_t)4 * target->width * target->height);
    dp_gl_mesh *mesh = NULL;
    dp_gl_state *state = NULL;
    dp_diag diag = {0};
    dp_style flat = *style;
    flat.lines = DP_NO_LINES;
    dp_result result = dp_gl_mesh_from_source(gl, source, &mesh, &diag);
    if (!result) result = dp_gl_draw(gl, &mesh, 1, camera, &flat, target, &diag);
    if (!result) result = dp_gl_enter(gl, &state, &diag);
    assert_int_equal(result, DP_OK);
    assert_int_equal(dp_style_resolve(style, &gl->style, &diag), DP_OK);
    result = dp_gl_upload_block(gl, &diag);
    upload(gl, lines);
    if (!result) result = dp_gl_ink_strokes(gl, &diag);
    if (!result) result = dp_gl_show(gl, &diag);
    if (!result) result = dp_gl_check(gl, "inking", &diag);
    dp_gl_leave(gl, state);
    if (!result) result = dp_gl_read(gl, target, rgba, 0, &diag);
    if (result) fprintf(stderr, "%s\n", diag.message);
    assert_int_equal(result, DP_OK);
    if (kept)
        *kept = mesh;
    else
        dp_gl_mesh_destroy(mesh);
    return rgba;
}

void strokes_draw_both(gl_test *t, dp_source *source, const dp_camera *camera,
                       const dp_style *style, const dp_gl_target *target, uint8_t **cpu,
                       uint8_t **gpu, dp_gl_mesh **kept) {
    const dp_target to = {.width = target->width,
                          .height = target->height,
                          .samples = target->samples,
                          .rgba = malloc((size_t)4 * target->width * target->height)};
    dp_context *context;
    dp_diag diag = {0};
    assert_int_equal(dp_context_create(NULL, &context, &diag), DP_OK);
    if (dp_draw(context, source, camera, style, &to, &diag)) fail_msg("%s", diag.message);
    *cpu = to.rgba;
    *gpu = draw_gpu(t, source, camera, style, target, &context->drawing, kept);
    dp_context_destroy(context);
}
