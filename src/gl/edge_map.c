/* The edge map on the device (Nienhaus and Döllner 2003, 4.1.2), and how it comes back onto the model.
 *
 *    G-buffer  → intensity   first variant: one pass; C1: three, each of which is added by blending (detect.frag)
 *    intensity → edge map    inner edges in RGB, profile edges in A (edge_map.frag)
 *    the model → edged       drawn a second time: the edge map and the shades are projected onto it from the camera
 *                            (project.frag)
 *
 * As in gbuffer/edge_map.c, whose values these are. As printed, and for 8 bits, distances are measured between near and far of the
 * enhanced groups, which a compute pass fits to their vertices (range.comp); they never come to the host. */
#include "gl/shading.h"

#include <stdio.h>

static bool needs_range(const dp_edge_map *m) { return m->as_printed || m->eight_bits; }

static dp_result upload_enhanced(dp_gl *gl, dp_diag *diag) {
    const dp_edge_map *const m = &gl->style.edge_map;
    uint32_t *const words = dp_alloc_array(&gl->memory, (size_t)m->enhanced_count + 1, 4);
    if (!words) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for enhanced groups");
    for (uint32_t i = 0; i < m->enhanced_count; i++) words[i] = m->enhanced[i] != 0;
    words[m->enhanced_count] = 0;
    const dp_result result =
        dp_gl_buffer_fill(gl, &gl->shading->enhanced, words, 4 * ((size_t)m->enhanced_count + 1),
                          "enhanced groups", diag);
    dp_free(&gl->memory, words);
    return result;
}

static dp_result fit_range(dp_gl *gl, dp_diag *diag) {
    static const uint32_t none[2] = {UINT32_MAX, 0};
    const bool chosen = gl->style.edge_map.enhanced != NULL;
    const dp_gl_program_desc desc = {.compute = "range.comp",
                                     .defines = chosen ? "#define CHOSEN\n" : NULL};
    uint32_t program;
    dp_result result =
        dp_gl_buffer_fill(gl, &gl->shading->range, none, sizeof none, "a range of distances", diag);
    if (!result) result = dp_gl_program(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_use(gl, program);
    dp_gl_scene_bind(gl);
    gl->api.BindBufferBase(GL_UNIFORM_BUFFER, DP_GL_BLOCK_SHADING, gl->shading->block_buffer.name);
    dp_gl_buffer_bind(gl, &gl->shading->range, 4);
    if (chosen) dp_gl_buffer_bind(gl, &gl->shading->enhanced, 5);
    dp_gl_dispatch(gl, chosen ? gl->scene.triangle_count : gl->scene.vertex_count);
    return DP_OK;
}

/* One pass of a detector; pass -1: the first variant. */
static dp_result detect(dp_gl *gl, int pass, dp_diag *diag) {
    const dp_edge_map *const m = &gl->style.edge_map;
    char defines[120], c1[32] = "";
    uint32_t program;
    if (pass >= 0) snprintf(c1, sizeof c1, "#define C1_PASS %d\n", pass);
    snprintf(defines, sizeof defines, "%s%s%s", c1, m->as_printed ? "#define AS_PRINTED\n" : "",
             m->eight_bits ? "#define EIGHT_BITS\n" : "");
    const dp_gl_program_desc desc = {
        .vertex = "whole.vert", .fragment = "detect.frag", .defines = defines};
    const dp_result result =
        dp_gl_begin_pass(gl, &desc, &gl->shading->intensity, GL_RG32F, &program, diag);
    if (result) return result;
    if (needs_range(m)) dp_gl_buffer_bind(gl, &gl->shading->range, 4);
    if (pass > 0) {
        gl->api.Enable(GL_BLEND);
        gl->api.BlendFunc(GL_ONE, GL_ONE);
    }
    dp_gl_draw_whole(gl);
    gl->api.Disable(GL_BLEND);
    gl->api.BlendFunc(GL_ONE, GL_ZERO);
    return DP_OK;
}

static dp_result measure_strengths(dp_gl *gl, dp_diag *diag) {
    const dp_edge_map *const m = &gl->style.edge_map;
    char defines[200];
    uint32_t program;
    snprintf(defines, sizeof defines, "%s%s%s%s%s%s",
             m->detector == DP_EDGE_MAP_C1 ? "#define C1\n" : "",
             m->as_printed ? "#define AS_PRINTED\n#define WHOLE 1.0\n" : "#define WHOLE 2.0\n",
             m->eight_bits ? "#define EIGHT_BITS\n" : "", m->no_groups ? "" : "#define GROUPS\n",
             m->far_side ? "#define FAR_SIDE\n" : "", m->enhanced ? "#define CHOSEN\n" : "");
    const dp_gl_program_desc desc = {
        .vertex = "whole.vert", .fragment = "edge_map.frag", .defines = defines};
    const dp_result result =
        dp_gl_begin_pass(gl, &desc, &gl->shading->edge_map, GL_RGBA16, &program, diag);
    if (result) return result;
    if (needs_range(m)) dp_gl_buffer_bind(gl, &gl->shading->range, 4);
    if (m->enhanced) dp_gl_buffer_bind(gl, &gl->shading->enhanced, 5);
    dp_gl_texture_bind(gl, &gl->shading->intensity, DP_GL_UNIT_PASS);
    dp_gl_uniform_i(gl, program, "intensities", DP_GL_UNIT_PASS);
    dp_gl_draw_whole(gl);
    return DP_OK;
}

dp_result dp_gl_fit_edge_map(dp_gl *gl, dp_diag *diag) {
    const dp_edge_map *const m = &gl->style.edge_map;
    const dp_result result = m->enhanced ? upload_enhanced(gl, diag) : DP_OK;
    return result || !needs_range(m) ? result : fit_range(gl, diag);
}

dp_result dp_gl_make_edge_map(dp_gl *gl, dp_diag *diag) {
    const dp_edge_map *const m = &gl->style.edge_map;
    const bool c1 = m->detector == DP_EDGE_MAP_C1;
    dp_result result = c1 ? DP_OK : detect(gl, -1, diag);
    for (int pass = 0; c1 && pass < (int)m->c1_passes && !result; pass++)
        result = detect(gl, pass, diag);
    return result ? result : measure_strengths(gl, diag);
}

/* Where no fragment will be, the colours are those without edges. */
static dp_result copy_colors(dp_gl *gl, const dp_gl_texture *from, dp_diag *diag) {
    static const dp_gl_program_desc desc = {.vertex = "whole.vert", .fragment = "copy.frag"};
    uint32_t program;
    const dp_result result =
        dp_gl_begin_pass(gl, &desc, &gl->shading->edged, GL_RGBA8, &program, diag);
    if (result) return result;
    dp_gl_texture_bind(gl, from, DP_GL_UNIT_PASS);
    dp_gl_uniform_i(gl, program, "colors", DP_GL_UNIT_PASS);
    dp_gl_draw_whole(gl);
    gl->api.MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
    return DP_OK;
}

/* The samples are those of the first pass, so that each pixel's polygon has a fragment there; nothing is drawn but by
 * the fragments themselves. */
static void open_second_pass(dp_gl *gl) {
    dp_gl_shading *const s = gl->shading;
    if (!s->second) gl->api.GenFramebuffers(1, &s->second);
    gl->api.BindFramebuffer(GL_FRAMEBUFFER, s->second);
    gl->api.FramebufferTexture(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, gl->faces.depth.name, 0);
    gl->api.DrawBuffer(GL_NONE);
    gl->api.ReadBuffer(GL_NONE);
}

dp_result dp_gl_apply_edge_map(dp_gl *gl, const dp_gl_texture *from, dp_diag *diag) {
    static const dp_gl_program_desc desc = {
        .vertex = "faces.vert", .fragment = "project.frag", .defines = "#define PROJECTED\n"};
    dp_gl_shading *const s = gl->shading;
    const dp_gl_api *const a = &gl->api;
    uint32_t program;
    dp_result result = copy_colors(gl, from, diag);
    if (!result) result = dp_gl_program(gl, &desc, &program, diag);
    if (result) return result;
    open_second_pass(gl);
    dp_gl_use(gl, program);
    dp_gl_scene_bind(gl);
    dp_gl_gbuffer_bind(gl, program);
    dp_gl_texture_bind(gl, from, DP_GL_UNIT_PASS);
    dp_gl_texture_bind(gl, &s->edge_map, DP_GL_UNIT_PASS + 1);
    dp_gl_uniform_i(gl, program, "colors", DP_GL_UNIT_PASS);
    dp_gl_uniform_i(gl, program, "edge_map", DP_GL_UNIT_PASS + 1);
    a->BindImageTexture(0, s->edged.name, 0, GL_FALSE, 0, GL_WRITE_ONLY, GL_RGBA8);
    a->Uniform2f(a->GetUniformLocation(program, "depth_range"), 0, 0.5f); /* no depth is tested */
    a->Enable(GL_CLIP_DISTANCE0);
    a->DrawArrays(GL_TRIANGLES, 0, (GLsizei)(3 * gl->scene.triangle_count));
    a->Disable(GL_CLIP_DISTANCE0);
    a->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    return DP_OK;
}
