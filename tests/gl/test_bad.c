/* What can go wrong: broken and lost contexts, memory that is out on either side, and absurd input. Each fails with a
 * message, and what can be drawn again is. */
#include "gl/figure.h"
#include "gl/gl.h"

#include <EGL/egl.h>
#include <dlfcn.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 64, HEIGHT = 48, BYTES = 4 * WIDTH * HEIGHT };

static const dp_style look = {.surface = DP_RGB(200, 40, 40), .paper = DP_RGB(255, 255, 255)};

/* ------- a driver with faults ------- */

/* What is planted, counted down by calls; 0: nothing. A function of OpenGL has no argument for the test's own. */
static struct faults {
    gl_context *context;
    const char *missing; /* this function is NULL */
    GLenum error;        /* glGetError returns it … */
    int error_at;        /* … at this call, and */
    bool error_stays;    /* from then on */
    int refuse_at;       /* this shader or program is refused, with this log: */
    const char *log;
    int major, minor; /* the version that it says it has */
    const char *version, *renderer;
    int blocks; /* GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS */
    char heard[1024];
} faults;

#define REAL(type, name) ((type)(uintptr_t)gl_context_proc(faults.context, name))

static GLenum APIENTRY bad_get_error(void) {
    const GLenum real = REAL(PFNGLGETERRORPROC, "glGetError")();
    if (faults.error_at > 0 && --faults.error_at == 0) {
        if (faults.error_stays) faults.error_at = 1;
        return faults.error;
    }
    return real;
}

static bool is_refused(void) { return faults.refuse_at > 0 && --faults.refuse_at == 0; }

static void APIENTRY bad_get_shader(GLuint shader, GLenum what, GLint *out) {
    REAL(PFNGLGETSHADERIVPROC, "glGetShaderiv")(shader, what, out);
    if (what == GL_COMPILE_STATUS && is_refused()) *out = GL_FALSE;
}

static void APIENTRY bad_get_program(GLuint program, GLenum what, GLint *out) {
    REAL(PFNGLGETPROGRAMIVPROC, "glGetProgramiv")(program, what, out);
    if (what == GL_LINK_STATUS && is_refused()) *out = GL_FALSE;
}

static void APIENTRY bad_log(GLuint object, GLsizei size, GLsizei *length, GLchar *out) {
    (void)object;
    snprintf(out, (size_t)size, "%s", faults.log ? faults.log : "");
    if (length) *length = (GLsizei)strlen(out);
}

static void APIENTRY bad_get_integer(GLenum what, GLint *out) {
    REAL(PFNGLGETINTEGERVPROC, "glGetIntegerv")(what, out);
    if (what == GL_MAJOR_VERSION && faults.major) *out = faults.major;
    if (what == GL_MINOR_VERSION && faults.major) *out = faults.minor;
    if (what == GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS && faults.blocks) *out = faults.blocks;
}

static const GLubyte *APIENTRY bad_get_string(GLenum what) {
    if (what == GL_VERSION && faults.version) return (const GLubyte *)faults.version;
    if (what == GL_RENDERER && faults.renderer) return (const GLubyte *)faults.renderer;
    return REAL(PFNGLGETSTRINGPROC, "glGetString")(what);
}

static void *bad_proc(void *user, const char *name) {
    static const struct {
        const char *name;
        void (*function)(void);
    } planted[] = {{"glGetError", (void (*)(void))bad_get_error},
                   {"glGetShaderiv", (void (*)(void))bad_get_shader},
                   {"glGetProgramiv", (void (*)(void))bad_get_program},
                   {"glGetShaderInfoLog", (void (*)(void))bad_log},
                   {"glGetProgramInfoLog", (void (*)(void))bad_log},
                   {"glGetIntegerv", (void (*)(void))bad_get_integer},
                   {"glGetString", (void (*)(void))bad_get_string}};
    void *address;
    if (faults.missing && !strcmp(name, faults.missing)) return NULL;
    for (size_t i = 0; i < sizeof planted / sizeof *planted; i++)
        if (!strcmp(name, planted[i].name)) {
            memcpy(&address, &planted[i].function, sizeof address);
            return address;
        }
    return gl_context_proc(user, name);
}

static void hear(void *user, const char *text) {
    (void)user;
    snprintf(faults.heard, sizeof faults.heard, "%s", text);
}

static dp_gl_desc bad_desc(gl_test *t) {
    faults = (struct faults){.context = t->context};
    return (dp_gl_desc){.get_proc_address = bad_proc, .user = t->context, .message = hear};
}

/* ------- what is drawn ------- */

typedef struct scene {
    dp_gl *gl;
    dp_gl_mesh *mesh;
    dp_source *source;
    dp_gl_target target;
    bool flat; /* without lines, which take many programs */
} scene;

/* Programs pass from one dp_gl to the next: compiling them takes longer than all else. */
static dp_gl_programs kept;

static void create(scene *s, const dp_gl_desc *desc) {
    assert_int_equal(dp_gl_create(desc, &s->gl, NULL), DP_OK);
    if (s->flat) return;
    s->gl->programs = kept;
    kept = (dp_gl_programs){0};
}

static dp_result draw(scene *s, uint8_t *rgba, dp_diag *diag) {
    const dp_camera camera = figure_camera(false, 20);
    const dp_segment *segments;
    size_t count;
    dp_style style = look;
    dp_result result = DP_OK;
    if (s->flat) style.lines = DP_NO_LINES;
    if (!s->mesh) result = dp_gl_mesh_from_source(s->gl, s->source, &s->mesh, diag);
    if (!result) result = dp_gl_draw(s->gl, &s->mesh, 1, &camera, &style, &s->target, diag);
    if (!result) result = dp_gl_segments(s->gl, &segments, &count, diag);
    if (!result) result = dp_gl_read(s->gl, &s->target, rgba, 0, diag);
    return result;
}

static scene scene_of(gl_test *t, dp_gl *gl) {
    static figure f;
    figure_make(&f, 0);
    return (scene){gl, NULL, figure_source(&f), gl_test_target(t, WIDTH, HEIGHT, 1), false};
}

static void scene_free(scene *s) {
    dp_gl_mesh_destroy(s->mesh);
    if (!s->flat) kept = s->gl->programs, s->gl->programs = (dp_gl_programs){0};
    dp_gl_destroy(s->gl);
    dp_source_destroy(s->source);
}

/* ------- contexts ------- */

static void refuse(const dp_gl_desc *desc, dp_result result, const char *words) {
    dp_gl *gl = NULL;
    dp_diag diag = {0};
    assert_int_equal(dp_gl_create(desc, &gl, &diag), result);
    assert_null(gl);
    if (!strstr(diag.message, words)) fail_msg("\"%s\" says nothing of %s", diag.message, words);
}

static void refuses_contexts(void **state) {
    gl_test *const t = *state;
    dp_gl *gl;
    if (!t->gl) skip();
    dp_gl_desc desc = bad_desc(t);
    assert_int_equal(dp_gl_create(NULL, &gl, NULL), DP_ERR_ARGUMENT);
    assert_int_equal(dp_gl_create(&(dp_gl_desc){0}, &gl, NULL), DP_ERR_ARGUMENT);
    faults.missing = "glDispatchCompute";
    refuse(&desc, DP_ERR_UNSUPPORTED, "glDispatchCompute");
    faults.missing = "glClipControl"; /* one that need not be there */
    assert_int_equal(dp_gl_create(&desc, &gl, NULL), DP_OK);
    dp_gl_destroy(gl);
    faults.missing = NULL;
    faults.major = 3, faults.minor = 3, faults.version = "3.3 (Core Profile) Mesa";
    refuse(&desc, DP_ERR_UNSUPPORTED, "4.3");
    faults.major = 4, faults.minor = 2;
    refuse(&desc, DP_ERR_UNSUPPORTED, "4.3");
    faults.major = 0, faults.version = "OpenGL ES 3.2 Mesa 22.3.6";
    refuse(&desc, DP_ERR_UNSUPPORTED, "OpenGL ES 3.2");
    faults.version = NULL, faults.blocks = 2;
    refuse(&desc, DP_ERR_UNSUPPORTED, "buffers in vertex shaders");
    faults.blocks = 0, faults.error = GL_CONTEXT_LOST, faults.error_at = 1;
    refuse(&desc, DP_ERR_IO, "lost");
}

/* A context is made current in no thread for a while. */
static void refuses_no_context(void **state) {
    gl_test *const t = *state;
    void *const library = t->gl ? dlopen("libEGL.so.1", RTLD_NOW) : NULL;
    if (!library) skip();
    __typeof__(eglGetCurrentDisplay) *display;
    __typeof__(eglGetCurrentContext) *context;
    __typeof__(eglMakeCurrent) *make_current;
    void *const found[3] = {dlsym(library, "eglGetCurrentDisplay"),
                            dlsym(library, "eglGetCurrentContext"),
                            dlsym(library, "eglMakeCurrent")};
    memcpy(&display, &found[0], sizeof display), memcpy(&context, &found[1], sizeof context);
    memcpy(&make_current, &found[2], sizeof make_current);
    const dp_gl_desc desc = {.get_proc_address = gl_context_proc, .user = t->context};
    const EGLDisplay d = display();
    const EGLContext c = context();
    assert_true(make_current(d, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT));
    refuse(&desc, DP_ERR_UNSUPPORTED, "no OpenGL context is current");
    assert_true(make_current(d, EGL_NO_SURFACE, EGL_NO_SURFACE, c));
}

/* The context is lost at each moment at which it can be noticed: from then on all calls say so. */
static void loses_contexts(void **state) {
    static uint8_t rgba[BYTES];
    gl_test *const t = *state;
    if (!t->gl) skip();
    const dp_gl_desc desc = bad_desc(t);
    int at = 1;
    for (bool over = false; !over; at += 1 + at / 8) { /* each at first, then fewer */
        dp_diag diag = {0};
        scene s = scene_of(t, NULL);
        faults.error_at = 0;
        create(&s, &desc);
        faults.error = GL_CONTEXT_LOST, faults.error_at = at, faults.error_stays = true;
        const dp_result result = draw(&s, rgba, &diag);
        over = result == DP_OK;
        if (!over) {
            assert_int_equal(result, DP_ERR_IO);
            assert_non_null(strstr(diag.message, "lost"));
            assert_int_equal(draw(&s, rgba, &diag), DP_ERR_IO);
        }
        faults.error_at = 0, faults.error_stays = false;
        if (at % 2) { /* either will do */
            dp_gl_mesh_destroy(s.mesh);
            kept = s.gl->programs, s.gl->programs = (dp_gl_programs){0};
            dp_gl_abandon(s.gl);
            dp_source_destroy(s.source);
        } else {
            scene_free(&s);
        }
    }
    assert_in_range(at, 6, 200);
}

/* ------- memory ------- */

/* The device's memory is out at each moment at which that is asked; the next picture is as it should be. */
static void runs_out_of_device_memory(void **state) {
    static uint8_t rgba[BYTES], whole[BYTES];
    gl_test *const t = *state;
    int failures = 0, at = 1;
    if (!t->gl) skip();
    const dp_gl_desc desc = bad_desc(t);
    for (bool over = false; !over; at += 1 + at / 8) { /* each at first, then fewer */
        dp_diag diag = {0};
        scene s = scene_of(t, NULL);
        create(&s, &desc);
        faults.error = GL_OUT_OF_MEMORY, faults.error_at = at;
        const dp_result result = draw(&s, rgba, &diag);
        over = faults.error_at > 0;
        faults.error_at = 0;
        if (result) {
            assert_int_equal(result, DP_ERR_MEMORY);
            assert_non_null(strstr(diag.message, "memory"));
            failures++;
        }
        if (draw(&s, rgba, &diag)) fail_msg("again: %s", diag.message);
        if (at == 1) memcpy(whole, rgba, BYTES);
        assert_memory_equal(rgba, whole, BYTES);
        scene_free(&s);
    }
    assert_in_range(failures, 5, 200);
}

static void keeps_to_its_limit(void **state) {
    static uint8_t rgba[BYTES];
    gl_test *const t = *state;
    if (!t->gl) skip();
    dp_gl_desc desc = bad_desc(t);
    bool done = false;
    for (desc.memory = 1000; !done; desc.memory *= 4) {
        dp_diag diag = {0};
        scene s = scene_of(t, NULL);
        create(&s, &desc);
        const dp_result result = draw(&s, rgba, &diag);
        done = result == DP_OK;
        if (!done) assert_int_equal(result, DP_ERR_LIMIT);
        if (!done) assert_non_null(strstr(diag.message, "MB are allowed"));
        scene_free(&s);
    }
    assert_in_range(desc.memory, 1000 * 4 * 4, 100000000);
}

typedef struct counted {
    long left, blocks;
} counted;

static void *counted_realloc(void *block, size_t size, void *user) {
    counted *const c = user;
    if (c->left-- <= 0) return NULL;
    void *const out = realloc(block, size ? size : 1);
    if (!block && out) c->blocks++;
    return out;
}
static void *counted_alloc(size_t size, void *user) { return counted_realloc(NULL, size, user); }
static void counted_free(void *block, void *user) {
    counted *const c = user;
    if (block) c->blocks--;
    free(block);
}

/* Each allocation of the host's fails once; all are freed. Programs are kept from one failure to the next, or compiling
 * them again would take minutes. */
static void runs_out_of_memory(void **state) {
    static uint8_t rgba[BYTES], whole[BYTES];
    gl_test *const t = *state;
    if (!t->gl) skip();
    counted c = {1000000, 0};
    const dp_allocator memory = {counted_alloc, counted_realloc, counted_free, &c};
    dp_gl_desc desc = bad_desc(t);
    desc.allocator = &memory;
    dp_diag diag = {0};
    dp_gl *gl = NULL;
    long at = 0;
    dp_result result = DP_ERR_MEMORY;
    while ((c.left = at++, result = dp_gl_create(&desc, &gl, &diag)))
        assert_int_equal(result, DP_ERR_MEMORY);
    scene s = scene_of(t, gl);
    for (at = 0, result = DP_ERR_MEMORY; result; at++) {
        c.left = at;
        result = draw(&s, rgba, &diag);
        if (result && result != DP_ERR_MEMORY) fail_msg("%ld: %s", at, diag.message);
    }
    memcpy(whole, rgba, BYTES);
    for (at = 0, result = DP_ERR_MEMORY; result; at++) { /* and with all programs there */
        dp_gl_mesh_destroy(s.mesh);
        s.mesh = NULL;
        c.left = at;
        result = draw(&s, rgba, &diag);
        if (result && result != DP_ERR_MEMORY) fail_msg("%ld: %s", at, diag.message);
    }
    assert_memory_equal(rgba, whole, BYTES);
    assert_true(at > 8);
    dp_gl_mesh_destroy(s.mesh);
    dp_gl_destroy(s.gl);
    dp_source_destroy(s.source);
    assert_int_equal(c.blocks, 0);
}

/* ------- compilers ------- */

static void hears_compilers(void **state) {
    static uint8_t rgba[BYTES];
    gl_test *const t = *state;
    int at = 1;
    if (!t->gl) skip();
    const dp_gl_desc desc = bad_desc(t);
    for (bool over = false; !over; at++) {
        dp_diag diag = {0};
        scene s = scene_of(t, NULL);
        s.flat = true;
        create(&s, &desc);
        faults.log = at % 2 ? "0:7(2): error: nonsense\nERROR: 1:3: more\n99: none\n" : "";
        faults.refuse_at = at;
        const dp_result result = draw(&s, rgba, &diag);
        over = faults.refuse_at > 0;
        faults.refuse_at = 0;
        if (!over) {
            char named[80];
            assert_int_equal(result, DP_ERR_UNSUPPORTED);
            assert_non_null(strstr(diag.message, "does not compile on this device"));
            if (at % 2) {
                snprintf(named, sizeof named,
                         "%s:7(2): error: nonsense\nERROR: %s:3: more\n99: none\n",
                         dp_gl_shader_files[0].name, dp_gl_shader_files[1].name);
                assert_string_equal(faults.heard, named);
            }
            if (at < 3 && draw(&s, rgba, &diag)) fail_msg("again: %s", diag.message);
        }
        scene_free(&s);
    }
    assert_in_range(at, 8, 100);
}

/* What this compiler itself says is told by file and line. */
static void names_files_in_logs(void **state) {
    gl_test *const t = *state;
    uint32_t program;
    dp_diag diag = {0};
    dp_gl *gl;
    if (!t->gl) skip();
    const dp_gl_desc desc = bad_desc(t);
    faults.log = NULL;
    assert_int_equal(dp_gl_create(&desc, &gl, &diag), DP_OK);
    gl->api.GetShaderInfoLog = t->gl->api.GetShaderInfoLog;
    const dp_gl_program_desc broken = {.vertex = "whole.vert",
                                       .fragment = "flat.frag",
                                       .defines = "#define is_triangle(id) nonsense\n"};
    assert_int_equal(dp_gl_program(gl, &broken, &program, &diag), DP_ERR_UNSUPPORTED);
    assert_non_null(strstr(faults.heard, ".glsl:"));
    assert_non_null(strstr(diag.message, "flat.frag does not compile"));
    dp_gl_destroy(gl);
}

/* ------- arguments ------- */

static void refuses_targets(void **state) {
    gl_test *const t = *state;
    if (!t->gl) skip();
    const dp_camera camera = figure_camera(false, 20);
    const dp_gl_target good = gl_test_target(t, WIDTH, HEIGHT, 1);
    dp_gl_target bad[] = {good, good, good, good, good, good};
    bad[0].width = 0, bad[1].height = 0, bad[2].width = UINT32_MAX, bad[3].height = 1u << 20;
    bad[4].samples = 3, bad[5].samples = 32;
    uint8_t rgba[4];
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        dp_diag diag = {0};
        assert_int_equal(dp_gl_draw(t->gl, NULL, 0, &camera, &look, &bad[i], &diag),
                         DP_ERR_ARGUMENT);
        assert_true(strlen(diag.message) > 10);
        if (i < 4) assert_int_equal(dp_gl_read(t->gl, &bad[i], rgba, 0, NULL), DP_ERR_ARGUMENT);
    }
    dp_gl_target large = good;
    large.width = large.height = t->gl->texture_most, large.samples = 4;
    assert_int_equal(dp_gl_draw(t->gl, NULL, 0, &camera, &look, &large, NULL), DP_ERR_LIMIT);
    large = good, large.framebuffer = 4711;
    assert_int_equal(dp_gl_draw(t->gl, NULL, 0, &camera, &look, &large, NULL), DP_ERR_ARGUMENT);
    large = good, large.x = INT32_MIN, large.y = INT32_MAX;
    assert_int_equal(dp_gl_draw(t->gl, NULL, 0, &camera, &look, &large, NULL), DP_OK);
    assert_int_equal(dp_gl_read(t->gl, &good, rgba, 4, NULL), DP_ERR_ARGUMENT);
    assert_int_equal(dp_gl_draw(t->gl, NULL, 1, &camera, &look, &good, NULL), DP_ERR_ARGUMENT);
    assert_int_equal(dp_gl_draw(NULL, NULL, 0, &camera, &look, &good, NULL), DP_ERR_ARGUMENT);
    assert_int_equal(dp_gl_draw(t->gl, NULL, 0, NULL, &look, &good, NULL), DP_ERR_ARGUMENT);
    assert_int_equal(dp_gl_draw(t->gl, NULL, 0, &camera, &look, NULL, NULL), DP_ERR_ARGUMENT);
    dp_camera broken = camera;
    broken.projection[0] = NAN;
    assert_int_equal(dp_gl_draw(t->gl, NULL, 0, &broken, &look, &good, NULL), DP_ERR_ARGUMENT);
}

static void refuses_meshes(void **state) {
    gl_test *const t = *state;
    dp_gl *other;
    dp_gl_mesh *mesh = NULL;
    if (!t->gl) skip();
    const dp_gl_desc desc = bad_desc(t);
    const dp_camera camera = figure_camera(false, 20);
    scene s = scene_of(t, t->gl);
    assert_int_equal(dp_gl_create(&desc, &other, NULL), DP_OK);
    assert_int_equal(dp_gl_mesh_from_source(other, s.source, &mesh, NULL), DP_OK);
    dp_gl_mesh *const foreign = mesh;
    assert_int_equal(dp_gl_draw(t->gl, &mesh, 1, &camera, &look, &s.target, NULL), DP_ERR_ARGUMENT);
    mesh = NULL;
    assert_int_equal(dp_gl_draw(t->gl, &mesh, 1, &camera, &look, &s.target, NULL), DP_ERR_ARGUMENT);
    dp_gl_mesh_destroy(foreign), dp_gl_mesh_destroy(NULL);
    mesh = foreign; /* destroyed */
    assert_int_equal(dp_gl_draw(other, &mesh, 1, &camera, &look, &s.target, NULL), DP_ERR_ARGUMENT);
    dp_gl_destroy(other), dp_gl_destroy(NULL), dp_gl_abandon(NULL);
    double matrix[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    assert_int_equal(dp_gl_mesh_from_source(t->gl, s.source, &mesh, NULL), DP_OK);
    assert_int_equal(dp_gl_mesh_place(mesh, matrix, NULL), DP_OK);
    static const int at[5] = {0, 3, 5, 12, 15};
    static const double wrong[5] = {-1, 0.5, 0, (double)INFINITY, 2};
    for (int i = 0; i < 5; i++) {
        const double was = matrix[at[i]];
        matrix[at[i]] = wrong[i];
        assert_int_equal(dp_gl_mesh_place(mesh, matrix, NULL), DP_ERR_ARGUMENT);
        matrix[at[i]] = was;
    }
    assert_int_equal(dp_gl_mesh_from_source(t->gl, NULL, &mesh, NULL), DP_ERR_ARGUMENT);
    assert_int_equal(dp_gl_mesh_update(mesh, NULL, NULL), DP_ERR_ARGUMENT);
    dp_gl_mesh_destroy(mesh);
    dp_source_destroy(s.source);
}

static void refuses_buffers(void **state) {
    gl_test *const t = *state;
    dp_gl_mesh *mesh;
    GLuint buffer;
    if (!t->gl) skip();
    const dp_gl_api *const a = &t->gl->api;
    const dp_camera camera = figure_camera(false, 20);
    const dp_gl_target target = gl_test_target(t, WIDTH, HEIGHT, 1);
    a->GenBuffers(1, &buffer);
    a->BindBuffer(GL_ARRAY_BUFFER, buffer);
    a->BufferData(GL_ARRAY_BUFFER, 360, NULL, GL_STATIC_DRAW);
    const dp_gl_buffers good = {.positions = buffer, .vertex_count = 30, .triangle_count = 10};
    dp_gl_buffers bad[] = {good, good, good, good, good, good, good, good, good};
    bad[0].positions = 0, bad[1].vertex_count = 31, bad[2].triangle_count = 11;
    bad[3].positions_stride = 8, bad[4].positions_offset = 2, bad[5].positions_stride = 13;
    bad[6].indices = buffer, bad[6].triangle_count = 31, bad[7].indices = 4711;
    bad[8].normals = buffer, bad[8].normals_offset = 4;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        dp_diag diag = {0};
        assert_int_equal(dp_gl_mesh_from_buffers(t->gl, &bad[i], &mesh, &diag), DP_ERR_ARGUMENT);
        assert_true(strlen(diag.message) > 10);
    }
    assert_int_equal(dp_gl_mesh_from_buffers(t->gl, &good, &mesh, NULL), DP_OK);
    a->BufferData(GL_ARRAY_BUFFER, 100, NULL, GL_STATIC_DRAW); /* too small now */
    assert_int_equal(dp_gl_draw(t->gl, &mesh, 1, &camera, &look, &target, NULL), DP_ERR_ARGUMENT);
    a->DeleteBuffers(1, &buffer);
    assert_int_equal(dp_gl_draw(t->gl, &mesh, 1, &camera, &look, &target, NULL), DP_ERR_ARGUMENT);
    assert_int_equal(dp_gl_mesh_update(mesh, (dp_source *)(void *)mesh, NULL), DP_ERR_ARGUMENT);
    dp_gl_mesh_destroy(mesh);
}

/* Vertices that are not finite are left out, and those far away are drawn, as the CPU does; what is farther than it draws
 * does no harm. Nothing at all is paper. */
static void draws_absurd_meshes(void **state) {
    static uint8_t gpu[BYTES];
    gl_test *const t = *state;
    dp_gl_mesh *mesh;
    figure f;
    if (!t->gl) skip();
    const dp_camera camera = figure_camera(false, 20);
    const dp_gl_target target = gl_test_target(t, WIDTH, HEIGHT, 1);
    dp_style style = look;
    style.lines = DP_NO_LINES;
    figure_make(&f, 0);
    for (int i = 0; i < FIGURE_VERTICES; i += 40) {
        static const float odd[4] = {NAN, INFINITY, -INFINITY, 1e12f};
        f.positions[i][i / 40 % 3] = odd[i / 40 % 4];
    }
    dp_source *const source = figure_source(&f);
    uint8_t *const cpu = gl_test_draw_cpu(source, &camera, &style, WIDTH, HEIGHT, 1);
    uint8_t *const drawn = gl_test_draw(t, source, &camera, &style, WIDTH, HEIGHT, 1);
    gl_test_keep("bad-absurd-gpu", drawn, WIDTH, HEIGHT),
        gl_test_keep("bad-absurd-cpu", cpu, WIDTH, HEIGHT);
    assert_true(gl_test_alike(drawn, cpu, WIDTH, HEIGHT, 2) > 0.99);
    free(cpu), free(drawn);
    for (int i = 0; i < FIGURE_VERTICES; i += 40)
        f.positions[i][i / 40 % 3] = i % 80 ? 3e38f : -3e38f;
    free(gl_test_draw(t, source, &camera, NULL, WIDTH, HEIGHT, 4)); /* with lines */
    dp_source_destroy(source);
    GLuint buffer;
    t->gl->api.GenBuffers(1, &buffer);
    t->gl->api.BindBuffer(GL_ARRAY_BUFFER, buffer);
    const dp_gl_buffers none = {.positions = buffer};
    assert_int_equal(dp_gl_mesh_from_buffers(t->gl, &none, &mesh, NULL), DP_OK);
    for (size_t count = 0; count < 2; count++) {
        assert_int_equal(dp_gl_draw(t->gl, &mesh, count, &camera, NULL, &target, NULL), DP_OK);
        assert_int_equal(dp_gl_read(t->gl, &target, gpu, 0, NULL), DP_OK);
        for (int i = 0; i < BYTES; i++) assert_int_equal(gpu[i], 255);
    }
    dp_gl_mesh_destroy(mesh);
    t->gl->api.DeleteBuffers(1, &buffer);
}

static int teardown(void **state) {
    gl_test *const t = *state;
    for (size_t i = 0; i < kept.count; i++) t->gl->api.DeleteProgram(kept.entries[i].name);
    free(kept.entries);
    return gl_test_teardown(state);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(refuses_contexts),   cmocka_unit_test(refuses_no_context),
        cmocka_unit_test(loses_contexts),     cmocka_unit_test(runs_out_of_device_memory),
        cmocka_unit_test(keeps_to_its_limit), cmocka_unit_test(runs_out_of_memory),
        cmocka_unit_test(hears_compilers),    cmocka_unit_test(names_files_in_logs),
        cmocka_unit_test(refuses_targets),    cmocka_unit_test(refuses_meshes),
        cmocka_unit_test(refuses_buffers),    cmocka_unit_test(draws_absurd_meshes)};
    return cmocka_run_group_tests(tests, gl_test_setup, teardown);
}
