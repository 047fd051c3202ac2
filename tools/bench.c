/* drypoint bench MODEL --frames N: draws the same frame N times and reports the median of each
 * time. Loading and the first frame, in which the context's memory grows, are not counted. */
#include "commands.h"
#include "look.h"
#include "objects.h"
#include "page.h"
#include "report.h"

#include <stdlib.h>
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
    printf("}, \"triangles\": %llu, \"added_polygons\": %llu, \"segments\": %llu",
           (unsigned long long)last->triangles, (unsigned long long)last->added_polygons,
           (unsigned long long)last->segments);
    printf(", \"width\": %u, \"height\": %u, \"samples\": %u, \"threads\": %ld}\n", b->target.width,
           b->target.height, b->target.samples, s->threads ? (long)s->threads : processors);
}

static int draw_frames(const tool_settings *s, bench *b, const dp_camera *camera,
                       const dp_style *style) {
    for (uint32_t k = 0; k <= b->count; k++) { /* frame 0 is not counted */
        dp_diag diag = {0};
        const dp_result result =
            dp_draw_grouped(b->context, b->source, camera, style, b->objects.styles,
                            b->objects.count, &b->target, &diag);
        if (result)
            return result == DP_ERR_ARGUMENT ? report_failure(NULL, &diag) : report_model(s, &diag);
        if (k) dp_stats_of(b->context, &b->frames[k - 1]);
    }
    return 0;
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
    dp_source_destroy(b.source);
    look_free(&b.look);
    objects_free(&b.objects);
    free(b.frames);
    free(b.target.rgba);
    return code;
}
