/* base/threads: every index runs once, no two tasks have the same worker number at a time, on own
 * and foreign threads; and what happens when the system starts no more. */
#include <drypoint/draw.h>

#include "base/threads.h"

#include <errno.h>
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdint.h>
#include <time.h>

#include <cmocka.h>

enum { PIECES = 1000, LOOPS = 50 };

typedef struct tally {
    uint32_t workers;
    atomic_uint done[PIECES];
    atomic_uint busy[256];
    atomic_uint overlaps, strangers;
} tally;

static void count_piece(void *arg, uint32_t index, uint32_t worker) {
    tally *const t = arg;
    if (worker >= t->workers) {
        atomic_fetch_add(&t->strangers, 1);
        return;
    }
    if (atomic_fetch_add(&t->busy[worker], 1)) atomic_fetch_add(&t->overlaps, 1);
    atomic_fetch_add(&t->done[index], 1);
    atomic_fetch_sub(&t->busy[worker], 1);
}

static void check_loops(dp_threads *threads) {
    assert_non_null(threads);
    static tally t;
    t = (tally){.workers = dp_threads_count(threads)};
    for (int i = 0; i < LOOPS; i++) dp_parallel(threads, PIECES, count_piece, &t);
    for (int i = 0; i < PIECES; i++) assert_int_equal(atomic_load(&t.done[i]), LOOPS);
    assert_int_equal(atomic_load(&t.overlaps), 0);
    assert_int_equal(atomic_load(&t.strangers), 0);
}

static void every_piece_is_done_once_per_loop(void **state) {
    (void)state;
    const dp_allocator memory = dp_allocator_resolve(NULL);
    for (uint32_t count = 1; count <= 9; count += 2) {
        dp_threads *const threads = dp_threads_create(count, NULL, NULL, &memory);
        check_loops(threads);
        assert_int_equal(dp_threads_count(threads), count);
        dp_threads_destroy(threads);
    }
}

static void zero_means_a_thread_per_processor(void **state) {
    (void)state;
    const dp_allocator memory = dp_allocator_resolve(NULL);
    dp_threads *const threads = dp_threads_create(0, NULL, NULL, &memory);
    assert_true(dp_threads_count(threads) >= 1);
    check_loops(threads);
    dp_threads_destroy(threads);
}

static void no_work_calls_nobody(void **state) {
    (void)state;
    const dp_allocator memory = dp_allocator_resolve(NULL);
    dp_threads *const threads = dp_threads_create(3, NULL, NULL, &memory);
    dp_parallel(threads, 0, NULL, NULL);
    dp_threads_destroy(threads);
    dp_threads_destroy(NULL);
}

/* Results of one loop are visible to the next without anybody's locks. */
typedef struct chain {
    uint32_t values[2][PIECES]; /* read from one, written to the other */
    int from;
} chain;

static void copy_and_add(void *arg, uint32_t index, uint32_t worker) {
    chain *const c = arg;
    (void)worker;
    c->values[!c->from][index] = c->values[c->from][PIECES - 1 - index] + 1;
}

static void a_loop_sees_what_the_last_one_wrote(void **state) {
    (void)state;
    const dp_allocator memory = dp_allocator_resolve(NULL);
    dp_threads *const threads = dp_threads_create(4, NULL, NULL, &memory);
    static chain c;
    for (int i = 0; i < LOOPS; i++, c.from = !c.from)
        dp_parallel(threads, PIECES, copy_and_add, &c);
    for (int i = 0; i < PIECES; i++) assert_int_equal(c.values[c.from][i], LOOPS);
    dp_threads_destroy(threads);
}

/* An application's loop: more threads than workers were promised. */
enum { CROWD = 8 };

typedef struct crowd {
    void (*task)(void *arg, uint32_t index);
    void *arg;
    uint32_t count;
    atomic_uint next, *returned;
} crowd;

static void *crowd_main(void *arg) {
    crowd *const c = arg;
    for (uint32_t i; (i = atomic_fetch_add(&c->next, 1)) < c->count;) {
        c->task(c->arg, i);
        if (c->returned) atomic_fetch_add(c->returned, 1);
    }
    return NULL;
}

static void crowd_loop(void *user, uint32_t count, void (*task)(void *arg, uint32_t index),
                       void *arg) {
    pthread_t threads[CROWD];
    crowd c = {.task = task, .arg = arg, .count = count, .returned = user};
    for (int i = 0; i < CROWD; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, crowd_main, &c), 0);
    for (int i = 0; i < CROWD; i++) pthread_join(threads[i], NULL);
}

static void the_application_can_bring_its_own_threads(void **state) {
    (void)state;
    const dp_allocator memory = dp_allocator_resolve(NULL);
    atomic_uint calls = 0;
    for (uint32_t count = 1; count <= CROWD + 1; count++) {
        atomic_store(&calls, 0);
        dp_threads *const threads = dp_threads_create(count, crowd_loop, &calls, &memory);
        check_loops(threads);
        assert_int_equal(atomic_load(&calls), LOOPS * PIECES);
        dp_threads_destroy(threads);
    }
}

/* One call after the other, the last first, on the calling thread. */
static void serial_loop(void *user, uint32_t count, void (*task)(void *arg, uint32_t index),
                        void *arg) {
    (void)user;
    while (count) task(arg, --count);
}

static void or_none_at_all(void **state) {
    (void)state;
    const dp_allocator memory = dp_allocator_resolve(NULL);
    for (uint32_t count = 1; count <= 9; count += 4) {
        dp_threads *const threads = dp_threads_create(count, serial_loop, NULL, &memory);
        check_loops(threads);
        dp_threads_destroy(threads);
    }
}

static double seconds(clockid_t clock) {
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

static void sleep_a_moment(void) { nanosleep(&(struct timespec){.tv_nsec = 2000000}, NULL); }

/* The first item is over when all other calls have returned: none may wait for it. */
typedef struct patience {
    atomic_uint returned, done;
    bool in_vain;
} patience;

static void await_others(void *arg, uint32_t index, uint32_t worker) {
    patience *const p = arg;
    (void)index, (void)worker;
    if (atomic_fetch_add(&p->done, 1)) return;
    const double until = seconds(CLOCK_MONOTONIC) + 20;
    while (atomic_load(&p->returned) < CROWD - 1 && !p->in_vain) {
        sleep_a_moment();
        p->in_vain = seconds(CLOCK_MONOTONIC) > until;
    }
}

static void a_call_without_a_worker_returns_at_once(void **state) {
    (void)state;
    const dp_allocator memory = dp_allocator_resolve(NULL);
    patience p = {0};
    dp_threads *const threads = dp_threads_create(1, crowd_loop, &p.returned, &memory);
    dp_parallel(threads, CROWD, await_others, &p);
    assert_false(p.in_vain);
    assert_int_equal(atomic_load(&p.done), CROWD);
    dp_threads_destroy(threads);
}

/* Many calls, few workers, items that take their time without using it. */
static void sleep_in_item(void *arg, uint32_t index, uint32_t worker) {
    (void)arg, (void)index, (void)worker;
    sleep_a_moment();
}

static void too_many_calls_burn_no_time(void **state) {
    enum { ITEMS = 100 };
    (void)state;
    const dp_allocator memory = dp_allocator_resolve(NULL);
    dp_threads *const threads = dp_threads_create(2, crowd_loop, NULL, &memory);
    const double wall = seconds(CLOCK_MONOTONIC), used = seconds(CLOCK_PROCESS_CPUTIME_ID);
    dp_parallel(threads, ITEMS, sleep_in_item, NULL);
    const double took = seconds(CLOCK_MONOTONIC) - wall;
    const double burnt = seconds(CLOCK_PROCESS_CPUTIME_ID) - used;
    assert_true(took > 0.001 * ITEMS);
    if (burnt > took / 4) fail_msg("%.0f ms of %.0f ms burnt", burnt * 1e3, took * 1e3);
    dp_threads_destroy(threads);
}

/* The linker puts this before the system's (--wrap): no thread is started beyond `most`. */
int __real_pthread_create(pthread_t *, const pthread_attr_t *, void *(*)(void *), void *);
int __wrap_pthread_create(pthread_t *, const pthread_attr_t *, void *(*)(void *), void *);
static uint32_t most = UINT32_MAX;

int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes,
                          void *(*start)(void *), void *arg) {
    if (!most) return EAGAIN;
    most--;
    return __real_pthread_create(thread, attributes, start, arg);
}

static void threads_that_do_not_start_are_a_limit(void **state) {
    (void)state;
    for (uint32_t started = 0; started < 3; started++) {
        dp_context *context = NULL;
        dp_diag diag;
        most = started;
        const dp_context_desc desc = {.threads = 4};
        assert_int_equal(dp_context_create(&desc, &context, &diag), DP_ERR_LIMIT);
        assert_null(context);
        assert_string_equal(diag.message, "the system starts no more threads: ask for fewer");
        most = started;
        const dp_context_desc fewer = {.threads = started + 1};
        assert_int_equal(dp_context_create(&fewer, &context, &diag), DP_OK);
        dp_context_destroy(context);
    }
    most = UINT32_MAX;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_piece_is_done_once_per_loop),
        cmocka_unit_test(zero_means_a_thread_per_processor),
        cmocka_unit_test(no_work_calls_nobody),
        cmocka_unit_test(a_loop_sees_what_the_last_one_wrote),
        cmocka_unit_test(the_application_can_bring_its_own_threads),
        cmocka_unit_test(or_none_at_all),
        cmocka_unit_test(a_call_without_a_worker_returns_at_once),
        cmocka_unit_test(too_many_calls_burn_no_time),
        cmocka_unit_test(threads_that_do_not_start_are_a_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
