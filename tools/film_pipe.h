/* A film in one file: raw pixels, or what ffmpeg makes of them. */
#ifndef TOOL_FILM_PIPE_H
#define TOOL_FILM_PIPE_H

#include "options.h"

#include <sys/types.h>

typedef struct film_shape {
    uint32_t width, height, count;
    double fps;
    dp_color paper; /* what becomes of transparent pixels where there are none */
    bool opaque;    /* all pixels are */
} film_shape;

typedef struct film_pipe {
    const char *path; /* as given */
    int format;       /* files.h */
    film_shape shape;
    char *final, *temporary; /* final: what `temporary` becomes; NULL: written in place */
    int descriptor;          /* where frames go; -1: it is closed */
    int words;               /* ffmpeg's stderr, a file without a name */
    pid_t ffmpeg;            /* 0: none */
    uint8_t *flat;           /* a frame over white, where the format has no transparency */
} film_pipe;

/* Is there a program to make such a film? A message with a remedy if not. */
bool film_pipe_possible(const char *path, int format);

/* Frames in their order, then one of finish and abandon, which leaves the old file. These return 0,
 * or the exit code after a message, also when Ctrl-C came between (without a message). */
int film_pipe_open(const char *path, int format, const film_shape *shape, film_pipe *pipe);
int film_pipe_write(film_pipe *pipe, const uint8_t *rgba);
int film_pipe_finish(film_pipe *pipe);
void film_pipe_abandon(film_pipe *pipe);

#endif
