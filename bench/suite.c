/* suite --main MODEL [options] MODEL…: how a frame's time depends on everything it could depend on.
 *
 * Every row of the table below is a picture. It is drawn in turn by up to six variants: the row
 * itself, the same flat white, and OpenGL on the CPU (peers/llvmpipe.c) flat and with lines,
 * without and with 4 samples. Whoever has had the least time so far draws next: so all live through
 * the same moods of a machine that does other things too, and ratios hold where times do not. A
 * variant's first frame after a change, in which memory grows and shaders compile, is thrown away.
 *
 * One JSON object per line on standard output. Rows about triangles run for every MODEL, the others
 * for the main one. --seconds is what all may take: rows get equal shares of what is left. */
#include "peer.h"

#include <drypoint/draw.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { FRAMES_MAX = 200, OWN_FRAMES_MIN = 3, MODELS_MAX = 16 };
/* Above this a frame with lines takes OpenGL so long that there would be time for nothing else. */
static const double PEER_LINES_TRIANGLES_MAX = 4e6;

#define FOUR (DP_SIL_RIDGE_VALLEY | DP_INTERSECTION)

typedef struct row {
    const char *group, *label;
    unsigned width, height, samples, threads; /* 0: 1680, 1050, 4, one per processor */
    uint32_t lines;                           /* 0: the four classes of the paper */
    float line_width;                         /* px; 0: 2 */
    dp_ink ink;
    dp_method method;
    bool edge_table_off, cull;
    dp_shading shading;
    dp_edge_detector map;
    bool object_space;
    bool quick; /* in the short run too */
} row;

static const row rows[] = {
    {.group = "pixels", .label = "0.5 MP", .width = 896, .height = 560, .quick = true},
    {.group = "pixels", .label = "4.1 MP", .width = 2560, .height = 1600},
    {.group = "pixels", .label = "8.3 MP", .width = 3640, .height = 2275, .quick = true},
    {.group = "pixels", .label = "33 MP", .width = 7280, .height = 4550},
    {.group = "width", .label = "1 px", .line_width = 1},
    {.group = "width", .label = "4 px", .line_width = 4},
    {.group = "width", .label = "8 px", .line_width = 8},
    {.group = "width", .label = "16 px", .line_width = 16},
    {.group = "width", .label = "24 px", .line_width = 24, .quick = true},
    {.group = "samples", .label = "1", .samples = 1, .quick = true},
    {.group = "samples", .label = "8", .samples = 8},
    {.group = "samples", .label = "16", .samples = 16, .quick = true},
    {.group = "threads", .label = "1", .threads = 1, .quick = true},
    {.group = "lines", .label = "silhouette", .lines = DP_SILHOUETTE, .quick = true},
    {.group = "lines", .label = "ridge", .lines = DP_RIDGE},
    {.group = "lines", .label = "valley", .lines = DP_VALLEY},
    {.group = "lines", .label = "intersection", .lines = DP_INTERSECTION, .quick = true},
    {.group = "lines", .label = "border", .lines = DP_BORDER},
    {.group = "lines", .label = "all five", .lines = DP_ALL_LINES, .quick = true},
    {.group = "method", .label = "ink=quads", .ink = DP_INK_QUADS, .quick = true},
    {.group = "method",
     .label = "ink=quads, as printed",
     .ink = DP_INK_QUADS,
     .method = DP_METHOD_PAPER},
    {.group = "method", .label = "edge table off", .edge_table_off = true},
    {.group = "method", .label = "back faces culled", .cull = true, .quick = true},
    {.group = "shading",
     .label = "edge map, diagonal",
     .lines = DP_NO_LINES,
     .map = DP_EDGE_MAP_DIAGONAL,
     .quick = true},
    {.group = "shading",
     .label = "edge map, C1",
     .lines = DP_NO_LINES,
     .map = DP_EDGE_MAP_C1,
     .quick = true},
    {.group = "shading",
     .label = "Gooch",
     .lines = DP_NO_LINES,
     .shading = DP_SHADING_GOOCH,
     .quick = true},
    {.group = "shading",
     .label = "toon, cartoon map",
     .lines = DP_NO_LINES,
     .shading = DP_SHADING_TOON,
     .quick = true},
    {.group = "shading",
     .label = "hatching on the screen",
     .lines = DP_NO_LINES,
     .shading = DP_SHADING_HATCH,
     .quick = true},
    {.group = "shading",
     .label = "hatching on the object",
     .lines = DP_NO_LINES,
     .shading = DP_SHADING_HATCH,
     .object_space = true,
     .quick = true},
    {.group = "shading",
     .label = "halftone",
     .lines = DP_NO_LINES,
     .shading = DP_SHADING_HALFTONE,
     .quick = true},
    {.group = "shading", .label = "pencil", .lines = DP_NO_LINES, .shading = DP_SHADING_PENCIL},
};
enum { ROW_COUNT = sizeof rows / sizeof *rows };
static const row plain_row = {.group = "triangles", .label = "", .quick = true};

enum { OWN, OWN_FLAT, PEER_FLAT_0, PEER_FLAT_4, PEER_LINES_0, PEER_LINES_4, VARIANT_COUNT };
static const char *const variant_names[VARIANT_COUNT] = {
    "own", "flat", "llvmpipe_flat_0", "llvmpipe_flat_4", "llvmpipe_lines_0", "llvmpipe_lines_4"};

typedef struct variant {
    bool gone; /* not measured, or failed */
    unsigned count;
    double spent; /* ms, thrown away frames too */
    frame_time frames[FRAMES_MAX];
    float stages[DP_STAGE_COUNT][FRAMES_MAX]; /* ms; our own only */
} variant;

typedef struct suite {
    const char *models[MODELS_MAX], *main_model, *peer_program;
    unsigned model_count;
    bool quick;
    double deadline; /* ms */
    unsigned rows_left;
    /* The model at hand. */
    const char *model;
    dp_source *source;
    dp_extent extent;
    peer peer;
    unsigned peer_width, peer_height; /* the size that the peer is warm for */
    bool peer_warm[VARIANT_COUNT];
    double last_ms[VARIANT_COUNT]; /* of the last frame; 0: none yet */
    /* The row at hand. */
    dp_context *context;
    dp_target target;
    dp_camera camera;
    dp_style styles[2]; /* OWN, OWN_FLAT */
    dp_stats stats;     /* of the last frame of OWN */
    variant variants[VARIANT_COUNT];
} suite;

static double now_ms(clockid_t clock) {
    struct timespec t;
    clock_gettime(clock, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static int by_value(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Of count sorted values, between the two nearest; at in [0, 1]. */
static double quantile(const double *sorted, unsigned count, double at) {
    const double place = at * (count - 1);
    const unsigned below = (unsigned)place, above = below + 1 < count ? below + 1 : below;
    return sorted[below] + (place - below) * (sorted[above] - sorted[below]);
}

static bool draw_own(suite *s, int which, frame_time *time, dp_stats *stats) {
    dp_diag diag = {0};
    const double start = now_ms(CLOCK_MONOTONIC), cpu_start = now_ms(CLOCK_PROCESS_CPUTIME_ID);
    const dp_result result =
        dp_draw(s->context, s->source, &s->camera, &s->styles[which], &s->target, &diag);
    time->ms = now_ms(CLOCK_MONOTONIC) - start;
    time->cpu_ms = now_ms(CLOCK_PROCESS_CPUTIME_ID) - cpu_start;
    dp_stats_of(s->context, stats);
    if (result) fprintf(stderr, "suite: %s: %s\n", s->model, diag.message);
    return !result;
}

/* One frame of a variant; `keep` tells whether it counts. */
static void draw_variant(suite *s, int which, bool keep) {
    variant *const v = &s->variants[which];
    frame_time *const time = &v->frames[v->count];
    dp_stats stats = {0};
    v->gone = which <= OWN_FLAT ? !draw_own(s, which, time, &stats)
                                : !peer_draw(&s->peer, s->target.width, s->target.height,
                                             which == PEER_FLAT_4 || which == PEER_LINES_4 ? 4 : 0,
                                             which == PEER_LINES_0 || which == PEER_LINES_4, time);
    if (v->gone) return;
    v->spent += time->ms;
    s->last_ms[which] = time->ms;
    if (which == OWN) s->stats = stats;
    for (int k = 0; k < DP_STAGE_COUNT; k++) v->stages[k][v->count] = (float)stats.stage_ms[k];
    v->count += keep;
}

/* A peer's frame that would eat up a row's share of the time is drawn only where it is the
 * yardstick: in the rows about triangles and about quads as ink. */
static bool too_slow(const suite *s, const row *r, int which, double share) {
    const double triangles = (double)(s->extent.corners - 2 * s->extent.polygons);
    if (which >= PEER_LINES_0 && triangles > PEER_LINES_TRIANGLES_MAX) return true;
    const bool yardstick = r == &plain_row || r->ink == DP_INK_QUADS;
    return !yardstick && which > OWN_FLAT && s->last_ms[which] > share / 3;
}

/* First frames, which find memory cold. A peer's that takes longer than all frames should is kept:
 * there will be no better. */
static void warm_up(suite *s, const row *r, double share) {
    if (s->peer_width != s->target.width || s->peer_height != s->target.height)
        memset(s->peer_warm, 0, sizeof s->peer_warm);
    s->peer_width = s->target.width;
    s->peer_height = s->target.height;
    for (int k = 0; k < VARIANT_COUNT; k++) {
        variant *const v = &s->variants[k];
        *v = (variant){.gone = too_slow(s, r, k, share)};
        if (v->gone || s->peer_warm[k]) continue;
        draw_variant(s, k, false);
        if (!v->gone && k > OWN_FLAT && v->spent > share) v->count = 1;
        v->spent = 0;
        s->peer_warm[k] = k > OWN_FLAT;
    }
}

/* The variant that has had the least time and needs or may have more; -1: none. */
static int next_variant(const suite *s, double share, bool time_left) {
    int best = -1;
    for (int k = 0; k < VARIANT_COUNT; k++) {
        const variant *const v = &s->variants[k];
        const unsigned least = k <= OWN_FLAT ? OWN_FRAMES_MIN : 1;
        if (v->gone || v->count == FRAMES_MAX || (!time_left && v->count >= least)) continue;
        if (best < 0 || v->spent < s->variants[best].spent) best = k;
    }
    return best;
}

static void measure(suite *s, const row *r) {
    const double start = now_ms(CLOCK_MONOTONIC);
    const double left = s->deadline > start ? s->deadline - start : 0;
    const double share = left / (s->rows_left ? s->rows_left : 1);
    int which;
    warm_up(s, r, share);
    while ((which = next_variant(s, share, now_ms(CLOCK_MONOTONIC) < start + share)) >= 0)
        draw_variant(s, which, true);
    if (s->rows_left) s->rows_left--;
}

static void print_variant(const variant *v, bool stages) {
    double ms[FRAMES_MAX], cpu[FRAMES_MAX];
    if (v->gone || !v->count) {
        printf("null");
        return;
    }
    for (unsigned k = 0; k < v->count; k++) ms[k] = v->frames[k].ms, cpu[k] = v->frames[k].cpu_ms;
    qsort(ms, v->count, sizeof *ms, by_value);
    qsort(cpu, v->count, sizeof *cpu, by_value);
    printf("{\"frames\": %u, \"frame_ms\": %.3f, \"frame_ms_min\": %.3f, \"frame_ms_max\": %.3f, "
           "\"frame_ms_q1\": %.3f, \"frame_ms_q3\": %.3f, \"cpu_ms\": %.3f, \"cpu_ms_min\": %.3f",
           v->count, quantile(ms, v->count, 0.5), ms[0], ms[v->count - 1],
           quantile(ms, v->count, 0.25), quantile(ms, v->count, 0.75), quantile(cpu, v->count, 0.5),
           cpu[0]);
    if (stages) printf(", \"stages\": {");
    for (int stage = 0; stages && stage < DP_STAGE_COUNT; stage++) {
        for (unsigned k = 0; k < v->count; k++) ms[k] = v->stages[stage][k];
        qsort(ms, v->count, sizeof *ms, by_value);
        printf("%s\"%s\": %.3f", stage ? ", " : "", dp_stage_name((dp_stage)stage),
               quantile(ms, v->count, 0.5));
    }
    printf(stages ? "}}" : "}");
}

static const char *name_of(const char *path) {
    const char *const slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static void print_row(const suite *s, const row *r) {
    const dp_stats *const stats = &s->stats;
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    printf("{\"group\": \"%s\", \"label\": \"%s\", \"model\": \"%s\", \"main\": %s, "
           "\"triangles\": %llu, \"vertices\": %llu, \"width\": %u, \"height\": %u, \"samples\": "
           "%u, \"threads\": %ld, "
           "\"line_width\": %g, \"segments\": %llu, \"added_polygons\": %llu, \"bytes\": %llu",
           r->group, r->label, name_of(s->model), s->model == s->main_model ? "true" : "false",
           (unsigned long long)stats->triangles, (unsigned long long)s->extent.vertices,
           s->target.width, s->target.height, s->target.samples,
           r->threads ? (long)r->threads : processors,
           r->line_width > 0 ? (double)r->line_width : 2, (unsigned long long)stats->segments,
           (unsigned long long)stats->added_polygons, (unsigned long long)stats->bytes);
    for (int k = 0; k < VARIANT_COUNT; k++) {
        printf(", \"%s\": ", variant_names[k]);
        print_variant(&s->variants[k], k <= OWN_FLAT);
    }
    printf("}\n");
    fflush(stdout);
}

static void set_styles(suite *s, const row *r) {
    dp_style style = {.lines = r->lines ? r->lines : FOUR,
                      .method = r->method,
                      .ink = r->ink,
                      .cull_back_faces = r->cull,
                      .edge_table_off = r->edge_table_off,
                      .shade = {.shading = r->shading, .object_space = r->object_space},
                      .edge_map = {.detector = r->map}};
    for (int k = 0; k < DP_LINE_COUNT; k++) style.line[k].width = r->line_width;
    s->styles[OWN] = s->styles[OWN_FLAT] = style;
    s->styles[OWN_FLAT].lines = DP_NO_LINES;
    s->styles[OWN_FLAT].shade.shading = DP_SHADING_FLAT;
    s->styles[OWN_FLAT].edge_map.detector = DP_EDGE_MAP_OFF;
}

static bool set_up(suite *s, const row *r) {
    s->target = (dp_target){.width = r->width ? r->width : 1680,
                            .height = r->height ? r->height : 1050,
                            .samples = r->samples ? r->samples : 4};
    s->target.rgba = malloc((size_t)4 * s->target.width * s->target.height);
    const dp_context_desc desc = {.threads = r->threads};
    dp_fit fit = {.aspect = (double)s->target.width / s->target.height};
    memcpy(fit.min, s->extent.min, sizeof fit.min);
    memcpy(fit.max, s->extent.max, sizeof fit.max);
    set_styles(s, r);
    return s->target.rgba && !dp_camera_fit(&s->camera, &fit) &&
           !dp_context_create(&desc, &s->context, NULL);
}

static void do_row(suite *s, const row *r) {
    if (s->quick && !r->quick) return;
    fprintf(stderr, "bench: %s, %s %s\n", name_of(s->model), r->group, r->label);
    if (set_up(s, r)) {
        measure(s, r);
        print_row(s, r);
    } else {
        fprintf(stderr, "suite: no memory for this row\n");
    }
    dp_context_destroy(s->context);
    free(s->target.rgba);
    s->context = NULL;
    s->target.rgba = NULL;
}

static bool do_model(suite *s, const char *model) {
    dp_diag diag = {0};
    s->model = model;
    s->peer_width = 0;
    memset(s->last_ms, 0, sizeof s->last_ms);
    if (dp_source_open(model, NULL, &s->source, &diag) ||
        dp_source_extent(s->source, &s->extent, &diag)) {
        fprintf(stderr, "suite: %s: %s\n", model, diag.message);
        dp_source_destroy(s->source);
        return false;
    }
    peer_start(&s->peer, s->peer_program, model);
    do_row(s, &plain_row);
    for (int k = 0; k < ROW_COUNT && model == s->main_model; k++) do_row(s, &rows[k]);
    peer_stop(&s->peer);
    dp_source_destroy(s->source);
    s->source = NULL;
    return true;
}

static unsigned count_rows(const suite *s) {
    unsigned count = s->model_count;
    for (int k = 0; k < ROW_COUNT; k++) count += s->main_model && (!s->quick || rows[k].quick);
    return count;
}

static bool parse(suite *s, int argc, char **argv) {
    double seconds = 480;
    const char *main_model = "";
    for (int k = 1; k < argc; k++) {
        const bool more = k + 1 < argc;
        if (!strcmp(argv[k], "--quick"))
            s->quick = true;
        else if (!strcmp(argv[k], "--seconds") && more)
            seconds = atof(argv[++k]);
        else if (!strcmp(argv[k], "--peer") && more)
            s->peer_program = argv[++k];
        else if (!strcmp(argv[k], "--main") && more)
            main_model = argv[++k];
        else if (argv[k][0] == '-' || s->model_count == MODELS_MAX)
            return false;
        else
            s->models[s->model_count++] = argv[k];
    }
    for (unsigned k = 0; k < s->model_count; k++)
        if (!strcmp(s->models[k], main_model)) s->main_model = s->models[k];
    s->deadline = now_ms(CLOCK_MONOTONIC) + 1e3 * seconds;
    return s->model_count > 0;
}

int main(int argc, char **argv) {
    static suite s;
    if (!parse(&s, argc, argv))
        return fprintf(stderr, "usage: suite [--quick] [--seconds S] [--peer PROGRAM] "
                               "[--main MODEL] MODEL...\n"),
               2;
    signal(SIGPIPE, SIG_IGN); /* a peer that ended is found out by its silence */
    s.rows_left = count_rows(&s);
    bool good = true;
    for (unsigned k = 0; k < s.model_count; k++) good = do_model(&s, s.models[k]) && good;
    return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
