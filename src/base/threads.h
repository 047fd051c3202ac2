/* One parallel loop over indices, on the context's threads or the application's. */
#ifndef DP_BASE_THREADS_H
#define DP_BASE_THREADS_H

#include "base/memory.h"

/* Does item `index`. `worker` is in [0, dp_threads_count), and never used twice at the same
 * time. */
typedef void dp_task(void *arg, uint32_t index, uint32_t worker);

/* The application's loop, as in dp_context_desc. */
typedef void dp_parallel_for(void *user, uint32_t count, void (*task)(void *arg, uint32_t index),
                             void *arg);

typedef struct dp_threads dp_threads;

/* count 0: one per processor. With `loop` no thread is started; `count` is how many of the
 * application's threads work at once, and further calls return immediately. DP_ERR_MEMORY;
 * DP_ERR_LIMIT: the system starts no more threads. In WebAssembly there are as many as the module's
 * pool still has, and it is no error if that is fewer than asked for. */
dp_result dp_threads_start(uint32_t count, dp_parallel_for *loop, void *user,
                           const dp_allocator *allocator, dp_threads **out);

/* The same, for callers to whom either error is lack of memory. NULL: error. */
static inline dp_threads *dp_threads_create(uint32_t count, dp_parallel_for *loop, void *user,
                                            const dp_allocator *allocator) {
    dp_threads *threads;
    return dp_threads_start(count, loop, user, allocator, &threads) ? NULL : threads;
}

/* How many threads are worth starting for one loop: one per processor. In WebAssembly the caller
 * works alone: the threads of a pool come back only when the page's event loop turns. */
#ifdef __EMSCRIPTEN__
enum { DP_THREADS_BRIEF = 1 };
#else
enum { DP_THREADS_BRIEF = 0 };
#endif

void dp_threads_destroy(dp_threads *threads);
uint32_t dp_threads_count(const dp_threads *threads);
/* Of the allocator's; what the system keeps for its threads is not counted. */
uint64_t dp_threads_bytes(const dp_threads *threads);

/* Runs task(arg, i, worker) for every i in [0, count), and returns when all are done. Each of the
 * context's threads has a share of the indices, the same in every loop of this length, so what a
 * task writes again in each frame is often in its processor's caches. Threads that are done take
 * from others' shares. */
void dp_parallel(dp_threads *threads, uint32_t count, dp_task *task, void *arg);

/* How many of `count` items a task should take, from `least` to `most`, so that a few workers have
 * equal shares. Depends only on these numbers. */
static inline uint32_t dp_task_size(uint32_t count, uint32_t least, uint32_t most) {
    enum { TASKS = 16, WHOLE = 64 };
    const uint32_t size = (count / TASKS / WHOLE + 1) * WHOLE;
    return size < least ? least : size > most ? most : size;
}

#endif
