/* steady PROGRAM "OPTIONS" MODEL [FRAMES]: how steady are lines while a model turns?
 *
 * Draws a slow turn (FRAMES, 120, of half a degree each, at 800x600 unless OPTIONS have a --size;
 * the eye keeps its distance) by running the program, and prints one number: the share of line
 * pixels that appear or vanish from one frame to the next, in the mean over the turn. A pixel
 * appears that is further than 2 px from all ink of the frame before, and vanishes if it is further
 * than that from all ink of the next.
 *
 * One process per processor draws a run of frames, and the first of the next one's too, and sends
 * the sum over its pairs of neighbours through a pipe. */
#define _DEFAULT_SOURCE /* fork, mkdtemp */
#include "ink.h"

#include <drypoint/camera.h>
#include <drypoint/io.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { FRAMES = 120, WORKERS_MAX = 64, WORDS_MAX = 256, FEW = 64 /* words of our own */ };

static const double step = 0.5, start = 45, elevation = 23, fov = 35; /* degrees */
static const double near = 2;                                         /* px */
static const double degree = 3.14159265358979323846 / 180;

/* What is drawn, and from where. */
typedef struct turn {
    const char *program, *model;
    const char *words[WORDS_MAX]; /* of the options, NULL after them */
    size_t count;
    bool sized; /* the options say --size */
    double centre[3], distance;
    const char *folder; /* for pictures */
} turn;

/* The eye's distance from the box's centre is such that the box's sphere is seen whole. */
static bool find_distance(turn *t) {
    dp_source *source = NULL;
    dp_extent extent;
    dp_diag diag = {0};
    dp_result result = dp_io_open(t->model, NULL, &source, &diag);
    if (!result) result = dp_source_extent(source, &extent, &diag);
    dp_source_destroy(source);
    if (result) return fprintf(stderr, "steady: %s: %s\n", t->model, diag.message), false;
    double square = 0;
    for (int k = 0; k < 3; k++) {
        const double side = extent.exact_max[k] - extent.exact_min[k];
        t->centre[k] = extent.exact_min[k] + side / 2;
        square += side * side;
    }
    t->distance = sqrt(square) / 2 / sin(fov * degree / 2);
    return true;
}

/* Cuts the text of options, which stays theirs, at spaces. */
static void cut_options(turn *t, char *text) {
    for (char *word = strtok(text, " "); word && t->count + 1 < WORDS_MAX - FEW;
         word = strtok(NULL, " ")) {
        t->words[t->count++] = word;
        t->sized = t->sized || !strncmp(word, "--size", 6);
    }
}

/* Becomes the program, drawing one frame into a file. */
static void become_program(const turn *t, int frame, const char *picture) {
    const double azimuth = (start + step * frame) * degree;
    const double direction[3] = {cos(elevation * degree) * sin(azimuth), sin(elevation * degree),
                                 cos(elevation * degree) * cos(azimuth)};
    char eye[128], target[128], angle[32];
    snprintf(eye, sizeof eye, "--eye=%.9g,%.9g,%.9g", t->centre[0] + t->distance * direction[0],
             t->centre[1] + t->distance * direction[1], t->centre[2] + t->distance * direction[2]);
    snprintf(target, sizeof target, "--target=%.9g,%.9g,%.9g", t->centre[0], t->centre[1],
             t->centre[2]);
    snprintf(angle, sizeof angle, "--fov=%g", fov);
    const char *words[WORDS_MAX] = {t->program,  t->model, "-o", picture, "--quiet",
                                    "--threads", "1",      eye,  target,  angle};
    size_t count = 10;
    if (!t->sized) words[count++] = "--size=800x600";
    memcpy(words + count, t->words, (t->count + 1) * sizeof *words);
    execvp(t->program, (char *const *)words);
    perror(t->program);
    _exit(127);
}

/* Draws one frame. False: the program failed, and said why. */
static bool draw(const turn *t, int frame, ink *out) {
    char picture[512];
    snprintf(picture, sizeof picture, "%s/%d.png", t->folder, (int)getpid());
    const pid_t child = fork();
    if (child < 0) return perror("steady: fork"), false;
    if (!child) become_program(t, frame, picture);
    int status = 0;
    const bool drawn = waitpid(child, &status, 0) == child && !status && ink_read(picture, out);
    unlink(picture);
    return drawn;
}

/* The share of pixels that appear or vanish from a to b; negative: no memory. */
static double change(const ink *a, const ink *b) {
    const size_t all = a->count + b->count;
    const size_t kept = ink_near(b, a, near), stay = ink_near(a, b, near);
    if (kept == SIZE_MAX || stay == SIZE_MAX) return -1;
    return all ? (double)(all - kept - stay) / (double)all : 0;
}

/* The sum of changes over the pairs that begin with frames from … to - 1; negative: it failed. */
static double changes(const turn *t, int from, int to) {
    ink before = {0}, after = {0};
    double sum = from < to && !draw(t, from, &before) ? -1 : 0;
    for (int frame = from; frame < to && sum >= 0; frame++) {
        const bool drawn = draw(t, frame + 1, &after);
        const double one = drawn ? change(&before, &after) : -1;
        sum = one < 0 ? -1 : sum + one;
        ink_free(&before);
        before = after;
        after = (ink){0};
    }
    ink_free(&before);
    return sum;
}

static int processors(void) {
    const long count = sysconf(_SC_NPROCESSORS_ONLN);
    return count < 1 ? 1 : count > WORKERS_MAX ? WORKERS_MAX : (int)count;
}

/* Begins a process that writes its share's sum into the pipe. */
static bool begin_worker(const turn *t, int to_parent, int from, int to) {
    const pid_t child = fork();
    if (child < 0) return perror("steady: fork"), false;
    if (child) return true;
    const double sum = changes(t, from, to);
    const bool written = write(to_parent, &sum, sizeof sum) == sizeof sum;
    _exit(written ? EXIT_SUCCESS : EXIT_FAILURE);
}

/* The mean change over the turn; negative: it failed. */
static double measure(const turn *t, int frames) {
    const int pairs = frames - 1, workers = processors();
    int ends[2], begun = 0;
    if (pipe(ends)) return perror("steady: pipe"), -1;
    while (begun < workers &&
           begin_worker(t, ends[1], pairs * begun / workers, pairs * (begun + 1) / workers))
        begun++;
    close(ends[1]);
    double sum = begun < workers ? -1 : 0, one;
    for (int k = 0; k < begun; k++) {
        if (read(ends[0], &one, sizeof one) != sizeof one) one = -1;
        sum = one < 0 || sum < 0 ? -1 : sum + one;
    }
    close(ends[0]);
    while (wait(NULL) > 0) {
    }
    return sum < 0 ? -1 : sum / pairs;
}

int main(int argc, char **argv) {
    const int frames = argc == 5 ? atoi(argv[4]) : FRAMES;
    if (argc < 4 || argc > 5 || frames < 2)
        return fprintf(stderr, "usage: steady PROGRAM \"OPTIONS\" MODEL [FRAMES]\n"), 2;
    const char *const tmp = getenv("TMPDIR");
    char folder[512];
    snprintf(folder, sizeof folder, "%s/steady-XXXXXX", tmp && *tmp ? tmp : P_tmpdir);
    turn t = {.program = argv[1], .model = argv[3], .folder = folder};
    cut_options(&t, argv[2]);
    if (!find_distance(&t)) return EXIT_FAILURE;
    if (!mkdtemp(folder)) return perror("steady: TMPDIR"), EXIT_FAILURE;
    const double mean = measure(&t, frames);
    rmdir(folder);
    if (mean < 0) return fprintf(stderr, "steady: not all frames could be drawn\n"), EXIT_FAILURE;
    printf("%.5f\n", mean);
    return EXIT_SUCCESS;
}
