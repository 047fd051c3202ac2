/* What a film was, as a table for people and as JSON for programs. */
#ifndef TOOL_FILM_STATS_H
#define TOOL_FILM_STATS_H

#include "film_jobs.h"
#include "options.h"

/* What is kept of its frames. */
typedef struct film_stats {
    double *frame_ms;   /* [count] */
    uint64_t *segments; /* [count] */
    uint32_t count, room;
    uint32_t empty;     /* frames without a line */
    dp_stats dropping;  /* of the first frame that polygons were dropped from, or edges lost */
    uint64_t triangles; /* of the last frame */
    double seconds;     /* from the first order to the last frame's end */
    uint32_t jobs, threads, width, height, samples;
} film_stats;

bool film_stats_begin(film_stats *stats, uint32_t frames);
void film_stats_add(film_stats *stats, const film_frame *frame);
/* Prints them as --stats says. */
void film_stats_print(const tool_settings *s, film_stats *stats, FILE *out);
void film_stats_free(film_stats *stats);

#endif
