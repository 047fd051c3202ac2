/* Models that are not clean, by OpenGL: the lines are those of dp_draw, wherever the eye must decide. */
#include "gl/gl_look.h"
#include "twins/scene.h"

#include <drypoint/io.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 240, HEIGHT = 180, PIXELS = 12 /* that may differ */ };

static bool passes(const char *what, const look looks[2]) {
    int kind;
    for (int i = 0; i < 2; i++)
        if (looks[i].diag.result) {
            print_message("%s: %s\n", what, looks[i].diag.message);
            return false;
        }
    const uint32_t pixels = look_pixels(&looks[0], &looks[1]);
    const double lengths = look_lengths(&looks[0], &looks[1], &kind);
    if (pixels <= PIXELS && lengths <= 0) return true;
    print_message("%s: %u pixels differ, %.1f px of %s\n", what, pixels, lengths,
                  look_kind_names[kind]);
    return false;
}

static bool agrees(gl_test *t, const char *what, dp_source *source, const dp_camera *camera,
                   bool table_off) {
    const look_how how = {.width = WIDTH, .height = HEIGHT, .samples = 4, .table_off = table_off};
    look looks[2] = {{0}};
    dp_context *context;
    char name[200];
    assert_int_equal(dp_context_create(NULL, &context, NULL), DP_OK);
    look_draw_source(context, source, camera, &how, &looks[0]);
    gl_look_draw(t, source, camera, &how, &looks[1]);
    const bool right = passes(what, looks);
    for (int i = 0; i < 2; i++) {
        snprintf(name, sizeof name, "eye-%s-%s", what, i ? "gl" : "cpu");
        for (char *c = name; *c; c++)
            if (*c == '/') *c = '-';
        gl_test_keep(name, looks[i].rgba, WIDTH, HEIGHT);
        look_free(&looks[i]);
    }
    dp_context_destroy(context);
    return right;
}

/* ------- files ------- */

typedef struct case_of {
    const char *name; /* in tests/cases */
    double direction[3];
    bool orthographic;
} case_of;

static const case_of cases[] = {
    {"open-box.obj", {1, 1.2, 1}, false},
    {"back/tray.obj", {1, -1, 1}, true},
    {"back/vee.obj", {0.3, 0.6, 1}, false},
    {"back/inverted.obj", {1, -1, 1}, true},
    {"back/flip3.obj", {1, -1, 1}, true},
    {"inside-out-cylinder.obj", {1, 0.6, 1}, false},
    {"mixed-winding-cylinder.obj", {1, 0.6, 1}, false},
    {"double/box_double.stl", {1, -1, 1}, true},
    {"double/half.stl", {-1, -1, 0.6}, false},
    {"double/traydouble.stl", {0.5, -0.8, 1}, true},
    {"fan/fan_LRU_000.obj", {0.1, 0.2, 1}, false},
    {"fan/fan_RUL_011.obj", {0.1, 0.2, 1}, false},
    {"fan/fan_ULR_011.obj", {0.6, 0.7, 1}, false},
    {"standing/box_z1.4.obj", {0.5, -0.9, 0.8}, false},
    {"standing/box_open.obj", {0.5, -0.9, 0.8}, false},
    {"standing/cylopen24.obj", {0.5, -0.9, 0.8}, false},
    {"standing/shelf.obj", {0.5, -0.9, 0.8}, false},
    {"standing/table.obj", {0.5, -0.9, 0.8}, false},
    {"flush/two.obj", {0.5, -0.9, 0.5}, false},
    {"flush/overlap.obj", {0.5, -0.9, 0.5}, false},
    {"flush/plug.obj", {0.5, -0.9, 0.5}, false},
    {"nested/g0.001.obj", {0.5, -0.9, 0.5}, false},
    {"nested/g0.1.obj", {0.5, -0.9, 0.5}, false},
    {"twisted-prism.obj", {1, 0.6, 0.5}, false},
    {"t-junction.obj", {1, 0.8, 1}, false},
    {"tjunction/exact.stl", {0.5, 0.5, 1}, true},
    {"tjunction/ascii_.4f.stl", {0.5, 0.5, 1}, true},
    {"rim/slivers.stl", {1, -1, 1}, false},
    {"far-from-origin.obj", {1, -1, 0.6}, false},
};

static bool case_agrees(gl_test *t, const case_of *c, bool table_off) {
    const dp_fit fit = {.direction = {c->direction[0], c->direction[1], c->direction[2]},
                        .orthographic = c->orthographic,
                        .aspect = (double)WIDTH / HEIGHT};
    char path[1000];
    dp_source *source;
    dp_camera camera;
    dp_diag diag = {0};
    snprintf(path, sizeof path, "%s/cases/%s", DP_TESTS_DIR, c->name);
    if (dp_io_open(path, NULL, &source, &diag)) fail_msg("%s", diag.message);
    assert_int_equal(dp_camera_fit_source(&camera, &fit, source, NULL, NULL), DP_OK);
    const bool right = agrees(t, c->name, source, &camera, table_off);
    dp_source_destroy(source);
    return right;
}

static void unclean_models_have_the_same_lines(void **state) {
    gl_test *const t = *state;
    unsigned wrong = 0;
    if (!t->gl) skip();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        wrong += !case_agrees(t, &cases[i], false);
    assert_int_equal(wrong, 0);
}

/* Every edge as the eye sees it: dp_style.edge_table_off. */
static void the_eye_alone_finds_them(void **state) {
    gl_test *const t = *state;
    unsigned wrong = 0;
    if (!t->gl) skip();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i += 5)
        wrong += !case_agrees(t, &cases[i], true);
    assert_int_equal(wrong, 0);
}

/* ------- scenes ------- */

static bool scene_agrees(gl_test *t, uint64_t seed) {
    static const soup_place here = {.scale = 1};
    char name[40];
    soup_arrays arrays;
    scene s;
    dp_source *source;
    scene_make(seed, &s);
    const dp_camera camera = scene_camera(&s, &here, (double)WIDTH / HEIGHT);
    soup_arrays_make(&s.soup, &here, &arrays);
    assert_int_equal(dp_source_from_arrays(&arrays.batch, NULL, &source, NULL), DP_OK);
    snprintf(name, sizeof name, "scene-%u", (unsigned)seed);
    const bool right = agrees(t, name, source, &camera, false);
    dp_source_destroy(source);
    soup_arrays_free(&arrays);
    scene_free(&s);
    return right;
}

static void parts_that_touch_and_cross_do_so_too(void **state) {
    gl_test *const t = *state;
    unsigned wrong = 0;
    if (!t->gl) skip();
    for (uint64_t seed = 0; seed < 12; seed++) wrong += !scene_agrees(t, seed);
    assert_int_equal(wrong, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(unclean_models_have_the_same_lines),
                                       cmocka_unit_test(the_eye_alone_finds_them),
                                       cmocka_unit_test(parts_that_touch_and_cross_do_so_too)};
    return cmocka_run_group_tests(tests, gl_test_setup, gl_test_teardown);
}
