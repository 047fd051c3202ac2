/* Ends of lines that are solved (dp_style.exact_ends), in hand-made scenes: one unit of the world is one
 * pixel, and (0, 0) is the picture's middle. */
#include "base/hostile.h"
#include "base/kernels.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "scene.h"

enum { LINE_EDGE = 2 }; /* of the first polygon: the line that others hide */

static scene made;
static picture shown;
static const dp_style exact = {.exact_ends = true};

/* What float32 positions and the segments' float32 coordinates leave open. px */
static const double rounding = 5e-5;

static dp_context *new_context(uint32_t threads) {
    const dp_context_desc desc = {.threads = threads};
    dp_context *context = NULL;
    assert_int_equal(dp_context_create(&desc, &context, NULL), DP_OK);
    return context;
}

/* ------- scenes ------- */

/* A sheet at z = 0 below a line from (80, right) to (-80, left), which is its border. */
static void begin_with_line(double left, double right) {
    made.corners = made.polygons = 0;
    scene_polygon(&made, 4,
                  (const float[][3]){
                      {-80, -40, 0}, {80, -40, 0}, {80, (float)right, 0}, {-80, (float)left, 0}});
}

static void add_triangle(const double corners[3][3]) {
    float at[3][3];
    for (int i = 0; i < 9; i++) at[i / 3][i % 3] = (float)corners[i / 3][i % 3];
    scene_polygon(&made, 3, (const float(*)[3])at);
}

/* A roof below a ridge at z = 0, from (80, y) to (-80, y). Where y has few decimals, all coordinates
 * count as rounded to them (core/precision.c). */
static void begin_with_ridge(double y) {
    const float at = (float)y;
    made.corners = made.polygons = 0;
    scene_polygon(
        &made, 4,
        (const float[][3]){{-80, -40, -40 - at}, {80, -40, -40 - at}, {80, at, 0}, {-80, at, 0}});
    scene_polygon(
        &made, 4,
        (const float[][3]){{-80, at, 0}, {80, at, 0}, {80, 40, at - 40}, {-80, 40, at - 40}});
}

/* A sheet that covers x0 to x1, at depths z0 and z1 there. */
static void add_sheet(double x0, double z0, double x1, double z1) {
    const float a = (float)x0, b = (float)x1, za = (float)z0, zb = (float)z1;
    scene_polygon(&made, 4,
                  (const float[][3]){{a, -30, za}, {b, -30, zb}, {b, 30, zb}, {a, 30, za}});
}

/* ------- what is drawn ------- */

/* An end of the line: its place, px to the right of the middle, and what hides it from there on. */
typedef struct found_end {
    double x;
    uint64_t hider;
} found_end;

static int by_x(const void *left, const void *right) {
    const found_end *const a = left, *const b = right;
    return a->x < b->x ? -1 : a->x > b->x;
}

enum { ENDS_MOST = 16 };

/* The hidden ends of the line, from left to right. */
static size_t ends_of_line(dp_context *context, found_end ends[ENDS_MOST]) {
    size_t count, n = 0;
    const dp_segment *const segments = dp_segments(context, &count);
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < 2; k++) {
            const dp_segment *const s = &segments[i];
            if (s->polygon != 0 || s->edge != LINE_EDGE || s->end[k] != DP_END_HIDDEN) continue;
            assert_true(n < ENDS_MOST);
            const float *const p = k ? s->b : s->a;
            ends[n++] = (found_end){(double)p[0] - SCENE_WIDTH / 2.0, s->hider[k]};
        }
    qsort(ends, n, sizeof *ends, by_x);
    return n;
}

/* Draws, and checks that polygon `first` hides the line from `from` on, and `last` until `to`. */
static void expect_hidden(double from, uint64_t first, double to, uint64_t last) {
    const dp_camera camera = scene_flat_camera();
    dp_context *const context = new_context(1);
    found_end ends[ENDS_MOST];
    assert_int_equal(scene_draw(context, &made, &camera, &exact, &shown, NULL), DP_OK);
    const size_t count = ends_of_line(context, ends);
    assert_int_equal(count, 2);
    assert_true(fabs(ends[0].x - from) < rounding);
    assert_true(fabs(ends[1].x - to) < rounding);
    assert_int_equal(ends[0].hider, first);
    assert_int_equal(ends[1].hider, last);
    dp_context_destroy(context);
}

/* ------- tests ------- */

/* Where the edges of a triangle cross the line on the screen, at any angle. */
static void an_edge_in_front(void **state) {
    (void)state;
    for (int i = 0; i < 40; i++) {
        const double foot = -50 + i * 0.37, slope = 0.5 + 0.1 * i, line = 3.1;
        begin_with_line(line, line);
        /* its left edge leads from (foot, -20) up to the right, its right edge straight up */
        const double top = -20 + slope * (40 - foot);
        add_triangle((const double[3][3]){{foot, -20, 9}, {40, -20, 9}, {40, top, 9}});
        expect_hidden(foot + (line + 20) / slope, 1, 40, 1);
    }
}

/* Where a slanted sheet comes nearer than the line, which is lifted by a tenth of a pixel; what
 * hides it must be nearer by a twentieth. */
static void a_depth_crossing(void **state) {
    (void)state;
    for (int i = 0; i < 20; i++) {
        const double at = -10 + i * 0.31, slope = 0.1 + 0.1 * i;
        begin_with_ridge(5.0123457);
        add_sheet(at - 20, -20 * slope, at + 30, 30 * slope);
        expect_hidden(at + 0.15 / slope, 2, at + 30, 2);
    }
}

/* Tiles are 64 px wide, so one of them ends at x = 28; its last sample point and the next one are
 * different tiles'. The line is steep enough that its sample points lie anywhere. */
static void an_end_at_a_tile_border(void **state) {
    (void)state;
    for (int i = -20; i <= 20; i++) {
        const double at = DP_TUNED(28, 12) + i * 0.0125;
        begin_with_line(3, 9.7);
        add_sheet(at, 7, 60, 7);
        expect_hidden(at, 1, 60, 1);
        begin_with_line(3, 9.7);
        add_sheet(-60, 7, at, 7);
        expect_hidden(-60, 1, at, 1);
    }
}

/* Sheets side by side, the first of them narrower than the sample points are apart: what they hide is
 * one stretch. */
static void two_neighbours(void **state) {
    (void)state;
    for (int i = 0; i < 30; i++) {
        const double from = 10 + i * 0.027, seam = from + 0.1 + i * 0.005;
        begin_with_line(3, 3);
        add_sheet(from, 7, seam, 7);
        add_sheet(seam, 7, 40, 8);
        add_sheet(40, 8, 40.05, 8);
        expect_hidden(from, 1, 40.05, 3);
    }
}

/* A gap between two sheets that no sample point lies in stays hidden; the ends are those of the
 * whole. A gap that is seen ends where the sheets do. */
static void a_gap(void **state) {
    const dp_camera camera = scene_flat_camera();
    dp_context *const context = new_context(1);
    found_end ends[ENDS_MOST];
    (void)state;
    begin_with_line(3, 3);
    add_sheet(-20, 7, 4.5, 7);
    add_sheet(5.03, 7, 30, 7);
    assert_int_equal(scene_draw(context, &made, &camera, &exact, &shown, NULL), DP_OK);
    assert_int_equal(ends_of_line(context, ends), 4);
    assert_true(fabs(ends[1].x - 4.5) < rounding && fabs(ends[2].x - 5.03) < rounding);
    assert_int_equal(ends[1].hider, 1);
    assert_int_equal(ends[2].hider, 2);
    dp_context_destroy(context);
}

/* Triangles around a point of the line: all of them begin to hide it there. */
static void amid_a_fan(void **state) {
    enum { PARTS = 7 };
    const double pi = 3.14159265358979323846;
    (void)state;
    for (int i = 0; i < 10; i++) {
        const double x = -12.3 + i * 0.083;
        const dp_camera camera = scene_flat_camera();
        dp_context *const context = new_context(1);
        found_end ends[ENDS_MOST];
        begin_with_line(3, 3);
        for (int k = 0; k < PARTS; k++) {
            const double a = pi * (k - PARTS / 2.0) / PARTS, b = pi * (k + 1 - PARTS / 2.0) / PARTS;
            add_triangle((const double[3][3]){{x, 3, 6},
                                              {x + 25 * cos(a), 3 + 25 * sin(a), 6},
                                              {x + 25 * cos(b), 3 + 25 * sin(b), 6}});
        }
        assert_int_equal(scene_draw(context, &made, &camera, &exact, &shown, NULL), DP_OK);
        assert_int_equal(ends_of_line(context, ends), 2);
        assert_true(fabs(ends[0].x - x) < 2 * rounding);
        assert_in_range(ends[0].hider, 1, PARTS);
        assert_int_equal(ends[1].hider, 1 + PARTS / 2);
        dp_context_destroy(context);
    }
}

/* A line that tiles part and nothing hides is one segment, without hidden ends. */
static void tile_borders_end_nothing(void **state) {
    const dp_camera camera = scene_flat_camera();
    dp_context *const context = new_context(1);
    found_end ends[ENDS_MOST];
    size_t count, along = 0;
    (void)state;
    begin_with_line(-11, 17);
    assert_int_equal(scene_draw(context, &made, &camera, &exact, &shown, NULL), DP_OK);
    assert_int_equal(ends_of_line(context, ends), 0);
    const dp_segment *const s = dp_segments(context, &count);
    for (size_t i = 0; i < count; i++) along += s[i].edge == LINE_EDGE;
    assert_int_equal(along, 1);
    dp_context_destroy(context);
}

/* Without exact ends they lie midway between sample points, up to an eighth of a pixel off. */
static void sampled_where_not_asked_for(void **state) {
    const dp_camera camera = scene_flat_camera();
    dp_context *const context = new_context(1);
    double worst = 0;
    (void)state;
    for (int i = 0; i < 20; i++) {
        found_end ends[ENDS_MOST];
        const double at = 10 + i * 0.0125;
        begin_with_line(3, 3);
        add_sheet(at, 7, 60, 7);
        assert_int_equal(scene_draw(context, &made, &camera, NULL, &shown, NULL), DP_OK);
        assert_int_equal(ends_of_line(context, ends), 2);
        worst = fmax(worst, fabs(ends[0].x - at));
    }
    assert_true(worst > 0.1 && worst <= 0.126);
    dp_context_destroy(context);
}

/* ------- any threads, any width ------- */

static double random_number(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return (*state >> 8) / 16777216.0;
}

static void make_triangles(uint32_t seed) {
    made.corners = made.polygons = 0;
    for (int i = 0; i < 150; i++) {
        double at[3][3];
        const double x = (random_number(&seed) - 0.5) * SCENE_WIDTH,
                     y = (random_number(&seed) - 0.5) * SCENE_HEIGHT,
                     z = 160 * (random_number(&seed) - 0.5);
        for (int c = 0; c < 3; c++) {
            at[c][0] = x + 60 * (random_number(&seed) - 0.5);
            at[c][1] = y + 60 * (random_number(&seed) - 0.5);
            at[c][2] = z + 60 * (random_number(&seed) - 0.5);
        }
        add_triangle((const double(*)[3])at);
    }
}

/* Segments as bytes that are all set. */
typedef struct copied {
    dp_segment *list;
    size_t count;
} copied;

static copied draw_and_copy(uint32_t threads, const dp_camera *camera) {
    dp_context *const context = new_context(threads);
    copied out = {0};
    assert_int_equal(scene_draw(context, &made, camera, &exact, &shown, NULL), DP_OK);
    const dp_segment *const s = dp_segments(context, &out.count);
    out.list = calloc(out.count + 1, sizeof *out.list);
    assert_non_null(out.list);
    memcpy(out.list, s, out.count * sizeof *s);
    dp_context_destroy(context);
    return out;
}

static void expect_same(copied a, copied b) {
    assert_int_equal(a.count, b.count);
    for (size_t i = 0; i < a.count; i++) {
        const dp_segment *const s = &a.list[i], *const t = &b.list[i];
        assert_memory_equal(s->a, t->a, sizeof s->a);
        assert_memory_equal(s->b, t->b, sizeof s->b);
        assert_memory_equal(s->world_a, t->world_a, sizeof s->world_a);
        assert_memory_equal(s->world_b, t->world_b, sizeof s->world_b);
        assert_memory_equal(s->hider, t->hider, sizeof s->hider);
        assert_memory_equal(s->end, t->end, sizeof s->end);
        assert_true(s->line == t->line && s->polygon == t->polygon && s->other == t->other &&
                    s->edge == t->edge);
    }
}

static void the_same_everywhere(void **state) {
    static const uint32_t threads[] = {1, 2, 7};
    const dp_camera cameras[] = {scene_flat_camera(), scene_camera(30, 20, 220, 0, 0, 0)};
    dp_width widths[DP_WIDTHS_MOST];
    const uint32_t count = dp_widths_list(widths);
    size_t hidden = 0;
    (void)state;
    for (uint32_t round = 0; round < 8; round++) {
        make_triangles(round + 1);
        copied first = {0};
        for (uint32_t k = 0; k < 3 * count; k++) {
            assert_int_equal(setenv("DRYPOINT_CPU", widths[k / 3].name, 1), 0);
            const copied here = draw_and_copy(threads[k % 3], &cameras[round % 2]);
            if (k == 0) {
                first = here;
                continue;
            }
            expect_same(first, here);
            free(here.list);
        }
        for (size_t i = 0; i < 2 * first.count; i++)
            hidden += first.list[i / 2].end[i % 2] == DP_END_HIDDEN;
        free(first.list);
    }
    unsetenv("DRYPOINT_CPU");
    assert_true(hidden > 1000);
}

/* A source without polygons has no vertices to close. */
static void nothing_is_there(void **state) {
    (void)state;
    const float position[3] = {0, 0, 0};
    const dp_batch none = {.positions = position, .stable = true};
    const double eye[3] = {3, 3, 3}, target[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    dp_context *const context = new_context(1);
    dp_source *source = NULL;
    dp_camera camera = {0};
    size_t count = 1;
    assert_int_equal(dp_source_from_arrays(&none, NULL, &source, NULL), DP_OK);
    assert_int_equal(dp_camera_look_at(&camera, eye, target, up), DP_OK);
    assert_int_equal(dp_camera_perspective(&camera, 40, 1, 0.1, 10), DP_OK);
    const dp_target square = {.width = 100, .height = 100};
    assert_int_equal(dp_draw(context, source, &camera, &exact, &square, NULL), DP_OK);
    (void)dp_segments(context, &count);
    assert_int_equal(count, 0);
    dp_source_destroy(source);
    dp_context_destroy(context);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_is_there),
        cmocka_unit_test(an_edge_in_front),
        cmocka_unit_test(a_depth_crossing),
        cmocka_unit_test(an_end_at_a_tile_border),
        cmocka_unit_test(two_neighbours),
        cmocka_unit_test(a_gap),
        cmocka_unit_test(amid_a_fan),
        cmocka_unit_test(tile_borders_end_nothing),
        cmocka_unit_test(sampled_where_not_asked_for),
        cmocka_unit_test(the_same_everywhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
