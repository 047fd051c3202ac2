/* The program ffmpeg, which makes films of frames. */
#ifndef TOOL_FFMPEG_H
#define TOOL_FFMPEG_H

#include <drypoint/style.h>

#include <stdbool.h>
#include <stdint.h>
#include <sys/types.h>

typedef struct ffmpeg_film {
    uint32_t width, height, count;
    double fps;
    dp_color paper;
    bool opaque;
    int format;       /* files.h */
    const char *file; /* NULL: it goes to the target, which cannot be gone back in */
} ffmpeg_film;

/* Looks for it on PATH. */
bool ffmpeg_find(char *program, size_t size);
/* Starts it with a pipe of frames (RGBA) as input, a target as standard output, and a file for its
 * words. Its process, or below 0: errno says why not. */
pid_t ffmpeg_start(const ffmpeg_film *film, int frames, int target, int words);

#endif
