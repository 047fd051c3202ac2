/* Reads a model in a child process. Assimp has readers of some forty formats, and broken files crash
 * some of them, or keep them busy or allocating for ever.
 *
 *     child    limits its memory and time, dp_io_open, sends what it has got
 *     parent   receives it until the deadline, then waits for the child
 *
 * fork is safe because no thread runs: models are opened before contexts are made, and contexts of
 * earlier pictures are gone. */
#include "apart.h"

#include "pipe.h"
#include "progress.h"
#include "transfer.h"

#include <drypoint/io.h>

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

/* Sanitizers reserve more address space than any limit allows, and their reports must be seen. */
#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
#define SANITIZED 1
#elif defined __has_feature
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) ||                         \
    __has_feature(memory_sanitizer)
#define SANITIZED 1
#endif
#endif
#ifndef SANITIZED
#define SANITIZED 0
#endif

static void limit(int resource, double most) {
    struct rlimit now;
    if (getrlimit(resource, &now)) return;
    if (now.rlim_max == RLIM_INFINITY || most < (double)now.rlim_max)
        now.rlim_cur = now.rlim_max = (rlim_t)most;
    setrlimit(resource, &now);
}

/* Memory: far more than any sound file of this size takes, and no more than the machine has. Text in
 * an archive (3MF) takes about 100 times its size; the 8 GB are for scenes whose arrays are in other
 * files (glTF). */
static void limit_child(double bytes, double seconds) {
    const double machine = (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
    const double most = 8.0 * (1 << 30) + 100 * bytes;
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, 2 * seconds + 1); /* should the parent be gone */
    if (SANITIZED) return;
    limit(RLIMIT_AS, machine > 0 && machine < most ? machine : most);
    const int nowhere = open("/dev/null", O_WRONLY); /* what Assimp and the C library print */
    if (nowhere < 0) return;
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
}

/* ------- messages ------- */

static dp_result fail(dp_diag *diag, const char *path, const char *what) {
    const char *const slash = strrchr(path, '/'), *const dot = strrchr(slash ? slash : path, '.');
    *diag = (dp_diag){.result = DP_ERR_FORMAT};
    snprintf(diag->message, sizeof diag->message, "Assimp's reader of %.20s files %s",
             dot ? dot : "such", what);
    return DP_ERR_FORMAT;
}

/* Says why the child has sent nothing whole. */
static dp_result fail_by_status(dp_diag *diag, const char *path, int status) {
    char text[120];
    if (!WIFSIGNALED(status))
        return fail(diag, path, "gave up on it: export it again, or as STL, PLY, OBJ or OFF");
    snprintf(text, sizeof text, "crashed on it (%s): export it again, or as STL, PLY, OBJ or OFF",
             strsignal(WTERMSIG(status)));
    return fail(diag, path, text);
}

static dp_result fail_late(dp_diag *diag, const char *path, double seconds) {
    char text[120];
    snprintf(text, sizeof text,
             "was not done after %g s: give it more with --read-time, or convert the file",
             seconds);
    return fail(diag, path, text);
}

/* ------- both processes ------- */

static void run_child(const char *path, int to, pid_t parent, double bytes, double seconds) {
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGKILL); /* whatever ends the parent */
#endif
    if (getppid() != parent) _exit(1);
    limit_child(bytes, seconds);
    dp_source *source = NULL;
    dp_diag diag = {0};
    diag.result = dp_io_open(path, NULL, &source, &diag);
    transfer_send(to, source, &diag);
    _exit(0);
}

dp_result open_apart(const char *path, double seconds, dp_source **out, dp_diag *diag) {
    struct stat file;
    int ends[2];
    const double bytes = stat(path, &file) ? 0 : (double)file.st_size;
    const pid_t parent = getpid();
    if (!(seconds > 0)) seconds = 60 + (double)(size_t)(bytes / 1e6);
    if (pipe(ends)) return dp_io_open(path, NULL, out, diag);
    const pid_t child = fork();
    if (child == 0) {
        close(ends[0]);
        run_child(path, ends[1], parent, bytes, seconds);
    }
    close(ends[1]);
    if (child < 0) {
        close(ends[0]);
        return dp_io_open(path, NULL, out, diag);
    }
    interrupt_also(child);
    const transfer_end end = transfer_receive(ends[0], pipe_clock() + seconds, out, diag);
    close(ends[0]);
    if (end) kill(child, SIGKILL);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    interrupt_also(0);
    if (end == TRANSFER_LATE) return fail_late(diag, path, seconds);
    if (end == TRANSFER_BROKEN) return fail_by_status(diag, path, status);
    if (end == TRANSFER_FULL)
        *diag = (dp_diag){.result = DP_ERR_MEMORY, .message = "out of memory for the model"};
    return diag->result;
}
