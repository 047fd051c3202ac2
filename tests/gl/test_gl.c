/* The back end on graphics hardware: pictures of simple models, beside those of dp_draw. */
#include "gl/context.h"

#include <drypoint/shapes.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

enum { WIDTH = 200, HEIGHT = 150 };

/* A picture by OpenGL and one by the CPU, of a generated model. */
static double alike(gl_test *t, const char *shape, const dp_style *style, uint32_t samples,
                    int levels) {
    dp_source *source;
    dp_camera camera;
    if (!t->gl) skip();
    const dp_fit fit = {.aspect = (double)WIDTH / HEIGHT};
    const dp_shape made = {.name = shape, .triangles = 2000};
    assert_int_equal(dp_source_from_shape(&made, &source, NULL), DP_OK);
    assert_int_equal(dp_camera_fit_source(&camera, &fit, source, NULL, NULL), DP_OK);
    uint8_t *const gpu = gl_test_draw(t, source, &camera, style, WIDTH, HEIGHT, samples),
                   *const cpu = gl_test_draw_cpu(source, &camera, style, WIDTH, HEIGHT, samples);
    char name[80];
    snprintf(name, sizeof name, "gl-%s-gpu", shape);
    gl_test_keep(name, gpu, WIDTH, HEIGHT);
    snprintf(name, sizeof name, "gl-%s-cpu", shape);
    gl_test_keep(name, cpu, WIDTH, HEIGHT);
    const double share = gl_test_alike(gpu, cpu, WIDTH, HEIGHT, levels);
    free(gpu), free(cpu);
    dp_source_destroy(source);
    return share;
}

/* Faces cover the same pixels as on the CPU. With one sample a pixel is or is not covered; rounding of corners to the device's
 * grid decides in a few. */
static void draws_flat_faces(void **state) {
    const dp_style style = {.lines = DP_NO_LINES, .surface = DP_RGB(200, 40, 40)};
    assert_true(alike(*state, "torus", &style, 1, 0) > 0.999);
    assert_true(alike(*state, "bracket", &style, 1, 0) > 0.999);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(draws_flat_faces)};
    return cmocka_run_group_tests(tests, gl_test_setup, gl_test_teardown);
}
