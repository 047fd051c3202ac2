/* drypoint MODEL -o OUT.png: reads, draws, writes. Nothing is written before all is drawn. */
#include "commands.h"
#include "look.h"
#include "output.h"
#include "planes.h"
#include "progress.h"
#include "report.h"

#include <drypoint/io.h>

#include <stdlib.h>
#include <string.h>

/* A picture is a PNG; any other ending is taken for a mistake. */
static bool check_ending(const char *path) {
    if (output_in_place(path) || output_has_ending(path, ".png") || output_has_ending(path, ".svg"))
        return true;
    return wrong_usage("-o %s: pictures are written as PNG; name it %.*s.png", path,
                       output_stem(path), path);
}

/* Every output has a file of its own, and none is the model. */
static bool check_outputs(const tool_settings *s) {
    const char *paths[OUTPUT_COUNT + 2] = {s->model};
    size_t count = 1;
    if (s->output) paths[count++] = s->output;
    for (int k = 0; k < OUTPUT_COUNT; k++)
        if (s->outputs[k]) paths[count++] = s->outputs[k];
    for (size_t i = 1; i < count; i++)
        for (size_t k = 0; k < i; k++) {
            if (k == 0 && !strcmp(paths[0], "-")) continue; /* standard input */
            if (!output_same(paths[i], paths[k])) continue;
            return k ? wrong_usage("two outputs go to %s; name another file", paths[i])
                     : wrong_usage("%s is the model; name another file for the output", paths[i]);
        }
    return true;
}

typedef struct drawing {
    dp_source *source;
    dp_context *context;
    dp_texture *texture;
    dp_target target;
    dp_stats stats;
    look_data look;
} drawing;

/* Warns of what a source is to be remarked on; NULL: nothing. */
static void warn_source(const char *remark) {
    if (remark) warn("%s", remark);
}

/* Draws into a new picture, which the caller frees. */
static int draw(const tool_settings *s, drawing *d, const dp_extent *extent) {
    dp_camera camera;
    dp_extent seen = *extent;
    dp_style style = make_style(s);
    look_mirror(s, &seen, &style);
    const int wrong = make_camera(s, &seen, &camera);
    if (wrong) return wrong;
    look_deepen(&style, &seen, &camera);
    const dp_context_desc desc = {
        .threads = s->threads, .progress = progress_report, .memory = (size_t)s->memory};
    const int wrong_stroke = make_stroke(s, &style, &d->texture);
    if (wrong_stroke) return wrong_stroke;
    dp_diag diag = {0};
    d->target = make_target(s);
    int code = look_make(s, d->source, &d->look, &style);
    if (!code) code = planes_prepare(s, &d->target);
    if (code) return code;
    if (!s->quiet && style.shade.model_colors) warn_source(dp_source_color_remark(d->source));
    if (!s->quiet) warn_strokeless(s, &style);
    d->target.rgba = calloc((size_t)d->target.width * d->target.height, 4);
    if (!d->target.rgba) {
        wrong_usage("out of memory for %u x %u pixels; give a smaller --size", d->target.width,
                    d->target.height);
        return EXIT_FAILED;
    }
    if (dp_context_create(&desc, &d->context, &diag)) return report_failure(NULL, &diag);
    progress_begin("drawing", s->quiet);
    const dp_result result = dp_draw(d->context, d->source, &camera, &style, &d->target, &diag);
    progress_end();
    if (result == DP_ERR_ARGUMENT) return report_failure(NULL, &diag);
    if (result) return report_failure(s->model, &diag);
    dp_stats_of(d->context, &d->stats);
    return 0;
}

static int write_page(const tool_settings *s, const drawing *d) {
    dp_diag diag = {0};
    dp_drawing *lines = NULL;
    dp_result result = dp_drawing_create(d->context, NULL, &lines, &diag);
    if (!result) {
        const dp_view_on_page view = {.drawing = lines};
        const dp_page page = {.views = &view, .view_count = 1};
        interrupt_hold();
        result = dp_io_write_page(s->output, &page, DP_FORMAT_SVG, &diag);
        interrupt_release();
    }
    dp_drawing_destroy(lines);
    return result ? report_failure(NULL, &diag) : 0;
}

static int write_picture(const tool_settings *s, const drawing *d) {
    if (output_has_ending(s->output, ".svg")) return write_page(s, d);
    const dp_io_picture picture = {.rgba = d->target.rgba,
                                   .width = d->target.width,
                                   .height = d->target.height,
                                   .progress = progress_report};
    dp_diag diag = {0};
    progress_begin("writing", s->quiet);
    interrupt_hold();
    const dp_result result = dp_io_write_picture(s->output, &picture, &diag);
    interrupt_release();
    progress_end();
    return result ? report_failure(NULL, &diag) : 0;
}

static int write_trace(const tool_settings *s, const drawing *d) {
    dp_diag diag = {0};
    if (!s->outputs[OUTPUT_TRACE]) return 0;
    interrupt_hold();
    const dp_result result = dp_io_write_trace(s->outputs[OUTPUT_TRACE], d->context, &diag);
    interrupt_release();
    return result ? report_failure(NULL, &diag) : 0;
}

/* Is it standard output? */
static bool is_standard(const char *path) { return path && !strcmp(path, "-"); }

static void print_stats(const tool_settings *s, const drawing *d) {
    if (!s->quiet) warn_source(dp_source_remark(d->source));
    if (!s->quiet) warn_dropped(&d->stats);
    if (!s->quiet) warn_lost(&d->stats);
    if (s->stats == STATS_TABLE) print_stats_table(stderr, &d->stats);
    bool taken = is_standard(s->output);
    for (int k = 0; k < OUTPUT_COUNT; k++) taken |= is_standard(s->outputs[k]);
    if (s->stats == STATS_JSON) print_stats_json(taken ? stderr : stdout, &d->stats, &d->target);
}

static int run(const tool_settings *s, drawing *d) {
    dp_extent extent;
    int code = open_model(s, &d->source);
    if (!code) code = measure_model(s, d->source, &extent);
    if (!code) warn_coarse(s, &extent);
    if (!code) code = draw(s, d, &extent);
    if (!code) code = planes_write(s, &d->target);
    if (!code) code = write_trace(s, d);
    if (!code && s->output) code = write_picture(s, d);
    if (!code) print_stats(s, d);
    return code;
}

int command_draw(const tool_settings *s) {
    const char *const trace = s->outputs[OUTPUT_TRACE];
    if (s->output && !check_ending(s->output)) return EXIT_USAGE;
    if (!check_outputs(s)) return EXIT_USAGE;
    if (s->output && !output_possible(s->output)) return EXIT_FAILED;
    if (trace && !output_possible(trace)) return EXIT_FAILED;
    drawing d = {0};
    const int code = run(s, &d);
    dp_context_destroy(d.context);
    dp_texture_destroy(d.texture);
    dp_source_destroy(d.source);
    free(d.target.rgba);
    planes_free(&d.target);
    look_free(&d.look);
    return code;
}
