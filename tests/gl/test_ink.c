/* Ink on graphics hardware equals the CPU's, stroke by stroke: both draw the same segments. */
#include "gl/context.h"
#include "gl/strokes.h"

#include <drypoint/shapes.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

enum { WIDTH = 300, HEIGHT = 200 };

typedef struct look {
    const char *name, *shape;
    float width; /* px */
    uint32_t samples;
    bool orthographic;
    double least; /* share of pixels that are alike */
} look;

/* All classes in colours of their own, with opacities less than 1. */
static dp_style style_of(float width) {
    static const dp_color colors[5] = {0x101010ff, 0xb02020ff, 0x2020b0e0, 0x208020ff, 0xc08000a0};
    dp_style style = {.lines = DP_SILHOUETTE | DP_RIDGE | DP_VALLEY | DP_INTERSECTION | DP_BORDER,
                      .ridge_angle = 150,
                      .valley_angle = 210};
    for (int i = 0; i < 5; i++) style.line[i] = (dp_line_style){.width = width, .color = colors[i]};
    return style;
}

static void compare(gl_test *t, const look *k) {
    dp_source *source;
    dp_camera camera;
    char name[120];
    uint8_t *cpu, *gpu;
    const dp_style style = style_of(k->width);
    const dp_gl_target target = gl_test_target(t, WIDTH, HEIGHT, k->samples);
    const dp_fit fit = {.aspect = (double)WIDTH / HEIGHT, .orthographic = k->orthographic};
    const dp_shape made = {.name = k->shape, .triangles = 1500};
    assert_int_equal(dp_source_from_shape(&made, &source, NULL), DP_OK);
    assert_int_equal(dp_camera_fit_source(&camera, &fit, source, NULL, NULL), DP_OK);
    strokes_draw_both(t, source, &camera, &style, &target, &cpu, &gpu, NULL);
    const double share = gl_test_alike(gpu, cpu, WIDTH, HEIGHT, 2);
    snprintf(name, sizeof name, "ink-%s-gpu", k->name);
    gl_test_keep(name, gpu, WIDTH, HEIGHT);
    snprintf(name, sizeof name, "ink-%s-cpu", k->name);
    gl_test_keep(name, cpu, WIDTH, HEIGHT);
    if (getenv("DP_TEST_PICTURES")) printf("%-28s %.5f\n", k->name, share);
    if (share < k->least) fail_msg("%s: %.4f of the pixels are alike", k->name, share);
    free(cpu), free(gpu);
    dp_source_destroy(source);
}

static void equals_the_cpu(void **state) {
    static const look looks[] = {
        {"bracket-2", "bracket", 2, 1, false, 0.995},
        {"bracket-12-4", "bracket", 12, 4, false, 0.995},
        {"torus-2-4-ortho", "torus", 2, 4, true, 0.995},
        {"torus-12", "torus", 12, 1, false, 0.995},
        {"boxes-2-4", "boxes", 2, 4, false, 0.995},
        {"boxes-12-ortho", "boxes", 12, 1, true, 0.995},
        {"terrain-2-ortho", "terrain", 2, 1, true, 0.995},
        {"terrain-12-4", "terrain", 12, 4, false, 0.995},
        {"gear-24-4-ortho", "gear", 24, 4, true, 0.995},
        {"torus-64-4", "torus", 64, 4, false, 0.995},
    };
    for (size_t i = 0; i < sizeof looks / sizeof *looks; i++) compare(*state, &looks[i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(equals_the_cpu)};
    return cmocka_run_group_tests(tests, gl_test_setup, gl_test_teardown);
}
