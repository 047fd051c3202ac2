/* Shading and edge maps on graphics hardware, beside those of dp_draw: shares of pixels within two grey levels. */
#include "gl/context.h"

#include <drypoint/shapes.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <GL/glcorearb.h>

enum { WIDTH = 240, HEIGHT = 180, LEVELS = 2 };
/* Of the pixels that are not plain paper. */
static const double SHARE = 0.995;

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

static dp_camera look_at(dp_source *source, bool orthographic, double zoom) {
    dp_camera camera;
    const dp_fit fit = {
        .aspect = (double)WIDTH / HEIGHT, .orthographic = orthographic, .zoom = zoom};
    assert_int_equal(dp_camera_fit_source(&camera, &fit, source, NULL, NULL), DP_OK);
    return camera;
}

static bool is_alike(const uint8_t *a, const uint8_t *b, int levels) {
    bool same = true;
    for (int k = 0; k < 4; k++) same &= abs(a[k] - b[k]) <= levels;
    return same;
}

/* Share of pixels within LEVELS, of those that differ from the first pixel, which is paper, in one picture or both. */
static double share_of(const uint8_t *a, const uint8_t *b) {
    size_t alike = 0, count = 0;
    for (size_t i = 0; i < (size_t)WIDTH * HEIGHT; i++) {
        if (is_alike(a, a + 4 * i, 0) && is_alike(b, b + 4 * i, 0)) continue;
        alike += is_alike(a + 4 * i, b + 4 * i, LEVELS);
        count++;
    }
    assert_true(count > 0);
    return (double)alike / (double)count;
}

/* Keeps both pictures; fails if too many pixels differ. */
static void check(const char *name, const uint8_t *gpu, const uint8_t *cpu) {
    char file[120];
    const double share = share_of(gpu, cpu);
    snprintf(file, sizeof file, "shading-%s-gpu", name);
    gl_test_keep(file, gpu, WIDTH, HEIGHT);
    snprintf(file, sizeof file, "shading-%s-cpu", name);
    gl_test_keep(file, cpu, WIDTH, HEIGHT);
    printf("%-30s %.5f\n", name, share);
    assert_true(share >= SHARE);
}

/* Draws both pictures, and compares them. */
static void compare(gl_test *t, const char *name, dp_source *source, const dp_camera *camera,
                    const dp_style *style, uint32_t samples) {
    uint8_t *const gpu = gl_test_draw(t, source, camera, style, WIDTH, HEIGHT, samples),
                   *const cpu = gl_test_draw_cpu(source, camera, style, WIDTH, HEIGHT, samples);
    check(name, gpu, cpu);
    free(gpu), free(cpu);
}

static void compare_shapes(gl_test *t, const sample *samples, size_t count) {
    static const char *const shapes[] = {"torus", "bracket"};
    if (!t->gl) skip();
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++) {
        dp_source *const source = make_shape(shapes[s]);
        const dp_camera camera = look_at(source, false, 0);
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
        {"paper",
         {.shade = {.shading = DP_SHADING_PAPER},
          .paper = DP_RGB(240, 230, 200),
          .edge_map = {.detector = DP_EDGE_MAP_C1}}},
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

static void mirror(void **state) {
    static const sample samples[] = {
        {"mirror", {.mirror = {.fade = 0}}},
        {"mirror-lit",
         {.shade = {.shading = DP_SHADING_LAMBERT},
          .mirror = {.tint = DP_RGB(120, 160, 200), .tint_share = 0.3f}}},
        {"mirror-fade",
         {.shade = {.shading = DP_SHADING_GOOCH, .normals = DP_NORMALS_SMOOTH},
          .edge_map = {.detector = DP_EDGE_MAP_DIAGONAL},
          .mirror = {.fade = 1}}},
        {"mirror-flat-fade", {.mirror = {.fade = 1}}},
        {"mirror-toon",
         {.shade = {.shading = DP_SHADING_TOON, .normals = DP_NORMALS_FACET},
          .edge_map = {.detector = DP_EDGE_MAP_C1, .as_printed = true, .eight_bits = true}}},
    };
    gl_test *const t = *state;
    if (!t->gl) skip();
    for (int cuts = 0; cuts < 2; cuts++) {
        dp_source *const source = make_shape(cuts ? "bracket" : "torus");
        dp_extent extent;
        assert_int_equal(dp_source_extent(source, &extent, NULL), DP_OK);
        for (size_t i = 0; i < sizeof samples / sizeof *samples; i++) {
            dp_style style = samples[i].style;
            char name[80];
            const double size = (double)(extent.max[0] - extent.min[0]), low = extent.min[1];
            style.lines = DP_NO_LINES;
            style.surface = DP_RGB(200, 120, 60);
            style.mirror.normal[1] = 1;
            style.mirror.offset = cuts ? low + 0.2 * (extent.max[1] - low) : low - 0.05 * size;
            style.mirror.size = (float)(1.6 * size);
            for (int k = 0; k < 3; k++)
                style.mirror.center[k] = 0.5 * (double)(extent.min[k] + extent.max[k]);
            style.mirror.fade *= (float)size;
            const dp_camera camera = look_at(source, false, 0.6);
            snprintf(name, sizeof name, "%s-%s", cuts ? "cut" : "whole", samples[i].name);
            compare(t, name, source, &camera, &style, 4);
        }
        dp_source_destroy(source);
    }
}

/* A ball of quadrilaterals with all that corners may carry, in two groups, far from the world's origin. */
enum { AROUND = 24, DOWN = 12, VERTICES = (AROUND + 1) * (DOWN + 1), QUADS = AROUND * DOWN };
typedef struct ball {
    float positions[VERTICES][3], normals[VERTICES][3], texcoords[VERTICES][2];
    uint32_t colors[VERTICES], corners[4 * QUADS], firsts[QUADS + 1], triangles[6 * QUADS];
    uint16_t groups[QUADS];
    bool done, plain;
} ball;

static void put_vertex(ball *b, int v, int i, int k) {
    const double a = 6.283185307179586 * (i % AROUND) / AROUND, e = 3.141592653589793 * k / DOWN;
    const double ring = k % DOWN ? sin(e) : 0, n[3] = {ring * cos(a), cos(e), ring * sin(a)};
    for (int c = 0; c < 3; c++) {
        b->normals[v][c] = (float)(n[c] * 2); /* of any length */
        b->positions[v][c] = (float)(n[c] * (1 + 0.2 * sin(4 * a) * ring));
    }
    b->texcoords[v][0] = (float)i / AROUND * 3, b->texcoords[v][1] = (float)k / DOWN;
    b->colors[v] = i < AROUND / 2 ? DP_RGB(250 * i / AROUND, 90, 250 * k / DOWN) : 0;
}

static void make_ball(ball *b) {
    memset(b, 0, sizeof *b);
    for (int v = 0; v < VERTICES; v++) put_vertex(b, v, v % (AROUND + 1), v / (AROUND + 1));
    for (uint32_t q = 0; q < QUADS; q++) {
        const uint32_t v = q / AROUND * (AROUND + 1) + q % AROUND;
        const uint32_t at[4] = {v, v + 1, v + AROUND + 2, v + AROUND + 1};
        const uint32_t fan[6] = {at[0], at[1], at[2], at[0], at[2], at[3]};
        memcpy(b->corners + 4 * q, at, sizeof at);
        memcpy(b->triangles + 6 * q, fan, sizeof fan);
        b->firsts[q + 1] = 4 * (q + 1);
        b->groups[q] = q / AROUND > DOWN / 3;
    }
}

static dp_result next_ball(void *user, dp_batch *batch, dp_diag *diag) {
    ball *const b = user;
    (void)diag;
    if (b->done) return DP_OK;
    b->done = true;
    *batch = (dp_batch){.positions = b->positions[0],
                        .vertex_count = VERTICES,
                        .indices = b->corners,
                        .corner_count = 4 * QUADS,
                        .firsts = b->firsts,
                        .polygon_count = QUADS,
                        .groups = b->groups,
                        .normals = {.values = b->normals[0], .stride = 12, .count = VERTICES},
                        .texcoords = {.values = b->texcoords[0], .stride = 8, .count = VERTICES},
                        .colors = b->colors,
                        .origin = {1000, 500, -300}};
    if (b->plain) batch->normals = (dp_attribute){0};
    return DP_OK;
}

static dp_result rewind_ball(void *user, dp_diag *diag) {
    (void)diag;
    ((ball *)user)->done = false;
    return DP_OK;
}

static uint32_t color_of_ball(void *user, uint32_t group) {
    (void)user;
    return group ? DP_RGB(40, 160, 60) : DP_RGB(230, 200, 40);
}

static dp_source *ball_source(ball *b) {
    dp_source *source;
    const dp_source_callbacks callbacks = {
        .user = b, .next = next_ball, .rewind = rewind_ball, .group_color = color_of_ball};
    assert_int_equal(dp_source_from_callbacks(&callbacks, NULL, &source, NULL), DP_OK);
    return source;
}

/* Groups and vertices with colours, texture coordinates, an origin; both projections, one sample, near planes. */
static void attributes(void **state) {
    static const uint8_t enhanced[2] = {0, 1};
    static const sample samples[] = {
        {"colors", {.shade = {.model_colors = true}}},
        {"colors-lit",
         {.shade = {.shading = DP_SHADING_LAMBERT, .model_colors = true, .highlight = 0.5f}}},
        {"hatch-texcoords", {.shade = {.shading = DP_SHADING_HATCH, .object_space = true}}},
        {"groups",
         {.edge_map = {.detector = DP_EDGE_MAP_DIAGONAL,
                       .enhanced = enhanced,
                       .enhanced_count = 2}}},
        {"groups-printed",
         {.edge_map = {.detector = DP_EDGE_MAP_C1,
                       .as_printed = true,
                       .enhanced = enhanced,
                       .enhanced_count = 2}}},
        {"facet", {.shade = {.shading = DP_SHADING_TOON, .normals = DP_NORMALS_FACET}}},
    };
    gl_test *const t = *state;
    ball b;
    if (!t->gl) skip();
    make_ball(&b);
    dp_source *const source = ball_source(&b);
    for (size_t i = 0; i < sizeof samples / sizeof *samples; i++)
        for (int view = 0; view < 2; view++) {
            dp_style style = samples[i].style;
            char name[80];
            style.lines = DP_NO_LINES;
            style.surface = DP_RGB(200, 200, 200);
            const dp_camera camera = look_at(source, view == 1, 0);
            snprintf(name, sizeof name, "ball-%s-%d", samples[i].name, view);
            compare(t, name, source, &camera, &style, view == 1 ? 1 : 4);
        }
    b.plain = true;
    dp_style style = {
        .lines = DP_NO_LINES,
        .shade = {.shading = DP_SHADING_GOOCH, .model_colors = true, .crease_angle = 8}};
    dp_camera camera = look_at(source, false, 0);
    compare(t, "ball-computed", source, &camera, &style, 4);
    const double eye[3] = {1000.9, 500.5, -299.1}, to[3] = {1000, 500, -300}, up[3] = {0, 1, 0};
    assert_int_equal(dp_camera_perspective(&camera, 60, (double)WIDTH / HEIGHT, 0.1, 10), DP_OK);
    assert_int_equal(dp_camera_look_at(&camera, eye, to, up), DP_OK);
    style.shade.shading = DP_SHADING_HALFTONE, style.shade.object_space = true;
    compare(t, "ball-near", source, &camera, &style, 4);
    dp_source_destroy(source);
}

#define CALL(t, type, name) ((type)(uintptr_t)gl_context_proc((t)->context, name))

static uint32_t upload(gl_test *t, const void *data, size_t size) {
    GLuint name;
    CALL(t, PFNGLGENBUFFERSPROC, "glGenBuffers")(1, &name);
    CALL(t, PFNGLBINDBUFFERPROC, "glBindBuffer")(GL_ARRAY_BUFFER, name);
    CALL(t, PFNGLBUFFERDATAPROC, "glBufferData")
    (GL_ARRAY_BUFFER, (GLsizeiptr)size, data, GL_STATIC_DRAW);
    return name;
}

/* Draws meshes, and compares with what the CPU draws of a source. */
static void compare_meshes(gl_test *t, const char *name, dp_gl_mesh *const *meshes, size_t count,
                           dp_source *source, const dp_camera *camera, const dp_style *style) {
    const dp_gl_target target = gl_test_target(t, WIDTH, HEIGHT, 4);
    uint8_t *const gpu = malloc((size_t)4 * WIDTH * HEIGHT), *const cpu = gl_test_draw_cpu(
                                                                 source, camera, style, WIDTH,
                                                                 HEIGHT, 4);
    dp_diag diag = {0};
    if (dp_gl_draw(t->gl, meshes, count, camera, style, &target, &diag))
        fail_msg("%s", diag.message);
    assert_int_equal(dp_gl_read(t->gl, &target, gpu, 0, &diag), DP_OK);
    check(name, gpu, cpu);
    free(gpu), free(cpu);
}

/* The application's buffers: normals of vertices; without any, polygons have their own, and smooth ones are refused. */
static void buffers(void **state) {
    gl_test *const t = *state;
    ball b;
    dp_source *source;
    dp_gl_mesh *mesh, *bare;
    dp_diag diag = {0};
    if (!t->gl) skip();
    make_ball(&b);
    const dp_batch batch = {.positions = b.positions[0],
                            .vertex_count = VERTICES,
                            .indices = b.triangles,
                            .corner_count = 6 * QUADS,
                            .polygon_count = 2 * QUADS,
                            .normals = {.values = b.normals[0], .stride = 12, .count = VERTICES}};
    assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
    dp_gl_buffers from = {.positions = upload(t, b.positions, sizeof b.positions),
                          .vertex_count = VERTICES,
                          .indices = upload(t, b.triangles, sizeof b.triangles),
                          .triangle_count = 2 * QUADS,
                          .normals = upload(t, b.normals, sizeof b.normals)};
    const uint32_t names[3] = {from.positions, from.indices, from.normals};
    assert_int_equal(dp_gl_mesh_from_buffers(t->gl, &from, &mesh, &diag), DP_OK);
    from.normals = 0;
    assert_int_equal(dp_gl_mesh_from_buffers(t->gl, &from, &bare, &diag), DP_OK);
    dp_style style = {.lines = DP_NO_LINES,
                      .shade = {.shading = DP_SHADING_GOOCH},
                      .edge_map = {.detector = DP_EDGE_MAP_DIAGONAL}};
    const dp_camera camera = look_at(source, false, 0.7);
    compare_meshes(t, "buffers", &mesh, 1, source, &camera, &style);
    style.mirror = (dp_mirror){.normal = {0, 1, 0}, .offset = -0.6, .size = 4};
    compare_meshes(t, "buffers-mirror", &mesh, 1, source, &camera, &style);
    style.shade.normals = DP_NORMALS_FACET;
    compare_meshes(t, "buffers-facet", &bare, 1, source, &camera, &style);
    style.shade.normals = DP_NORMALS_MODEL;
    compare_meshes(t, "buffers-mirror", &mesh, 1, source, &camera, &style);
    style.shade.normals = DP_NORMALS_SMOOTH;
    const dp_gl_target target = gl_test_target(t, WIDTH, HEIGHT, 4);
    assert_int_equal(dp_gl_draw(t->gl, &bare, 1, &camera, &style, &target, &diag),
                     DP_ERR_UNSUPPORTED);
    dp_gl_mesh_destroy(mesh), dp_gl_mesh_destroy(bare);
    CALL(t, PFNGLDELETEBUFFERSPROC, "glDeleteBuffers")(3, names);
    dp_source_destroy(source);
}

static void turn_vertex(const double m[16], const float from[3], float to[3]) {
    for (int r = 0; r < 3; r++)
        to[r] = (float)(m[r] * (double)from[0] + m[4 + r] * (double)from[1] +
                        m[8 + r] * (double)from[2] + m[12 + r]);
}

/* Two meshes, one of them turned and smaller, as one source that is so. */
static void scenes(void **state) {
    static const double matrix[16] = {0, 0.5, 0, 0, -0.5, 0, 0, 0, 0, 0, 0.5, 0, 0.4, 0.3, 1.2, 1};
    gl_test *const t = *state;
    ball b, turned;
    dp_source *parts[2], *joined;
    dp_gl_mesh *meshes[2];
    dp_diag diag = {0};
    if (!t->gl) skip();
    make_ball(&b), make_ball(&turned);
    b.plain = turned.plain = true;
    for (int v = 0; v < VERTICES; v++) turn_vertex(matrix, b.positions[v], turned.positions[v]);
    parts[0] = ball_source(&b), parts[1] = ball_source(&turned);
    assert_int_equal(dp_gl_mesh_from_source(t->gl, parts[0], &meshes[0], &diag), DP_OK);
    assert_int_equal(dp_gl_mesh_from_source(t->gl, parts[0], &meshes[1], &diag), DP_OK);
    const double m[16] = {matrix[0],
                          matrix[1],
                          matrix[2],
                          0,
                          matrix[4],
                          matrix[5],
                          matrix[6],
                          0,
                          matrix[8],
                          matrix[9],
                          matrix[10],
                          0,
                          1000 + matrix[12] - matrix[0] * 1000 - matrix[4] * 500 - matrix[8] * -300,
                          500 + matrix[13] - matrix[1] * 1000 - matrix[5] * 500 - matrix[9] * -300,
                          -300 + matrix[14] - matrix[2] * 1000 - matrix[6] * 500 -
                              matrix[10] * -300,
                          1};
    assert_int_equal(dp_gl_mesh_place(meshes[1], m, &diag), DP_OK);
    assert_int_equal(dp_source_join(parts, NULL, 2, NULL, &joined, &diag), DP_OK);
    dp_style style = {
        .lines = DP_NO_LINES,
        .shade = {.shading = DP_SHADING_LAMBERT, .model_colors = true, .crease_angle = 60},
        .edge_map = {.detector = DP_EDGE_MAP_DIAGONAL}};
    const dp_camera camera = look_at(joined, false, 0.7);
    compare_meshes(t, "scene", meshes, 2, joined, &camera, &style);
    style.mirror =
        (dp_mirror){.normal = {0, 1, 0}, .offset = 499.4, .center = {1000, 0, -300}, .size = 4};
    compare_meshes(t, "scene-mirror", meshes, 2, joined, &camera, &style);
    compare_meshes(t, "scene-again", meshes, 2, joined, &camera, &style);
    dp_gl_mesh_destroy(meshes[0]), dp_gl_mesh_destroy(meshes[1]);
    dp_source_destroy(joined);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(shades),  cmocka_unit_test(edge_maps),
                                       cmocka_unit_test(mirror),  cmocka_unit_test(attributes),
                                       cmocka_unit_test(buffers), cmocka_unit_test(scenes)};
    return cmocka_run_group_tests(tests, gl_test_setup, gl_test_teardown);
}
