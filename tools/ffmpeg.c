/* How ffmpeg is called. Quality: lines of a drawing are thin, and compression is what they see first;
 * so H.264 and VP9 have a constant quality at which they stay clear, and GIFs have colours of their
 * own and no dither, which would flicker beside lines. */
#include "ffmpeg.h"
#include "files.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

bool ffmpeg_find(char *program, size_t size) {
    const char *at = getenv("PATH");
    for (; at && *at; at += strcspn(at, ":"), at += *at == ':') {
        const int length = (int)strcspn(at, ":");
        struct stat status;
        snprintf(program, size, "%.*s%sffmpeg", length, at, length ? "/" : "");
        if (!access(program, X_OK) && !stat(program, &status) && S_ISREG(status.st_mode))
            return true;
    }
    return false;
}

/* ---- the command line ---- */

enum { WORDS_MOST = 64 };
typedef struct command {
    const char *words[WORDS_MOST];
    int count;
    char size[32], rate[32], filter[256], file[4200];
} command;

static void add(command *c, const char *const *words) {
    for (; *words && c->count < WORDS_MOST - 1; words++) c->words[c->count++] = *words;
}

/* Rec. 709's colours are what players expect of films. */
#define REC_709 "scale=out_color_matrix=bt709:out_range=tv:flags=accurate_rnd+full_chroma_int"

/* H.264 with halved colours wants even sides: a last row and column of paper. */
static void filter_mp4(const ffmpeg_film *f, char *filter, size_t size) {
    const uint32_t paper = f->opaque && f->paper ? f->paper >> 8 : 0xFFFFFF;
    snprintf(filter, size, "pad=ceil(iw/2)*2:ceil(ih/2)*2:0:0:0x%06X," REC_709 ",format=yuv420p",
             (unsigned)paper);
}

/* One palette of the whole film keeps it small, but ffmpeg then holds all frames; long films have a
 * palette for each frame. */
static void filter_gif(const ffmpeg_film *f, char *filter, size_t size) {
    const bool whole = (double)f->width * f->height * f->count < 250e6;
    snprintf(filter, size,
             "split[a][b];[a]palettegen=stats_mode=%s:reserve_transparent=%d[p];"
             "[b][p]paletteuse=dither=none%s",
             whole ? "full" : "single", !f->opaque, whole ? "" : ":new=1");
}

static const char *const rec_709[] = {"-colorspace",  "bt709",      "-color_primaries",
                                      "bt709",        "-color_trc", "bt709",
                                      "-color_range", "tv",         NULL};
static const char *const mp4[] = {"-c:v", "libx264", "-preset", "medium", "-crf", "16", NULL};
static const char *const mp4_in_file[] = {"-movflags", "+faststart", "-f", "mp4", NULL};
static const char *const mp4_in_pipe[] = {"-movflags", "frag_keyframe+empty_moov", "-f", "mp4",
                                          NULL};
static const char *const webm[] = {"-c:v",      "libvpx-vp9", "-crf", "20",        "-b:v",
                                   "0",         "-row-mt",    "1",    "-deadline", "good",
                                   "-cpu-used", "4",          "-f",   "webm",      NULL};
static const char *const gif[] = {"-loop", "0", "-f", "gif", NULL};
static const char *const apng[] = {"-plays", "0", "-pred", "mixed", "-f", "apng", NULL};

static void add_format(command *c, const ffmpeg_film *f) {
    const bool complex = f->format == FORMAT_GIF;
    add(c, (const char *const[]){complex ? "-filter_complex" : "-vf", c->filter, NULL});
    switch (f->format) {
    case FORMAT_MP4:
        filter_mp4(f, c->filter, sizeof c->filter);
        add(c, mp4);
        add(c, rec_709);
        add(c, f->file ? mp4_in_file : mp4_in_pipe);
        break;
    case FORMAT_WEBM:
        snprintf(c->filter, sizeof c->filter, REC_709 ",format=%s",
                 f->opaque ? "yuv420p" : "yuva420p");
        add(c, rec_709);
        add(c, webm);
        break;
    case FORMAT_GIF:
        filter_gif(f, c->filter, sizeof c->filter);
        add(c, gif);
        break;
    default:
        snprintf(c->filter, sizeof c->filter, "format=%s", f->opaque ? "rgb24" : "rgba");
        add(c, apng);
    }
}

static void make_command(command *c, const ffmpeg_film *f) {
    snprintf(c->size, sizeof c->size, "%ux%u", f->width, f->height);
    snprintf(c->rate, sizeof c->rate, "%.9g", f->fps);
    /* a name could have a colon in it, or begin with a dash */
    snprintf(c->file, sizeof c->file, "%s%s", f->file ? "file:" : "pipe:1", f->file ? f->file : "");
    const char *const input[] = {
        "ffmpeg",   "-hide_banner",  "-loglevel", "error",       "-nostdin", "-y",         "-f",
        "rawvideo", "-pixel_format", "rgba",      "-video_size", c->size,    "-framerate", c->rate,
        "-i",       "pipe:0",        "-an",       NULL};
    add(c, input);
    add_format(c, f);
    add(c, (const char *const[]){c->file, NULL});
}

/* ---- the process ---- */

static void become(const char *program, command *c, int frames, int target, int words) {
    setpgid(0, 0);
    signal(SIGPIPE, SIG_DFL);
    signal(SIGINT, SIG_DFL);
    signal(SIGTERM, SIG_DFL);
    signal(SIGHUP, SIG_DFL);
    if (dup2(frames, STDIN_FILENO) < 0 || dup2(target, STDOUT_FILENO) < 0 ||
        dup2(words, STDERR_FILENO) < 0)
        _exit(126);
    char *arguments[WORDS_MOST];
    memcpy(arguments, c->words, sizeof arguments); /* execv changes none */
    execv(program, arguments);
    dprintf(STDERR_FILENO, "%s: %s\n", program, strerror(errno));
    _exit(127);
}

pid_t ffmpeg_start(const ffmpeg_film *film, int frames, int target, int words) {
    char program[4096];
    if (!ffmpeg_find(program, sizeof program)) return errno = ENOENT, -1;
    command *const c = calloc(1, sizeof *c);
    if (!c) return -1;
    make_command(c, film);
    const pid_t child = fork();
    if (child == 0) become(program, c, frames, target, words);
    free(c);
    return child;
}
