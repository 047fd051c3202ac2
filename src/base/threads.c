/* A pool of pthreads, each with a share of a loop's indices.
 *
 *    dp_parallel         deal out the shares, announce a new `round`, work, wait until `busy` is 0
 *    a worker            wait for a round; work: its own share, then what is left of others'
 *
 * Invariants: between two loops all workers wait, at first spinning, then asleep on `wake`. Inside
 * a loop they share only the counters of the shares, and seldom touch another's. Not handled:
 * nesting; a task must not start another loop.
 *
 * The application's own loop may run on any threads, and on more than there are workers. A call of
 * its task is only the permission to do one item. A call that finds a free worker number does the
 * next item, and items that were left meanwhile; a call that finds none leaves its item and
 * returns. So no call waits for another, and as many items are done as calls are made. */
#include "base/threads.h"

#include <pthread.h>
#include <stdatomic.h>
#include <time.h>
#include <unistd.h>

enum { MAX_THREADS = 256 };

/* Indices [next, end) are still to be handed out. One cache line in size, so that no two share
 * one. */
typedef struct share {
    atomic_uint next;
    uint32_t end;
    char unused[64 - 2 * sizeof(uint32_t)];
} share;

typedef struct worker {
    dp_threads *threads;
    pthread_t thread;
    uint32_t index;
} worker;

struct dp_threads {
    dp_allocator allocator;
    uint32_t count;   /* workers, including the caller, which is worker 0 */
    uint32_t started; /* running threads: count - 1; 0 with the application's loop */
    dp_parallel_for *loop;
    void *user;
    struct { /* with the application's loop */
        pthread_mutex_t mutex;
        uint32_t next;                 /* item */
        uint32_t owed;                 /* items left to calls that have a number */
        uint32_t free;                 /* how many numbers are free */
        uint32_t numbers[MAX_THREADS]; /* [free]; the last is handed out first */
    } calls;

    pthread_mutex_t mutex;
    pthread_cond_t wake, done;
    atomic_uint round, busy; /* written with the mutex held, but for decreasing `busy` */
    bool quit;
    bool lingers; /* there is a processor for each worker, so waiting begins by spinning */

    dp_task *task;
    void *arg;
    share shares[MAX_THREADS]; /* of a loop's indices, by worker */
    worker workers[MAX_THREADS];
};

/* Works on its own share, then on the rest of the others'. */
static void work(dp_threads *threads, uint32_t self) {
    const uint32_t count = threads->started + 1;
    for (uint32_t i = 0; i < count; i++) {
        share *const s = &threads->shares[(self + i) % count];
        for (;;) {
            const uint32_t index = atomic_fetch_add_explicit(&s->next, 1, memory_order_relaxed);
            if (index >= s->end) break;
            threads->task(threads->arg, index, self);
        }
    }
}

static void share_out(dp_threads *threads, uint32_t total) {
    const uint32_t count = threads->started + 1;
    for (uint32_t i = 0; i < count; i++) {
        share *const s = &threads->shares[i];
        atomic_store_explicit(&s->next, (uint32_t)((uint64_t)total * i / count),
                              memory_order_relaxed);
        s->end = (uint32_t)((uint64_t)total * (i + 1) / count);
    }
}

static inline void pause_a_moment(void) {
#if defined __x86_64__ || defined __i386__
    __builtin_ia32_pause();
#elif defined __aarch64__
    __asm__ volatile("yield");
#endif
}

static int64_t now_ns(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (int64_t)t.tv_sec * 1000000000 + t.tv_nsec;
}

/* Spins for a while until a value changes: stages of a frame follow each other closely, and waking
 * a thread is slow. False: it has not changed. */
static bool linger(atomic_uint *value, uint32_t had) {
    enum { LOOKS = 64, LINGER_NS = 200000 };
    const int64_t until = now_ns() + LINGER_NS;
    do {
        for (int i = 0; i < LOOKS; i++) {
            if (atomic_load_explicit(value, memory_order_acquire) != had) return true;
            pause_a_moment();
        }
    } while (now_ns() < until);
    return false;
}

/* Waits for a loop that is not yet seen. False: there will be none. */
static bool await_loop(dp_threads *threads, uint32_t *seen) {
    if (!threads->lingers || !linger(&threads->round, *seen)) {
        pthread_mutex_lock(&threads->mutex);
        while (!threads->quit && threads->round == *seen)
            pthread_cond_wait(&threads->wake, &threads->mutex);
        const bool quit = threads->quit;
        pthread_mutex_unlock(&threads->mutex);
        if (quit) return false;
    }
    *seen = threads->round;
    return true;
}

/* Waits until no worker is busy. */
static void await_workers(dp_threads *threads) {
    uint32_t busy;
    while ((busy = threads->busy) != 0 && threads->lingers)
        if (!linger(&threads->busy, busy)) break;
    if (!busy) return;
    pthread_mutex_lock(&threads->mutex);
    while (threads->busy) pthread_cond_wait(&threads->done, &threads->mutex);
    pthread_mutex_unlock(&threads->mutex);
}

static void *thread_main(void *arg) {
    worker *const self = arg;
    dp_threads *const threads = self->threads;
    uint32_t seen = 0;
    while (await_loop(threads, &seen)) {
        work(threads, self->index);
        if (atomic_fetch_sub(&threads->busy, 1) > 1) continue;
        pthread_mutex_lock(&threads->mutex);
        pthread_cond_signal(&threads->done);
        pthread_mutex_unlock(&threads->mutex);
    }
    return NULL;
}

static uint32_t processors(void) {
    const long online = sysconf(_SC_NPROCESSORS_ONLN);
    return online < 1 ? 1 : online > MAX_THREADS ? MAX_THREADS : (uint32_t)online;
}

/* In WebAssembly a thread is one of the module's pool, which is filled before the program starts;
 * what is asked for beyond would start only after the caller returns to the event loop: never, as
 * the caller waits for it. So all contexts together hire no more than there are, and where the
 * pool is smaller than DRYPOINT_WEB_POOL (pthread_create then fails, as all modules are linked with
 * -sPTHREAD_POOL_SIZE_STRICT=2), they do with fewer. */
#ifdef __EMSCRIPTEN__
static atomic_uint hired;
enum { POOL = DRYPOINT_WEB_POOL, DOES_WITH_FEWER = 1 };

static bool hire(void) {
    if (atomic_fetch_add(&hired, 1) < POOL) return true;
    atomic_fetch_sub(&hired, 1);
    return false;
}
static void dismiss(uint32_t count) { atomic_fetch_sub(&hired, count); }
#else
enum { DOES_WITH_FEWER = 0 };
static bool hire(void) { return true; }
static void dismiss(uint32_t count) { (void)count; }
#endif

/* Starts the next worker. False: there is no thread for it. */
static bool start_worker(dp_threads *threads) {
    const uint32_t index = threads->started + 1;
    worker *const w = &threads->workers[index];
    *w = (worker){.threads = threads, .index = index};
    if (!hire()) return false;
    if (pthread_create(&w->thread, NULL, thread_main, w)) {
        dismiss(1);
        return false;
    }
    threads->started = index;
    return true;
}

dp_result dp_threads_start(uint32_t count, dp_parallel_for *loop, void *user,
                           const dp_allocator *allocator, dp_threads **out) {
    *out = NULL;
    if (!count) count = processors();
    if (count > MAX_THREADS) count = MAX_THREADS;
    dp_threads *const threads = dp_alloc_zeroed(allocator, sizeof *threads);
    if (!threads) return DP_ERR_MEMORY;
    threads->allocator = *allocator;
    threads->loop = loop;
    threads->lingers = count <= processors();
    threads->user = user;
    pthread_mutex_init(&threads->calls.mutex, NULL);
    while (threads->calls.free < count) {
        threads->calls.numbers[threads->calls.free] = count - 1 - threads->calls.free;
        threads->calls.free++;
    }
    pthread_mutex_init(&threads->mutex, NULL);
    pthread_cond_init(&threads->wake, NULL);
    pthread_cond_init(&threads->done, NULL);
    while (!loop && threads->started + 1 < count && start_worker(threads)) continue;
    threads->count = loop ? count : threads->started + 1;
    if (threads->count < count && !DOES_WITH_FEWER) {
        dp_threads_destroy(threads);
        return DP_ERR_LIMIT;
    }
    *out = threads;
    return DP_OK;
}

void dp_threads_destroy(dp_threads *threads) {
    if (!threads) return;
    pthread_mutex_lock(&threads->mutex);
    threads->quit = true;
    pthread_cond_broadcast(&threads->wake);
    pthread_mutex_unlock(&threads->mutex);
    for (uint32_t i = 1; i <= threads->started; i++) pthread_join(threads->workers[i].thread, NULL);
    dismiss(threads->started);
    pthread_cond_destroy(&threads->wake);
    pthread_cond_destroy(&threads->done);
    pthread_mutex_destroy(&threads->mutex);
    pthread_mutex_destroy(&threads->calls.mutex);
    const dp_allocator memory = threads->allocator;
    dp_free(&memory, threads);
}

uint32_t dp_threads_count(const dp_threads *threads) { return threads->count; }
uint64_t dp_threads_bytes(const dp_threads *threads) { return sizeof *threads; }

/* Does one item and those left meanwhile; or leaves its own. */
static void foreign_task(void *arg, uint32_t index) {
    dp_threads *const threads = arg;
    (void)index; /* items are handed out in order, whatever this says */
    pthread_mutex_lock(&threads->calls.mutex);
    threads->calls.owed++;
    if (threads->calls.free) {
        const uint32_t self = threads->calls.numbers[--threads->calls.free];
        while (threads->calls.owed) {
            const uint32_t item = threads->calls.next++;
            threads->calls.owed--;
            pthread_mutex_unlock(&threads->calls.mutex);
            threads->task(threads->arg, item, self);
            pthread_mutex_lock(&threads->calls.mutex);
        }
        threads->calls.numbers[threads->calls.free++] = self;
    }
    pthread_mutex_unlock(&threads->calls.mutex);
}

void dp_parallel(dp_threads *threads, uint32_t count, dp_task *task, void *arg) {
    if (!count) return;
    threads->task = task;
    threads->arg = arg;
    if (threads->loop) {
        threads->calls.next = 0;
        threads->loop(threads->user, count, foreign_task, threads);
        return;
    }
    share_out(threads, count);
    const bool alone = count == 1 || !threads->started;
    if (!alone) {
        pthread_mutex_lock(&threads->mutex);
        threads->busy = threads->started;
        threads->round++;
        pthread_cond_broadcast(&threads->wake);
        pthread_mutex_unlock(&threads->mutex);
    }
    work(threads, 0);
    if (!alone) await_workers(threads);
}
