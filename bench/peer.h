/* A peer program in a child process that draws a frame whenever it is asked to
 * (peers/llvmpipe.c). */
#ifndef BENCH_PEER_H
#define BENCH_PEER_H

#include <stdbool.h>
#include <stdio.h>
#include <sys/types.h>

typedef struct peer {
    FILE *orders, *answers; /* NULL: there is none */
    pid_t child;
} peer;

/* One frame: wall time, and processor time of all threads. */
typedef struct frame_time {
    double ms, cpu_ms;
} frame_time;

/* Starts PROGRAM MODEL --serve; program NULL or a failing one: a peer that is not there. */
void peer_start(peer *p, const char *program, const char *model);
/* False: it could not; the peer is gone then. */
bool peer_draw(peer *p, unsigned width, unsigned height, unsigned samples, bool lines,
               frame_time *time);
void peer_stop(peer *p);

#endif
