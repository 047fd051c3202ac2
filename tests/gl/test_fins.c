/* Silhouettes by adjacency on graphics hardware: by a geometry shader in one pass and in two, and by pulling, which all draw
 * one picture; and beside the CPU's, plain and textured. */
#include "gl/context.h"
#include "gl/figure.h"

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

static void tell(gl_test *t, scene *s, const look *k, const uint8_t *cpu) {
    if (!getenv("DP_TEST_PICTURES")) return;
    for (int i = 0; i < (k->texture ? 3 : 1); i++) {
        t->gl->lookups = i;
        uint8_t *const rgba = draw(t, s, k, 1, false);
        printf("%-12s lookups %d: within 2 levels %.5f, within 16 %.5f\n", k->name, i,
               gl_test_alike(rgba, cpu, WIDTH, HEIGHT, 2),
               gl_test_alike(rgba, cpu, WIDTH, HEIGHT, 16));
        free(rgba);
    }
    t->gl->lookups = DP_GL_LOOKUPS_UNIT;
}

/* In all ways, and by the CPU. */
static void compare_scene(gl_test *t, const look *k, scene *s) {
    uint8_t *const once = draw(t, s, k, 1, false), *const twice = draw(t, s, k, 2, false),
                   *const pulled = draw(t, s, k, 2, true),
                   *const pulled_once = draw(t, s, k, 1, true);
    uint8_t *const cpu =
        gl_test_draw_cpu(s->source, &s->camera, &s->style, WIDTH, HEIGHT, k->samples);
    keep(k, "once", once), keep(k, "pulled", pulled), keep(k, "cpu", cpu);
    tell(t, s, k, cpu);
    const double share = gl_test_alike(once, cpu, WIDTH, HEIGHT, 2);
    /* interpolated coordinates of a texture may be rounded otherwise, and so may what is clipped: a pixel in 40 000 */
    const int levels = k->texture ? 1 : 0;
    const bool same = !memcmp(once, twice, 4 * WIDTH * HEIGHT) &&
                      !memcmp(pulled, pulled_once, 4 * WIDTH * HEIGHT) &&
                      gl_test_alike(once, pulled, WIDTH, HEIGHT, levels) > 0.9999;
    free(once), free(twice), free(pulled), free(pulled_once), free(cpu);
    if (!same) fail_msg("%s: passes and ways of drawing differ", k->name);
    if (share < k->least) fail_msg("%s: %.4f of the pixels are alike", k->name, share);
}

static void compare(gl_test *t, const look *k) {
    scene s;
    if (!t->gl) skip();
    open_scene(k, &s);
    compare_scene(t, k, &s);
    close_scene(&s);
}

static void equals_the_cpu(void **state) {
    static const look looks[] = {
        {"torus-2", "torus", NULL, 2, 4, false, 0.99},
        {"torus-12", "torus", NULL, 12, 4, false, 0.99},
        {"bracket-8", "bracket", NULL, 8, 4, true, 0.99},
        {"sheet-8", "terrain", NULL, 8, 4, false, 0.99},
    };
    for (size_t i = 0; i < sizeof looks / sizeof *looks; i++) compare(*state, &looks[i]);
}

static void is_textured(void **state) {
    static const look looks[] = {
        {"charcoal", "torus", "charcoal", 10, 4, false, 0.97},
        {"dashes", "bracket", "dashes", 8, 4, false, 0.97},
        {"rope", "terrain", "rope", 12, 4, false, 0.97},
    };
    for (size_t i = 0; i < sizeof looks / sizeof *looks; i++) compare(*state, &looks[i]);
}

/* ------- odd meshes ------- */

/* Draws a mesh in all ways, and compares. */
static void compare_mesh(gl_test *t, const char *name, const dp_batch *batch, dp_camera camera,
                         dp_style style, double least) {
    const look k = {.name = name, .samples = 4, .least = least, .shape = "torus", .width = 6};
    scene s;
    if (!t->gl) skip();
    open_scene(&k, &s);
    dp_source_destroy(s.source);
    style.edges = s.style.edges, style.ink = s.style.ink, style.method = s.style.method;
    memcpy(style.line, s.style.line, sizeof style.line);
    style.lines = s.style.lines;
    s.style = style, s.camera = camera;
    assert_int_equal(dp_source_from_arrays(batch, NULL, &s.source, NULL), DP_OK);
    compare_scene(t, &k, &s);
    close_scene(&s);
}

static dp_batch triangles_of(const float (*positions)[3], size_t vertices,
                             const uint32_t (*indices)[3], size_t count) {
    return (dp_batch){.positions = positions[0],
                      .vertex_count = vertices,
                      .indices = indices[0],
                      .corner_count = 3 * count,
                      .polygon_count = count};
}

/* Three sheets at one edge, of which one is wound the other way; and a tetrahedron with one face turned round. */
static void knows_fans_and_turned_faces(void **state) {
    static const float positions[][3] = {{0, 0, 0},        {0, 1.6f, 0},     {1, 0.3f, 0.4f},
                                         {-1, 0.5f, 0.2f}, {0.3f, 0.7f, 1},  {1.2f, 0, -1},
                                         {2, 0, -1},       {1.6f, 1, -0.6f}, {1.6f, 0.2f, 0.5f}};
    static const uint32_t indices[][3] = {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}, {5, 6, 7},
                                          {5, 8, 6}, {6, 8, 7}, {5, 8, 7}};
    const dp_batch batch = triangles_of(positions, 9, indices, 7);
    compare_mesh(*state, "fans", &batch, figure_camera(false, 20), (dp_style){0}, 0.995);
    compare_mesh(*state, "fans-flat", &batch, figure_camera(true, 20), (dp_style){0}, 0.995);
}

/* Corners of polygons of four have one share of the vertex normal, not one a triangle. */
static void knows_polygons(void **state) {
    figure f;
    uint32_t corners[FIGURE_VERTICES][4], firsts[FIGURE_VERTICES + 1];
    figure_make(&f, 0);
    for (uint32_t i = 0; i < FIGURE_VERTICES; i++) {
        memcpy(corners[i], f.indices[2 * i], sizeof f.indices[0]);
        corners[i][3] = f.indices[2 * i + 1][2], firsts[i] = 4 * i;
    }
    firsts[FIGURE_VERTICES] = 4 * FIGURE_VERTICES;
    const dp_batch batch = {.positions = f.positions[0],
                            .vertex_count = FIGURE_VERTICES,
                            .indices = corners[0],
                            .corner_count = sizeof corners / 4,
                            .firsts = firsts,
                            .polygon_count = FIGURE_VERTICES};
    compare_mesh(*state, "polygons", &batch, figure_camera(false, 20), (dp_style){0}, 0.99);
}

/* The eye is close, so that the near plane and the guarded frustum cut edges. */
static void clips_edges(void **state) {
    figure f;
    dp_camera camera;
    static const double eye[3] = {1.0, 0.05, 0.45}, at[3] = {-1, 0.3, 0.1}, up[3] = {0, 0, 1};
    figure_make(&f, 0);
    const dp_batch batch = triangles_of((const float(*)[3])f.positions, FIGURE_VERTICES,
                                        (const uint32_t(*)[3])f.indices, FIGURE_TRIANGLES);
    assert_int_equal(dp_camera_look_at(&camera, eye, at, up), DP_OK);
    assert_int_equal(dp_camera_perspective(&camera, 70, 4.0 / 3, 0.2, 2.5), DP_OK);
    compare_mesh(*state, "clipped", &batch, camera, (dp_style){0}, 0.99);
    compare_mesh(*state, "culled", &batch, figure_camera(false, 20),
                 (dp_style){.cull_back_faces = true}, 0.99);
}

/* What ink half hides is shaded, with edges, in one pass as in two. */
static void lies_over_shading(void **state) {
    figure f;
    figure_make(&f, 0);
    const dp_batch batch = triangles_of((const float(*)[3])f.positions, FIGURE_VERTICES,
                                        (const uint32_t(*)[3])f.indices, FIGURE_TRIANGLES);
    const dp_style style = {.shade.shading = DP_SHADING_LAMBERT,
                            .edge_map.detector = DP_EDGE_MAP_DIAGONAL};
    compare_mesh(*state, "shaded", &batch, figure_camera(false, 20), style, 0.99);
}

/* Other classes are strokes, which lie over outlines. The CPU smooths them a little along their chains. */
static void lies_over_creases(void **state) {
    gl_test *const t = *state;
    const look k = {"creases", "bracket", NULL, 8, 4, false, 0.97};
    scene s;
    if (!t->gl) skip();
    open_scene(&k, &s);
    s.style.lines = DP_ALL_LINES;
    s.style.line[DP_LINE_RIDGE] = (dp_line_style){4, 0xd08020ff};
    compare_scene(t, &k, &s);
    close_scene(&s);
}

/* A texture with colours of its own. */
static void brings_colours(void **state) {
    gl_test *const t = *state;
    const look k = {"coloured", "torus", "ink", 10, 4, true, 0.97};
    uint8_t pixels[8][24][4];
    scene s;
    if (!t->gl) skip();
    for (int y = 0; y < 8; y++)
        for (int x = 0; x < 24; x++) {
            const uint8_t p[4] = {(uint8_t)(10 * x), (uint8_t)(30 * y), (uint8_t)(255 - 10 * x),
                                  (uint8_t)(x % 8 < 2 ? 20 : 255 - 20 * y)};
            memcpy(pixels[y][x], p, 4);
        }
    open_scene(&k, &s);
    dp_texture_destroy(s.texture);
    const dp_texture_desc desc = {.pixels = pixels[0][0], .width = 24, .height = 8, .channels = 4};
    assert_int_equal(dp_texture_create(&desc, &s.texture, NULL), DP_OK);
    s.style.stroke.texture = s.texture;
    compare_scene(t, &k, &s);
    close_scene(&s);
}

/* The mirror shows silhouettes of the reflected scene. */
static void is_mirrored(void **state) {
    gl_test *const t = *state;
    const look k = {"mirrored", "torus", NULL, 5, 4, false, 0.97};
    scene s;
    if (!t->gl) skip();
    open_scene(&k, &s);
    s.style.mirror = (dp_mirror){.normal = {0, 1, 0},
                                 .offset = -0.6,
                                 .size = 4,
                                 .tint = DP_RGB(200, 210, 220),
                                 .tint_share = 0.3f};
    compare_scene(t, &k, &s);
    close_scene(&s);
}

/* Strokes by adjacency are those that the table of edges finds, whose mates are an adjacency. */
static void strokes_by_adjacency(void **state) {
    gl_test *const t = *state;
    static const look looks[] = {{"strokes", "bracket", NULL, 3, 4, false, 0.995},
                                 {"strokes-open", "terrain", NULL, 3, 4, false, 0.99}};
    if (!t->gl) skip();
    for (size_t i = 0; i < 2; i++) {
        const look *const k = &looks[i];
        scene s;
        open_scene(k, &s);
        s.style.ink = DP_INK_STROKES, s.style.lines = DP_ALL_LINES;
        uint8_t *const gpu = gl_test_draw(t, s.source, &s.camera, &s.style, WIDTH, HEIGHT, 4);
        uint8_t *const cpu = gl_test_draw_cpu(s.source, &s.camera, &s.style, WIDTH, HEIGHT, 4);
        const double share = gl_test_alike(gpu, cpu, WIDTH, HEIGHT, 2);
        keep(k, "once", gpu), keep(k, "cpu", cpu);
        free(gpu), free(cpu);
        close_scene(&s);
        if (share < k->least) fail_msg("%s: %.4f of the pixels are alike", k->name, share);
    }
}

/* Added triangles are no segments, and those of the picture before are gone. */
static void has_no_segments(void **state) {
    gl_test *const t = *state;
    const look k = {"none", "torus", NULL, 3, 4, false, 0};
    const dp_segment *segments;
    size_t count[2];
    scene s;
    if (!t->gl) skip();
    open_scene(&k, &s);
    const dp_gl_target target = gl_test_target(t, WIDTH, HEIGHT, 4);
    dp_gl_mesh *mesh;
    assert_int_equal(dp_gl_mesh_from_source(t->gl, s.source, &mesh, NULL), DP_OK);
    for (int i = 0; i < 2; i++) {
        s.style.ink = i ? DP_INK_QUADS : DP_INK_STROKES;
        assert_int_equal(dp_gl_draw(t->gl, &mesh, 1, &s.camera, &s.style, &target, NULL), DP_OK);
        assert_int_equal(dp_gl_segments(t->gl, &segments, &count[i], NULL), DP_OK);
    }
    assert_true(count[0] > 10 && count[1] == 0);
    dp_gl_mesh_destroy(mesh);
    close_scene(&s);
}

/* What is not drawn is named. */
static void refuses_the_rest(void **state) {
    gl_test *const t = *state;
    const look k = {"refused", "torus", "charcoal", 10, 4, false, 0};
    const struct {
        dp_ink ink;
        dp_method method;
        uint32_t lines;
        const char *why;
    } cases[] = {{DP_INK_QUADS, DP_METHOD_EXACT, DP_SILHOUETTE, "visible chains"},
                 {DP_INK_QUADS, DP_METHOD_PAPER, DP_ALL_LINES, "stylized strokes"},
                 {DP_INK_STROKES, DP_METHOD_PAPER, DP_SILHOUETTE, "stylized strokes"}};
    scene s;
    dp_gl_mesh *mesh;
    dp_diag diag;
    if (!t->gl) skip();
    open_scene(&k, &s);
    const dp_gl_target target = gl_test_target(t, WIDTH, HEIGHT, 4);
    assert_int_equal(dp_gl_mesh_from_source(t->gl, s.source, &mesh, &diag), DP_OK);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        s.style.ink = cases[i].ink, s.style.method = cases[i].method;
        s.style.lines = cases[i].lines;
        assert_int_equal(dp_gl_draw(t->gl, &mesh, 1, &s.camera, &s.style, &target, &diag),
                         DP_ERR_UNSUPPORTED);
        assert_non_null(strstr(diag.message, cases[i].why));
    }
    dp_gl_mesh_destroy(mesh);
    close_scene(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(equals_the_cpu),
                                       cmocka_unit_test(is_textured),
                                       cmocka_unit_test(knows_fans_and_turned_faces),
                                       cmocka_unit_test(knows_polygons),
                                       cmocka_unit_test(clips_edges),
                                       cmocka_unit_test(lies_over_shading),
                                       cmocka_unit_test(lies_over_creases),
                                       cmocka_unit_test(brings_colours),
                                       cmocka_unit_test(is_mirrored),
                                       cmocka_unit_test(strokes_by_adjacency),
                                       cmocka_unit_test(has_no_segments),
                                       cmocka_unit_test(refuses_the_rest)};
    return cmocka_run_group_tests(tests, gl_test_setup, gl_test_teardown);
}
