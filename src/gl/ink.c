/* Plain strokes: segments drawn as round-ended capsules over the picture, as sink/ink.c draws them.
 *
 *     one instance a segment, by the indirect command that begins with their number: a rectangle around
 *         the capsule (capsule.vert), in which each pixel's coverage is found and multiplied by the share of
 *         its samples that nothing hides (capsule.frag); the largest of each class stays (GL_MAX)
 *     one pass over all pixels lays the classes over each other (ink_lay.frag)
 *
 * Data structure: line k is channel k % 4 of coverage texture k / 4; the second is only there where borders
 * are drawn. Coverage has 8 bits: half a step of the picture's own at the most. Invariant: ink
 * does not depend on the order of segments, as the maximum does not.
 *
 * Strokes are cut by surfaces only where silhouettes are drawn, as on the CPU, and always by what the application
 * has drawn: that belongs to no line, and hides from the spine's depth on.
 *
 * Not here: sections and hatching, patterns, hidden lines. */
#include "gl/ink.h"

enum { CAPSULE_CORNERS = 4, UNIT_COVERAGE = DP_GL_UNIT_OWN };

/* Coverage textures that these classes need. */
static int textures_of(const dp_gl *gl) { return gl->style.lines & DP_BORDER ? 2 : 1; }

static dp_result reserve(dp_gl *gl, dp_diag *diag) {
    static const GLenum buffers[2] = {GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    const dp_gl_api *const a = &gl->api;
    dp_gl_ink *const k = &gl->ink;
    const int count = textures_of(gl);
    for (int i = 0; i < count; i++) {
        const dp_result result =
            dp_gl_texture_reserve(gl, &k->coverage[i], GL_RGBA8, gl->target.width,
                                  gl->target.height, 0, "coverage by strokes", diag);
        if (result) return result;
    }
    if (!k->framebuffer) a->GenFramebuffers(1, &k->framebuffer);
    a->BindFramebuffer(GL_FRAMEBUFFER, k->framebuffer);
    for (int i = 0; i < 2; i++)
        a->FramebufferTexture(GL_FRAMEBUFFER, buffers[i], i < count ? k->coverage[i].name : 0, 0);
    a->DrawBuffers(count, buffers);
    if (a->CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        return dp_fail(diag, DP_ERR_UNSUPPORTED, "%s cannot draw into two pictures at once",
                       gl->device);
    return DP_OK;
}

static void draw_capsules(dp_gl *gl, uint32_t program) {
    static const GLfloat none[4] = {0, 0, 0, 0};
    static const GLuint corners = CAPSULE_CORNERS;
    const dp_gl_api *const a = &gl->api;
    float range[2];
    for (int i = 0; i < textures_of(gl); i++) a->ClearBufferfv(GL_COLOR, i, none);
    a->Viewport(0, 0, (GLsizei)gl->target.width, (GLsizei)gl->target.height);
    dp_gl_use(gl, program);
    dp_gl_scene_bind(gl);
    dp_gl_buffer_bind(gl, &gl->lines.segments, DP_GL_BIND_OWN);
    dp_gl_faces_bind(gl, program);
    dp_gl_depth_range(gl, range);
    a->Uniform2f(a->GetUniformLocation(program, "depth_range"), range[0], range[1]);
    dp_gl_uniform_u(gl, program, "cuts",
                    (gl->style.lines & DP_SILHOUETTE ? 1u : 0) |
                        (gl->target.depth_texture ? 2u : 0));
    a->BindBuffer(GL_DRAW_INDIRECT_BUFFER, gl->lines.counters.name);
    a->BufferSubData(GL_DRAW_INDIRECT_BUFFER, 0, sizeof corners, &corners);
    a->Enable(GL_BLEND);
    a->BlendEquation(GL_MAX);
    a->DrawArraysIndirect(GL_TRIANGLE_STRIP, NULL);
    a->BlendEquation(GL_FUNC_ADD);
    a->Disable(GL_BLEND);
}

static void lay(dp_gl *gl, uint32_t program) {
    const dp_gl_api *const a = &gl->api;
    dp_gl_use(gl, program);
    for (int i = 0; i < textures_of(gl); i++)
        dp_gl_texture_bind(gl, &gl->ink.coverage[i], UNIT_COVERAGE + (uint32_t)i);
    dp_gl_uniform_i(gl, program, "coverage0", UNIT_COVERAGE);
    dp_gl_uniform_i(gl, program, "coverage1", UNIT_COVERAGE + 1);
    a->BindImageTexture(0, gl->surface.picture.name, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA8);
    a->MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
    a->DrawBuffer(GL_NONE); /* it reads the picture and writes it, each pixel its own */
    dp_gl_draw_whole(gl);
    a->MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                     GL_FRAMEBUFFER_BARRIER_BIT);
}

dp_result dp_gl_ink_strokes(dp_gl *gl, dp_diag *diag) {
    static const dp_gl_program_desc capsules = {.vertex = "capsule.vert",
                                                .fragment = "capsule.frag"},
                                    layers = {.vertex = "whole.vert", .fragment = "ink_lay.frag"};
    uint32_t capsule_program, layer_program;
    if (!gl->lines.segments.name || !gl->lines.counters.name) return DP_OK;
    dp_result result = reserve(gl, diag);
    if (!result) result = dp_gl_program(gl, &capsules, &capsule_program, diag);
    if (!result) result = dp_gl_program(gl, &layers, &layer_program, diag);
    if (result) return result;
    draw_capsules(gl, capsule_program);
    lay(gl, layer_program);
    return DP_OK;
}

void dp_gl_ink_free(dp_gl *gl) {
    for (int i = 0; i < 2; i++) dp_gl_texture_free(gl, &gl->ink.coverage[i]);
    if (gl->ink.framebuffer) gl->api.DeleteFramebuffers(1, &gl->ink.framebuffer);
    gl->ink.framebuffer = 0;
}
