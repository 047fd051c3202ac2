/* triad: what the machine's memory and cores can do, to hold a frame's stages against.
 *
 * For one thread and for one per processor: a[i] = b[i] + s * c[i] over arrays that no cache holds,
 * reading alone, filling alone, and multiply-adds on registers. Best of ROUNDS: the machine's limit
 * is asked for, not its usual day. One line of JSON. */
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { ROUNDS = 10, THREADS_MAX = 64, LANES = 16 };
static const size_t LENGTH = (size_t)16 << 20; /* floats: 64 MB per array and thread */

typedef struct worker {
    pthread_t thread;
    pthread_barrier_t *barrier;
    float *a, *b, *c; /* [LENGTH] */
    double *seconds;  /* [4][ROUNDS], of worker 0 only, or NULL */
    float sink;       /* so that nothing is optimised away */
} worker;

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void triad(worker *w) {
    float *const restrict a = w->a;
    const float *const restrict b = w->b, *const restrict c = w->c;
    for (size_t i = 0; i < LENGTH; i++) a[i] = b[i] + 3.0f * c[i];
}

static void read_all(worker *w) {
    const unsigned *const words = (const unsigned *)(const void *)w->b;
    unsigned sum[LANES] = {0};
    for (size_t i = 0; i < LENGTH; i += LANES)
        for (size_t k = 0; k < LANES; k++) sum[k] ^= words[i + k];
    for (size_t k = 0; k < LANES; k++) w->sink += (float)sum[k];
}

static void fill(worker *w) { memset(w->a, (int)w->sink & 1, LENGTH * sizeof *w->a); }

/* Eight chains of LANES floats, enough to hide the latency of multiply and add. */
static void compute(worker *w) {
    float x[8][LANES];
    for (int k = 0; k < 8; k++)
        for (int l = 0; l < LANES; l++) x[k][l] = w->b[l] + (float)k;
    for (size_t i = 0; i < LENGTH / 64; i++)
        for (int k = 0; k < 8; k++)
            for (int l = 0; l < LANES; l++) x[k][l] = x[k][l] * 0.999f + 0.001f;
    for (int k = 0; k < 8; k++)
        for (int l = 0; l < LANES; l++) w->sink += x[k][l];
}

static void (*const kernels[4])(worker *) = {triad, read_all, fill, compute};
/* What one worker does per call: bytes moved, or operations of the last. */
static const double work[4] = {12.0 * (16 << 20), 4.0 * (16 << 20), 4.0 * (16 << 20),
                               2.0 * 8 * LANES *((16 << 20) / 64)};

static void *run(void *user) {
    worker *const w = user;
    for (size_t i = 0; i < LENGTH; i++) w->a[i] = w->b[i] = w->c[i] = (float)(i & 7);
    for (int k = 0; k < 4; k++)
        for (int round = 0; round < ROUNDS; round++) {
            pthread_barrier_wait(w->barrier);
            const double start = now();
            kernels[k](w);
            pthread_barrier_wait(w->barrier);
            if (w->seconds) w->seconds[k * ROUNDS + round] = now() - start;
        }
    return NULL;
}

static int start_all(worker *w, int count) {
    int started = 0;
    for (; started < count; started++) {
        w[started].a = malloc(3 * LENGTH * sizeof(float));
        if (!w[started].a) return fprintf(stderr, "triad: out of memory\n"), EXIT_FAILURE;
        w[started].b = w[started].a + LENGTH;
        w[started].c = w[started].b + LENGTH;
    }
    for (started = 0; started < count; started++)
        if (pthread_create(&w[started].thread, NULL, run, &w[started]))
            return fprintf(stderr, "triad: no thread\n"), EXIT_FAILURE;
    return EXIT_SUCCESS;
}

static int measure(int count, double giga[4]) {
    static worker w[THREADS_MAX];
    double seconds[4 * ROUNDS];
    pthread_barrier_t barrier;
    pthread_barrier_init(&barrier, NULL, (unsigned)count);
    for (int t = 0; t < count; t++) w[t] = (worker){.barrier = &barrier};
    w[0].seconds = seconds;
    if (start_all(w, count)) exit(EXIT_FAILURE);
    for (int t = 0; t < count; t++) {
        pthread_join(w[t].thread, NULL);
        free(w[t].a);
    }
    pthread_barrier_destroy(&barrier);
    for (int k = 0; k < 4; k++) {
        double best = seconds[k * ROUNDS];
        for (int round = 1; round < ROUNDS; round++)
            if (seconds[k * ROUNDS + round] < best) best = seconds[k * ROUNDS + round];
        giga[k] = 1e-9 * work[k] * count / best;
    }
    return EXIT_SUCCESS;
}

int main(void) {
    long processors = sysconf(_SC_NPROCESSORS_ONLN);
    if (processors < 1) processors = 1;
    if (processors > THREADS_MAX) processors = THREADS_MAX;
    printf("[");
    for (int pass = 0; pass < (processors > 1 ? 2 : 1); pass++) {
        const int threads = pass ? (int)processors : 1;
        double giga[4];
        measure(threads, giga);
        printf(
            "%s{\"threads\": %d, \"triad_gb_s\": %.1f, \"read_gb_s\": %.1f, \"fill_gb_s\": %.1f, "
            "\"gflops\": %.1f}",
            pass ? ", " : "", threads, giga[0], giga[1], giga[2], giga[3]);
    }
    printf("]\n");
    return EXIT_SUCCESS;
}
