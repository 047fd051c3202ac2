/* mesh/source: arrays and callbacks as sources, inconsistent tables, extents. */
#include "base/hostile.h"
#include <drypoint/drypoint.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const float quad[] = {0, 0, 0, 2, 0, 0, 2, 1, 0, 0, 1, 0};
static const uint32_t two_triangles[] = {0, 1, 2, 0, 2, 3};

static dp_batch quad_batch(void) {
    return (dp_batch){.positions = quad,
                      .vertex_count = 4,
                      .indices = two_triangles,
                      .corner_count = 6,
                      .polygon_count = 2};
}

static void arrays_come_once_per_rewind(void **state) {
    (void)state;
    const dp_batch arrays = quad_batch();
    dp_source *source;
    assert_int_equal(dp_source_from_arrays(&arrays, NULL, &source, NULL), DP_OK);
    assert_true(dp_source_rewindable(source));
    for (int round = 0; round < 2; round++) {
        dp_batch batch;
        assert_int_equal(dp_source_next(source, &batch, NULL), DP_OK);
        assert_int_equal(batch.polygon_count, 2);
        assert_int_equal(batch.position_stride, 12);
        assert_true(batch.stable && batch.positions == quad);
        assert_int_equal(dp_source_next(source, &batch, NULL), DP_OK);
        assert_int_equal(batch.polygon_count, 0);
        assert_int_equal(dp_source_rewind(source, NULL), DP_OK);
    }
    assert_null(dp_source_group_name(source, 0));
    dp_source_destroy(source);
    dp_source_destroy(NULL);
}

static void extent_counts_and_skips_what_is_not_usable(void **state) {
    (void)state;
    static const float positions[] = {-1, 0, 0, 2, 0, 5, 2, 1, 0, NAN, 1, 0, 99, 99, 99};
    static const uint32_t indices[] = {0, 1, 2, /* */ 0, 1, 3, /* */ 0, 1, 7};
    const dp_batch arrays = {.positions = positions,
                             .vertex_count = 5,
                             .indices = indices,
                             .corner_count = 9,
                             .polygon_count = 3};
    dp_source *source;
    dp_extent extent;
    assert_int_equal(dp_source_from_arrays(&arrays, NULL, &source, NULL), DP_OK);
    for (int round = 0; round < 2; round++) { /* it rewinds by itself */
        assert_int_equal(dp_source_extent(source, &extent, NULL), DP_OK);
        assert_int_equal(extent.polygons, 3);
        assert_int_equal(extent.corners, 9);
        assert_int_equal(extent.vertices, 5);
        assert_int_equal(extent.not_finite, 1);
        assert_int_equal(extent.bad_index, 1);
        assert_true(extent.min[0] == -1 && extent.max[0] == 2 && extent.max[2] == 5);
    }
    dp_source_destroy(source);
}

/* Deforming meshes: after a drawing the source stands at its end. */
static void extent_begins_at_the_start(void **state) {
    static const char *const shapes[] = {"cube", "terrain"};
    (void)state;
    for (size_t i = 0; i < 3; i++) {
        const dp_batch arrays = quad_batch();
        dp_source *source = NULL;
        dp_extent fresh, later;
        dp_batch batch;
        if (i < 2)
            assert_int_equal(dp_source_from_shape(&(dp_shape){.name = shapes[i]}, &source, NULL),
                             DP_OK);
        else
            assert_int_equal(dp_source_from_arrays(&arrays, NULL, &source, NULL), DP_OK);
        assert_int_equal(dp_source_extent(source, &fresh, NULL), DP_OK);
        do assert_int_equal(dp_source_next(source, &batch, NULL), DP_OK);
        while (batch.polygon_count);
        assert_int_equal(dp_source_extent(source, &later, NULL), DP_OK);
        assert_memory_equal(&later, &fresh, sizeof fresh);
        assert_true(fresh.polygons > 0);
        assert_int_equal(dp_source_next(source, &batch, NULL), DP_OK);
        assert_true(batch.polygon_count > 0); /* it is left at its start */
        dp_source_destroy(source);
    }
}

static void the_extent_of_nothing_is_no_box(void **state) {
    dp_camera camera;
    dp_fit fit = {0};
    (void)state;
    const dp_batch arrays = {0};
    dp_source *source;
    dp_extent extent;
    assert_int_equal(dp_source_from_arrays(&arrays, NULL, &source, NULL), DP_OK);
    assert_int_equal(dp_source_extent(source, &extent, NULL), DP_OK);
    assert_true(extent.min[0] == INFINITY && extent.max[2] == -INFINITY && extent.polygons == 0);
    memcpy(fit.min, extent.min, sizeof fit.min), memcpy(fit.max, extent.max, sizeof fit.max);
    assert_int_equal(dp_camera_fit(&camera, &fit), DP_ERR_ARGUMENT);
    dp_source_destroy(source);
}

/* An application's source that counts its calls and returns any batch it is given. */
typedef struct app {
    dp_batch batch;
    dp_result result;
    int left, destroyed;
} app;

static dp_result app_next(void *user, dp_batch *batch, dp_diag *diag) {
    app *const self = user;
    assert_non_null(diag);
    if (self->left-- > 0) *batch = self->batch;
    return self->result;
}
static void app_destroy(void *user) { ((app *)user)->destroyed++; }

static dp_source *open_app(app *self) {
    const dp_source_callbacks callbacks = {.user = self, .next = app_next, .destroy = app_destroy};
    dp_source *source = NULL;
    assert_int_equal(dp_source_from_callbacks(&callbacks, NULL, &source, NULL), DP_OK);
    return source;
}

static void a_stream_is_read_once_and_destroyed_once(void **state) {
    (void)state;
    app self = {.batch = quad_batch(), .left = 3};
    dp_source *const source = open_app(&self);
    assert_false(dp_source_rewindable(source));
    dp_extent extent;
    assert_int_equal(dp_source_extent(source, &extent, NULL), DP_OK);
    assert_int_equal(extent.polygons, 6);
    dp_diag diag;
    assert_int_equal(dp_source_rewind(source, &diag), DP_ERR_UNSUPPORTED);
    assert_int_equal(diag.result, DP_ERR_UNSUPPORTED);
    assert_int_equal(self.destroyed, 0);
    dp_source_destroy(source);
    assert_int_equal(self.destroyed, 1);
}

static void a_failing_stream_always_says_something(void **state) {
    (void)state;
    app self = {.result = DP_ERR_IO};
    dp_source *const source = open_app(&self);
    dp_batch batch;
    dp_diag diag = {0};
    assert_int_equal(dp_source_next(source, &batch, &diag), DP_ERR_IO);
    assert_int_equal(diag.result, DP_ERR_IO);
    assert_true(diag.message[0] != 0);
    dp_source_destroy(source);
}

static void tables_that_contradict_themselves_are_refused(void **state) {
    (void)state;
    static const uint32_t backwards[] = {0, 4, 3}, beyond[] = {0, 3, 7}, good[] = {0, 3, 6};
    dp_batch bad[5];
    for (int i = 0; i < 5; i++) bad[i] = quad_batch();
    bad[0].corner_count = 5;
    bad[1].firsts = backwards;
    bad[2].firsts = beyond;
    bad[3].positions = NULL;
    bad[4].vertex_count = (size_t)UINT32_MAX + 1;
    for (int i = 0; i < 5; i++) {
        app self = {.batch = bad[i], .left = 1};
        dp_source *const source = open_app(&self);
        dp_batch batch;
        dp_diag diag = {0};
        assert_int_equal(dp_source_next(source, &batch, &diag),
                         i == 4 ? DP_ERR_LIMIT : DP_ERR_ARGUMENT);
        if (i == 4) assert_non_null(strstr(diag.message, "4294967296 vertices"));
        if (i == 0) assert_non_null(strstr(diag.message, "its corner_count is 5"));
        dp_source_destroy(source);
    }
    app self = {.batch = quad_batch(), .left = 1};
    self.batch.firsts = good;
    dp_source *const source = open_app(&self);
    dp_batch batch;
    assert_int_equal(dp_source_next(source, &batch, NULL), DP_OK);
    dp_source_destroy(source);
}

/* An allocator that fails at its n-th call; everything is given back all the same. */
typedef struct stingy {
    int left, held;
} stingy;

static void *stingy_alloc(size_t size, void *user) {
    stingy *const s = user;
    if (s->left-- <= 0) return NULL;
    s->held++;
    return malloc(size);
}
static void *stingy_realloc(void *block, size_t size, void *user) {
    stingy *const s = user;
    if (s->left-- <= 0) return NULL;
    if (!block) s->held++;
    return realloc(block, size);
}
static void stingy_free(void *block, void *user) {
    if (block) ((stingy *)user)->held--;
    free(block);
}

static void failing_memory_leaves_nothing_behind(void **state) {
    (void)state;
    const dp_batch arrays = quad_batch();
    dp_result result = DP_ERR_MEMORY;
    for (int allowed = 0; result; allowed++) {
        stingy s = {.left = allowed};
        const dp_allocator memory = {stingy_alloc, stingy_realloc, stingy_free, &s};
        dp_source *source;
        dp_diag diag = {0};
        result = dp_source_from_arrays(&arrays, &memory, &source, &diag);
        if (result) {
            assert_int_equal(result, DP_ERR_MEMORY);
            assert_int_equal(diag.result, DP_ERR_MEMORY);
            assert_null(source);
        }
        dp_source_destroy(source);
        assert_int_equal(s.held, 0);
        assert_true(allowed < 10);
    }
}

/* ------- where numbers may lie ------- */

enum { WIDTH = 120, HEIGHT = 90 };

static dp_result next_batch(void *user, dp_batch *batch, dp_diag *diag) {
    (void)diag;
    *batch = *(const dp_batch *)user;
    return DP_OK;
}

static const void *moved(const void *address) { return (const char *)address + 1; }

/* Every array, one byte off where it must begin or with a stride that is not a multiple. */
static void what_lies_askew_is_refused(void **state) {
    static const float zeros[64];
    static const uint32_t numbers[16];
    static const uint16_t groups[4];
    dp_batch sound = quad_batch(), bad[12];
    size_t n = 0;
    (void)state;
    sound.positions = zeros;
    sound.normals = sound.texcoords = (dp_attribute){zeros, 12, 4, numbers};
    sound.groups = groups;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) bad[i] = sound;
    for (size_t off = 1; off < 4; off++) bad[n++].position_stride = 12 + off;
    bad[n++].positions = moved(zeros);
    bad[n++].indices = moved(two_triangles);
    bad[n++].groups = moved(groups);
    bad[n++].normals.stride = 13;
    bad[n++].normals.values = moved(zeros);
    bad[n++].normals.indices = moved(numbers);
    bad[n++].texcoords.stride = 10;
    bad[n++].texcoords.values = moved(zeros);
    bad[n++].firsts = moved(numbers);
    assert_int_equal(n, sizeof bad / sizeof *bad);
    for (size_t i = 0; i < n; i++) {
        const dp_source_callbacks callbacks = {.user = &bad[i], .next = next_batch};
        dp_source *source = NULL;
        dp_batch batch;
        dp_diag diag = {0};
        uint32_t six[12];
        if (dp_source_from_arrays(&bad[i], NULL, &source, &diag) != DP_ERR_ARGUMENT)
            fail_msg("arrays %zu were taken", i);
        assert_non_null(strstr(diag.message, "multiple"));
        assert_null(source);
        assert_int_equal(dp_source_from_callbacks(&callbacks, NULL, &source, NULL), DP_OK);
        diag = (dp_diag){0};
        if (dp_source_next(source, &batch, &diag) != DP_ERR_ARGUMENT)
            fail_msg("batch %zu was taken", i);
        assert_non_null(strstr(diag.message, "multiple"));
        dp_source_destroy(source);
        if (!bad[i].firsts)
            assert_int_equal(dp_adjacency_indices(&bad[i], NULL, six, NULL), DP_ERR_ARGUMENT);
    }
    /* an array that is not there has no stride */
    dp_batch empty = quad_batch();
    dp_source *source = NULL;
    empty.normals.stride = 7;
    assert_int_equal(dp_source_from_arrays(&empty, NULL, &source, NULL), DP_OK);
    dp_source_destroy(source);
}

static void positions_that_overlap_are_refused(void **state) {
    (void)state;
    for (size_t stride = 4; stride <= 12; stride += 4) {
        dp_batch batch = quad_batch();
        dp_source *source = NULL;
        dp_diag diag = {0};
        batch.position_stride = stride;
        const dp_result result = dp_source_from_arrays(&batch, NULL, &source, &diag);
        assert_int_equal(result, stride < 12 ? DP_ERR_ARGUMENT : DP_OK);
        if (result) assert_non_null(strstr(diag.message, "position_stride"));
        dp_source_destroy(source);
    }
}

static void draw(const dp_batch *batch, const dp_style *style, uint8_t *rgba) {
    dp_context *context = NULL;
    dp_source *source = NULL;
    dp_camera camera;
    const dp_fit fit = {.min = {-1, -1, -1}, .max = {1, 1, 1}};
    const dp_target target = {.width = WIDTH, .height = HEIGHT, .rgba = rgba};
    assert_int_equal(dp_camera_fit(&camera, &fit), DP_OK);
    assert_int_equal(dp_context_create(&(dp_context_desc){.threads = 2}, &context, NULL), DP_OK);
    assert_int_equal(dp_source_from_arrays(batch, NULL, &source, NULL), DP_OK);
    assert_int_equal(dp_draw(context, source, &camera, style, &target, NULL), DP_OK);
    dp_source_destroy(source);
    dp_context_destroy(context);
}

/* Any multiple of 4 does, and draws what tight positions draw. */
static void vertices_may_be_any_multiple_apart(void **state) {
    static const dp_style styles[] = {{0},
                                      {.ink = DP_INK_QUADS},
                                      {.edges = DP_EDGES_ADJACENCY},
                                      {.shade = {.shading = DP_SHADING_PENCIL}}};
    static uint8_t expected[4 * WIDTH * HEIGHT], rgba[4 * WIDTH * HEIGHT];
    static float spread[3000 * 9];
    dp_source *shape = NULL;
    dp_batch tight;
    (void)state;
    assert_int_equal(
        dp_source_from_shape(&(dp_shape){.name = "torus", .triangles = 1000}, &shape, NULL), DP_OK);
    assert_int_equal(dp_source_next(shape, &tight, NULL), DP_OK);
    assert_true(tight.polygon_count > DP_TUNED(100, 0) && tight.vertex_count <= 3000);
    for (size_t s = 0; s < sizeof styles / sizeof *styles; s++) {
        draw(&tight, &styles[s], expected);
        for (size_t stride = 4; stride <= 9; stride++) {
            dp_batch wide = tight;
            for (size_t v = 0; v < tight.vertex_count; v++)
                memcpy(spread + v * stride,
                       (const char *)tight.positions + v * tight.position_stride, 12);
            wide.positions = spread;
            wide.position_stride = stride * sizeof(float);
            draw(&wide, &styles[s], rgba);
            assert_memory_equal(rgba, expected, sizeof rgba);
        }
    }
    dp_source_destroy(shape);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(arrays_come_once_per_rewind),
        cmocka_unit_test(extent_counts_and_skips_what_is_not_usable),
        cmocka_unit_test(extent_begins_at_the_start),
        cmocka_unit_test(the_extent_of_nothing_is_no_box),
        cmocka_unit_test(positions_that_overlap_are_refused),
        cmocka_unit_test(a_stream_is_read_once_and_destroyed_once),
        cmocka_unit_test(a_failing_stream_always_says_something),
        cmocka_unit_test(tables_that_contradict_themselves_are_refused),
        cmocka_unit_test(failing_memory_leaves_nothing_behind),
        cmocka_unit_test(what_lies_askew_is_refused),
        cmocka_unit_test(vertices_may_be_any_multiple_apart),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
