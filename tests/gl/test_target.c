/* Where pictures go, and what stands there already: framebuffers of all kinds, and the application's own depth. */
#include "gl/figure.h"
#include "gl/gl.h"
#include "gl/strokes.h"

#include <EGL/egl.h>
#include <dlfcn.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 160, HEIGHT = 120, BYTES = 4 * WIDTH * HEIGHT };

static const dp_style flat = {
    .lines = DP_NO_LINES, .surface = DP_RGB(200, 40, 40), .paper = DP_RGB(255, 255, 255)};

/* A framebuffer of the application's, with two colour buffers. */
typedef struct own {
    GLuint framebuffer, colors[2], depth;
    GLenum kind;
} own;

static GLuint own_texture(const dp_gl_api *a, GLenum kind, GLenum format, GLsizei w, GLsizei h) {
    GLuint name;
    a->GenTextures(1, &name);
    a->BindTexture(kind, name);
    if (kind == GL_TEXTURE_2D)
        a->TexStorage2D(kind, 1, format, w, h);
    else
        a->TexStorage2DMultisample(kind, 4, format, w, h, GL_TRUE);
    a->BindTexture(kind, 0);
    return name;
}

static own own_make(const dp_gl_api *a, bool several, GLenum depth_format, GLsizei w, GLsizei h) {
    own o = {.kind = several ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D};
    for (int i = 0; i < 2; i++) o.colors[i] = own_texture(a, o.kind, GL_RGBA8, w, h);
    o.depth = own_texture(a, o.kind, depth_format, w, h);
    a->GenFramebuffers(1, &o.framebuffer);
    a->BindFramebuffer(GL_FRAMEBUFFER, o.framebuffer);
    a->FramebufferTexture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, o.colors[0], 0);
    a->FramebufferTexture(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT1, o.colors[1], 0);
    a->FramebufferTexture(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, o.depth, 0);
    assert_int_equal(a->CheckFramebufferStatus(GL_FRAMEBUFFER), GL_FRAMEBUFFER_COMPLETE);
    return o;
}

static void own_clear(const dp_gl_api *a, const own *o, const GLfloat color[4], GLfloat depth) {
    static const GLenum both[2] = {GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT0};
    a->BindFramebuffer(GL_FRAMEBUFFER, o->framebuffer);
    a->DrawBuffers(2, both);
    for (int i = 0; i < 2; i++) a->ClearBufferfv(GL_COLOR, i, color);
    a->ClearBufferfv(GL_DEPTH, 0, &depth);
    a->BindFramebuffer(GL_FRAMEBUFFER, 0);
}

static void own_free(const dp_gl_api *a, own *o) {
    a->DeleteFramebuffers(1, &o->framebuffer);
    a->DeleteTextures(2, o->colors);
    a->DeleteTextures(1, &o->depth);
}

/* The figure, drawn into a target and read. */
static void draw(gl_test *t, const dp_camera *camera, const dp_style *style,
                 const dp_gl_target *target, uint8_t *rgba) {
    figure f;
    dp_diag diag = {0};
    dp_gl_mesh *mesh;
    figure_make(&f, 0);
    dp_source *const source = figure_source(&f);
    dp_result result = dp_gl_mesh_from_source(t->gl, source, &mesh, &diag);
    if (!result) result = dp_gl_draw(t->gl, &mesh, 1, camera, style, target, &diag);
    if (!result) result = dp_gl_read(t->gl, target, rgba, 0, &diag);
    if (result) fail_msg("%s", diag.message);
    dp_gl_mesh_destroy(mesh);
    dp_source_destroy(source);
}

static bool is_color(const uint8_t *pixel, int r, int g, int b) {
    return pixel[0] == r && pixel[1] == g && pixel[2] == b;
}

static double share_of(const uint8_t *rgba, int r, int g, int b) {
    int count = 0;
    for (int i = 0; i < BYTES; i += 4) count += is_color(rgba + i, r, g, b);
    return count / (double)(WIDTH * HEIGHT);
}

/* A wall across the view, `distance` before the eye, as the application's depth has it. */
static float depth_of_wall(const dp_camera *camera, double distance) {
    const double *const p = camera->projection;
    const double z = p[10] * -distance + p[14], w = p[11] * -distance + p[15];
    return (float)(z / w * 0.5 + 0.5);
}

static const struct wall {
    bool several, orthographic;
    GLenum format;
    uint32_t samples;
} walls[] = {{false, false, GL_DEPTH_COMPONENT32F, 1},
             {false, true, GL_DEPTH_COMPONENT24, 4},
             {true, false, GL_DEPTH24_STENCIL8, 4}};

/* What lies behind a wall of the application's is hidden as if the far plane stood there, and the wall is
 * left as it is. */
static void depth_of_others_hides(void **state) {
    static const GLfloat gray[4] = {0, 1, 0, 1};
    static uint8_t shown[BYTES], cut[BYTES];
    gl_test *const t = *state;
    if (!t->gl) skip();
    const dp_gl_api *const a = &t->gl->api;
    const double distance = 4.6;
    for (size_t i = 0; i < sizeof walls / sizeof *walls; i++) {
        const struct wall *const w = &walls[i];
        own o = own_make(a, w->several, w->format, WIDTH, HEIGHT);
        const dp_camera camera = figure_camera(w->orthographic, 20),
                        short_camera = figure_camera(w->orthographic, distance);
        own_clear(a, &o, gray, depth_of_wall(&camera, distance));
        dp_gl_target target = gl_test_target(t, WIDTH, HEIGHT, w->samples);
        draw(t, &short_camera, &flat, &target, cut);
        target.framebuffer = o.framebuffer, target.depth_texture = o.depth;
        draw(t, &camera, &flat, &target, shown);
        gl_test_keep("target-wall", shown, WIDTH, HEIGHT);
        int wrong = 0;
        for (int k = 0; k < BYTES; k += 4) {
            const bool surface = is_color(cut + k, 200, 40, 40), paper = cut[k + 1] == 255;
            wrong += surface && !is_color(shown + k, 200, 40, 40);
            wrong += paper && !is_color(shown + k, 0, 255, 0);
        }
        assert_true(share_of(shown, 200, 40, 40) > 0.05 && share_of(shown, 0, 255, 0) > 0.3);
        assert_in_range(wrong, 0, WIDTH * HEIGHT / 1000);
        own_free(a, &o);
    }
}

/* Beyond the wall nothing is inked; before it all is; far away it changes nothing. */
static void depth_of_others_hides_lines(void **state) {
    static const GLfloat white[4] = {1, 1, 1, 1};
    gl_test *const t = *state;
    if (!t->gl) skip();
    const dp_gl_api *const a = &t->gl->api;
    static const struct {
        double distance, least, most; /* share of the ink that is left */
    } cases[] = {{19, 0.999, 1.001}, {4.6, 0.1, 0.7}, {1.5, 0, 0}};
    const dp_camera camera = figure_camera(false, 20);
    figure f;
    figure_make(&f, 0);
    dp_source *const source = figure_source(&f);
    for (int lines = 0; lines < 2; lines++) /* also where surfaces cut nothing */
        for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
            own o = own_make(a, false, GL_DEPTH_COMPONENT24, WIDTH, HEIGHT);
            dp_style style = {.lines = lines ? DP_RIDGE : DP_SILHOUETTE | DP_RIDGE,
                              .ridge_angle = 165};
            for (int k = 0; k < 2; k++) style.line[k] = (dp_line_style){3, DP_RGB(0, 0, 0)};
            dp_gl_target target = {.framebuffer = o.framebuffer,
                                   .width = WIDTH,
                                   .height = HEIGHT,
                                   .samples = 1,
                                   .depth_texture = o.depth,
                                   .transparent = true};
            uint8_t *cpu, *gpu;
            own_clear(a, &o, white, depth_of_wall(&camera, cases[i].distance));
            strokes_draw_both(t, source, &camera, &style, &target, &cpu, &gpu, NULL);
            gl_test_keep(lines ? "target-ink-ridges" : "target-ink", gpu, WIDTH, HEIGHT);
            double ink[2] = {0, 0};
            for (int k = 0; k < BYTES; k += 4) ink[0] += 255 - cpu[k], ink[1] += 255 - gpu[k];
            const double left = ink[1] / ink[0];
            if (left < cases[i].least || left > cases[i].most)
                fail_msg("a wall at %g leaves %g of the ink", cases[i].distance, left);
            free(cpu), free(gpu);
            own_free(a, &o);
        }
    dp_source_destroy(source);
}

static void refuses_other_textures(void **state) {
    gl_test *const t = *state;
    if (!t->gl) skip();
    const dp_gl_api *const a = &t->gl->api;
    const dp_camera camera = figure_camera(false, 20);
    own o = own_make(a, false, GL_DEPTH_COMPONENT24, WIDTH / 2, HEIGHT);
    GLuint layered, bad[4] = {o.depth, t->texture, 0x7777777, 0};
    a->GenTextures(1, &layered);
    a->BindTexture(GL_TEXTURE_2D_ARRAY, layered);
    bad[3] = layered;
    dp_gl_target target = gl_test_target(t, WIDTH, HEIGHT, 1);
    bad[1] = t->texture;
    for (int i = 0; i < 4; i++) {
        dp_diag diag = {0};
        target.depth_texture = bad[i];
        assert_int_equal(dp_gl_draw(t->gl, NULL, 0, &camera, &flat, &target, &diag),
                         DP_ERR_ARGUMENT);
        assert_non_null(strstr(diag.message, "depth_texture"));
    }
    a->BindTexture(GL_TEXTURE_2D_ARRAY, 0);
    a->DeleteTextures(1, &layered);
    own_free(a, &o);
}

/* In a part of a larger framebuffer, only that part changes, and only the first of its draw buffers. */
static void draws_into_a_part(void **state) {
    static const GLfloat green[4] = {0, 1, 0, 1};
    static uint8_t alone[BYTES];
    enum { X = 30, Y = 20, W = WIDTH + 70, H = HEIGHT + 50 };
    gl_test *const t = *state;
    if (!t->gl) skip();
    const dp_gl_api *const a = &t->gl->api;
    const dp_camera camera = figure_camera(false, 20);
    dp_gl_target target = gl_test_target(t, WIDTH, HEIGHT, 1);
    draw(t, &camera, &flat, &target, alone);
    for (int several = 0; several < 2; several++) {
        own o = own_make(a, several, GL_DEPTH_COMPONENT24, W, H);
        own_clear(a, &o, green, 1);
        dp_gl_target part = target;
        part.framebuffer = o.framebuffer, part.x = X, part.y = Y;
        uint8_t *const rgba = malloc((size_t)4 * W * H), *const there = malloc(BYTES);
        draw(t, &camera, &flat, &part, there);
        assert_memory_equal(there, alone, BYTES);
        part.x = part.y = 0, part.width = W, part.height = H;
        assert_int_equal(dp_gl_read(t->gl, &part, rgba, 0, NULL), DP_OK);
        int wrong = 0;
        for (int y = 0; y < H; y++)
            for (int x = 0; x < W; x++) {
                const int px = x - X, py = y - (H - Y - HEIGHT);
                const bool in = px >= 0 && px < WIDTH && py >= 0 && py < HEIGHT;
                const uint8_t *const p = rgba + 4 * (y * W + x);
                wrong +=
                    in ? memcmp(p, alone + 4 * (py * WIDTH + px), 4) != 0 : !is_color(p, 0, 255, 0);
            }
        assert_int_equal(wrong, 0);
        a->BindFramebuffer(GL_FRAMEBUFFER, o.framebuffer);
        a->DrawBuffer(GL_COLOR_ATTACHMENT0); /* the second of both before */
        assert_int_equal(dp_gl_read(t->gl, &part, rgba, 0, NULL), DP_OK);
        for (int i = 0; i < 4 * W * H; i += 4) wrong += !is_color(rgba + i, 0, 255, 0);
        assert_int_equal(wrong, 0);
        free(rgba), free(there);
        own_free(a, &o);
    }
}

/* Where the picture is empty, a transparent target keeps what it holds. */
static void leaves_what_is_there(void **state) {
    static const GLfloat green[4] = {0, 1, 0, 1};
    static uint8_t alone[BYTES], over[BYTES];
    gl_test *const t = *state;
    if (!t->gl) skip();
    const dp_gl_api *const a = &t->gl->api;
    const dp_camera camera = figure_camera(false, 20);
    dp_style style = flat;
    style.paper = 0xffffff00, style.surface = 0xc8282880;
    dp_gl_target target = gl_test_target(t, WIDTH, HEIGHT, 1);
    draw(t, &camera, &style, &target, alone);
    own o = own_make(a, false, GL_DEPTH_COMPONENT24, WIDTH, HEIGHT);
    own_clear(a, &o, green, 1);
    target.framebuffer = o.framebuffer, target.transparent = true;
    draw(t, &camera, &style, &target, over);
    for (int i = 0; i < BYTES; i += 4) {
        if (alone[i + 3] == 0) assert_true(is_color(over + i, 0, 255, 0));
        if (alone[i + 3] != 0) assert_in_range(over[i], 99, 102);
        assert_int_equal(over[i + 3], 255);
    }
    assert_true(share_of(over, 0, 255, 0) > 0.3 && share_of(over, 0, 255, 0) < 0.9);
    own_free(a, &o);
}

/* ------- a window's framebuffer ------- */

typedef struct window {
    EGLDisplay display;
    EGLContext context;
    EGLSurface surface;
    __typeof__(eglMakeCurrent) *make_current;
    __typeof__(eglDestroySurface) *destroy;
} window;

static void find(void *library, void *function, const char *name) {
    void *const address = dlsym(library, name);
    memcpy(function, &address, sizeof address);
}

static bool open_window(window *w) {
    static const EGLint kind[] = {
        EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RED_SIZE, 8, EGL_ALPHA_SIZE, 8, EGL_NONE};
    static const EGLint size[] = {EGL_WIDTH, WIDTH, EGL_HEIGHT, HEIGHT, EGL_NONE};
    __typeof__(eglGetCurrentDisplay) *display;
    __typeof__(eglGetCurrentContext) *context;
    __typeof__(eglChooseConfig) *choose;
    __typeof__(eglCreatePbufferSurface) *create;
    void *const library = dlopen("libEGL.so.1", RTLD_NOW);
    EGLConfig config;
    EGLint count = 0;
    find(library, &display, "eglGetCurrentDisplay"),
        find(library, &context, "eglGetCurrentContext");
    find(library, &choose, "eglChooseConfig"), find(library, &create, "eglCreatePbufferSurface");
    find(library, &w->make_current, "eglMakeCurrent");
    find(library, &w->destroy, "eglDestroySurface");
    w->display = display(), w->context = context();
    if (!choose(w->display, kind, &config, 1, &count) || !count) return false;
    w->surface = create(w->display, config, size);
    return w->surface && w->make_current(w->display, w->surface, w->surface, w->context);
}

static void close_window(window *w) {
    w->make_current(w->display, EGL_NO_SURFACE, EGL_NO_SURFACE, w->context);
    w->destroy(w->display, w->surface);
}

static void draws_into_a_window(void **state) {
    static uint8_t alone[BYTES], there[BYTES];
    gl_test *const t = *state;
    window w = {0};
    dp_diag diag = {0};
    if (!t->gl) skip();
    const dp_camera camera = figure_camera(false, 20);
    dp_gl_target target = gl_test_target(t, WIDTH, HEIGHT, 4);
    draw(t, &camera, &flat, &target, alone);
    target.framebuffer = 0;
    assert_int_equal(dp_gl_draw(t->gl, NULL, 0, &camera, &flat, &target, &diag), DP_ERR_ARGUMENT);
    assert_non_null(strstr(diag.message, "no window"));
    if (!open_window(&w)) skip();
    draw(t, &camera, &flat, &target, there);
    assert_memory_equal(there, alone, BYTES);
    close_window(&w);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(depth_of_others_hides),  cmocka_unit_test(depth_of_others_hides_lines),
        cmocka_unit_test(refuses_other_textures), cmocka_unit_test(draws_into_a_part),
        cmocka_unit_test(leaves_what_is_there),   cmocka_unit_test(draws_into_a_window)};
    return cmocka_run_group_tests(tests, gl_test_setup, gl_test_teardown);
}
