/* One parallel loop over indices, on the context's own threads or the application's. */
#ifndef DP_BASE_THREADS_H
#define DP_BASE_THREADS_H

#include "base/memory.h"

/* Does piece `index` of the work; `worker` in [0, dp_threads_count) is not used twice at a time. */
typedef void dp_task(void *arg, uint32_t index, uint32_t worker);

/* The application's loop, as in dp_context_desc. */
typedef void dp_parallel_for(void *user, uint32_t count, void (*task)(void *arg, uint32_t index),
                             void *arg);

typedef struct dp_threads dp_threads;

/* count 0: one per processor. With `loop`, no thread is started and `count` is how many of the
 * application's threads work at once, however many there are; further calls return at once. NULL
 * when memory or threads are out. */
dp_threads *dp_threads_create(uint32_t count, dp_parallel_for *loop, void *user,
                              const dp_allocator *allocator);
void dp_threads_destroy(dp_threads *threads);
uint32_t dp_threads_count(const dp_threads *threads);

/* Runs task(arg, i, worker) for every i in [0, count) and returns when all are done. Of the
 * context's own threads each has a share of the indices, which is the same in every loop of so
 * many: what a task writes again, frame after frame, its processor mostly has at hand. Whoever is
 * done takes what is left of the others' shares. */
void dp_parallel(dp_threads *threads, uint32_t count, dp_task *task, void *arg);

/* How many of `count` items a task should take, from `least` to `most`: so few that a few workers
 * have equal shares. Depends on nothing but these. */
static inline uint32_t dp_task_size(uint32_t count, uint32_t least, uint32_t most) {
    enum { TASKS = 16, WHOLE = 64 };
    const uint32_t size = (count / TASKS / WHOLE + 1) * WHOLE;
    return size < least ? least : size > most ? most : size;
}

#endif
