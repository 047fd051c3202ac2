/* The picture's surface, without light, and the picture's way into the application's framebuffer. */
#include "gl/surface.h"

dp_result dp_gl_open_surface(dp_gl *gl, dp_diag *diag) {
    dp_gl_surface *const s = &gl->surface;
    const dp_result result = dp_gl_texture_reserve(gl, &s->picture, GL_RGBA8, gl->target.width,
                                                   gl->target.height, 0, "the picture", diag);
    if (result) return result;
    if (!s->framebuffer) gl->api.GenFramebuffers(1, &s->framebuffer);
    gl->api.BindFramebuffer(GL_FRAMEBUFFER, s->framebuffer);
    gl->api.FramebufferTexture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, s->picture.name, 0);
    gl->api.DrawBuffer(GL_COLOR_ATTACHMENT0);
    gl->api.Viewport(0, 0, (GLsizei)gl->target.width, (GLsizei)gl->target.height);
    return DP_OK;
}

dp_result dp_gl_paint_surface(dp_gl *gl, dp_diag *diag) {
    static const dp_gl_program_desc desc = {.vertex = "whole.vert", .fragment = "flat.frag"};
    uint32_t program;
    dp_result result = dp_gl_open_surface(gl, diag);
    if (!result) result = dp_gl_program(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_use(gl, program);
    dp_gl_scene_bind(gl);
    dp_gl_faces_bind(gl, program);
    dp_gl_draw_whole(gl);
    return DP_OK;
}

/* Blended over what is there, or in its place. */
static void draw_over(dp_gl *gl, bool over) {
    const dp_gl_api *const a = &gl->api;
    if (over) {
        a->Enable(GL_BLEND);
        a->BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    }
    dp_gl_draw_whole(gl);
    a->Disable(GL_BLEND);
    a->BlendFunc(GL_ONE, GL_ZERO);
}

/* Where the application's things cover samples, the picture holds nothing of those, and lies over what is there. */
static void draw_parts(dp_gl *gl, uint32_t program) {
    const bool transparent = gl->target.transparent,
               parts = gl->target.depth_texture && !transparent;
    dp_gl_uniform_u(gl, program, "part", parts ? 1 : 0);
    draw_over(gl, transparent);
    if (!parts) return;
    dp_gl_uniform_u(gl, program, "part", 2);
    draw_over(gl, true);
}

static void mask_other_buffers(dp_gl *gl, GLboolean mask) {
    for (GLuint i = 1; i < DP_GL_DRAW_BUFFERS; i++) gl->api.ColorMaski(i, mask, mask, mask, mask);
}

dp_result dp_gl_bind_framebuffer(dp_gl *gl, uint32_t point, uint32_t framebuffer, dp_diag *diag) {
    const dp_gl_api *const a = &gl->api;
    if (framebuffer && !a->IsFramebuffer(framebuffer))
        return dp_fail(diag, DP_ERR_ARGUMENT, "there is no framebuffer %u", framebuffer);
    a->BindFramebuffer(point, framebuffer);
    if (a->CheckFramebufferStatus(point) != GL_FRAMEBUFFER_COMPLETE)
        return dp_fail(diag, DP_ERR_ARGUMENT, "framebuffer %u is not complete%s", framebuffer,
                       framebuffer ? "" : ": there is no window");
    return DP_OK;
}

dp_result dp_gl_show(dp_gl *gl, dp_diag *diag) {
    static const dp_gl_program_desc desc = {.vertex = "whole.vert", .fragment = "show.frag"};
    const dp_gl_api *const a = &gl->api;
    const dp_gl_target *const t = &gl->target;
    uint32_t program;
    dp_result result = dp_gl_program(gl, &desc, &program, diag);
    if (!result) result = dp_gl_bind_framebuffer(gl, GL_DRAW_FRAMEBUFFER, t->framebuffer, diag);
    if (result) return result;
    a->Viewport(t->x, t->y, (GLsizei)t->width, (GLsizei)t->height);
    dp_gl_use(gl, program);
    dp_gl_faces_bind(gl, program);
    dp_gl_texture_bind(gl, &gl->surface.picture, DP_GL_UNIT_OWN);
    dp_gl_uniform_i(gl, program, "shown", DP_GL_UNIT_OWN);
    a->Uniform2i(a->GetUniformLocation(program, "from"), t->x, t->y);
    mask_other_buffers(gl, GL_FALSE);
    draw_parts(gl, program);
    mask_other_buffers(gl, GL_TRUE);
    return DP_OK;
}

void dp_gl_surface_free(dp_gl *gl) {
    dp_gl_texture_free(gl, &gl->surface.picture);
    if (gl->surface.framebuffer) gl->api.DeleteFramebuffers(1, &gl->surface.framebuffer);
    gl->surface.framebuffer = 0;
}
