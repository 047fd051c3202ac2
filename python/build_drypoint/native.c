/* What the extension adds to the library: progress reports that reach Python only now and then.
 *
 * The library reports many times a frame. Each call into Python waits for the interpreter's lock, which
 * other threads may hold for milliseconds; so those that follow the last one within INTERVAL are
 * answered here. The first INTERVAL of a drawing is quiet, too: short frames never wait.
 *
 * Not handled: nothing is told at the end; Python knows that itself. */
#include <time.h>

static const double INTERVAL = 0.03; /* s: an interrupt feels immediate */

static double seconds_now(void) {
    struct timespec now;
    timespec_get(&now, TIME_UTC);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void drypoint_progress_begin(drypoint_progress *progress) { progress->last = seconds_now(); }

static int drypoint_progress_call(void *user, double fraction) {
    drypoint_progress *const progress = user;
    const double now = seconds_now();
    if (!progress->handle) return 0;
    if (now >= progress->last && now - progress->last < INTERVAL) return 0;
    const int stop = drypoint_report(progress->handle, fraction);
    progress->last = seconds_now();
    return stop;
}
