/* Nothing of the application's state is changed: all that can be set is set to odd values, all that can be asked is
 * asked before and after calls. More than 600 lines: most are the lists of what can be set. */
#include "gl/figure.h"
#include "gl/gl.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 64, HEIGHT = 48, UNITS = 16, DRAWN_BUFFERS = 8, VIEWPORTS = 16, BLOCKS = 8 };

/* ------- what is asked ------- */

typedef struct answers {
    struct {
        GLenum what;
        int index;
        GLint64 value;
    } list[4096];
    size_t count;
} answers;

static void note(answers *n, GLenum what, int index, GLint64 value) {
    assert_true(n->count < sizeof n->list / sizeof *n->list);
    n->list[n->count].what = what, n->list[n->count].index = index;
    n->list[n->count++].value = value;
}

static const GLenum switches[] = {GL_BLEND,
                                  GL_COLOR_LOGIC_OP,
                                  GL_CULL_FACE,
                                  GL_DEPTH_CLAMP,
                                  GL_DEPTH_TEST,
                                  GL_DITHER,
                                  GL_FRAMEBUFFER_SRGB,
                                  GL_LINE_SMOOTH,
                                  GL_MULTISAMPLE,
                                  GL_POLYGON_OFFSET_FILL,
                                  GL_POLYGON_OFFSET_LINE,
                                  GL_POLYGON_OFFSET_POINT,
                                  GL_POLYGON_SMOOTH,
                                  GL_PRIMITIVE_RESTART,
                                  GL_PRIMITIVE_RESTART_FIXED_INDEX,
                                  GL_RASTERIZER_DISCARD,
                                  GL_SAMPLE_ALPHA_TO_COVERAGE,
                                  GL_SAMPLE_ALPHA_TO_ONE,
                                  GL_SAMPLE_COVERAGE,
                                  GL_SAMPLE_MASK,
                                  GL_SAMPLE_SHADING,
                                  GL_SCISSOR_TEST,
                                  GL_STENCIL_TEST,
                                  GL_TEXTURE_CUBE_MAP_SEAMLESS,
                                  GL_PROGRAM_POINT_SIZE,
                                  GL_DEBUG_OUTPUT,
                                  GL_DEBUG_OUTPUT_SYNCHRONOUS};

/* Each answers with up to four numbers. */
static const struct {
    GLenum what;
    int count;
} values[] = {{GL_CURRENT_PROGRAM, 1},
              {GL_PROGRAM_PIPELINE_BINDING, 1},
              {GL_VERTEX_ARRAY_BINDING, 1},
              {GL_DRAW_FRAMEBUFFER_BINDING, 1},
              {GL_READ_FRAMEBUFFER_BINDING, 1},
              {GL_RENDERBUFFER_BINDING, 1},
              {GL_ACTIVE_TEXTURE, 1},
              {GL_POLYGON_MODE, 1},
              {GL_FRONT_FACE, 1},
              {GL_CULL_FACE_MODE, 1},
              {GL_DEPTH_FUNC, 1},
              {GL_DEPTH_WRITEMASK, 1},
              {GL_PROVOKING_VERTEX, 1},
              {GL_LOGIC_OP_MODE, 1},
              {GL_PRIMITIVE_RESTART_INDEX, 1},
              {GL_PATCH_VERTICES, 1},
              {GL_LINE_SMOOTH_HINT, 1},
              {GL_STENCIL_FUNC, 1},
              {GL_STENCIL_REF, 1},
              {GL_STENCIL_VALUE_MASK, 1},
              {GL_STENCIL_WRITEMASK, 1},
              {GL_STENCIL_FAIL, 1},
              {GL_STENCIL_PASS_DEPTH_FAIL, 1},
              {GL_STENCIL_PASS_DEPTH_PASS, 1},
              {GL_STENCIL_BACK_FUNC, 1},
              {GL_STENCIL_BACK_REF, 1},
              {GL_STENCIL_BACK_VALUE_MASK, 1},
              {GL_STENCIL_BACK_WRITEMASK, 1},
              {GL_STENCIL_BACK_FAIL, 1},
              {GL_STENCIL_BACK_PASS_DEPTH_FAIL, 1},
              {GL_STENCIL_BACK_PASS_DEPTH_PASS, 1},
              {GL_STENCIL_CLEAR_VALUE, 1},
              {GL_READ_BUFFER, 1},
              {GL_ARRAY_BUFFER_BINDING, 1},
              {GL_ATOMIC_COUNTER_BUFFER_BINDING, 1},
              {GL_COPY_READ_BUFFER_BINDING, 1},
              {GL_COPY_WRITE_BUFFER_BINDING, 1},
              {GL_DISPATCH_INDIRECT_BUFFER_BINDING, 1},
              {GL_DRAW_INDIRECT_BUFFER_BINDING, 1},
              {GL_ELEMENT_ARRAY_BUFFER_BINDING, 1},
              {GL_PIXEL_PACK_BUFFER_BINDING, 1},
              {GL_PIXEL_UNPACK_BUFFER_BINDING, 1},
              {GL_SHADER_STORAGE_BUFFER_BINDING, 1},
              {GL_TEXTURE_BUFFER_BINDING, 1},
              {GL_TRANSFORM_FEEDBACK_BUFFER_BINDING, 1},
              {GL_UNIFORM_BUFFER_BINDING, 1},
              {GL_TRANSFORM_FEEDBACK_BINDING, 1},
              {GL_PACK_ALIGNMENT, 1},
              {GL_PACK_ROW_LENGTH, 1},
              {GL_PACK_SKIP_ROWS, 1},
              {GL_PACK_SKIP_PIXELS, 1},
              {GL_PACK_SWAP_BYTES, 1},
              {GL_PACK_LSB_FIRST, 1},
              {GL_PACK_IMAGE_HEIGHT, 1},
              {GL_PACK_SKIP_IMAGES, 1},
              {GL_UNPACK_ALIGNMENT, 1},
              {GL_UNPACK_ROW_LENGTH, 1},
              {GL_UNPACK_SKIP_ROWS, 1},
              {GL_UNPACK_SKIP_PIXELS, 1},
              {GL_UNPACK_SWAP_BYTES, 1},
              {GL_UNPACK_LSB_FIRST, 1},
              {GL_UNPACK_IMAGE_HEIGHT, 1},
              {GL_UNPACK_SKIP_IMAGES, 1},
              {GL_CLAMP_READ_COLOR, 1},
              {GL_TRANSFORM_FEEDBACK_ACTIVE, 1},
              {GL_TRANSFORM_FEEDBACK_PAUSED, 1}};

/* The same, as floating-point numbers: their bits are compared. */
static const struct {
    GLenum what;
    int count;
} reals[] = {{GL_COLOR_CLEAR_VALUE, 4},
             {GL_DEPTH_CLEAR_VALUE, 1},
             {GL_BLEND_COLOR, 4},
             {GL_POLYGON_OFFSET_FACTOR, 1},
             {GL_POLYGON_OFFSET_UNITS, 1},
             {GL_LINE_WIDTH, 1},
             {GL_POINT_SIZE, 1},
             {GL_SAMPLE_COVERAGE_VALUE, 1},
             {GL_SAMPLE_COVERAGE_INVERT, 1},
             {GL_MIN_SAMPLE_SHADING_VALUE, 1},
             {GL_POINT_FADE_THRESHOLD_SIZE, 1}};

static const GLenum texture_bindings[] = {
    GL_TEXTURE_BINDING_1D,       GL_TEXTURE_BINDING_2D,        GL_TEXTURE_BINDING_3D,
    GL_TEXTURE_BINDING_2D_ARRAY, GL_TEXTURE_BINDING_CUBE_MAP,  GL_TEXTURE_BINDING_2D_MULTISAMPLE,
    GL_TEXTURE_BINDING_BUFFER,   GL_TEXTURE_BINDING_RECTANGLE, GL_SAMPLER_BINDING};

static void ask_plain(const dp_gl_api *a, answers *n) {
    GLint v[4];
    GLfloat f[4];
    for (size_t i = 0; i < sizeof switches / sizeof *switches; i++)
        note(n, switches[i], 0, a->IsEnabled(switches[i]));
    for (int i = 0; i < 8; i++)
        note(n, GL_CLIP_DISTANCE0, i, a->IsEnabled(GL_CLIP_DISTANCE0 + (GLenum)i));
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        a->GetIntegerv(values[i].what, v);
        for (int k = 0; k < values[i].count; k++) note(n, values[i].what, k, v[k]);
    }
    for (size_t i = 0; i < sizeof reals / sizeof *reals; i++) {
        a->GetFloatv(reals[i].what, f);
        memcpy(v, f, sizeof v);
        for (int k = 0; k < reals[i].count; k++) note(n, reals[i].what, k, v[k]);
    }
    for (GLenum i = 0; i < DRAWN_BUFFERS; i++) {
        a->GetIntegerv(GL_DRAW_BUFFER0 + i, v);
        note(n, GL_DRAW_BUFFER0, (int)i, v[0]);
    }
}

static void ask_each_buffer(const dp_gl_api *a, answers *n) {
    static const GLenum what[] = {GL_BLEND_EQUATION_RGB, GL_BLEND_EQUATION_ALPHA,
                                  GL_BLEND_SRC_RGB,      GL_BLEND_SRC_ALPHA,
                                  GL_BLEND_DST_RGB,      GL_BLEND_DST_ALPHA};
    for (GLuint i = 0; i < DRAWN_BUFFERS; i++) {
        GLboolean mask[4];
        GLint v;
        a->GetBooleani_v(GL_COLOR_WRITEMASK, i, mask);
        for (int k = 0; k < 4; k++) note(n, GL_COLOR_WRITEMASK, (int)(4 * i) + k, mask[k]);
        note(n, GL_BLEND, (int)i, a->IsEnabledi(GL_BLEND, i));
        for (size_t k = 0; k < sizeof what / sizeof *what; k++) {
            a->GetIntegeri_v(what[k], i, &v);
            note(n, what[k], (int)i, v);
        }
    }
}

static void ask_viewports(const dp_gl_api *a, answers *n) {
    for (GLuint i = 0; i < VIEWPORTS; i++) {
        GLfloat f[4];
        GLint box[4];
        GLdouble range[2];
        a->GetFloati_v(GL_VIEWPORT, i, f);
        a->GetIntegeri_v(GL_SCISSOR_BOX, i, box);
        a->GetDoublei_v(GL_DEPTH_RANGE, i, range);
        for (int k = 0; k < 4; k++) note(n, GL_VIEWPORT, (int)(4 * i) + k, (GLint64)(f[k] * 1024));
        for (int k = 0; k < 4; k++) note(n, GL_SCISSOR_BOX, (int)(4 * i) + k, box[k]);
        for (int k = 0; k < 2; k++)
            note(n, GL_DEPTH_RANGE, (int)(2 * i) + k, (GLint64)(range[k] * 1048576));
        note(n, GL_SCISSOR_TEST, (int)i, a->IsEnabledi(GL_SCISSOR_TEST, i));
    }
}

static void ask_bindings(const dp_gl_api *a, answers *n) {
    static const GLenum images[] = {GL_IMAGE_BINDING_NAME,    GL_IMAGE_BINDING_LEVEL,
                                    GL_IMAGE_BINDING_LAYERED, GL_IMAGE_BINDING_LAYER,
                                    GL_IMAGE_BINDING_ACCESS,  GL_IMAGE_BINDING_FORMAT};
    static const GLenum blocks[2][3] = {
        {GL_SHADER_STORAGE_BUFFER_BINDING, GL_SHADER_STORAGE_BUFFER_START,
         GL_SHADER_STORAGE_BUFFER_SIZE},
        {GL_UNIFORM_BUFFER_BINDING, GL_UNIFORM_BUFFER_START, GL_UNIFORM_BUFFER_SIZE}};
    GLint unit, v;
    GLint64 wide;
    a->GetIntegerv(GL_ACTIVE_TEXTURE, &unit);
    for (GLuint i = 0; i < UNITS; i++) {
        a->ActiveTexture(GL_TEXTURE0 + i);
        for (size_t k = 0; k < sizeof texture_bindings / sizeof *texture_bindings; k++) {
            a->GetIntegerv(texture_bindings[k], &v);
            note(n, texture_bindings[k], (int)i, v);
        }
    }
    a->ActiveTexture((GLenum)unit);
    for (GLuint i = 0; i < BLOCKS; i++) {
        for (int b = 0; b < 2; b++)
            for (int k = 0; k < 3; k++) {
                a->GetInteger64i_v(blocks[b][k], i, &wide);
                note(n, blocks[b][k], (int)i, wide);
            }
        for (size_t k = 0; k < sizeof images / sizeof *images; k++) {
            a->GetIntegeri_v(images[k], i, &v);
            note(n, images[k], (int)i, v);
        }
    }
    a->GetIntegeri_v(GL_SAMPLE_MASK_VALUE, 0, &v);
    note(n, GL_SAMPLE_MASK_VALUE, 0, v);
}

static void ask(const dp_gl *gl, answers *n) {
    const dp_gl_api *const a = &gl->api;
    void *callback = NULL;
    GLint v;
    n->count = 0;
    ask_plain(a, n);
    ask_each_buffer(a, n);
    ask_viewports(a, n);
    ask_bindings(a, n);
    if (gl->has_clip_control) {
        a->GetIntegerv(GL_CLIP_ORIGIN, &v), note(n, GL_CLIP_ORIGIN, 0, v);
        a->GetIntegerv(GL_CLIP_DEPTH_MODE, &v), note(n, GL_CLIP_DEPTH_MODE, 0, v);
    }
    if (gl->version >= 440)
        a->GetIntegerv(GL_QUERY_BUFFER_BINDING, &v), note(n, GL_QUERY_BUFFER_BINDING, 0, v);
    a->GetPointerv(GL_DEBUG_CALLBACK_FUNCTION, &callback);
    note(n, GL_DEBUG_CALLBACK_FUNCTION, 0, (GLint64)(uintptr_t)callback);
    assert_int_equal(a->GetError(), GL_NO_ERROR);
}

static void compare(const answers *before, const answers *after, const char *call) {
    int wrong = 0;
    assert_int_equal(before->count, after->count);
    for (size_t i = 0; i < before->count; i++) {
        if (before->list[i].value == after->list[i].value) continue;
        print_message("%s: 0x%04x [%d] was %lld, is %lld\n", call, before->list[i].what,
                      before->list[i].index, (long long)before->list[i].value,
                      (long long)after->list[i].value);
        wrong++;
    }
    assert_int_equal(wrong, 0);
}

/* ------- odd values ------- */

/* Functions that the library has no use for. */
#define CALL(t, type, name) ((type)(uintptr_t)gl_context_proc((t)->context, name))

typedef struct objects {
    GLuint buffer, more, textures[6], sampler, framebuffers[2], targets[2], vertex_array, program,
        pipeline, renderbuffer, query;
} objects;

static GLuint any_program(gl_test *t) {
    static const char text[] = "#version 430 core\n"
                               "out gl_PerVertex { vec4 gl_Position; };\n"
                               "out vec4 fed;\n"
                               "void main() { gl_Position = fed = vec4(0.0); }\n";
    static const char *const fed[] = {"fed"};
    const dp_gl_api *const a = &t->gl->api;
    const char *const source = text;
    const GLuint program = a->CreateProgram(), shader = a->CreateShader(GL_VERTEX_SHADER);
    a->ShaderSource(shader, 1, &source, NULL);
    a->CompileShader(shader);
    a->AttachShader(program, shader);
    a->DeleteShader(shader);
    CALL(t, PFNGLPROGRAMPARAMETERIPROC, "glProgramParameteri")(program, GL_PROGRAM_SEPARABLE, 1);
    CALL(t, PFNGLTRANSFORMFEEDBACKVARYINGSPROC, "glTransformFeedbackVaryings")
    (program, 1, fed, GL_INTERLEAVED_ATTRIBS);
    a->LinkProgram(program);
    return program;
}

static void make_textures(gl_test *t, objects *o) {
    static const GLenum kinds[6] = {GL_TEXTURE_2D,       GL_TEXTURE_2D_MULTISAMPLE,
                                    GL_TEXTURE_2D_ARRAY, GL_TEXTURE_CUBE_MAP,
                                    GL_TEXTURE_3D,       GL_TEXTURE_RECTANGLE};
    const dp_gl_api *const a = &t->gl->api;
    a->GenTextures(6, o->textures);
    for (GLuint u = 0; u < UNITS; u++) {
        a->ActiveTexture(GL_TEXTURE0 + u);
        for (int i = 0; i < 6; i++) a->BindTexture(kinds[i], o->textures[i]);
        a->BindSampler(u, o->sampler);
    }
    a->TexStorage2D(GL_TEXTURE_2D, 2, GL_RGBA8, 8, 8);
    for (GLuint i = 0; i < BLOCKS; i++)
        a->BindImageTexture(i, o->textures[0], 1, GL_TRUE, 0, GL_WRITE_ONLY, GL_R32UI);
}

static void make_buffers(gl_test *t, objects *o) {
    static const GLenum targets[] = {
        GL_ARRAY_BUFFER,         GL_ATOMIC_COUNTER_BUFFER,    GL_COPY_READ_BUFFER,
        GL_COPY_WRITE_BUFFER,    GL_DISPATCH_INDIRECT_BUFFER, GL_DRAW_INDIRECT_BUFFER,
        GL_ELEMENT_ARRAY_BUFFER, GL_PIXEL_PACK_BUFFER,        GL_PIXEL_UNPACK_BUFFER,
        GL_TEXTURE_BUFFER,       GL_TRANSFORM_FEEDBACK_BUFFER};
    const dp_gl_api *const a = &t->gl->api;
    a->GenBuffers(2, &o->buffer);
    for (int i = 0; i < 2; i++) {
        a->BindBuffer(GL_ARRAY_BUFFER, i ? o->more : o->buffer);
        a->BufferData(GL_ARRAY_BUFFER, 65536, NULL, GL_DYNAMIC_DRAW);
    }
    for (size_t i = 0; i < sizeof targets / sizeof *targets; i++)
        a->BindBuffer(targets[i], o->buffer);
    for (GLuint i = 0; i < BLOCKS; i++) {
        a->BindBufferRange(GL_SHADER_STORAGE_BUFFER, i, o->more, 256, 512);
        a->BindBufferRange(GL_UNIFORM_BUFFER, i, o->buffer, 1024, 64);
    }
    a->BindBuffer(GL_SHADER_STORAGE_BUFFER, o->buffer);
    a->BindBuffer(GL_UNIFORM_BUFFER, o->more);
    if (t->gl->version >= 440) a->BindBuffer(GL_QUERY_BUFFER, o->more);
}

static void make_framebuffers(gl_test *t, objects *o) {
    const dp_gl_api *const a = &t->gl->api;
    a->GenFramebuffers(2, o->framebuffers);
    a->GenTextures(2, o->targets);
    for (int i = 0; i < 2; i++) {
        a->BindTexture(GL_TEXTURE_2D, o->targets[i]);
        a->TexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA8, WIDTH, HEIGHT);
        a->BindFramebuffer(GL_FRAMEBUFFER, o->framebuffers[i]);
        a->FramebufferTexture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, o->targets[i], 0);
        a->DrawBuffers(3, (GLenum[]){GL_COLOR_ATTACHMENT1, GL_NONE, GL_NONE});
        a->ReadBuffer(GL_NONE);
    }
    a->BindTexture(GL_TEXTURE_2D, o->textures[0]);
    a->BindFramebuffer(GL_FRAMEBUFFER, o->framebuffers[0]);
}

static objects make_objects(gl_test *t) {
    const dp_gl_api *const a = &t->gl->api;
    objects o = {0};
    a->GenVertexArrays(1, &o.vertex_array);
    a->BindVertexArray(o.vertex_array);
    a->GenSamplers(1, &o.sampler);
    make_textures(t, &o);
    make_buffers(t, &o);
    make_framebuffers(t, &o);
    o.program = any_program(t);
    CALL(t, PFNGLGENPROGRAMPIPELINESPROC, "glGenProgramPipelines")(1, &o.pipeline);
    CALL(t, PFNGLBINDPROGRAMPIPELINEPROC, "glBindProgramPipeline")(o.pipeline);
    a->UseProgram(o.program);
    CALL(t, PFNGLGENRENDERBUFFERSPROC, "glGenRenderbuffers")(1, &o.renderbuffer);
    CALL(t, PFNGLBINDRENDERBUFFERPROC, "glBindRenderbuffer")(GL_RENDERBUFFER, o.renderbuffer);
    return o;
}

static void free_objects(gl_test *t, objects *o) {
    const dp_gl_api *const a = &t->gl->api;
    a->UseProgram(0);
    a->DeleteProgram(o->program);
    CALL(t, PFNGLDELETEPROGRAMPIPELINESPROC, "glDeleteProgramPipelines")(1, &o->pipeline);
    CALL(t, PFNGLDELETERENDERBUFFERSPROC, "glDeleteRenderbuffers")(1, &o->renderbuffer);
    a->DeleteVertexArrays(1, &o->vertex_array);
    a->DeleteFramebuffers(2, o->framebuffers);
    a->DeleteTextures(6, o->textures);
    a->DeleteTextures(2, o->targets);
    a->DeleteSamplers(1, &o->sampler);
    a->DeleteBuffers(2, &o->buffer);
}

static void set_pixels(gl_test *t) {
    static const GLenum packs[2][8] = {
        {GL_PACK_ALIGNMENT, GL_PACK_ROW_LENGTH, GL_PACK_SKIP_ROWS, GL_PACK_SKIP_PIXELS,
         GL_PACK_SWAP_BYTES, GL_PACK_LSB_FIRST, GL_PACK_IMAGE_HEIGHT, GL_PACK_SKIP_IMAGES},
        {GL_UNPACK_ALIGNMENT, GL_UNPACK_ROW_LENGTH, GL_UNPACK_SKIP_ROWS, GL_UNPACK_SKIP_PIXELS,
         GL_UNPACK_SWAP_BYTES, GL_UNPACK_LSB_FIRST, GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_IMAGES}};
    static const GLint odd[8] = {8, 77, 3, 5, 1, 1, 9, 2};
    for (int i = 0; i < 16; i++) t->gl->api.PixelStorei(packs[i / 8][i % 8], odd[i % 8]);
}

static void set_each_buffer(gl_test *t) {
    const dp_gl_api *const a = &t->gl->api;
    for (GLuint i = 0; i < DRAWN_BUFFERS; i++) {
        a->ColorMaski(i, i & 1, i >> 1 & 1, i >> 2 & 1, i != 3);
        a->BlendEquationSeparatei(i, GL_FUNC_ADD + i % 2, i % 2 ? GL_MIN : GL_MAX);
        a->BlendFuncSeparatei(i, GL_SRC_COLOR + i % 4, GL_DST_COLOR, GL_CONSTANT_COLOR + i % 2,
                              GL_ZERO);
        if (i % 3 == 1) a->Disablei(GL_BLEND, i);
    }
    for (GLuint i = 0; i < VIEWPORTS; i++) {
        a->ViewportIndexedf(i, 1.5f * (GLfloat)i, 2, 10 + (GLfloat)i, 7.25f);
        CALL(t, PFNGLSCISSORINDEXEDPROC, "glScissorIndexed")
        (i, (GLint)i, 1, (GLsizei)i + 2, 5);
        a->DepthRangeIndexed(i, 0.25, 0.5 + 0.03125 * i);
        if (i % 2) a->Disablei(GL_SCISSOR_TEST, i);
    }
}

static void set_values(gl_test *t) {
    const dp_gl_api *const a = &t->gl->api;
    a->PolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    a->FrontFace(GL_CW), a->CullFace(GL_FRONT);
    a->DepthFunc(GL_NEVER), a->DepthMask(GL_FALSE);
    a->ProvokingVertex(GL_FIRST_VERTEX_CONVENTION);
    a->LogicOp(GL_XOR), a->PrimitiveRestartIndex(2);
    a->PatchParameteri(GL_PATCH_VERTICES, 5);
    a->PolygonOffset(3, 4), a->LineWidth(1);
    a->SampleCoverage(0.25f, GL_TRUE), a->SampleMaski(0, 2), a->MinSampleShading(0.5f);
    CALL(t, PFNGLCLEARCOLORPROC, "glClearColor")(0.1f, 0.2f, 0.3f, 0.4f);
    CALL(t, PFNGLCLEARDEPTHPROC, "glClearDepth")(0.75);
    CALL(t, PFNGLCLEARSTENCILPROC, "glClearStencil")(7);
    CALL(t, PFNGLBLENDCOLORPROC, "glBlendColor")(0.5f, 0.6f, 0.7f, 0.8f);
    CALL(t, PFNGLPOINTSIZEPROC, "glPointSize")(3);
    for (int i = 0; i < 2; i++) {
        const GLenum face = i ? GL_BACK : GL_FRONT;
        a->StencilFuncSeparate(face, GL_LESS + (GLenum)i, 3 + i, 0x55);
        a->StencilMaskSeparate(face, 0x33);
        a->StencilOpSeparate(face, GL_INCR, GL_INVERT, GL_DECR_WRAP);
    }
    if (t->gl->has_clip_control) a->ClipControl(GL_UPPER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    a->ActiveTexture(GL_TEXTURE0 + 5);
}

/* All switches to what they are not by default, but for the two of debugging. */
static void set_switches(gl_test *t, bool odd) {
    const dp_gl_api *const a = &t->gl->api;
    for (size_t i = 0; i + 2 < sizeof switches / sizeof *switches; i++) {
        const bool usual = switches[i] == GL_DITHER || switches[i] == GL_MULTISAMPLE;
        if (usual != odd)
            a->Enable(switches[i]);
        else
            a->Disable(switches[i]);
    }
    for (GLenum i = 0; i < 8; i++)
        if (odd)
            a->Enable(GL_CLIP_DISTANCE0 + i);
        else
            a->Disable(GL_CLIP_DISTANCE0 + i);
}

/* ------- tests ------- */

/* All calls that touch the device, the pictures of which are those of a context at rest. */
static void call_all(gl_test *t, const dp_gl_target *target, bool lines, answers *before,
                     uint8_t *rgba) {
    static answers after;
    dp_style style = {.surface = DP_RGB(10, 200, 30)};
    dp_gl_mesh *mesh;
    dp_gl_stats stats;
    dp_diag diag = {0};
    const dp_camera camera = figure_camera(false, 20);
    figure f;
    if (!lines) style.lines = DP_NO_LINES; /* those take many programs */
    figure_make(&f, 0);
    dp_source *const source = figure_source(&f);
    if (before) ask(t->gl, before);
#define AFTER(what, call)                                                                          \
    if (call) fail_msg("%s: %s", what, diag.message);                                              \
    if (before) ask(t->gl, &after), compare(before, &after, what)
    AFTER("dp_gl_mesh_from_source", dp_gl_mesh_from_source(t->gl, source, &mesh, &diag));
    dp_gl_time_stages(t->gl, true);
    dp_texture *texture = NULL;
    assert_int_equal(dp_texture_named("charcoal", 0, NULL, &texture, NULL), DP_OK);
    const dp_style fins = {.lines = DP_SILHOUETTE | DP_BORDER,
                           .edges = DP_EDGES_ADJACENCY,
                           .ink = DP_INK_QUADS,
                           .method = DP_METHOD_PAPER,
                           .shade.shading = DP_SHADING_PENCIL,
                           .stroke.texture = texture};
    AFTER("textured silhouettes", dp_gl_draw(t->gl, &mesh, 1, &camera, &fins, target, &diag));
    for (int i = 0; i < 2; i++) {
        AFTER("dp_gl_draw", dp_gl_draw(t->gl, &mesh, 1, &camera, &style, target, &diag));
    }
    dp_texture_destroy(texture);
    AFTER("dp_gl_stats_of", dp_gl_stats_of(t->gl, &stats, &diag));
    assert_true(stats.stage_ms[DP_GL_STAGE_FACES] > 0 && stats.stage_ms[DP_GL_STAGE_FACES] < 1e5);
    AFTER("dp_gl_mesh_update", dp_gl_mesh_update(mesh, source, &diag));
    AFTER("dp_gl_read", dp_gl_read(t->gl, target, rgba, 0, &diag));
    AFTER("dp_gl_mesh_destroy", (dp_gl_mesh_destroy(mesh), DP_OK));
#undef AFTER
    dp_source_destroy(source);
}

static void keeps_state(void **state) {
    static answers before;
    static uint8_t plain[4 * WIDTH * HEIGHT], odd[4 * WIDTH * HEIGHT];
    gl_test *const t = *state;
    if (!t->gl) skip();
    dp_gl_target target = gl_test_target(t, WIDTH, HEIGHT, 4);
    call_all(t, &target, true, NULL, plain);
    objects o = make_objects(t);
    target.framebuffer = o.framebuffers[1];
    set_pixels(t);
    set_switches(t, true);
    set_each_buffer(t);
    set_values(t);
    assert_int_equal(t->gl->api.GetError(), GL_NO_ERROR);
    call_all(t, &target, true, &before, odd);
    assert_memory_equal(odd, plain, sizeof odd);
    free_objects(t, &o);
}

/* While the application measures, listens, or feeds back. */
static void lives_beside_queries(void **state) {
    static uint8_t rgba[4 * WIDTH * HEIGHT];
    gl_test *const t = *state;
    if (!t->gl) skip();
    const dp_gl_api *const a = &t->gl->api;
    const dp_gl_target target = gl_test_target(t, WIDTH, HEIGHT, 1);
    GLuint queries[2];
    GLuint64 ns = 0;
    a->GenQueries(2, queries);
    a->BeginQuery(GL_TIME_ELAPSED, queries[0]);
    a->BeginQuery(GL_PRIMITIVES_GENERATED, queries[1]);
    call_all(t, &target, false, NULL, rgba);
    a->EndQuery(GL_TIME_ELAPSED), a->EndQuery(GL_PRIMITIVES_GENERATED);
    a->GetQueryObjectui64v(queries[0], GL_QUERY_RESULT, &ns);
    assert_true(ns > 0);
    assert_int_equal(a->GetError(), GL_NO_ERROR);
    a->DeleteQueries(2, queries);
}

static void refuses_transform_feedback(void **state) {
    gl_test *const t = *state;
    if (!t->gl) skip();
    const dp_gl_api *const a = &t->gl->api;
    const dp_gl_target target = gl_test_target(t, WIDTH, HEIGHT, 1);
    const dp_camera camera = figure_camera(false, 20);
    dp_diag diag = {0};
    GLuint vertices, buffer, program = any_program(t);
    a->GenVertexArrays(1, &vertices), a->BindVertexArray(vertices);
    a->GenBuffers(1, &buffer);
    a->BindBuffer(GL_ARRAY_BUFFER, buffer);
    a->BufferData(GL_ARRAY_BUFFER, 256, NULL, GL_DYNAMIC_DRAW);
    a->BindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer);
    a->UseProgram(program);
    CALL(t, PFNGLBEGINTRANSFORMFEEDBACKPROC, "glBeginTransformFeedback")(GL_POINTS);
    assert_int_equal(dp_gl_draw(t->gl, NULL, 0, &camera, NULL, &target, &diag), DP_ERR_ARGUMENT);
    assert_non_null(strstr(diag.message, "transform feedback"));
    CALL(t, PFNGLPAUSETRANSFORMFEEDBACKPROC, "glPauseTransformFeedback")();
    assert_int_equal(dp_gl_draw(t->gl, NULL, 0, &camera, NULL, &target, &diag), DP_OK);
    CALL(t, PFNGLRESUMETRANSFORMFEEDBACKPROC, "glResumeTransformFeedback")();
    CALL(t, PFNGLENDTRANSFORMFEEDBACKPROC, "glEndTransformFeedback")();
    assert_int_equal(a->GetError(), GL_NO_ERROR);
    a->UseProgram(0), a->BindVertexArray(0), a->BindBuffer(GL_ARRAY_BUFFER, 0);
    a->DeleteProgram(program), a->DeleteBuffers(1, &buffer), a->DeleteVertexArrays(1, &vertices);
}

/* An application that hears of errors itself goes on doing so. */
static void APIENTRY count_message(GLenum source, GLenum type, GLuint id, GLenum severity,
                                   GLsizei length, const GLchar *text, const void *user) {
    int count;
    (void)source, (void)type, (void)id, (void)severity, (void)length, (void)text;
    memcpy(&count, user, sizeof count);
    count++;
    memcpy((void *)(uintptr_t)user, &count, sizeof count);
}

static void ignore(void *user, const char *text) { (void)user, (void)text; }

static void leaves_callbacks(void **state) {
    gl_test *const t = *state;
    int heard = 0;
    dp_gl *second;
    void *before = NULL, *after = NULL;
    if (!t->gl) skip();
    const dp_gl_api *const a = &t->gl->api;
    const dp_gl_desc desc = {
        .get_proc_address = gl_context_proc, .user = t->context, .message = ignore};
    a->GetPointerv(GL_DEBUG_CALLBACK_FUNCTION, &before);
    a->DebugMessageCallback(count_message, &heard);
    assert_int_equal(dp_gl_create(&desc, &second, NULL), DP_OK);
    a->Enable(0xdead);
    dp_gl_destroy(second);
    a->Enable(0xdead);
    assert_int_equal(heard, 2);
    a->DebugMessageCallback(NULL, NULL);
    assert_int_equal(dp_gl_create(&desc, &second, NULL), DP_OK);
    a->GetPointerv(GL_DEBUG_CALLBACK_FUNCTION, &after);
    assert_ptr_equal(after, before);
    dp_gl_destroy(second);
    a->GetPointerv(GL_DEBUG_CALLBACK_FUNCTION, &after);
    assert_null(after);
    while (a->GetError() != GL_NO_ERROR) {
    }
}

/* Each has a context of its own. */
#define FRESH(f) cmocka_unit_test_setup_teardown(f, gl_test_setup, gl_test_teardown)

int main(void) {
    const struct CMUnitTest tests[] = {FRESH(keeps_state), FRESH(lives_beside_queries),
                                       FRESH(refuses_transform_feedback), FRESH(leaves_callbacks)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
