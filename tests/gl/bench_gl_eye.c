/* Random scenes by OpenGL and by the CPU: what the eye (twins/eye.h) sees of both pictures, and how long their lines
 * are.
 *
 *   bench_gl_eye [--seeds 200] [--from 0] [--table-off] [--samples 1] [--write FOLDER]
 *
 * prints the scenes in which the two differ, and what all have in common. And for other judges of pictures:
 *
 *   bench_gl_eye MODEL WIDTH HEIGHT OUT-CPU.png OUT-GL.png EX EY EZ TX TY TZ UX UY UZ FOV
 */
#include "gl/gl_look.h"
#include "twins/eye.h"
#include "twins/scene.h"

#include <drypoint/io.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 300, HEIGHT = 225, CPU = 0, GL = 1 };

typedef struct options {
    uint64_t from, seeds;
    uint32_t samples;
    bool table_off;
    const char *folder;
} options;

typedef struct sheet {
    double recall[2], precision[2], least_recall[2], least_precision[2];
    double recall_apart, precision_apart; /* the most that OpenGL has less */
    double length[2][DP_LINE_COUNT];
    unsigned pixels_apart;
} sheet;

static void keep(const options *o, uint64_t seed, const char *what, const uint8_t *rgba) {
    char path[4096];
    snprintf(path, sizeof path, "%s/%llu-%s.png", o->folder, (unsigned long long)seed, what);
    dp_io_write_png(path, rgba, WIDTH, HEIGHT, 0, NULL);
}

static void write_files(const options *o, uint64_t seed, const eye_truth *truth,
                        const look looks[2]) {
    uint8_t *const marked = malloc((size_t)4 * WIDTH * HEIGHT);
    if (marked == NULL) abort();
    keep(o, seed, "cpu", looks[CPU].rgba);
    keep(o, seed, "gl", looks[GL].rgba);
    eye_mark(truth, looks[GL].rgba, 2, marked);
    keep(o, seed, "gl-eye", marked);
    look_difference(&looks[CPU], &looks[GL], marked);
    keep(o, seed, "difference", marked);
    free(marked);
}

static void print_scene(uint64_t seed, const eye_score scores[2], const look looks[2],
                        uint32_t pixels) {
    printf("seed %llu: recall %.4f %.4f, precision %.4f %.4f, %u px differ; lengths",
           (unsigned long long)seed, scores[CPU].recall, scores[GL].recall, scores[CPU].precision,
           scores[GL].precision, pixels);
    for (int k = 0; k < DP_LINE_COUNT; k++)
        printf(" %.1f/%.1f", looks[CPU].length[k], looks[GL].length[k]);
    printf("\n");
}

static void add(sheet *all, const eye_score scores[2], const look looks[2], uint32_t pixels) {
    for (int i = 0; i < 2; i++) {
        all->recall[i] += scores[i].recall, all->precision[i] += scores[i].precision;
        all->least_recall[i] = fmin(all->least_recall[i], scores[i].recall);
        all->least_precision[i] = fmin(all->least_precision[i], scores[i].precision);
        for (int k = 0; k < DP_LINE_COUNT; k++) all->length[i][k] += looks[i].length[k];
    }
    all->recall_apart = fmax(all->recall_apart, scores[CPU].recall - scores[GL].recall);
    all->precision_apart = fmax(all->precision_apart, scores[CPU].precision - scores[GL].precision);
    all->pixels_apart += pixels > 30;
}

static bool same_lengths(const look looks[2]) {
    int kind;
    return look_lengths(&looks[CPU], &looks[GL], &kind) <= 0;
}

static void draw_both(gl_test *t, dp_context *context, dp_source *source, const dp_camera *camera,
                      const look_how *how, look looks[2]) {
    look_draw_source(context, source, camera, how, &looks[CPU]);
    gl_look_draw(t, source, camera, how, &looks[GL]);
    for (int i = 0; i < 2; i++)
        if (looks[i].diag.result) {
            fprintf(stderr, "%s\n", looks[i].diag.message);
            exit(1);
        }
}

static void draw_scene(gl_test *t, dp_context *context, const options *o, uint64_t seed,
                       look looks[2], sheet *all) {
    static const soup_place here = {.scale = 1};
    const look_how how = {.width = WIDTH,
                          .height = HEIGHT,
                          .samples = o->samples ? o->samples
                                     : seed % 2 ? 1
                                                : 4,
                          .table_off = o->table_off};
    soup_arrays arrays;
    scene s;
    dp_source *source;
    eye_score scores[2];
    scene_make(seed, &s);
    const dp_camera camera = scene_camera(&s, &here, (double)WIDTH / HEIGHT);
    soup_arrays_make(&s.soup, &here, &arrays);
    if (dp_source_from_arrays(&arrays.batch, NULL, &source, NULL)) abort();
    draw_both(t, context, source, &camera, &how, looks);
    eye_truth *const truth = eye_see(&arrays.batch, &camera, WIDTH, HEIGHT, 150, 210);
    for (int i = 0; i < 2; i++) scores[i] = eye_judge(truth, looks[i].rgba, 2);
    const uint32_t pixels = look_pixels(&looks[CPU], &looks[GL]);
    add(all, scores, looks, pixels);
    if (pixels > 30 || !same_lengths(looks) || o->seeds == 1)
        print_scene(seed, scores, looks, pixels);
    if (o->folder) {
        write_files(o, seed, truth, looks);
        char path[4096];
        snprintf(path, sizeof path, "%s/%llu.obj", o->folder, (unsigned long long)seed);
        soup_arrays_write(&arrays, &here, path);
    }
    eye_free(truth);
    dp_source_destroy(source);
    soup_arrays_free(&arrays);
    scene_free(&s);
}

static void print_sheet(const sheet *all, double seeds) {
    static const char *const names[2] = {"CPU", "OpenGL"};
    for (int i = 0; i < 2; i++) {
        printf("%-6s  recall mean %.4f least %.4f, precision mean %.4f least %.4f; px of segments",
               names[i], all->recall[i] / seeds, all->least_recall[i], all->precision[i] / seeds,
               all->least_precision[i]);
        for (int k = 0; k < DP_LINE_COUNT; k++) printf(" %.0f", all->length[i][k]);
        printf("\n");
    }
    printf("at most %.4f less recall and %.4f less precision by OpenGL; pictures differ in %u "
           "scenes\n",
           all->recall_apart, all->precision_apart, all->pixels_apart);
}

static void draw_file(gl_test *t, dp_context *context, char **words, look looks[2]) {
    const look_how how = {
        .width = (uint32_t)atoi(words[1]), .height = (uint32_t)atoi(words[2]), .samples = 4};
    double v[10];
    dp_source *source;
    dp_camera camera;
    dp_diag diag = {0};
    for (int i = 0; i < 10; i++) v[i] = atof(words[5 + i]);
    if (dp_io_open(words[0], NULL, &source, &diag)) {
        fprintf(stderr, "%s\n", diag.message);
        exit(1);
    }
    const double distance = hypot(hypot(v[0] - v[3], v[1] - v[4]), v[2] - v[5]);
    dp_camera_look_at(&camera, v, v + 3, v + 6);
    dp_camera_perspective(&camera, v[9], (double)how.width / how.height, distance / 100,
                          100 * distance);
    draw_both(t, context, source, &camera, &how, looks);
    for (int i = 0; i < 2; i++)
        dp_io_write_png(words[3 + i], looks[i].rgba, how.width, how.height, 0, NULL);
    dp_source_destroy(source);
}

static options parse(int count, char **words) {
    options o = {.seeds = 200};
    for (int i = 1; i < count; i++) {
        const char *const next = i + 1 < count ? words[i + 1] : "";
        if (!strcmp(words[i], "--seeds")) o.seeds = strtoull(next, NULL, 10);
        if (!strcmp(words[i], "--from")) o.from = strtoull(next, NULL, 10);
        if (!strcmp(words[i], "--samples")) o.samples = (uint32_t)strtoul(next, NULL, 10);
        if (!strcmp(words[i], "--write")) o.folder = next;
        if (!strcmp(words[i], "--table-off")) o.table_off = true;
    }
    return o;
}

int main(int argc, char **argv) {
    const options o = parse(argc, argv);
    sheet all = {.least_recall = {1, 1}, .least_precision = {1, 1}};
    look looks[2] = {{0}};
    dp_context *context;
    void *state;
    if (gl_test_setup(&state) || !((gl_test *)state)->gl || dp_context_create(NULL, &context, NULL))
        return 1;
    if (argc == 16)
        draw_file(state, context, argv + 1, looks);
    else {
        for (uint64_t i = 0; i < o.seeds; i++)
            draw_scene(state, context, &o, o.from + i, looks, &all);
        print_sheet(&all, (double)o.seeds);
    }
    for (int i = 0; i < 2; i++) look_free(&looks[i]);
    dp_context_destroy(context);
    return gl_test_teardown(&state);
}
