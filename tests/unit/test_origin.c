/* Models far from 0: positions about an origin draw what the same model draws at 0, wherever they
 * come from, and what is in world space stays there.
 *
 * Above 600 lines: every source and reader is asked the same of the same models. */
#include "scene.h"
#include "temporary.h"

#include "draw/context.h"
#include "mesh/source.h"
#include "mesh/wide.h"

#include <drypoint/io.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

/* Survey coordinates: neighbouring float32 values are half a unit apart there. */
static const double away[3] = {692345.12, 5334567.34, 512.5};

static dp_context *context;
static scene house;
static picture shown, expected;

/* ------- the model ------- */

/* Walls, a roof that overlaps them, a chimney: of sizes that no float32 holds far from 0. */
static void make_house(void) {
    static const float roof[5][4][3] = {
        {{-34.3f, 8.1f, 22.2f}, {34.3f, 8.1f, 22.2f}, {34.3f, 27.7f, 0}, {-34.3f, 27.7f, 0}},
        {{34.3f, 8.1f, -22.2f}, {-34.3f, 8.1f, -22.2f}, {-34.3f, 27.7f, 0}, {34.3f, 27.7f, 0}},
        {{-34.3f, 8.1f, -22.2f}, {-34.3f, 8.1f, 22.2f}, {-34.3f, 27.7f, 0}, {-34.3f, 27.7f, 0}},
        {{34.3f, 8.1f, 22.2f}, {34.3f, 8.1f, -22.2f}, {34.3f, 27.7f, 0}, {34.3f, 27.7f, 0}},
        {{-34.3f, 8.1f, -22.2f},
         {34.3f, 8.1f, -22.2f},
         {34.3f, 8.1f, 22.2f},
         {-34.3f, 8.1f, 22.2f}},
    };
    memset(&house, 0, sizeof house);
    scene_box(&house, (const float[3]){-30.7f, -25.3f, -20.9f},
              (const float[3]){30.7f, 8.1f, 20.9f});
    for (int i = 0; i < 5; i++) scene_polygon(&house, i == 2 || i == 3 ? 3 : 4, roof[i]);
    scene_box(&house, (const float[3]){11.1f, 4.4f, -3.3f}, (const float[3]){18.8f, 39.9f, 3.3f});
}

static dp_camera camera_at(const double at[3]) {
    return scene_camera(at[0] + 70, at[1] + 45, at[2] + 95, at[0], at[1] + 3, at[2]);
}

/* ------- drawing ------- */

static void draw(dp_source *source, const dp_camera *camera, const dp_style *style, picture *p) {
    const dp_target target = {.width = SCENE_WIDTH,
                              .height = SCENE_HEIGHT,
                              .rgba = p->rgba,
                              .line_class = p->line_class,
                              .depth = p->depth};
    dp_diag diag = {0};
    dp_stats stats;
    if (dp_draw(context, source, camera, style, &target, &diag)) fail_msg("%s", diag.message);
    dp_stats_of(context, &stats);
    assert_int_equal(stats.dropped, 0);
}

static int different(void) {
    int count = 0;
    for (size_t i = 0; i < sizeof shown.rgba; i += 4) {
        int most = 0;
        for (size_t k = i; k < i + 4; k++) {
            const int step = abs((int)shown.rgba[k] - (int)expected.rgba[k]);
            most = step > most ? step : most;
        }
        count += most > 64;
    }
    return count;
}

static void expect_same(const char *what) {
    if (different()) fail_msg("%s: %d pixels differ", what, different());
    assert_true(scene_ink(&shown, -100, -60, 100, 60) > 300);
}

/* The house at 0, from its arrays. */
static void draw_expected(const dp_style *style) {
    const dp_batch batch = scene_batch(&house);
    const dp_camera camera = camera_at((const double[3]){0, 0, 0});
    dp_source *source;
    assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
    draw(source, &camera, style, &expected);
    dp_source_destroy(source);
}

/* ------- files ------- */

static char file[200000];
static size_t file_size;

static void put(const char *format, ...) __attribute__((format(printf, 1, 2)));
static void put(const char *format, ...) {
    va_list arguments;
    va_start(arguments, format);
    file_size += (size_t)vsnprintf(file + file_size, sizeof file - file_size, format, arguments);
    va_end(arguments);
    assert_true(file_size < sizeof file);
}

static void put_bytes(const void *bytes, size_t size, bool big) {
    assert_true(file_size + size < sizeof file);
    for (size_t i = 0; i < size; i++)
        file[file_size++] = ((const char *)bytes)[big ? size - 1 - i : i];
}

static void put_corner(const char *before, const float p[3], const double at[3]) {
    put("%s%.9f %.9f %.9f\n", before, (double)p[0] + at[0], (double)p[1] + at[1],
        (double)p[2] + at[2]);
}

static void write_obj(const double at[3]) {
    for (size_t c = 0; c < house.corners; c++) put_corner("v ", house.positions[c], at);
    for (size_t i = 0; i < house.polygons; i++) {
        put("f");
        for (uint32_t c = house.firsts[i]; c < house.firsts[i + 1]; c++) put(" %u", c + 1);
        put("\n");
    }
}

static void put_faces(void) {
    for (size_t i = 0; i < house.polygons; i++) {
        put("%u", house.firsts[i + 1] - house.firsts[i]);
        for (uint32_t c = house.firsts[i]; c < house.firsts[i + 1]; c++) put(" %u", c);
        put("\n");
    }
}

static void write_off(const double at[3]) {
    put("OFF\n%zu %zu 0\n", house.corners, house.polygons);
    for (size_t c = 0; c < house.corners; c++) put_corner("", house.positions[c], at);
    put_faces();
}

static void ply_header(const char *format, const char *type) {
    put("ply\nformat %s 1.0\nelement vertex %zu\nproperty %s x\nproperty %s y\nproperty %s z\n"
        "element face %zu\nproperty list uchar int vertex_indices\nend_header\n",
        format, house.corners, type, type, type, house.polygons);
}

static void write_ascii_ply(const double at[3]) {
    ply_header("ascii", "float");
    for (size_t c = 0; c < house.corners; c++) put_corner("", house.positions[c], at);
    put_faces();
}

static void write_binary_ply(const double at[3], bool big, bool wide) {
    ply_header(big ? "binary_big_endian" : "binary_little_endian", wide ? "double" : "float");
    for (size_t c = 0; c < house.corners; c++)
        for (int k = 0; k < 3; k++) {
            const double value = (double)house.positions[c][k] + at[k];
            const float single = (float)value;
            put_bytes(wide ? (const void *)&value : &single, wide ? sizeof value : sizeof single,
                      big);
        }
    for (size_t i = 0; i < house.polygons; i++) {
        const uint8_t corners = (uint8_t)(house.firsts[i + 1] - house.firsts[i]);
        put_bytes(&corners, 1, big);
        for (uint32_t c = house.firsts[i]; c < house.firsts[i + 1]; c++)
            put_bytes(&c, sizeof c, big);
    }
}

static void write_little_ply(const double at[3]) { write_binary_ply(at, false, true); }
static void write_big_ply(const double at[3]) { write_binary_ply(at, true, true); }
static void write_single_ply(const double at[3]) { write_binary_ply(at, false, false); }

static void write_stl(const double at[3]) {
    put("solid house\n");
    for (size_t i = 0; i < house.polygons; i++)
        for (uint32_t c = house.firsts[i] + 1; c + 1 < house.firsts[i + 1]; c++) {
            put("facet normal 0 0 0\nouter loop\n");
            put_corner("vertex ", house.positions[house.firsts[i]], at);
            put_corner("vertex ", house.positions[c], at);
            put_corner("vertex ", house.positions[c + 1], at);
            put("endloop\nendfacet\n");
        }
    put("endsolid house\n");
}

static const struct {
    const char *name;
    void (*write)(const double at[3]);
} formats[] = {{"x.obj", write_obj},           {"x.off", write_off},
               {"ascii.ply", write_ascii_ply}, {"little.ply", write_little_ply},
               {"big.ply", write_big_ply},     {"x.stl", write_stl}};
enum { FORMATS = sizeof formats / sizeof *formats };

static dp_source *open_file(const char *name, void (*write)(const double at[3]),
                            const double at[3]) {
    dp_diag diag = {0};
    dp_source *source = NULL;
    file_size = 0;
    write(at);
    const dp_memory_file memory = {.data = file, .size = file_size, .name = name};
    if (dp_source_open_memory(&memory, NULL, &source, &diag)) fail_msg("%s", diag.message);
    return source;
}

/* ------- choosing an origin ------- */

typedef struct chosen {
    double origin[3];
    float positions[8][3];
} chosen;

static chosen choose(const double (*at)[3], size_t count) {
    const dp_allocator memory = dp_allocator_resolve(NULL);
    chosen c = {{0}, {{0}}};
    dp_wide wide = {0};
    for (size_t v = 0; v < count; v++) {
        for (int k = 0; k < 3; k++) c.positions[v][k] = (float)at[v][k];
        assert_true(dp_wide_note(&wide, v, at[v], c.positions[v], &memory));
    }
    dp_wide_settle(&wide, c.positions[0], count, c.origin, &memory);
    assert_null(wide.rests);
    return c;
}

static void models_near_zero_stay_as_they_are(void **state) {
    static const double near[][3] = {{100.1, 0.3, 7.7}, {120.2, 3.3, 9.1}, {117.7, 8.1, 2.2}},
                        integers[][3] = {{200, 201, 202}, {203, 204, 205}, {206, 207, 208}},
                        point[][3] = {{1e6 + 0.1, 2, 3}, {1e6 + 0.1, 2, 3}},
                        broken[][3] = {{0, 0, (double)NAN}, {(double)INFINITY, 0, 0}};
    const struct {
        const double (*at)[3];
        size_t count;
    } cases[] = {{near, 3}, {integers, 3}, {point, 2}, {broken, 2}};
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const chosen c = choose(cases[i].at, cases[i].count);
        for (size_t v = 0; v < cases[i].count; v++)
            for (int k = 0; k < 3; k++) {
                const float whole = (float)cases[i].at[v][k];
                assert_true(c.origin[k] == 0);
                assert_memory_equal(&c.positions[v][k], &whole, sizeof whole);
            }
    }
}

static void far_models_get_an_origin_among_them(void **state) {
    static const double far[][3] = {
        {692345.12, 5334567.34, 1.5}, {692351.37, 5334571.59, 2}, {692344.87, 5334567.09, 0}};
    double turned[4][3] = {{0}}; /* the other way round, after a filler */
    (void)state;
    for (int v = 0; v < 3; v++) memcpy(turned[1 + v], far[2 - v], sizeof far[v]);
    const chosen c = choose(far, 3), t = choose((const double(*)[3])turned, 4);
    assert_memory_equal(c.origin, t.origin, sizeof c.origin);
    assert_true(c.origin[2] == 0); /* no axis without need */
    for (int k = 0; k < 2; k++)
        assert_true(c.origin[k] == floor(c.origin[k]) && fabs(c.origin[k] - far[0][k]) < 7);
    for (int v = 0; v < 3; v++)
        for (int k = 0; k < 3; k++) {
            const double world = c.origin[k] + (double)c.positions[v][k];
            assert_true(fabs(world - far[v][k]) < 1e-6);
            assert_true(c.positions[v][k] == t.positions[3 - v][k]);
        }
}

/* ------- readers ------- */

static void every_reader_keeps_the_digits(void **state) {
    const dp_camera camera = camera_at(away);
    (void)state;
    draw_expected(NULL);
    for (int i = 0; i < FORMATS; i++) {
        dp_source *const source = open_file(formats[i].name, formats[i].write, away);
        dp_batch batch;
        dp_extent extent;
        draw(source, &camera, NULL, &shown);
        expect_same(formats[i].name);
        assert_int_equal(dp_source_extent(source, &extent, NULL), DP_OK);
        assert_true(extent.spacing > 0 && extent.spacing < 1e-4); /* z needs no origin */
        assert_int_equal(dp_source_next(source, &batch, NULL), DP_OK);
        for (int k = 0; k < 3; k++) {
            const double world = batch.origin[k] + (double)batch.positions[k],
                         wanted = away[k] + (double)house.positions[0][k];
            assert_true(batch.origin[k] != 0 || k == 2);
            assert_true(fabs(world - wanted) < 1e-5);
        }
        dp_source_destroy(source);
    }
}

/* An allocator of which only the first calls succeed. */
static size_t calls_left;

static void *scarce_alloc(size_t size, void *user) {
    (void)user;
    return calls_left && calls_left-- ? malloc(size) : NULL;
}
static void *scarce_realloc(void *block, size_t size, void *user) {
    (void)user;
    return calls_left && calls_left-- ? realloc(block, size) : NULL;
}
static void scarce_free(void *block, void *user) {
    (void)user;
    free(block);
}

/* Every allocation may fail, also those of what float32 cuts off. */
static void readers_say_when_memory_is_out(void **state) {
    const dp_allocator scarce = {
        .alloc = scarce_alloc, .realloc = scarce_realloc, .free = scarce_free};
    const dp_file_options options = {.allocator = &scarce};
    (void)state;
    for (int i = 0; i < FORMATS; i++) {
        dp_result result = DP_ERR_MEMORY;
        file_size = 0;
        formats[i].write(away);
        const dp_memory_file memory = {.data = file, .size = file_size, .name = formats[i].name};
        for (size_t calls = 0; result; calls++) {
            dp_source *source = NULL;
            dp_batch batch;
            dp_diag diag = {0};
            calls_left = calls;
            result = dp_source_open_memory(&memory, &options, &source, &diag);
            if (!result) result = dp_source_next(source, &batch, &diag);
            if (result) assert_int_equal(result, DP_ERR_MEMORY);
            assert_true(calls < 100000 && (result || calls > 3));
            dp_source_destroy(source);
        }
    }
}

/* Readings of ASCII STL give the same bits, though only the first one chooses the origin. */
static void readings_are_alike(void **state) {
    dp_source *const source = open_file("x.stl", write_stl, away);
    float first[600];
    dp_batch batch;
    size_t count = 0;
    (void)state;
    for (int reading = 0; reading < 3; reading++) {
        size_t at = 0;
        for (;;) {
            assert_int_equal(dp_source_next(source, &batch, NULL), DP_OK);
            if (!batch.polygon_count) break;
            const size_t n = 3 * batch.vertex_count;
            assert_true(at + n <= 600);
            if (reading)
                assert_memory_equal(first + at, batch.positions, n * sizeof *first);
            else
                memcpy(first + at, batch.positions, n * sizeof *first);
            at += n;
        }
        assert_true(at > 200 && (!reading || at == count));
        count = at;
        assert_int_equal(dp_source_rewind(source, NULL), DP_OK);
    }
    dp_source_destroy(source);
}

static void what_the_file_has_lost_is_told(void **state) {
    dp_source *const source = open_file("single.ply", write_single_ply, away);
    dp_extent extent;
    (void)state;
    assert_int_equal(dp_source_extent(source, &extent, NULL), DP_OK);
    assert_true(extent.spacing == 0.5);
    for (int k = 0; k < 3; k++) {
        assert_true((double)extent.min[k] == extent.exact_min[k]);
        assert_true((double)extent.max[k] == extent.exact_max[k]);
    }
    dp_source_destroy(source);
}

/* ------- sources of an application ------- */

static void the_box_is_in_world_space(void **state) {
    dp_batch batch = scene_batch(&house);
    dp_source *source;
    dp_extent at_zero, extent;
    (void)state;
    assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
    assert_int_equal(dp_source_extent(source, &at_zero, NULL), DP_OK);
    dp_source_destroy(source);
    memcpy(batch.origin, away, sizeof away);
    assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
    assert_int_equal(dp_source_extent(source, &extent, NULL), DP_OK);
    dp_source_destroy(source);
    for (int k = 0; k < 3; k++) {
        assert_true(extent.exact_min[k] == away[k] + at_zero.exact_min[k]);
        assert_true(extent.exact_max[k] == away[k] + at_zero.exact_max[k]);
        assert_true((double)extent.min[k] <= extent.exact_min[k]); /* rounded outwards */
        assert_true((double)extent.max[k] >= extent.exact_max[k]);
        assert_true((double)extent.min[k] > extent.exact_min[k] - 1);
    }
    assert_true(extent.spacing == at_zero.spacing);
}

static void a_camera_is_fitted_to_the_exact_box(void **state) {
    dp_batch batch = scene_batch(&house);
    static const double at[2][3] = {{0, 0, 0}, {692345.12, 5334567.34, 512.5}};
    (void)state;
    for (int i = 0; i < 2; i++) {
        dp_source *source;
        dp_extent extent;
        dp_fit fit = {.aspect = (double)SCENE_WIDTH / SCENE_HEIGHT};
        dp_camera camera;
        memcpy(batch.origin, at[i], sizeof at[i]);
        assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
        assert_int_equal(dp_source_extent(source, &extent, NULL), DP_OK);
        memcpy(fit.exact_min, extent.exact_min, sizeof fit.exact_min);
        memcpy(fit.exact_max, extent.exact_max, sizeof fit.exact_max);
        assert_int_equal(dp_camera_fit(&camera, &fit), DP_OK);
        draw(source, &camera, NULL, i ? &shown : &expected);
        dp_source_destroy(source);
    }
    expect_same("fitted");
}

/* Hands out the house's polygons, `step` at a time, each batch about an origin of its own. */
typedef struct parts {
    size_t next, step, calls;
    float positions[SCENE_CORNERS][3];
    uint32_t firsts[SCENE_POLYGONS + 1];
} parts;

static dp_result parts_next(void *user, dp_batch *batch, dp_diag *diag) {
    parts *const p = user;
    const size_t last = p->next + p->step < house.polygons ? p->next + p->step : house.polygons;
    (void)diag;
    p->calls++;
    if (p->next == house.polygons) return DP_OK;
    const uint32_t from = house.firsts[p->next], to = house.firsts[last];
    for (int k = 0; k < 3; k++) batch->origin[k] = away[k] + 8 * (double)(p->next % 5) - 16;
    for (uint32_t c = from; c < to; c++)
        for (int k = 0; k < 3; k++)
            p->positions[c - from][k] =
                (float)((double)house.positions[c][k] + away[k] - batch->origin[k]);
    for (size_t i = p->next; i <= last; i++) p->firsts[i - p->next] = house.firsts[i] - from;
    batch->positions = p->positions[0];
    batch->vertex_count = batch->corner_count = to - from;
    batch->firsts = p->firsts;
    batch->polygon_count = last - p->next;
    p->next = last;
    return DP_OK;
}

static dp_result parts_rewind(void *user, dp_diag *diag) {
    (void)diag;
    ((parts *)user)->next = 0;
    return DP_OK;
}

enum { FROM_MEMORY, IN_PARTS, IN_PARTS_ONCE, WAYS };

static void batches_are_moved_to_one_origin(void **state) {
    static parts p;
    const dp_camera camera = camera_at(away);
    const dp_style once = {.passes = 1};
    const size_t limit = context->limit;
    (void)state;
    draw_expected(NULL);
    for (int way = 0; way < WAYS; way++) {
        const dp_source_callbacks callbacks = {
            .user = &p, .next = parts_next, .rewind = way == IN_PARTS_ONCE ? NULL : parts_rewind};
        context->limit = way == FROM_MEMORY ? limit : 1;
        for (p.step = 1; p.step < 9; p.step += 3) {
            dp_source *source;
            p.next = p.calls = 0;
            assert_int_equal(dp_source_from_callbacks(&callbacks, NULL, &source, NULL), DP_OK);
            draw(source, &camera, way == IN_PARTS_ONCE ? &once : NULL, &shown);
            if (way == FROM_MEMORY) /* each batch is asked for once */
                assert_int_equal(p.calls, (house.polygons + p.step - 1) / p.step + 1);
            if (way == IN_PARTS_ONCE) /* what hides is known by samples only */
                assert_true(different() < 60);
            else
                expect_same(way == IN_PARTS ? "in parts" : "batches");
            dp_source_destroy(source);
        }
    }
    context->limit = limit;
}

/* Files that do not fit are read in parts. */
static void streamed_files_keep_the_digits(void **state) {
    const dp_camera camera = camera_at(away);
    const size_t limit = context->limit;
    (void)state;
    draw_expected(NULL);
    context->limit = 1;
    dp_source *const source = open_file("x.stl", write_stl, away);
    draw(source, &camera, NULL, &shown);
    context->limit = limit;
    expect_same("ASCII STL in parts");
    dp_source_destroy(source);
}

static void origins_must_be_finite(void **state) {
    dp_batch batch = scene_batch(&house);
    dp_source *source;
    dp_diag diag = {0};
    dp_extent extent;
    (void)state;
    batch.spacing = 3; /* what an application knows of its own positions */
    assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
    assert_int_equal(dp_source_extent(source, &extent, &diag), DP_OK);
    assert_true(extent.spacing == 3);
    dp_source_destroy(source);
    batch.origin[1] = INFINITY;
    assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
    assert_int_equal(dp_source_extent(source, &extent, &diag), DP_ERR_ARGUMENT);
    assert_non_null(strstr(diag.message, "origin"));
    dp_source_destroy(source);
}

static void immediate_mode_takes_doubles(void **state) {
    const dp_camera camera = camera_at(away);
    const dp_target target = {.width = SCENE_WIDTH, .height = SCENE_HEIGHT, .rgba = shown.rgba};
    dp_diag diag = {0};
    dp_stats stats;
    (void)state;
    draw_expected(NULL);
    for (int twice = 0; twice < 2; twice++) { /* an origin ends with its recording */
        dp_set_camera(context, &camera);
        dp_enable(context, DP_ALL_LINES);
        for (size_t i = 0; i < house.polygons; i++) {
            dp_begin(context, DP_POLYGON);
            for (uint32_t c = house.firsts[i]; c < house.firsts[i + 1]; c++) {
                double at[3];
                for (int k = 0; k < 3; k++) at[k] = away[k] + (double)house.positions[c][k];
                if (c % 2)
                    dp_vertex3dv(context, at);
                else
                    dp_vertex3d(context, at[0], at[1], at[2]);
            }
            dp_end(context);
        }
        if (dp_finish(context, &target, &diag)) fail_msg("%s", diag.message);
        dp_stats_of(context, &stats);
        assert_int_equal(stats.dropped, 0);
        expect_same("immediate mode");
    }
    dp_begin(context, DP_POLYGON);
    dp_vertex3dv(context, NULL);
    dp_end(context);
    assert_int_equal(dp_finish(context, &target, &diag), DP_ERR_ARGUMENT);
    assert_non_null(strstr(diag.message, "dp_vertex3dv"));
}

/* ------- world space ------- */

static void segments_are_in_world_space(void **state) {
    const dp_camera near = camera_at((const double[3]){0, 0, 0}), far = camera_at(away);
    dp_batch batch = scene_batch(&house);
    dp_source *source;
    size_t count, again;
    (void)state;
    assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
    draw(source, &near, NULL, &expected);
    dp_source_destroy(source);
    const dp_segment *segments = dp_segments(context, &count);
    dp_segment *const kept = calloc(count, sizeof *kept);
    assert_true(kept && count > 10);
    memcpy(kept, segments, count * sizeof *kept);
    memcpy(batch.origin, away, sizeof away);
    assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
    draw(source, &far, NULL, &shown);
    dp_source_destroy(source);
    segments = dp_segments(context, &again);
    assert_int_equal(count, again);
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 3; k++) {
            assert_true(fabs(segments[i].world_a[k] - away[k] - kept[i].world_a[k]) < 1e-3);
            assert_true(fabs(segments[i].world_b[k] - away[k] - kept[i].world_b[k]) < 1e-3);
        }
    free(kept);
}

/* The same model about another origin, which costs no digit: the same picture, whatever lies in
 * world space. */
static void an_origin_changes_nothing(void **state) {
    static const double origin[3] = {64, -32, 16};
    static scene exact, moved;
    const dp_camera camera = scene_camera(130, 40, 60, 40, -30, 10);
    const dp_style styles[] = {
        {.lines = DP_ALL_LINES},
        {.lines = DP_NO_LINES, .shade = {.shading = DP_SHADING_HATCH, .object_space = true}},
        {.lines = DP_NO_LINES,
         .shade = {.shading = DP_SHADING_HALFTONE, .object_space = true, .stroke_scale = 3}},
        {.ink = DP_INK_QUADS, .edges = DP_EDGES_ADJACENCY},
        {.shade = {.shading = DP_SHADING_PENCIL}},
        {.mirror = {.normal = {0, 1, 0.25},
                    .offset = -46,
                    .center = {35, -50, 0},
                    .size = 90,
                    .fade = 60}},
    };
    (void)state;
    memset(&exact, 0, sizeof exact);
    scene_box(&exact, (const float[3]){10, -46, -10}, (const float[3]){40.5f, -20.25f, 15});
    scene_box(&exact, (const float[3]){20, -40, -16}, (const float[3]){31, -12.5f, 3});
    scene_polygon(&exact, 3, (const float[3][3]){{8, -46, 20}, {44, -46, 20}, {25, -30, 32}});
    moved = exact;
    for (size_t c = 0; c < moved.corners; c++)
        for (int k = 0; k < 3; k++) moved.positions[c][k] -= (float)origin[k];
    for (size_t i = 0; i < sizeof styles / sizeof *styles; i++) {
        const scene *const scenes[] = {&exact, &moved};
        for (int m = 0; m < 2; m++) {
            dp_batch batch = scene_batch(scenes[m]);
            dp_source *source;
            if (m) memcpy(batch.origin, origin, sizeof origin);
            assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
            draw(source, &camera, &styles[i], m ? &shown : &expected);
            dp_source_destroy(source);
        }
        if (different() > 4) fail_msg("style %zu: %d pixels differ", i, different());
        assert_true(scene_ink(&shown, -100, -60, 100, 60) > 100);
    }
}

static void written_models_stay_in_place(void **state) {
    static const char *const endings[] = {".ply", ".obj", ".stl"};
    const dp_camera camera = camera_at(away);
    (void)state;
    draw_expected(NULL);
    for (int i = 0; i < 3; i++) {
        dp_batch batch = scene_batch(&house);
        dp_source *source;
        dp_diag diag = {0};
        dp_extent extent;
        char path[400], name[420];
        temporary_name(path, sizeof path, "origin");
        assert_int_equal(close(mkstemp(path)), 0);
        snprintf(name, sizeof name, "%s%s", path, endings[i]);
        memcpy(batch.origin, away, sizeof away);
        assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
        if (dp_io_write_mesh(name, DP_MESH_FILE_AUTO, source, NULL, NULL, &diag))
            fail_msg("%s", diag.message);
        dp_source_destroy(source);
        if (dp_source_open(name, NULL, &source, &diag)) fail_msg("%s", diag.message);
        if (i < 2) {
            draw(source, &camera, NULL, &shown);
            expect_same(endings[i]);
        } else { /* float32 */
            assert_int_equal(dp_source_extent(source, &extent, &diag), DP_OK);
            for (int k = 0; k < 3; k++) assert_true(fabs((double)extent.min[k] - away[k]) < 60);
            assert_true(extent.spacing == 0.5);
        }
        dp_source_destroy(source);
        unlink(name), unlink(path);
    }
}

static int set_up(void **state) {
    (void)state;
    make_house();
    return dp_context_create(&(dp_context_desc){.threads = 2}, &context, NULL);
}

static int tear_down(void **state) {
    (void)state;
    dp_context_destroy(context);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(models_near_zero_stay_as_they_are),
        cmocka_unit_test(far_models_get_an_origin_among_them),
        cmocka_unit_test(every_reader_keeps_the_digits),
        cmocka_unit_test(readers_say_when_memory_is_out),
        cmocka_unit_test(readings_are_alike),
        cmocka_unit_test(what_the_file_has_lost_is_told),
        cmocka_unit_test(the_box_is_in_world_space),
        cmocka_unit_test(a_camera_is_fitted_to_the_exact_box),
        cmocka_unit_test(batches_are_moved_to_one_origin),
        cmocka_unit_test(streamed_files_keep_the_digits),
        cmocka_unit_test(origins_must_be_finite),
        cmocka_unit_test(immediate_mode_takes_doubles),
        cmocka_unit_test(segments_are_in_world_space),
        cmocka_unit_test(an_origin_changes_nothing),
        cmocka_unit_test(written_models_stay_in_place),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
