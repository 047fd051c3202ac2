/* What of the context's state this library touches: remembered before a call, given back after it.
 *
 * Three tables say it: switches that glEnable knows, bindings of textures and buffers, and single values;
 * dp_gl_enter reads them all and sets what our passes take for granted (nothing tested, blended, masked or
 * scissored), dp_gl_leave writes them back. With dp_gl_desc.leaves_state_changed nothing is asked.
 * Invariant: whatever a pass enables, binds or sets is in one of these tables. */
#include "gl/gl.h"

enum { SWITCHES = 20, COLOR_MASKS = 4, IMAGES = 4, UNIFORM_BLOCKS = 3 };

/* Switches that passes use, all off when a call begins. */
static const GLenum switches[] = {GL_BLEND,
                                  GL_CULL_FACE,
                                  GL_DEPTH_TEST,
                                  GL_STENCIL_TEST,
                                  GL_SCISSOR_TEST,
                                  GL_COLOR_LOGIC_OP,
                                  GL_POLYGON_OFFSET_FILL,
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
                                  GL_CLIP_DISTANCE0};

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

struct dp_gl_state {
    GLboolean on[SWITCHES], multisample, depth_mask, color_masks[COLOR_MASKS][4],
        blends[COLOR_MASKS];
    GLint program, vertex_array, draw_framebuffer, read_framebuffer, active_unit;
    GLint viewport[4], scissor[4], polygon_mode[2], front_face, cull_face, depth_func, provoking;
    GLint blend_rgb, blend_alpha, source_rgb, source_alpha, target_rgb, target_alpha;
    GLint clip_origin, clip_depth;
    GLfloat depth_range[2];
    GLint array_buffer, storage_buffer, uniform_buffer, indirect_buffer, dispatch_buffer;
    GLint copy_read, copy_write, pack_buffer, unpack_buffer;
    GLint pack[4], unpack[6];
    stencil faces[2];
    unit units[DP_GL_UNITS];
    block storage[DP_GL_BINDINGS], uniforms[UNIFORM_BLOCKS];
    image images[IMAGES];
};

static const GLenum pack_names[4] = {GL_PACK_ALIGNMENT, GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS,
                                     GL_PACK_SKIP_PIXELS};
static const GLint pack_values[4] = {1, 0, 0, 0};
static const GLenum unpack_names[6] = {GL_UNPACK_ALIGNMENT,    GL_UNPACK_ROW_LENGTH,
                                       GL_UNPACK_SKIP_ROWS,    GL_UNPACK_SKIP_PIXELS,
                                       GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_IMAGES};
static const GLint unpack_values[6] = {1, 0, 0, 0, 0, 0};

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
    for (GLuint i = 0; i < COLOR_MASKS; i++) {
        a->GetBooleani_v(GL_COLOR_WRITEMASK, i, s->color_masks[i]);
        s->blends[i] = a->IsEnabledi(GL_BLEND, i);
    }
}

static void ask_values(dp_gl *gl, dp_gl_state *s) {
    const dp_gl_api *const a = &gl->api;
    a->GetIntegerv(GL_CURRENT_PROGRAM, &s->program);
    a->GetIntegerv(GL_VERTEX_ARRAY_BINDING, &s->vertex_array);
    a->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &s->draw_framebuffer);
    a->GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &s->read_framebuffer);
    a->GetIntegerv(GL_VIEWPORT, s->viewport);
    a->GetIntegerv(GL_SCISSOR_BOX, s->scissor);
    a->GetIntegerv(GL_POLYGON_MODE, s->polygon_mode);
    a->GetIntegerv(GL_FRONT_FACE, &s->front_face);
    a->GetIntegerv(GL_CULL_FACE_MODE, &s->cull_face);
    a->GetIntegerv(GL_DEPTH_FUNC, &s->depth_func);
    a->GetIntegerv(GL_PROVOKING_VERTEX, &s->provoking);
    a->GetIntegerv(GL_BLEND_EQUATION_RGB, &s->blend_rgb);
    a->GetIntegerv(GL_BLEND_EQUATION_ALPHA, &s->blend_alpha);
    a->GetIntegerv(GL_BLEND_SRC_RGB, &s->source_rgb);
    a->GetIntegerv(GL_BLEND_SRC_ALPHA, &s->source_alpha);
    a->GetIntegerv(GL_BLEND_DST_RGB, &s->target_rgb);
    a->GetIntegerv(GL_BLEND_DST_ALPHA, &s->target_alpha);
    a->GetFloatv(GL_DEPTH_RANGE, s->depth_range);
    if (gl->has_clip_control) {
        a->GetIntegerv(GL_CLIP_ORIGIN, &s->clip_origin);
        a->GetIntegerv(GL_CLIP_DEPTH_MODE, &s->clip_depth);
    }
    for (int i = 0; i < 4; i++) a->GetIntegerv(pack_names[i], &s->pack[i]);
    for (int i = 0; i < 6; i++) a->GetIntegerv(unpack_names[i], &s->unpack[i]);
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
    a->Enable(GL_MULTISAMPLE);
    a->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    a->DepthMask(GL_TRUE);
    a->DepthFunc(GL_LESS);
    a->DepthRangef(0, 1);
    a->PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    a->FrontFace(GL_CCW);
    a->CullFace(GL_BACK);
    a->ProvokingVertex(GL_LAST_VERTEX_CONVENTION);
    a->BlendEquation(GL_FUNC_ADD);
    a->BlendFunc(GL_ONE, GL_ZERO);
    if (gl->has_clip_control) a->ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    for (int i = 0; i < 4; i++) a->PixelStorei(pack_names[i], pack_values[i]);
    for (int i = 0; i < 6; i++) a->PixelStorei(unpack_names[i], unpack_values[i]);
    a->BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    a->BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    a->BindVertexArray(gl->vertex_array);
}

dp_result dp_gl_enter(dp_gl *gl, dp_gl_state **state, dp_diag *diag) {
    *state = NULL;
    while (!gl->is_lost && gl->api.GetError() == GL_CONTEXT_LOST) gl->is_lost = true;
    if (gl->is_lost)
        return dp_fail(diag, DP_ERR_IO,
                       "the OpenGL context was lost: make another one, and another dp_gl for it");
    if (!gl->desc.leaves_state_changed) {
        dp_gl_state *const s = dp_alloc_zeroed(&gl->memory, sizeof *s);
        if (!s) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for the context's state");
        ask_switches(gl, s);
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
    if (!s->multisample) a->Disable(GL_MULTISAMPLE);
    a->DepthMask(s->depth_mask);
    for (GLuint i = 0; i < COLOR_MASKS; i++) {
        const GLboolean *const m = s->color_masks[i];
        a->ColorMaski(i, m[0], m[1], m[2], m[3]);
        if (s->blends[i])
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
    a->Viewport(s->viewport[0], s->viewport[1], s->viewport[2], s->viewport[3]);
    a->Scissor(s->scissor[0], s->scissor[1], s->scissor[2], s->scissor[3]);
    a->PolygonMode(GL_FRONT_AND_BACK, (GLenum)s->polygon_mode[0]);
    a->FrontFace((GLenum)s->front_face);
    a->CullFace((GLenum)s->cull_face);
    a->DepthFunc((GLenum)s->depth_func);
    a->ProvokingVertex((GLenum)s->provoking);
    a->BlendEquationSeparate((GLenum)s->blend_rgb, (GLenum)s->blend_alpha);
    a->BlendFuncSeparate((GLenum)s->source_rgb, (GLenum)s->target_rgb, (GLenum)s->source_alpha,
                         (GLenum)s->target_alpha);
    a->DepthRangef(s->depth_range[0], s->depth_range[1]);
    if (gl->has_clip_control) a->ClipControl((GLenum)s->clip_origin, (GLenum)s->clip_depth);
    for (int i = 0; i < 4; i++) a->PixelStorei(pack_names[i], s->pack[i]);
    for (int i = 0; i < 6; i++) a->PixelStorei(unpack_names[i], s->unpack[i]);
}

void dp_gl_leave(dp_gl *gl, dp_gl_state *state) {
    if (!state) return;
    give_blocks(gl, state);
    for_buffers(state, bind_buffer, gl);
    give_units(gl, state);
    give_stencil(gl, state);
    give_switches(gl, state);
    give_values(gl, state);
    dp_free(&gl->memory, state);
}
