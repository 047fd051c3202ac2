/* An OpenGL context without a window, by EGL (Mesa's surfaceless platform, or the device one), for tests; and a framebuffer
 * to draw into. libEGL is loaded when a test runs. */
#ifndef TESTS_GL_CONTEXT_H
#define TESTS_GL_CONTEXT_H

#include <drypoint/gl.h>

typedef struct gl_context gl_context;

/* NULL: there is no EGL, or no OpenGL `version` (430, …) core profile, and *why says which. */
gl_context *gl_context_create(int version, const char **why);
void gl_context_destroy(gl_context *context); /* NULL allowed */
/* Makes it current, as gl_context_create does. */
void gl_context_use(gl_context *context);
void *gl_context_proc(void *user, const char *name);

/* A dp_gl of a current context; fails the test if that cannot be. Skips the test where there is no context:
 * set as cmocka's setup and teardown, the state is a gl_test *. */
typedef struct gl_test {
    gl_context *context;
    dp_gl *gl;
    uint32_t framebuffer, texture; /* RGBA8 */
    uint32_t width, height;
    char messages[4096]; /* what the driver said */
} gl_test;
int gl_test_setup(void **state);
int gl_test_teardown(void **state);
/* A framebuffer of that size, as a target. */
dp_gl_target gl_test_target(gl_test *test, uint32_t width, uint32_t height, uint32_t samples);
/* Draws a source and reads the picture: [height][width][4], malloc'd. */
uint8_t *gl_test_draw(gl_test *test, dp_source *source, const dp_camera *camera,
                      const dp_style *style, uint32_t width, uint32_t height, uint32_t samples);
/* The same by the CPU. */
uint8_t *gl_test_draw_cpu(dp_source *source, const dp_camera *camera, const dp_style *style,
                          uint32_t width, uint32_t height, uint32_t samples);
/* Share of pixels whose channels all differ by no more than `levels`. */
double gl_test_alike(const uint8_t *a, const uint8_t *b, uint32_t width, uint32_t height,
                     int levels);
/* Writes a PNG if the environment names a directory in DP_TEST_PICTURES. */
void gl_test_keep(const char *name, const uint8_t *rgba, uint32_t width, uint32_t height);

#endif
