/* Silhouettes by adjacency on graphics hardware: by a geometry shader in one pass and in two, and by pulling, which all draw
 * one picture; and beside the CPU's, plain and textured. */
#include "gl/context.h"

#include "gl/gl.h"

#include <drypoint/shapes.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 240, HEIGHT = 180 };

typedef struct look {
    const char *name, *shape, *texture;
    float width; /* px */
    uint32_t samples;
    bool orthographic;
    double least; /* share of pixels within two levels of the CPU's */
} look;

typedef struct scene {
    dp_source *source;
    dp_camera camera;
    dp_texture *texture;
    dp_style style;
} scene;

static void open_scene(const look *k, scene *s) {
    const dp_fit fit = {.aspect = (double)WIDTH / HEIGHT, .orthographic = k->orthographic};
    const dp_shape made = {.name = k->shape, .triangles = 1500};
    *s = (scene){.style = {.lines = DP_SILHOUETTE | DP_BORDER,
                           .edges = DP_EDGES_ADJACENCY,
                           .ink = DP_INK_QUADS,
                           .method = DP_METHOD_PAPER,
                           .surface = DP_RGB(220, 230, 240)}};
    assert_int_equal(dp_source_from_shape(&made, &s->source, NULL), DP_OK);
    assert_int_equal(dp_camera_fit_source(&s->camera, &fit, s->source, NULL, NULL), DP_OK);
    s->style.line[DP_LINE_SILHOUETTE] = (dp_line_style){k->width, 0x203060ff};
    s->style.line[DP_LINE_BORDER] = (dp_line_style){k->width * 0.7f, 0xb03020d0};
    if (!k->texture) return;
    assert_int_equal(dp_texture_named(k->texture, 0, NULL, &s->texture, NULL), DP_OK);
    s->style.stroke.texture = s->texture;
    s->style.stroke.u = DP_STROKE_POLAR;
}

static void close_scene(scene *s) {
    dp_source_destroy(s->source);
    dp_texture_destroy(s->texture);
}

static uint8_t *draw(gl_test *t, scene *s, const look *k, int passes, bool pulled) {
    s->style.passes = passes;
    t->gl->no_geometry_shader = pulled;
    uint8_t *const rgba =
        gl_test_draw(t, s->source, &s->camera, &s->style, WIDTH, HEIGHT, k->samples);
    t->gl->no_geometry_shader = false;
    return rgba;
}

static void keep(const look *k, const char *how, const uint8_t *rgba) {
    char name[120];
    snprintf(name, sizeof name, "fins-%s-%s", k->name, how);
    gl_test_keep(name, rgba, WIDTH, HEIGHT);
}

static void compare(gl_test *t, const look *k) {
    scene s;
    if (!t->gl) skip();
    open_scene(k, &s);
    uint8_t *const once = draw(t, &s, k, 1, false), *const twice = draw(t, &s, k, 2, false),
                   *const pulled = draw(t, &s, k, 2, true),
                   *const pulled_once = draw(t, &s, k, 1, true);
    uint8_t *const cpu = gl_test_draw_cpu(s.source, &s.camera, &s.style, WIDTH, HEIGHT, k->samples);
    keep(k, "once", once), keep(k, "twice", twice), keep(k, "pulled", pulled), keep(k, "cpu", cpu);
    const double share = gl_test_alike(once, cpu, WIDTH, HEIGHT, 2);
    if (getenv("DP_TEST_PICTURES"))
        printf("%-24s cpu %.5f twice %.5f pulled %.5f\n", k->name, share,
               gl_test_alike(once, twice, WIDTH, HEIGHT, 0),
               gl_test_alike(once, pulled, WIDTH, HEIGHT, 0));
    /* interpolated coordinates of a texture may be rounded otherwise */
    const int levels = k->texture ? 1 : 0;
    const bool same = !memcmp(once, twice, 4 * WIDTH * HEIGHT) &&
                      !memcmp(pulled, pulled_once, 4 * WIDTH * HEIGHT) &&
                      gl_test_alike(once, pulled, WIDTH, HEIGHT, levels) == 1;
    free(once), free(twice), free(pulled), free(pulled_once), free(cpu);
    close_scene(&s);
    if (!same) fail_msg("%s: passes and ways of drawing differ", k->name);
    if (share < k->least) fail_msg("%s: %.4f of the pixels are alike", k->name, share);
}

static void equals_the_cpu(void **state) {
    static const look looks[] = {
        {"torus-2", "torus", NULL, 2, 4, false, 0.99},
        {"torus-12", "torus", NULL, 12, 1, false, 0.99},
        {"bracket-8", "bracket", NULL, 8, 4, true, 0.99},
        {"sheet-8", "terrain", NULL, 8, 4, false, 0.99},
    };
    for (size_t i = 0; i < sizeof looks / sizeof *looks; i++) compare(*state, &looks[i]);
}

static void is_textured(void **state) {
    static const look looks[] = {
        {"charcoal", "torus", "charcoal", 10, 4, false, 0.97},
        {"dashes", "bracket", "dashes", 8, 1, false, 0.97},
        {"rope", "terrain", "rope", 12, 4, false, 0.97},
    };
    for (size_t i = 0; i < sizeof looks / sizeof *looks; i++) compare(*state, &looks[i]);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(equals_the_cpu),
                                       cmocka_unit_test(is_textured)};
    return cmocka_run_group_tests(tests, gl_test_setup, gl_test_teardown);
}
