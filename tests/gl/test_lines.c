/* Lines by OpenGL are those of dp_draw: by class, polygons and length; of what comes back, and of what is wrong. */
#include "gl/agree.h"
#include "gl/context.h"

#include "gl/gl.h"

#include <drypoint/drawing.h>
#include <drypoint/shapes.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 300, HEIGHT = 200 };

static dp_source *shape(const char *name, uint64_t triangles) {
    dp_source *source;
    const dp_shape made = {.name = name, .triangles = triangles};
    assert_int_equal(dp_source_from_shape(&made, &source, NULL), DP_OK);
    return source;
}

static dp_camera camera_at(dp_source *source, bool orthographic) {
    dp_camera camera;
    const dp_fit fit = {.aspect = (double)WIDTH / HEIGHT,
                        .orthographic = orthographic,
                        .direction = {-0.8, 0.5, 0.7}};
    assert_int_equal(dp_camera_fit_source(&camera, &fit, source, NULL, NULL), DP_OK);
    return camera;
}

static void must(dp_result result, const dp_diag *diag) {
    if (result) fprintf(stderr, "%s\n", diag->message);
    assert_int_equal(result, DP_OK);
}

static void draw(gl_test *t, dp_gl_mesh **meshes, size_t count, const dp_camera *camera,
                 const dp_style *style, uint32_t samples) {
    const dp_gl_target target = gl_test_target(t, WIDTH, HEIGHT, samples);
    dp_diag diag = {0};
    must(dp_gl_draw(t->gl, meshes, count, camera, style, &target, &diag), &diag);
}

static const dp_segment *segments_of(gl_test *t, size_t *count) {
    const dp_segment *segments;
    dp_diag diag = {0};
    must(dp_gl_segments(t->gl, &segments, count, &diag), &diag);
    return segments;
}

static dp_context *draw_cpu(dp_source *source, const dp_camera *camera, const dp_style *style,
                            uint32_t samples) {
    const dp_target target = {.width = WIDTH, .height = HEIGHT, .samples = samples};
    dp_context *context;
    dp_diag diag = {0};
    must(dp_context_create(NULL, &context, &diag), &diag);
    must(dp_draw(context, source, camera, style, &target, &diag), &diag);
    return context;
}

static dp_gl_mesh *mesh_of(gl_test *t, dp_source *source) {
    dp_gl_mesh *mesh;
    dp_diag diag = {0};
    if (!t->gl) skip();
    must(dp_gl_mesh_from_source(t->gl, source, &mesh, &diag), &diag);
    return mesh;
}

/* Least share of the length that is alike in the last picture and on the CPU. */
static void agrees(gl_test *t, dp_source *source, const dp_camera *camera, const dp_style *style,
                   uint32_t samples, double least) {
    size_t count, cpu_count;
    dp_context *const context = draw_cpu(source, camera, style, samples);
    const dp_segment *const gpu = segments_of(t, &count), *const cpu =
                                                              dp_segments(context, &cpu_count);
    const agreement g = agree(cpu, cpu_count, gpu, count, DP_LINE_COUNT);
    assert_true(g.length[0] > 100);
    if (!(agree_share(&g) >= least)) agree_print(cpu, cpu_count, gpu, count, DP_LINE_COUNT, 8);
    assert_true(agree_share(&g) >= least);
    dp_context_destroy(context);
}

/* ------- the same lines ------- */

static void finds_the_lines_of_the_cpu(void **state) {
    static const struct {
        const char *name;
        uint64_t triangles;
    } shapes[] = {{"torus", 500}, {"bracket", 2000}, {"gear", 2000}, {"bolt", 2000}, {"stairs", 0}};
    gl_test *const t = *state;
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        dp_source *const source = shape(shapes[i].name, shapes[i].triangles);
        dp_gl_mesh *mesh = mesh_of(t, source);
        for (uint32_t k = 0; k < 3; k++) {
            const uint32_t samples = k == 1 ? 1 : 4;
            const dp_style style = {.ridge_angle = k ? 150 : 179, .valley_angle = k ? 210 : 190};
            const dp_camera camera = camera_at(source, k == 2);
            draw(t, &mesh, 1, &camera, &style, samples);
            agrees(t, source, &camera, &style, samples, 0.994);
        }
        dp_gl_mesh_destroy(mesh);
        dp_source_destroy(source);
    }
}

/* Where the near plane cuts the model, and the eye is within it. */
static void cuts_lines_at_the_near_plane(void **state) {
    gl_test *const t = *state;
    dp_source *const source = shape("stairs", 0);
    dp_gl_mesh *mesh = mesh_of(t, source);
    dp_camera camera;
    assert_int_equal(dp_camera_look_at(&camera, (double[]){1.2, 0.9, 1.1},
                                       (double[]){-0.3, -0.2, 0}, (double[]){0, 1, 0}),
                     DP_OK);
    assert_int_equal(dp_camera_perspective(&camera, 60, 1.5, 0.9, 20), DP_OK);
    draw(t, &mesh, 1, &camera, NULL, 4);
    agrees(t, source, &camera, NULL, 4, 0.97);
    dp_gl_mesh_destroy(mesh);
    dp_source_destroy(source);
}

static double total_length(const dp_segment *s, size_t count) {
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += hypot((double)s[i].b[0] - (double)s[i].a[0], (double)s[i].b[1] - (double)s[i].a[1]);
    return sum;
}

/* A batch of triangles that share their vertices, gathered from a shape, and the same without sharing. */
typedef struct gathered {
    float *positions, *soup;
    uint32_t *corners;
    size_t triangles;
} gathered;

static gathered gather(const char *name, uint64_t triangles) {
    dp_source *const source = shape(name, triangles);
    gathered g = {0};
    dp_batch batch;
    size_t room = 0;
    while (dp_source_next(source, &batch, NULL) == DP_OK && batch.polygon_count) {
        assert_null(batch.firsts);
        room = 3 * (g.triangles + batch.polygon_count);
        g.soup = realloc(g.soup, room * 3 * sizeof *g.soup);
        for (size_t i = 0; i < 3 * batch.polygon_count; i++)
            memcpy(g.soup + 3 * (3 * g.triangles + i),
                   batch.positions + 3 * (batch.indices ? batch.indices[i] : i),
                   3 * sizeof *g.soup);
        g.triangles += batch.polygon_count;
    }
    g.positions = malloc(room * 3 * sizeof *g.positions);
    g.corners = malloc(room * sizeof *g.corners);
    size_t vertices = 0;
    for (size_t i = 0; i < room; i++) {
        size_t v = 0;
        while (v < vertices && memcmp(g.positions + 3 * v, g.soup + 3 * i, 3 * sizeof *g.soup) != 0)
            v++;
        if (v == vertices) memcpy(g.positions + 3 * vertices++, g.soup + 3 * i, 12);
        g.corners[i] = (uint32_t)v;
    }
    dp_source_destroy(source);
    return g;
}

static dp_source *source_of(const float *positions, size_t vertices, const uint32_t *corners,
                            size_t triangles) {
    dp_source *source;
    dp_diag diag = {0};
    const dp_batch batch = {.positions = positions,
                            .vertex_count = vertices,
                            .indices = corners,
                            .corner_count = 3 * triangles,
                            .polygon_count = triangles};
    must(dp_source_from_arrays(&batch, NULL, &source, &diag), &diag);
    return source;
}

static void free_gathered(gathered *g) { free(g->positions), free(g->soup), free(g->corners); }

/* Vertices need not be shared. */
static void draws_soups_like_indexed_meshes(void **state) {
    gl_test *const t = *state;
    gathered g = gather("gear", 1000);
    double length[2];
    size_t count[2];
    for (int k = 0; k < 2; k++) {
        dp_source *const source =
            k ? source_of(g.soup, 3 * g.triangles, NULL, g.triangles)
              : source_of(g.positions, 3 * g.triangles, g.corners, g.triangles);
        dp_gl_mesh *mesh = mesh_of(t, source);
        const dp_camera camera = camera_at(source, false);
        draw(t, &mesh, 1, &camera, NULL, 1);
        const dp_segment *const s = segments_of(t, &count[k]);
        length[k] = total_length(s, count[k]);
        dp_gl_mesh_destroy(mesh);
        dp_source_destroy(source);
    }
    assert_int_equal(count[0], count[1]);
    assert_true(length[0] > 500 && fabs(length[0] - length[1]) < 1e-3);
    free_gathered(&g);
}

/* ------- what is kept, and what grows ------- */

static void keeps_mates_while_vertices_move(void **state) {
    gl_test *const t = *state;
    gathered g = gather("bracket", 1000);
    dp_source *const source = source_of(g.soup, 3 * g.triangles, NULL, g.triangles);
    dp_gl_mesh *mesh = mesh_of(t, source);
    const dp_camera camera = camera_at(source, false);
    dp_diag diag = {0};
    draw(t, &mesh, 1, &camera, NULL, 4);
    const uint64_t topology = t->gl->lines.topology;
    for (size_t i = 0; i < 3 * g.triangles; i++) {
        float *const p = g.soup + 3 * i;
        p[0] *= 1 + 0.3f * p[1], p[2] += 0.2f * p[1] * p[1];
    }
    must(dp_gl_mesh_update(mesh, source, &diag), &diag);
    draw(t, &mesh, 1, &camera, NULL, 4);
    agrees(t, source, &camera, NULL, 4, 0.99);
    assert_int_equal(t->gl->lines.topology, topology);
    dp_gl_mesh_destroy(mesh);
    dp_source_destroy(source);
    free_gathered(&g);
}

/* Lists that are too short are made longer; what is found does not depend on how long they were. */
static void grows_full_lists(void **state) {
    gl_test *const t = *state;
    dp_source *const source = shape("terrain", 60000);
    dp_gl_mesh *mesh = mesh_of(t, source);
    const dp_camera camera = camera_at(source, false);
    const dp_style style = {
        .lines = DP_SILHOUETTE | DP_RIDGE | DP_VALLEY, .ridge_angle = 180, .valley_angle = 180.5f};
    dp_gl_stats stats[2];
    size_t count[2];
    for (int k = 0; k < 2; k++) {
        draw(t, &mesh, 1, &camera, &style, 1);
        assert_int_equal(dp_gl_stats_of(t->gl, &stats[k], NULL), DP_OK);
        segments_of(t, &count[k]);
    }
    assert_true(stats[0].candidates > 1 << 14 && stats[0].regrown > 0);
    assert_int_equal(stats[1].regrown, 0);
    assert_int_equal(stats[0].segments, stats[1].segments);
    assert_int_equal(count[0], count[1]);
    dp_gl_mesh_destroy(mesh);
    dp_source_destroy(source);
}

static void tells_when_memory_is_too_small(void **state) {
    gl_test *const t = *state;
    dp_gl *gl;
    dp_gl_mesh *mesh;
    dp_diag diag = {0};
    const dp_gl_target target = gl_test_target(t, WIDTH, HEIGHT, 1);
    dp_source *const source = shape("torus", 20000);
    const dp_camera camera = camera_at(source, false);
    const dp_gl_desc desc = {
        .get_proc_address = gl_context_proc, .user = t->context, .memory = 700 << 10};
    must(dp_gl_create(&desc, &gl, &diag), &diag);
    must(dp_gl_mesh_from_source(gl, source, &mesh, &diag), &diag);
    assert_int_equal(dp_gl_draw(gl, &mesh, 1, &camera, NULL, &target, &diag), DP_ERR_LIMIT);
    assert_non_null(strstr(diag.message, "MB are allowed"));
    dp_gl_mesh_destroy(mesh);
    dp_gl_destroy(gl);
    dp_source_destroy(source);
}

/* ------- bad input ------- */

/* Triangles with indices out of range, corners that are equal, and coordinates that are not numbers draw nothing, and the
 * rest its lines. */
static void survives_absurd_meshes(void **state) {
    gl_test *const t = *state;
    gathered g = gather("cube", 0);
    const size_t n = g.triangles;
    g.soup = realloc(g.soup, 9 * (n + 4) * sizeof *g.soup);
    for (size_t i = 0; i < 36; i++) g.soup[9 * n + i] = i % 4 ? NAN : 1e38f;
    uint32_t *const corners = malloc((3 * n + 12) * sizeof *corners);
    for (uint32_t i = 0; i < 3 * n; i++) corners[i] = i;
    const uint32_t absurd[12] = {
        (uint32_t)(3 * n),    (uint32_t)(3 * n + 1), 0, UINT32_MAX, 1, 2, 5, 5, 5, 0x80000000u, 0,
        (uint32_t)(3 * n + 2)};
    memcpy(corners + 3 * n, absurd, sizeof absurd);
    dp_source *const plain = source_of(g.soup, 3 * n, NULL, n), *const source =
                                                                    source_of(g.soup, 3 * n + 12,
                                                                              corners, n + 4);
    const dp_camera camera = camera_at(plain, false);
    dp_gl_mesh *mesh = mesh_of(t, source);
    draw(t, &mesh, 1, &camera, NULL, 4);
    agrees(t, plain, &camera, NULL, 4, 0.999);
    dp_gl_mesh_destroy(mesh);
    dp_source_destroy(source);
    dp_source_destroy(plain);
    free(corners);
    free_gathered(&g);
}

/* ------- what comes back ------- */

static int in_order(const dp_segment *a, const dp_segment *b) {
    if (a->polygon != b->polygon) return a->polygon < b->polygon;
    return a->edge <= b->edge;
}

/* Several meshes are as one scene of them. */
static void numbers_polygons_of_several_meshes(void **state) {
    gl_test *const t = *state;
    dp_source *parts[2] = {shape("bracket", 500), shape("torus", 300)}, *scene;
    dp_gl_mesh *meshes[2] = {mesh_of(t, parts[0]), mesh_of(t, parts[1])};
    dp_diag diag = {0};
    must(dp_source_join(parts, NULL, 2, NULL, &scene, &diag), &diag);
    const dp_camera camera = camera_at(scene, false);
    const dp_style style = {.lines = DP_ALL_LINES & ~DP_INTERSECTION};
    size_t count;
    draw(t, meshes, 2, &camera, &style, 4);
    agrees(t, scene, &camera, &style, 4, 0.98);
    const dp_segment *const s = segments_of(t, &count);
    for (size_t i = 1; i < count; i++) assert_true(in_order(&s[i - 1], &s[i]));
    for (int k = 0; k < 2; k++) dp_gl_mesh_destroy(meshes[k]);
    dp_source_destroy(scene);
}

/* A drawing as SVG, malloc'd. */
static char *svg_of(dp_context *context) {
    dp_drawing *drawing;
    dp_diag diag = {0};
    void *bytes;
    size_t size;
    must(dp_drawing_create(context, NULL, &drawing, &diag), &diag);
    const dp_view_on_page view = {.drawing = drawing};
    const dp_page page = {.views = &view, .view_count = 1};
    must(dp_page_write_memory(&page, DP_FORMAT_SVG, &bytes, &size, &diag), &diag);
    char *const text = malloc(size + 1);
    memcpy(text, bytes, size);
    text[size] = 0;
    dp_bytes_free(bytes);
    dp_drawing_destroy(drawing);
    return text;
}

static size_t count_of(const char *text, const char *what) {
    size_t n = 0;
    for (const char *at = text; (at = strstr(at, what)) != NULL; at++) n++;
    return n;
}

/* Sinks and pages take the device's lines as the CPU's. */
static void hands_its_lines_over(void **state) {
    gl_test *const t = *state;
    dp_source *const source = shape("bracket", 2000);
    dp_gl_mesh *mesh = mesh_of(t, source);
    const dp_camera camera = camera_at(source, false);
    dp_context *const cpu = draw_cpu(source, &camera, NULL, 4);
    dp_context *handed;
    dp_diag diag = {0};
    size_t count, handed_count;
    draw(t, &mesh, 1, &camera, NULL, 4);
    must(dp_context_create(NULL, &handed, &diag), &diag);
    must(dp_gl_hand_over(t->gl, handed, &diag), &diag);
    const dp_segment *const a = dp_segments(cpu, &count), *const b =
                                                              dp_segments(handed, &handed_count);
    const agreement g = agree(a, count, b, handed_count, DP_LINE_COUNT);
    assert_true(agree_share(&g) > 0.997);
    char *const one = svg_of(cpu), *const other = svg_of(handed);
    assert_int_equal(count_of(one, "<path"), count_of(other, "<path"));
    assert_true(labs((long)strlen(one) - (long)strlen(other)) < 60);
    free(one), free(other);
    dp_context_destroy(handed);
    dp_context_destroy(cpu);
    dp_gl_mesh_destroy(mesh);
    assert_int_equal(dp_gl_segments(t->gl, &(const dp_segment *){NULL}, &count, &diag),
                     DP_ERR_ARGUMENT); /* whose mesh is gone */
    dp_source_destroy(source);
}

/* Ends tell why a line stops; all that a segment tells is as on the CPU. */
static void tells_what_ends_lines(void **state) {
    gl_test *const t = *state;
    dp_source *const source = shape("stairs", 0);
    dp_gl_mesh *mesh = mesh_of(t, source);
    dp_camera camera = camera_at(source, false);
    camera.projection[0] *= 1.6, camera.projection[5] *= 1.6; /* some lines leave the picture */
    dp_context *const context = draw_cpu(source, &camera, NULL, 4);
    size_t count, cpu_count, left = 0;
    draw(t, &mesh, 1, &camera, NULL, 4);
    const dp_segment *const s = segments_of(t, &count), *const cpu =
                                                            dp_segments(context, &cpu_count);
    assert_int_equal(count, cpu_count);
    for (size_t i = 0; i < count; i++) {
        assert_int_equal(s[i].line, cpu[i].line);
        assert_int_equal(s[i].edge, cpu[i].edge);
        assert_int_equal(s[i].chain, cpu[i].chain);
        for (int k = 0; k < 2; k++) assert_int_equal(s[i].end[k], cpu[i].end[k]);
        for (int c = 0; c < 3; c++) {
            assert_true(fabs((double)s[i].a[c] - (double)cpu[i].a[c]) < 1e-3);
            assert_true(fabs(s[i].world_b[c] - cpu[i].world_b[c]) < 1e-4);
        }
        left += s[i].end[0] == DP_END_PICTURE || s[i].end[1] == DP_END_PICTURE;
    }
    assert_true(left > 0);
    dp_context_destroy(context);
    dp_gl_mesh_destroy(mesh);
    dp_source_destroy(source);
}

/* Lines that go on behind something know what that is, as nearly all do on the CPU. */
static void tells_what_hides_lines(void **state) {
    gl_test *const t = *state;
    dp_source *const source = shape("gear", 2000);
    dp_gl_mesh *mesh = mesh_of(t, source);
    const dp_camera camera = camera_at(source, false);
    size_t count, ends = 0, known = 0;
    draw(t, &mesh, 1, &camera, NULL, 4);
    const dp_segment *const s = segments_of(t, &count);
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 2; k++) {
            ends += s[i].end[k] == DP_END_HIDDEN;
            known += s[i].end[k] == DP_END_HIDDEN && s[i].hider[k] != UINT64_MAX;
        }
    assert_true(ends > 50 && known * 100 >= ends * 95);
    dp_gl_mesh_destroy(mesh);
    dp_source_destroy(source);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(finds_the_lines_of_the_cpu),
                                       cmocka_unit_test(cuts_lines_at_the_near_plane),
                                       cmocka_unit_test(draws_soups_like_indexed_meshes),
                                       cmocka_unit_test(keeps_mates_while_vertices_move),
                                       cmocka_unit_test(grows_full_lists),
                                       cmocka_unit_test(tells_when_memory_is_too_small),
                                       cmocka_unit_test(survives_absurd_meshes),
                                       cmocka_unit_test(numbers_polygons_of_several_meshes),
                                       cmocka_unit_test(hands_its_lines_over),
                                       cmocka_unit_test(tells_what_ends_lines),
                                       cmocka_unit_test(tells_what_hides_lines)};
    return cmocka_run_group_tests(tests, gl_test_setup, gl_test_teardown);
}
