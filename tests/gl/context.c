/* Contexts for tests, and pictures drawn both ways. */
#include "gl/context.h"

#include <drypoint/io.h>

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <GL/glcorearb.h>

struct gl_context {
    void *library;
    EGLDisplay display;
    EGLContext context;
    __typeof__(eglGetProcAddress) *proc;
    __typeof__(eglMakeCurrent) *make_current;
    __typeof__(eglDestroyContext) *destroy;
};

/* What drivers leak is not ours. A sanitizer asks for it. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void) {
    return "leak:_dri.so\nleak:libEGL\nleak:libgallium\nleak:libLLVM\n";
}

static void load(gl_context *c, void *function, const char *name) {
    void *const address = dlsym(c->library, name);
    memcpy(function, &address, sizeof address);
}

void *gl_context_proc(void *user, const char *name) {
    const gl_context *const c = user;
    __eglMustCastToProperFunctionPointerType f = c->proc(name);
    void *address;
    memcpy(&address, &f, sizeof address);
    return address;
}

/* Mesa's display without a window; or, where DP_TEST_EGL_DEVICE is a number, that device's of the system, which is how drivers of
 * graphics cards are reached. */
static EGLDisplay open_display(gl_context *c) {
    PFNEGLGETPLATFORMDISPLAYEXTPROC get_display;
    PFNEGLQUERYDEVICESEXTPROC query;
    EGLDeviceEXT devices[16];
    EGLint count = 0;
    const char *const asked = getenv("DP_TEST_EGL_DEVICE");
    const __eglMustCastToProperFunctionPointerType f = c->proc("eglGetPlatformDisplayEXT"),
                                                   g = c->proc("eglQueryDevicesEXT");
    memcpy(&get_display, &f, sizeof get_display), memcpy(&query, &g, sizeof query);
    if (!get_display) return EGL_NO_DISPLAY;
    if (!asked) return get_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL);
    const int device = atoi(asked);
    if (!query || !query(16, devices, &count) || device < 0 || device >= count)
        return EGL_NO_DISPLAY;
    return get_display(EGL_PLATFORM_DEVICE_EXT, devices[device], NULL);
}

gl_context *gl_context_create(int version, const char **why) {
    gl_context *const c = calloc(1, sizeof *c);
    __typeof__(eglInitialize) *initialize;
    __typeof__(eglBindAPI) *bind_api;
    __typeof__(eglCreateContext) *create;
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 version / 100,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 version / 10 % 10,
                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_CONTEXT_OPENGL_DEBUG,
                                 EGL_TRUE,
                                 EGL_NONE};
    *why = "there is no libEGL.so.1";
    if (!(c->library = dlopen("libEGL.so.1", RTLD_NOW))) goto fail;
    load(c, &c->proc, "eglGetProcAddress");
    load(c, &c->make_current, "eglMakeCurrent");
    load(c, &c->destroy, "eglDestroyContext");
    load(c, &initialize, "eglInitialize");
    load(c, &bind_api, "eglBindAPI");
    load(c, &create, "eglCreateContext");
    *why = "EGL has no display without a window";
    c->display = open_display(c);
    if (!c->display || !initialize(c->display, NULL, NULL)) goto fail;
    *why = "EGL has no OpenGL of that version";
    if (!bind_api(EGL_OPENGL_API)) goto fail;
    c->context = create(c->display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
    if (!c->context || !c->make_current(c->display, EGL_NO_SURFACE, EGL_NO_SURFACE, c->context))
        goto fail;
    return c;
fail:
    gl_context_destroy(c);
    return NULL;
}

void gl_context_use(gl_context *c) {
    assert_true(c->make_current(c->display, EGL_NO_SURFACE, EGL_NO_SURFACE, c->context));
}

void gl_context_destroy(gl_context *c) {
    if (!c) return;
    if (c->context) {
        c->make_current(c->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        c->destroy(c->display, c->context);
    }
    free(
        c); /* libEGL stays loaded, and the driver, as the display is not terminated: what they leak is named */
}

static void hear(void *user, const char *text) {
    (void)user;
    fprintf(stderr, "OpenGL: %s\n", text);
}

int gl_test_setup(void **state) {
    const char *why;
    gl_test *const t = calloc(1, sizeof *t);
    dp_diag diag;
    *state = t;
    if (!(t->context = gl_context_create(430, &why))) {
        fprintf(stderr, "skipped: %s\n", why);
        return 0;
    }
    const dp_gl_desc desc = {
        .get_proc_address = gl_context_proc, .user = t->context, .message = hear};
    if (dp_gl_create(&desc, &t->gl, &diag)) {
        fprintf(stderr, "%s\n", diag.message);
        return -1;
    }
    return 0;
}

#define CALL(t, type, name) ((type)(uintptr_t)gl_context_proc((t)->context, name))

int gl_test_teardown(void **state) {
    gl_test *const t = *state;
    if (t->framebuffer) {
        CALL(t, PFNGLDELETEFRAMEBUFFERSPROC, "glDeleteFramebuffers")(1, &t->framebuffer);
        CALL(t, PFNGLDELETETEXTURESPROC, "glDeleteTextures")(1, &t->texture);
    }
    dp_gl_destroy(t->gl);
    gl_context_destroy(t->context);
    free(t);
    return 0;
}

dp_gl_target gl_test_target(gl_test *t, uint32_t width, uint32_t height, uint32_t samples) {
    if (!t->gl) skip();
    if (t->width != width || t->height != height) {
        if (t->framebuffer) {
            CALL(t, PFNGLDELETEFRAMEBUFFERSPROC, "glDeleteFramebuffers")(1, &t->framebuffer);
            CALL(t, PFNGLDELETETEXTURESPROC, "glDeleteTextures")(1, &t->texture);
        }
        CALL(t, PFNGLGENTEXTURESPROC, "glGenTextures")(1, &t->texture);
        CALL(t, PFNGLBINDTEXTUREPROC, "glBindTexture")(GL_TEXTURE_2D, t->texture);
        CALL(t, PFNGLTEXSTORAGE2DPROC, "glTexStorage2D")
        (GL_TEXTURE_2D, 1, GL_RGBA8, (GLsizei)width, (GLsizei)height);
        CALL(t, PFNGLGENFRAMEBUFFERSPROC, "glGenFramebuffers")(1, &t->framebuffer);
        CALL(t, PFNGLBINDFRAMEBUFFERPROC, "glBindFramebuffer")(GL_FRAMEBUFFER, t->framebuffer);
        CALL(t, PFNGLFRAMEBUFFERTEXTUREPROC, "glFramebufferTexture")
        (GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, t->texture, 0);
        CALL(t, PFNGLBINDFRAMEBUFFERPROC, "glBindFramebuffer")(GL_FRAMEBUFFER, 0);
        t->width = width, t->height = height;
    }
    return (dp_gl_target){
        .framebuffer = t->framebuffer, .width = width, .height = height, .samples = samples};
}

uint8_t *gl_test_draw(gl_test *t, dp_source *source, const dp_camera *camera, const dp_style *style,
                      uint32_t width, uint32_t height, uint32_t samples) {
    const dp_gl_target target = gl_test_target(t, width, height, samples);
    uint8_t *const rgba = malloc((size_t)4 * width * height);
    dp_gl_mesh *mesh = NULL;
    dp_diag diag = {0};
    dp_result result = dp_gl_mesh_from_source(t->gl, source, &mesh, &diag);
    if (!result) result = dp_gl_draw(t->gl, &mesh, 1, camera, style, &target, &diag);
    if (!result) result = dp_gl_read(t->gl, &target, rgba, 0, &diag);
    if (result) fprintf(stderr, "%s\n", diag.message);
    assert_int_equal(result, DP_OK);
    dp_gl_mesh_destroy(mesh);
    return rgba;
}

uint8_t *gl_test_draw_cpu(dp_source *source, const dp_camera *camera, const dp_style *style,
                          uint32_t width, uint32_t height, uint32_t samples) {
    uint8_t *const rgba = malloc((size_t)4 * width * height);
    const dp_target target = {.width = width, .height = height, .samples = samples, .rgba = rgba};
    dp_context *context;
    dp_diag diag = {0};
    assert_int_equal(dp_context_create(NULL, &context, &diag), DP_OK);
    const dp_result result = dp_draw(context, source, camera, style, &target, &diag);
    if (result) fprintf(stderr, "%s\n", diag.message);
    assert_int_equal(result, DP_OK);
    dp_context_destroy(context);
    return rgba;
}

double gl_test_alike(const uint8_t *a, const uint8_t *b, uint32_t width, uint32_t height,
                     int levels) {
    size_t alike = 0;
    for (size_t i = 0; i < (size_t)width * height; i++) {
        bool same = true;
        for (int k = 0; k < 4; k++) same &= abs(a[4 * i + k] - b[4 * i + k]) <= levels;
        alike += same;
    }
    return (double)alike / ((double)width * height);
}

void gl_test_keep(const char *name, const uint8_t *rgba, uint32_t width, uint32_t height) {
    const char *const folder = getenv("DP_TEST_PICTURES");
    char path[512];
    if (!folder) return;
    snprintf(path, sizeof path, "%s/%s.png", folder, name);
    dp_io_write_png(path, rgba, width, height, 0, NULL);
}
