/* A thread that opens a model as the program does, for the viewer's command line.
 *
 * Invariant: there is one job at a time, and its command line is its own. Foreign formats are read in a child process
 * (apart.c), which is forked from this thread: what it calls of the C library is usable there with glibc and musl, and
 * it calls nothing else that other threads may have locked. */
#include "load.h"

#include "progress.h"
#include "report.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

struct load_job {
    pthread_t thread;
    parsed line;
    loaded model;
    bool failed;
    atomic_bool ended;
    void (*wake)(void);
};

static atomic_int per_mille = -1; /* of the reading; -1: not known */
static atomic_bool stop, stopped;

static int hear(double fraction) {
    atomic_store(&per_mille, fraction < 0 ? -1 : (int)(1000 * fmin(fraction, 1)));
    if (!atomic_load(&stop)) return 0;
    atomic_store(&stopped, true);
    return 1;
}

double load_fraction(void) { return atomic_load(&per_mille) / 1000.0; }

void load_stop(void) {
    atomic_store(&stop, true);
    if (interrupt_child()) atomic_store(&stopped, true); /* Assimp's reader does not listen */
}

bool load_was_stopped(void) { return atomic_load(&stopped); }

static void *run(void *argument) {
    load_job *const job = argument;
    job->failed = !loaded_open(&job->line.settings, &job->model);
    atomic_store(&job->ended, true);
    job->wake();
    return NULL;
}

load_job *load_begin(const cmdline *line, void (*wake)(void)) {
    load_job *const job = calloc(1, sizeof *job);
    if (!job) return wrong_usage("out of memory"), NULL;
    job->wake = wake;
    atomic_store(&stop, false);
    atomic_store(&stopped, false);
    atomic_store(&per_mille, -1);
    progress_to(hear);
    if (!cmdline_parse(line, NULL, &job->line)) {
        parsed_free(&job->line);
        free(job);
        return NULL;
    }
    if (!pthread_create(&job->thread, NULL, run, job)) return job;
    wrong_usage("no thread could be started to read the model");
    parsed_free(&job->line);
    free(job);
    return NULL;
}

bool load_ended(const load_job *job) { return atomic_load(&job->ended); }

bool load_end(load_job *job, loaded *out) {
    pthread_join(job->thread, NULL);
    const bool done = !job->failed;
    if (done)
        *out = job->model;
    else
        loaded_free(&job->model);
    parsed_free(&job->line);
    free(job);
    return done;
}
