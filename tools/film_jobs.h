/* Frames drawn side by side, in processes, and taken in their order. */
#ifndef TOOL_FILM_JOBS_H
#define TOOL_FILM_JOBS_H

#include <drypoint/draw.h>

/* What is told of a frame that is drawn. */
typedef struct film_frame {
    uint32_t number;
    int code; /* 0, or the exit code after a message */
    bool empty;
    dp_stats stats; /* of its first view */
} film_frame;

typedef struct film_jobs {
    const uint32_t *frames; /* [count] numbers, in the order to take them */
    uint32_t count, jobs;
    size_t bytes; /* of a frame's pixels; 0: none are taken */
    void *user;
    /* In each process: once, and for each frame. `pixels` are shared with the program's own. */
    int (*begin)(void *user);
    int (*draw)(void *user, uint32_t number, uint8_t *pixels, film_frame *frame);
    /* In the program's own: once the processes are there, and for each frame. */
    int (*ready)(void *user);
    int (*take)(void *user, const film_frame *frame, const uint8_t *pixels);
} film_jobs;

/* Draws all frames. There are never more than jobs + 2 that are not taken yet. 0, or the exit code
 * after a message, of the first that failed; after Ctrl-C, without one. */
int film_jobs_run(const film_jobs *jobs);

#endif
