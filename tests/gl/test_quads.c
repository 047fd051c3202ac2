/* Added polygons as ink on graphics hardware (Raskar 2001): pictures beside those of dp_draw, of the same style.
 *
 * What may differ are samples that an edge of a polygon just touches: the device rounds corners to 1/256 px. Of 35,000 pixels some
 * ten are affected with one sample, twice as many with four. */
#include "gl/context.h"

#include <drypoint/shapes.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

enum { WIDTH = 220, HEIGHT = 160 };
enum { PLANE, ONCE, TWICE, STENCIL, BETWEENS };

/* A model and how it is looked at. */
typedef struct scene {
    const char *shape;
    bool orthographic, inside;
    uint32_t samples, triangles;
} scene;

static const dp_color RED = DP_RGB(200, 0, 0), BLUE = DP_RGB(0, 0, 200), GREEN = DP_RGB(0, 160, 0),
                      PURPLE = DP_RGB(200, 0, 200), BROWN = DP_RGB(160, 100, 0);

static dp_style style_of(dp_method method, int between) {
    static const dp_between betweens[] = {DP_BETWEEN_PLANE, DP_BETWEEN_INTERVAL,
                                          DP_BETWEEN_INTERVAL, DP_BETWEEN_STENCIL};
    return (dp_style){.ink = DP_INK_QUADS,
                      .method = method,
                      .between = betweens[between],
                      .passes = between == TWICE ? 2 : 0,
                      .line = {{3, RED}, {2, BLUE}, {4, GREEN}, {3, PURPLE}, {5, BROWN}}};
}

/* Inside: the eye stands in the model, which the near plane cuts. */
static dp_camera camera_of(dp_source *source, const scene *s) {
    dp_camera camera;
    dp_extent extent;
    const dp_fit fit = {.aspect = (double)WIDTH / HEIGHT, .orthographic = s->orthographic};
    assert_int_equal(dp_camera_fit_source(&camera, &fit, source, &extent, NULL), DP_OK);
    if (!s->inside) return camera;
    double eye[3], target[3];
    const double up[3] = {0, 1, 0};
    for (int k = 0; k < 3; k++) {
        const double a = (double)extent.min[k], b = (double)extent.max[k];
        eye[k] = a + (b - a) * (k == 2 ? 1.05 : 0.7), target[k] = a + (b - a) * (k ? 0.5 : 0.2);
    }
    assert_int_equal(dp_camera_look_at(&camera, eye, target, up), DP_OK);
    const double size = (double)(extent.max[0] - extent.min[0]);
    assert_int_equal(
        dp_camera_perspective(&camera, 70, (double)WIDTH / HEIGHT, 0.2 * size, 9 * size), DP_OK);
    return camera;
}

static void keep(const scene *s, const dp_style *style, const char *kind, const uint8_t *rgba) {
    char name[120];
    snprintf(name, sizeof name, "quads-%s%s-%s-%d-%d-%s-%u-%s", s->shape, s->inside ? "-in" : "",
             style->method ? "paper" : "exact", (int)style->between, style->passes,
             s->orthographic ? "ortho" : "persp", s->samples, kind);
    gl_test_keep(name, rgba, WIDTH, HEIGHT);
}

static size_t count_like(const uint8_t *rgba, dp_color color) {
    size_t count = 0;
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
        const uint8_t *const p = rgba + 4 * i;
        count += p[0] == color >> 24 && p[1] == (color >> 16 & 0xff) && p[2] == (color >> 8 & 0xff);
    }
    return count;
}

/* Share of pixels within two levels of the CPU's. `least`: so many pixels must have all of `color`; 0: none need. */
static double alike_with(gl_test *t, dp_gl *gl, const scene *s, const dp_style *style,
                         dp_color color, size_t least) {
    dp_source *source;
    const dp_shape made = {.name = s->shape, .triangles = s->triangles ? s->triangles : 1500};
    assert_int_equal(dp_source_from_shape(&made, &source, NULL), DP_OK);
    const dp_camera camera = camera_of(source, s);
    dp_gl *const own = t->gl;
    t->gl = gl;
    uint8_t *const gpu = gl_test_draw(t, source, &camera, style, WIDTH, HEIGHT, s->samples),
                   *const cpu = gl_test_draw_cpu(source, &camera, style, WIDTH, HEIGHT, s->samples);
    t->gl = own;
    keep(s, style, "gpu", gpu), keep(s, style, "cpu", cpu);
    const double share = gl_test_alike(gpu, cpu, WIDTH, HEIGHT, 2);
    if (least) assert_true(count_like(gpu, color) >= least);
    free(gpu), free(cpu);
    dp_source_destroy(source);
    if (getenv("DP_TEST_PICTURES"))
        printf("%s %d %d %d %d %u: %.5f\n", s->shape, (int)style->method, (int)style->between,
               style->passes, s->orthographic, s->samples, share);
    return share;
}
static double alike(gl_test *t, const scene *s, const dp_style *style, dp_color color,
                    size_t least) {
    if (!t->gl) skip();
    return alike_with(t, t->gl, s, style, color, least);
}

static void all_ways(gl_test *t, const char *shape, uint32_t lines, dp_color color, size_t least,
                     double one, double four) {
    for (int i = 0; i < 2 * BETWEENS; i++)
        for (int k = 0; k < 4; k++) {
            const scene s = {shape, .orthographic = k & 1, .samples = k & 2 ? 4 : 1,
                             .triangles = 600};
            dp_style style = style_of(i % 2 ? DP_METHOD_PAPER : DP_METHOD_EXACT, i / 2);
            style.lines = lines, style.between_offset = i / 2 && color == PURPLE ? 6 : 0;
            assert_true(alike(t, &s, &style, color, least) >= (k & 2 ? four : one));
        }
}

static void equals_the_cpu(void **state) { all_ways(*state, "stairs", 0, GREEN, 5, 0.9996, 0.999); }

static void finds_intersections(void **state) {
    all_ways(*state, "boxes", DP_INTERSECTION | DP_SILHOUETTE, PURPLE, 10, 0.9997, 0.9996);
}

/* Borders are drawn at theta; in their own colour where ridges are off. */
static void draws_borders(void **state) {
    const scene s = {"terrain", .samples = 4, .triangles = 800};
    dp_style style = style_of(DP_METHOD_EXACT, PLANE);
    style.lines = DP_BORDER | DP_SILHOUETTE;
    assert_true(alike(*state, &s, &style, BROWN, 100) >= 0.999);
    style.lines = DP_ALL_LINES;
    assert_true(alike(*state, &s, &style, BLUE, 100) >= 0.998);
}

/* Corners behind the eye, and polygons that the near plane cuts. */
static void clips(void **state) {
    for (int i = 0; i < 4; i++) {
        const scene s = {"gear", .inside = true, .samples = 1};
        dp_style style = style_of(i % 2 ? DP_METHOD_PAPER : DP_METHOD_EXACT, i / 2);
        style.line[0].width = style.line[1].width = 8;
        assert_true(alike(*state, &s, &style, RED, 200) >= 0.998);
    }
}

static void takes_any_width_and_angle(void **state) {
    const float angles[3][2] = {{100, 190}, {200, 170}, {330, 300}};
    for (int i = 0; i < 3; i++) {
        const scene s = {"bracket", .samples = 4, .orthographic = i == 1};
        dp_style style = style_of(DP_METHOD_EXACT, PLANE);
        style.ridge_angle = angles[i][0], style.valley_angle = angles[i][1];
        style.line[i].width = 24;
        assert_true(alike(*state, &s, &style, 0, 0) >= 0.998);
    }
}

/* Ink lies over a shaded surface as a layer; colours may be translucent, and the paper too. */
static void lies_over_shading(void **state) {
    const scene s = {"torus", .samples = 4};
    dp_style style = style_of(DP_METHOD_EXACT, PLANE);
    style.surface = DP_RGB(180, 200, 220), style.line[0].color = 0xc8000080;
    assert_true(alike(*state, &s, &style, 0, 0) >= 0.999);
    style.paper = 0xffffff40;
    assert_true(alike(*state, &s, &style, 0, 0) >= 0.999);
    style.paper = 0, style.shade.shading = DP_SHADING_GOOCH;
    assert_true(alike(*state, &s, &style, 0, 0) >= 0.999);
}

/* With little memory half-edges are taken in several portions. */
static void takes_portions(void **state) {
    gl_test *const t = *state;
    dp_diag diag;
    dp_gl *gl = NULL;
    const dp_gl_desc desc = {
        .get_proc_address = gl_context_proc, .user = t->context, .memory = 640 * 1024};
    if (!t->gl) skip();
    assert_int_equal(dp_gl_create(&desc, &gl, &diag), DP_OK);
    for (int between = 0; between < BETWEENS; between++) {
        const scene s = {"gear", .samples = 4};
        const dp_style style = style_of(DP_METHOD_EXACT, between);
        assert_true(alike_with(t, gl, &s, &style, GREEN, 50) >= 0.999);
    }
    dp_gl_destroy(gl);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(equals_the_cpu),
                                       cmocka_unit_test(finds_intersections),
                                       cmocka_unit_test(draws_borders),
                                       cmocka_unit_test(clips),
                                       cmocka_unit_test(takes_any_width_and_angle),
                                       cmocka_unit_test(lies_over_shading),
                                       cmocka_unit_test(takes_portions)};
    return cmocka_run_group_tests(tests, gl_test_setup, gl_test_teardown);
}
