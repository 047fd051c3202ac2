/* Pencil rendering on graphics hardware beside the CPU's; how much of the difference the texture units' filtering makes. */
#include "gl/context.h"
#include "gl/figure.h"

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

static GLuint buffer_of(gl_test *t, const void *data, size_t size) {
    const dp_gl_api *const a = &t->gl->api;
    GLuint name;
    a->GenBuffers(1, &name);
    a->BindBuffer(GL_COPY_WRITE_BUFFER, name);
    a->BufferData(GL_COPY_WRITE_BUFFER, (GLsizeiptr)size, data, GL_STATIC_DRAW);
    return name;
}

/* Positions that the application writes have their directions, made anew when they are others. */
static void follows_buffers(void **state) {
    gl_test *const t = *state;
    static uint8_t rgba[4 * WIDTH * HEIGHT];
    figure f;
    dp_gl_mesh *mesh;
    if (!t->gl) skip();
    const dp_camera camera = figure_camera(false, 20);
    const dp_style style = {.lines = DP_NO_LINES,
                            .shade = {.shading = DP_SHADING_PENCIL, .normals = DP_NORMALS_FACET}};
    const dp_gl_target target = gl_test_target(t, WIDTH, HEIGHT, 1);
    figure_make(&f, 0);
    const GLuint names[2] = {buffer_of(t, f.positions, sizeof f.positions),
                             buffer_of(t, f.indices, sizeof f.indices)};
    const dp_gl_buffers buffers = {.positions = names[0],
                                   .vertex_count = FIGURE_VERTICES,
                                   .indices = names[1],
                                   .triangle_count = FIGURE_TRIANGLES};
    assert_int_equal(dp_gl_mesh_from_buffers(t->gl, &buffers, &mesh, NULL), DP_OK);
    for (int i = 0; i < 2; i++) {
        double turned[16];
        figure_turn_matrix(turned, 40, 0.1);
        if (i) figure_place(&f, turned);
        t->gl->api.BindBuffer(GL_COPY_WRITE_BUFFER, names[0]);
        t->gl->api.BufferSubData(GL_COPY_WRITE_BUFFER, 0, sizeof f.positions, f.positions);
        assert_int_equal(dp_gl_draw(t->gl, &mesh, 1, &camera, &style, &target, NULL), DP_OK);
        assert_int_equal(dp_gl_read(t->gl, &target, rgba, 0, NULL), DP_OK);
        dp_source *const source = figure_source(&f);
        uint8_t *const cpu = gl_test_draw_cpu(source, &camera, &style, WIDTH, HEIGHT, 1);
        gl_test_keep(i ? "pencil-turned" : "pencil-buffers", rgba, WIDTH, HEIGHT);
        assert_true(gl_test_alike(rgba, cpu, WIDTH, HEIGHT, 2) > 0.98);
        free(cpu);
        dp_source_destroy(source);
    }
    dp_gl_mesh_destroy(mesh);
    t->gl->api.DeleteBuffers(2, names);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(equals_the_cpu),
                                       cmocka_unit_test(follows_buffers)};
    return cmocka_run_group_tests(tests, gl_test_setup, gl_test_teardown);
}
