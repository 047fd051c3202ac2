/* dp_draw: the same picture, bit for bit, for any number of threads; contexts that do not disturb
 * each other; memory that runs out at any point. */
#include <drypoint/drypoint.h>

#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 200, HEIGHT = 150, PIXELS = WIDTH * HEIGHT };

/* All that a drawing gives; zeroed first, so that it can be compared as a block. */
typedef struct picture {
    uint8_t rgba[4 * PIXELS];
    float depth[PIXELS];
    uint8_t line_class[PIXELS];
    float normal[3 * PIXELS];
    dp_segment *segments;
    size_t count;
} picture;

static dp_result draw(const dp_context_desc *desc, const char *name, const dp_style *style,
                      picture *out, dp_diag *diag) {
    dp_context *context = NULL;
    dp_source *source = NULL;
    dp_camera camera;
    dp_extent extent;
    const dp_shape shape = {.name = name, .allocator = desc->allocator};
    memset(out, 0, sizeof *out);
    dp_result result = dp_source_from_shape(&shape, &source, diag);
    if (!result) result = dp_source_extent(source, &extent, diag);
    if (!result) result = dp_context_create(desc, &context, diag);
    if (!result) {
        dp_fit fit = {0};
        memcpy(fit.min, extent.min, sizeof fit.min);
        memcpy(fit.max, extent.max, sizeof fit.max);
        result = dp_camera_fit(&camera, &fit);
    }
    const dp_target target = {.width = WIDTH,
                              .height = HEIGHT,
                              .rgba = out->rgba,
                              .depth = out->depth,
                              .line_class = out->line_class,
                              .normal = out->normal};
    if (!result) result = dp_draw(context, source, &camera, style, &target, diag);
    dp_stats stats = {0};
    dp_stats_of(context, &stats);
    const dp_segment *const segments = result ? NULL : dp_segments(context, &out->count);
    if (!result && stats.segments && !segments) /* no memory for their chains */
        result = diag->result = DP_ERR_MEMORY;
    if (!result) {
        out->segments = calloc(out->count + 1, sizeof *segments);
        assert_non_null(out->segments);
        if (out->count) memcpy(out->segments, segments, out->count * sizeof *segments);
    }
    dp_source_destroy(source);
    dp_context_destroy(context);
    return result;
}

static void assert_same_segment(const dp_segment *a, const dp_segment *b) {
    assert_int_equal(a->line, b->line);
    assert_memory_equal(a->a, b->a, sizeof a->a);
    assert_memory_equal(a->b, b->b, sizeof a->b);
    assert_memory_equal(a->world_a, b->world_a, sizeof a->world_a);
    assert_memory_equal(a->world_b, b->world_b, sizeof a->world_b);
    assert_true(a->polygon == b->polygon && a->other == b->other && a->edge == b->edge);
    assert_true(a->width == b->width && a->color == b->color);
}

static void assert_same(const picture *a, const picture *b) {
    assert_memory_equal(a->rgba, b->rgba, sizeof a->rgba);
    assert_memory_equal(a->depth, b->depth, sizeof a->depth);
    assert_memory_equal(a->line_class, b->line_class, sizeof a->line_class);
    assert_memory_equal(a->normal, b->normal, sizeof a->normal);
    assert_int_equal(a->count, b->count);
    for (size_t i = 0; i < a->count; i++) assert_same_segment(&a->segments[i], &b->segments[i]);
}

static void backwards(void *user, uint32_t count, void (*task)(void *arg, uint32_t index),
                      void *arg) {
    (void)user;
    while (count) task(arg, --count);
}

/* More threads than the context has workers. */
typedef struct crowd {
    void (*task)(void *arg, uint32_t index);
    void *arg;
    uint32_t count;
    atomic_uint next;
} crowd;

static void *crowd_main(void *arg) {
    crowd *const c = arg;
    for (uint32_t i; (i = atomic_fetch_add(&c->next, 1)) < c->count;) c->task(c->arg, i);
    return NULL;
}

static void crowded(void *user, uint32_t count, void (*task)(void *arg, uint32_t index),
                    void *arg) {
    enum { THREADS = 6 };
    pthread_t threads[THREADS];
    crowd c = {.task = task, .arg = arg, .count = count};
    (void)user;
    for (int i = 0; i < THREADS; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, crowd_main, &c), 0);
    for (int i = 0; i < THREADS; i++) pthread_join(threads[i], NULL);
}

static const char *const shapes[] = {"cube", "boxes", "bracket", "gear", "terrain"};
enum { SHAPES = sizeof shapes / sizeof *shapes };
static picture reference, other;

static void check_threads(const dp_style *style) {
    for (int i = 0; i < SHAPES; i++) {
        assert_int_equal(draw(&(dp_context_desc){.threads = 1}, shapes[i], style, &reference, NULL),
                         DP_OK);
        assert_true(reference.count || (style && style->ink == DP_INK_QUADS));
        const dp_context_desc descs[] = {{.threads = 2},
                                         {.threads = 7},
                                         {.threads = 3, .parallel_for = backwards},
                                         {.threads = 2, .parallel_for = crowded}};
        for (size_t k = 0; k < sizeof descs / sizeof *descs; k++) {
            assert_int_equal(draw(&descs[k], shapes[i], style, &other, NULL), DP_OK);
            assert_same(&reference, &other);
            free(other.segments);
        }
        free(reference.segments);
    }
}

static void any_number_of_threads_draws_the_same(void **state) {
    (void)state;
    check_threads(NULL);
}

static void wide_lines_too(void **state) {
    (void)state;
    dp_style style = {0};
    for (int i = 0; i < DP_LINE_COUNT; i++) {
        style.line[i].width = (float)(3 + 4 * i);
        style.line[i].color = DP_RGB(40 * i, 0, 255 - 40 * i);
    }
    check_threads(&style);
}

/* Two contexts at once, each in its own thread. */
typedef struct job {
    picture picture;
    const char *shape;
    dp_result result;
} job;

static void *draw_job(void *arg) {
    job *const j = arg;
    j->result = draw(&(dp_context_desc){.threads = 2}, j->shape, NULL, &j->picture, NULL);
    return NULL;
}

static void contexts_do_not_disturb_each_other(void **state) {
    (void)state;
    static job jobs[2];
    for (int round = 0; round < 3; round++) {
        pthread_t threads[2];
        for (int i = 0; i < 2; i++) {
            jobs[i].shape = shapes[2 + i];
            assert_int_equal(pthread_create(&threads[i], NULL, draw_job, &jobs[i]), 0);
        }
        for (int i = 0; i < 2; i++) pthread_join(threads[i], NULL);
        for (int i = 0; i < 2; i++) {
            assert_int_equal(jobs[i].result, DP_OK);
            assert_int_equal(
                draw(&(dp_context_desc){.threads = 1}, jobs[i].shape, NULL, &reference, NULL),
                DP_OK);
            assert_same(&reference, &jobs[i].picture);
            free(reference.segments);
            free(jobs[i].picture.segments);
        }
    }
}

/* An allocator that fails from its n-th call on. */
typedef struct stingy {
    atomic_int left, held;
} stingy;

static void *stingy_alloc(size_t size, void *user) {
    stingy *const s = user;
    if (atomic_fetch_sub(&s->left, 1) <= 0) return NULL;
    atomic_fetch_add(&s->held, 1);
    return malloc(size);
}
static void *stingy_realloc(void *block, size_t size, void *user) {
    stingy *const s = user;
    if (atomic_fetch_sub(&s->left, 1) <= 0) return NULL;
    if (!block) atomic_fetch_add(&s->held, 1);
    return realloc(block, size);
}
static void stingy_free(void *block, void *user) {
    if (block) atomic_fetch_sub(&((stingy *)user)->held, 1);
    free(block);
}

static void memory_may_run_out_anywhere(void **state) {
    (void)state;
    dp_result result = DP_ERR_MEMORY;
    int allowed = 0;
    for (; result && allowed < 20000; allowed += 1 + allowed / 16) {
        stingy s = {allowed, 0};
        const dp_allocator memory = {stingy_alloc, stingy_realloc, stingy_free, &s};
        dp_diag diag = {0};
        result = draw(&(dp_context_desc){.threads = 2, .allocator = &memory}, "boxes", NULL, &other,
                      &diag);
        if (result) {
            assert_int_equal(result, DP_ERR_MEMORY);
            assert_int_equal(diag.result, DP_ERR_MEMORY);
        }
        assert_int_equal(atomic_load(&s.held), 0);
    }
    assert_int_equal(result, DP_OK);
    assert_int_equal(draw(&(dp_context_desc){.threads = 1}, "boxes", NULL, &reference, NULL),
                     DP_OK);
    assert_same(&reference, &other);
    free(reference.segments);
    free(other.segments);
}

/* Progress that says stop. */
static int stop_at_once(void *user, double fraction) {
    assert_true(fraction >= 0 && fraction <= 1);
    (*(int *)user)++;
    return 1;
}

static void progress_can_stop_a_drawing(void **state) {
    (void)state;
    int calls = 0;
    dp_diag diag = {0};
    const dp_context_desc desc = {.threads = 2, .progress = stop_at_once, .user = &calls};
    assert_int_equal(draw(&desc, "bracket", NULL, &other, &diag), DP_ERR_CANCELLED);
    assert_int_equal(diag.result, DP_ERR_CANCELLED);
    assert_int_equal(calls, 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_number_of_threads_draws_the_same),
        cmocka_unit_test(wide_lines_too),
        cmocka_unit_test(contexts_do_not_disturb_each_other),
        cmocka_unit_test(memory_may_run_out_anywhere),
        cmocka_unit_test(progress_can_stop_a_drawing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
