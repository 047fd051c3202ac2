/* From a command line to pixels, by the program's own functions: what the window shows is what the program draws.
 *
 * Invariant: `styled` says that style, look and objects are of `line`, of a model that is there. */
#include "picture.h"

#include "files.h"
#include "report.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static void free_style(picture *p) {
    dp_texture_destroy(p->texture);
    look_free(&p->look);
    objects_free(&p->objects);
    p->texture = NULL;
    p->look = (look_data){0};
    p->objects = (object_styles){0};
    p->styled = false;
}

void picture_free(picture *p) {
    free_style(p);
    parsed_free(&p->line);
    dp_context_destroy(p->context);
    free(p->rgba);
    *p = (picture){0};
}

/* What the program does in drawing_prepare, but for files. */
static int make_look(picture *p, loaded *model, measured *seen) {
    const tool_settings *const s = &p->line.settings;
    p->style = make_style(s);
    look_mirror(s, seen, &p->style);
    int code = page_make(s, model->source, seen, &p->plan);
    if (!code && !page_widths(s, &p->plan, &p->style)) code = EXIT_USAGE;
    if (!code) code = make_stroke(s, &p->plan, &p->style, &p->texture);
    if (!code) code = look_make(s, model->source, &p->look, &p->style);
    if (!code) code = objects_style(s, model->source, &p->plan, &p->style, &p->objects);
    return code;
}

/* Only the camera is another. */
static int make_camera_again(picture *p, loaded *model, measured *seen) {
    dp_style mirrored = p->style;
    look_mirror(&p->line.settings, seen, &mirrored);
    return page_make(&p->line.settings, model->source, seen, &p->plan);
}

bool picture_aim(picture *p, const cmdline *line, loaded *model, bool restyle) {
    parsed next;
    measured seen = model->seen;
    if (!cmdline_parse(line, NULL, &next)) {
        parsed_free(&next);
        return false;
    }
    restyle |= !p->styled;
    if (restyle) free_style(p);
    parsed_move(&p->line, &next);
    const int code = restyle ? make_look(p, model, &seen) : make_camera_again(p, model, &seen);
    if (code) return false;
    look_deepen(&p->style, &seen.extent, &p->plan.views[0].camera);
    p->styled = true;
    return true;
}

/* ------- drawing ------- */

static double now_ms(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

static bool make_room(picture *p, uint32_t width, uint32_t height) {
    const size_t bytes = (size_t)4 * width * height;
    if (bytes <= p->room) return true;
    uint8_t *const rgba = realloc(p->rgba, bytes);
    if (!rgba) return wrong_usage("out of memory for %u x %u pixels", width, height);
    p->rgba = rgba;
    p->room = bytes;
    return true;
}

static bool make_context(picture *p) {
    const tool_settings *const s = &p->line.settings;
    /* frames are drawn from memory, unless --memory asks for streaming */
    const dp_context_desc desc = {.threads = s->threads,
                                  .progress = p->progress,
                                  .memory = s->memory > 0 ? (size_t)s->memory : SIZE_MAX / 2};
    dp_diag diag = {0};
    if (p->context || !dp_context_create(&desc, &p->context, &diag)) return true;
    report_failure(NULL, &diag);
    return false;
}

/* Lengths in pixels, for a picture of half the size. */
static void halve(dp_style *style) {
    for (int k = 0; k < DP_LINE_COUNT; k++) {
        style->line[k].width = style->line[k].width > 1 ? 0.5f * style->line[k].width : 0.5f;
        for (int level = 0; level < DP_LEVELS; level++) {
            float *const width = &style->hidden.line[level][k].width;
            if (*width > 0) *width = *width > 1 ? 0.5f * *width : 0.5f;
        }
    }
    dp_stroke_style *const stroke = &style->stroke;
    stroke->taper *= 0.5f, stroke->jitter *= 0.5f, stroke->overshoot *= 0.5f;
}

static dp_result draw(picture *p, const loaded *model, tool_gl *gl, const dp_style *style,
                      const dp_target *target, dp_diag *diag) {
    const dp_camera *const camera = &p->plan.views[0].camera;
    if (!gl)
        return dp_draw_grouped(p->context, model->source, camera, style, p->objects.styles,
                               p->objects.count, target, diag);
    if (!p->objects.count) return gl_draw(gl, camera, style, target, diag);
    *diag = (dp_diag){.result = DP_ERR_UNSUPPORTED,
                      .message = "OpenGL draws no object in a look of its own"};
    return diag->result;
}

static void take_stats(picture *p, tool_gl *gl) {
    dp_stats stats = {0};
    dp_diag diag;
    if (!gl) dp_stats_of(p->context, &stats);
    if (gl && gl_stats(gl, &stats, &diag)) stats = (dp_stats){0};
    p->segments = stats.segments;
}

bool picture_draw(picture *p, const loaded *model, tool_gl *gl, picture_quality quality) {
    const tool_settings *const s = &p->line.settings;
    dp_style style = p->style;
    dp_target target = make_target(s);
    dp_diag diag = {0};
    if (quality) target.samples = 1;
    if (quality == QUALITY_HALF) {
        target.width = (target.width + 1) / 2, target.height = (target.height + 1) / 2;
        halve(&style);
    }
    if (!gl && (!make_context(p) || !make_room(p, target.width, target.height))) return false;
    target.rgba = gl ? NULL : p->rgba;
    const double start = now_ms();
    const dp_result result = draw(p, model, gl, &style, &target, &diag);
    p->stopped = result == DP_ERR_CANCELLED;
    if (result && !p->stopped) report_failure(NULL, &diag);
    if (result) return false;
    p->ms = now_ms() - start;
    p->width = target.width, p->height = target.height;
    p->by_gl = gl != NULL;
    take_stats(p, gl);
    return true;
}

/* ------- depth ------- */

/* Lets a picture show the surroundings of a point (in shares of its size) alone, that many times as large. */
static void look_closely(dp_camera *camera, double x, double y, double across, double down) {
    double *const m = camera->projection;
    for (int k = 0; k < 4; k++) { /* clip space: x and y less the point's, larger */
        m[4 * k] = (m[4 * k] - (2 * x - 1) * m[4 * k + 3]) * across;
        m[4 * k + 1] = (m[4 * k + 1] - (1 - 2 * y) * m[4 * k + 3]) * down;
    }
}

double picture_depth(picture *p, const loaded *model, double right, double down) {
    enum { SIDE = 3 };
    float depth[SIDE * SIDE], nearest = INFINITY;
    if (!p->styled || !make_context(p)) return 0;
    dp_camera camera = p->plan.views[0].camera;
    look_closely(&camera, right, down, (double)p->plan.width / SIDE, (double)p->plan.height / SIDE);
    const dp_style style = {.lines = DP_NO_LINES};
    const dp_target target = {.width = SIDE, .height = SIDE, .samples = 1, .depth = depth};
    dp_diag diag;
    if (dp_draw(p->context, model->source, &camera, &style, &target, &diag)) return 0;
    for (int k = 0; k < SIDE * SIDE; k++) nearest = fminf(nearest, depth[k]);
    return isfinite(nearest) ? (double)nearest : 0;
}

/* ------- saving ------- */

static int save(const tool_settings *s, const loaded *model, tool_gl *gl) {
    measured seen;
    drawing d = {.source = model->source, .gl = gl, .gl_lent = gl != NULL};
    int code = files_check(s);
    if (!code) code = measure_model(s, d.source, &seen);
    if (!code) code = drawing_prepare(s, &d, d.source, &seen);
    if (!code) look_deepen(&d.style, &seen.extent, &d.plan.views[0].camera);
    if (!code) code = drawing_open(s, &d, s->threads);
    if (!code) code = drawing_draw(s, &d);
    if (!code) code = drawing_write(s, &d);
    d.source = NULL; /* it is the model's */
    drawing_free(&d);
    return code;
}

bool picture_save(const cmdline *line, const loaded *model, tool_gl *gl, const char *file) {
    parsed p;
    const bool done = cmdline_parse(line, file, &p) && !save(&p.settings, model, gl);
    parsed_free(&p);
    return done;
}
