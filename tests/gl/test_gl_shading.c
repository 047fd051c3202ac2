/* Shading and edge maps on graphics hardware, beside those of dp_draw: shares of pixels within two grey levels. */
#include "gl/context.h"

#include <drypoint/shapes.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 240, HEIGHT = 180, LEVELS = 2 };
static const double SHARE = 0.99;

typedef struct sample {
    const char *name;
    dp_style style;
} sample;

static dp_source *make_shape(const char *name) {
    dp_source *source;
    const dp_shape shape = {.name = name, .triangles = 2000};
    assert_int_equal(dp_source_from_shape(&shape, &source, NULL), DP_OK);
    return source;
}

static dp_camera look_at(dp_source *source, bool orthographic) {
    dp_camera camera;
    const dp_fit fit = {.aspect = (double)WIDTH / HEIGHT, .orthographic = orthographic};
    assert_int_equal(dp_camera_fit_source(&camera, &fit, source, NULL, NULL), DP_OK);
    return camera;
}

/* Draws both pictures; fails if too many pixels differ. */
static void compare(gl_test *t, const char *name, dp_source *source, const dp_camera *camera,
                    const dp_style *style, uint32_t samples) {
    uint8_t *const gpu = gl_test_draw(t, source, camera, style, WIDTH, HEIGHT, samples),
                   *const cpu = gl_test_draw_cpu(source, camera, style, WIDTH, HEIGHT, samples);
    char file[120];
    const double share = gl_test_alike(gpu, cpu, WIDTH, HEIGHT, LEVELS);
    snprintf(file, sizeof file, "shading-%s-gpu", name);
    gl_test_keep(file, gpu, WIDTH, HEIGHT);
    snprintf(file, sizeof file, "shading-%s-cpu", name);
    gl_test_keep(file, cpu, WIDTH, HEIGHT);
    printf("%-40s %.5f\n", name, share);
    free(gpu), free(cpu);
    assert_true(share >= SHARE);
}

static void compare_shapes(gl_test *t, const sample *samples, size_t count) {
    static const char *const shapes[] = {"torus", "bracket"};
    if (!t->gl) skip();
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++) {
        dp_source *const source = make_shape(shapes[s]);
        const dp_camera camera = look_at(source, false);
        for (size_t i = 0; i < count; i++) {
            dp_style style = samples[i].style;
            char name[80];
            style.lines = DP_NO_LINES;
            if (!style.surface) style.surface = DP_RGB(200, 120, 60);
            snprintf(name, sizeof name, "%s-%s", shapes[s], samples[i].name);
            compare(t, name, source, &camera, &style, 4);
        }
        dp_source_destroy(source);
    }
}

static void shades(void **state) {
    static const uint8_t shades[3][4] = {
        {40, 60, 80, 255}, {140, 130, 120, 255}, {255, 250, 240, 255}};
    static const sample samples[] = {
        {"flat", {0}},
        {"paper", {.shade = {.shading = DP_SHADING_PAPER}, .paper = DP_RGB(240, 230, 200)}},
        {"lambert", {.shade = {.shading = DP_SHADING_LAMBERT}}},
        {"lambert-smooth",
         {.shade = {.shading = DP_SHADING_LAMBERT,
                    .normals = DP_NORMALS_SMOOTH,
                    .crease_angle = 100}}},
        {"lambert-facet", {.shade = {.shading = DP_SHADING_LAMBERT, .normals = DP_NORMALS_FACET}}},
        {"gooch", {.shade = {.shading = DP_SHADING_GOOCH, .highlight = 0.6f}}},
        {"gooch-plain",
         {.shade = {.shading = DP_SHADING_GOOCH, .gooch_plain = true, .light = {1, 0, 1}}}},
        {"toon", {.shade = {.shading = DP_SHADING_TOON}}},
        {"toon-nearest",
         {.shade = {.shading = DP_SHADING_TOON, .nearest = true, .shades = {shades[0], 3, 1}}}},
        {"hatch", {.shade = {.shading = DP_SHADING_HATCH, .ink = DP_RGB(20, 20, 90)}}},
        {"hatch-object", {.shade = {.shading = DP_SHADING_HATCH, .object_space = true}}},
        {"halftone", {.shade = {.shading = DP_SHADING_HALFTONE, .stroke_scale = 0.7f}}},
    };
    compare_shapes(*state, samples, sizeof samples / sizeof *samples);
}

#define MAP(...)                                                                                   \
    {                                                                                              \
        .surface = DP_RGB(210, 210, 210), .edge_map = { __VA_ARGS__ }                              \
    }

static void edge_maps(void **state) {
    static const uint8_t enhanced[1] = {1};
    static const sample samples[] = {
        {"diagonal", MAP(.detector = DP_EDGE_MAP_DIAGONAL)},
        {"c1", MAP(.detector = DP_EDGE_MAP_C1)},
        {"diagonal-printed", MAP(.detector = DP_EDGE_MAP_DIAGONAL, .as_printed = true)},
        {"c1-printed", MAP(.detector = DP_EDGE_MAP_C1, .as_printed = true, .enhanced = enhanced,
                           .enhanced_count = 1)},
        {"diagonal-8",
         MAP(.detector = DP_EDGE_MAP_DIAGONAL, .as_printed = true, .eight_bits = true)},
        {"c1-8", MAP(.detector = DP_EDGE_MAP_C1, .eight_bits = true)},
        {"c1-one-pass", MAP(.detector = DP_EDGE_MAP_C1, .c1_passes = 1)},
        {"wide", MAP(.detector = DP_EDGE_MAP_DIAGONAL, .radius = 3, .far_side = true,
                     .inner = DP_RGB(255, 255, 255), .profile = DP_RGB(0, 0, 160))},
        {"gooch-edges",
         {.shade = {.shading = DP_SHADING_GOOCH},
          .edge_map = {.detector = DP_EDGE_MAP_DIAGONAL, .inner = DP_RGB(255, 255, 255)}}},
        {"toon-edges",
         {.shade = {.shading = DP_SHADING_TOON}, .edge_map = {.detector = DP_EDGE_MAP_C1}}},
    };
    compare_shapes(*state, samples, sizeof samples / sizeof *samples);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(shades), cmocka_unit_test(edge_maps)};
    return cmocka_run_group_tests(tests, gl_test_setup, gl_test_teardown);
}
