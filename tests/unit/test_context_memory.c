/* A context's memory: all of it is freed whichever allocation fails, and later frames allocate
 * none. */
#include "drawing.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

/* Counts what is alive, and fails at allocation number `fail_at`; 0: never. */
typedef struct meter {
    atomic_long alive, calls, fail_at;
} meter;

static bool fails(meter *m) {
    return atomic_fetch_add(&m->calls, 1) + 1 == atomic_load(&m->fail_at);
}

static void *meter_alloc(size_t size, void *user) {
    meter *m = user;
    void *block = fails(m) ? NULL : malloc(size ? size : 1);
    if (block) atomic_fetch_add(&m->alive, 1);
    return block;
}

static void *meter_realloc(void *block, size_t size, void *user) {
    meter *m = user;
    void *moved = fails(m) ? NULL : realloc(block, size ? size : 1);
    if (moved && !block) atomic_fetch_add(&m->alive, 1);
    return moved;
}

static void meter_free(void *block, void *user) {
    meter *m = user;
    if (block) atomic_fetch_sub(&m->alive, 1);
    free(block);
}

/* One drawing, every `at`-th allocation failing. True: it came through without meeting the
 * failure. */
static bool draw_with_failure(const char *shape, uint32_t threads, long at,
                              const uint8_t *expected) {
    meter m = {0};
    const dp_allocator allocator = {meter_alloc, meter_realloc, meter_free, &m};
    const dp_context_desc desc = {.allocator = &allocator, .threads = threads};
    static uint8_t rgba[BYTES];
    dp_context *context = NULL;
    dp_diag diag = {0};
    dp_source *source = new_shape(shape, NULL);
    atomic_store(&m.fail_at, at);
    dp_result result = dp_context_create(&desc, &context, &diag);
    if (result == DP_OK)
        result = draw(context, source, rgba, &diag);
    else
        assert_null(context);
    if (result != DP_OK && result != DP_ERR_MEMORY && result != DP_ERR_LIMIT)
        fail_msg("%s, allocation %ld: %s", shape, at, dp_result_name(result));
    if (result != DP_OK) {
        assert_int_equal(diag.result, result);
        assert_true(diag.message[0] != 0);
    }
    const bool met = atomic_load(&m.calls) >= at;
    if (result == DP_OK && memcmp(rgba, expected, BYTES) != 0)
        fail_msg("%s, allocation %ld: another picture", shape, at);
    if (!met) assert_int_equal(result, DP_OK);
    atomic_store(&m.fail_at, 0);
    if (context != NULL) { /* there is memory again: as if nothing had been */
        assert_int_equal(draw(context, source, rgba, &diag), DP_OK);
        if (memcmp(rgba, expected, BYTES) != 0)
            fail_msg("%s, after allocation %ld: another picture", shape, at);
    }
    dp_context_destroy(context);
    dp_source_destroy(source);
    if (atomic_load(&m.alive) != 0)
        fail_msg("%s, allocation %ld: %ld blocks leak", shape, at, atomic_load(&m.alive));
    return !met;
}

/* Beyond so many allocations they are much alike: then not every one is made to fail. The thread
 * sanitizer looks for races, not for leaks, and is slow: it sees fewer, and only with threads. */
#ifdef __SANITIZE_THREAD__
enum { ALIKE = 60, FEWEST_THREADS = 2 };
#elif defined __SANITIZE_ADDRESS__
enum { ALIKE = 150, FEWEST_THREADS = 1 };
#else
enum { ALIKE = 400, FEWEST_THREADS = 1 };
#endif

static long next_failure(long at) { return at + (at < ALIKE ? 1 : at * 8 / ALIKE); }

static void every_allocation_may_fail(void **state) {
    static const char *const shapes[] = {"boxes", "gear", "terrain"};
    (void)state;
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; s++) {
        static uint8_t expected[BYTES];
        dp_context *context = NULL;
        dp_source *source = new_shape(shapes[s], NULL);
        assert_int_equal(dp_context_create(NULL, &context, NULL), DP_OK);
        assert_int_equal(draw(context, source, expected, NULL), DP_OK);
        dp_context_destroy(context);
        dp_source_destroy(source);
        for (uint32_t threads = FEWEST_THREADS; threads <= 2; threads++) {
            long at = 1;
            while (!draw_with_failure(shapes[s], threads, at, expected)) {
                at = next_failure(at);
                if (at > 1000000) fail_msg("%s: never ends", shapes[s]);
            }
            assert_true(at > 10);
        }
    }
}

/* The same for what the immediate interface records. */
static void recording_may_run_out_of_memory(void **state) {
    (void)state;
    for (long at = 1;; at = next_failure(at)) {
        meter m = {0};
        const dp_allocator allocator = {meter_alloc, meter_realloc, meter_free, &m};
        const dp_context_desc desc = {.allocator = &allocator, .threads = 1};
        const dp_camera camera = camera_of(2, 1.5, 2.5);
        static uint8_t rgba[BYTES];
        const dp_target target = {.width = WIDTH, .height = HEIGHT, .rgba = rgba};
        dp_context *context = NULL;
        dp_diag diag = {0};
        atomic_store(&m.fail_at, at);
        if (dp_context_create(&desc, &context, &diag) == DP_OK) {
            dp_set_camera(context, &camera);
            dp_enable(context, DP_SIL_RIDGE_VALLEY);
            dp_begin(context, DP_TRIANGLE_STRIP);
            for (int i = 0; i < 3000; i++)
                dp_vertex3f(context, (float)i / 1500 - 1, (float)(i % 2), (float)sin(i * 0.01));
            dp_end(context);
            const dp_result result = dp_finish(context, &target, &diag);
            if (result != DP_OK) assert_int_equal(result, DP_ERR_MEMORY);
        }
        const bool met = atomic_load(&m.calls) >= at;
        dp_context_destroy(context);
        assert_int_equal(atomic_load(&m.alive), 0);
        if (!met) break;
        assert_true(at < 100000);
    }
}

/* Counts calls that get memory. */
static void *counting_alloc(size_t size, void *user) {
    ++*(size_t *)user;
    return malloc(size);
}
static void *counting_realloc(void *block, size_t size, void *user) {
    ++*(size_t *)user;
    return realloc(block, size);
}
static void counting_free(void *block, void *user) {
    (void)user;
    free(block);
}

/* With one worker the second frame finds all memory where the first left it. */
static void later_frames_allocate_nothing(void **state) {
    static const char *const shapes[] = {"gear", "boxes", "terrain"};
    static uint8_t rgba[BYTES];
    (void)state;
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        size_t count = 0;
        const dp_allocator allocator = {counting_alloc, counting_realloc, counting_free, &count};
        const dp_context_desc desc = {.allocator = &allocator, .threads = 1};
        dp_context *context = NULL;
        dp_source *source = new_shape(shapes[i], NULL);
        assert_int_equal(dp_context_create(&desc, &context, NULL), DP_OK);
        assert_int_equal(draw(context, source, rgba, NULL), DP_OK);
        assert_true(count > 0);
        count = 0;
        for (int frame = 0; frame < 3; frame++)
            assert_int_equal(draw(context, source, rgba, NULL), DP_OK);
        assert_int_equal(count, 0);
        dp_context_destroy(context);
        dp_source_destroy(source);
    }
}

/* Grants no block above 64 MB. */
static void *small_alloc(size_t size, void *user) {
    (void)user;
    return size > (size_t)64 << 20 ? NULL : malloc(size);
}
static void *small_realloc(void *block, size_t size, void *user) {
    (void)user;
    return size > (size_t)64 << 20 ? NULL : realloc(block, size);
}
static void small_free(void *block, void *user) {
    (void)user;
    free(block);
}

/* The largest picture in every way that makes something of its size: where a size were to wrap, a
 * small block would be granted and written beyond. */
static void the_largest_picture_is_refused_in_time(void **state) {
    static const dp_style styles[] = {
        {0},
        {.ink = DP_INK_QUADS},
        {.shade = {.shading = DP_SHADING_TOON}},
        {.edge_map = {.detector = DP_EDGE_MAP_C1}},
        {.mirror = {.normal = {0, 1, 0}, .offset = -1, .size = 4, .fade = 1}},
    };
    static uint8_t rgba[4]; /* nothing gets so far as to write it */
    const dp_result expected = sizeof(size_t) > 4 ? DP_ERR_MEMORY : DP_ERR_LIMIT;
    const dp_allocator allocator = {small_alloc, small_realloc, small_free, NULL};
    const dp_context_desc desc = {.allocator = &allocator, .threads = 2};
    const dp_camera camera = camera_of(2, 1.5, 2.5);
    dp_context *context = NULL;
    dp_source *source = new_shape("cube", NULL);
    (void)state;
    assert_int_equal(dp_context_create(&desc, &context, NULL), DP_OK);
    for (size_t i = 0; i < sizeof styles / sizeof *styles; i++)
        for (uint32_t samples = 1; samples <= 16; samples += samples == 1 ? 3 : samples) {
            dp_diag diag = {0};
            const dp_target target = {
                .width = 32768, .height = 32768, .samples = samples, .rgba = rgba};
            assert_int_equal(dp_draw(context, source, &camera, &styles[i], &target, &diag),
                             expected);
            assert_int_equal(diag.result, expected);
        }
    dp_context_destroy(context);
    dp_source_destroy(source);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(recording_may_run_out_of_memory),
        cmocka_unit_test(later_frames_allocate_nothing),
        cmocka_unit_test(the_largest_picture_is_refused_in_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
