/* The depth interval in one pass, as printed (Raskar 2001, 2.3 and 2.4): faces and added polygons are drawn in the order in
 * which they come, and each is tested against what was drawn before it.
 *
 * Data structure: `states`, a word a sample: z1 and ink, changed at once by compare-and-swap in the fragment shader
 * (shaders/quads_once.frag). Fragments of one sample run in the order of their polygons where the device has
 * GL_ARB_fragment_shader_interlock, or a rasterizer that works so (llvmpipe); elsewhere in about that order, which is all that
 * the picture depends on: a valley shows on the side of the polygon that came first. */
#include "gl/quads.h"

/* What the application has drawn is there first. */
static dp_result begin(dp_gl *gl, dp_diag *diag) {
    static const dp_gl_program_desc desc = {.vertex = "whole.vert",
                                            .fragment = "quads_once_begin.frag"};
    dp_gl_quads *const q = gl->quads;
    const size_t samples = (size_t)gl->target.width * gl->target.height * gl->samples;
    uint32_t program;
    dp_result result = dp_gl_buffer_reserve(gl, &q->states, 4 * samples, "states of samples", diag);
    if (!gl->target.depth_texture) {
        if (!result) dp_gl_buffer_clear(gl, &q->states, 4 * samples, 0);
        gl->api.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
        return result;
    }
    if (!result) result = dp_gl_program(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_use(gl, program);
    dp_gl_faces_bind(gl, program);
    dp_gl_uniform_2f(gl, program, "depth_range", q->range);
    dp_gl_buffer_bind(gl, &q->states, DP_GL_BIND_OWN + 2);
    dp_gl_draw_whole(gl);
    gl->api.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    return DP_OK;
}

/* Puts a portion's polygons in order. */
static dp_result order(dp_gl *gl, const dp_gl_portions *p, uint32_t i, dp_diag *diag) {
    static const dp_gl_program_desc desc = {.compute = "quads_order.comp", .any_samples = true};
    dp_gl_quads *const q = gl->quads;
    const uint32_t all = 3 * gl->scene.triangle_count, first = i * p->edges;
    uint32_t program;
    const dp_result result = dp_gl_program(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_use(gl, program);
    dp_gl_buffer_bind(gl, &q->order, DP_GL_BIND_OWN + 1);
    dp_gl_buffer_bind(gl, &q->counts, DP_GL_BIND_OWN + 3);
    dp_gl_buffer_bind(gl, &q->commands, DP_GL_BIND_OWN + 4);
    dp_gl_uniform_u(gl, program, "edge_count", all - first < p->edges ? all - first : p->edges);
    dp_gl_uniform_u(gl, program, "places", p->places);
    dp_gl_uniform_u(gl, program, "first_command", i * DP_GL_ADDED_LISTS);
    dp_gl_dispatch(gl, 1);
    return DP_OK;
}

static dp_result draw(dp_gl *gl, uint32_t i, dp_diag *diag) {
    static const dp_gl_program_desc desc = {
        .vertex = "quads.vert", .fragment = "quads_once.frag", .defines = "#define ORDERED\n"};
    const dp_gl_api *const a = &gl->api;
    const dp_style *const s = &gl->style;
    dp_gl_quads *const q = gl->quads;
    float move[2];
    uint32_t program;
    const dp_result result = dp_gl_program(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_depth_move(gl, (double)s->between_offset, move);
    dp_gl_use(gl, program);
    dp_gl_scene_bind(gl);
    dp_gl_faces_bind(gl, program);
    dp_gl_buffer_bind(gl, &q->records, DP_GL_BIND_OWN);
    dp_gl_buffer_bind(gl, &q->order, DP_GL_BIND_OWN + 1);
    dp_gl_buffer_bind(gl, &q->states, DP_GL_BIND_OWN + 2);
    dp_gl_buffer_bind(gl, &q->faces, DP_GL_BIND_OWN + 3);
    dp_gl_uniform_2f(gl, program, "depth_range", q->range);
    dp_gl_uniform_4f(gl, program, "traps", (const float[4]){move[0], move[1], move[0], move[1]});
    dp_gl_uniform_u(gl, program, "intersections", (s->lines & DP_INTERSECTION) != 0);
    a->BindBuffer(GL_DRAW_INDIRECT_BUFFER, q->commands.name);
    a->DrawArraysIndirect(GL_TRIANGLES, (const void *)(16 * DP_GL_ADDED_LISTS * (uintptr_t)i));
    a->MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    return DP_OK;
}

dp_result dp_gl_quads_once(dp_gl *gl, dp_diag *diag) {
    dp_gl_portions portions;
    dp_result result = begin(gl, diag);
    if (!result) result = dp_gl_quads_portion(gl, true, &portions, diag);
    if (result) return result;
    gl->api.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    gl->api.Enable(GL_CLIP_DISTANCE0);
    for (uint32_t i = 0; i < portions.count && !result; i++) {
        result = dp_gl_quads_shade(gl, &portions, i, true, diag);
        if (!result) result = order(gl, &portions, i, diag);
        if (!result) result = draw(gl, i, diag);
    }
    gl->api.Disable(GL_CLIP_DISTANCE0);
    gl->api.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    return result;
}
