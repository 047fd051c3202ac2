/* What of the context's state this library touches: remembered before a call, given back after it.
 *
 * Three tables say it: switches that glEnable knows, bindings of textures and buffers, and single values;
 * dp_gl_enter reads them all and sets what our passes take for granted (nothing tested, blended, masked or
 * scissored), dp_gl_leave writes them back. With dp_gl_desc.leaves_state_changed nothing is asked.
 * Invariant: whatever a pass enables, binds or sets is in one of these tables. */
#include "gl/gl.h"

enum {
    SWITCHES = 28,
    VIEWPORTS = 16, /* glViewport sets all */
    IMAGES = 4,
    UNIFORM_BLOCKS = 3,
    PACKS = 7,
    UNPACKS = 7
};

/* Switches that passes use, all off when a call begins. */
static const GLenum switches[] = {GL_BLEND,
                                  GL_CULL_FACE,
                                  GL_DEPTH_TEST,
                                  GL_STENCIL_TEST,
                                  GL_COLOR_LOGIC_OP,
                                  GL_POLYGON_OFFSET_FILL,
                                  GL_POLYGON_OFFSET_LINE, /* llvmpipe offsets all by them */
                                  GL_POLYGON_OFFSET_POINT,
                                  GL_POLYGON_SMOOTH,
                                  GL_RASTERIZER_DISCARD,
                                  GL_SAMPLE_ALPHA_TO_COVERAGE,
                                  GL_SAMPLE_ALPHA_TO_ONE,
                                  GL_SAMPLE_COVERAGE,
                                  GL_SAMPLE_MASK,
                                  GL_SAMPLE_SHADING,
                                  GL_PRIMITIVE_RESTART,
                                  GL_PRIMITIVE_RESTART_FIXED_INDEX,
                                  GL_DEPTH_CLAMP,
                                  GL_FRAMEBUFFER_SRGB,
                                  GL_DITHER,
                                  GL_CLIP_DISTANCE0,
                                  GL_CLIP_DISTANCE0 + 1,
                                  GL_CLIP_DISTANCE0 + 2,
                                  GL_CLIP_DISTANCE0 + 3,
                                  GL_CLIP_DISTANCE0 + 4,
                                  GL_CLIP_DISTANCE0 + 5,
                                  GL_CLIP_DISTANCE0 + 6,
                                  GL_CLIP_DISTANCE0 + 7};

typedef struct unit {
    GLint plain, multisample, layered, sampler;
} unit;

typedef struct block {
    GLint name;
    GLint64 start, size;
} block;

typedef struct image {
    GLint name, level, layered, layer, access, format;
} image;

typedef struct stencil {
    GLint func, ref, value_mask, write_mask, fail, depth_fail, depth_pass;
} stencil;

/* Of one draw buffer. */
typedef struct blending {
    GLboolean mask[4], on;
    GLint rgb, alpha, source_rgb, source_alpha, target_rgb, target_alpha;
} blending;

struct dp_gl_state {
    GLboolean on[SWITCHES], scissor, multisample, depth_mask;
    blending buffers[DP_GL_DRAW_BUFFERS];
    GLint program, vertex_array, draw_framebuffer, read_framebuffer, active_unit;
    GLint polygon_mode[2], front_face, cull_face, depth_func, provoking;
    GLint clip_origin, clip_depth;
    GLfloat viewports[VIEWPORTS][4];
    GLdouble depth_range[2];
    GLint array_buffer, storage_buffer, uniform_buffer, indirect_buffer, dispatch_buffer;
    GLint copy_read, copy_write, pack_buffer, unpack_buffer;
    GLint pack[PACKS], unpack[UNPACKS];
    stencil faces[2];
    unit units[DP_GL_UNITS];
    block storage[DP_GL_BINDINGS], uniforms[UNIFORM_BLOCKS];
    image images[IMAGES];
};

static const GLenum pack_names[PACKS] = {
    GL_PACK_ALIGNMENT,   GL_PACK_ROW_LENGTH,   GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS,
    GL_PACK_SKIP_IMAGES, GL_PACK_IMAGE_HEIGHT, GL_PACK_SWAP_BYTES};
static const GLenum unpack_names[UNPACKS] = {
    GL_UNPACK_ALIGNMENT,    GL_UNPACK_ROW_LENGTH,  GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS,
    GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_IMAGES, GL_UNPACK_SWAP_BYTES};
static const GLint pack_values[PACKS] = {1}; /* the others are 0; the same for both */

/* Buffers that are bound to targets without an index. */
static void for_buffers(dp_gl_state *s, void (*visit)(dp_gl *, GLenum, GLenum, GLint *),
                        dp_gl *gl) {
    visit(gl, GL_ARRAY_BUFFER, GL_ARRAY_BUFFER_BINDING, &s->array_buffer);
    visit(gl, GL_SHADER_STORAGE_BUFFER, GL_SHADER_STORAGE_BUFFER_BINDING, &s->storage_buffer);
    visit(gl, GL_UNIFORM_BUFFER, GL_UNIFORM_BUFFER_BINDING, &s->uniform_buffer);
    visit(gl, GL_DRAW_INDIRECT_BUFFER, GL_DRAW_INDIRECT_BUFFER_BINDING, &s->indirect_buffer);
    visit(gl, GL_DISPATCH_INDIRECT_BUFFER, GL_DISPATCH_INDIRECT_BUFFER_BINDING,
          &s->dispatch_buffer);
    visit(gl, GL_COPY_READ_BUFFER, GL_COPY_READ_BUFFER_BINDING, &s->copy_read);
    visit(gl, GL_COPY_WRITE_BUFFER, GL_COPY_WRITE_BUFFER_BINDING, &s->copy_write);
    visit(gl, GL_PIXEL_PACK_BUFFER, GL_PIXEL_PACK_BUFFER_BINDING, &s->pack_buffer);
    visit(gl, GL_PIXEL_UNPACK_BUFFER, GL_PIXEL_UNPACK_BUFFER_BINDING, &s->unpack_buffer);
}
static void ask_buffer(dp_gl *gl, GLenum target, GLenum binding, GLint *name) {
    (void)target;
    gl->api.GetIntegerv(binding, name);
}
static void bind_buffer(dp_gl *gl, GLenum target, GLenum binding, GLint *name) {
    (void)binding;
    gl->api.BindBuffer(target, (GLuint)*name);
}

static void ask_switches(dp_gl *gl, dp_gl_state *s) {
    const dp_gl_api *const a = &gl->api;
    for (size_t i = 0; i < SWITCHES; i++) s->on[i] = a->IsEnabled(switches[i]);
    s->multisample = a->IsEnabled(GL_MULTISAMPLE);
    a->GetBooleanv(GL_DEPTH_WRITEMASK, &s->depth_mask);
    s->scissor = a->IsEnabledi(GL_SCISSOR_TEST, 0);
}

static void ask_blending(dp_gl *gl, dp_gl_state *s) {
    const dp_gl_api *const a = &gl->api;
    for (GLuint i = 0; i < DP_GL_DRAW_BUFFERS; i++) {
        blending *const b = &s->buffers[i];
        a->GetBooleani_v(GL_COLOR_WRITEMASK, i, b->mask);
        b->on = a->IsEnabledi(GL_BLEND, i);
        a->GetIntegeri_v(GL_BLEND_EQUATION_RGB, i, &b->rgb);
        a->GetIntegeri_v(GL_BLEND_EQUATION_ALPHA, i, &b->alpha);
        a->GetIntegeri_v(GL_BLEND_SRC_RGB, i, &b->source_rgb);
        a->GetIntegeri_v(GL_BLEND_SRC_ALPHA, i, &b->source_alpha);
        a->GetIntegeri_v(GL_BLEND_DST_RGB, i, &b->target_rgb);
        a->GetIntegeri_v(GL_BLEND_DST_ALPHA, i, &b->target_alpha);
    }
}

static void ask_values(dp_gl *gl, dp_gl_state *s) {
    const dp_gl_api *const a = &gl->api;
    a->GetIntegerv(GL_CURRENT_PROGRAM, &s->program);
    a->GetIntegerv(GL_VERTEX_ARRAY_BINDING, &s->vertex_array);
    a->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &s->draw_framebuffer);
    a->GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &s->read_framebuffer);
    for (GLuint i = 0; i < VIEWPORTS; i++) a->GetFloati_v(GL_VIEWPORT, i, s->viewports[i]);
    a->GetIntegerv(GL_POLYGON_MODE, s->polygon_mode);
    a->GetIntegerv(GL_FRONT_FACE, &s->front_face);
    a->GetIntegerv(GL_CULL_FACE_MODE, &s->cull_face);
    a->GetIntegerv(GL_DEPTH_FUNC, &s->depth_func);
    a->GetIntegerv(GL_PROVOKING_VERTEX, &s->provoking);
    a->GetDoublei_v(GL_DEPTH_RANGE, 0, s->depth_range);
    if (gl->has_clip_control) {
        a->GetIntegerv(GL_CLIP_ORIGIN, &s->clip_origin);
        a->GetIntegerv(GL_CLIP_DEPTH_MODE, &s->clip_depth);
    }
    for (int i = 0; i < PACKS; i++) a->GetIntegerv(pack_names[i], &s->pack[i]);
    for (int i = 0; i < UNPACKS; i++) a->GetIntegerv(unpack_names[i], &s->unpack[i]);
}

static void ask_stencil(dp_gl *gl, dp_gl_state *s) {
    static const GLenum names[2][7] = {
        {GL_STENCIL_FUNC, GL_STENCIL_REF, GL_STENCIL_VALUE_MASK, GL_STENCIL_WRITEMASK,
         GL_STENCIL_FAIL, GL_STENCIL_PASS_DEPTH_FAIL, GL_STENCIL_PASS_DEPTH_PASS},
        {GL_STENCIL_BACK_FUNC, GL_STENCIL_BACK_REF, GL_STENCIL_BACK_VALUE_MASK,
         GL_STENCIL_BACK_WRITEMASK, GL_STENCIL_BACK_FAIL, GL_STENCIL_BACK_PASS_DEPTH_FAIL,
         GL_STENCIL_BACK_PASS_DEPTH_PASS}};
    for (int i = 0; i < 2; i++) {
        stencil *const f = &s->faces[i];
        GLint *const to[7] = {&f->func, &f->ref,        &f->value_mask, &f->write_mask,
                              &f->fail, &f->depth_fail, &f->depth_pass};
        for (int k = 0; k < 7; k++) gl->api.GetIntegerv(names[i][k], to[k]);
    }
}

static void ask_units(dp_gl *gl, dp_gl_state *s) {
    const dp_gl_api *const a = &gl->api;
    a->GetIntegerv(GL_ACTIVE_TEXTURE, &s->active_unit);
    for (GLuint i = 0; i < DP_GL_UNITS; i++) {
        a->ActiveTexture(GL_TEXTURE0 + i);
        a->GetIntegerv(GL_TEXTURE_BINDING_2D, &s->units[i].plain);
        a->GetIntegerv(GL_TEXTURE_BINDING_2D_MULTISAMPLE, &s->units[i].multisample);
        a->GetIntegerv(GL_TEXTURE_BINDING_2D_ARRAY, &s->units[i].layered);
        a->GetIntegerv(GL_SAMPLER_BINDING, &s->units[i].sampler);
        a->BindSampler(i, 0);
    }
}

static block ask_block(dp_gl *gl, GLuint i, GLenum binding, GLenum start, GLenum size) {
    block b = {0};
    gl->api.GetIntegeri_v(binding, i, &b.name);
    gl->api.GetInteger64i_v(start, i, &b.start);
    gl->api.GetInteger64i_v(size, i, &b.size);
    return b;
}

static void ask_blocks(dp_gl *gl, dp_gl_state *s) {
    for (GLuint i = 0; i < DP_GL_BINDINGS; i++)
        s->storage[i] = ask_block(gl, i, GL_SHADER_STORAGE_BUFFER_BINDING,
                                  GL_SHADER_STORAGE_BUFFER_START, GL_SHADER_STORAGE_BUFFER_SIZE);
    for (GLuint i = 0; i < UNIFORM_BLOCKS; i++)
        s->uniforms[i] = ask_block(gl, i, GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START,
                                   GL_UNIFORM_BUFFER_SIZE);
    for (GLuint i = 0; i < IMAGES; i++) {
        image *const m = &s->images[i];
        gl->api.GetIntegeri_v(GL_IMAGE_BINDING_NAME, i, &m->name);
        gl->api.GetIntegeri_v(GL_IMAGE_BINDING_LEVEL, i, &m->level);
        gl->api.GetIntegeri_v(GL_IMAGE_BINDING_LAYERED, i, &m->layered);
        gl->api.GetIntegeri_v(GL_IMAGE_BINDING_LAYER, i, &m->layer);
        gl->api.GetIntegeri_v(GL_IMAGE_BINDING_ACCESS, i, &m->access);
        gl->api.GetIntegeri_v(GL_IMAGE_BINDING_FORMAT, i, &m->format);
    }
}

/* What passes take for granted. */
static void set_plain(dp_gl *gl) {
    const dp_gl_api *const a = &gl->api;
    for (size_t i = 0; i < SWITCHES; i++) a->Disable(switches[i]);
    a->Disablei(GL_SCISSOR_TEST, 0);
    a->Enable(GL_MULTISAMPLE);
    a->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    a->DepthMask(GL_TRUE);
    a->DepthFunc(GL_LESS);
    a->DepthRangeIndexed(0, 0, 1);
    a->PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    a->FrontFace(GL_CCW);
    a->CullFace(GL_BACK);
    a->ProvokingVertex(GL_LAST_VERTEX_CONVENTION);
    a->BlendEquation(GL_FUNC_ADD);
    a->BlendFunc(GL_ONE, GL_ZERO);
    if (gl->has_clip_control) a->ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    for (int i = 0; i < PACKS; i++) a->PixelStorei(pack_names[i], pack_values[i]);
    for (int i = 0; i < UNPACKS; i++) a->PixelStorei(unpack_names[i], pack_values[i]);
    a->BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    a->BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    a->BindVertexArray(gl->vertex_array);
}

/* What no call can draw under: a lost context, and transform feedback, which forbids other programs. */
static dp_result check_context(dp_gl *gl, dp_diag *diag) {
    GLboolean feeds = GL_FALSE, paused = GL_FALSE;
    dp_gl_forget_errors(gl);
    if (gl->is_lost)
        return dp_fail(diag, DP_ERR_IO,
                       "the OpenGL context was lost: make another one, and another dp_gl for it");
    gl->api.GetBooleanv(GL_TRANSFORM_FEEDBACK_ACTIVE, &feeds);
    gl->api.GetBooleanv(GL_TRANSFORM_FEEDBACK_PAUSED, &paused);
    if (feeds && !paused)
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "transform feedback is active: end or pause it before this call");
    return DP_OK;
}

dp_result dp_gl_enter(dp_gl *gl, dp_gl_state **state, dp_diag *diag) {
    *state = NULL;
    const dp_result result = check_context(gl, diag);
    if (result) return result;
    if (!gl->desc.leaves_state_changed) {
        dp_gl_state *const s = dp_alloc_zeroed(&gl->memory, sizeof *s);
        if (!s) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for the context's state");
        ask_switches(gl, s);
        ask_blending(gl, s);
        ask_values(gl, s);
        ask_stencil(gl, s);
        for_buffers(s, ask_buffer, gl);
        ask_units(gl, s);
        ask_blocks(gl, s);
        *state = s;
    }
    set_plain(gl);
    return DP_OK;
}

static void give_switches(dp_gl *gl, const dp_gl_state *s) {
    const dp_gl_api *const a = &gl->api;
    for (size_t i = 0; i < SWITCHES; i++)
        if (s->on[i])
            a->Enable(switches[i]);
        else
            a->Disable(switches[i]);
    if (s->scissor) a->Enablei(GL_SCISSOR_TEST, 0);
    if (!s->multisample) a->Disable(GL_MULTISAMPLE);
    a->DepthMask(s->depth_mask);
}

static void give_blending(dp_gl *gl, const dp_gl_state *s) {
    const dp_gl_api *const a = &gl->api;
    for (GLuint i = 0; i < DP_GL_DRAW_BUFFERS; i++) {
        const blending *const b = &s->buffers[i];
        a->ColorMaski(i, b->mask[0], b->mask[1], b->mask[2], b->mask[3]);
        a->BlendEquationSeparatei(i, (GLenum)b->rgb, (GLenum)b->alpha);
        a->BlendFuncSeparatei(i, (GLenum)b->source_rgb, (GLenum)b->target_rgb,
                              (GLenum)b->source_alpha, (GLenum)b->target_alpha);
        if (b->on)
            a->Enablei(GL_BLEND, i);
        else
            a->Disablei(GL_BLEND, i);
    }
}

static void give_stencil(dp_gl *gl, const dp_gl_state *s) {
    for (int i = 0; i < 2; i++) {
        const stencil *const f = &s->faces[i];
        const GLenum face = i ? GL_BACK : GL_FRONT;
        gl->api.StencilFuncSeparate(face, (GLenum)f->func, f->ref, (GLuint)f->value_mask);
        gl->api.StencilMaskSeparate(face, (GLuint)f->write_mask);
        gl->api.StencilOpSeparate(face, (GLenum)f->fail, (GLenum)f->depth_fail,
                                  (GLenum)f->depth_pass);
    }
}

static void give_units(dp_gl *gl, const dp_gl_state *s) {
    const dp_gl_api *const a = &gl->api;
    for (GLuint i = 0; i < DP_GL_UNITS; i++) {
        a->ActiveTexture(GL_TEXTURE0 + i);
        a->BindTexture(GL_TEXTURE_2D, (GLuint)s->units[i].plain);
        a->BindTexture(GL_TEXTURE_2D_MULTISAMPLE, (GLuint)s->units[i].multisample);
        a->BindTexture(GL_TEXTURE_2D_ARRAY, (GLuint)s->units[i].layered);
        a->BindSampler(i, (GLuint)s->units[i].sampler);
    }
    a->ActiveTexture((GLenum)s->active_unit);
}

static void give_block(dp_gl *gl, GLenum target, GLuint i, const block *b) {
    if (b->name && b->size)
        gl->api.BindBufferRange(target, i, (GLuint)b->name, (GLintptr)b->start,
                                (GLsizeiptr)b->size);
    else
        gl->api.BindBufferBase(target, i, (GLuint)b->name);
}

static void give_blocks(dp_gl *gl, const dp_gl_state *s) {
    for (GLuint i = 0; i < DP_GL_BINDINGS; i++)
        give_block(gl, GL_SHADER_STORAGE_BUFFER, i, &s->storage[i]);
    for (GLuint i = 0; i < UNIFORM_BLOCKS; i++)
        give_block(gl, GL_UNIFORM_BUFFER, i, &s->uniforms[i]);
    for (GLuint i = 0; i < IMAGES; i++) {
        const image *const m = &s->images[i];
        gl->api.BindImageTexture(i, (GLuint)m->name, m->level, (GLboolean)m->layered, m->layer,
                                 (GLenum)m->access, m->format ? (GLenum)m->format : GL_R8);
    }
}

static void give_values(dp_gl *gl, const dp_gl_state *s) {
    const dp_gl_api *const a = &gl->api;
    a->UseProgram((GLuint)s->program);
    a->BindVertexArray((GLuint)s->vertex_array);
    a->BindFramebuffer(GL_DRAW_FRAMEBUFFER, (GLuint)s->draw_framebuffer);
    a->BindFramebuffer(GL_READ_FRAMEBUFFER, (GLuint)s->read_framebuffer);
    for (GLuint i = 0; i < VIEWPORTS; i++)
        a->ViewportIndexedf(i, s->viewports[i][0], s->viewports[i][1], s->viewports[i][2],
                            s->viewports[i][3]);
    a->PolygonMode(GL_FRONT_AND_BACK, (GLenum)s->polygon_mode[0]);
    a->FrontFace((GLenum)s->front_face);
    a->CullFace((GLenum)s->cull_face);
    a->DepthFunc((GLenum)s->depth_func);
    a->ProvokingVertex((GLenum)s->provoking);
    a->DepthRangeIndexed(0, s->depth_range[0], s->depth_range[1]);
    if (gl->has_clip_control) a->ClipControl((GLenum)s->clip_origin, (GLenum)s->clip_depth);
    for (int i = 0; i < PACKS; i++) a->PixelStorei(pack_names[i], s->pack[i]);
    for (int i = 0; i < UNPACKS; i++) a->PixelStorei(unpack_names[i], s->unpack[i]);
}

void dp_gl_leave(dp_gl *gl, dp_gl_state *state) {
    if (!state) return;
    give_blocks(gl, state);
    for_buffers(state, bind_buffer, gl);
    give_units(gl, state);
    give_stencil(gl, state);
    give_switches(gl, state);
    give_blending(gl, state);
    give_values(gl, state);
    dp_free(&gl->memory, state);
}
