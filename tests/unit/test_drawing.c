/* Cleaned drawings, of segments made by hand and by chance. Longer than 600 lines, as all phases of
 * cleaning are asked through the same few helpers; each test is short. */
#include "vector/drawing.h"

#include "base/memory.h"
#include <drypoint/drypoint.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* ------- segments by hand ------- */

static dp_segment segments[20000];
static size_t count;

static dp_segment *add(float ax, float ay, float bx, float by) {
    dp_segment *const s = &segments[count];
    *s = (dp_segment){.line = DP_LINE_SILHOUETTE,
                      .a = {ax, ay, 1},
                      .b = {bx, by, 1},
                      .world_a = {(double)ax, (double)ay, 1},
                      .world_b = {(double)bx, (double)by, 1},
                      .polygon = count,
                      .other = UINT64_MAX,
                      .edge = (uint32_t)count % 3,
                      .hider = {UINT64_MAX, UINT64_MAX},
                      .width = 2,
                      .color = DP_RGB(0, 0, 0)};
    count++;
    return s;
}

static dp_drawing *drawing;
static dp_drawing_info info;

static void clean_desc(const dp_drawing_desc *desc) {
    const dp_allocator memory = dp_allocator_resolve(NULL);
    const dp_drawn drawn = {.segments = segments,
                            .count = count,
                            .width = 400,
                            .height = 300,
                            .paper = 0xFFFFFFFF,
                            .hidden_look = DP_HIDDEN_DASHED};
    dp_diag diag = {0};
    dp_drawing_destroy(drawing);
    assert_int_equal(dp_drawing_make(&drawn, desc, &memory, &drawing, &diag), DP_OK);
    dp_drawing_info_of(drawing, &info);
}

static void clean(void) { clean_desc(NULL); }

static dp_path path(size_t i) {
    dp_path p;
    assert_true(dp_drawing_path(drawing, i, &p));
    return p;
}

static int begin(void **state) {
    (void)state;
    count = 0;
    return 0;
}

static int end(void **state) {
    (void)state;
    dp_drawing_destroy(drawing);
    drawing = NULL;
    return 0;
}

static void add_square(float x, float y, float side) {
    add(x, y, x + side, y);
    add(x + side, y + side, x + side, y);
    add(x + side, y + side, x, y + side);
    add(x, y + side, x, y);
}

/* ------- coincidence ------- */

static void a_doubled_side_is_drawn_once(void **state) {
    (void)state;
    add_square(10, 10, 50);
    add(60, 10, 10, 10)->line = DP_LINE_RIDGE;
    clean();
    assert_int_equal(info.paths, 1);
    assert_true(path(0).closed);
    assert_int_equal(path(0).count, 4);
    assert_int_equal(path(0).line, DP_LINE_SILHOUETTE);
    assert_float_equal(info.length, 200, 1e-4);
    assert_float_equal(info.coincident, 50, 1e-4);
    clean_desc(&(dp_drawing_desc){.keep_coincident = true});
    assert_int_equal(info.paths, 2);
    assert_float_equal(info.coincident, 0, 0);
}

static void overlaps_are_cut(void **state) {
    (void)state;
    add(10, 10, 50, 10);
    add(100, 10.01f, 20, 10)->line = DP_LINE_VALLEY;
    clean();
    assert_int_equal(info.paths, 2);
    assert_int_equal(path(0).line, DP_LINE_VALLEY); /* the lower layer */
    assert_float_equal(path(0).length, 50, 1e-3);
    assert_float_equal(path(0).points[1].x, 50, 1e-4);
    assert_float_equal(path(0).points[1].world[0], 50, 1e-4);
    assert_float_equal(path(1).length, 40, 1e-4);
    assert_float_equal(info.coincident, 30, 1e-3);
}

static void one_within_another_leaves_two_pieces(void **state) {
    (void)state;
    add(0, 5, 100, 5)->line = DP_LINE_RIDGE;
    add(60, 5, 40, 5);
    clean();
    assert_int_equal(info.paths, 3);
    assert_float_equal(info.coincident, 20, 1e-4);
    assert_float_equal(info.length, 100, 1e-4);
}

static void lines_that_share_an_end_or_cross_are_kept(void **state) {
    (void)state;
    add(10, 10, 50, 10);
    add(50, 10, 90, 10);
    add(50, 10, 50, 40);
    add(30, 0, 31, 20);
    add(10, 10.05f, 50, 10.05f); /* beside it, but further than the tolerance */
    clean_desc(&(dp_drawing_desc){.join = -1});
    assert_float_equal(info.coincident, 0, 0);
    assert_float_equal(info.length, 80 + 30 + sqrt(401) + 40, 1e-3);
}

static void visible_lines_hide_hidden_ones_below(void **state) {
    (void)state;
    dp_segment *const deep = add(0, 0, 40, 30), *const hidden = add(0, 0, 40, 30);
    deep->level = 2, hidden->level = 1;
    add(8, 6, 24, 18);
    clean();
    assert_int_equal(info.paths, 3);
    assert_int_equal(info.levels, 1);
    assert_int_equal(path(0).level, 1);
    assert_int_equal(path(2).level, 0);
    assert_float_equal(path(0).length + path(1).length, 30, 1e-3);
    assert_float_equal(info.coincident, 50 + 20, 1e-3);
    assert_float_equal(path(0).dash[0], 22, 0);
    assert_float_equal(path(0).dash[1], 8, 0);
    assert_float_equal(path(2).dash[0], 0, 0);
}

/* In perspective the middle of a line on the screen is not its middle in space. */
static void cut_ends_lie_where_they_do_in_space(void **state) {
    (void)state;
    dp_segment *const s = add(0, 0, 100, 0);
    s->line = DP_LINE_RIDGE, s->a[2] = 1, s->b[2] = 3;
    memcpy(s->world_b, (double[3]){300, 0, 3}, sizeof s->world_b);
    add(50, 0, 100, 0);
    const dp_drawn drawn = {
        .segments = segments, .count = count, .perspective = true, .focal = 100};
    const dp_allocator memory = dp_allocator_resolve(NULL);
    dp_drawing_destroy(drawing);
    assert_int_equal(dp_drawing_make(&drawn, NULL, &memory, &drawing, NULL), DP_OK);
    /* 1 / distance is 2/3 there: distance 1.5, a quarter of the way */
    const dp_path_point *const p = &path(0).points[1];
    assert_float_equal(p->x, 50, 1e-4);
    assert_float_equal(p->distance, 1.5, 1e-5);
    assert_float_equal(p->world[0], 75, 1e-4);
    assert_float_equal(p->world[2], 1.5, 1e-5);
}

/* ------- chains and gaps ------- */

static void gaps_up_to_the_limit_are_joined(void **state) {
    (void)state;
    add(10, 10, 50, 10);
    add(51.9f, 10, 90, 10);
    add(92.1f, 10, 120, 10);
    clean();
    assert_int_equal(info.paths, 2);
    assert_int_equal(info.joined, 1);
    assert_float_equal(info.joined_length, 1.9, 1e-3);
    assert_float_equal(path(0).length, 80, 1e-3);
    clean_desc(&(dp_drawing_desc){.join = 2.5f});
    assert_int_equal(info.paths, 1);
    clean_desc(&(dp_drawing_desc){.join = -1});
    assert_int_equal(info.paths, 3);
    assert_int_equal(info.joined, 0);
}

static void a_gap_is_told_from_a_line(void **state) {
    (void)state;
    add(10, 10, 50, 10);
    add(51, 10.5f, 90, 12);
    clean();
    assert_int_equal(info.paths, 1);
    assert_int_equal(path(0).count, 4);
    assert_int_equal(path(0).points[0].polygon, 0);
    assert_true(path(0).points[1].polygon == UINT64_MAX);
    assert_int_equal(path(0).points[2].polygon, 1);
    assert_true(path(0).points[3].polygon == UINT64_MAX);
}

static void hooks_and_steps_sideways_are_not_drawn(void **state) {
    (void)state;
    add(10, 10, 50, 10), add(49, 11.5f, 90, 11.5f); /* would go back */
    add(10, 50, 50, 50), add(10, 51.5f, 50, 51.5f); /* side by side, ends as well */
    clean();
    assert_int_equal(info.joined, 0);
    assert_int_equal(info.paths, 4);
}

static void a_line_that_passes_takes_no_end(void **state) {
    (void)state;
    add(10, 10, 90, 10);
    add(50, 11, 50, 60);
    clean();
    assert_int_equal(info.paths, 2);
    assert_int_equal(info.joined, 0);
}

/* Where a line passes in two pieces and a third ends there, the pieces belong together. */
static void what_goes_straight_on_is_joined_first(void **state) {
    (void)state;
    add(10, 10, 49.5f, 10), add(50.5f, 10, 90, 10);
    add(50, 10.5f, 50, 60);
    clean();
    assert_int_equal(info.paths, 2);
    assert_int_equal(info.joined, 1);
    assert_float_equal(path(0).length, 80, 1e-3);
}

static void classes_are_joined_when_asked_for(void **state) {
    (void)state;
    add(10, 10, 40, 10);
    add(40, 10, 90, 10)->line = DP_LINE_RIDGE;
    add(91, 10, 99, 10);
    clean();
    assert_int_equal(info.paths, 3);
    clean_desc(&(dp_drawing_desc){.join_classes = true});
    assert_int_equal(info.paths, 1);
    assert_int_equal(path(0).line, DP_LINE_RIDGE);
    assert_int_equal(path(0).count, 2);
    clean_desc(&(dp_drawing_desc){.join_classes = true, .join = -1});
    assert_int_equal(info.paths, 2);
    segments[1].color = DP_RGB(255, 0, 0); /* another pen */
    clean_desc(&(dp_drawing_desc){.join_classes = true});
    assert_int_equal(info.paths, 3);
}

static void a_step_in_depth_is_joined_only_straight_on(void **state) {
    (void)state;
    const dp_allocator memory = dp_allocator_resolve(NULL);
    add(10, 10, 50, 10);
    dp_segment *const s = add(50.5f, 10.5f, 50.5f, 60);
    dp_drawn drawn = {.segments = segments, .count = count, .perspective = true, .focal = 100};
    dp_drawing_destroy(drawing);
    assert_int_equal(dp_drawing_make(&drawn, NULL, &memory, &drawing, NULL), DP_OK);
    dp_drawing_info_of(drawing, &info);
    assert_int_equal(info.paths, 1);
    s->a[2] = s->b[2] = 2;
    dp_drawing_destroy(drawing);
    assert_int_equal(dp_drawing_make(&drawn, NULL, &memory, &drawing, NULL), DP_OK);
    dp_drawing_info_of(drawing, &info);
    assert_int_equal(info.paths, 2);
    s->b[0] = 90, s->b[1] = 12;
    dp_drawing_destroy(drawing);
    assert_int_equal(dp_drawing_make(&drawn, NULL, &memory, &drawing, NULL), DP_OK);
    dp_drawing_info_of(drawing, &info);
    assert_int_equal(info.paths, 1);
}

static void rings_are_closed_over_gaps_too(void **state) {
    (void)state;
    for (int i = 0; i < 39; i++) {
        const double t = i * 2 * 3.14159265358979 / 40, u = (i + 1) * 2 * 3.14159265358979 / 40;
        add((float)(100 + 10 * cos(t)), (float)(100 + 10 * sin(t)), (float)(100 + 10 * cos(u)),
            (float)(100 + 10 * sin(u)));
    }
    clean();
    assert_int_equal(info.paths, 1);
    assert_true(path(0).closed);
    assert_int_equal(path(0).count, 40);
    assert_int_equal(info.joined, 1);
}

/* A node of many ends is sorted, not compared each with each. */
static void many_lines_meet_in_one_point(void **state) {
    (void)state;
    for (int i = 0; i < 20000; i++) {
        const double t = i * 2 * 3.14159265358979 / 20000;
        add(200, 150, (float)(200 + 3 * cos(t)), (float)(150 + 3 * sin(t)));
    }
    clean_desc(&(dp_drawing_desc){.keep_coincident = true, .join = -1});
    assert_int_equal(info.paths, 10000);
    clean();
    assert_true(info.paths > 10);
}

/* ------- short paths and points ------- */

static void short_paths_are_dropped_after_joining(void **state) {
    (void)state;
    add(10, 10, 10.9f, 10);
    add(100, 10, 101.1f, 10);
    add(200, 10, 200.6f, 10), add(201, 10, 201.6f, 10);
    clean();
    assert_int_equal(info.paths, 2);
    assert_int_equal(info.dropped, 1);
    assert_float_equal(info.dropped_length, 0.9, 1e-4);
    clean_desc(&(dp_drawing_desc){.min_length = -1});
    assert_int_equal(info.paths, 3);
}

static void points_on_a_straight_line_are_left_out(void **state) {
    (void)state;
    add(10, 10, 20, 10), add(30, 10.01f, 20, 10), add(30, 10.01f, 50, 10);
    add(50, 10, 50, 40);
    add(50, 40, 80, 40.5f), add(80, 40.5f, 110, 40);
    clean();
    assert_int_equal(info.paths, 1);
    assert_int_equal(path(0).count, 5);
    assert_float_equal(path(0).points[1].x, 50, 0);
    assert_float_equal(path(0).points[1].y, 10, 0);
    assert_int_equal(path(0).points[1].polygon, 3); /* of the line that leads on */
    assert_int_equal(path(0).points[1].edge, 0);
    clean_desc(&(dp_drawing_desc){.tolerance = -1});
    assert_int_equal(path(0).count, 7);
    clean_desc(&(dp_drawing_desc){.tolerance = 1});
    assert_int_equal(path(0).count, 4);
}

/* A path that goes to 50, back to 40 beside itself, and on; a spur at its start and at its end. */
static void folds_are_taken_out(void **state) {
    (void)state;
    add(14, 10.05f, 10, 10);
    add(10, 10, 50, 10);
    add(50, 10, 40, 10.06f);
    add(40, 10.06f, 90, 10);
    add(90, 10, 88, 10.04f);
    clean();
    assert_int_equal(info.paths, 1);
    assert_int_equal(path(0).count, 2);
    assert_float_equal(path(0).points[0].x, 10, 0);
    assert_float_equal(path(0).points[1].x, 90, 0);
    assert_true(path(0).points[1].polygon == UINT64_MAX);
    assert_float_equal(info.coincident, 4 + 20 + 2, 0.01);
    clean_desc(&(dp_drawing_desc){.keep_coincident = true});
    assert_float_equal(info.length, 80 + 26, 0.01);
    count = 0; /* what leads away is a corner */
    add(14, 10.5f, 10, 10);
    add(10, 10, 50, 10);
    add(50, 10, 40, 10.5f);
    add(40, 10.5f, 90, 10);
    clean();
    assert_float_equal(info.coincident, 0, 0);
    assert_int_equal(path(0).count, 5);
}

static void a_ring_begins_at_a_corner(void **state) {
    (void)state;
    add(30, 10, 60, 10), add(60, 10, 60, 40), add(60, 40, 10, 40), add(10, 40, 10, 10);
    add(10, 10, 30, 10);
    clean();
    assert_int_equal(info.paths, 1);
    assert_true(path(0).closed);
    assert_int_equal(path(0).count, 4);
    assert_float_equal(path(0).length, 160, 1e-4);
}

/* ------- order ------- */

static void layers_lie_from_the_bottom_up(void **state) {
    (void)state;
    static const dp_line bottom_up[] = {DP_LINE_HATCHING, DP_LINE_VALLEY, DP_LINE_INTERSECTION,
                                        DP_LINE_RIDGE,    DP_LINE_BORDER, DP_LINE_SILHOUETTE,
                                        DP_LINE_SECTION};
    for (uint32_t level = 0; level < 3; level++)
        for (int k = 0; k < DP_LINE_COUNT; k++) {
            dp_segment *const s = add(10, 10 * (float)(count + 1), 50, 10 * (float)(count + 1));
            s->line = (dp_line)k, s->level = level;
        }
    for (int optimize = 0; optimize < 2; optimize++) {
        clean_desc(&(dp_drawing_desc){.optimize = optimize});
        assert_int_equal(info.paths, 21);
        assert_int_equal(info.levels, 2);
        for (size_t i = 0; i < 21; i++) {
            assert_int_equal(path(i).level, 2 - i / 7);
            assert_int_equal(path(i).line, bottom_up[i % 7]);
        }
    }
}

static void the_pen_travels_less_when_asked_to(void **state) {
    (void)state;
    uint32_t seed = 1;
    for (int i = 0; i < 2000; i++) {
        seed = seed * 1664525 + 1013904223;
        const float x = (float)(seed >> 8) / 16777216 * 380;
        seed = seed * 1664525 + 1013904223;
        const float y = (float)(seed >> 8) / 16777216 * 280;
        if (i % 3)
            add(x, y, x + 7, y + 3);
        else
            add(x, y, x + 5, y), add(x + 5, y, x, y + 5), add(x, y + 5, x, y);
    }
    const dp_drawing_desc keep = {.join = -1, .keep_coincident = true},
                          optimize = {.join = -1, .keep_coincident = true, .optimize = true};
    clean_desc(&keep);
    const dp_drawing_info plain = info;
    assert_true(plain.travel_before == 0);
    clean_desc(&optimize);
    assert_int_equal(info.paths, plain.paths);
    assert_int_equal(info.points, plain.points);
    assert_float_equal(info.length, plain.length, 1e-6 * plain.length);
    assert_float_equal(info.travel_before, plain.travel, 0);
    assert_true(info.travel < 0.1 * plain.travel);
    for (size_t i = 0; i < info.paths; i++) { /* what a line is goes with it */
        const dp_path p = path(i);
        for (size_t k = 0; k + !p.closed < p.count; k++) {
            const dp_segment *const s = &segments[p.points[k].polygon];
            const dp_path_point *const a = &p.points[k], *const b = &p.points[(k + 1) % p.count];
            assert_true(
                (a->x == s->a[0] && a->y == s->a[1] && b->x == s->b[0] && b->y == s->b[1]) ||
                (a->x == s->b[0] && a->y == s->b[1] && b->x == s->a[0] && b->y == s->a[1]));
        }
    }
}

/* ------- segments by chance ------- */

static double distance_to(const dp_segment *s, double x, double y) {
    const double ux = (double)s->b[0] - (double)s->a[0], uy = (double)s->b[1] - (double)s->a[1];
    const double px = x - (double)s->a[0], py = y - (double)s->a[1];
    const double square = ux * ux + uy * uy;
    const double t = square > 0 ? fmin(1, fmax(0, (px * ux + py * uy) / square)) : 0;
    return sqrt((px - t * ux) * (px - t * ux) + (py - t * uy) * (py - t * uy));
}

/* Do lines run beside each other there? */
static bool is_doubled(size_t own, double x, double y, double ux, double uy) {
    for (size_t i = 0; i < info.paths; i++) {
        const dp_path p = path(i);
        for (size_t k = 0; i != own && k + !p.closed < p.count; k++) {
            const dp_path_point *const a = &p.points[k], *const b = &p.points[(k + 1) % p.count];
            const double vx = (double)b->x - (double)a->x, vy = (double)b->y - (double)a->y;
            const dp_segment s = {.a = {a->x, a->y}, .b = {b->x, b->y}};
            if (fabs(ux * vy - uy * vx) < 1e-3 * sqrt((ux * ux + uy * uy) * (vx * vx + vy * vy)) &&
                distance_to(&s, x, y) < 0.015)
                return true;
        }
    }
    return false;
}

static void nothing_is_lost_or_drawn_twice(void **state) {
    (void)state;
    uint32_t seed = 7;
    for (int round = 0; round < 40; round++) {
        double length = 0;
        count = 0;
        for (int i = 0; i < 120; i++) { /* along few lines, so that many lie on each other */
            float v[4];
            for (int k = 0; k < 4; k++)
                seed = seed * 1664525 + 1013904223, v[k] = (float)(seed >> 20) / 16;
            const float at = 20 * floorf(v[1] / 40), to = v[0] + v[2] / 8;
            dp_segment *const s = i % 3 == 0   ? add(v[0], at, to, at)
                                  : i % 3 == 1 ? add(at, v[0], at, to)
                                               : add(v[0], v[0] + at, to, to + at);
            s->line = (dp_line)(i % DP_LINE_COUNT), s->level = (uint32_t)(v[3] / 100);
            length += (double)dp_hypotf(s->b[0] - s->a[0], s->b[1] - s->a[1]);
        }
        clean_desc(&(dp_drawing_desc){.tolerance = -1, .join = round % 2 ? -1 : 0});
        const double left = length - info.coincident - info.dropped_length + info.joined_length;
        assert_float_equal(info.length, left, 1e-3);
        for (size_t i = 0; i < info.paths; i++) {
            const dp_path p = path(i);
            assert_true(p.length >= 1);
            for (size_t k = 0; k < p.count; k++) {
                double least = INFINITY;
                for (size_t n = 0; n < count; n++)
                    least = fmin(least, distance_to(&segments[n], (double)p.points[k].x,
                                                    (double)p.points[k].y));
                assert_true(least < 1e-3);
                const dp_path_point *const a = &p.points[k], *const b =
                                                                 &p.points[(k + 1) % p.count];
                if ((k + 1 == p.count && !p.closed) || a->polygon == UINT64_MAX) continue;
                const double x = (double)b->x - (double)a->x, y = (double)b->y - (double)a->y;
                for (int n = 1; n < 8; n++)
                    assert_false(
                        is_doubled(i, (double)a->x + x * n / 8, (double)a->y + y * n / 8, x, y));
            }
        }
    }
}

/* ------- memory and arguments ------- */

static long allocations, fail_at, alive;

static void *count_alloc(size_t size, void *user) {
    (void)user;
    void *const block = ++allocations == fail_at ? NULL : malloc(size);
    alive += block != NULL;
    return block;
}

static void *count_realloc(void *block, size_t size, void *user) {
    (void)user;
    void *const moved = ++allocations == fail_at ? NULL : realloc(block, size);
    alive += moved && !block;
    return moved;
}

static void count_free(void *block, void *user) {
    (void)user;
    alive -= block != NULL;
    free(block);
}

static void memory_may_run_out(void **state) {
    (void)state;
    for (int i = 0; i < 300; i++) {
        const float x = (float)(i % 20) * 17, y = (float)(i / 20) * 19;
        add(x, y, x + 12 + (float)(i % 7), y);
        if (i % 4 == 0) add(x + 3, y, x + 6, y)->line = DP_LINE_RIDGE;
        if (i % 5 == 0) add_square(x + 2, y + 2, 5);
    }
    const dp_allocator memory = {count_alloc, count_realloc, count_free, NULL};
    const dp_drawn drawn = {.segments = segments, .count = count, .width = 400, .height = 300};
    for (long at = 1;; at++) {
        dp_drawing *made = NULL;
        dp_diag diag = {0};
        allocations = 0, fail_at = at;
        const dp_result result =
            dp_drawing_make(&drawn, &(dp_drawing_desc){.optimize = true}, &memory, &made, &diag);
        if (result == DP_OK) assert_true(allocations < at);
        if (result != DP_OK) {
            assert_int_equal(result, DP_ERR_MEMORY);
            assert_int_equal(diag.result, DP_ERR_MEMORY);
            assert_null(made);
        }
        dp_drawing_destroy(made);
        assert_int_equal(alive, 0);
        if (result == DP_OK) break;
    }
    assert_true(allocations > 20);
}

static void numbers_must_be_finite(void **state) {
    (void)state;
    const dp_allocator memory = dp_allocator_resolve(NULL);
    const dp_drawn drawn = {.segments = segments, .count = 0};
    const dp_drawing_desc bad[] = {
        {.join = NAN}, {.join = INFINITY}, {.min_length = -INFINITY}, {.tolerance = NAN}};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        dp_drawing *made = NULL;
        dp_diag diag = {0};
        assert_int_equal(dp_drawing_make(&drawn, &bad[i], &memory, &made, &diag), DP_ERR_ARGUMENT);
        assert_null(made);
        assert_true(diag.message[0] != 0);
    }
    clean();
    assert_int_equal(info.paths, 0);
    dp_path p;
    assert_false(dp_drawing_path(drawing, 0, &p));
    add(5, 5, 5, 5), add(7, 7, 7, 7), add(7, 7, 7, 7);
    clean();
    assert_int_equal(info.paths, 0);
}

/* ------- pictures ------- */

static void threads_change_nothing(void **state) {
    (void)state;
    dp_drawing *made[3] = {NULL};
    for (int i = 0; i < 3; i++) {
        dp_context *context = NULL;
        dp_source *source = NULL;
        dp_extent extent;
        dp_camera camera;
        const uint32_t threads[] = {1, 2, 7};
        assert_int_equal(
            dp_context_create(&(dp_context_desc){.threads = threads[i]}, &context, NULL), DP_OK);
        assert_int_equal(dp_source_from_shape(&(dp_shape){.name = "gear"}, &source, NULL), DP_OK);
        assert_int_equal(dp_source_extent(source, &extent, NULL), DP_OK);
        dp_fit fit = {.direction = {0, 0, 1}, .orthographic = true};
        memcpy(fit.min, extent.min, sizeof fit.min), memcpy(fit.max, extent.max, sizeof fit.max);
        assert_int_equal(dp_camera_fit(&camera, &fit), DP_OK);
        assert_int_equal(dp_drawing_create(context, NULL, &made[i], NULL), DP_ERR_ARGUMENT);
        assert_int_equal(dp_draw(context, source, &camera, NULL,
                                 &(dp_target){.width = 640, .height = 480}, NULL),
                         DP_OK);
        assert_int_equal(
            dp_drawing_create(context, &(dp_drawing_desc){.optimize = true}, &made[i], NULL),
            DP_OK);
        dp_source_destroy(source);
        dp_context_destroy(context);
    }
    dp_drawing_info one, other;
    dp_drawing_info_of(made[0], &one);
    assert_true(one.paths > 5);
    assert_true(one.coincident > 0.15 * one.length); /* seen from the front, the back's lines */
    for (int i = 1; i < 3; i++) {
        dp_drawing_info_of(made[i], &other);
        assert_int_equal(one.paths, other.paths);
        for (size_t k = 0; k < one.paths; k++) {
            dp_path p, q;
            assert_true(dp_drawing_path(made[0], k, &p) && dp_drawing_path(made[i], k, &q));
            assert_int_equal(p.count, q.count);
            assert_memory_equal(p.points, q.points, p.count * sizeof *p.points);
        }
    }
    for (int i = 0; i < 3; i++) dp_drawing_destroy(made[i]);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, begin, end)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(a_doubled_side_is_drawn_once),
        TEST(overlaps_are_cut),
        TEST(one_within_another_leaves_two_pieces),
        TEST(lines_that_share_an_end_or_cross_are_kept),
        TEST(visible_lines_hide_hidden_ones_below),
        TEST(cut_ends_lie_where_they_do_in_space),
        TEST(gaps_up_to_the_limit_are_joined),
        TEST(a_gap_is_told_from_a_line),
        TEST(hooks_and_steps_sideways_are_not_drawn),
        TEST(a_line_that_passes_takes_no_end),
        TEST(what_goes_straight_on_is_joined_first),
        TEST(classes_are_joined_when_asked_for),
        TEST(a_step_in_depth_is_joined_only_straight_on),
        TEST(rings_are_closed_over_gaps_too),
        TEST(many_lines_meet_in_one_point),
        TEST(short_paths_are_dropped_after_joining),
        TEST(points_on_a_straight_line_are_left_out),
        TEST(folds_are_taken_out),
        TEST(a_ring_begins_at_a_corner),
        TEST(layers_lie_from_the_bottom_up),
        TEST(the_pen_travels_less_when_asked_to),
        TEST(nothing_is_lost_or_drawn_twice),
        TEST(memory_may_run_out),
        TEST(numbers_must_be_finite),
        TEST(threads_change_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
