/* run [-n TIMES] COMMAND…: wall time and peak memory of a command, a new process each time.
 *
 * Prints one line of JSON: runs, median, least and most seconds, and the most memory that any of
 * the runs held. The command's own standard output is thrown away. Exits as the command does if it
 * fails. */
#define _DEFAULT_SOURCE /* wait4 */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { RUNS_MAX = 1000 };

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int by_value(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void become(char **command) {
    const int nowhere = open("/dev/null", O_WRONLY);
    if (nowhere >= 0) dup2(nowhere, STDOUT_FILENO);
    execvp(command[0], command);
    perror(command[0]);
    _exit(127);
}

/* Runs the command once. Returns its exit code, 128 + the signal that ended it, or -1. */
static int run(char **command, double *seconds, struct rusage *usage) {
    const double start = now();
    const pid_t child = fork();
    if (child < 0) return perror("fork"), -1;
    if (!child) become(command);
    int status = 0;
    if (wait4(child, &status, 0, usage) < 0) return perror("wait4"), -1;
    *seconds = now() - start;
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

int main(int argc, char **argv) {
    int times = 1;
    char **command = argv + 1;
    if (argc > 3 && !strcmp(argv[1], "-n")) {
        times = atoi(argv[2]);
        command += 2;
    }
    if (!*command || times < 1 || times > RUNS_MAX)
        return fprintf(stderr, "usage: run [-n 1…%d] COMMAND...\n", RUNS_MAX), 2;
    static double seconds[RUNS_MAX];
    double processor = 0;
    long peak_kb = 0;
    for (int k = 0; k < times; k++) {
        struct rusage usage = {0};
        const int code = run(command, &seconds[k], &usage);
        if (code) return code < 0 ? EXIT_FAILURE : code;
        if (usage.ru_maxrss > peak_kb) peak_kb = usage.ru_maxrss;
        processor += (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
                     1e-6 * (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
    }
    qsort(seconds, (size_t)times, sizeof *seconds, by_value);
    printf("{\"runs\": %d, \"seconds\": %.4f, \"seconds_min\": %.4f, \"seconds_max\": %.4f, "
           "\"processor_seconds\": %.4f, \"peak_mb\": %.1f}\n",
           times, 0.5 * (seconds[(times - 1) / 2] + seconds[times / 2]), seconds[0],
           seconds[times - 1], processor / times, (double)peak_kb / 1000.0);
    return EXIT_SUCCESS;
}
