/* The progress bar, and Ctrl-C.
 *
 * Here are the program's only mutable globals, because a signal handler can reach nothing else.
 *
 *     no output is being written   the handler ends the program at once
 *     an output is being written   the handler sets a flag; at its next report the writer is told
 *                                    to stop and removes its temporary file; interrupt_release ends
 *                                    the program
 *
 * If a writer is blocked, a signal interrupts its system call, which fails and ends the writer. */
#include "progress.h"

#include <pthread.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

static volatile sig_atomic_t signal_seen;
static volatile sig_atomic_t writing;
static volatile sig_atomic_t bar_shown;
static volatile sig_atomic_t child_process;

typedef struct piece_of_work {
    const char *what;
    struct timespec start;
    double last_shown; /* seconds since start */
    bool enabled;
} piece_of_work;

static piece_of_work work;

/* A thread that shows `work` while nobody reports it; `outer` is what goes on afterwards. */
static struct {
    pthread_t thread;
    pthread_mutex_t lock;
    pthread_cond_t changed;
    bool runs, over;
    piece_of_work outer;
} waiting = {.lock = PTHREAD_MUTEX_INITIALIZER, .changed = PTHREAD_COND_INITIALIZER};

static int (*listener)(double fraction);

static const char wipe[] = "\r\033[K";

/* ---- Ctrl-C ---- */

static void leave(int number) {
    if (child_process) kill((pid_t)child_process, SIGKILL);
    if (bar_shown && write(STDERR_FILENO, wipe, sizeof wipe - 1) < 0) _exit(128 + number);
    _exit(128 + number);
}

static void on_signal(int number) {
    if (!writing) leave(number);
    signal_seen = number;
}

void interrupt_install(void) {
    static const int numbers[] = {SIGINT, SIGTERM, SIGHUP}; /* HUP: the terminal is gone */
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++) {
        struct sigaction old, action;
        memset(&action, 0, sizeof action);
        action.sa_handler = on_signal; /* no SA_RESTART: a blocked write must fail */
        sigemptyset(&action.sa_mask);
        if (sigaction(numbers[k], NULL, &old) || old.sa_handler == SIG_IGN) continue; /* nohup */
        sigaction(numbers[k], &action, NULL);
    }
}

void interrupt_also(pid_t child) { child_process = (sig_atomic_t)child; }

bool interrupt_child(void) {
    const pid_t child = (pid_t)child_process;
    return child && !kill(child, SIGKILL);
}

void interrupt_hold(void) { writing = 1; }

bool interrupt_seen(void) { return signal_seen != 0; }

void interrupt_release(void) {
    writing = 0;
    if (signal_seen) leave(signal_seen);
}

/* ---- the bar ---- */

static double seconds_since(const struct timespec *start) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)(now.tv_sec - start->tv_sec) + 1e-9 * (double)(now.tv_nsec - start->tv_nsec);
}

void progress_to(int (*hear)(double fraction)) { listener = hear; }

void progress_begin(const char *what, bool quiet) {
    if (listener) return;
    work.what = what;
    work.last_shown = 0;
    work.enabled = !quiet && isatty(STDERR_FILENO);
    clock_gettime(CLOCK_MONOTONIC, &work.start);
}

static void show_known(double elapsed, double fraction) {
    enum { CELLS = 30 };
    char bar[CELLS + 1];
    const int full = (int)(fraction * CELLS);
    for (int k = 0; k < CELLS; k++) bar[k] = k < full ? '#' : '.';
    bar[CELLS] = 0;
    fprintf(stderr, "%s%s [%s] %3.0f %%", wipe, work.what, bar, 100 * fraction);
    if (fraction > 0.01) {
        const double left = elapsed / fraction - elapsed;
        fprintf(stderr, ", %.0f:%02.0f left", (left - (int)left % 60) / 60,
                (double)((int)left % 60));
    }
}

static void show(double elapsed, double fraction) {
    bar_shown = 1;
    if (fraction < 0)
        fprintf(stderr, "%s%s … %.0f s", wipe, work.what, elapsed);
    else
        show_known(elapsed, fraction > 1 ? 1 : fraction);
    fflush(stderr);
}

int progress_report(void *user, double fraction) {
    (void)user;
    if (signal_seen) return 1;
    if (listener) return listener(fraction);
    if (!work.enabled) return 0;
    const double elapsed = seconds_since(&work.start);
    if (elapsed < 1 || elapsed - work.last_shown < 0.1) return 0;
    work.last_shown = elapsed;
    show(elapsed, fraction);
    return 0;
}

void progress_clear(void) {
    if (!bar_shown) return;
    fputs(wipe, stderr);
    fflush(stderr);
    bar_shown = 0;
}

void progress_end(void) {
    if (listener) return;
    progress_clear();
    work.enabled = false;
}

/* ---- work that reports nothing ---- */

static struct timespec soon(void) {
    struct timespec t;
    clock_gettime(CLOCK_REALTIME, &t);
    t.tv_nsec += 200000000;
    if (t.tv_nsec >= 1000000000) t.tv_sec++, t.tv_nsec -= 1000000000;
    return t;
}

static void *show_waiting(void *user) {
    (void)user;
    pthread_mutex_lock(&waiting.lock);
    while (!waiting.over) {
        const struct timespec until = soon();
        pthread_cond_timedwait(&waiting.changed, &waiting.lock, &until);
        if (!waiting.over) progress_report(NULL, -1);
    }
    pthread_mutex_unlock(&waiting.lock);
    return NULL;
}

/* The thread takes no signals: Ctrl-C is for the one that works. */
static bool start_waiting(void) {
    sigset_t all, before;
    waiting.over = false;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    const bool started = !pthread_create(&waiting.thread, NULL, show_waiting, NULL);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return started;
}

void progress_wait_begin(const char *what, bool quiet) {
    if (listener) return;
    waiting.outer = work;
    progress_begin(what, quiet);
    waiting.runs = work.enabled && start_waiting();
}

void progress_wait_end(void) {
    if (listener) return;
    if (waiting.runs) {
        pthread_mutex_lock(&waiting.lock);
        waiting.over = true;
        pthread_cond_signal(&waiting.changed);
        pthread_mutex_unlock(&waiting.lock);
        pthread_join(waiting.thread, NULL);
        waiting.runs = false;
        progress_clear();
    }
    work = waiting.outer;
}
