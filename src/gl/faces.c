/* Faces: the nearest triangle of each sample, and its depth.
 *
 * The scene's triangles are drawn once, without attributes, into a texture of numbers (1 + triangle, R32UI) and a depth buffer.
 * Depth is d (core/view.h), which is larger when nearer, scaled into [0, 1]: in perspective 1 / distance, so that float32
 * is fine where it matters. Where the application gives a depth texture, it is put there first, as DP_GL_ID_FOREIGN.
 * Invariant: texel (x, y) is the picture's pixel from the upper left corner. */
#include "gl/fins.h"
#include "gl/scene.h"

#include <math.h>

void dp_gl_depth_range(const dp_gl *gl, float out[2]) {
    const dp_view *const v = &gl->view;
    const double *const z = v->clip[2], *const w = v->clip[3], *const s = v->sight;
    /* along the line of sight, clip z = scale * distance + offset */
    const double length2 = s[0] * s[0] + s[1] * s[1] + s[2] * s[2],
                 scale = (z[0] * s[0] + z[1] * s[1] + z[2] * s[2]) / length2,
                 offset = z[3] - scale * s[3];
    const double wscale = (w[0] * s[0] + w[1] * s[1] + w[2] * s[2]) / length2,
                 woffset = w[3] - wscale * s[3];
    const double near_z = -(offset + woffset) / (scale + wscale),
                 far_z = (woffset - offset) / (scale - wscale);
    if (v->perspective) {
        out[0] = (float)(near_z * (1 - 1e-6)), out[1] = 0;
    } else {
        out[0] = (float)((1 - 1e-6) / (far_z - near_z));
        out[1] = (float)(far_z / (far_z - near_z) * (1 - 1e-6));
    }
}

/* Textures of their own, attached to the bound framebuffer. */
static dp_result reserve_textures(dp_gl *gl, dp_diag *diag) {
    dp_gl_faces *const f = &gl->faces;
    const uint32_t w = gl->target.width, h = gl->target.height,
                   samples = gl->samples > 1 ? gl->samples : 0;
    if (f->layers[0]) dp_gl_fins_free_ink(gl);
    dp_result result = dp_gl_texture_reserve(gl, &f->ids, GL_R32UI, w, h, samples,
                                             "numbers of the samples' polygons", diag);
    if (!result)
        result = dp_gl_texture_reserve(gl, &f->depth, GL_DEPTH_COMPONENT32F, w, h, samples,
                                       "depth of the samples", diag);
    gl->api.FramebufferTexture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, f->ids.name, 0);
    gl->api.FramebufferTexture(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, f->depth.name, 0);
    return result;
}

static dp_result reserve(dp_gl *gl, dp_diag *diag) {
    dp_gl_faces *const f = &gl->faces;
    if (!f->framebuffer) gl->api.GenFramebuffers(1, &f->framebuffer);
    gl->api.BindFramebuffer(GL_FRAMEBUFFER, f->framebuffer);
    const dp_result result = dp_gl_fins_in_one_pass(gl) ? dp_gl_fins_reserve_layers(gl, diag)
                                                        : reserve_textures(gl, diag);
    if (result) return result;
    gl->api.DrawBuffer(GL_COLOR_ATTACHMENT0);
    if (gl->api.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        return dp_fail(diag, DP_ERR_UNSUPPORTED,
                       "%s cannot draw numbers with %u samples and 32 bits of depth", gl->device,
                       gl->samples);
    return DP_OK;
}

/* Sets up what faces, and all that is tested against them, are drawn with. */
static void clear(dp_gl *gl) {
    static const GLuint none[4] = {0, 0, 0, 0};
    static const GLfloat far_away = 0;
    gl->api.Viewport(0, 0, (GLsizei)gl->target.width, (GLsizei)gl->target.height);
    gl->api.DepthMask(GL_TRUE);
    gl->api.ClearBufferuiv(GL_COLOR, 0, none);
    gl->api.ClearBufferfv(GL_DEPTH, 0, &far_away);
    gl->api.Enable(GL_DEPTH_TEST);
    gl->api.DepthFunc(GL_GREATER);
}

/* GL_TEXTURE_2D or GL_TEXTURE_2D_MULTISAMPLE; 0: something else. Before OpenGL 4.5 only an error tells, of which debug
 * contexts need not hear. It is bound to its target then. */
static GLenum target_of_texture(dp_gl *gl, GLuint texture) {
    static const GLenum targets[2] = {GL_TEXTURE_2D, GL_TEXTURE_2D_MULTISAMPLE};
    const dp_gl_api *const a = &gl->api;
    const GLboolean tells = a->IsEnabled(GL_DEBUG_OUTPUT);
    GLenum found = 0;
    if (!a->IsTexture(texture)) return 0;
    dp_gl_forget_errors(gl);
    a->Disable(GL_DEBUG_OUTPUT);
    for (int i = 0; i < 2 && !found; i++) {
        a->BindTexture(targets[i], texture);
        if (a->GetError() == GL_NO_ERROR) found = targets[i];
    }
    if (tells) a->Enable(GL_DEBUG_OUTPUT);
    return found;
}

static dp_result check_foreign(dp_gl *gl, GLenum target, dp_diag *diag) {
    const dp_gl_api *const a = &gl->api;
    const GLuint name = gl->target.depth_texture;
    GLint width = 0, height = 0, bits = 0, mode = GL_DEPTH_COMPONENT;
    if (!target)
        return dp_fail(diag, DP_ERR_ARGUMENT, "depth_texture %u is no texture of two dimensions",
                       name);
    a->GetTexLevelParameteriv(target, 0, GL_TEXTURE_WIDTH, &width);
    a->GetTexLevelParameteriv(target, 0, GL_TEXTURE_HEIGHT, &height);
    a->GetTexLevelParameteriv(target, 0, GL_TEXTURE_DEPTH_SIZE, &bits);
    a->GetTexParameteriv(target, GL_DEPTH_STENCIL_TEXTURE_MODE, &mode);
    if (!bits || mode == GL_STENCIL_INDEX)
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "depth_texture %u holds no depth, or shows its stencil", name);
    if ((uint32_t)width != gl->target.width || (uint32_t)height != gl->target.height)
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "depth_texture %u is %d x %d px; the picture is %u x %u", name, width,
                       height, gl->target.width, gl->target.height);
    return DP_OK;
}

/* Whatever the application filters it by, or compares it with, its depth is read. */
static void bind_sampler(dp_gl *gl) {
    const dp_gl_api *const a = &gl->api;
    GLuint *const sampler = &gl->faces.sampler;
    if (!*sampler) {
        a->GenSamplers(1, sampler);
        a->SamplerParameteri(*sampler, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        a->SamplerParameteri(*sampler, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    }
    a->BindSampler(DP_GL_UNIT_OWN, *sampler);
}

/* The application's depth, as d, with DP_GL_ID_FOREIGN. */
static dp_result put_foreign(dp_gl *gl, const float range[2], dp_diag *diag) {
    static const dp_gl_program_desc plain = {.vertex = "whole.vert", .fragment = "foreign.frag"},
                                    several = {.vertex = "whole.vert",
                                               .fragment = "foreign.frag",
                                               .defines = "#define FOREIGN_SAMPLES\n"};
    const dp_gl_api *const a = &gl->api;
    uint32_t program;
    a->ActiveTexture(GL_TEXTURE0 + DP_GL_UNIT_OWN);
    const GLenum target = target_of_texture(gl, gl->target.depth_texture);
    dp_result result = check_foreign(gl, target, diag);
    if (!result)
        result = dp_gl_program(gl, target == GL_TEXTURE_2D ? &plain : &several, &program, diag);
    if (result) return result;
    dp_gl_use(gl, program);
    bind_sampler(gl);
    dp_gl_uniform_i(gl, program, "foreign", DP_GL_UNIT_OWN);
    a->Uniform2f(a->GetUniformLocation(program, "depth_range"), range[0], range[1]);
    a->DepthFunc(GL_ALWAYS);
    dp_gl_draw_whole(gl);
    a->DepthFunc(GL_GREATER);
    a->BindSampler(DP_GL_UNIT_OWN, 0);
    return DP_OK;
}

static dp_result draw_triangles(dp_gl *gl, const float range[2], dp_diag *diag) {
    static const dp_gl_program_desc desc = {.vertex = "faces.vert", .fragment = "faces.frag"};
    const dp_gl_api *const a = &gl->api;
    uint32_t program;
    const dp_result result = dp_gl_program(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_use(gl, program);
    dp_gl_scene_bind(gl);
    a->Uniform2f(a->GetUniformLocation(program, "depth_range"), range[0], range[1]);
    if (gl->style.cull_back_faces) {
        a->FrontFace(GL_CW); /* rows run from the top down here */
        a->Enable(GL_CULL_FACE);
    }
    a->DrawArrays(GL_TRIANGLES, 0, (GLsizei)(3 * gl->scene.triangle_count));
    a->Disable(GL_CULL_FACE);
    a->FrontFace(GL_CCW);
    return DP_OK;
}

dp_result dp_gl_draw_faces(dp_gl *gl, dp_diag *diag) {
    const dp_gl_api *const a = &gl->api;
    float range[2];
    dp_result result = reserve(gl, diag);
    if (result) return result;
    dp_gl_depth_range(gl, range);
    gl->faces.range[0] = range[0], gl->faces.range[1] = range[1];
    clear(gl);
    if (gl->target.depth_texture) result = put_foreign(gl, range, diag);
    if (result) return result;
    a->Enable(GL_CLIP_DISTANCE0);
    result = dp_gl_fins_in_one_pass(gl) ? dp_gl_fins_draw_once(gl, diag)
                                        : draw_triangles(gl, range, diag);
    a->Disable(GL_CLIP_DISTANCE0);
    a->Disable(GL_DEPTH_TEST);
    a->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    return result;
}

void dp_gl_faces_bind(dp_gl *gl, uint32_t program) {
    dp_gl_texture_bind(gl, &gl->faces.ids, DP_GL_UNIT_IDS);
    dp_gl_texture_bind(gl, &gl->faces.depth, DP_GL_UNIT_DEPTH);
    dp_gl_uniform_i(gl, program, "ids", DP_GL_UNIT_IDS);
    dp_gl_uniform_i(gl, program, "depths", DP_GL_UNIT_DEPTH);
}

void dp_gl_faces_free(dp_gl *gl) {
    dp_gl_fins_free_ink(gl);
    dp_gl_texture_free(gl, &gl->faces.ids);
    dp_gl_texture_free(gl, &gl->faces.depth);
    if (gl->faces.framebuffer) gl->api.DeleteFramebuffers(1, &gl->faces.framebuffer);
    if (gl->faces.sampler) gl->api.DeleteSamplers(1, &gl->faces.sampler);
    gl->faces.framebuffer = gl->faces.sampler = 0;
}
