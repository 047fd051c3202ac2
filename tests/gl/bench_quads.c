/* Processor time of a picture of a model by OpenGL, and share of its pixels that are the CPU's: flat, strokes, and added polygons
 * with each between-test.
 *
 *     bench_quads MODEL|shape:NAME [width height samples px]
 *
 * With a rasterizer that runs on the CPU, as Mesa's llvmpipe, that is the time of all its threads. DP_TEST_PICTURES=folder keeps
 * pictures; DP_BENCH_ONLY=name draws one way alone. */
#include "gl/context.h"

#include <drypoint/io.h>
#include <drypoint/shapes.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef struct way {
    const char *name;
    dp_style style;
} way;

static const way ways[] = {
    {"flat", {.lines = DP_NO_LINES}},
    {"strokes", {0}},
    {"plane", {.ink = DP_INK_QUADS}},
    {"interval-1", {.ink = DP_INK_QUADS, .between = DP_BETWEEN_INTERVAL}},
    {"interval-2", {.ink = DP_INK_QUADS, .between = DP_BETWEEN_INTERVAL, .passes = 2}},
    {"stencil", {.ink = DP_INK_QUADS, .between = DP_BETWEEN_STENCIL}},
    {"paper-plane", {.ink = DP_INK_QUADS, .method = DP_METHOD_PAPER}},
    {"paper-interval-1",
     {.ink = DP_INK_QUADS, .method = DP_METHOD_PAPER, .between = DP_BETWEEN_INTERVAL}},
};

typedef struct job {
    dp_gl *gl;
    dp_gl_mesh *mesh;
    dp_source *source;
    dp_camera camera;
    dp_gl_target target;
} job;

/* ms of processor time, of all threads. */
static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

static bool draw(const job *j, const dp_style *style, uint8_t *rgba) {
    dp_diag diag;
    dp_result result = dp_gl_draw(j->gl, &j->mesh, 1, &j->camera, style, &j->target, &diag);
    if (!result) result = dp_gl_read(j->gl, &j->target, rgba, 0, &diag);
    if (result) fprintf(stderr, "%s\n", diag.message);
    return !result;
}

/* The first picture, with which shaders are compiled, and the best of three after it. */
static bool measure(const job *j, const way *w, float px) {
    const uint32_t width = j->target.width, height = j->target.height;
    const size_t bytes = (size_t)4 * width * height;
    uint8_t *const rgba = malloc(bytes);
    dp_style style = w->style;
    char name[80];
    for (int i = 0; i < DP_LINE_COUNT; i++) style.line[i].width = px;
    const double start = now();
    bool good = draw(j, &style, rgba);
    const double first = now() - start;
    double best = 1e30;
    for (int i = 0; i < 3 && good; i++) {
        const double from = now();
        good = draw(j, &style, rgba);
        if (now() - from < best) best = now() - from;
    }
    if (good) {
        uint8_t *const cpu =
            gl_test_draw_cpu(j->source, &j->camera, &style, width, height, j->target.samples);
        printf("%-18s %8.0f ms, first %8.0f ms; as the CPU's within 2 levels: %.5f\n", w->name,
               best, first, gl_test_alike(rgba, cpu, width, height, 2));
        snprintf(name, sizeof name, "bench-%s-gpu", w->name),
            gl_test_keep(name, rgba, width, height);
        snprintf(name, sizeof name, "bench-%s-cpu", w->name),
            gl_test_keep(name, cpu, width, height);
        free(cpu);
    }
    free(rgba);
    return good;
}

static dp_result open_model(const char *name, dp_source **out, dp_diag *diag) {
    const dp_shape shape = {.name = name + 6};
    return strncmp(name, "shape:", 6) ? dp_io_open(name, NULL, out, diag)
                                      : dp_source_from_shape(&shape, out, diag);
}

static bool prepare(job *j, const char *model, uint32_t width, uint32_t height, dp_diag *diag) {
    const dp_fit fit = {.aspect = (double)width / height};
    dp_result result = open_model(model, &j->source, diag);
    if (!result) result = dp_camera_fit_source(&j->camera, &fit, j->source, NULL, diag);
    if (!result) result = dp_gl_mesh_from_source(j->gl, j->source, &j->mesh, diag);
    if (result) fprintf(stderr, "%s\n", diag->message);
    return !result;
}

static int run(gl_test *t, int count, char **words) {
    const uint32_t width = count > 3 ? (uint32_t)atoi(words[2]) : 800,
                   height = count > 3 ? (uint32_t)atoi(words[3]) : 500,
                   samples = count > 4 ? (uint32_t)atoi(words[4]) : 4;
    const float px = count > 5 ? (float)atof(words[5]) : 2;
    const char *const only = getenv("DP_BENCH_ONLY");
    job j = {.gl = t->gl, .target = gl_test_target(t, width, height, samples)};
    dp_diag diag;
    if (!prepare(&j, words[1], width, height, &diag)) return 1;
    printf("%s, %s, %u x %u, %u samples, %g px\n", dp_gl_device(t->gl), words[1], width, height,
           samples, (double)px);
    bool good = true;
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++)
        if (!only || !strcmp(only, ways[i].name)) good &= measure(&j, &ways[i], px);
    dp_gl_mesh_destroy(j.mesh);
    dp_source_destroy(j.source);
    return !good;
}

int main(int count, char **words) {
    void *state = NULL;
    if (count < 2) {
        fprintf(stderr, "bench_quads MODEL|shape:NAME [width height samples px]\n");
        return 2;
    }
    setvbuf(stdout, NULL, _IOLBF, 0);
    if (gl_test_setup(&state) || !((gl_test *)state)->gl) return 2;
    const int code = run(state, count, words);
    gl_test_teardown(&state);
    return code;
}
