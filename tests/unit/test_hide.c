/* find/visibility.c and find/hide.inc: kernels of any width hide the sample points that a test of
 * every point against every polygon hides, except those that rounding may put on either side. */
#include "find/finder.h"
#include "find/kernels.h"
#include "raster/kernels.h"
#include "raster/tile.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "kernel_tests.h"

enum { POLYGONS = 120, CORNERS = 4, SPINES = 60, ROUNDS = 60 };

typedef struct scene {
    dp_frame frame;
    dp_style style;
    dp_finder worker;
    dp_spine spines[SPINES];
} scene;

static float random_float(uint32_t *seed, float least, float most) {
    return least + (most - least) * (float)(next_random(seed) % 100000) / 100000;
}

static uint32_t clamp_px(float v) {
    return v <= 0 ? 0 : v >= DP_TILE - 1 ? DP_TILE - 1 : (uint32_t)v;
}

/* A triangle or a square, small or large, on a plane of its own, of either facing. */
static void put_polygon(dp_finder *w, uint32_t index, uint32_t points, uint32_t *seed) {
    const bool front = next_random(seed) % 4;
    const float x = random_float(seed, -4, DP_TILE + 4), y = random_float(seed, -4, DP_TILE + 4),
                size = next_random(seed) % 3 ? random_float(seed, 0.3f, 4)
                                             : random_float(seed, 4, DP_TILE),
                turn = random_float(seed, 0, 6.28f);
    dp_tile_polygon p = {.id = index,
                         .point = CORNERS * index,
                         .points = points,
                         .nearest = -INFINITY,
                         .d0 = random_float(seed, 0.5f, 1.5f),
                         .dx = random_float(seed, -0.01f, 0.01f),
                         .dy = random_float(seed, -0.01f, 0.01f),
                         .flags = (front ? DP_POLYGON_FRONT : 0) |
                                  (next_random(seed) % 8 ? DP_POLYGON_TOUCHES : 0)};
    float x0 = INFINITY, y0 = INFINITY, x1 = -INFINITY, y1 = -INFINITY;
    for (uint32_t i = 0; i < points; i++) {
        const float angle = turn + (front ? -6.2832f : 6.2832f) * (float)i / (float)points;
        const dp_vertex v = {x + size * cosf(angle), y + size * sinf(angle), 0, 0};
        w->tile.points[p.point + i] = v;
        p.nearest = dp_maxf(p.nearest, p.d0 + p.dx * v.x + p.dy * v.y);
        x0 = dp_minf(x0, v.x), x1 = dp_maxf(x1, v.x), y0 = dp_minf(y0, v.y), y1 = dp_maxf(y1, v.y);
    }
    if (x1 < 0 || y1 < 0 || x0 >= DP_TILE || y0 >= DP_TILE) p.flags = 0;
    p.x0 = (uint8_t)clamp_px(x0), p.x1 = (uint8_t)clamp_px(x1);
    p.y0 = (uint8_t)clamp_px(y0), p.y1 = (uint8_t)clamp_px(y1);
    w->tile.polygons[index] = p;
}

static dp_pointd random_end(uint32_t *seed, dp_pointd from, float length) {
    return (dp_pointd){from.x + random_float(seed, -length, length),
                       from.y + random_float(seed, -length, length),
                       from.d * random_float(seed, 0.98f, 1.02f)};
}

static void begin(scene *s, uint32_t *seed) {
    dp_finder *const w = &s->worker;
    *s = (scene){.style = {.cull_back_faces = next_random(seed) % 2}};
    s->frame = (dp_frame){.view = make_view(false), .styles = &s->style, .style_count = 1};
    w->tile.frame = &s->frame;
    w->tile.memory = dp_allocator_resolve(NULL);
    w->tile.keys_stride = POLYGONS + DP_SEEN_ROOM;
    assert_true(
        DP_TILE_RESERVE(&w->tile, &w->tile, polygons, polygons_cap, (size_t)POLYGONS) &&
        DP_TILE_RESERVE(&w->tile, &w->tile, points, points_cap, (size_t)CORNERS * POLYGONS) &&
        DP_TILE_RESERVE(&w->tile, &w->tile, keys, keys_cap, 3 * (size_t)w->tile.keys_stride));
    memset(w->tile.points, 0, (size_t)CORNERS * POLYGONS * sizeof *w->tile.points);
    memset(w->tile.keys, 0, 3 * (size_t)w->tile.keys_stride * sizeof *w->tile.keys);
    const bool triangles = next_random(seed) % 2;
    for (uint32_t i = 0; i < POLYGONS; i++)
        put_polygon(w, i, triangles || next_random(seed) % 2 ? 3 : 4, seed);
    w->tile.polygon_count = POLYGONS;
    for (uint32_t i = 0; i < SPINES; i++) {
        const dp_pointd a = {random_float(seed, 0, DP_TILE), random_float(seed, 0, DP_TILE),
                             random_float(seed, 0.5f, 1.5f)};
        dp_spine *const spine = &s->spines[i];
        spine->a = spine->probe_a = a;
        spine->b = spine->probe_b = random_end(seed, a, i % 4 ? 2 : DP_TILE);
        assert_true(dp_spine_divide(spine));
    }
}

/* Hides the spines' points; some belong to polygons, and some are hidden before. */
static void hide(scene *s, dp_width kernels) {
    dp_finder *const w = &s->worker;
    s->frame.lanes = kernels.lanes;
    w->lines.candidate_count = w->lines.probe_count = 0;
    assert_true(dp_tile_see(&w->tile, false));
    for (uint32_t i = 0; i < SPINES; i++)
        dp_add_candidate(w, (dp_candidate){.a = 2 * i, .b = 2 * i + 1, .k1 = UINT32_MAX},
                         &s->spines[i], NULL);
    for (uint32_t i = 0; i < w->lines.probe_count; i += 7) w->lines.probes.limit[i] = INFINITY;
    dp_hide_points(w);
}

/* 1: hidden, 0: visible, -1: undecidable. */
static int hides(const dp_finder *w, const dp_tile_polygon *p, float x, float y, float limit) {
    const float beside[5][2] = {{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}}, slack = 1e-3f;
    const float d = dp_minf(dp_plane_at(p, x, y), p->nearest);
    int covered = 0;
    if (!dp_is_surface(&w->tile, p) || d < limit - 1e-5f) return 0;
    for (int i = 0; i < 5; i++)
        covered += dp_tile_covers(&w->tile, p, x + slack * beside[i][0], y + slack * beside[i][1]);
    if (!covered) return 0;
    return covered == 5 && d > limit + 1e-5f ? 1 : -1;
}

static int expected(const dp_finder *w, const dp_candidate *c, uint32_t i, float limit) {
    int found = 0;
    for (uint32_t k = 0; k < POLYGONS; k++) {
        if (k == c->a || k == c->b) continue;
        const int one =
            hides(w, &w->tile.polygons[k], w->lines.probes.x[i], w->lines.probes.y[i], limit);
        if (one == 1) return 1;
        if (one < 0) found = -1;
    }
    return found;
}

typedef struct counts {
    uint32_t hidden, seen, unsure;
} counts;

/* Tests every point against every polygon. */
static void compare(const dp_finder *w, const float *before, counts *found) {
    for (uint32_t k = 0; k < w->lines.candidate_count; k++) {
        const dp_candidate *const c = &w->lines.candidates[k];
        for (uint32_t i = c->probe; i < c->probe + (c->k1 - c->k0); i++) {
            if (i % 7 == 0) {
                assert_true(w->lines.probes.limit[i] == INFINITY);
                continue;
            }
            const int hidden = expected(w, c, i, before[i]);
            found->hidden += hidden == 1, found->seen += hidden == 0, found->unsure += hidden < 0;
            if (hidden < 0) continue;
            assert_int_equal(w->lines.probes.limit[i] == INFINITY, hidden);
            if (!hidden) assert_true(w->lines.probes.limit[i] == before[i]);
        }
    }
}

static void free_scene(scene *s) {
    s->frame.lanes = 1;
    dp_finder_free(&s->worker);
}

static void points_behind_polygons_are_hidden(void **state) {
    dp_width list[DP_WIDTHS_MOST];
    const uint32_t kernels = dp_widths_list(list);
    uint32_t seed = 5;
    counts found = {0};
    static scene s;
    (void)state;
    for (int round = 0; round < ROUNDS; round++) {
        begin(&s, &seed);
        const dp_finder *const w = &s.worker;
        hide(&s, (dp_width){"plain", 1});
        const uint32_t count = w->lines.probe_count;
        float *const plain = malloc(2 * (size_t)count * sizeof *plain), *const before =
                                                                            plain + count;
        assert_non_null(plain);
        memcpy(plain, w->lines.probes.limit, count * sizeof *plain);
        for (uint32_t k = 0; k < w->lines.candidate_count; k++) {
            const dp_candidate *const c = &w->lines.candidates[k];
            dp_find_kernels_for(s.frame.lanes)
                ->points(w, &s.spines[c->a / 2], c->k0, c->k1, &w->lines.probes, c->probe);
        }
        memcpy(before, w->lines.probes.limit, count * sizeof *before);
        for (uint32_t i = 0; i < kernels; i++) {
            hide(&s, list[i]);
            assert_int_equal(w->lines.probe_count, count);
            assert_memory_equal(w->lines.probes.limit, plain, count * sizeof *plain);
        }
        compare(w, before, &found);
        free(plain);
        free_scene(&s);
    }
    assert_true(found.hidden > 1000 && found.seen > 1000);
    assert_true(found.unsure < found.seen / 20);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(points_behind_polygons_are_hidden)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
