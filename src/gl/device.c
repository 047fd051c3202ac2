/* A dp_gl: what the context can do, and what all stages share. */
#include "gl/ink.h"
#include "gl/lines.h"
#include "gl/mirror.h"
#include "gl/scene.h"
#include "gl/surface.h"

#include <stdio.h>
#include <string.h>

static void forward_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                            const GLchar *text, const void *user) {
    const dp_gl *const gl = user;
    (void)type, (void)id, (void)length;
    if (source == GL_DEBUG_SOURCE_SHADER_COMPILER) return; /* program.c tells it, with names */
    if (severity != GL_DEBUG_SEVERITY_NOTIFICATION && gl->desc.message)
        gl->desc.message(gl->desc.user, text);
}

static bool has_extension(const dp_gl *gl, const char *name) {
    GLint count = 0;
    gl->api.GetIntegerv(GL_NUM_EXTENSIONS, &count);
    for (GLint i = 0; i < count; i++) {
        const GLubyte *const at = gl->api.GetStringi(GL_EXTENSIONS, (GLuint)i);
        if (at && !strcmp((const char *)at, name)) return true;
    }
    return false;
}

static uint32_t ask(const dp_gl *gl, GLenum what) {
    GLint value = 0;
    gl->api.GetIntegerv(what, &value);
    return value > 0 ? (uint32_t)value : 0;
}

static uint32_t least(uint32_t a, uint32_t b) { return a < b ? a : b; }

/* Limits that OpenGL 4.3 leaves open and that the shaders need. */
static dp_result check_limits(dp_gl *gl, dp_diag *diag) {
    const struct {
        GLenum name;
        uint32_t needed;
        const char *what;
    } limits[] = {
        {GL_MAX_COMPUTE_SHADER_STORAGE_BLOCKS, DP_GL_BINDINGS, "buffers in compute shaders"},
        {GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, DP_GL_BINDINGS, "buffers in vertex shaders"},
        {GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS, DP_GL_BINDINGS, "buffers in fragment shaders"},
        {GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS, DP_GL_BINDINGS, "bindings of storage buffers"},
        {GL_MAX_TEXTURE_IMAGE_UNITS, DP_GL_UNITS, "textures in fragment shaders"}};
    for (size_t i = 0; i < sizeof limits / sizeof *limits; i++) {
        const uint32_t has = ask(gl, limits[i].name);
        if (has < limits[i].needed)
            return dp_fail(diag, DP_ERR_UNSUPPORTED, "%s allows %u %s; %u are needed", gl->device,
                           has, limits[i].what, limits[i].needed);
    }
    return DP_OK;
}

static dp_result ask_device(dp_gl *gl, dp_diag *diag) {
    const dp_gl_api *const a = &gl->api;
    GLint64 storage = 0;
    const char *const renderer = (const char *)a->GetString(GL_RENDERER),
                      *const version = (const char *)a->GetString(GL_VERSION);
    if (!version)
        return dp_fail(diag, DP_ERR_UNSUPPORTED, "no OpenGL context is current in this thread");
    snprintf(gl->device, sizeof gl->device, "%.80s, OpenGL %.60s",
             renderer ? renderer : "unknown device", version);
    gl->version = (int)(100 * ask(gl, GL_MAJOR_VERSION) + 10 * ask(gl, GL_MINOR_VERSION));
    if (gl->version < 430 || strstr(version, "OpenGL ES"))
        return dp_fail(diag, DP_ERR_UNSUPPORTED, "OpenGL 4.3 or later is needed; this is %s",
                       gl->device);
    gl->has_clip_control =
        a->ClipControl && (gl->version >= 450 || has_extension(gl, "GL_ARB_clip_control"));
    gl->has_reset_status =
        a->GetGraphicsResetStatus && (gl->version >= 450 || has_extension(gl, "GL_KHR_robustness"));
    gl->samples_most =
        least(least(ask(gl, GL_MAX_COLOR_TEXTURE_SAMPLES), ask(gl, GL_MAX_INTEGER_SAMPLES)),
              ask(gl, GL_MAX_DEPTH_TEXTURE_SAMPLES));
    gl->samples_most = least(gl->samples_most, DP_GL_SAMPLES_MOST);
    gl->texture_most = ask(gl, GL_MAX_TEXTURE_SIZE);
    a->GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &storage);
    gl->storage_most = storage > UINT32_MAX ? UINT32_MAX : (uint32_t)storage;
    return check_limits(gl, diag);
}

/* Debug contexts tell what is wrong as it happens, and nothing is asked after each call. An application that listens
 * itself goes on doing so. */
static void listen(dp_gl *gl) {
    GLint flags = 0;
    void *other = NULL;
    gl->api.GetIntegerv(GL_CONTEXT_FLAGS, &flags);
    gl->api.GetPointerv(GL_DEBUG_CALLBACK_FUNCTION, &other);
    gl->has_debug = (flags & GL_CONTEXT_FLAG_DEBUG_BIT) && gl->desc.message && !other;
    if (!gl->has_debug) return;
    gl->api.Enable(GL_DEBUG_OUTPUT);
    gl->api.DebugMessageCallback(forward_message, gl);
}

dp_result dp_gl_create(const dp_gl_desc *desc, dp_gl **out, dp_diag *diag) {
    if (!desc || !desc->get_proc_address || !out)
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "dp_gl_create: desc, desc->get_proc_address or out is NULL");
    *out = NULL;
    const dp_allocator memory = dp_allocator_resolve(desc->allocator);
    dp_gl *const gl = dp_alloc_zeroed(&memory, sizeof *gl);
    if (!gl) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a dp_gl");
    gl->memory = memory, gl->desc = *desc;
    gl->lines.topology = UINT64_MAX;
    dp_result result = dp_gl_api_load(&gl->api, desc, diag);
    if (!result) result = ask_device(gl, diag);
    if (!result) dp_gl_forget_errors(gl); /* the application's own */
    if (!result && gl->is_lost) result = dp_gl_check(gl, "creating a dp_gl", diag);
    if (result) {
        dp_free(&memory, gl);
        return result;
    }
    listen(gl);
    gl->api.GenVertexArrays(1, &gl->vertex_array);
    *out = gl;
    return DP_OK;
}

static void free_host(dp_gl *gl) {
    const dp_allocator memory = gl->memory;
    dp_gl_mirror_free(gl);
    dp_gl_scene_free_host(gl);
    dp_gl_read_free(gl);
    dp_free(&memory, gl->programs.entries);
    dp_gl_quads_free(gl), dp_gl_shading_free(gl), dp_gl_fins_free(gl);
    dp_free(&memory, gl);
}

void dp_gl_destroy(dp_gl *gl) {
    if (!gl) return;
    if (gl->is_lost) {
        dp_gl_abandon(gl);
        return;
    }
    dp_gl_programs_free(gl);
    dp_gl_mirror_free(gl);
    dp_gl_scene_free(gl);
    dp_gl_faces_free(gl);
    dp_gl_lines_free(gl);
    dp_gl_surface_free(gl);
    dp_gl_ink_free(gl);
    dp_gl_buffer_free(gl, &gl->block_buffer);
    gl->api.DeleteVertexArrays(1, &gl->vertex_array);
    if (gl->queries[0][0]) gl->api.DeleteQueries(2 * DP_GL_STAGE_COUNT, gl->queries[0]);
    if (gl->has_debug) gl->api.DebugMessageCallback(NULL, NULL);
    free_host(gl);
}

void dp_gl_abandon(dp_gl *gl) {
    if (!gl) return;
    gl->is_lost = true;
    free_host(gl);
}

/* The first error that the context remembers; it may hold several, and a broken one no end of them. */
static GLenum take_errors(dp_gl *gl) {
    enum { MOST = 32 };
    GLenum first = GL_NO_ERROR;
    if (gl->has_reset_status && gl->api.GetGraphicsResetStatus() != GL_NO_ERROR)
        first = GL_CONTEXT_LOST;
    for (int i = 0; i < MOST && first != GL_CONTEXT_LOST; i++) {
        const GLenum error = gl->api.GetError();
        if (error == GL_NO_ERROR) break;
        if (first == GL_NO_ERROR || error == GL_CONTEXT_LOST) first = error;
    }
    gl->is_lost |= first == GL_CONTEXT_LOST;
    return first;
}

void dp_gl_forget_errors(dp_gl *gl) {
    if (!gl->is_lost) (void)take_errors(gl);
}

dp_result dp_gl_check(dp_gl *gl, const char *what, dp_diag *diag) {
    const GLenum error = gl->is_lost ? GL_CONTEXT_LOST : take_errors(gl);
    switch (error) {
    case GL_NO_ERROR:
        return DP_OK;
    case GL_OUT_OF_MEMORY:
        return dp_fail(diag, DP_ERR_MEMORY, "the device's memory is out: %s", what);
    case GL_CONTEXT_LOST:
        return dp_fail(diag, DP_ERR_IO, "the OpenGL context was lost: %s", what);
    default:
        return dp_fail(diag, DP_ERR_UNSUPPORTED, "%s reports error 0x%04x: %s", gl->device,
                       (unsigned)error, what);
    }
}

const char *dp_gl_device(const dp_gl *gl) { return gl ? gl->device : ""; }

void dp_gl_use(dp_gl *gl, uint32_t program) {
    gl->api.UseProgram(program);
    gl->api.BindBufferBase(GL_UNIFORM_BUFFER, 0, gl->block_buffer.name);
}

void dp_gl_dispatch(dp_gl *gl, uint32_t count) {
    enum { ROW = 32768 };
    const uint32_t groups = (count + DP_GL_GROUP_SIZE - 1) / DP_GL_GROUP_SIZE,
                   rows = (groups + ROW - 1) / ROW;
    if (groups) gl->api.DispatchCompute(rows > 1 ? ROW : groups, rows, 1);
    gl->api.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void dp_gl_dispatch_pixels(dp_gl *gl) {
    gl->api.DispatchCompute((gl->target.width + 7) / 8, (gl->target.height + 7) / 8, 1);
    gl->api.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                          GL_TEXTURE_FETCH_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

void dp_gl_draw_whole(dp_gl *gl) { gl->api.DrawArrays(GL_TRIANGLES, 0, 3); }
