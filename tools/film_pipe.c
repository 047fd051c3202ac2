/* Writes a film's frames to a file, or through ffmpeg into one.
 *
 * A regular file is written under another name in the same folder and renamed when it is whole; the
 * old file stays until then. Standard output, devices and pipes are written in place.
 *
 * ffmpeg runs in a process group of its own, so that Ctrl-C reaches this program alone, which ends
 * it and removes what is half done. Its words go to a file without a name and are told if it fails.
 * Nothing here waits without looking for Ctrl-C now and then. */
#define _XOPEN_SOURCE 700 /* realpath */
#include "film_pipe.h"
#include "ffmpeg.h"
#include "files.h"
#include "output.h"
#include "progress.h"
#include "report.h"
#include "words.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { TRIES = 1000, WAIT = 200 /* ms */ };

static const char *spoken(const char *path) { return strcmp(path, "-") ? path : "standard output"; }

static int fail(const film_pipe *p, int error) {
    wrong_usage("cannot write %s: %s%s", spoken(p->path), strerror(error),
                error == ENOSPC ? "; make room or choose another place" : "");
    return EXIT_FAILED;
}

bool film_pipe_possible(const char *path, int format) {
    char program[4096];
    if (format == FORMAT_RGBA || ffmpeg_find(program, sizeof program)) return true;
    return wrong_usage("-o %s: such films are made by ffmpeg, and there is none on PATH; install "
                       "it (apt install ffmpeg, brew install ffmpeg), or write pictures: "
                       "-o %.*s-%%04d.png",
                       path, strcmp(path, "-") ? output_stem(path) : 4,
                       strcmp(path, "-") ? path : "film");
}

/* ---- the file ---- */

/* Makes a file beside the target, with the old one's permissions. */
static int create_beside(film_pipe *p, const struct stat *old) {
    const int folder = (int)(output_name(p->final) - p->final);
    const size_t size = strlen(p->final) + 64;
    p->temporary = malloc(size);
    if (!p->temporary) return errno = ENOMEM, -1;
    for (int k = 0; k < TRIES; k++) {
        snprintf(p->temporary, size, "%.*s.drypoint-%ld-%d.tmp", folder, p->final, (long)getpid(),
                 k);
        const int made =
            open(p->temporary, O_WRONLY | O_CREAT | O_EXCL | O_NOCTTY | O_CLOEXEC, 0666);
        if (made >= 0 && old) (void)fchmod(made, old->st_mode & 07777); /* may fail, no harm */
        if (made >= 0 || errno != EEXIST) return made;
    }
    return -1;
}

/* Where the film's bytes go; below 0: errno says why not. */
static int open_target(film_pipe *p) {
    struct stat old;
    if (!strcmp(p->path, "-")) return fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
    if (output_in_place(p->path)) return open(p->path, O_WRONLY | O_NOCTTY | O_CLOEXEC);
    const bool exists = !stat(p->path, &old);
    p->final = exists ? realpath(p->path, NULL) : strdup(p->path);
    if (!p->final) return -1;
    const int made = create_beside(p, exists ? &old : NULL);
    if (made < 0) {
        free(p->temporary);
        p->temporary = NULL;
    }
    return made;
}

/* ---- ffmpeg ---- */

static int start_ffmpeg(film_pipe *p, int target) {
    int ends[2];
    p->words = words_open();
    if (p->words < 0 || pipe(ends)) return fail(p, errno);
    for (int k = 0; k < 2; k++) fcntl(ends[k], F_SETFD, FD_CLOEXEC);
    const ffmpeg_film film = {.width = p->shape.width,
                              .height = p->shape.height,
                              .count = p->shape.count,
                              .fps = p->shape.fps,
                              .paper = p->shape.paper,
                              .opaque = p->shape.opaque,
                              .format = p->format,
                              .file = p->temporary};
    p->ffmpeg = ffmpeg_start(&film, ends[0], target, p->words);
    close(ends[0]);
    p->descriptor = ends[1];
    fcntl(p->descriptor, F_SETFL, O_NONBLOCK);
    if (p->ffmpeg > 0) return 0;
    p->ffmpeg = 0;
    wrong_usage("cannot start ffmpeg for %s: %s", spoken(p->path), strerror(errno));
    return EXIT_FAILED;
}

/* Tells why ffmpeg has failed, in its own last words. */
static int report_ffmpeg(const film_pipe *p, int status) {
    char how[80], words[600];
    if (WIFSIGNALED(status))
        snprintf(how, sizeof how, "was ended by a signal (%s)", strsignal(WTERMSIG(status)));
    else if (WEXITSTATUS(status))
        snprintf(how, sizeof how, "failed with exit code %d", WEXITSTATUS(status));
    else
        snprintf(how, sizeof how, "ended before the film did");
    words_tail(p->words, words, sizeof words);
    wrong_usage("%s: ffmpeg %s%s%s", spoken(p->path), how, *words ? ": " : "", words);
    return EXIT_FAILED;
}

/* Waits for ffmpeg to end. False: Ctrl-C came first. */
static bool await_ffmpeg(film_pipe *p, int *status) {
    const struct timespec moment = {.tv_nsec = 10000000};
    for (;;) {
        const pid_t ended = waitpid(p->ffmpeg, status, WNOHANG);
        if (ended > 0 || (ended < 0 && errno != EINTR)) break;
        if (interrupt_seen()) return false;
        nanosleep(&moment, NULL);
    }
    p->ffmpeg = 0;
    return true;
}

/* The pipe to it has broken: it has ended, or will. */
static int lost_ffmpeg(film_pipe *p) {
    int status = 0;
    close(p->descriptor);
    p->descriptor = -1;
    return await_ffmpeg(p, &status) ? report_ffmpeg(p, status) : EXIT_FAILED;
}

/* ---- frames ---- */

int film_pipe_open(const char *path, int format, const film_shape *shape, film_pipe *p) {
    *p =
        (film_pipe){.path = path, .format = format, .shape = *shape, .descriptor = -1, .words = -1};
    const int target = open_target(p);
    if (target < 0) return fail(p, errno);
    if (format == FORMAT_MP4 && !shape->opaque) {
        p->flat = malloc((size_t)shape->width * shape->height * 4);
        if (!p->flat) return close(target), fail(p, ENOMEM);
    }
    if (format == FORMAT_RGBA) {
        p->descriptor = target;
        return 0;
    }
    const int code = start_ffmpeg(p, target);
    close(target);
    return code;
}

/* Pixels over white. */
static const uint8_t *flatten(const film_pipe *p, const uint8_t *rgba) {
    const size_t n = (size_t)p->shape.width * p->shape.height;
    if (!p->flat) return rgba;
    for (size_t i = 0; i < n; i++) {
        const uint32_t a = rgba[4 * i + 3];
        for (int k = 0; k < 3; k++)
            p->flat[4 * i + k] = (uint8_t)((rgba[4 * i + k] * a + 255 * (255 - a) + 127) / 255);
        p->flat[4 * i + 3] = 255;
    }
    return p->flat;
}

/* Writes some bytes when there is room for them; how many, 0: not yet, below 0: errno says why. */
static ssize_t write_some(const film_pipe *p, const uint8_t *bytes, size_t size) {
    /* so little never blocks a pipe that has room at all */
    const size_t share = p->ffmpeg || p->temporary || size < 4096 ? size : 4096;
    struct pollfd room = {.fd = p->descriptor, .events = POLLOUT};
    const int ready = poll(&room, 1, WAIT);
    if (ready <= 0) return ready < 0 && errno != EINTR ? -1 : 0;
    const ssize_t count = write(p->descriptor, bytes, share);
    return count < 0 && (errno == EINTR || errno == EAGAIN) ? 0 : count;
}

int film_pipe_write(film_pipe *p, const uint8_t *rgba) {
    const size_t size = (size_t)p->shape.width * p->shape.height * 4;
    const uint8_t *const bytes = flatten(p, rgba);
    for (size_t done = 0; done < size;) {
        const ssize_t count = write_some(p, bytes + done, size - done);
        if (interrupt_seen()) return EXIT_FAILED;
        if (count < 0 && p->ffmpeg) return lost_ffmpeg(p);
        if (count < 0) return fail(p, errno);
        done += (size_t)count;
    }
    return 0;
}

/* ---- the end ---- */

static void forget(film_pipe *p) {
    if (p->descriptor >= 0) close(p->descriptor);
    if (p->words >= 0) close(p->words);
    free(p->final);
    free(p->temporary);
    free(p->flat);
    *p = (film_pipe){.descriptor = -1, .words = -1};
}

void film_pipe_abandon(film_pipe *p) {
    if (p->ffmpeg > 0) {
        kill(-p->ffmpeg, SIGKILL); /* and what it has started */
        kill(p->ffmpeg, SIGKILL);  /* it may not have a group yet */
        while (waitpid(p->ffmpeg, NULL, 0) < 0 && errno == EINTR) {
        }
    }
    if (p->temporary) unlink(p->temporary);
    if (p->path) forget(p);
}

/* Gives the whole file its name. An encoder that says that all went well must have written one. */
static int put_in_place(film_pipe *p) {
    struct stat made;
    if (!p->temporary) return 0;
    if (p->format != FORMAT_RGBA && !stat(p->temporary, &made) && made.st_size == 0) {
        wrong_usage("%s: ffmpeg wrote nothing: is the one on PATH whole?", spoken(p->path));
        return EXIT_FAILED;
    }
    return rename(p->temporary, p->final) ? fail(p, errno) : 0;
}

int film_pipe_finish(film_pipe *p) {
    int status = 0, code = 0;
    const int closed = close(p->descriptor);
    const int error = errno;
    p->descriptor = -1;
    if (p->ffmpeg && !await_ffmpeg(p, &status))
        code = EXIT_FAILED;
    else if (status)
        code = report_ffmpeg(p, status);
    else if (closed)
        code = fail(p, error);
    else
        code = put_in_place(p);
    if (code) return code;
    free(p->temporary);
    p->temporary = NULL;
    forget(p);
    return 0;
}
