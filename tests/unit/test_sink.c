/* Sinks and segments (drypoint/sink.h): the order of calls, what stops them, chains, and what
 * ends a segment, looked at with rays through random triangles. */
#include "base/hostile.h"
#include "scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static dp_context *context;
static picture shown;
static scene made;

static int make_context(void **state) {
    (void)state;
    return dp_context_create(NULL, &context, NULL) == DP_OK ? 0 : -1;
}

static int destroy_context(void **state) {
    (void)state;
    dp_context_destroy(context);
    return 0;
}

/* ------- scenes ------- */

static double random_number(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return (*state >> 8) / 16777216.0;
}

static void make_triangles(uint32_t seed, int count, double spread) {
    made.corners = made.polygons = 0;
    for (int i = 0; i < count; i++) {
        float at[3][3];
        const double x = spread * (random_number(&seed) - 0.5) * SCENE_WIDTH,
                     y = spread * (random_number(&seed) - 0.5) * SCENE_HEIGHT,
                     z = 160 * (random_number(&seed) - 0.5);
        for (int c = 0; c < 3; c++) {
            at[c][0] = (float)(x + 70 * (random_number(&seed) - 0.5));
            at[c][1] = (float)(y + 70 * (random_number(&seed) - 0.5));
            at[c][2] = (float)(z + 70 * (random_number(&seed) - 0.5));
        }
        scene_polygon(&made, 3, (const float(*)[3])at);
    }
}

static void make_boxes(void) {
    made.corners = made.polygons = 0;
    scene_box(&made, (const float[3]){-60, -30, -20}, (const float[3]){10, 25, 30});
    scene_box(&made, (const float[3]){-20, -45, -35}, (const float[3]){45, 5, 12});
}

static dp_result try_draw(const dp_camera *camera, const dp_style *style) {
    dp_diag diag = {0};
    return scene_draw(context, &made, camera, style, &shown, &diag);
}

static void draw(const dp_camera *camera, const dp_style *style) {
    assert_int_equal(try_draw(camera, style), DP_OK);
}

static void draw_boxes(const dp_style *style) {
    const dp_camera camera = scene_camera(120, 90, 160, 0, 0, 0);
    make_boxes();
    draw(&camera, style);
}

/* ------- a sink that keeps a log ------- */

enum { CALLS = 4096 };

typedef struct call {
    char what; /* b, s, l, k, e */
    dp_line line;
    dp_result so_far;
} call;

typedef struct calls {
    call list[CALLS];
    size_t count, fail_at; /* the call, from 1 on, that fails; 0: none */
    bool silent;           /* without saying why */
    dp_sheet sheet;
    size_t segments, strokes;
    const dp_target *target;
} calls;

static calls seen;

static dp_result note(void *user, call made_now, dp_diag *diag) {
    calls *const c = user;
    assert_true(c->count < CALLS);
    c->list[c->count++] = made_now;
    if (c->count != c->fail_at) return DP_OK;
    if (diag && !c->silent) {
        diag->result = DP_ERR_IO;
        snprintf(diag->message, sizeof diag->message, "call %zu", c->count);
    }
    return DP_ERR_IO;
}

static dp_result on_begin(void *user, const dp_sheet *sheet, dp_diag *diag) {
    ((calls *)user)->sheet = *sheet;
    return note(user, (call){.what = 'b'}, diag);
}

static dp_result on_surface(void *user, const dp_target *target, dp_diag *diag) {
    ((calls *)user)->target = target;
    assert_ptr_equal(target->rgba, shown.rgba);
    return note(user, (call){.what = 's'}, diag);
}

static dp_result on_layer(void *user, dp_line line, dp_diag *diag) {
    return note(user, (call){.what = 'l', .line = line}, diag);
}

static dp_result on_stroke(void *user, const dp_chain_stroke *stroke, dp_diag *diag) {
    calls *const c = user;
    c->strokes++;
    c->segments += stroke->count;
    return note(user, (call){.what = 'k', .line = stroke->line}, diag);
}

static dp_result on_end(void *user, dp_result so_far, dp_diag *diag) {
    return note(user, (call){.what = 'e', .so_far = so_far}, diag);
}

static const dp_sink logging = {&seen, on_begin, on_surface, on_layer, on_stroke, on_end};

static dp_result send_to_log(size_t fail_at, bool silent, dp_diag *diag) {
    seen = (calls){.fail_at = fail_at, .silent = silent};
    return dp_send(context, &logging, diag);
}

/* begin surface (layer stroke+)* end, layers from the bottom up, strokes of their layer. */
static void calls_come_in_order(void **state) {
    static const dp_line layers[] = {DP_LINE_VALLEY, DP_LINE_INTERSECTION, DP_LINE_RIDGE,
                                     DP_LINE_BORDER, DP_LINE_SILHOUETTE};
    (void)state;
    draw_boxes(NULL);
    assert_int_equal(send_to_log(0, false, NULL), DP_OK);
    assert_true(seen.count > 8);
    assert_int_equal(seen.list[0].what, 'b');
    assert_int_equal(seen.list[1].what, 's');
    size_t at = 2, met = 0;
    for (size_t i = 0; i < sizeof layers / sizeof *layers; i++) {
        if (seen.list[at].what != 'l' || seen.list[at].line != layers[i]) continue;
        met++, at++;
        assert_int_equal(seen.list[at].what, 'k');
        for (; seen.list[at].what == 'k'; at++) assert_int_equal(seen.list[at].line, layers[i]);
    }
    assert_true(met >= 3);
    assert_int_equal(seen.list[at].what, 'e');
    assert_int_equal(seen.list[at].so_far, DP_OK);
    assert_int_equal(at + 1, seen.count);
    assert_int_equal(seen.sheet.width, SCENE_WIDTH);
    assert_int_equal(seen.sheet.height, SCENE_HEIGHT);
    assert_int_equal(seen.sheet.strokes, seen.strokes);
    assert_int_equal(seen.sheet.segments, seen.segments);
}

static dp_result count_strokes(void *user, const dp_sheet *sheet, dp_diag *diag) {
    (void)diag;
    *(size_t *)user = sheet->strokes;
    return DP_OK;
}

/* Any function may be left out; and begin is told how many strokes come, whatever else there is. */
static void functions_may_be_left_out(void **state) {
    size_t strokes = 0;
    (void)state;
    draw_boxes(NULL);
    assert_int_equal(dp_send(context, &(dp_sink){.user = &strokes, .begin = count_strokes}, NULL),
                     DP_OK);
    assert_int_equal(dp_send(context, &(dp_sink){0}, NULL), DP_OK);
    assert_int_equal(send_to_log(0, false, NULL), DP_OK);
    assert_true(strokes > 0);
    assert_int_equal(strokes, seen.strokes);
    for (int left_out = 0; left_out < 5; left_out++) {
        dp_sink sink = logging;
        if (left_out == 0) sink.begin = NULL;
        if (left_out == 1) sink.surface = NULL;
        if (left_out == 2) sink.layer = NULL;
        if (left_out == 3) sink.stroke = NULL;
        if (left_out == 4) sink.end = NULL;
        seen = (calls){.count = 0};
        assert_int_equal(dp_send(context, &sink, NULL), DP_OK);
        for (size_t i = 0; i < seen.count; i++)
            assert_int_not_equal(seen.list[i].what, "bslke"[left_out]);
        assert_true(seen.count >= 4);
    }
}

/* Whichever call fails: nothing comes after it but the end, which knows; the reason is told. */
static void any_call_may_fail(void **state) {
    (void)state;
    draw_boxes(NULL);
    assert_int_equal(send_to_log(0, false, NULL), DP_OK);
    const size_t whole = seen.count;
    for (size_t at = 1; at <= whole; at++) {
        char message[32];
        dp_diag diag = {0};
        snprintf(message, sizeof message, "call %zu", at);
        assert_int_equal(send_to_log(at, false, &diag), DP_ERR_IO);
        assert_int_equal(diag.result, DP_ERR_IO);
        assert_string_equal(diag.message, message);
        const bool ends = at > 1 && at < whole;
        assert_int_equal(seen.count, at + ends);
        if (ends) assert_int_equal(seen.list[at].what, 'e');
        if (ends) assert_int_equal(seen.list[at].so_far, DP_ERR_IO);
        assert_int_equal(send_to_log(at, true, &diag), DP_ERR_IO); /* it does not say why */
        assert_int_equal(diag.result, DP_ERR_IO);
        assert_true(diag.message[0] && strcmp(diag.message, message) != 0);
        assert_int_equal(send_to_log(at, false, NULL), DP_ERR_IO);
    }
}

static dp_result fail_stroke(void *user, const dp_chain_stroke *stroke, dp_diag *diag) {
    (void)user, (void)stroke;
    diag->result = DP_ERR_LIMIT;
    strcpy(diag->message, "enough");
    return DP_ERR_LIMIT;
}

static dp_result fail_end(void *user, dp_result so_far, dp_diag *diag) {
    (void)user;
    if (so_far) assert_null(diag);
    return DP_ERR_IO;
}

/* An end that fails as well does not hide what stopped the drawing. */
static void the_first_failure_is_told(void **state) {
    dp_diag diag = {0};
    (void)state;
    draw_boxes(NULL);
    assert_int_equal(dp_send(context, &(dp_sink){.stroke = fail_stroke, .end = fail_end}, &diag),
                     DP_ERR_LIMIT);
    assert_int_equal(diag.result, DP_ERR_LIMIT);
    assert_string_equal(diag.message, "enough");
    assert_int_equal(dp_send(context, &(dp_sink){.end = fail_end}, &diag), DP_ERR_IO);
}

/* ------- when there is something to send ------- */

static void assert_nothing_to_send(void) {
    dp_diag diag = {0};
    size_t count = 1;
    assert_int_equal(send_to_log(0, false, &diag), DP_ERR_ARGUMENT);
    assert_int_equal(diag.result, DP_ERR_ARGUMENT);
    assert_int_equal(seen.count, 0);
    assert_null(dp_segments(context, &count));
    assert_int_equal(count, 0);
}

static int stop_at_once(void *user, double fraction) {
    (void)user, (void)fraction;
    return *(bool *)user;
}

static void a_failed_drawing_sends_nothing(void **state) {
    const dp_camera camera = scene_camera(120, 90, 160, 0, 0, 0), none = {{0}, {0}};
    dp_diag diag;
    bool stops = false;
    dp_context *const shared = context;
    const dp_context_desc desc = {.progress = stop_at_once, .user = &stops};
    (void)state;
    assert_int_equal(dp_context_create(&desc, &context, NULL), DP_OK);
    assert_int_equal(dp_send(NULL, &logging, &diag), DP_ERR_ARGUMENT);
    assert_int_equal(dp_send(context, NULL, &diag), DP_ERR_ARGUMENT);
    assert_int_equal(dp_trace(context, NULL, NULL, &diag), DP_ERR_ARGUMENT);
    assert_nothing_to_send();
    for (int way = 0; way < 6; way++) {
        make_boxes();
        draw(&camera, NULL);
        assert_int_equal(send_to_log(0, false, NULL), DP_OK);
        stops = way == 0;
        if (way == 0) assert_int_equal(try_draw(&camera, NULL), DP_ERR_CANCELLED);
        if (way == 1) assert_int_equal(try_draw(&none, NULL), DP_ERR_ARGUMENT);
        if (way == 2)
            assert_int_equal(try_draw(&camera, &(dp_style){.ridge_angle = -1}), DP_ERR_ARGUMENT);
        if (way == 3) assert_int_equal(dp_finish(context, NULL, &diag), DP_ERR_ARGUMENT);
        if (way == 4) made.positions[0][0] = NAN, made.polygons = 1;
        if (way == 4) assert_int_equal(try_draw(&camera, NULL), DP_ERR_FORMAT);
        if (way == 5)
            assert_int_equal(dp_draw(context, NULL, NULL, NULL, NULL, &diag), DP_ERR_ARGUMENT);
        stops = false;
        assert_nothing_to_send();
    }
    dp_context_destroy(context);
    context = shared;
}

static void quads_have_no_strokes(void **state) {
    size_t count = 1;
    (void)state;
    draw_boxes(&(dp_style){.ink = DP_INK_QUADS});
    assert_int_equal(send_to_log(0, false, NULL), DP_OK);
    assert_int_equal(seen.count, 3);
    assert_int_equal(seen.sheet.segments, 0);
    assert_null(dp_segments(context, &count));
    assert_int_equal(count, 0);
    draw_boxes(&(dp_style){.ink = DP_INK_QUADS, .edges = DP_EDGES_ADJACENCY});
    assert_int_equal(send_to_log(0, false, NULL), DP_OK);
    assert_true(seen.segments > 0);
}

/* What is sent is the picture's, not the image's in its mirror. */
static void a_mirrored_drawing_is_sent(void **state) {
    const dp_style plain = {.surface = DP_RGB(200, 200, 200)};
    dp_style mirrored = plain;
    size_t before, after;
    (void)state;
    draw_boxes(&plain);
    assert_non_null(dp_segments(context, &before));
    mirrored.mirror = (dp_mirror){.normal = {0, 1, 0}, .offset = -50, .size = 60};
    draw_boxes(&mirrored);
    assert_non_null(dp_segments(context, &after));
    assert_true(after > before); /* the mirror's own edges */
    assert_int_equal(send_to_log(0, false, NULL), DP_OK);
    assert_int_equal(seen.segments, after);
}

static void what_is_recorded_is_sent(void **state) {
    const dp_camera camera = scene_flat_camera();
    const dp_target target = {.width = SCENE_WIDTH, .height = SCENE_HEIGHT, .rgba = shown.rgba};
    (void)state;
    dp_set_camera(context, &camera);
    dp_enable(context, DP_ALL_LINES);
    dp_begin(context, DP_POLYGON);
    dp_vertex3f(context, -20, -20, 0);
    dp_vertex3f(context, 30, -20, 0);
    dp_vertex3f(context, 5, 30, 0);
    dp_end(context);
    assert_int_equal(dp_finish(context, &target, NULL), DP_OK);
    assert_int_equal(send_to_log(0, false, NULL), DP_OK);
    assert_int_equal(seen.segments, 3);
    assert_int_equal(seen.strokes, 1);
}

/* ------- chains ------- */

typedef struct walking {
    const dp_segment *all; /* what dp_segments gave before */
    size_t count, met, closed;
    bool gaps; /* those of stylized strokes are allowed */
    bool *taken;
} walking;

static const float *end_of(const dp_segment *s, bool last) {
    return s->reversed == last ? s->a : s->b;
}

static bool same_place(const float a[3], const float b[3]) {
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static dp_result walk(void *user, const dp_chain_stroke *stroke, dp_diag *diag) {
    walking *const w = user;
    (void)diag;
    assert_true(stroke->count > 0);
    for (size_t i = 0; i < stroke->count; i++) {
        const dp_segment *const s = stroke->segments[i];
        const size_t index = (size_t)(s - w->all);
        assert_true(index < w->count && !w->taken[index]);
        w->taken[index] = true;
        w->met++;
        assert_int_equal(s->place, i);
        assert_int_equal(s->chain, stroke->chain);
        assert_int_equal(s->line, stroke->line);
        assert_int_equal(s->color, stroke->color);
        const dp_segment *const next = i + 1 < stroke->count ? stroke->segments[i + 1]
                                       : stroke->closed      ? stroke->segments[0]
                                                             : NULL;
        if (next && !w->gaps) assert_true(same_place(end_of(s, true), end_of(next, false)));
    }
    w->closed += stroke->closed;
    return DP_OK;
}

static void assert_same_segments(const dp_segment *s, const dp_segment *t, size_t count) {
    for (size_t i = 0; i < count; i++) {
        assert_true(same_place(s[i].a, t[i].a) && same_place(s[i].b, t[i].b));
        assert_true(s[i].polygon == t[i].polygon && s[i].edge == t[i].edge);
        assert_true(s[i].chain == t[i].chain && s[i].place == t[i].place);
        assert_true(s[i].reversed == t[i].reversed);
    }
}

/* Segments are the same whoever asked first; each has its place in one chain, and they meet. */
static void check_chains(const dp_camera *camera, const dp_style *style, size_t *closed) {
    walking w = {.gaps = style != NULL};
    draw(camera, style);
    const dp_segment *const asked = dp_segments(context, &w.count);
    assert_non_null(asked);
    dp_segment *const first = malloc(w.count * sizeof *first);
    assert_non_null(first);
    memcpy(first, asked, w.count * sizeof *first);
    assert_non_null(w.taken = calloc(w.count, sizeof *w.taken));
    w.all = asked;
    const dp_sink sink = {.user = &w, .stroke = walk};
    assert_int_equal(dp_send(context, &sink, NULL), DP_OK);
    assert_int_equal(w.met, w.count);
    assert_ptr_equal(dp_segments(context, NULL), asked);
    assert_same_segments(first, asked, w.count);
    *closed = w.closed;
    draw(camera, style); /* again, sent before it is asked for */
    assert_int_equal(send_to_log(0, false, NULL), DP_OK);
    size_t count;
    const dp_segment *const sent = dp_segments(context, &count);
    assert_int_equal(count, w.count);
    assert_same_segments(sent, first, count);
    free(first);
    free(w.taken);
}

static void chains_are_whole(void **state) {
    const dp_camera camera = scene_camera(120, 90, 160, 0, 0, 0), flat = scene_flat_camera();
    const dp_style stylized = {.stroke = {.taper = 5}};
    size_t closed;
    (void)state;
    make_boxes();
    check_chains(&camera, NULL, &closed);
    check_chains(&camera, &stylized, &closed);
    for (uint32_t seed = 1; seed < 6; seed++) {
        make_triangles(seed, 40, 0.8);
        check_chains(&flat, NULL, &closed);
        check_chains(&camera, &stylized, &closed);
    }
    made.corners = made.polygons = 0;
    scene_polygon(&made, 3, (const float[][3]){{-20, -20, 0}, {20, -20, 0}, {0, 15, 0}});
    check_chains(&flat, NULL, &closed);
    assert_int_equal(closed, 1);
}

/* Chains take memory when they are made, and no more after that. One thread: what several take
 * depends on which of them did what. */
static void statistics_count_chains(void **state) {
    dp_context *const shared = context;
    dp_stats before, after, again;
    (void)state;
    assert_int_equal(dp_context_create(&(dp_context_desc){.threads = 1}, &context, NULL), DP_OK);
    draw_boxes(NULL);
    dp_stats_of(context, &before);
    assert_non_null(dp_segments(context, NULL));
    dp_stats_of(context, &after);
    assert_true(after.bytes > before.bytes);
    draw_boxes(NULL);
    assert_int_equal(send_to_log(0, false, NULL), DP_OK);
    dp_stats_of(context, &again);
    assert_int_equal(again.bytes, after.bytes);
    dp_context_destroy(context);
    context = shared;
}

/* ------- ends ------- */

typedef struct point {
    double x, y, z;
} point;

static point at(const float p[3]) { return (point){(double)p[0], (double)p[1], (double)p[2]}; }
static point minus(point a, point b) { return (point){a.x - b.x, a.y - b.y, a.z - b.z}; }
static point along(point a, point b, double t) {
    return (point){a.x + t * b.x, a.y + t * b.y, a.z + t * b.z};
}
static double dot(point a, point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static point cross(point a, point b) {
    return (point){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static double length_of(point a) { return sqrt(dot(a, a)); }

enum { EYE = 260 }; /* both cameras look from +z at the middle */

/* Where the point is seen, px from the picture's middle, y up; third: towards the eye. */
static point seen_at(point p, bool flat) {
    const double focal = flat ? 1 : SCENE_HEIGHT / 2.0 / tan(25 * 3.14159265358979323846 / 180);
    const double scale = flat ? 1 : focal / (EYE - p.z);
    return (point){p.x * scale, p.y * scale, scale};
}

/* How far outside of a triangle on the screen, px. */
static double outside(const point corner[3], double x, double y) {
    const double turn = (corner[1].x - corner[0].x) * (corner[2].y - corner[0].y) -
                        (corner[1].y - corner[0].y) * (corner[2].x - corner[0].x);
    double most = -INFINITY;
    for (int i = 0; i < 3; i++) {
        const point a = corner[i], b = corner[(i + 1) % 3];
        const double ex = b.x - a.x, ey = b.y - a.y, side = ey * (x - a.x) - ex * (y - a.y);
        most = fmax(most, (turn > 0 ? side : -side) / hypot(ex, ey));
    }
    return most;
}

/* The hider covers a point within two pixels of the sample point behind a hidden end, an eighth of a
 * pixel on, and is nearer. Sample points are lifted by a tenth of a pixel, which planes seen edge-on magnify. */
static void check_hider(const dp_segment *s, int k, bool flat) {
    const point end = at(k ? s->world_b : s->world_a), other = at(k ? s->world_a : s->world_b);
    const double px = hypot((double)s->b[0] - (double)s->a[0], (double)s->b[1] - (double)s->a[1]);
    const point beyond = along(end, minus(end, other), 0.125 / px), spot = seen_at(beyond, flat);
    point corner[3], on_screen[3];
    assert_true(s->hider[k] < made.polygons);
    assert_true(s->hider[k] != s->polygon && s->hider[k] != s->other);
    for (int c = 0; c < 3; c++) {
        corner[c] = at(made.positions[3 * s->hider[k] + (size_t)c]);
        on_screen[c] = seen_at(corner[c], flat);
    }
    assert_true(outside(on_screen, spot.x, spot.y) < 2);
    const point normal = cross(minus(corner[1], corner[0]), minus(corner[2], corner[0]));
    const point eye = flat ? along(beyond, (point){0, 0, 1}, EYE) : (point){0, 0, EYE};
    const point ray = minus(beyond, eye);
    const double slope = fabs(dot(normal, ray)) / (length_of(normal) * length_of(ray));
    const double t = dot(normal, minus(corner[0], eye)) / dot(normal, ray); /* 1: at the line */
    assert_true((t - 1) * length_of(ray) < 0.3 / spot.z / slope);
}

static void check_picture_end(const dp_segment *s, int k) {
    const float *const p = k ? s->b : s->a;
    const double x = (double)p[0], y = (double)p[1];
    const double from_edge = fmin(fmin(x, SCENE_WIDTH - x), fmin(y, SCENE_HEIGHT - y));
    assert_true(from_edge < 0.4);
}

/* An end that is a vertex is the one that the edge begins or ends with. */
static void check_vertex_end(const dp_segment *s, int k) {
    const size_t corner = (s->edge + (size_t)k) % 3;
    const point from =
        minus(at(k ? s->world_b : s->world_a), at(made.positions[3 * s->polygon + corner]));
    assert_true(s->edge < 3);
    assert_true(length_of(from) < 1e-3);
}

typedef struct tally {
    size_t hidden, known, picture, vertices, crossings;
} tally;

static void check_ends(bool flat, tally *t) {
    size_t count;
    const dp_segment *const segments = dp_segments(context, &count);
    for (size_t i = 0; i < count; i++) {
        const dp_segment *const s = &segments[i];
        for (int k = 0; k < 2; k++) {
            const bool known = s->end[k] == DP_END_HIDDEN && s->hider[k] != UINT64_MAX;
            assert_true(s->end[k] == DP_END_HIDDEN || s->hider[k] == UINT64_MAX);
            assert_true(s->end[k] != DP_END_CROSSING || s->edge == UINT32_MAX);
            t->hidden += s->end[k] == DP_END_HIDDEN;
            t->known += known;
            t->picture += s->end[k] == DP_END_PICTURE;
            t->vertices += s->end[k] == DP_END_VERTEX;
            t->crossings += s->end[k] == DP_END_CROSSING;
            if (known) check_hider(s, k, flat);
            if (s->end[k] == DP_END_PICTURE) check_picture_end(s, k);
            if (s->end[k] == DP_END_VERTEX) check_vertex_end(s, k);
        }
    }
}

static void ends_are_what_they_say(void **state) {
    (void)state;
    for (int flat = 0; flat < 2; flat++) {
        const dp_camera camera = flat ? scene_flat_camera() : scene_camera(0, 0, EYE, 0, 0, 0);
        tally t = {0};
        for (uint32_t seed = 1; seed <= 12; seed++) {
            make_triangles(100 + seed, 60, seed % 2 ? 0.8 : 1.6);
            draw(&camera, NULL);
            check_ends(flat, &t);
        }
        print_message("hidden %zu, known %zu, picture %zu, vertex %zu, crossing %zu\n", t.hidden,
                      t.known, t.picture, t.vertices, t.crossings);
        assert_true(t.hidden > 500 && t.picture > 50 && t.vertices > 500 && t.crossings > 100);
        /* not where tiles meet, and hostile ones meet often */
        assert_true(t.known >= t.hidden - t.hidden / DP_TUNED(50, 20));
    }
}

/* The planes end lines only where they cut them, also where the near one is close to the eye, so
 * that z / w is nearly 1 for all that is seen. */
static void planes_end_lines(void **state) {
    static const double nears[] = {1e-3, 1, 230};
    (void)state;
    for (int flat = 0; flat < 2; flat++)
        for (size_t i = 0; i < sizeof nears / sizeof *nears; i++) {
            dp_camera camera = scene_camera(0, 0, EYE, 0, 0, 0);
            const double aspect = (double)SCENE_WIDTH / SCENE_HEIGHT;
            size_t count, cut = 0;
            if (flat)
                dp_camera_orthographic(&camera, SCENE_HEIGHT, aspect, nears[i], 1000);
            else
                dp_camera_perspective(&camera, 50, aspect, nears[i], 1e6);
            made.corners = made.polygons = 0;
            scene_polygon(&made, 3,
                          (const float[][3]){{-20, -20, -30}, {20, -20, -30}, {0, 20, 40}});
            draw(&camera, NULL);
            const dp_segment *const s = dp_segments(context, &count);
            for (size_t k = 0; k < 2 * count; k++) cut += s[k / 2].end[k % 2] == DP_END_PICTURE;
            assert_int_equal(count, 3);
            assert_int_equal(cut, nears[i] > 200 ? 2 : 0);
        }
}

/* ------- memory ------- */

typedef struct meter {
    long alive, calls, fail_at;
} meter;

static bool fails(meter *m) { return ++m->calls == m->fail_at; }

static void *meter_alloc(size_t size, void *user) {
    meter *const m = user;
    void *const block = fails(m) ? NULL : malloc(size ? size : 1);
    m->alive += block != NULL;
    return block;
}

static void *meter_realloc(void *block, size_t size, void *user) {
    meter *const m = user;
    void *const moved = fails(m) ? NULL : realloc(block, size ? size : 1);
    m->alive += moved && !block;
    return moved;
}

static void meter_free(void *block, void *user) {
    ((meter *)user)->alive -= block != NULL;
    free(block);
}

static dp_result drop_text(void *user, const char *text, size_t size, dp_diag *diag) {
    (void)text, (void)diag;
    *(size_t *)user += size;
    return DP_OK;
}

/* However the drawing is asked for, any allocation may fail; then it can be asked again. */
static void memory_may_run_out(void **state) {
    const dp_camera camera = scene_camera(0, 0, EYE, 0, 0, 0);
    dp_context *const shared = context;
    (void)state;
    make_triangles(3, 50, 0.8);
    for (int way = 0; way < 3; way++) {
        bool met = true;
        for (long nth = 1; met; nth++) {
            meter m = {0};
            const dp_allocator allocator = {meter_alloc, meter_realloc, meter_free, &m};
            const dp_context_desc desc = {.allocator = &allocator, .threads = 1};
            dp_diag diag = {0};
            size_t count = 0, bytes = 0;
            assert_int_equal(dp_context_create(&desc, &context, NULL), DP_OK);
            draw(&camera, NULL);
            m.calls = 0, m.fail_at = nth;
            dp_result result = DP_OK;
            if (way == 0) result = dp_segments(context, &count) ? DP_OK : DP_ERR_MEMORY;
            if (way == 1) result = send_to_log(0, false, &diag);
            if (way == 2) result = dp_trace(context, drop_text, &bytes, &diag);
            met = m.calls >= nth;
            assert_int_equal(result, met ? DP_ERR_MEMORY : DP_OK);
            if (met && way) assert_int_equal(diag.result, DP_ERR_MEMORY);
            m.fail_at = 0;
            assert_int_equal(send_to_log(0, false, NULL), DP_OK);
            assert_non_null(dp_segments(context, &count));
            assert_int_equal(seen.segments, count);
            draw(&camera, NULL);
            dp_context_destroy(context);
            assert_int_equal(m.alive, 0);
            if (!met) assert_true(nth > 3);
            assert_true(nth < 100);
        }
    }
    context = shared;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(calls_come_in_order),
        cmocka_unit_test(functions_may_be_left_out),
        cmocka_unit_test(any_call_may_fail),
        cmocka_unit_test(the_first_failure_is_told),
        cmocka_unit_test(a_failed_drawing_sends_nothing),
        cmocka_unit_test(quads_have_no_strokes),
        cmocka_unit_test(a_mirrored_drawing_is_sent),
        cmocka_unit_test(what_is_recorded_is_sent),
        cmocka_unit_test(chains_are_whole),
        cmocka_unit_test(statistics_count_chains),
        cmocka_unit_test(ends_are_what_they_say),
        cmocka_unit_test(planes_end_lines),
        cmocka_unit_test(memory_may_run_out),
    };
    return cmocka_run_group_tests(tests, make_context, destroy_context);
}
