/* drypoint MODEL -o OUT.png: reads, draws, writes. Nothing is written before all is drawn.
 *
 * A run has one plan (page.h): views, each with its camera and its place on the page. Each view is
 * drawn once, into its rectangle of the picture and into paths; only a ground under paths takes a
 * drawing of its own. */
#include "draw.h"
#include "film.h"
#include "files.h"
#include "look.h"
#include "objects.h"
#include "output.h"
#include "page_ink.h"
#include "planes.h"
#include "progress.h"
#include "report.h"
#include "sides.h"

#include <drypoint/io.h>

#include <stdlib.h>
#include <string.h>

/* Warns of what a source is to be remarked on; NULL: nothing. */
static void warn_source(const tool_settings *s, const char *remark) {
    if (remark && !s->quiet) warn_of_model(s, remark);
}

/* ---- preparing ---- */

static int make_page(drawing *d) {
    const page_plan *const plan = &d->plan;
    d->target.width = plan->width, d->target.height = plan->height;
    if (!d->pixels || d->lent) return 0;
    d->target.rgba = calloc((size_t)plan->width * plan->height, 4);
    if (d->target.rgba) return 0;
    wrong_usage("out of memory for %u x %u pixels; give a smaller %s", plan->width, plan->height,
                plan->paged ? "--dpi" : "--size");
    return EXIT_FAILED;
}

/* Warns of options, once for all models. */
static void warn_options(const tool_settings *s, const drawing *d) {
    if (d->paths) paths_warn(s, &d->style);
}

int drawing_prepare(const tool_settings *s, drawing *d, dp_source *seen, measured *model) {
    d->pixels = files_have_pixels(s), d->paths = files_have_paths(s);
    d->style = make_style(s);
    d->style.exact_ends = d->paths && !s->gl;
    look_mirror(s, model, &d->style);
    int code = page_make(s, seen, model, &d->plan);
    if (code) return code;
    if (!page_widths(s, &d->plan, &d->style)) return EXIT_USAGE;
    code = make_stroke(s, &d->plan, &d->style, &d->texture);
    if (code) return code;
    code = look_make(s, d->source, &d->look, &d->style);
    if (!code) code = objects_style(s, d->source, &d->plan, &d->style, &d->objects);
    if (code) return code;
    if (d->style.shade.model_colors) warn_source(s, dp_source_color_remark(d->source));
    if (!s->number) warn_options(s, d);
    return 0;
}

int drawing_open(const tool_settings *s, drawing *d, uint32_t threads) {
    const dp_context_desc desc = {
        .threads = threads, .progress = progress_report, .memory = (size_t)s->memory};
    dp_diag diag = {0};
    d->target.samples = make_target(s).samples;
    d->target.width = d->plan.views[0].width, d->target.height = d->plan.views[0].height;
    int code = planes_prepare(s, &d->target);
    if (!code) code = make_page(d);
    if (!code && s->gl && !d->gl) code = gl_open(&d->gl);
    if (code) return code;
    if (d->gl && s->stats) gl_time(d->gl);
    return dp_context_create(&desc, &d->context, &diag) ? report_failure(NULL, &diag) : 0;
}

/* ---- drawing ---- */

/* What takes seconds there is mostly the first picture, for which the driver compiles shaders. */
static const char gl_at_work[] =
    "drawing by OpenGL (its shaders are compiled once, and kept by the driver)";

static int refused_by_gl(const dp_diag *diag) {
    if (diag->result == DP_ERR_UNSUPPORTED)
        wrong_usage("--gl: %s; leave out --gl", diag->message);
    else if (diag->result == DP_ERR_LIMIT)
        wrong_usage("--gl: %s; leave out --gl, or give a smaller --size", diag->message);
    else
        report_failure("--gl", diag);
    return EXIT_FAILED;
}

/* Says, once, that the device has fewer samples than were asked for. */
static void tell_samples(const tool_settings *s, drawing *d, uint32_t asked) {
    const uint32_t drawn = s->quiet || d->samples_told ? asked : gl_samples(d->gl);
    d->samples_told = true;
    if (drawn && drawn < asked)
        warn("--samples: OpenGL draws %u of a pixel, not %u: more this device does not have", drawn,
             asked);
}

/* Draws by OpenGL; the lines become the context's if anyone asks for them. */
static int draw_by_gl(const tool_settings *s, drawing *d, const page_view *v, const dp_style *style,
                      const object_styles *objects, const dp_target *target) {
    dp_diag diag = {0};
    if (objects->count) {
        wrong_usage(
            "--gl: OpenGL draws no object in a look of its own; leave out --gl, or --object");
        return EXIT_FAILED;
    }
    progress_wait_begin(gl_at_work, s->quiet);
    dp_result result = gl_draw(d->gl, &v->camera, style, target, &diag);
    progress_wait_end();
    if (!result) tell_samples(s, d, target->samples);
    if (!result && (d->paths || s->outputs[OUTPUT_TRACE]) && style->lines != DP_NO_LINES)
        result = gl_hand_over(d->gl, d->context, &diag);
    return result ? refused_by_gl(&diag) : 0;
}

static int draw_into(const tool_settings *s, drawing *d, const page_view *v, const dp_style *style,
                     const object_styles *objects, const dp_target *target) {
    dp_diag diag = {0};
    if (d->gl) return draw_by_gl(s, d, v, style, objects, target);
    progress_begin("drawing", s->quiet);
    const dp_result result = dp_draw_grouped(d->context, d->source, &v->camera, style,
                                             objects->styles, objects->count, target, &diag);
    progress_end();
    if (!result) return 0;
    return result == DP_ERR_ARGUMENT ? report_failure(NULL, &diag) : report_model(s, &diag);
}

/* The surface under the lines of view k, without paper: the page has it. */
static int draw_ground(const tool_settings *s, drawing *d, int k) {
    const page_view *const v = &d->plan.views[k];
    dp_style style = d->style;
    style.lines = DP_NO_LINES;
    style.paper = DP_COLOR_NONE;
    style.hidden.look = DP_HIDDEN_NONE;
    d->views[k].ground = calloc((size_t)v->width * v->height, 4);
    if (!d->views[k].ground) {
        wrong_usage("out of memory for the ground; leave out --ground");
        return EXIT_FAILED;
    }
    const dp_target target = {.width = v->width,
                              .height = v->height,
                              .samples = d->target.samples,
                              .rgba = d->views[k].ground};
    object_styles bare;
    if (!objects_without_lines(&d->objects, &bare)) return EXIT_FAILED;
    const int code = draw_into(s, d, v, &style, &bare, &target);
    objects_free(&bare);
    return code;
}

static void take_stats(drawing *d, int k) {
    dp_diag diag;
    if (!d->gl) dp_stats_of(d->context, &d->stats[k]);
    if (d->gl && gl_stats(d->gl, &d->stats[k], &diag)) d->stats[k] = (dp_stats){0};
}

/* Uploads the model, or where its vertices are now. */
static int take_source(const tool_settings *s, drawing *d) {
    dp_diag diag = {0};
    if (!d->gl || d->gl_lent) return 0;
    progress_wait_begin(gl_at_work, s->quiet);
    const dp_result result = gl_take(d->gl, d->source, d->gl_taken, &diag);
    progress_wait_end();
    d->gl_taken = true;
    return result ? refused_by_gl(&diag) : 0;
}

static int draw_lines(const tool_settings *s, drawing *d, int k) {
    const page_view *const v = &d->plan.views[k];
    const size_t stride = (size_t)4 * d->plan.width;
    dp_target target = d->target;
    dp_style style = d->style;
    target.width = v->width, target.height = v->height;
    if (target.rgba) target.rgba += v->y * stride + (size_t)4 * v->x, target.rgba_stride = stride;
    if (v->bare) style.hidden.look = DP_HIDDEN_NONE;
    int code = draw_into(s, d, v, &style, &d->objects, &target);
    if (!code) take_stats(d, k);
    if (!code && d->paths) code = paths_make(s, &d->plan, d->context, &d->views[k].lines);
    return code;
}

static void clear_views(drawing *d) {
    for (int k = 0; k < SHEET_MOST; k++) {
        dp_drawing_destroy(d->views[k].lines);
        free(d->views[k].ground);
        d->views[k] = (view_paths){0};
    }
}

/* The ground first: the context's last drawing is that of the lines, which the trace is of. */
int drawing_draw(const tool_settings *s, drawing *d) {
    int code = take_source(s, d);
    clear_views(d);
    if (d->plan.paged && d->target.rgba) ink_paper(&d->target, s->style.paper);
    for (int k = 0; k < d->plan.view_count && !code; k++) {
        if (d->paths && s->ground == GROUND_PNG) code = draw_ground(s, d, k);
        if (!code) code = draw_lines(s, d, k);
    }
    if (!code && d->pixels) ink_page(&d->plan, &d->target);
    return code;
}

/* ---- writing ---- */

static int write_picture(const tool_settings *s, const drawing *d, const char *path) {
    const dp_io_picture picture = {.rgba = d->target.rgba,
                                   .width = d->plan.width,
                                   .height = d->plan.height,
                                   .dpi = d->plan.dpi,
                                   .progress = progress_report};
    dp_diag diag = {0};
    progress_begin("writing", s->quiet);
    interrupt_hold();
    const dp_result result = dp_io_write_picture(path, &picture, &diag);
    interrupt_release();
    progress_end();
    return result ? report_failure(NULL, &diag) : 0;
}

static int write_pictures(const tool_settings *s, const drawing *d) {
    int code = 0;
    for (uint32_t k = 0; k < s->file_count && !code; k++)
        if (files_format(s, s->files[k]) == FORMAT_PNG) code = write_picture(s, d, s->files[k]);
    return code;
}

static int write_trace(const tool_settings *s, const drawing *d) {
    dp_diag diag = {0};
    if (!s->outputs[OUTPUT_TRACE]) return 0;
    interrupt_hold();
    const dp_result result = dp_io_write_trace(s->outputs[OUTPUT_TRACE], d->context, &diag);
    interrupt_release();
    return result ? report_failure(NULL, &diag) : 0;
}

static int write_planes(const tool_settings *s, const drawing *d) {
    dp_target view = d->target;
    view.width = d->plan.views[0].width, view.height = d->plan.views[0].height;
    return planes_write(s, &view);
}

int drawing_write(const tool_settings *s, drawing *d) {
    int code = write_planes(s, d);
    if (!code) code = write_trace(s, d);
    if (!code) code = write_pictures(s, d);
    if (!code && d->paths) code = paths_write(s, &d->plan, d->views);
    return code;
}

/* ---- what is told ---- */

/* (Quads are no segments; an edge map may have edges.) */
bool drawing_is_empty(const drawing *d) {
    uint64_t segments = 0;
    for (int k = 0; k < d->plan.view_count; k++) segments += d->stats[k].segments;
    return !segments && d->style.lines != DP_NO_LINES && d->style.ink != DP_INK_QUADS &&
           !d->style.edge_map.detector;
}

static void tell_empty_picture(const tool_settings *s, const drawing *d) {
    if (!drawing_is_empty(d) || s->quiet || !s->file_count) return;
    tell_empty(strcmp(s->files[0], "-") ? s->files[0] : "standard output");
}

static void print_gl_stats(const tool_settings *s, const drawing *d, const dp_target *view) {
    if (s->stats == STATS_TABLE) {
        gl_print_table(stderr, d->gl);
        return;
    }
    FILE *const out = files_standard(s) ? stderr : stdout;
    fprintf(
        out,
        "{\"width\": %u, \"height\": %u, \"samples\": %u, \"triangles\": %llu, \"segments\": %llu",
        view->width, view->height, view->samples, (unsigned long long)d->stats[0].triangles,
        (unsigned long long)d->stats[0].segments);
    gl_print_json(out, d->gl);
    fputs("}\n", out);
}

static void print_stats(const tool_settings *s, const drawing *d) {
    warn_source(s, dp_source_remark(d->source));
    if (!s->quiet) warn_dropped(s, &d->stats[0]);
    if (!s->quiet) warn_lost(s, &d->stats[0]);
    for (int k = 0; k < d->plan.view_count; k++) {
        const dp_target view = {.width = d->plan.views[k].width,
                                .height = d->plan.views[k].height,
                                .samples = d->target.samples};
        if (d->gl && s->stats) {
            print_gl_stats(s, d, &view);
            continue;
        }
        if (s->stats == STATS_TABLE) print_stats_table(stderr, s, &d->stats[k]);
        if (s->stats == STATS_JSON)
            print_stats_json(files_standard(s) ? stderr : stdout, s, &d->stats[k], &view);
    }
    if (d->paths)
        paths_tell(s, &d->plan, d->views, sides_assumed(s, d->source));
    else
        tell_empty_picture(s, d), sides_tell(s, d->source);
}

static int run(const tool_settings *s, drawing *d) {
    measured model;
    int code = open_model(s, &d->source);
    if (!code) code = measure_model(s, d->source, &model);
    if (!code) warn_coarse(s, &model.extent);
    if (!code) code = drawing_prepare(s, d, d->source, &model);
    if (code) return code;
    for (int k = 0; k < d->plan.view_count; k++)
        look_deepen(&d->style, &model.extent, &d->plan.views[k].camera);
    code = drawing_open(s, d, s->threads);
    if (!code) code = drawing_draw(s, d);
    if (!code) code = drawing_write(s, d);
    if (!code) print_stats(s, d);
    return code;
}

void drawing_free(drawing *d) {
    if (!d->gl_lent) gl_close(d->gl);
    dp_context_destroy(d->context);
    dp_texture_destroy(d->texture);
    dp_source_destroy(d->source);
    clear_views(d);
    if (!d->lent) free(d->target.rgba);
    planes_free(&d->target);
    look_free(&d->look);
    objects_free(&d->objects);
}

int draw_scene(const tool_settings *s) {
    int code = files_check(s);
    if (code) return code;
    if (film_wanted(s)) return film_draw(s);
    drawing d = {0};
    code = run(s, &d);
    drawing_free(&d);
    return code;
}
