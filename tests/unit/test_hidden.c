/* Hidden lines: which there are, their classes and levels; what is visible stays; how they are
 * inked. */
#include "base/kernels.h"
#include "strokes/hidden.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sink_scene.h"

static const dp_style solid = {.hidden = {.look = DP_HIDDEN_SOLID, .levels = DP_LEVELS}};

static void begin_scene(void) { made.corners = made.polygons = 0; }

/* px of hidden lines of a class and level; -1: any. */
static double hidden_length(int line, int level) {
    size_t count;
    const dp_segment *const s = dp_segments(context, &count);
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        if (!s[i].level || (line >= 0 && (int)s[i].line != line) ||
            (level >= 0 && (int)s[i].level != level))
            continue;
        const double x = (double)s[i].b[0] - (double)s[i].a[0],
                     y = (double)s[i].b[1] - (double)s[i].a[1];
        sum += sqrt(x * x + y * y);
    }
    return sum;
}

static size_t hidden_count(int line, int level) {
    size_t count, sum = 0;
    const dp_segment *const s = dp_segments(context, &count);
    for (size_t i = 0; i < count; i++)
        sum += s[i].level && (line < 0 || (int)s[i].line == line) &&
               (level < 0 || (int)s[i].level == level);
    return sum;
}

/* ------- which lines, and how deep ------- */

static void a_box_hides_three_ridges(void **state) {
    const dp_camera camera = scene_camera(120, 90, 160, 0, 0, 0);
    (void)state;
    begin_scene();
    scene_box(&made, (const float[3]){-30, -25, -20}, (const float[3]){30, 25, 20});
    draw(&camera, &solid);
    size_t count;
    const dp_segment *const s = dp_segments(context, &count);
    assert_int_equal(count, 12);
    assert_int_equal(hidden_count(DP_LINE_RIDGE, 1), 3);
    assert_int_equal(hidden_count(-1, -1), 3);
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 2; k++) assert_int_equal(s[i].end[k], DP_END_VERTEX);
}

static void no_hidden_lines_unless_wanted(void **state) {
    (void)state;
    draw_boxes(NULL);
    assert_int_equal(hidden_count(-1, -1), 0);
}

/* A small box behind a large one, seen nearly from the front. */
static void make_two_boxes(void) {
    begin_scene();
    scene_box(&made, (const float[3]){-50, -40, 0}, (const float[3]){50, 40, 20});
    scene_box(&made, (const float[3]){-20, -15, -60}, (const float[3]){20, 15, -30});
}

static void boxes_behind_each_other_have_two_levels(void **state) {
    const dp_camera camera = scene_camera(60, 50, 400, 0, 0, 0);
    (void)state;
    make_two_boxes();
    draw(&camera, &solid);
    /* the large one's back edges, and what the small one shows; behind that its own back edges */
    assert_int_equal(hidden_count(-1, 2), 3);
    assert_int_equal(hidden_count(DP_LINE_RIDGE, 2), 3);
    assert_int_equal(hidden_count(DP_LINE_SILHOUETTE, 1), 6);
    assert_int_equal(hidden_count(DP_LINE_RIDGE, 1), 3 + 3);
    assert_int_equal(hidden_count(-1, -1), 3 + 6 + 6);
    const double all = hidden_length(-1, -1);
    dp_style one = solid;
    one.hidden.levels = 1;
    draw(&camera, &one);
    assert_true(fabs(hidden_length(-1, 1) - all) < 1e-3 * all);
    assert_int_equal(hidden_count(-1, 2), 0);
}

/* A row of screens before a line: levels are saturated. */
static void levels_are_saturated(void **state) {
    const dp_camera camera = scene_flat_camera();
    (void)state;
    begin_scene();
    scene_wall(&made, -20, -50, 20, -50, 20);
    for (int i = 0; i < 5; i++) scene_wall(&made, -60, 5 * i, 60, 5 * i, 50);
    for (uint32_t levels = 1; levels <= DP_LEVELS; levels++) {
        dp_style style = solid;
        style.hidden.levels = levels;
        draw(&camera, &style);
        const int expected = levels < 5 ? (int)levels : 5;
        assert_true(fabs(hidden_length(DP_LINE_BORDER, expected) - (2 * 40 + 2 * 40)) < 1 ||
                    expected < 5);
        assert_true(hidden_length(DP_LINE_BORDER, expected) > 2 * 40 + 2 * 40 - 1);
        assert_int_equal(hidden_count(-1, expected + 1), 0);
    }
}

/* A sheet turned away has no front face, but hides all the same. */
static void an_open_sheet_from_behind_hides_once(void **state) {
    const dp_camera camera = scene_flat_camera();
    (void)state;
    begin_scene();
    scene_wall(&made, -20, -50, 20, -50, 20);
    scene_wall(&made, 60, 0, -60, 0, 50);
    scene_wall(&made, 60, 10, -60, 10, 50);
    draw(&camera, &solid);
    assert_true(fabs(hidden_length(DP_LINE_BORDER, 1) - (2 * 40 + 2 * 40)) < 1 ||
                hidden_length(DP_LINE_BORDER, 1) > 4 * 40 - 1);
    assert_int_equal(hidden_count(-1, 2), 0);
}

/* What two backs make is what the object has there, not what would be seen from behind. */
static void folds_of_backs_are_classed_by_the_object(void **state) {
    const dp_camera behind = scene_camera(0, 0, -400, 0, 0, 0);
    (void)state;
    for (int concave = 0; concave < 2; concave++) {
        begin_scene();
        scene_roof(&made, concave ? 270 : 90, 30);
        scene_wall(&made, 90, -100, -90, -100, 70);
        draw(&behind, &solid);
        assert_true(hidden_length(concave ? DP_LINE_VALLEY : DP_LINE_RIDGE, -1) > 20);
        assert_int_equal(hidden_count(concave ? DP_LINE_RIDGE : DP_LINE_VALLEY, -1), 0);
    }
}

static void smooth_folds_are_left_out(void **state) {
    const dp_camera camera = scene_flat_camera();
    (void)state;
    begin_scene();
    scene_roof(&made, 145, 30);
    scene_wall(&made, -90, 50, 90, 50, 55);
    draw(&camera, &solid);
    assert_int_equal(hidden_count(DP_LINE_RIDGE, -1), 0);
    dp_style smooth = solid;
    smooth.hidden.smooth = true;
    draw(&camera, &smooth);
    assert_true(hidden_length(DP_LINE_RIDGE, 1) > 20);
}

static void crossings_are_hidden_too(void **state) {
    const dp_camera camera = scene_flat_camera();
    (void)state;
    begin_scene();
    scene_wall(&made, -40, -30, 40, 20, 30);
    scene_wall(&made, -40, 20, 40, -30, 30);
    draw(&camera, &solid);
    const size_t open = hidden_count(DP_LINE_INTERSECTION, -1);
    scene_wall(&made, -90, 50, 90, 50, 55);
    draw(&camera, &solid);
    assert_int_equal(open, 0);
    assert_true(fabs(hidden_length(DP_LINE_INTERSECTION, 1) - 60) < 1);
}

/* ------- what is visible stays ------- */

static int by_place(const void *left, const void *right) {
    const dp_segment *const l = left, *const r = right;
    const int line = (int)l->line - (int)r->line;
    if (line) return line;
    const int a = memcmp(l->a, r->a, sizeof l->a);
    return a ? a : memcmp(l->b, r->b, sizeof l->b);
}

/* The visible segments, sorted; the caller frees them. */
static dp_segment *visible_segments(size_t *visible) {
    size_t count;
    const dp_segment *const s = dp_segments(context, &count);
    dp_segment *const out = malloc((count + 1) * sizeof *out);
    assert_non_null(out);
    *visible = 0;
    for (size_t i = 0; i < count; i++)
        if (!s[i].level) out[(*visible)++] = s[i];
    qsort(out, *visible, sizeof *out, by_place);
    return out;
}

static void expect_same_visible(const dp_camera *camera, const dp_style *plain) {
    size_t before, after;
    draw(camera, plain);
    dp_segment *const without = visible_segments(&before);
    dp_style style = *plain;
    style.hidden = solid.hidden;
    draw(camera, &style);
    dp_segment *const with = visible_segments(&after);
    assert_int_equal(before, after);
    for (size_t i = 0; i < before; i++) {
        const dp_segment *const p = &without[i], *const q = &with[i];
        assert_int_equal(p->line, q->line);
        assert_memory_equal(p->a, q->a, sizeof p->a);
        assert_memory_equal(p->b, q->b, sizeof p->b);
        assert_memory_equal(p->world_a, q->world_a, sizeof p->world_a);
        assert_memory_equal(p->hider, q->hider, sizeof p->hider);
        assert_memory_equal(p->end, q->end, sizeof p->end);
        assert_true(p->polygon == q->polygon && p->other == q->other && p->edge == q->edge);
    }
    free(without);
    free(with);
}

static void what_is_visible_stays(void **state) {
    const dp_camera cameras[] = {scene_flat_camera(), scene_camera(120, 90, 160, 0, 0, 0)};
    const dp_style styles[] = {{.ridge_angle = 170}, {.edge_table_off = true}};
    (void)state;
    for (int i = 0; i < 4; i++) {
        make_boxes();
        expect_same_visible(&cameras[i % 2], &styles[i / 2]);
        make_two_boxes();
        expect_same_visible(&cameras[i % 2], &styles[i / 2]);
        for (uint32_t seed = 1; seed < 12; seed++) {
            make_triangles(seed, 60, 1);
            expect_same_visible(&cameras[i % 2], &styles[i / 2]);
        }
    }
}

/* Hidden lines in the paper's colour leave no trace: they lie below, and hide nothing. */
static void ink_of_visible_lines_stays(void **state) {
    static picture before;
    dp_style style = solid;
    (void)state;
    for (int level = 0; level < DP_LEVELS; level++)
        for (int i = 0; i < DP_LINE_COUNT; i++)
            style.hidden.line[level][i].color = DP_RGB(255, 255, 255);
    for (int stylized = 0; stylized < 2; stylized++) {
        dp_style plain = {.stroke = {.taper = stylized ? 10.0f : 0, .depth = stylized ? 0.5f : 0}};
        draw_boxes(&plain);
        before = shown;
        plain.hidden = style.hidden;
        draw_boxes(&plain);
        assert_memory_equal(before.rgba, shown.rgba, sizeof shown.rgba);
    }
}

/* ------- the same for all ------- */

enum { SIDE = 240 };
typedef struct result {
    uint8_t rgba[4 * SIDE * SIDE];
    dp_segment *segments;
    size_t count;
} result;

static void draw_shape(const char *name, uint32_t threads, const dp_style *style, result *out) {
    const dp_shape shape = {.name = name, .triangles = 6000};
    const dp_context_desc desc = {.threads = threads};
    const dp_target target = {.width = SIDE, .height = SIDE, .rgba = out->rgba};
    dp_source *source;
    dp_context *own;
    dp_extent extent;
    dp_camera camera;
    dp_fit fit = {.aspect = 1};
    assert_int_equal(dp_source_from_shape(&shape, &source, NULL), DP_OK);
    assert_int_equal(dp_source_extent(source, &extent, NULL), DP_OK);
    memcpy(fit.min, extent.min, sizeof fit.min);
    memcpy(fit.max, extent.max, sizeof fit.max);
    assert_int_equal(dp_camera_fit(&camera, &fit), DP_OK);
    assert_int_equal(dp_context_create(&desc, &own, NULL), DP_OK);
    memset(out->rgba, 0, sizeof out->rgba);
    assert_int_equal(dp_draw(own, source, &camera, style, &target, NULL), DP_OK);
    const dp_segment *const s = dp_segments(own, &out->count);
    out->segments = malloc((out->count + 1) * sizeof *s);
    assert_non_null(out->segments);
    if (out->count) memcpy(out->segments, s, out->count * sizeof *s);
    dp_context_destroy(own);
    dp_source_destroy(source);
}

static void expect_same(const result *a, const result *b) {
    assert_int_equal(a->count, b->count);
    assert_memory_equal(a->rgba, b->rgba, sizeof a->rgba);
    for (size_t i = 0; i < a->count; i++) {
        const dp_segment *const p = &a->segments[i], *const q = &b->segments[i];
        assert_memory_equal(p->a, q->a, sizeof p->a);
        assert_memory_equal(p->b, q->b, sizeof p->b);
        assert_true(p->line == q->line && p->level == q->level && p->chain == q->chain &&
                    p->place == q->place && p->reversed == q->reversed);
    }
}

static const char *const shapes[] = {"gear", "boxes", "stairs", "bolt"};
enum { SHAPES = sizeof shapes / sizeof *shapes };
static const dp_style dashed = {.hidden = {.look = DP_HIDDEN_DASHED, .levels = 3}};

static void threads_make_no_difference(void **state) {
    static const uint32_t threads[] = {1, 2, 7};
    static result results[2];
    (void)state;
    for (int i = 0; i < SHAPES; i++)
        for (int k = 0; k < 3; k++) {
            draw_shape(shapes[i], threads[k], &dashed, &results[k > 0]);
            if (k) {
                expect_same(&results[0], &results[1]);
                free(results[1].segments);
            }
            if (k == 2) free(results[0].segments);
        }
}

static void vector_widths_make_no_difference(void **state) {
    static result results[2];
    dp_width list[DP_WIDTHS_MOST];
    const uint32_t count = dp_widths_list(list);
    (void)state;
    for (int i = 0; i < SHAPES; i++) {
        for (uint32_t k = 0; k < count; k++) {
            assert_int_equal(setenv("DRYPOINT_CPU", list[k].name, 1), 0);
            draw_shape(shapes[i], 2, &dashed, &results[k > 0]);
            if (!k) continue;
            expect_same(&results[0], &results[1]);
            free(results[1].segments);
        }
        free(results[0].segments);
    }
    unsetenv("DRYPOINT_CPU");
}

/* ------- memory ------- */

/* Counts calls that get memory; the one number `fail_at` gets none. */
typedef struct meter {
    long calls, fail_at, alive;
} meter;

static bool fails(meter *m) { return ++m->calls == m->fail_at; }
static void *meter_alloc(size_t size, void *user) {
    void *const block = fails(user) ? NULL : malloc(size);
    ((meter *)user)->alive += block != NULL;
    return block;
}
static void *meter_realloc(void *old, size_t size, void *user) {
    void *const block = fails(user) ? NULL : realloc(old, size);
    ((meter *)user)->alive += block && !old;
    return block;
}
static void meter_free(void *block, void *user) {
    ((meter *)user)->alive -= block != NULL;
    free(block);
}

static dp_result draw_metered(dp_context *own) {
    const dp_camera camera = scene_camera(60, 50, 400, 0, 0, 0);
    dp_diag diag = {0};
    const dp_style style = {.hidden = {.look = DP_HIDDEN_DASHED, .levels = 3},
                            .stroke = {.taper = 4}};
    make_two_boxes();
    return scene_draw(own, &made, &camera, &style, &shown, &diag);
}

/* One worker, so that calls come in one order; statistics know every byte. */
static void every_allocation_may_fail(void **state) {
    (void)state;
    for (long at = 1;; at++) {
        meter m = {.fail_at = at};
        const dp_allocator allocator = {meter_alloc, meter_realloc, meter_free, &m};
        const dp_context_desc desc = {.allocator = &allocator, .threads = 1};
        dp_context *own = NULL;
        const bool there = dp_context_create(&desc, &own, NULL) == DP_OK;
        if (there) {
            const dp_result first = draw_metered(own);
            if (first) {
                assert_int_equal(first, DP_ERR_MEMORY);
                assert_int_equal(draw_metered(own), DP_OK);
            }
            const long before = m.calls;
            assert_int_equal(draw_metered(own), DP_OK);
            assert_int_equal(m.calls, before); /* later frames allocate nothing */
        }
        dp_context_destroy(own);
        assert_int_equal(m.alive, 0);
        if (m.calls < at) break;
        assert_true(at < 10000);
    }
}

/* ------- ink ------- */

/* One wall behind a larger one: its borders are hidden, from -40 to 40 and from -20 to 20. */
static void draw_hidden_wall(dp_hidden_look look, float width) {
    dp_style style = {.lines = DP_BORDER, .hidden = {.look = look}};
    style.hidden.line[0][DP_LINE_BORDER].width = width;
    const dp_camera camera = scene_flat_camera();
    begin_scene();
    scene_wall(&made, -40, -50, 40, -50, 20);
    scene_wall(&made, -80, 0, 80, 0, 50);
    draw(&camera, &style);
}

static void looks_have_their_share_of_ink(void **state) {
    (void)state;
    draw_hidden_wall(DP_HIDDEN_SOLID, 2);
    const double whole = scene_ink(&shown, -38, 18, 38, 22);
    assert_true(fabs(whole - 2 * 76) < 2);
    draw_hidden_wall(DP_HIDDEN_THIN, 0);
    assert_true(fabs(scene_ink(&shown, -38, 18, 38, 22) - 76) < 2);
    draw_hidden_wall(DP_HIDDEN_DASHED, 1);
    const double dashes = scene_ink(&shown, -38, 18, 38, 22);
    assert_true(dashes > 0.72 * 76 && dashes < 0.88 * 76); /* 12 of 15 */
    draw_hidden_wall(DP_HIDDEN_DOTTED, 2);
    const double dots = scene_ink(&shown, -38, 18, 38, 22);
    assert_true(dots > 0.2 * whole && dots < 0.33 * whole); /* pi / 4 of 3 */
    draw_hidden_wall(DP_HIDDEN_NONE, 2);
    assert_true(scene_ink(&shown, -38, 18, 38, 22) == 0);
}

/* A second wall whose upper border lies exactly behind a part of the first one's. */
static void dashes_do_not_fill_each_others_gaps(void **state) {
    (void)state;
    draw_hidden_wall(DP_HIDDEN_DASHED, 1);
    const double alone = scene_ink(&shown, -38, 18, 38, 22);
    const dp_style style = {.lines = DP_BORDER, .hidden = {.look = DP_HIDDEN_DASHED}};
    const dp_camera camera = scene_flat_camera();
    begin_scene();
    scene_wall(&made, -40, -50, 40, -50, 20);
    scene_wall(&made, -33, -60, 29, -60, 20);
    scene_wall(&made, -80, 0, 80, 0, 50);
    draw(&camera, &style);
    assert_true(fabs(scene_ink(&shown, -38, 18, 38, 22) - alone) < 3);
}

/* Lines meet at the corner of two dashes. */
static void corners_are_closed(void **state) {
    static const float widths[] = {1, 2, 1.5f};
    (void)state;
    for (int i = 0; i < 3; i++) {
        draw_hidden_wall(DP_HIDDEN_DASHED, widths[i]);
        for (int corner = 0; corner < 4; corner++) {
            const double x = corner & 1 ? 37 : -40, y = corner & 2 ? 17 : -20;
            /* 3 px of each of the two lines */
            assert_true(scene_ink(&shown, x, y, x + 3, y + 3) > 2.4 * (double)widths[i]);
        }
    }
}

static void patterns_allow_for_round_ends(void **state) {
    float dash[2] = {7, 7};
    (void)state;
    assert_false(dp_hidden_dash(DP_HIDDEN_SOLID, 2, dash));
    assert_false(dp_hidden_dash(DP_HIDDEN_THIN, 2, dash));
    assert_true(dash[0] == 7 && dash[1] == 7);
    assert_true(dp_hidden_dash(DP_HIDDEN_DASHED, 2, dash));
    assert_true(dash[0] == 24 - 2 && dash[1] == 6 + 2);
    assert_true(dp_hidden_dash(DP_HIDDEN_DOTTED, 2, dash));
    assert_true(dash[0] == 0 && dash[1] == 6);
}

/* ------- where they go ------- */

typedef struct order {
    uint32_t level, strokes, layers;
    dp_line layer;
} order;

static dp_result see_layer(void *user, dp_line line, dp_diag *diag) {
    order *const o = user;
    (void)diag;
    o->layer = line, o->layers++;
    return DP_OK;
}

static dp_result see_stroke(void *user, const dp_chain_stroke *stroke, dp_diag *diag) {
    order *const o = user;
    (void)diag;
    assert_true(stroke->level <= o->level);
    o->level = stroke->level, o->strokes++;
    assert_int_equal(stroke->line, o->layer);
    for (size_t i = 0; i < stroke->count; i++) {
        assert_int_equal(stroke->segments[i]->level, stroke->level);
        assert_int_equal(stroke->segments[i]->line, stroke->line);
    }
    return DP_OK;
}

static void sinks_get_the_deepest_first(void **state) {
    const dp_camera camera = scene_camera(60, 50, 400, 0, 0, 0);
    order seen = {.level = DP_LEVELS, .layer = DP_LINE_COUNT};
    (void)state;
    make_two_boxes();
    draw(&camera, &solid);
    const dp_sink sink = {.user = &seen, .layer = see_layer, .stroke = see_stroke};
    assert_int_equal(dp_send(context, &sink, NULL), DP_OK);
    assert_int_equal(seen.level, 0);
    assert_int_equal(seen.layers, 1 + 2 + 2); /* ridges of level 2; both classes of 1 and of 0 */
}

static void levels_have_their_own_look(void **state) {
    const dp_camera camera = scene_camera(60, 50, 400, 0, 0, 0);
    dp_style style = solid;
    size_t count;
    (void)state;
    style.hidden.line[0][DP_LINE_RIDGE] = (dp_line_style){3, DP_RGB(1, 2, 3)};
    style.hidden.line[1][DP_LINE_RIDGE] = (dp_line_style){5, DP_RGB(4, 5, 6)};
    make_two_boxes();
    draw(&camera, &style);
    const dp_segment *const s = dp_segments(context, &count);
    for (size_t i = 0; i < count; i++) {
        if (s[i].line != DP_LINE_RIDGE) continue;
        assert_true(s[i].width == (s[i].level ? 1 + 2 * (float)s[i].level : 2));
        assert_int_equal(s[i].color, s[i].level == 1   ? DP_RGB(1, 2, 3)
                                     : s[i].level == 2 ? DP_RGB(4, 5, 6)
                                                       : DP_RGB(0, 0, 0));
    }
}

static void only_strokes_that_emerge_may_be_hidden(void **state) {
    dp_style style = solid, resolved;
    dp_diag diag = {0};
    (void)state;
    assert_int_equal(dp_style_resolve(&style, &resolved, &diag), DP_OK);
    style.ink = DP_INK_QUADS;
    assert_int_equal(dp_style_resolve(&style, &resolved, &diag), DP_ERR_ARGUMENT);
    assert_non_null(strstr(diag.message, "hidden lines"));
    style = solid, style.edges = DP_EDGES_ADJACENCY;
    assert_int_equal(dp_style_resolve(&style, &resolved, &diag), DP_ERR_ARGUMENT);
    assert_non_null(strstr(diag.message, "hidden lines"));
    style.hidden.look = DP_HIDDEN_NONE;
    assert_int_equal(dp_style_resolve(&style, &resolved, &diag), DP_OK);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_box_hides_three_ridges),
        cmocka_unit_test(no_hidden_lines_unless_wanted),
        cmocka_unit_test(boxes_behind_each_other_have_two_levels),
        cmocka_unit_test(levels_are_saturated),
        cmocka_unit_test(an_open_sheet_from_behind_hides_once),
        cmocka_unit_test(folds_of_backs_are_classed_by_the_object),
        cmocka_unit_test(smooth_folds_are_left_out),
        cmocka_unit_test(crossings_are_hidden_too),
        cmocka_unit_test(what_is_visible_stays),
        cmocka_unit_test(ink_of_visible_lines_stays),
        cmocka_unit_test(threads_make_no_difference),
        cmocka_unit_test(vector_widths_make_no_difference),
        cmocka_unit_test(every_allocation_may_fail),
        cmocka_unit_test(looks_have_their_share_of_ink),
        cmocka_unit_test(dashes_do_not_fill_each_others_gaps),
        cmocka_unit_test(corners_are_closed),
        cmocka_unit_test(patterns_allow_for_round_ends),
        cmocka_unit_test(sinks_get_the_deepest_first),
        cmocka_unit_test(levels_have_their_own_look),
        cmocka_unit_test(only_strokes_that_emerge_may_be_hidden),
    };
    return cmocka_run_group_tests(tests, make_context, destroy_context);
}
