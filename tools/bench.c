/* drypoint bench MODEL --frames N: draws the same frame N times and reports the median of each
 * time. Loading and the first frame, in which the context's memory grows, are not counted.
 *
 * A model that moves is drawn at a later time in each frame. Then the same polygons are drawn as a model
 * that stands, in a context of its own, and the moved ones are read without being drawn: the three can be
 * compared, whatever else the machine does meanwhile. */
#include "commands.h"
#include "keep.h"
#include "look.h"
#include "objects.h"
#include "page.h"
#include "report.h"

#include <math.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

typedef struct bench {
    dp_source *source;
    dp_context *context;
    dp_texture *texture;
    dp_target target;
    look_data look;
    object_styles objects;
    dp_stats *frames; /* [count] */
    uint32_t count;

    /* of a model that moves */
    dp_context *still_context;  /* NULL: it does not */
    double *still_ms, *read_ms; /* [count] frames of the still one; readings, on one thread */
} bench;

static int by_value(const void *a, const void *b) {
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The median of times[0, count), which it sorts. */
static double median(double *times, uint32_t count) {
    qsort(times, count, sizeof *times, by_value);
    return 0.5 * (times[(count - 1) / 2] + times[count / 2]);
}

static void print_result(const tool_settings *s, const bench *b, double *times) {
    const dp_stats *const last = &b->frames[b->count - 1];
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    for (uint32_t k = 0; k < b->count; k++) times[k] = b->frames[k].frame_ms;
    printf("{\"frames\": %u, \"frame_ms\": %.3f", b->count, median(times, b->count));
    printf(", \"frame_ms_min\": %.3f, \"frame_ms_max\": %.3f, \"stages\": {", times[0],
           times[b->count - 1]);
    for (int stage = 0; stage < DP_STAGE_COUNT; stage++) {
        for (uint32_t k = 0; k < b->count; k++) times[k] = b->frames[k].stage_ms[stage];
        printf("%s\"%s\": %.3f", stage ? ", " : "", dp_stage_name((dp_stage)stage),
               median(times, b->count));
    }
    printf("}");
    if (b->still_context)
        printf(", \"still_ms\": %.3f, \"read_ms\": %.3f", median(b->still_ms, b->count),
               median(b->read_ms, b->count));
    printf(", \"triangles\": %llu, \"added_polygons\": %llu, \"segments\": %llu",
           (unsigned long long)last->triangles, (unsigned long long)last->added_polygons,
           (unsigned long long)last->segments);
    printf(", \"width\": %u, \"height\": %u, \"samples\": %u, \"threads\": %ld}\n", b->target.width,
           b->target.height, b->target.samples, s->threads ? (long)s->threads : processors);
}

static int draw_frame(const tool_settings *s, const bench *b, dp_context *context,
                      dp_source *source, const dp_camera *camera, const dp_style *style) {
    dp_diag diag = {0};
    const dp_result result = dp_draw_grouped(context, source, camera, style, b->objects.styles,
                                             b->objects.count, &b->target, &diag);
    if (!result) return 0;
    return result == DP_ERR_ARGUMENT ? report_failure(NULL, &diag) : report_model(s, &diag);
}

/* ---- models that move ---- */

static double now_ms(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

/* Reads the source from its start, and draws nothing. */
static dp_result read_through(dp_source *source, dp_diag *diag) {
    dp_batch batch = {.polygon_count = 1};
    dp_result result = dp_source_rewind(source, diag);
    while (!result && batch.polygon_count) result = dp_source_next(source, &batch, diag);
    return result;
}

/* Step `step` of 2 for each frame: from --time T0 to T1, or 25 frames a second from T0 on. */
static double time_of(const tool_settings *s, const bench *b, uint32_t step) {
    if (s->time[1] == s->time[0]) return s->time[0] + step / 25.0;
    return s->time[0] + (s->time[1] - s->time[0]) * step / (2.0 * b->count);
}

static int move_to(const tool_settings *s, bench *b, double time, double *read_ms) {
    dp_diag diag = {0};
    dp_result result = dp_source_set_time(b->source, time, &diag);
    const double start = now_ms();
    if (!result) result = read_through(b->source, &diag);
    *read_ms = now_ms() - start;
    return result ? report_model(s, &diag) : 0;
}

static int begin_moving(bench *b, const dp_context_desc *desc) {
    dp_diag diag = {0};
    b->still_ms = calloc(b->count, sizeof *b->still_ms);
    b->read_ms = calloc(b->count, sizeof *b->read_ms);
    if (!b->still_ms || !b->read_ms) {
        wrong_usage("out of memory for %u frames", b->count);
        return EXIT_FAILED;
    }
    return dp_context_create(desc, &b->still_context, &diag) ? report_failure(NULL, &diag) : 0;
}

/* Draws the polygons as they are now as a model that stands: twice, as it then is no new one. */
static int draw_still(const tool_settings *s, bench *b, const dp_camera *camera,
                      const dp_style *style, double *ms) {
    dp_stats stats;
    dp_diag diag = {0};
    dp_source *still = NULL;
    dp_result result = dp_source_rewind(b->source, &diag);
    if (!result) result = copy_source(b->source, HUGE_VAL, &still, &diag);
    if (result) return report_model(s, &diag);
    int code = draw_frame(s, b, b->still_context, still, camera, style);
    if (!code) code = draw_frame(s, b, b->still_context, still, camera, style);
    dp_stats_of(b->still_context, &stats);
    *ms = stats.frame_ms;
    dp_source_destroy(still);
    return code;
}

/* Each frame is the second of two, so that the processor's caches hold what is its own. */
static int draw_moving_frames(const tool_settings *s, bench *b, const dp_camera *camera,
                              const dp_style *style) {
    int code = 0;
    for (uint32_t k = 0; k < b->count && !code; k++) {
        for (uint32_t step = 2 * k; step < 2 * k + 2 && !code; step++) {
            code = move_to(s, b, time_of(s, b, step), &b->read_ms[k]);
            if (!code) code = draw_frame(s, b, b->context, b->source, camera, style);
        }
        dp_stats_of(b->context, &b->frames[k]);
        if (!code) code = draw_still(s, b, camera, style, &b->still_ms[k]);
    }
    return code;
}

static int draw_frames(const tool_settings *s, bench *b, const dp_camera *camera,
                       const dp_style *style) {
    int code = 0;
    if (b->still_context) return draw_moving_frames(s, b, camera, style);
    for (uint32_t k = 0; k <= b->count && !code; k++) { /* frame 0 is not counted */
        code = draw_frame(s, b, b->context, b->source, camera, style);
        if (k && !code) dp_stats_of(b->context, &b->frames[k - 1]);
    }
    return code;
}

static bool moves(const tool_settings *s, const bench *b) {
    return s->has_deform || (s->morph && !s->has_blend) || dp_source_duration(b->source) > 0;
}

static int measure(const tool_settings *s, bench *b) {
    /* frames are timed from memory, unless --memory asks for streaming */
    const dp_context_desc desc = {.threads = s->threads,
                                  .memory = s->memory > 0 ? (size_t)s->memory : SIZE_MAX / 2};
    dp_style style = make_style(s);
    measured model;
    page_plan plan;
    dp_diag diag = {0};
    dp_camera *const camera = &plan.views[0].camera;
    int code = measure_model(s, b->source, &model);
    if (!code) look_mirror(s, &model, &style);
    if (!code) code = page_make(s, b->source, &model, &plan);
    if (!code && !page_widths(s, &plan, &style)) code = EXIT_USAGE;
    if (!code) look_deepen(&style, &model.extent, camera);
    if (!code) code = make_stroke(s, &plan, &style, &b->texture);
    if (!code) code = look_make(s, b->source, &b->look, &style);
    if (!code) code = objects_style(s, b->source, &plan, &style, &b->objects);
    if (code) return code;
    if (dp_context_create(&desc, &b->context, &diag)) return report_failure(NULL, &diag);
    if (moves(s, b) && (code = begin_moving(b, &desc))) return code;
    return draw_frames(s, b, camera, &style);
}

static int run(const tool_settings *s, bench *b) {
    b->count = s->frames ? s->frames : 10;
    b->target = make_target(s);
    b->target.rgba = calloc((size_t)b->target.width * b->target.height, 4);
    b->frames = calloc(b->count, sizeof *b->frames);
    double *const times = calloc(b->count, sizeof *times);
    int code = EXIT_FAILED;
    if (b->target.rgba && b->frames && times)
        code = open_model(s, &b->source);
    else
        wrong_usage("out of memory for the picture; give a smaller --size");
    if (b->source) code = measure(s, b);
    if (!code) print_result(s, b, times);
    free(times);
    return code;
}

int command_bench(const tool_settings *s) {
    bench b = {0};
    const int code = run(s, &b);
    dp_context_destroy(b.context);
    dp_texture_destroy(b.texture);
    dp_context_destroy(b.still_context);
    dp_source_destroy(b.source);
    look_free(&b.look);
    objects_free(&b.objects);
    free(b.frames);
    free(b.still_ms);
    free(b.read_ms);
    free(b.target.rgba);
    return code;
}
