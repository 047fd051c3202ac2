/* mesh/join: several sources as one scene. */
#include "base/hostile.h"
#include "mesh/source.h"
#include "scene.h"
#include "temporary.h"
#include <drypoint/drypoint.h>
#include <drypoint/io.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static const float triangle[] = {0, 0, 0, 4, 0, 0, 0, 4, 0};
static const float normals[] = {0, 0, 1, 0, 0, 1, 0, 0, 1};
static const uint32_t colors[] = {0xFF0000FF, 0xFF0000FF, 0xFF0000FF};

static dp_batch triangle_batch(void) {
    return (dp_batch){
        .positions = triangle, .vertex_count = 3, .corner_count = 3, .polygon_count = 1};
}

static dp_source *source_of(const dp_batch *batch) {
    dp_source *source;
    assert_int_equal(dp_source_from_arrays(batch, NULL, &source, NULL), DP_OK);
    return source;
}

static dp_source *join(dp_source **parts, const char *const *names, size_t count) {
    dp_source *joined;
    dp_diag diag = {0};
    assert_int_equal(dp_source_join(parts, names, count, NULL, &joined, &diag), DP_OK);
    return joined;
}

static dp_source *file_of(const char *text, const char *name) {
    const dp_memory_file file = {.data = text, .size = strlen(text), .name = name};
    dp_source *source;
    dp_diag diag = {0};
    if (dp_source_open_memory(&file, NULL, &source, &diag)) fail_msg("%s", diag.message);
    return source;
}

/* An application's source: batches of one triangle, and then a result. */
typedef struct app {
    int batches, left, rewinds, destroyed;
    double time, length;
    bool frozen;
    dp_result end;
    uint16_t group[1];
} app;

static dp_result app_next(void *user, dp_batch *batch, dp_diag *diag) {
    app *const a = user;
    if (!a->left--) {
        if (a->end) snprintf(diag->message, sizeof diag->message, "the tape is torn");
        diag->result = a->end;
        return a->end;
    }
    *batch = triangle_batch();
    batch->groups = a->group;
    return DP_OK;
}
static dp_result app_rewind(void *user, dp_diag *diag) {
    app *const a = user;
    (void)diag;
    a->rewinds++, a->left = a->batches;
    return DP_OK;
}
static void app_destroy(void *user) { ((app *)user)->destroyed++; }
static const char *app_name(void *user, uint32_t group) {
    return group == ((app *)user)->group[0] ? "blade" : NULL;
}
static uint32_t app_color(void *user, uint32_t group) {
    return group == ((app *)user)->group[0] ? 0x112233FF : 0;
}
static dp_result app_set_time(void *user, double time, dp_diag *diag) {
    app *const a = user;
    a->time = time;
    if (a->frozen) snprintf(diag->message, sizeof diag->message, "the tape is stuck");
    return a->frozen ? (diag->result = DP_ERR_IO) : DP_OK;
}
static double app_duration(void *user) { return ((app *)user)->length; }
static const char *app_remark(void *user) {
    (void)user;
    return "the tape is worn";
}

static dp_source *app_source(app *a, bool rewindable) {
    const dp_source_callbacks callbacks = {.user = a,
                                           .next = app_next,
                                           .rewind = rewindable ? app_rewind : NULL,
                                           .destroy = app_destroy,
                                           .group_name = app_name,
                                           .group_color = app_color,
                                           .remark = app_remark,
                                           .set_time = app_set_time,
                                           .duration = app_duration};
    dp_source *source;
    a->left = a->batches;
    assert_int_equal(dp_source_from_callbacks(&callbacks, NULL, &source, NULL), DP_OK);
    return source;
}

static void batches_come_in_order_in_every_reading(void **state) {
    (void)state;
    app a = {.batches = 2, .group = {7}};
    dp_batch plain = triangle_batch(), colored = plain, empty = {0};
    plain.origin[0] = 500000;
    colored.normals = (dp_attribute){.values = normals, .count = 3};
    colored.colors = colors;
    dp_source *parts[] = {source_of(&empty), source_of(&plain), app_source(&a, true),
                          source_of(&colored)};
    dp_source *const joined = join(parts, NULL, 4);
    assert_true(dp_source_rewindable(joined));
    for (int round = 0; round < 2; round++) {
        dp_batch batch;
        assert_int_equal(dp_source_next(joined, &batch, NULL), DP_OK);
        assert_true(batch.origin[0] == 500000 && batch.groups[0] == 1 && !batch.normals.values);
        for (int k = 0; k < 2; k++) {
            assert_int_equal(dp_source_next(joined, &batch, NULL), DP_OK);
            assert_true(batch.origin[0] == 0 && batch.groups[0] == 4 && !batch.colors);
        }
        assert_int_equal(dp_source_next(joined, &batch, NULL), DP_OK);
        assert_true(batch.groups[0] == 3 && batch.normals.values == normals &&
                    batch.colors == colors);
        for (int k = 0; k < 2; k++) {
            assert_int_equal(dp_source_next(joined, &batch, NULL), DP_OK);
            assert_int_equal(batch.polygon_count, 0);
        }
        assert_int_equal(dp_source_rewind(joined, NULL), DP_OK);
    }
    assert_int_equal(a.rewinds, 2);
    dp_source_destroy(joined);
    assert_int_equal(a.destroyed, 1);
}

static void read_through(dp_source *joined) {
    dp_extent extent;
    dp_diag diag = {0};
    if (dp_source_extent(joined, &extent, &diag)) fail_msg("%s", diag.message);
}

static void groups_have_names_of_their_files(void **state) {
    (void)state;
    static const char two[] =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\no left\nf 1 2 3\no right\nf 1 3 2\no left\nf 1 2 3\n";
    static const char *const names[] = {"a", NULL, "c", "d"};
    app a = {.batches = 1, .group = {900}};
    const dp_batch plain = triangle_batch();
    dp_source *parts[] = {file_of(two, "a.obj"), file_of(two, "b.obj"), app_source(&a, true),
                          source_of(&plain)};
    dp_source *const joined = join(parts, names, 4);
    for (int round = 0; round < 2; round++) {
        read_through(joined);
        assert_string_equal(dp_source_group_name(joined, 0), "a/left");
        assert_string_equal(dp_source_group_name(joined, 1), "left");
        assert_string_equal(dp_source_group_name(joined, 2), "c");
        assert_string_equal(dp_source_group_name(joined, 3), "d");
        assert_string_equal(dp_source_group_name(joined, 4), "a/right");
        assert_string_equal(dp_source_group_name(joined, 5), "right");
        assert_string_equal(dp_source_group_name(joined, 6), "c/blade");
        assert_null(dp_source_group_name(joined, 7));
        assert_int_equal(dp_source_group_color(joined, 6), 0x112233FF);
        assert_int_equal(dp_source_group_color(joined, 2), 0);
        assert_int_equal(dp_source_group_color(joined, 70000), 0);
    }
    dp_source_destroy(joined);
}

static void a_failing_source_is_named(void **state) {
    (void)state;
    static const char *const names[] = {"whole", "torn"};
    app a = {.batches = 1}, b = {.batches = 1, .end = DP_ERR_IO};
    dp_source *parts[] = {app_source(&a, true), app_source(&b, true)};
    dp_source *const joined = join(parts, names, 2);
    dp_extent extent;
    dp_diag diag = {0};
    for (int round = 0; round < 2; round++) { /* the scene can be read again, and fails again */
        assert_int_equal(dp_source_extent(joined, &extent, &diag), DP_ERR_IO);
        assert_string_equal(diag.message, "torn: the tape is torn");
    }
    assert_string_equal(dp_source_remark(joined),
                        "whole: the tape is worn; torn: the tape is worn");
    assert_string_equal(dp_source_remark(joined),
                        "whole: the tape is worn; torn: the tape is worn");
    assert_null(dp_source_color_remark(joined));
    dp_source_destroy(joined);
}

static void a_scene_moves_with_all_its_parts(void **state) {
    (void)state;
    const dp_batch still = triangle_batch();
    app a = {.batches = 1, .length = 2}, b = {.batches = 1, .length = 3};
    dp_source *parts[] = {app_source(&a, true), source_of(&still), app_source(&b, true)};
    static const char *const names[] = {"a", "still", "b"};
    dp_source *const joined = join(parts, names, 3);
    dp_diag diag = {0};
    assert_true(dp_source_duration(joined) == 3);
    assert_true(dp_source_duration(parts[1]) == 0 && dp_source_duration(NULL) == 0);
    assert_int_equal(dp_source_set_time(joined, 1.5, &diag), DP_OK);
    assert_true(a.time == 1.5 && b.time == 1.5);
    assert_int_equal(dp_source_set_time(joined, NAN, &diag), DP_ERR_ARGUMENT);
    assert_int_equal(dp_source_set_time(NULL, 1, NULL), DP_ERR_ARGUMENT);
    b.frozen = true;
    assert_int_equal(dp_source_set_time(joined, 2, &diag), DP_ERR_IO);
    assert_string_equal(diag.message, "b: the tape is stuck");
    dp_source_destroy(joined);
}

static void what_can_be_read_once_makes_a_scene_of_that_kind(void **state) {
    (void)state;
    app a = {.batches = 1}, b = {.batches = 1};
    dp_source *parts[] = {app_source(&a, true), app_source(&b, false)};
    dp_source *const joined = join(parts, NULL, 2);
    dp_batch batch;
    assert_false(dp_source_rewindable(joined));
    assert_int_equal(dp_source_rewind(joined, NULL), DP_ERR_UNSUPPORTED);
    for (int k = 0; k < 3; k++) {
        assert_int_equal(dp_source_next(joined, &batch, NULL), DP_OK);
        assert_int_equal(batch.polygon_count, k < 2);
    }
    dp_source_destroy(joined);
}

static void wrong_calls_leave_the_sources(void **state) {
    (void)state;
    app a = {.batches = 1};
    dp_source *const one = app_source(&a, true), *joined = one;
    dp_source *twice[] = {one, one}, *missing[] = {one, NULL};
    assert_int_equal(dp_source_join(twice, NULL, 2, NULL, &joined, NULL), DP_ERR_ARGUMENT);
    assert_null(joined);
    assert_int_equal(dp_source_join(missing, NULL, 2, NULL, &joined, NULL), DP_ERR_ARGUMENT);
    assert_int_equal(dp_source_join(twice, NULL, 0, NULL, &joined, NULL), DP_ERR_ARGUMENT);
    assert_int_equal(dp_source_join(NULL, NULL, 1, NULL, &joined, NULL), DP_ERR_ARGUMENT);
    assert_int_equal(dp_source_join(twice, NULL, 70000, NULL, &joined, NULL), DP_ERR_LIMIT);
    assert_int_equal(dp_source_join(twice, NULL, 1, NULL, NULL, NULL), DP_ERR_ARGUMENT);
    assert_int_equal(a.destroyed, 0);
    dp_source_destroy(one);
}

/* ---- memory ---- */

typedef struct meter {
    int left, blocks; /* allocations until one fails; blocks held */
} meter;

static void *meter_alloc(size_t size, void *user) {
    meter *const m = user;
    if (!m->left--) return NULL;
    m->blocks++;
    return malloc(size);
}
static void *meter_realloc(void *block, size_t size, void *user) {
    meter *const m = user;
    if (!m->left--) return NULL;
    if (!block) m->blocks++;
    return realloc(block, size);
}
static void meter_free(void *block, void *user) {
    if (block) ((meter *)user)->blocks--;
    free(block);
}

static void memory_may_fail_anywhere(void **state) {
    (void)state;
    static const char *const names[] = {"a", "b"};
    int failures = 0;
    for (int left = 0;; left++) {
        meter m = {.left = left};
        const dp_allocator memory = {meter_alloc, meter_realloc, meter_free, &m};
        app a = {.batches = 1, .group = {3}}, b = a;
        dp_source *parts[] = {app_source(&a, true), app_source(&b, true)}, *joined;
        dp_extent extent;
        dp_result result = dp_source_join(parts, names, 2, &memory, &joined, NULL);
        if (result) {
            assert_int_equal(a.destroyed + b.destroyed, 0);
            dp_source_destroy(parts[0]), dp_source_destroy(parts[1]);
        } else {
            result = dp_source_extent(joined, &extent, NULL);
            if (!result) /* without memory for it there is no name */
                assert_true(m.left > 0 || !dp_source_group_name(joined, 2));
            dp_source_remark(joined);
            dp_source_destroy(joined);
        }
        assert_int_equal(m.blocks, 0);
        assert_int_equal(a.destroyed + b.destroyed, 2);
        if (result) assert_int_equal(result, DP_ERR_MEMORY);
        failures += result != DP_OK;
        if (!result && m.left > 0) break;
    }
    assert_true(failures > 5);
}

/* ---- pictures ---- */

static void draw(dp_source *source, const dp_style *style, size_t memory, picture *out,
                 dp_stats *stats) {
    const dp_context_desc desc = {.memory = memory};
    const dp_camera camera = scene_camera(3, 2, 4, 0, 0, 0);
    const dp_target target = {.width = SCENE_WIDTH, .height = SCENE_HEIGHT, .rgba = out->rgba};
    dp_context *context;
    dp_diag diag = {0};
    assert_int_equal(dp_context_create(&desc, &context, NULL), DP_OK);
    if (dp_draw(context, source, &camera, style, &target, &diag)) fail_msg("%s", diag.message);
    if (stats) dp_stats_of(context, stats);
    dp_context_destroy(context);
}

static dp_source *shape(const char *name, uint64_t triangles) {
    dp_source *source;
    const dp_shape one = {.name = name, .triangles = triangles};
    assert_int_equal(dp_source_from_shape(&one, &source, NULL), DP_OK);
    return source;
}

/* A source as a binary STL on disk. The caller destroys both. */
static dp_source *stl_of(dp_source *made) {
    char path[300];
    dp_source *source;
    temporary_name(path, sizeof path, "join");
    const int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    assert_int_equal(dp_io_write_mesh(path, DP_MESH_FILE_STL, made, NULL, NULL, NULL), DP_OK);
    assert_int_equal(dp_source_open(path, NULL, &source, NULL), DP_OK);
    close(descriptor);
    unlink(path);
    return source;
}

static const char faces_of_two_walls[] = "f 1 2 3 4\nf 5 6 7 8\n";

/* Two walls that cross: in two files, and in one. */
static void a_scene_looks_like_one_file(void **state) {
    (void)state;
    static picture whole, halves;
    static const char first[] = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n",
                      second[] = "v 0 -1 -1\nv 0 -1 1\nv 0 1 1\nv 0 1 -1\nf 1 2 3 4\n";
    char both[400];
    snprintf(both, sizeof both, "%.*s%.*s%s", (int)(strstr(first, "f ") - first), first,
             (int)(strstr(second, "f ") - second), second, faces_of_two_walls);
    dp_source *one = file_of(both, "both.obj");
    dp_source *parts[] = {file_of(first, "a.obj"), file_of(second, "b.obj")};
    dp_source *const two = join(parts, NULL, 2);
    draw(one, NULL, 0, &whole, NULL);
    draw(two, NULL, 0, &halves, NULL);
    assert_memory_equal(whole.rgba, halves.rgba, sizeof whole.rgba);
    dp_source_destroy(one), dp_source_destroy(two);
}

/* A sphere has no normals of its own; a triangle out of sight has some, which change nothing. */
static void missing_normals_are_made(void **state) {
    (void)state;
    static picture alone, beside;
    const dp_style style = {.lines = DP_NO_LINES, .shade.shading = DP_SHADING_LAMBERT};
    float far[9];
    dp_batch with = triangle_batch();
    for (int k = 0; k < 9; k++) far[k] = triangle[k] + 90;
    with.positions = far;
    with.normals = (dp_attribute){.values = normals, .count = 3};
    dp_source *const sphere = shape("sphere", 500);
    draw(sphere, &style, 0, &alone, NULL);
    for (int first = 0; first < 2; first++) {
        dp_source *parts[2];
        parts[first] = shape("sphere", 500), parts[1 - first] = source_of(&with);
        dp_source *const joined = join(parts, NULL, 2);
        for (int frame = 0; frame < 2; frame++) {
            draw(joined, &style, 0, &beside, NULL);
            assert_memory_equal(alone.rgba, beside.rgba, sizeof alone.rgba);
        }
        dp_source_destroy(joined);
    }
    dp_source_destroy(sphere);
}

/* A scene of large binary STLs is that of one file with all their triangles, in memory and in parts. */
static void large_scenes_are_streamed(void **state) {
    (void)state;
    enum { TRIANGLES = DP_TUNED(150000, 500) }; /* too many for 48 MB; tiny steps would take long */
    static picture whole, parted;
    static const char *const shapes[] = {"sphere", "terrain", "torus"};
    static const size_t memories[] = {SIZE_MAX / 2, 48 << 20};
    const dp_style style = {.lines = DP_SILHOUETTE | DP_RIDGE | DP_VALLEY};
    dp_source *parts[3];
    for (int k = 0; k < 3; k++) {
        dp_source *const made = shape(shapes[k], TRIANGLES);
        parts[k] = stl_of(made);
        dp_source_destroy(made);
    }
    dp_source *const joined = join(parts, NULL, 3), *const one = stl_of(joined);
    assert_true(joined->records.read && joined->records.count == one->records.count);
    for (int m = 0; m < 2; m++) {
        dp_stats of_one, of_joined;
        draw(one, &style, memories[m], &whole, &of_one);
        draw(joined, &style, memories[m], &parted, &of_joined);
        assert_int_equal(of_one.polygons, of_joined.polygons);
        assert_memory_equal(whole.rgba, parted.rgba, sizeof whole.rgba);
    }
    dp_extent of_one, of_joined;
    assert_int_equal(dp_source_extent(one, &of_one, NULL), DP_OK);
    assert_int_equal(dp_source_extent(joined, &of_joined, NULL), DP_OK);
    assert_memory_equal(&of_one, &of_joined, sizeof of_one);
    dp_source_destroy(joined), dp_source_destroy(one);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(batches_come_in_order_in_every_reading),
        cmocka_unit_test(groups_have_names_of_their_files),
        cmocka_unit_test(a_failing_source_is_named),
        cmocka_unit_test(what_can_be_read_once_makes_a_scene_of_that_kind),
        cmocka_unit_test(wrong_calls_leave_the_sources),
        cmocka_unit_test(memory_may_fail_anywhere),
        cmocka_unit_test(a_scene_looks_like_one_file),
        cmocka_unit_test(missing_normals_are_made),
        cmocka_unit_test(a_scene_moves_with_all_its_parts),
        cmocka_unit_test(large_scenes_are_streamed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
