/* The same input gives the same bytes: for any number of threads, again, in another context, with
 * any kernels. */
#include "base/hostile.h"
#include "base/kernels.h"

#include <drypoint/drypoint.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = DP_TUNED(320, 160), HEIGHT = DP_TUNED(240, 120), THREADS = 3 };

/* In tiny steps models take turns: each draws every third of the views and looks, and all of them together all. */
enum { TURNS = DP_TUNED(1, 3) };

/* Of models: fewer where the sanitizers make every one of them dear. */
#ifdef __SANITIZE_ADDRESS__
enum { TRIANGLES = DP_TUNED(5000, 1500) };
#else
enum { TRIANGLES = 20000 };
#endif

static const uint32_t thread_counts[THREADS] = {1, 2, 7};

/* Everything a drawing leaves behind. */
typedef struct result {
    uint8_t rgba[4 * WIDTH * HEIGHT];
    uint8_t line_class[WIDTH * HEIGHT];
    float depth[WIDTH * HEIGHT];
    float normal[3 * WIDTH * HEIGHT];
    float eye_normal[3 * WIDTH * HEIGHT]; /* of shaded drawings: the G-buffer */
    float distance[WIDTH * HEIGHT];
    uint16_t id[WIDTH * HEIGHT];
    uint8_t edge_map[4 * WIDTH * HEIGHT];
    dp_segment *segments;
    size_t segment_count;
} result;

static result results[2];

static void draw(dp_context *context, dp_source *source, const dp_camera *camera,
                 const dp_style *style, uint32_t samples, result *out) {
    const bool shaded = style && (style->shade.shading || style->edge_map.detector);
    const dp_target target = {.width = WIDTH,
                              .height = HEIGHT,
                              .samples = samples,
                              .rgba = out->rgba,
                              .line_class = out->line_class,
                              .depth = out->depth,
                              .normal = out->normal,
                              .eye_normal = shaded ? out->eye_normal : NULL,
                              .distance = shaded ? out->distance : NULL,
                              .id = shaded ? out->id : NULL,
                              .edge_map = shaded ? out->edge_map : NULL};
    dp_diag diag = {0};
    memset(out->rgba, 0x33, sizeof out->rgba);
    if (dp_draw(context, source, camera, style, &target, &diag) != DP_OK)
        fail_msg("%s", diag.message);
    size_t count = 0;
    const dp_segment *segments = dp_segments(context, &count);
    free(out->segments);
    out->segments = malloc((count + 1) * sizeof *segments);
    assert_non_null(out->segments);
    if (count > 0) memcpy(out->segments, segments, count * sizeof *segments);
    out->segment_count = count;
}

/* Member by member: what lies between members may be anything. */
static bool same_segment(const dp_segment *a, const dp_segment *b) {
    return a->line == b->line && !memcmp(a->a, b->a, sizeof a->a) &&
           !memcmp(a->b, b->b, sizeof a->b) && !memcmp(a->world_a, b->world_a, sizeof a->world_a) &&
           !memcmp(a->world_b, b->world_b, sizeof a->world_b) && a->polygon == b->polygon &&
           a->other == b->other && a->edge == b->edge && a->color == b->color &&
           !memcmp(&a->width, &b->width, sizeof a->width);
}

static void expect_same(const result *a, const result *b, const char *what, const char *how) {
    if (memcmp(a->rgba, b->rgba, sizeof a->rgba) != 0) fail_msg("%s, %s: other colours", what, how);
    if (memcmp(a->line_class, b->line_class, sizeof a->line_class) != 0)
        fail_msg("%s, %s: other classes", what, how);
    if (memcmp(a->depth, b->depth, sizeof a->depth) != 0)
        fail_msg("%s, %s: other depth", what, how);
    if (memcmp(a->normal, b->normal, sizeof a->normal) != 0)
        fail_msg("%s, %s: other normals", what, how);
    if (memcmp(a->eye_normal, b->eye_normal, sizeof a->eye_normal) ||
        memcmp(a->id, b->id, sizeof a->id) ||
        memcmp(a->distance, b->distance, sizeof a->distance) ||
        memcmp(a->edge_map, b->edge_map, sizeof a->edge_map))
        fail_msg("%s, %s: another G-buffer", what, how);
    if (a->segment_count != b->segment_count)
        fail_msg("%s, %s: %zu segments, not %zu", what, how, b->segment_count, a->segment_count);
    for (size_t i = 0; i < a->segment_count; i++)
        if (!same_segment(&a->segments[i], &b->segments[i]))
            fail_msg("%s, %s: segment %zu differs", what, how, i);
}

static dp_context *new_context(uint32_t threads) {
    const dp_context_desc desc = {.threads = threads};
    dp_context *context = NULL;
    assert_int_equal(dp_context_create(&desc, &context, NULL), DP_OK);
    return context;
}

static dp_source *new_shape(const char *name, uint64_t triangles) {
    const dp_shape shape = {.name = name, .triangles = triangles};
    dp_source *source = NULL;
    assert_int_equal(dp_source_from_shape(&shape, &source, NULL), DP_OK);
    return source;
}

static dp_camera fitted_as(dp_source *source, dp_fit fit) {
    dp_extent extent;
    dp_camera camera;
    fit.aspect = (double)WIDTH / HEIGHT;
    assert_int_equal(dp_source_extent(source, &extent, NULL), DP_OK);
    memcpy(fit.min, extent.min, sizeof fit.min);
    memcpy(fit.max, extent.max, sizeof fit.max);
    assert_int_equal(dp_camera_fit(&camera, &fit), DP_OK);
    return camera;
}

static dp_camera fitted(dp_source *source) { return fitted_as(source, (dp_fit){0}); }

/* Draws with 1, 2 and 7 threads, and with 7 once more. */
static void check(dp_source *source, const dp_style *style, uint32_t samples, const char *what) {
    const dp_camera camera = fitted(source);
    for (int i = 0; i < THREADS; i++) {
        dp_context *context = new_context(thread_counts[i]);
        draw(context, source, &camera, style, samples, &results[i > 0]);
        if (i > 0) expect_same(&results[0], &results[1], what, "threads");
        draw(context, source, &camera, style, samples, &results[1]);
        expect_same(&results[0], &results[1], what, "drawn again");
        dp_context_destroy(context);
    }
}

static void every_shape(void **state) {
    const dp_style style = {0};
    (void)state;
    for (uint32_t i = 0; i < dp_shape_count(); i++) {
        dp_source *source = new_shape(dp_shape_name(i), TRIANGLES);
        check(source, &style, 4, dp_shape_name(i));
        dp_source_destroy(source);
    }
}

static void every_mode(void **state) {
    static const char *const names[] = {"boxes", "stairs"};
    (void)state;
    for (int n = 0; n < 2; n++) {
        dp_source *source = new_shape(names[n], 0);
        for (int ink = DP_INK_STROKES; ink <= DP_INK_QUADS; ink++) {
            for (int between = DP_BETWEEN_PLANE; between <= DP_BETWEEN_STENCIL; between++) {
                for (int method = DP_METHOD_EXACT; method <= DP_METHOD_PAPER; method++) {
                    const dp_style style = {.ink = (dp_ink)ink,
                                            .between = (dp_between)between,
                                            .method = (dp_method)method,
                                            .line[DP_LINE_VALLEY].width = 5,
                                            .edge_table_off = n == 0};
                    check(source, &style, 4, names[n]);
                }
            }
        }
        dp_source_destroy(source);
    }
}

static void every_number_of_samples(void **state) {
    static const uint32_t samples[] = {1, 4, 8, 16};
    const dp_style style = {.line[DP_LINE_RIDGE].width = 12};
    dp_source *source = new_shape("gear", 0);
    (void)state;
    for (int i = 0; i < 4; i++) check(source, &style, samples[i], "gear");
    dp_source_destroy(source);
}

/* What a context drew before leaves no trace. */
static void contexts_remember_nothing(void **state) {
    const dp_style style = {0}, other = {.ridge_angle = 90, .lines = DP_RIDGE | DP_VALLEY};
    dp_source *gear = new_shape("gear", 0), *boxes = new_shape("boxes", 0);
    const dp_camera camera = fitted(gear), another = fitted(boxes);
    dp_context *fresh = new_context(2), *used = new_context(2);
    (void)state;
    draw(fresh, gear, &camera, &style, 4, &results[0]);
    draw(used, boxes, &another, &other, 16, &results[1]);
    draw(used, gear, &camera, &other, 1, &results[1]);
    draw(used, gear, &camera, &style, 4, &results[1]);
    expect_same(&results[0], &results[1], "gear", "after other drawings");
    dp_context_destroy(fresh);
    dp_context_destroy(used);
    dp_source_destroy(gear);
    dp_source_destroy(boxes);
}

/* Rows may be longer than the picture; what lies between them is not touched. */
static void stride_leaves_the_rest_alone(void **state) {
    enum { STRIDE = 4 * WIDTH + 28 };
    static uint8_t wide[STRIDE * HEIGHT];
    static const dp_style styles[] = {
        {0}, {.shade = {.shading = DP_SHADING_TOON}, .edge_map = {.detector = DP_EDGE_MAP_C1}}};
    dp_source *source = new_shape("gear", 0);
    const dp_camera camera = fitted(source);
    dp_context *context = new_context(2);
    const dp_target target = {
        .width = WIDTH, .height = HEIGHT, .rgba = wide, .rgba_stride = STRIDE};
    (void)state;
    for (int i = 0; i < 2; i++) {
        memset(wide, 0x77, sizeof wide);
        draw(context, source, &camera, &styles[i], 4, &results[0]);
        assert_int_equal(dp_draw(context, source, &camera, &styles[i], &target, NULL), DP_OK);
        for (int y = 0; y < HEIGHT; y++) {
            assert_memory_equal(wide + y * STRIDE, results[0].rgba + y * 4 * WIDTH, 4 * WIDTH);
            for (int x = 4 * WIDTH; x < STRIDE; x++) assert_int_equal(wide[y * STRIDE + x], 0x77);
        }
    }
    dp_context_destroy(context);
    dp_source_destroy(source);
}

/* Plain C and vectors of any width, in perspective and without, with lines and without. */
static void check_kernels(dp_source *source, const dp_camera *camera, const dp_style *style,
                          uint32_t samples, const char *what) {
    dp_width list[DP_WIDTHS_MOST];
    const uint32_t count = dp_widths_list(list);
    for (uint32_t i = 0; i < count; i++) {
        dp_context *const context = new_context(2);
        assert_int_equal(setenv("DRYPOINT_CPU", list[i].name, 1), 0);
        assert_int_equal(dp_lanes_best(), list[i].lanes);
        draw(context, source, camera, style, samples, &results[i > 0]);
        if (i > 0) expect_same(&results[0], &results[1], what, list[i].name);
        dp_context_destroy(context);
    }
    unsetenv("DRYPOINT_CPU");
}

static void every_kernel(void **state) {
    static const uint32_t samples[] = {1, 4, 8, 16};
    const dp_style styles[] = {{0},
                               {.lines = DP_NO_LINES},
                               {.ink = DP_INK_QUADS},
                               {.ink = DP_INK_QUADS, .method = DP_METHOD_PAPER}};
    (void)state;
    for (uint32_t i = 0; i < dp_shape_count(); i++) {
        dp_source *const source = new_shape(dp_shape_name(i), TRIANGLES);
        for (uint32_t k = i % TURNS; k < 12; k += TURNS) {
            const dp_camera camera = fitted_as(
                source, (dp_fit){.orthographic = k / 4 == 1, .zoom = k / 4 == 2 ? 30 : 1});
            check_kernels(source, &camera, &styles[k % 4], samples[(i + k) % 4], dp_shape_name(i));
        }
        dp_source_destroy(source);
    }
}

/* Every style and both detectors: any kernels, any number of threads, in a context that has drawn
 * other styles before. */
static void every_look(void **state) {
    static const char *const names[] = {"bolt", "boxes", "torus"};
    static const uint32_t samples[] = {4, 1, 8, 16};
    dp_context *const used = new_context(2);
    (void)state;
    for (uint32_t i = 0; i < 3; i++) {
        dp_source *const source = new_shape(names[i], TRIANGLES);
        for (uint32_t k = i % TURNS; k < 2 * DP_SHADING_COUNT; k += TURNS) {
            const dp_camera camera =
                fitted_as(source, (dp_fit){.orthographic = k % 4 == 1, .zoom = k % 4 == 2 ? 6 : 1});
            const dp_style style = {
                .lines = k % 3 ? DP_NO_LINES : DP_ALL_LINES,
                .ink = k % 6 == 3 ? DP_INK_QUADS : DP_INK_STROKES,
                .shade = {.shading = (dp_shading)(k / 2),
                          .object_space = k % 2,
                          .highlight = k % 4 == 3 ? 0.4f : 0,
                          .normals = k % 5 == 4 ? DP_NORMALS_FACET : DP_NORMALS_MODEL},
                .edge_map = {.detector = (dp_edge_detector)((k + i) % 3)}};
            check_kernels(source, &camera, &style, samples[(k / 2 + i) % 4], names[i]);
            draw(used, source, &camera, &style, samples[(k / 2 + i) % 4], &results[1]);
            expect_same(&results[0], &results[1], names[i], "after other drawings");
            if (k % 4 == 0) check(source, &style, 4, names[i]);
        }
        dp_source_destroy(source);
    }
    dp_context_destroy(used);
}

static int clean_up(void **state) {
    (void)state;
    free(results[0].segments);
    free(results[1].segments);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_shape),
        cmocka_unit_test(every_mode),
        cmocka_unit_test(every_number_of_samples),
        cmocka_unit_test(every_kernel),
        cmocka_unit_test(every_look),
        cmocka_unit_test(contexts_remember_nothing),
        cmocka_unit_test(stride_leaves_the_rest_alone),
    };
    return cmocka_run_group_tests(tests, NULL, clean_up);
}
