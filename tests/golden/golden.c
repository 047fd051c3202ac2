/* Golden pictures: see golden.h. */
#include "golden.h"

#include "base/kernels.h"

#include <drypoint/io.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* ------- sources ------- */

/* A generated or hand-made model as an application's source; `heavy`: behind a batch that holds so
 * many vertices that the whole is beyond the least memory that a context takes. */
typedef struct reader {
    dp_source *shape; /* NULL: */
    const model *made;
    float *padding;
    bool heavy, begun, ended;
} reader;

enum { PADDING = 2000000 /* vertices: 56 MB, as they are gathered */ };

static dp_result next_batch(void *user, dp_batch *batch, dp_diag *diag) {
    reader *const r = user;
    if (r->heavy && !r->begun) { /* one triangle of no area, which is dropped */
        *batch = (dp_batch){.positions = r->padding,
                            .vertex_count = PADDING,
                            .corner_count = 3,
                            .polygon_count = 1};
        r->begun = true;
        return DP_OK;
    }
    if (r->shape) return dp_source_next(r->shape, batch, diag);
    if (r->ended) return DP_OK;
    *batch = (dp_batch){.positions = r->made->positions[0],
                        .vertex_count = r->made->corners,
                        .corner_count = r->made->corners,
                        .firsts = r->made->firsts,
                        .polygon_count = r->made->polygons,
                        .edge_flags = r->made->flags,
                        .groups = r->made->groups};
    r->ended = true;
    return DP_OK;
}

static dp_result rewind_reader(void *user, dp_diag *diag) {
    reader *const r = user;
    r->begun = r->ended = false;
    return r->shape ? dp_source_rewind(r->shape, diag) : DP_OK;
}

static uint32_t group_color(void *user, uint32_t group) {
    static const uint32_t colors[] = {DP_RGB(214, 158, 120), DP_RGB(120, 160, 206),
                                      DP_RGB(150, 196, 130)};
    (void)user;
    return group < 3 ? colors[group] : 0;
}

/* The same source, however it is read. */
typedef struct opened {
    dp_source *source;
    reader reader;
} opened;

static void open_source(const golden *g, const model *made, opened *o) {
    *o = (opened){.reader = {.made = made, .heavy = g->reading == GOLDEN_TWICE}};
    const dp_shape shape = {.name = g->shape, .triangles = g->triangles};
    const dp_source_callbacks callbacks = {.user = &o->reader,
                                           .next = next_batch,
                                           .rewind =
                                               g->reading == GOLDEN_ONCE ? NULL : rewind_reader,
                                           .group_color = made ? group_color : NULL};
    if (g->shape) assert_int_equal(dp_source_from_shape(&shape, &o->reader.shape, NULL), DP_OK);
    if (o->reader.heavy) assert_non_null(o->reader.padding = calloc(PADDING, 3 * sizeof(float)));
    assert_int_equal(dp_source_from_callbacks(&callbacks, NULL, &o->source, NULL), DP_OK);
    if (g->clip.plane_count)
        assert_int_equal(dp_source_clip(o->source, &g->clip, NULL, &o->source, NULL), DP_OK);
}

static void close_source(opened *o) {
    dp_source_destroy(o->source);
    dp_source_destroy(o->reader.shape);
    free(o->reader.padding);
}

/* ------- drawing ------- */

/* Camera space becomes larger; what is seen stays the same. */
static void scale_view(dp_camera *camera, double scale, bool orthographic) {
    for (int i = 0; i < 16; i++)
        if (i % 4 < 3) camera->view[i] *= scale;
    if (!orthographic) camera->projection[14] *= scale; /* near and far */
    for (int i = 0; i < 3 && orthographic; i++) camera->projection[5 * i] /= scale;
}

static dp_camera camera_of(const golden_camera *c, uint32_t width, uint32_t height) {
    dp_camera camera;
    const double aspect = (double)width / height;
    dp_fit fit = {.min = {-1, -1, -1},
                  .max = {1, 1, 1},
                  .aspect = aspect,
                  .orthographic = c->orthographic,
                  .zoom = c->zoom};
    memcpy(fit.direction, c->direction, sizeof fit.direction);
    assert_int_equal(dp_camera_fit(&camera, &fit), DP_OK);
    if (c->flat) {
        const double *const d = c->direction;
        const double to[3] = {d[0], d[1], d[2] != 0 ? d[2] : 1};
        const double far = 600 / sqrt(to[0] * to[0] + to[1] * to[1] + to[2] * to[2]);
        dp_camera_look_at(&camera, (const double[3]){far * to[0], far * to[1], far * to[2]},
                          (const double[3]){0, 0, 0}, (const double[3]){0, 1, 0});
        dp_camera_orthographic(&camera, height, aspect, 1, 1500);
    }
    for (int i = 0; i < 16 && c->gain > 0; i++) camera.projection[i] *= c->gain;
    if (c->scale > 0) scale_view(&camera, c->scale, c->flat || c->orthographic);
    return camera;
}

static uint32_t color_of_group(uint32_t group) {
    static const uint32_t colors[] = {DP_RGB(150, 30, 20), DP_RGB(20, 60, 160),
                                      DP_RGB(20, 110, 40)};
    return colors[group % 3];
}

static void record(dp_context *context, const model *m, const dp_style *style) {
    for (size_t i = 0; i < m->polygons; i++) {
        const uint32_t group = m->groups[i];
        dp_enable(context, style->lines ? style->lines : DP_ALL_LINES);
        dp_line_width(context, DP_ALL_LINES, 1.5f + (float)group);
        dp_line_color(context, DP_ALL_LINES, color_of_group(group));
        dp_surface_color(context, group_color(NULL, group));
        dp_begin(context, DP_POLYGON);
        for (uint32_t c = m->firsts[i]; c < m->firsts[i + 1]; c++) {
            dp_edge_flag(context, m->flags[c]);
            dp_vertex3fv(context, m->positions[c]);
        }
        dp_end(context);
    }
}

/* A trace, in memory; it ends with a zero. */
typedef struct text {
    char *bytes;
    size_t size, room;
} text;

static dp_result add_text(void *user, const char *bytes, size_t size, dp_diag *diag) {
    text *const t = user;
    (void)diag;
    while (t->room < t->size + size + 1) {
        t->room = t->room ? 2 * t->room : 4096;
        assert_non_null(t->bytes = realloc(t->bytes, t->room));
    }
    memcpy(t->bytes + t->size, bytes, size);
    t->bytes[t->size += size] = 0;
    return DP_OK;
}

static dp_result draw_with(const golden *g, dp_context *context, const model *made,
                           const dp_camera *camera, const dp_style *style, const dp_target *target,
                           dp_diag *diag) {
    if (g->reading == GOLDEN_IMMEDIATE) {
        dp_set_camera(context, camera);
        dp_set_style(context, style);
        record(context, made, style);
        return dp_finish(context, target, diag);
    }
    opened o;
    open_source(g, made, &o);
    const dp_result result = dp_draw(context, o.source, camera, style, target, diag);
    close_source(&o);
    return result;
}

/* Also writes the drawing's trace where `trace` is not NULL. */
static void draw(const golden *g, uint32_t threads, uint8_t *rgba, uint32_t width, uint32_t height,
                 text *trace) {
    static model made;
    dp_context *context = NULL;
    dp_texture *texture = NULL;
    dp_diag diag = {0};
    const dp_camera camera = camera_of(&g->camera, width, height);
    const dp_target target = {
        .width = width, .height = height, .samples = g->samples, .rgba = rgba};
    const dp_context_desc desc = {.threads = threads,
                                  .memory = g->reading == GOLDEN_TWICE ? (size_t)48 << 20 : 0};
    dp_style style = g->style;
    made = (model){.corners = 0};
    if (g->make) g->make(&made);
    if (g->texture) assert_int_equal(dp_texture_named(g->texture, 0, NULL, &texture, NULL), DP_OK);
    style.stroke.texture = texture;
    assert_int_equal(dp_context_create(&desc, &context, NULL), DP_OK);
    if (draw_with(g, context, g->make ? &made : NULL, &camera, &style, &target, &diag))
        fail_msg("%s: %s", g->name, diag.message);
    if (trace && dp_trace(context, add_text, trace, &diag))
        fail_msg("%s: %s", g->name, diag.message);
    dp_context_destroy(context);
    dp_texture_destroy(texture);
}

/* ------- comparing ------- */

/* Pixels that differ by more than a grey level. */
static int count_off(const uint8_t *rgba, const uint8_t *kept, size_t pixels) {
    int off = 0;
    for (size_t i = 0; i < pixels; i++) {
        bool near = true;
        for (size_t k = 0; k < 4; k++) near &= abs(rgba[4 * i + k] - kept[4 * i + k]) <= 1;
        off += !near;
    }
    return off;
}

/* The hostile build's chunks hold three triangles: streaming thousands takes too long there. */
static bool is_left_out(const golden *g) {
#ifdef DP_HOSTILE
    return g->fragile || (g->shape && g->reading != GOLDEN_MEMORY);
#else
    (void)g;
    return false;
#endif
}

/* 1 if the picture differs from the stored one. */
static int check_row(const char *folder, const golden *g, uint32_t width, uint32_t height) {
    const size_t pixels = (size_t)width * height;
    uint8_t *const rgba = malloc(4 * pixels);
    char path[512];
    dp_io_pixels kept = {0};
    int failed = 0;
    assert_non_null(rgba);
    draw(g, 2, rgba, width, height, NULL);
    snprintf(path, sizeof path, "%s/golden/%s/%s.png", DP_TESTS_DIR, folder,
             g->like ? g->like : g->name);
    if (dp_io_read_png(path, &kept, NULL)) {
        if (!getenv("DP_GOLDEN_WRITE") || g->like) fail_msg("%s is not there", path);
        assert_int_equal(dp_io_write_png(path, rgba, width, height, 0, NULL), DP_OK);
    } else {
        assert_true(kept.width == width && kept.height == height);
        const int off = count_off(rgba, kept.rgba, pixels);
        failed = off > (int)(pixels / 2000);
        if (failed) print_error("%s: %d of %zu pixels differ\n", g->name, off, pixels);
    }
    dp_io_free_pixels(&kept);
    free(rgba);
    return failed;
}

/* Another machine's sines may round otherwise: a pixel in two thousand may be off, others by a grey
 * level. */
void golden_check(const char *folder, const golden *rows, size_t count, uint32_t width,
                  uint32_t height) {
    int failed = 0;
    for (size_t i = 0; i < count; i++)
        if (!is_left_out(&rows[i])) failed += check_row(folder, &rows[i], width, height);
    if (failed) fail_msg("%d of %zu pictures are not as they are kept", failed, count);
}

/* ------- traces ------- */

/* False where there is no such file. */
static bool read_text(const char *path, text *out) {
    char part[4096];
    FILE *const file = fopen(path, "rb");
    if (!file) return false;
    for (size_t n; (n = fread(part, 1, sizeof part, file)) > 0;) add_text(out, part, n, NULL);
    return !fclose(file) && out->size;
}

static void write_text(const char *path, const text *t) {
    FILE *const file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(t->bytes, 1, t->size, file), t->size);
    assert_int_equal(fclose(file), 0);
}

/* Of several polygons that hide an end, the one that is named depends on what the tile saw first:
 * in the hostile build, whose tiles are smaller, it may be another one, or none that is known. */
static void leave_out_hiders(text *t) {
#ifdef DP_HOSTILE
    char *to = t->bytes;
    for (const char *from = t->bytes; *from;) {
        if (!strncmp(from, " by ", 4))
            for (from += 4; *from >= '0' && *from <= '9';) from++;
        else
            *to++ = *from++;
    }
    *to = 0;
    t->size = (size_t)(to - t->bytes);
#else
    (void)t;
#endif
}

static void print_difference(const char *name, const char *how, const text *is, const text *kept) {
    size_t line = 1, start = 0, i = 0;
    for (; is->bytes[i] && is->bytes[i] == kept->bytes[i]; i++)
        if (is->bytes[i] == '\n') line++, start = i + 1;
    print_error("%s, %s: line %zu is\n    %.*s\nand not\n    %.*s\n", name, how, line,
                (int)strcspn(is->bytes + start, "\n"), is->bytes + start,
                (int)strcspn(kept->bytes + start, "\n"), kept->bytes + start);
}

/* 1 where the trace is another one with so many threads and so wide vectors. */
static int check_trace(const golden *g, const text *kept, uint32_t threads, const char *cpu,
                       uint32_t width, uint32_t height) {
    uint8_t *const rgba = malloc((size_t)4 * width * height);
    text trace = {0};
    char how[64];
    assert_non_null(rgba);
    setenv("DRYPOINT_CPU", cpu, 1);
    draw(g, threads, rgba, width, height, &trace);
    leave_out_hiders(&trace);
    const bool same = !strcmp(trace.bytes, kept->bytes);
    snprintf(how, sizeof how, "%u threads, %s", threads, cpu);
    if (!same) print_difference(g->name, how, &trace, kept);
    free(trace.bytes);
    free(rgba);
    return !same;
}

static int check_traces(const char *folder, const golden *g, uint32_t width, uint32_t height) {
    dp_width widths[DP_WIDTHS_MOST];
    const uint32_t width_count = dp_widths_list(widths);
    const char *const best = widths[width_count - 1].name;
    char path[512];
    text kept = {0};
    int failed = 0;
    snprintf(path, sizeof path, "%s/golden/%s/%s.txt", DP_TESTS_DIR, folder,
             g->like ? g->like : g->name);
    if (!read_text(path, &kept)) {
        uint8_t *const rgba = malloc((size_t)4 * width * height);
        if (!getenv("DP_GOLDEN_WRITE") || g->like) fail_msg("%s is not there", path);
        assert_non_null(rgba);
        draw(g, 2, rgba, width, height, &kept);
        write_text(path, &kept);
        free(rgba);
    }
    leave_out_hiders(&kept);
    failed += check_trace(g, &kept, 1, best, width, height);
    failed += check_trace(g, &kept, 2, best, width, height);
    failed += check_trace(g, &kept, 7, best, width, height);
    for (uint32_t i = 0; i + 1 < width_count; i++)
        failed += check_trace(g, &kept, 2, widths[i].name, width, height);
    unsetenv("DRYPOINT_CPU");
    free(kept.bytes);
    return failed;
}

void golden_check_traces(const char *folder, const golden *rows, size_t count, uint32_t width,
                         uint32_t height) {
    int failed = 0;
    for (size_t i = 0; i < count; i++)
        if (!is_left_out(&rows[i])) failed += check_traces(folder, &rows[i], width, height);
    if (failed) fail_msg("%d traces of %zu drawings are not as they are kept", failed, count);
}
