/* Quads as ink: (Raskar 2001) whole, as printed or exact. The added polygons are the lines; nothing else is drawn.
 *
 *    for each portion of half-edges
 *        primitive shader → lists: lines, joints, valleys           quads_shade.c, shaders/quads_shade.comp
 *        lines, joints    nearest wins, over the finished faces      → `lines`, `depth`
 *        valleys          take the between-test                      → `trapped`
 *    faces take the between-test themselves: intersections           → `trapped`
 *    lines, or else what is trapped, over the samples' surface       → the picture
 *
 *    between     valleys, intersections (as printed/quads.c, which has the same tests)
 *    plane       in the fragment shader: number of the polygon at the sample, both planes
 *    interval    passes = 1: in one pass, as printed (quads_once.c); passes = 2: against the finished faces
 *    stencil     (Raskar 2001, 7): polygons before the faces count down, the same moved nearer count up
 *
 * Data structure: per sample the class of the line that stands before the surface, with its depth, and that of what is
 * trapped. Invariant: a line always wins over what is trapped, and an intersection over a valley, so that the order of
 * polygons does not matter but with passes = 1. Not handled: styles of groups, patterns and light on lines. */
#include "gl/ink.h"
#include "gl/quads.h"

/* What is trapped lies at most this many line widths behind the surface (printed/quads.c). */
static const double TRAP = 4;

void dp_gl_depth_move(const dp_gl *gl, double px, float out[2]) {
    const dp_view *const v = &gl->view;
    out[0] = v->perspective ? (float)(1 - px / v->focal) : 1;
    out[1] = v->perspective ? 0 : (float)(-px / v->focal);
}

void dp_gl_uniform_2f(dp_gl *gl, uint32_t program, const char *name, const float value[2]) {
    gl->api.Uniform2f(gl->api.GetUniformLocation(program, name), value[0], value[1]);
}

/* A little farther than where it is: the device's test leaves all that the shader's may. */
static void clearly_behind(const dp_gl *gl, float out[2]) {
    dp_gl_depth_move(gl, 0.01, out);
    out[0] += gl->view.perspective ? -2e-6f : 2e-6f;
}

/* ------- textures ------- */

static dp_result reserve(dp_gl *gl, dp_diag *diag) {
    dp_gl_quads *const q = gl->quads;
    const uint32_t w = gl->target.width, h = gl->target.height,
                   samples = gl->samples > 1 ? gl->samples : 0;
    const bool stencil = gl->style.between == DP_BETWEEN_STENCIL;
    dp_result result =
        dp_gl_texture_reserve(gl, &q->lines, GL_R8UI, w, h, samples, "lines of samples", diag);
    if (!result)
        result = dp_gl_texture_reserve(gl, &q->depth, GL_DEPTH_COMPONENT32F, w, h, samples,
                                       "depth of lines", diag);
    if (!result)
        result = dp_gl_texture_reserve(gl, &q->trapped, GL_R8UI, w, h, samples,
                                       "trapped lines of samples", diag);
    if (!result && stencil)
        result = dp_gl_texture_reserve(gl, &q->stencil, GL_DEPTH32F_STENCIL8, w, h, samples,
                                       "the stencil buffer", diag);
    return result;
}

dp_result dp_gl_quads_attach(dp_gl *gl, const dp_gl_texture *color, const dp_gl_texture *depth,
                             dp_diag *diag) {
    const dp_gl_api *const a = &gl->api;
    dp_gl_quads *const q = gl->quads;
    const bool stencil = depth && depth->format == GL_DEPTH32F_STENCIL8;
    const uint32_t name = depth ? depth->name : 0;
    if (!q->framebuffer) a->GenFramebuffers(1, &q->framebuffer);
    a->BindFramebuffer(GL_FRAMEBUFFER, q->framebuffer);
    a->FramebufferTexture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, color->name, 0);
    a->FramebufferTexture(GL_FRAMEBUFFER, GL_DEPTH_STENCIL_ATTACHMENT, stencil ? name : 0, 0);
    if (!stencil) a->FramebufferTexture(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, name, 0);
    a->DrawBuffer(GL_COLOR_ATTACHMENT0);
    a->Viewport(0, 0, (GLsizei)gl->target.width, (GLsizei)gl->target.height);
    if (a->CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        return dp_fail(diag, DP_ERR_UNSUPPORTED, "%s cannot draw lines with %u samples and a %s",
                       gl->device, gl->samples, stencil ? "stencil buffer" : "depth of 32 bits");
    return DP_OK;
}

/* The faces' depth into that of the framebuffer. */
static dp_result copy_depth(dp_gl *gl, dp_diag *diag) {
    static const dp_gl_program_desc desc = {.vertex = "whole.vert", .fragment = "quads_depth.frag"};
    uint32_t program;
    const dp_result result = dp_gl_program(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_use(gl, program);
    dp_gl_faces_bind(gl, program);
    gl->api.Enable(GL_DEPTH_TEST);
    gl->api.DepthFunc(GL_ALWAYS);
    gl->api.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    dp_gl_draw_whole(gl);
    gl->api.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl->api.Disable(GL_DEPTH_TEST);
    return DP_OK;
}

/* Planes of all triangles. */
static dp_result place_faces(dp_gl *gl, dp_diag *diag) {
    static const dp_gl_program_desc desc = {.compute = "quads_faces.comp", .any_samples = true};
    dp_gl_quads *const q = gl->quads;
    uint32_t program;
    dp_result result = dp_gl_buffer_reserve(gl, &q->faces, 32 * (size_t)gl->scene.triangle_count,
                                            "planes of faces", diag);
    if (!result) result = dp_gl_program(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_use(gl, program);
    dp_gl_scene_bind(gl);
    dp_gl_buffer_bind(gl, &q->faces, DP_GL_BIND_OWN + 3);
    dp_gl_dispatch(gl, gl->scene.triangle_count);
    return DP_OK;
}

static dp_result begin(dp_gl *gl, dp_diag *diag) {
    static const GLuint none[4] = {0, 0, 0, 0};
    static const GLfloat zero = 0;
    dp_gl_quads *const q = gl->quads;
    const bool stencil = gl->style.between == DP_BETWEEN_STENCIL;
    dp_result result = dp_gl_quads_attach(gl, &q->trapped, stencil ? &q->stencil : NULL, diag);
    if (result) return result;
    gl->api.ClearBufferuiv(GL_COLOR, 0, none);
    if (stencil) {
        gl->api.ClearBufferfi(GL_DEPTH_STENCIL, 0, zero, 0);
        result = copy_depth(gl, diag);
    }
    if (!result) result = dp_gl_quads_attach(gl, &q->lines, &q->depth, diag);
    if (result) return result;
    gl->api.ClearBufferuiv(GL_COLOR, 0, none);
    return copy_depth(gl, diag);
}

/* ------- added polygons ------- */

/* A program with what all of them need. */
static dp_result use(dp_gl *gl, const dp_gl_program_desc *desc, const float move[2], double trap,
                     dp_line line, uint32_t *program, dp_diag *diag) {
    const dp_result result = dp_gl_program(gl, desc, program, diag);
    float behind[2];
    if (result) return result;
    dp_gl_depth_move(gl, trap, behind);
    dp_gl_use(gl, *program);
    dp_gl_scene_bind(gl);
    dp_gl_faces_bind(gl, *program);
    dp_gl_buffer_bind(gl, &gl->quads->records, DP_GL_BIND_OWN);
    dp_gl_buffer_bind(gl, &gl->quads->faces, DP_GL_BIND_OWN + 3);
    dp_gl_uniform_2f(gl, *program, "depth_range", gl->quads->range);
    dp_gl_uniform_2f(gl, *program, "depth_move", move);
    dp_gl_uniform_2f(gl, *program, "trap", behind);
    dp_gl_uniform_f(gl, *program, "reach", gl->style.line[line].width / 2);
    return DP_OK;
}

static void draw_list(dp_gl *gl, uint32_t portion, uint32_t list) {
    gl->api.BindBuffer(GL_DRAW_INDIRECT_BUFFER, gl->quads->commands.name);
    gl->api.DrawArraysIndirect(
        GL_TRIANGLES, (const void *)(16 * (DP_GL_ADDED_LISTS * (uintptr_t)portion + list)));
}

/* How far behind the surface something still is trapped, px. */
static double trap_of(const dp_style *s, dp_line line) {
    return s->between == DP_BETWEEN_PLANE ? TRAP * (double)s->line[line].width
                                          : (double)s->between_offset;
}

/* Silhouettes and ridges, or borders: what is nearest, before the surface. */
static dp_result draw_lines(dp_gl *gl, const dp_gl_portions *p, uint32_t portion, dp_diag *diag) {
    static const dp_gl_program_desc plain = {.vertex = "quads.vert", .fragment = "quads_line.frag"},
                                    joint = {.vertex = "quads.vert",
                                             .fragment = "quads_joint.frag"};
    static const float stay[2] = {1, 0};
    const dp_style *const s = &gl->style;
    const dp_line line = s->lines & DP_RIDGE ? DP_LINE_RIDGE : DP_LINE_BORDER;
    uint32_t program;
    dp_result result = dp_gl_quads_attach(gl, &gl->quads->lines, &gl->quads->depth, diag);
    if (!result) result = use(gl, &plain, stay, 0, line, &program, diag);
    if (result) return result;
    gl->api.Enable(GL_DEPTH_TEST);
    gl->api.DepthFunc(GL_GREATER);
    gl->api.Enable(GL_DEPTH_CLAMP); /* what comes nearer than the near plane is drawn */
    if (p->room[DP_GL_ADDED_LINES]) draw_list(gl, portion, DP_GL_ADDED_LINES);
    if (p->room[DP_GL_ADDED_JOINTS]) {
        result = use(gl, &joint, stay, trap_of(s, line), line, &program, diag);
        if (!result) draw_list(gl, portion, DP_GL_ADDED_JOINTS);
    }
    gl->api.Disable(GL_DEPTH_CLAMP);
    gl->api.Disable(GL_DEPTH_TEST);
    return result;
}

/* Tests by shader: only what lies behind the faces is asked. */
static void test_behind(dp_gl *gl) {
    gl->api.Enable(GL_DEPTH_TEST);
    gl->api.DepthFunc(GL_LEQUAL);
    gl->api.DepthMask(GL_FALSE);
}
static void test_no_more(dp_gl *gl) {
    gl->api.DepthMask(GL_TRUE);
    gl->api.Disable(GL_DEPTH_TEST);
}

static dp_result draw_valleys(dp_gl *gl, uint32_t portion, dp_diag *diag) {
    const dp_style *const s = &gl->style;
    const dp_gl_program_desc desc = {
        .vertex = "quads.vert",
        .fragment = "quads_trapped.frag",
        .defines = s->between == DP_BETWEEN_INTERVAL ? "#define INTERVAL\n" : NULL};
    float move[2];
    uint32_t program;
    clearly_behind(gl, move);
    dp_result result = dp_gl_quads_attach(gl, &gl->quads->trapped, &gl->faces.depth, diag);
    if (!result)
        result = use(gl, &desc, move, trap_of(s, DP_LINE_VALLEY), DP_LINE_VALLEY, &program, diag);
    if (result) return result;
    test_behind(gl);
    gl->api.Enable(GL_DEPTH_CLAMP);
    draw_list(gl, portion, DP_GL_ADDED_VALLEYS);
    gl->api.Disable(GL_DEPTH_CLAMP);
    test_no_more(gl);
    return DP_OK;
}

/* ------- faces ------- */

static void draw_scene(dp_gl *gl, bool fronts_alone) {
    const dp_gl_api *const a = &gl->api;
    a->Enable(GL_CLIP_DISTANCE0);
    if (fronts_alone || gl->style.cull_back_faces) {
        a->FrontFace(GL_CW); /* rows run from the top down here */
        a->Enable(GL_CULL_FACE);
    }
    a->DrawArrays(GL_TRIANGLES, 0, (GLsizei)(3 * gl->scene.triangle_count));
    a->Disable(GL_CULL_FACE);
    a->FrontFace(GL_CCW);
    a->Disable(GL_CLIP_DISTANCE0);
}

static dp_result draw_crossings(dp_gl *gl, dp_diag *diag) {
    const dp_style *const s = &gl->style;
    const bool interval = s->between == DP_BETWEEN_INTERVAL;
    const dp_gl_program_desc desc = {.vertex = "quads_face.vert",
                                     .fragment = "quads_crossing.frag",
                                     .defines = interval ? "#define INTERVAL\n" : NULL};
    float move[2];
    uint32_t program;
    clearly_behind(gl, move);
    dp_result result = dp_gl_quads_attach(gl, &gl->quads->trapped, &gl->faces.depth, diag);
    if (!result)
        result = use(gl, &desc, move, trap_of(s, DP_LINE_INTERSECTION), DP_LINE_INTERSECTION,
                     &program, diag);
    if (result) return result;
    dp_gl_uniform_f(gl, program, "nearer", 0);
    test_behind(gl);
    draw_scene(gl, interval);
    test_no_more(gl);
    return DP_OK;
}

/* ------- the stencil buffer (Raskar 2001, 7) ------- */

static void count_by(dp_gl *gl, GLenum operation) {
    gl->api.StencilFuncSeparate(GL_FRONT_AND_BACK, GL_ALWAYS, 0, 0xff);
    gl->api.StencilMaskSeparate(GL_FRONT_AND_BACK, 0xff);
    gl->api.StencilOpSeparate(GL_FRONT_AND_BACK, GL_KEEP, GL_KEEP, operation);
}

static dp_result begin_count(dp_gl *gl, dp_diag *diag) {
    const dp_gl_api *const a = &gl->api;
    const dp_result result = dp_gl_quads_attach(gl, &gl->quads->trapped, &gl->quads->stencil, diag);
    if (result) return result;
    a->Enable(GL_STENCIL_TEST);
    a->Enable(GL_DEPTH_TEST);
    a->DepthFunc(GL_GREATER);
    a->DepthMask(GL_FALSE);
    a->ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    return DP_OK;
}
static void end_count(dp_gl *gl) {
    gl->api.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl->api.DepthMask(GL_TRUE);
    gl->api.Disable(GL_DEPTH_TEST);
    gl->api.Disable(GL_STENCIL_TEST);
}

/* Valleys that are nearer than the surface count down; moved nearer by the offset, up. */
static dp_result count_valleys(dp_gl *gl, uint32_t portion, dp_diag *diag) {
    static const dp_gl_program_desc desc = {.vertex = "quads.vert", .fragment = "quads_line.frag"};
    static const float stay[2] = {1, 0};
    float nearer[2];
    uint32_t program;
    dp_gl_depth_move(gl, -(double)gl->style.between_offset, nearer);
    dp_result result = begin_count(gl, diag);
    if (!result) result = use(gl, &desc, stay, 0, DP_LINE_VALLEY, &program, diag);
    if (!result) {
        gl->api.Enable(GL_DEPTH_CLAMP);
        count_by(gl, GL_DECR_WRAP);
        draw_list(gl, portion, DP_GL_ADDED_VALLEYS);
        dp_gl_uniform_2f(gl, program, "depth_move", nearer);
        count_by(gl, GL_INCR_WRAP);
        draw_list(gl, portion, DP_GL_ADDED_VALLEYS);
        gl->api.Disable(GL_DEPTH_CLAMP);
    }
    end_count(gl);
    return result;
}

/* The same of faces: in the first walk they are moved a little, so that the surface and its duplicates count in both. */
static dp_result count_faces(dp_gl *gl, dp_diag *diag) {
    static const dp_gl_program_desc desc = {.vertex = "quads_face.vert"};
    static const float stay[2] = {1, 0}, same = 2;
    float nearer[2];
    uint32_t program;
    dp_gl_depth_move(gl, -(double)gl->style.between_offset, nearer);
    dp_result result = begin_count(gl, diag);
    if (!result) result = use(gl, &desc, stay, 0, DP_LINE_INTERSECTION, &program, diag);
    if (!result) {
        gl->api.Enable(GL_DEPTH_CLAMP); /* what is nearer than the near plane counts in both */
        dp_gl_uniform_f(gl, program, "nearer", same);
        count_by(gl, GL_DECR_WRAP);
        draw_scene(gl, true);
        dp_gl_uniform_f(gl, program, "nearer", 0);
        dp_gl_uniform_2f(gl, program, "depth_move", nearer);
        count_by(gl, GL_INCR_WRAP);
        draw_scene(gl, true);
        gl->api.Disable(GL_DEPTH_CLAMP);
    }
    end_count(gl);
    return result;
}

/* Inks samples whose count is not 0, and clears it. */
static dp_result ink_counted(dp_gl *gl, dp_line line, dp_diag *diag) {
    static const dp_gl_program_desc desc = {.vertex = "whole.vert",
                                            .fragment = "quads_stencil.frag"};
    const dp_gl_api *const a = &gl->api;
    uint32_t program;
    dp_result result = dp_gl_quads_attach(gl, &gl->quads->trapped, &gl->quads->stencil, diag);
    if (!result) result = dp_gl_program(gl, &desc, &program, diag);
    if (result) return result;
    dp_gl_use(gl, program);
    dp_gl_faces_bind(gl, program);
    dp_gl_uniform_u(gl, program, "line", line);
    a->Enable(GL_STENCIL_TEST);
    a->StencilFuncSeparate(GL_FRONT_AND_BACK, GL_NOTEQUAL, 0, 0xff);
    a->StencilMaskSeparate(GL_FRONT_AND_BACK, 0xff);
    a->StencilOpSeparate(GL_FRONT_AND_BACK, GL_KEEP, GL_ZERO, GL_ZERO);
    dp_gl_draw_whole(gl);
    a->Disable(GL_STENCIL_TEST);
    return DP_OK;
}

/* ------- the picture ------- */

static dp_result draw_added(dp_gl *gl, dp_diag *diag) {
    const bool stencil = gl->style.between == DP_BETWEEN_STENCIL;
    dp_gl_portions portions;
    dp_result result = dp_gl_quads_portion(gl, false, &portions, diag);
    for (uint32_t i = 0; !result && i < portions.count; i++) {
        result = dp_gl_quads_shade(gl, &portions, i, false, diag);
        if (!result) result = draw_lines(gl, &portions, i, diag);
        if (!result && portions.room[DP_GL_ADDED_VALLEYS])
            result = stencil ? count_valleys(gl, i, diag) : draw_valleys(gl, i, diag);
    }
    return result;
}

static dp_result draw_passes(dp_gl *gl, dp_diag *diag) {
    const dp_style *const s = &gl->style;
    const bool stencil = s->between == DP_BETWEEN_STENCIL;
    const uint32_t added = DP_SILHOUETTE | DP_RIDGE | DP_BORDER | DP_VALLEY;
    dp_result result = s->lines & added ? draw_added(gl, diag) : DP_OK;
    if (!result && stencil && s->lines & DP_VALLEY) result = ink_counted(gl, DP_LINE_VALLEY, diag);
    if (result || !(s->lines & DP_INTERSECTION)) return result;
    if (!stencil) return draw_crossings(gl, diag);
    result = count_faces(gl, diag);
    return result ? result : ink_counted(gl, DP_LINE_INTERSECTION, diag);
}

/* Copies the picture: it is read where it is written. */
static dp_result copy_picture(dp_gl *gl, dp_diag *diag) {
    const dp_gl_api *const a = &gl->api;
    dp_gl_quads *const q = gl->quads;
    const GLint w = (GLint)gl->target.width, h = (GLint)gl->target.height;
    dp_result result = dp_gl_texture_reserve(gl, &q->under, GL_RGBA8, gl->target.width,
                                             gl->target.height, 0, "the picture beneath ink", diag);
    if (!result) result = dp_gl_quads_attach(gl, &q->under, NULL, diag);
    if (result) return result;
    a->BindFramebuffer(GL_READ_FRAMEBUFFER, gl->surface.framebuffer);
    a->ReadBuffer(GL_COLOR_ATTACHMENT0);
    a->BlitFramebuffer(0, 0, w, h, 0, 0, w, h, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    return DP_OK;
}

static void bind(dp_gl *gl, uint32_t program, const dp_gl_texture *texture, uint32_t i,
                 const char *name) {
    dp_gl_texture_bind(gl, texture, DP_GL_UNIT_OWN + i);
    dp_gl_uniform_i(gl, program, name, (GLint)(DP_GL_UNIT_OWN + i));
}

static dp_result put(dp_gl *gl, bool layered, dp_diag *diag) {
    static const char *const defines[2][2] = {
        {"", "#define ONCE\n"}, {"#define LAYERED\n", "#define LAYERED\n#define ONCE\n"}};
    const bool once = dp_gl_is_once(&gl->style);
    const dp_gl_program_desc desc = {
        .vertex = "whole.vert", .fragment = "quads_put.frag", .defines = defines[layered][once]};
    dp_gl_quads *const q = gl->quads;
    uint32_t program;
    dp_result result = layered ? copy_picture(gl, diag) : DP_OK;
    if (!result) result = dp_gl_program(gl, &desc, &program, diag);
    if (!result) result = dp_gl_quads_attach(gl, &gl->surface.picture, NULL, diag);
    if (result) return result;
    dp_gl_use(gl, program);
    dp_gl_scene_bind(gl);
    dp_gl_faces_bind(gl, program);
    bind(gl, program, &q->lines, 0, "lines");
    bind(gl, program, &q->trapped, 1, "trapped");
    bind(gl, program, &q->depth, 2, "line_depths");
    if (layered) bind(gl, program, &q->under, 3, "under");
    if (once) dp_gl_buffer_bind(gl, &q->states, DP_GL_BIND_OWN + 2);
    dp_gl_buffer_bind(gl, &q->faces, DP_GL_BIND_OWN + 3);
    dp_gl_uniform_2f(gl, program, "depth_range", q->range);
    dp_gl_draw_whole(gl);
    return DP_OK;
}

/* Is the surface shaded, and ink a layer over it (picture.c)? */
static bool is_layered(const dp_style *s) {
    return s->shade.shading != DP_SHADING_FLAT || s->edge_map.detector || s->shade.model_colors;
}

dp_result dp_gl_ink_quads(dp_gl *gl, dp_diag *diag) {
    if (!gl->quads) gl->quads = dp_alloc_zeroed(&gl->memory, sizeof *gl->quads);
    if (!gl->quads) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for added polygons");
    dp_gl_depth_range(gl, gl->quads->range);
    dp_result result = reserve(gl, diag);
    if (!result) result = place_faces(gl, diag);
    if (!result) result = begin(gl, diag);
    if (!result)
        result = dp_gl_is_once(&gl->style) ? dp_gl_quads_once(gl, diag) : draw_passes(gl, diag);
    if (!result) gl->api.MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
    return result ? result : put(gl, is_layered(&gl->style), diag);
}

void dp_gl_quads_free(dp_gl *gl) {
    dp_gl_quads *const q = gl->quads;
    if (!q) return;
    if (!gl->is_lost) {
        dp_gl_texture *const textures[] = {&q->lines, &q->depth, &q->trapped, &q->stencil,
                                           &q->under};
        dp_gl_buffer *const buffers[] = {&q->records, &q->commands, &q->faces, &q->blocks,
                                         &q->counts,  &q->order,    &q->states};
        for (size_t i = 0; i < sizeof textures / sizeof *textures; i++)
            dp_gl_texture_free(gl, textures[i]);
        for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++)
            dp_gl_buffer_free(gl, buffers[i]);
        if (q->framebuffer) gl->api.DeleteFramebuffers(1, &q->framebuffer);
    }
    dp_free(&gl->memory, q);
    gl->quads = NULL;
}
