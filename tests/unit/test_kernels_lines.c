/* Kernels that find lines' sample points and hidden edges: all agree with plain C, bit for bit, and
 * plain C with the definition. */
#include "find/finder.h"
#include "find/kernels.h"
#include "strokes/kernels.h"
#include "raster/tile.h"
#include "strokes/segment_batch.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "kernel_tests.h"

enum { POINTS = 100, ROUNDS = 300 };

/* Within the tile at (TILE_X, 0) and a little beyond. */
enum { TILE_X = 64 };
static double random_place(uint32_t *seed) {
    return (double)(next_random(seed) % (DP_TILE * 1000 + 8000)) / 1000 - 4;
}

static dp_pointd random_point(uint32_t *seed, bool orthographic) {
    const double x = TILE_X + random_place(seed), y = random_place(seed),
                 d = 0.1 + (double)(next_random(seed) % 10000) / 10000;
    return (dp_pointd){x, y, orthographic ? -10 * d : d};
}

static void expect_point(const dp_view *view, const dp_spine *s, uint32_t k, const dp_probes *p,
                         uint32_t i) {
    const dp_pointd at = dp_point_mix(s->probe_a, s->probe_b, (k + 0.5) / s->n);
    const float x = (float)(at.x - TILE_X), y = (float)at.y;
    assert_memory_equal(&p->x[i], &x, sizeof x);
    assert_memory_equal(&p->y[i], &y, sizeof y);
    assert_true(p->limit[i] == (float)(at.d + dp_depth_step(view, at.d, DP_PROBE_SLACK)));
}

/* Any run of a spine's points. */
static void points_agree(void **state) {
    static dp_finder w;
    dp_width list[DP_WIDTHS_MOST];
    const uint32_t count = dp_widths_list(list);
    uint32_t seed = 7;
    (void)state;
    for (int round = 0; round < ROUNDS; round++) {
        float truth[3][POINTS + DP_PROBES_ROOM], own[3][POINTS + DP_PROBES_ROOM];
        const dp_probes expected = {truth[0], truth[1], truth[2]}, out = {own[0], own[1], own[2]};
        const bool orthographic = round & 1;
        const dp_frame frame = {.view = make_view(orthographic)};
        const dp_spine s = {.probe_a = random_point(&seed, orthographic),
                            .probe_b = random_point(&seed, orthographic),
                            .n = 1 + next_random(&seed) % POINTS};
        const uint32_t k0 = next_random(&seed) % s.n, k1 = k0 + 1 + next_random(&seed) % (s.n - k0);
        w.tile.frame = &frame;
        w.tile.tile_x = TILE_X;
        const uint32_t at = next_random(&seed) % (POINTS - (k1 - k0) + 1);
        dp_find_kernels_plain.points(&w, &s, k0, k1, &expected, at);
        for (uint32_t k = k0; k < k1; k++) expect_point(&frame.view, &s, k, &expected, at + k - k0);
        for (uint32_t i = 0; i < count; i++) {
            dp_find_kernels_for(list[i].lanes)->points(&w, &s, k0, k1, &out, at);
            for (int m = 0; m < 3; m++)
                assert_memory_equal(own[m] + at, truth[m] + at, (k1 - k0) * sizeof(float));
        }
    }
}

enum { TRIANGLES = 60, EDGES = 3 * TRIANGLES };

typedef struct scene {
    dp_frame frame;
    dp_tile_polygon polygons[TRIANGLES];
    dp_vertex points[3 * TRIANGLES];
    uint32_t polygon[EDGES], edge[EDGES];
    uint8_t marks[EDGES];
} scene;

/* Triangles of all sizes, some clipped, of whose edges some are alone; and blocks of pixels that
 * hide what lies further away. */
static void make_scene(scene *s, dp_finder *w, uint32_t *seed) {
    memset(w->tile.farthest, 0, sizeof w->tile.farthest);
    for (uint32_t y = 0; y < DP_RINGED; y++)
        for (uint32_t x = 0; x < DP_RINGED; x++)
            w->tile.farthest[0][0][y][x] = (float)(next_random(seed) % 4);
    for (uint32_t k = 1; k < DP_SPANS * DP_SPANS; k++) /* as dp_tile_find_farthest does */
        for (uint32_t y = 0; y < DP_RINGED; y++)
            for (uint32_t x = 0; x < DP_RINGED; x++) {
                float least = INFINITY;
                for (uint32_t v = y; v <= y + k / DP_SPANS && v < DP_RINGED; v++)
                    for (uint32_t u = x; u <= x + k % DP_SPANS && u < DP_RINGED; u++)
                        least = dp_minf(least, w->tile.farthest[0][0][v][u]);
                w->tile.farthest[k / DP_SPANS][k % DP_SPANS][y][x] = least;
            }
    for (uint32_t t = 0; t < TRIANGLES; t++) {
        const double x = random_place(seed), y = random_place(seed),
                     size = 0.1 + next_random(seed) % 40;
        s->polygons[t] = (dp_tile_polygon){
            .point = 3 * t, .points = 3, .flags = next_random(seed) % 5 ? 0 : DP_POLYGON_CLIPPED};
        for (uint32_t k = 0; k < 3; k++) {
            s->points[3 * t + k] = (dp_vertex){(float)(x + size * (next_random(seed) % 100) / 100),
                                               (float)(y + size * (next_random(seed) % 100) / 100),
                                               (float)(next_random(seed) % 300) / 100, 0};
            s->polygon[3 * t + k] = t, s->edge[3 * t + k] = k;
            s->marks[3 * t + k] = (uint8_t)(next_random(seed) % 3);
        }
    }
}

static bool is_hidden(const scene *s, const dp_finder *w, uint32_t number) {
    const dp_tile_polygon *const p = &s->polygons[s->polygon[number]];
    const dp_vertex a = s->points[p->point + s->edge[number]],
                    b = s->points[p->point + (s->edge[number] + 1) % 3];
    return !(p->flags & DP_POLYGON_CLIPPED) &&
           dp_tile_hides(&w->tile, dp_minf(a.x, b.x), dp_minf(a.y, b.y), dp_maxf(a.x, b.x),
                         dp_maxf(a.y, b.y), dp_maxf(a.d, b.d));
}

static void edges_alone_are_unmarked_where_hidden(void **state) {
    static dp_finder w;
    static scene s;
    dp_width list[DP_WIDTHS_MOST];
    const uint32_t count = dp_widths_list(list);
    uint32_t seed = 11, unmarked = 0, kept = 0;
    (void)state;
    s.frame = (dp_frame){.view = make_view(false), .step_scale = 0.01f};
    w.tile.frame = &s.frame;
    w.tile.polygons = s.polygons, w.tile.points = s.points;
    w.table.edges = (dp_edge_list){.polygon = s.polygon, .edge = s.edge};
    for (int round = 0; round < ROUNDS; round++) {
        uint8_t marks[EDGES];
        make_scene(&s, &w, &seed);
        w.table.marks = marks;
        w.table.edges.count = 1 + next_random(&seed) % EDGES;
        for (uint32_t i = 0; i < count; i++) {
            memcpy(marks, s.marks, sizeof marks);
            dp_find_kernels_for(list[i].lanes)->unmark_alone(&w);
            for (uint32_t k = 0; k < EDGES; k++) {
                const bool asked = k < w.table.edges.count && s.marks[k] == DP_MARK_ALONE,
                           hidden = asked && is_hidden(&s, &w, k);
                unmarked += hidden, kept += asked && !hidden;
                assert_int_equal(marks[k], hidden ? 0 : s.marks[k]);
            }
        }
    }
    assert_true(unmarked > 200 * count && kept > 200 * count);
}

static double random_share(uint32_t *seed) { return (double)(next_random(seed) % 1001) / 1000; }

static void put_unit(uint32_t *seed, double out[3][DP_SEGMENTS], uint32_t i) {
    const dp_vec3 n = dp_unit(dp_v3(random_share(seed) - 0.5, random_share(seed) - 0.5, 0.1));
    out[0][i] = n.x, out[1][i] = n.y, out[2][i] = n.z;
}

static void put_place(uint32_t *seed, bool orthographic, double out[3][DP_SEGMENTS], uint32_t i) {
    const dp_pointd p = random_point(seed, orthographic);
    out[0][i] = p.x, out[1][i] = p.y, out[2][i] = p.d;
}

static dp_vec3 vector_at(const double v[3][DP_SEGMENTS], uint32_t i) {
    return dp_v3(v[0][i], v[1][i], v[2][i]);
}

/* Ends lie where the shares say, on the screen and in the world; planes hold the point in whose
 * place they are. */
static void expect_segment(const dp_view *view, const dp_segment_batch *s, uint32_t i) {
    const dp_pointd a = {s->a[0][i], s->a[1][i], s->a[2][i]},
                    b = {s->b[0][i], s->b[1][i], s->b[2][i]};
    dp_vec3 first = {0, 0, 0};
    for (int k = 0; k < 2; k++) {
        const dp_pointd p = dp_point_mix(a, b, s->share[k][i]);
        const dp_vec3 at = dp_unproject(view, p);
        const float screen[3] = {(float)p.x, (float)p.y, (float)p.d},
                    world[3] = {(float)at.x, (float)at.y, (float)at.z};
        for (int c = 0; c < 3; c++) {
            assert_true(s->screen[k][c][i] == screen[c]);
            assert_true(s->world[k][c][i] == world[c]);
        }
        assert_true(s->distance[k][i] == (float)dp_distance(view, p.d));
        if (!k) first = at;
    }
    for (int k = 0; k < 2; k++) {
        const dp_vec3 n = vector_at(s->normal[k], i);
        const double facing = dp_dot(n, dp_view_vector(view, first)),
                     d = s->plane[k][0][i] + (double)s->plane[k][1][i] * s->screen[0][0][i] +
                         (double)s->plane[k][2][i] * s->screen[0][1][i];
        if (fabs(facing) > 0.05) assert_float_equal(d, s->screen[0][2][i], 1e-3);
    }
}

static void segments_agree(void **state) {
    dp_width list[DP_WIDTHS_MOST];
    const uint32_t kinds = dp_widths_list(list);
    uint32_t seed = 13;
    (void)state;
    for (int round = 0; round < ROUNDS; round++) {
        const bool orthographic = round & 1;
        const dp_view view = make_view(orthographic);
        const uint32_t count = 1 + next_random(&seed) % DP_SEGMENTS;
        dp_segment_batch truth = {0};
        for (uint32_t i = 0; i < DP_SEGMENTS; i++) {
            put_place(&seed, orthographic, truth.a, i);
            put_place(&seed, orthographic, truth.b, i);
            for (int k = 0; k < 2; k++) {
                truth.share[k][i] = random_share(&seed);
                put_unit(&seed, truth.normal[k], i);
            }
        }
        const dp_segment_batch asked = truth;
        dp_stroke_kernels_plain.segments(&view, &truth, DP_SEGMENTS);
        for (uint32_t i = 0; i < DP_SEGMENTS; i++) expect_segment(&view, &truth, i);
        for (uint32_t k = 0; k < kinds; k++) {
            const float *const want = &truth.screen[0][0][0];
            dp_segment_batch own = asked;
            const float *const got = &own.screen[0][0][0];
            dp_stroke_kernels_for(list[k].lanes)->segments(&view, &own, count);
            const size_t members =
                (sizeof own - offsetof(dp_segment_batch, screen)) / (DP_SEGMENTS * sizeof(float));
            for (size_t m = 0; m < members; m++)
                assert_memory_equal(got + m * DP_SEGMENTS, want + m * DP_SEGMENTS,
                                    count * sizeof(float));
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_agree),
        cmocka_unit_test(segments_agree),
        cmocka_unit_test(edges_alone_are_unmarked_where_hidden),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
