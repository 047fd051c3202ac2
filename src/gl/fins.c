/* Silhouettes and borders by adjacency, as textured triangles beside their edges (Hermosilla and Vázquez 2010, 2.3), for
 * DP_EDGES_ADJACENCY with DP_INK_QUADS and DP_METHOD_PAPER; printed/fins.c is the same on the CPU.
 *
 *     mates → index buffer with adjacency (Figure 2.2)                            fins_edges.c, kept
 *     vertex shader     positions to the screen                                   fins.vert
 *     geometry shader   which edges are outlines (Listing 2.1), and the           fins.geom, outlines.glsl,
 *                         triangles beside them (Listing 2.2)                       fins.glsl
 *     pixel shader      (x, y, v) → u, texture, alpha test (Listing 2.3)          fins.frag
 *
 * One pass (2.3.4): the geometry shader puts out the triangle itself, too, whose v is 2. Surface and ink go to two layers of
 * one framebuffer, each with a depth of its own, so that the picture does not depend on the order of triangles, and what
 * ink half hides can still be shaded. Two passes: faces.c draws the surface, and the geometry shader silhouettes alone.
 *
 * Without a geometry shader (the device has none that reads buffers, or dp_gl.no_geometry_shader): compute shaders list
 * outlines, in the order of triangles, and a vertex shader pulls each one's strip; always in two passes. The triangles are the same,
 * and so is the picture.
 *
 * Data structure: per sample the ink's colour (0: none) and depth. Invariant: texel (x, y) is the picture's pixel. Not
 * handled: creases and intersections, which are strokes over these (ink.c); triangles without area do not connect what they lie between. */
#include "gl/fins.h"
#include "gl/ink.h"
#include "gl/lines.h"

#include <stdio.h>

enum { OUTLINES = DP_SILHOUETTE | DP_BORDER, GEOMETRY_BUFFERS = 5 /* that fins.geom reads */ };

/* ------- which way ------- */

bool dp_gl_draws_fins(const dp_gl *gl) {
    const dp_style *const s = &gl->style;
    return s->edges == DP_EDGES_ADJACENCY && s->ink == DP_INK_QUADS &&
           s->method == DP_METHOD_PAPER && s->lines & OUTLINES && gl->scene.triangle_count;
}

static bool has_geometry_shader(const dp_gl *gl) {
    GLint buffers = 0;
    if (gl->no_geometry_shader) return false;
    gl->api.GetIntegerv(GL_MAX_GEOMETRY_SHADER_STORAGE_BLOCKS, &buffers);
    return buffers >= GEOMETRY_BUFFERS;
}

bool dp_gl_fins_in_one_pass(const dp_gl *gl) {
    return dp_gl_draws_fins(gl) && gl->style.passes == 1 && has_geometry_shader(gl);
}

dp_result dp_gl_fins_begin(dp_gl *gl, dp_diag *diag) {
    if (gl->fins) return DP_OK;
    gl->fins = dp_alloc_zeroed(&gl->memory, sizeof *gl->fins);
    return gl->fins ? DP_OK : dp_fail(diag, DP_ERR_MEMORY, "out of memory for silhouettes");
}

/* ------- where ink goes ------- */

static uint32_t samples_of_textures(const dp_gl *gl) { return gl->samples > 1 ? gl->samples : 0; }

void dp_gl_fins_free_ink(dp_gl *gl) {
    dp_gl_faces *const f = &gl->faces;
    dp_gl_texture_free(gl, &f->ink), dp_gl_texture_free(gl, &f->ink_depth);
    if (!f->layers[0]) return;
    dp_gl_texture_free(gl, &f->ids), dp_gl_texture_free(gl, &f->depth);
    gl->api.DeleteTextures(2, f->layers);
    f->layers[0] = f->layers[1] = 0;
}

/* An array of two layers. Its binding is none that state.c knows, so it is put back at once. */
static void make_layers(dp_gl *gl, uint32_t *name, GLenum format) {
    const dp_gl_api *const a = &gl->api;
    const GLsizei w = (GLsizei)gl->target.width, h = (GLsizei)gl->target.height;
    const GLenum target = gl->samples > 1 ? GL_TEXTURE_2D_MULTISAMPLE_ARRAY : GL_TEXTURE_2D_ARRAY;
    GLint before = 0;
    a->ActiveTexture(GL_TEXTURE0);
    a->GetIntegerv(gl->samples > 1 ? GL_TEXTURE_BINDING_2D_MULTISAMPLE_ARRAY
                                   : GL_TEXTURE_BINDING_2D_ARRAY,
                   &before);
    a->GenTextures(1, name);
    a->BindTexture(target, *name);
    if (gl->samples > 1)
        a->TexStorage3DMultisample(target, (GLsizei)gl->samples, format, w, h, 2, GL_TRUE);
    else
        a->TexStorage3D(target, 1, format, w, h, 2);
    a->BindTexture(target, (GLuint)before);
}

/* One layer, as a texture of its own. */
static void make_view(dp_gl *gl, dp_gl_texture *texture, uint32_t layers, GLenum format,
                      GLuint layer) {
    const dp_gl_api *const a = &gl->api;
    const uint32_t samples = samples_of_textures(gl), w = gl->target.width, h = gl->target.height;
    dp_gl_texture_free(gl, texture);
    *texture = (dp_gl_texture){.target = samples ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D,
                               .format = format,
                               .width = w,
                               .height = h,
                               .samples = samples};
    a->GenTextures(1, &texture->name);
    a->TextureView(texture->name, texture->target, layers, format, 0, 1, layer, 1);
    gl->stats.bytes += 4 * (uint64_t)w * h * gl->samples;
    if (samples) return;
    dp_gl_texture_bind(gl, texture, 0);
    a->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    a->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

static bool layers_fit(const dp_gl *gl) {
    const dp_gl_texture *const ids = &gl->faces.ids;
    return gl->faces.layers[0] && ids->width == gl->target.width &&
           ids->height == gl->target.height && ids->samples == samples_of_textures(gl);
}

dp_result dp_gl_fins_reserve_layers(dp_gl *gl, dp_diag *diag) {
    dp_gl_faces *const f = &gl->faces;
    dp_result result = DP_OK;
    if (!layers_fit(gl)) {
        dp_gl_fins_free_ink(gl);
        make_layers(gl, &f->layers[0], GL_R32UI);
        make_layers(gl, &f->layers[1], GL_DEPTH_COMPONENT32F);
        make_view(gl, &f->ids, f->layers[0], GL_R32UI, 0);
        make_view(gl, &f->depth, f->layers[1], GL_DEPTH_COMPONENT32F, 0);
        make_view(gl, &f->ink, f->layers[0], GL_R32UI, 1);
        make_view(gl, &f->ink_depth, f->layers[1], GL_DEPTH_COMPONENT32F, 1);
        result = dp_gl_check(gl, "layers of surface and silhouettes", diag);
        if (result) dp_gl_fins_free_ink(gl);
    }
    gl->api.FramebufferTexture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, f->layers[0], 0);
    gl->api.FramebufferTexture(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, f->layers[1], 0);
    return result;
}

/* Two passes: textures of ink's own, empty, and bound to draw to. */
static dp_result reserve_ink(dp_gl *gl, dp_diag *diag) {
    static const GLuint none[4] = {0, 0, 0, 0};
    static const GLfloat far_away = 0;
    const dp_gl_api *const a = &gl->api;
    dp_gl_fins *const s = gl->fins;
    dp_gl_faces *const f = &gl->faces;
    const uint32_t w = gl->target.width, h = gl->target.height, samples = samples_of_textures(gl);
    dp_result result =
        dp_gl_texture_reserve(gl, &f->ink, GL_R32UI, w, h, samples, "ink of the samples", diag);
    if (!result)
        result = dp_gl_texture_reserve(gl, &f->ink_depth, GL_DEPTH_COMPONENT32F, w, h, samples,
                                       "depth of ink", diag);
    if (result) return result;
    if (!s->framebuffer) a->GenFramebuffers(1, &s->framebuffer);
    a->BindFramebuffer(GL_FRAMEBUFFER, s->framebuffer);
    a->FramebufferTexture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, f->ink.name, 0);
    a->FramebufferTexture(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, f->ink_depth.name, 0);
    a->DrawBuffer(GL_COLOR_ATTACHMENT0);
    a->Viewport(0, 0, (GLsizei)w, (GLsizei)h);
    a->DepthMask(GL_TRUE);
    a->ClearBufferuiv(GL_COLOR, 0, none);
    a->ClearBufferfv(GL_DEPTH, 0, &far_away);
    return DP_OK;
}

/* ------- passes ------- */

static void bind_edges(dp_gl *gl) {
    dp_gl_scene_bind(gl);
    dp_gl_buffer_bind(gl, &gl->lines.mates, DP_GL_BIND_OWN);
    dp_gl_buffer_bind(gl, &gl->fins->rings, DP_GL_BIND_RINGS);
}

/* What both ways of drawing need: the program in use, with its buffers, textures and values. */
static dp_result begin_draw(dp_gl *gl, const char *vertex, const char *geometry, bool one_pass,
                            uint32_t *program, dp_diag *diag) {
    char defines[256];
    snprintf(defines, sizeof defines, "%s%s", one_pass ? "#define ONE_PASS\n" : "",
             dp_gl_fins_texture_defines(gl));
    const dp_gl_program_desc desc = {
        .vertex = vertex, .geometry = geometry, .fragment = "fins.frag", .defines = defines};
    float range[2];
    const dp_result result = dp_gl_program(gl, &desc, program, diag);
    if (result) return result;
    dp_gl_use(gl, *program);
    bind_edges(gl);
    dp_gl_fins_bind_texture(gl, *program);
    dp_gl_uniform_u(gl, *program, "lines", gl->style.lines & OUTLINES);
    dp_gl_uniform_i(gl, *program, "edges", 3);
    dp_gl_depth_range(gl, range);
    gl->api.Uniform2f(gl->api.GetUniformLocation(*program, "depth_range"), range[0], range[1]);
    return DP_OK;
}

static dp_result draw_triangles(dp_gl *gl, bool one_pass, dp_diag *diag) {
    const dp_gl_api *const a = &gl->api;
    uint32_t program;
    const dp_result result = begin_draw(gl, "fins.vert", "fins.geom", one_pass, &program, diag);
    if (result) return result;
    a->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, gl->fins->six.name); /* of the library's vertex array */
    a->DrawElements(GL_TRIANGLES_ADJACENCY, (GLsizei)(6 * gl->scene.triangle_count),
                    GL_UNSIGNED_INT, NULL);
    return DP_OK;
}

static dp_result draw_listed(dp_gl *gl, dp_diag *diag) {
    const dp_gl_api *const a = &gl->api;
    uint32_t program;
    dp_result result = dp_gl_fins_list(gl, diag);
    if (!result) result = begin_draw(gl, "fins_pulled.vert", NULL, false, &program, diag);
    if (result) return result;
    dp_gl_buffer_bind(gl, &gl->fins->listed, DP_GL_BIND_LISTED);
    a->BindBuffer(GL_DRAW_INDIRECT_BUFFER, gl->fins->sums.name);
    a->DrawArraysIndirect(GL_TRIANGLE_STRIP, NULL);
    return DP_OK;
}

dp_result dp_gl_fins_draw_once(dp_gl *gl, dp_diag *diag) {
    const GLint viewport[2] = {(GLint)gl->target.width, (GLint)gl->target.height};
    dp_result result = dp_gl_fins_begin(gl, diag);
    if (!result) result = dp_gl_fins_adjacency(gl, diag);
    if (!result) result = dp_gl_fins_texture(gl, diag);
    if (result) return result;
    gl->api.BindFramebuffer(GL_FRAMEBUFFER, gl->faces.framebuffer);
    gl->api.Viewport(0, 0, viewport[0], viewport[1]);
    return draw_triangles(gl, true, diag);
}

static dp_result draw_after(dp_gl *gl, dp_diag *diag) {
    const dp_gl_api *const a = &gl->api;
    dp_result result = dp_gl_find_mates(gl, diag);
    if (!result) result = dp_gl_fins_adjacency(gl, diag);
    if (!result) result = dp_gl_fins_texture(gl, diag);
    if (!result) result = reserve_ink(gl, diag);
    if (result) return result;
    a->Enable(GL_DEPTH_TEST);
    a->DepthFunc(GL_GREATER);
    result = has_geometry_shader(gl) ? draw_triangles(gl, false, diag) : draw_listed(gl, diag);
    a->Disable(GL_DEPTH_TEST);
    a->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    return result;
}

/* Ink over the picture. */
static dp_result put_ink(dp_gl *gl, dp_diag *diag) {
    static const dp_gl_program_desc desc = {.compute = "fins_ink.comp"};
    uint32_t program;
    const dp_result result = dp_gl_program(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_use(gl, program);
    dp_gl_faces_bind(gl, program);
    dp_gl_texture_bind(gl, &gl->faces.ink, DP_GL_UNIT_OWN);
    dp_gl_texture_bind(gl, &gl->faces.ink_depth, DP_GL_UNIT_OWN + 1);
    dp_gl_uniform_i(gl, program, "ink", DP_GL_UNIT_OWN);
    dp_gl_uniform_i(gl, program, "ink_depths", DP_GL_UNIT_OWN + 1);
    gl->api.BindImageTexture(0, gl->surface.picture.name, 0, GL_FALSE, 0, GL_READ_WRITE, GL_RGBA8);
    dp_gl_dispatch_pixels(gl);
    gl->api.MemoryBarrier(GL_FRAMEBUFFER_BARRIER_BIT);
    return DP_OK;
}

dp_result dp_gl_ink_fins(dp_gl *gl, dp_diag *diag) {
    dp_result result = dp_gl_fins_begin(gl, diag);
    if (!result && !dp_gl_fins_in_one_pass(gl)) result = draw_after(gl, diag);
    if (!result) result = put_ink(gl, diag);
    if (!result && gl->style.lines & DP_ALL_LINES & ~OUTLINES) result = dp_gl_ink_strokes(gl, diag);
    return result;
}

void dp_gl_fins_free(dp_gl *gl) {
    dp_gl_fins *const f = gl->fins;
    if (!f) return;
    dp_gl_pencil_free(gl, &f->pencil);
    if (!gl->is_lost) {
        dp_gl_buffer *const buffers[] = {&f->six,    &f->rings, &f->many,  &f->facing,
                                         &f->listed, &f->sums,  &f->centre};
        for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++)
            dp_gl_buffer_free(gl, buffers[i]);
        for (int i = 0; i < 2; i++) dp_gl_texture_free(gl, &f->strokes[i]);
        if (f->framebuffer) gl->api.DeleteFramebuffers(1, &f->framebuffer);
    }
    dp_free(&gl->memory, f);
    gl->fins = NULL;
}
