/* Draws frames side by side. Each job is a process, forked when the model is there: a source has one
 * time and one place, and a process has a source of its own without reading it again (its memory
 * stays shared until it is written).
 *
 *     program                                     job
 *     order {frame, slot}   ── pipe ──>           draws into the slot
 *     takes the slot's pixels in order  <── pipe ──  film_frame
 *
 * A slot is a frame's memory, shared by all. Frames are ordered in their sequence, so the first one
 * that is not taken always has a slot, and nobody waits for ever. A job has up to two orders, so
 * that it goes on while the program is busy with an encoder.
 *
 * Jobs end when their orders end, also if the program is killed. */
#define _DEFAULT_SOURCE /* MAP_ANONYMOUS */
#include "film_jobs.h"
#include "options.h"
#include "progress.h"
#include "report.h"
#include "words.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

enum { JOBS_MOST = 256, SLOTS_MOST = JOBS_MOST + 2, ORDERS = 2, WAIT = 200 /* ms */ };

typedef struct order {
    uint32_t frame; /* its place in film_jobs.frames */
    uint32_t slot;
} order;

typedef struct result {
    order order;
    film_frame frame;
} result;

typedef struct job {
    pid_t process;
    int orders, results; /* this program's ends; -1: closed */
    int words;           /* its stderr: said once, of the first job that fails */
    int waiting;         /* orders without a result */
} job;

typedef enum slot_state { SLOT_FREE = 0, SLOT_ORDERED, SLOT_DRAWN } slot_state;

typedef struct crew {
    const film_jobs *jobs;
    job job[JOBS_MOST];
    uint32_t job_count, slot_count;
    uint8_t *pixels; /* [slot_count][bytes] */
    slot_state state[SLOTS_MOST];
    result drawn[SLOTS_MOST];
    uint32_t ordered, taken; /* places in film_jobs.frames */
} crew;

/* ---- pipes ---- */

/* False: the other end is closed, or a signal came. */
static bool get(int from, void *to, size_t size) {
    for (size_t done = 0; done < size;) {
        const ssize_t count = read(from, (char *)to + done, size - done);
        if (count <= 0 && !(count < 0 && errno == EINTR)) return false;
        if (count > 0) done += (size_t)count;
    }
    return true;
}

/* Both fit into a pipe at once. */
static bool put(int to, const void *from, size_t size) {
    ssize_t count;
    do count = write(to, from, size);
    while (count < 0 && errno == EINTR);
    return count == (ssize_t)size;
}

/* ---- a job ---- */

static uint8_t *slot_pixels(const crew *c, uint32_t slot) {
    return c->jobs->bytes ? c->pixels + slot * c->jobs->bytes : NULL;
}

static void work(const crew *c, int orders, int results, int words) {
    const film_jobs *const jobs = c->jobs;
    dup2(words, STDERR_FILENO);
    signal(SIGINT, SIG_IGN); /* the program sees to it that jobs end */
    signal(SIGHUP, SIG_IGN);
    const int begun = jobs->begin(jobs->user);
    for (result r = {0}; get(orders, &r.order, sizeof r.order); r = (result){0}) {
        r.frame.number = jobs->frames[r.order.frame];
        r.frame.code =
            begun ? begun
                  : jobs->draw(jobs->user, r.frame.number, slot_pixels(c, r.order.slot), &r.frame);
        fflush(stderr);
        if (!put(results, &r, sizeof r)) break;
    }
    _exit(0);
}

static void close_job(job *j) {
    if (j->orders >= 0) close(j->orders);
    if (j->results >= 0) close(j->results);
    if (j->words >= 0) close(j->words);
    j->orders = j->results = j->words = -1;
}

static int no_process(void) {
    wrong_usage("cannot start a process to draw frames: %s; give fewer --jobs", strerror(errno));
    return EXIT_FAILED;
}

static int start_job(crew *c) {
    int orders[2], results[2];
    if (pipe(orders)) return no_process();
    if (pipe(results)) return close(orders[0]), close(orders[1]), no_process();
    job *const j = &c->job[c->job_count];
    fcntl(orders[1], F_SETFD, FD_CLOEXEC), fcntl(results[0], F_SETFD, FD_CLOEXEC);
    *j = (job){.orders = orders[1], .results = results[0], .words = words_open()};
    j->process = j->words < 0 ? -1 : fork();
    if (j->process == 0) {
        const int words = dup(j->words);
        for (uint32_t k = 0; k <= c->job_count; k++) close_job(&c->job[k]);
        work(c, orders[0], results[1], words);
    }
    close(orders[0]), close(results[1]);
    if (j->process < 0) return close_job(j), no_process();
    c->job_count++;
    return 0;
}

static int start(crew *c) {
    const film_jobs *const jobs = c->jobs;
    const uint32_t wanted = jobs->jobs < jobs->count ? jobs->jobs : jobs->count;
    c->slot_count = wanted + 2;
    if (jobs->bytes) {
        void *const pixels = mmap(NULL, c->slot_count * jobs->bytes, PROT_READ | PROT_WRITE,
                                  MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        if (pixels == MAP_FAILED) {
            wrong_usage("out of memory for %u frames; give fewer --jobs", c->slot_count);
            return EXIT_FAILED;
        }
        c->pixels = pixels;
    }
    fflush(NULL); /* a job would print it again */
    int code = 0;
    for (uint32_t k = 0; k < wanted && !code; k++) code = start_job(c);
    return code;
}

/* Ends all jobs: at once if something has failed, and in any case not in the middle of a file. */
static void stop(crew *c, bool at_once) {
    for (uint32_t k = 0; k < c->job_count; k++) {
        close_job(&c->job[k]);
        if (at_once && c->job[k].process > 0) kill(c->job[k].process, SIGTERM);
    }
    for (uint32_t k = 0; k < c->job_count; k++)
        while (c->job[k].process > 0 && waitpid(c->job[k].process, NULL, 0) < 0 && errno == EINTR) {
        }
    if (c->pixels) munmap(c->pixels, c->slot_count * c->jobs->bytes);
}

/* ---- orders and results ---- */

static uint32_t find_slot(const crew *c) {
    uint32_t k = 0;
    while (k < c->slot_count && c->state[k] != SLOT_FREE) k++;
    return k;
}

/* The job with the fewest orders. */
static job *find_job(crew *c) {
    job *best = &c->job[0];
    for (job *j = c->job; j < c->job + c->job_count; j++)
        if (j->waiting < best->waiting) best = j;
    return best;
}

/* A broken pipe is found out when results are read. */
static void give_orders(crew *c) {
    while (c->ordered < c->jobs->count) {
        job *const j = find_job(c);
        const order o = {c->ordered, find_slot(c)};
        if (o.slot == c->slot_count || j->waiting == ORDERS) return;
        c->state[o.slot] = SLOT_ORDERED;
        j->waiting++, c->ordered++;
        if (!put(j->orders, &o, sizeof o)) return;
    }
}

static int lost_job(job *j) {
    int status = 0;
    while (waitpid(j->process, &status, 0) < 0 && errno == EINTR) {
    }
    j->process = 0;
    if (interrupt_seen()) return EXIT_FAILED; /* Ctrl-C */
    words_show(j->words);
    wrong_usage("a process that draws frames was ended%s%s; if memory is short, give fewer --jobs, "
                "or a smaller --size",
                WIFSIGNALED(status) ? ": " : "",
                WIFSIGNALED(status) ? strsignal(WTERMSIG(status)) : "");
    return EXIT_FAILED;
}

static int receive(crew *c, job *j) {
    result r;
    if (!get(j->results, &r, sizeof r)) return lost_job(j);
    j->waiting--;
    c->drawn[r.order.slot] = r;
    c->state[r.order.slot] = SLOT_DRAWN;
    if (r.frame.code) words_show(j->words);
    return r.frame.code;
}

static int receive_some(crew *c) {
    struct pollfd ends[JOBS_MOST];
    int code = 0;
    for (uint32_t k = 0; k < c->job_count; k++)
        ends[k] = (struct pollfd){.fd = c->job[k].results, .events = POLLIN};
    if (poll(ends, c->job_count, WAIT) <= 0) return 0;
    for (uint32_t k = 0; k < c->job_count && !code; k++)
        if (ends[k].revents) code = receive(c, &c->job[k]);
    return code;
}

/* Takes those frames whose turn it is. */
static int take_some(crew *c) {
    const film_jobs *const jobs = c->jobs;
    for (uint32_t k = 0; k < c->slot_count;) {
        if (c->state[k] != SLOT_DRAWN || c->drawn[k].order.frame != c->taken) {
            k++;
            continue;
        }
        const int code = jobs->take(jobs->user, &c->drawn[k].frame, slot_pixels(c, k));
        if (code) return code;
        c->state[k] = SLOT_FREE;
        c->taken++;
        give_orders(c);
        k = 0;
    }
    return 0;
}

int film_jobs_run(const film_jobs *jobs) {
    crew *const c = calloc(1, sizeof *c);
    if (!c) return wrong_usage("out of memory for a film"), EXIT_FAILED;
    c->jobs = jobs;
    int code = start(c);
    if (!code) code = jobs->ready(jobs->user);
    while (!code && c->taken < jobs->count) {
        give_orders(c);
        code = receive_some(c);
        if (progress_report(NULL, (double)c->taken / jobs->count)) code = EXIT_FAILED;
        if (!code) code = take_some(c);
    }
    stop(c, code != 0);
    free(c);
    return code;
}
