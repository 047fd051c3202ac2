/* Pencil rendering on graphics hardware beside the CPU's; how much of the difference the texture units' filtering makes. */
#include "gl/context.h"

#include "gl/gl.h"

#include <drypoint/shapes.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

enum { WIDTH = 240, HEIGHT = 180 };

typedef struct look {
    const char *name, *shape;
    uint32_t tones, samples;
    bool printed, own;
    float scale;
    double least, mean; /* share of pixels within two levels; mean difference of channels, levels */
} look;

static double mean_difference(const uint8_t *a, const uint8_t *b) {
    double sum = 0;
    for (size_t i = 0; i < (size_t)4 * WIDTH * HEIGHT; i++) sum += abs(a[i] - b[i]);
    return sum / (4.0 * WIDTH * HEIGHT);
}

/* Strokes of the application's own, of odd sizes. */
static dp_image make_strokes(uint8_t *values) {
    for (uint32_t y = 0; y < 37; y++)
        for (uint32_t x = 0; x < 51; x++)
            values[y * 51 + x] = (uint8_t)(y % 6 < 3 ? 80 + 3 * (x % 20) : 240);
    return (dp_image){values, 51, 37};
}

static void compare(gl_test *t, const look *k) {
    dp_source *source;
    dp_camera camera;
    uint8_t strokes[51 * 37];
    char name[120];
    if (!t->gl) skip();
    const dp_fit fit = {.aspect = (double)WIDTH / HEIGHT};
    const dp_shape made = {.name = k->shape, .triangles = 3000};
    dp_style style = {.lines = DP_NO_LINES,
                      .surface = DP_RGB(250, 245, 235),
                      .shade = {.shading = DP_SHADING_PENCIL,
                                .pencil_tones = k->tones,
                                .pencil_printed = k->printed,
                                .stroke_scale = k->scale,
                                .ink = 0x202830f0}};
    if (k->own) style.shade.strokes = make_strokes(strokes);
    assert_int_equal(dp_source_from_shape(&made, &source, NULL), DP_OK);
    assert_int_equal(dp_camera_fit_source(&camera, &fit, source, NULL, NULL), DP_OK);
    uint8_t *const cpu = gl_test_draw_cpu(source, &camera, &style, WIDTH, HEIGHT, k->samples);
    uint8_t *of[3]; /* by lookups */
    for (int i = 0; i < 3; i++) {
        t->gl->lookups = i;
        of[i] = gl_test_draw(t, source, &camera, &style, WIDTH, HEIGHT, k->samples);
    }
    t->gl->lookups = DP_GL_LOOKUPS_UNIT;
    snprintf(name, sizeof name, "pencil-%s-gpu", k->name);
    gl_test_keep(name, of[0], WIDTH, HEIGHT);
    snprintf(name, sizeof name, "pencil-%s-cpu", k->name);
    gl_test_keep(name, cpu, WIDTH, HEIGHT);
    const double two = gl_test_alike(of[0], cpu, WIDTH, HEIGHT, 2),
                 mean = mean_difference(of[0], cpu);
    if (getenv("DP_TEST_PICTURES"))
        for (int i = 0; i < 3; i++)
            printf("%-12s lookups %d: within 2 %.5f, within 16 %.5f, mean %.4f\n", k->name, i,
                   gl_test_alike(of[i], cpu, WIDTH, HEIGHT, 2),
                   gl_test_alike(of[i], cpu, WIDTH, HEIGHT, 16), mean_difference(of[i], cpu));
    for (int i = 0; i < 3; i++) free(of[i]);
    free(cpu);
    dp_source_destroy(source);
    if (two < k->least || mean > k->mean)
        fail_msg("%s: %.4f of the pixels are alike, mean difference %.3f", k->name, two, mean);
}

static void equals_the_cpu(void **state) {
    static const look looks[] = {
        {"torso", "torso", 0, 4, false, false, 1, 0.98, 0.2},
        {"torus", "torus", 0, 1, false, false, 0.6f, 0.98, 0.2},
        {"printed", "torus", 0, 4, true, false, 1, 0.95, 0.5},
        {"tones", "bracket", 6, 4, false, false, 1, 0.98, 0.2},
        {"own", "bracket", 0, 4, false, true, 1.5f, 0.98, 0.2},
    };
    for (size_t i = 0; i < sizeof looks / sizeof *looks; i++) compare(*state, &looks[i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(equals_the_cpu)};
    return cmocka_run_group_tests(tests, gl_test_setup, gl_test_teardown);
}
