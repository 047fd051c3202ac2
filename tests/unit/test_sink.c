/* Sinks and segments (drypoint/sink.h): the order of calls, what stops them, chains, and
 * memory. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sink_scene.h"

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
    static const dp_line layers[] = {DP_LINE_HATCHING, DP_LINE_VALLEY, DP_LINE_INTERSECTION,
                                     DP_LINE_RIDGE,    DP_LINE_BORDER, DP_LINE_SILHOUETTE,
                                     DP_LINE_SECTION};
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
        cmocka_unit_test(memory_may_run_out),
    };
    return cmocka_run_group_tests(tests, make_context, destroy_context);
}
