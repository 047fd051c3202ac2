/* Contexts: independent of each other, reusable after a cancelled drawing, on an application's own
 * threads, with plain messages about wrong arguments. */
#include "drawing.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>

/* Independence. */

typedef struct job {
    const char *shape;
    uint8_t rgba[BYTES];
    dp_result result;
} job;

static void *draw_job(void *arg) {
    job *j = arg;
    const dp_context_desc desc = {.threads = 2};
    dp_context *context = NULL;
    dp_source *source = new_shape(j->shape, NULL);
    j->result = dp_context_create(&desc, &context, NULL);
    for (int i = 0; i < 5 && j->result == DP_OK; i++)
        j->result = draw(context, source, j->rgba, NULL);
    dp_context_destroy(context);
    dp_source_destroy(source);
    return NULL;
}

static void contexts_work_side_by_side(void **state) {
    enum { JOBS = 4 };
    static const char *const shapes[JOBS] = {"gear", "boxes", "torus", "stairs"};
    static job together[JOBS], alone[JOBS];
    pthread_t threads[JOBS];
    (void)state;
    for (int i = 0; i < JOBS; i++) {
        together[i].shape = alone[i].shape = shapes[i];
        assert_int_equal(pthread_create(&threads[i], NULL, draw_job, &together[i]), 0);
    }
    for (int i = 0; i < JOBS; i++) assert_int_equal(pthread_join(threads[i], NULL), 0);
    for (int i = 0; i < JOBS; i++) {
        draw_job(&alone[i]);
        assert_int_equal(together[i].result, DP_OK);
        assert_memory_equal(together[i].rgba, alone[i].rgba, BYTES);
    }
}

/* Progress and cancelling. */

typedef struct progress {
    double last;
    int calls, stop_at; /* 0: never */
    bool backwards, outside;
} progress;

static int watch(void *user, double fraction) {
    progress *p = user;
    p->backwards |= fraction < p->last;
    p->outside |= !(fraction >= 0 && fraction <= 1);
    p->last = fraction;
    return ++p->calls == p->stop_at;
}

static void progress_runs_forward_and_can_stop(void **state) {
    static uint8_t expected[BYTES], rgba[BYTES];
    progress seen = {0};
    const dp_context_desc desc = {.threads = 2, .progress = watch, .user = &seen};
    dp_context *context = NULL;
    dp_diag diag = {0};
    dp_source *source = new_shape("gear", NULL);
    (void)state;
    assert_int_equal(dp_context_create(&desc, &context, NULL), DP_OK);
    assert_int_equal(draw(context, source, expected, NULL), DP_OK);
    assert_true(seen.calls > 0 && !seen.backwards && !seen.outside);
    const int calls = seen.calls;
    for (int stop = 1; stop <= calls; stop++) {
        seen = (progress){.stop_at = stop};
        assert_int_equal(draw(context, source, rgba, &diag), DP_ERR_CANCELLED);
        assert_int_equal(diag.result, DP_ERR_CANCELLED);
        assert_int_equal(seen.calls, stop); /* not asked again */
        seen = (progress){0};
        assert_int_equal(draw(context, source, rgba, NULL), DP_OK);
        assert_memory_equal(rgba, expected, BYTES);
    }
    dp_context_destroy(context);
    dp_source_destroy(source);
}

/* Someone else's threads. */

typedef struct pool {
    int threads, loops;
    uint32_t most;
} pool;

typedef struct share {
    void (*task)(void *arg, uint32_t index);
    void *arg;
    uint32_t count;
    atomic_uint next;
} share;

static void *work(void *user) {
    share *s = user;
    for (;;) {
        const uint32_t i = atomic_fetch_add(&s->next, 1);
        if (i >= s->count) return NULL;
        s->task(s->arg, s->count - 1 - i); /* any order will do */
    }
}

static void run_parallel(void *user, uint32_t count, void (*task)(void *arg, uint32_t index),
                         void *arg) {
    pool *p = user;
    share s = {.task = task, .arg = arg, .count = count};
    pthread_t threads[8];
    int started = 0;
    p->loops++;
    if (count > p->most) p->most = count;
    while (started < p->threads && pthread_create(&threads[started], NULL, work, &s) == 0)
        started++;
    work(&s);
    for (int i = 0; i < started; i++) pthread_join(threads[i], NULL);
}

static void parallel_for_may_be_the_applications(void **state) {
    static uint8_t expected[BYTES], rgba[BYTES];
    dp_context *context = NULL;
    dp_source *source = new_shape("gear", NULL);
    (void)state;
    assert_int_equal(dp_context_create(NULL, &context, NULL), DP_OK);
    assert_int_equal(draw(context, source, expected, NULL), DP_OK);
    dp_context_destroy(context);
    for (int threads = 0; threads <= 5; threads += 5) {
        for (uint32_t asked = 0; asked <= 3; asked += 3) {
            pool own = {.threads = threads};
            const dp_context_desc desc = {
                .threads = asked, .parallel_for = run_parallel, .user = &own};
            assert_int_equal(dp_context_create(&desc, &context, NULL), DP_OK);
            assert_int_equal(draw(context, source, rgba, NULL), DP_OK);
            assert_memory_equal(rgba, expected, BYTES);
            assert_true(own.loops > 0);
            dp_context_destroy(context);
        }
    }
    dp_source_destroy(source);
}

/* Sources. */

/* A source that hands out a shape's batches, can be read once, and fails when told. */
typedef struct stream {
    dp_source *inner;
    int batches, fail_at;
    bool destroyed;
} stream;

static dp_result stream_next(void *user, dp_batch *batch, dp_diag *diag) {
    stream *s = user;
    if (++s->batches == s->fail_at) {
        if (diag) diag->result = DP_ERR_IO, strcpy(diag->message, "the wire is cut");
        return DP_ERR_IO;
    }
    return dp_source_next(s->inner, batch, diag);
}

static void stream_destroy(void *user) { ((stream *)user)->destroyed = true; }

static void streams_are_read_once(void **state) {
    static uint8_t expected[BYTES], rgba[BYTES];
    const dp_camera camera = camera_of(2, 1.5, 2.5);
    const dp_target target = {.width = WIDTH, .height = HEIGHT, .rgba = rgba};
    const dp_style styles[] = {
        {0},
        {.passes = 1, .ink = DP_INK_QUADS, .between = DP_BETWEEN_INTERVAL},
        {.passes = 2, .ink = DP_INK_QUADS},
    };
    dp_context *context = NULL;
    (void)state;
    assert_int_equal(dp_context_create(NULL, &context, NULL), DP_OK);
    for (size_t i = 0; i < sizeof styles / sizeof *styles; i++) {
        stream s = {.inner = new_shape("gear", NULL)};
        const dp_source_callbacks callbacks = {
            .user = &s, .next = stream_next, .destroy = stream_destroy};
        dp_source *once = NULL;
        dp_diag diag = {0};
        assert_int_equal(dp_draw(context, s.inner, &camera, &styles[i], &target, &diag), DP_OK);
        memcpy(expected, rgba, BYTES);
        assert_int_equal(dp_source_rewind(s.inner, NULL), DP_OK);
        assert_int_equal(dp_source_from_callbacks(&callbacks, NULL, &once, NULL), DP_OK);
        assert_false(dp_source_rewindable(once));
        if (dp_draw(context, once, &camera, &styles[i], &target, &diag) != DP_OK)
            fail_msg("style %zu: %s", i, diag.message);
        assert_memory_equal(rgba, expected, BYTES);
        dp_source_destroy(once);
        assert_true(s.destroyed);
        dp_source_destroy(s.inner);
    }
    dp_context_destroy(context);
}

static void a_failing_source_says_why(void **state) {
    static uint8_t rgba[BYTES];
    dp_context *context = NULL;
    (void)state;
    assert_int_equal(dp_context_create(NULL, &context, NULL), DP_OK);
    for (int at = 1; at <= 2; at++) {
        stream s = {.inner = new_shape("gear", NULL), .fail_at = at};
        const dp_source_callbacks callbacks = {
            .user = &s, .next = stream_next, .destroy = stream_destroy};
        dp_source *source = NULL;
        dp_diag diag = {0};
        assert_int_equal(dp_source_from_callbacks(&callbacks, NULL, &source, NULL), DP_OK);
        assert_int_equal(draw(context, source, rgba, &diag), DP_ERR_IO);
        assert_int_equal(diag.result, DP_ERR_IO);
        assert_string_equal(diag.message, "the wire is cut");
        dp_source_destroy(source);
        dp_source_destroy(s.inner);
    }
    dp_context_destroy(context);
}

/* Arguments. */

static void wrong_arguments_are_told(void **state) {
    static uint8_t rgba[BYTES];
    const dp_camera good_camera = camera_of(2, 1.5, 2.5);
    const dp_target good = {.width = WIDTH, .height = HEIGHT, .rgba = rgba};
    dp_context *context = NULL;
    dp_diag diag = {0};
    dp_source *source = new_shape("cube", NULL);
    (void)state;
    assert_int_equal(dp_context_create(NULL, NULL, &diag), DP_ERR_ARGUMENT);
    assert_int_equal(dp_context_create(NULL, &context, NULL), DP_OK);
    assert_int_equal(dp_draw(NULL, source, &good_camera, NULL, &good, &diag), DP_ERR_ARGUMENT);
    assert_int_equal(dp_draw(context, NULL, &good_camera, NULL, &good, &diag), DP_ERR_ARGUMENT);
    assert_int_equal(dp_draw(context, source, NULL, NULL, &good, &diag), DP_ERR_ARGUMENT);
    assert_int_equal(dp_draw(context, source, &good_camera, NULL, NULL, &diag), DP_ERR_ARGUMENT);
    const dp_target targets[] = {{.width = 0, .height = 10, .rgba = rgba},
                                 {.width = 10, .height = 0, .rgba = rgba},
                                 {.width = 32769, .height = 1, .rgba = rgba},
                                 {.width = 1, .height = 32769, .rgba = rgba},
                                 {.width = 10, .height = 10, .samples = 3, .rgba = rgba},
                                 {.width = 10, .height = 10, .samples = 32, .rgba = rgba},
                                 {.width = 10, .height = 10, .rgba_stride = 39, .rgba = rgba}};
    for (size_t i = 0; i < sizeof targets / sizeof *targets; i++) {
        diag = (dp_diag){0};
        if (dp_draw(context, source, &good_camera, NULL, &targets[i], &diag) != DP_ERR_ARGUMENT)
            fail_msg("target %zu was taken", i);
        assert_int_equal(diag.result, DP_ERR_ARGUMENT);
        assert_true(diag.message[0] != 0 && strchr(diag.message, '\n') == NULL);
    }
    const dp_style styles[] = {{.ridge_angle = -1},
                               {.ridge_angle = 360},
                               {.valley_angle = 400},
                               {.valley_angle = NAN},
                               {.lines = 1u << 9},
                               {.line[DP_LINE_VALLEY].width = 0.25f},
                               {.line[DP_LINE_VALLEY].width = 65},
                               {.line[DP_LINE_RIDGE].width = NAN},
                               {.method = (dp_method)5},
                               {.between = (dp_between)5},
                               {.ink = (dp_ink)5},
                               {.passes = 7},
                               {.passes = -1},
                               {.between_offset = -2},
                               {.edge_map = {.enhanced_count = 5}},
                               {.passes = 1, .ink = DP_INK_QUADS, .between = DP_BETWEEN_PLANE}};
    for (size_t i = 0; i < sizeof styles / sizeof *styles; i++) {
        diag = (dp_diag){0};
        if (dp_draw(context, source, &good_camera, &styles[i], &good, &diag) != DP_ERR_ARGUMENT)
            fail_msg("style %zu was taken", i);
        assert_int_equal(diag.result, DP_ERR_ARGUMENT);
        assert_true(diag.message[0] != 0);
        dp_style resolved;
        assert_int_equal(dp_style_resolve(&styles[i], &resolved, NULL), DP_ERR_ARGUMENT);
    }
    dp_camera cameras[4] = {good_camera, good_camera, good_camera, good_camera};
    cameras[0].view[5] = NAN;
    cameras[1].projection[0] = INFINITY;
    memset(cameras[2].view, 0, sizeof cameras[2].view);
    memset(cameras[3].projection, 0, sizeof cameras[3].projection);
    for (size_t i = 0; i < 4; i++) {
        diag = (dp_diag){0};
        if (dp_draw(context, source, &cameras[i], NULL, &good, &diag) != DP_ERR_ARGUMENT)
            fail_msg("camera %zu was taken", i);
    }
    assert_int_equal(dp_draw(context, source, &good_camera, NULL, &good, NULL), DP_OK);
    dp_context_destroy(context);
    dp_context_destroy(NULL);
    dp_source_destroy(source);
}

/* Every plane is optional. */
/* Each way to draw takes its own passes, and says which when it is given others. */
static void passes_have_a_range_for_each_ink(void **state) {
    static const struct {
        dp_style style;
        int least, most, usual;
        const char *range;
    } ways[] = {
        {{.ink = DP_INK_STROKES}, 1, 2, 2, "for strokes it must be 1 or 2"},
        {{.between = DP_BETWEEN_INTERVAL}, 1, 2, 2, "for strokes it must be 1 or 2"},
        {{.between = DP_BETWEEN_STENCIL}, 1, 2, 2, "for strokes it must be 1 or 2"},
        {{.ink = DP_INK_QUADS}, 2, 2, 2, "for quads with the plane test it must be 2"},
        {{.ink = DP_INK_QUADS, .between = DP_BETWEEN_INTERVAL},
         1,
         2,
         1,
         "for quads with the interval test it must be 1 or 2"},
        {{.ink = DP_INK_QUADS, .between = DP_BETWEEN_STENCIL},
         3,
         3,
         3,
         "for quads with the stencil test it must be 3"},
        {{.edges = DP_EDGES_ADJACENCY}, 1, 2, 1, "for lines by adjacency it must be 1 or 2"},
        {{.edges = DP_EDGES_ADJACENCY, .ink = DP_INK_QUADS},
         1,
         2,
         1,
         "for lines by adjacency it must be 1 or 2"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++)
        for (int passes = -1; passes <= 5; passes++) {
            dp_style style = ways[i].style, resolved, again;
            dp_diag diag = {0};
            char start[32];
            style.passes = passes;
            const dp_result result = dp_style_resolve(&style, &resolved, &diag);
            if (!passes || (passes >= ways[i].least && passes <= ways[i].most)) {
                if (result) fail_msg("way %zu, %d passes: %s", i, passes, diag.message);
                assert_int_equal(resolved.passes, passes ? passes : ways[i].usual);
                assert_int_equal(dp_style_resolve(&resolved, &again, NULL), DP_OK);
                assert_int_equal(again.passes, resolved.passes);
                continue;
            }
            assert_int_equal(result, DP_ERR_ARGUMENT);
            snprintf(start, sizeof start, "passes is %d; ", passes);
            if (strncmp(diag.message, start, strlen(start)) != 0 ||
                !strstr(diag.message, ways[i].range))
                fail_msg("way %zu, %d passes: \"%s\"", i, passes, diag.message);
        }
}

static void planes_are_optional(void **state) {
    static uint8_t rgba[BYTES], line_class[WIDTH * HEIGHT];
    static float depth[WIDTH * HEIGHT], normal[3 * WIDTH * HEIGHT];
    const dp_camera camera = camera_of(2, 1.5, 2.5);
    dp_context *context = NULL;
    dp_source *source = new_shape("gear", NULL);
    size_t count = 0;
    (void)state;
    assert_int_equal(dp_context_create(NULL, &context, NULL), DP_OK);
    for (int planes = 0; planes < 16; planes++) {
        const dp_target target = {.width = WIDTH,
                                  .height = HEIGHT,
                                  .rgba = planes & 1 ? rgba : NULL,
                                  .depth = planes & 2 ? depth : NULL,
                                  .line_class = planes & 4 ? line_class : NULL,
                                  .normal = planes & 8 ? normal : NULL};
        size_t now = 0;
        assert_int_equal(dp_draw(context, source, &camera, NULL, &target, NULL), DP_OK);
        assert_non_null(dp_segments(context, &now));
        if (planes > 0) assert_int_equal(now, count);
        count = now;
    }
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const float *n = normal + 3 * i;
        const double length = sqrt((double)(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]));
        if (isfinite(depth[i]))
            assert_true(fabs(length - 1) < 1e-4);
        else
            assert_true(length == 0);
        /* towards the eye */
        if (length > 0)
            assert_true((double)n[0] * 2 + (double)n[1] * 1.5 + (double)n[2] * 2.5 > -1.9);
    }
    dp_context_destroy(context);
    dp_source_destroy(source);
}

/* The smallest and the longest pictures. */
static void extreme_sizes(void **state) {
    static const uint32_t sizes[][2] = {{1, 1}, {1, 500}, {32768, 3}, {3, 32768}, {65, 129}};
    dp_context *context = NULL;
    dp_source *source = new_shape("gear", NULL);
    (void)state;
    assert_int_equal(dp_context_create(NULL, &context, NULL), DP_OK);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        const size_t bytes = (size_t)4 * sizes[i][0] * sizes[i][1];
        uint8_t *rgba = malloc(bytes);
        assert_non_null(rgba);
        memset(rgba, 0, bytes);
        dp_camera camera = camera_of(2, 1.5, 2.5);
        const double aspect = (double)sizes[i][0] / sizes[i][1];
        assert_int_equal(dp_camera_perspective(&camera, 40, aspect, 0.1, 20), DP_OK);
        const dp_target target = {.width = sizes[i][0], .height = sizes[i][1], .rgba = rgba};
        dp_diag diag = {0};
        if (dp_draw(context, source, &camera, NULL, &target, &diag) != DP_OK)
            fail_msg("%s", diag.message);
        for (size_t k = 3; k < bytes; k += 4) assert_int_equal(rgba[k], 255);
        free(rgba);
    }
    dp_context_destroy(context);
    dp_source_destroy(source);
}

/* What dp_draw counted adds up, and segments refer to polygons there are. */
static void statistics_and_segments_add_up(void **state) {
    static uint8_t rgba[BYTES];
    dp_context *context = NULL;
    dp_source *source = new_shape("gear", NULL);
    dp_extent extent;
    dp_stats stats;
    size_t count = 0;
    (void)state;
    assert_int_equal(dp_source_extent(source, &extent, NULL), DP_OK);
    assert_int_equal(dp_context_create(NULL, &context, NULL), DP_OK);
    assert_int_equal(draw(context, source, rgba, NULL), DP_OK);
    dp_stats_of(context, &stats);
    const dp_segment *segments = dp_segments(context, &count);
    assert_int_equal(stats.polygons, extent.polygons);
    assert_int_equal(stats.triangles, extent.corners - 2 * extent.polygons);
    assert_int_equal(stats.dropped, 0);
    assert_int_equal(stats.segments, count);
    assert_true(count > 50);
    assert_true(stats.bytes > 1000);
    assert_true(stats.frame_ms > 0);
    for (size_t i = 0; i < count; i++) {
        const dp_segment *s = &segments[i];
        assert_true((unsigned)s->line < DP_LINE_COUNT);
        assert_true(s->polygon < stats.polygons);
        assert_true(s->other == UINT64_MAX || s->other < stats.polygons);
        assert_true(s->edge < 3 || s->line == DP_LINE_INTERSECTION);
        assert_true(s->width == 2);
        for (int k = 0; k < 3; k++) {
            assert_true(isfinite(s->a[k]) && isfinite(s->b[k]));
            assert_true(fabs((double)s->world_a[k]) <= 1.001 &&
                        fabs((double)s->world_b[k]) <= 1.001);
        }
        assert_true(s->a[2] > 0.1f && s->b[2] < 20);
    }
    dp_context_destroy(context);
    dp_source_destroy(source);
}

/* What one picture took does not stay in the next one's statistics. */
static void statistics_are_of_the_last_picture(void **state) {
    static uint8_t rgba[BYTES];
    const dp_camera camera = camera_of(2, 1.5, 2.5);
    const dp_target target = {.width = WIDTH, .height = HEIGHT, .rgba = rgba};
    const dp_style pencil = {.shade = {.shading = DP_SHADING_PENCIL}};
    dp_context *context = NULL;
    dp_source *source = new_shape("torus", NULL);
    dp_stats stats;
    (void)state;
    assert_int_equal(dp_context_create(NULL, &context, NULL), DP_OK);
    assert_int_equal(dp_draw(context, source, &camera, &pencil, &target, NULL), DP_OK);
    dp_stats_of(context, &stats);
    assert_true(stats.curvature_ms > 0);
    assert_int_equal(dp_draw(context, source, &camera, NULL, &target, NULL), DP_OK);
    dp_stats_of(context, &stats);
    assert_true(stats.curvature_ms == 0);
    dp_context_destroy(context);
    dp_source_destroy(source);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(contexts_work_side_by_side),
        cmocka_unit_test(progress_runs_forward_and_can_stop),
        cmocka_unit_test(parallel_for_may_be_the_applications),
        cmocka_unit_test(streams_are_read_once),
        cmocka_unit_test(a_failing_source_says_why),
        cmocka_unit_test(wrong_arguments_are_told),
        cmocka_unit_test(passes_have_a_range_for_each_ink),
        cmocka_unit_test(planes_are_optional),
        cmocka_unit_test(extreme_sizes),
        cmocka_unit_test(statistics_and_segments_add_up),
        cmocka_unit_test(statistics_are_of_the_last_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
