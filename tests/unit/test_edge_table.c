/* pipe/edge_table.c: edges that the table takes for one at first, as their keys have what it compares in common, are
 * told apart, by kernels of any width. */
#include "kernel/kernels.h"
#include "pipe/edge_table.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 40 };

/* Keys with one sum and one exclusive or: 1 + 6 and 2 + 5. */
typedef struct scene {
    dp_frame frame;
    dp_tile_worker worker;
    uint32_t count;
} scene;

static void add_triangle(scene *s, uint32_t a, uint32_t b, uint32_t c) {
    dp_tile_worker *const w = &s->worker;
    const uint32_t key[3] = {a, b, c}, t = s->count++;
    w->polygons[t] = (dp_tile_polygon){.id = t, .point = 3 * t, .points = 3,
                                       .flags = DP_POLYGON_FRONT | DP_POLYGON_TOUCHES | DP_POLYGON_NEAR * 7};
    for (uint32_t k = 0; k < 3; k++) {
        w->points[3 * t + k] = (dp_vertex){.x = (float)k, .y = (float)(k * k), .key = key[k]};
        w->keys[k * w->keys_stride + t] = key[k];
    }
    memcpy(w->normals[t], (float[4]){0, 0, 1, 0}, sizeof *w->normals);
}

/* Nothing is flat, so that every edge is told of. */
static void begin(scene *s, const dp_kernels *kernels) {
    static const float positions[3 * MOST][3];
    dp_tile_worker *const w = &s->worker;
    *s = (scene){.frame = {.kernels = kernels, .flat_cosine = 2}};
    s->frame.polygons = (dp_polygons){.positions = positions[0], .stride = sizeof *positions, .vertex_count = 3 * MOST, .count = MOST};
    w->frame = &s->frame;
    w->memory = dp_allocator_resolve(NULL);
    w->keys_stride = MOST + DP_SEEN_ROOM;
    assert_true(DP_WORKER_RESERVE(w, polygons, polygons_cap, (size_t)MOST) && DP_WORKER_RESERVE(w, points, points_cap, (size_t)3 * MOST) &&
                DP_WORKER_RESERVE(w, normals, normals_cap, (size_t)MOST + 16) &&
                DP_WORKER_RESERVE(w, keys, keys_cap, 3 * (size_t)w->keys_stride));
}

static void fill(scene *s) {
    s->worker.polygon_count = s->count;
    assert_true(dp_tile_see(&s->worker, false));
    assert_int_equal(s->worker.seen_count, s->count);
    assert_true(dp_edge_table_list(&s->worker) && dp_edge_table_fill(&s->worker));
}

/* The partner of an edge; UINT32_MAX: none. Fails where the edge has not been told of. */
static uint32_t partner_of(const scene *s, uint32_t polygon, uint32_t edge, bool more) {
    for (uint32_t n = dp_edge_table_next(&s->worker, 0); n != UINT32_MAX; n = dp_edge_table_next(&s->worker, n + 1)) {
        const dp_edge_entry e = dp_edge_table_entry(&s->worker, n);
        if (e.a != polygon || e.edge_a != edge) continue;
        assert_int_equal(e.more != 0, more);
        return e.b;
    }
    fail_msg("edge %u of triangle %u is not in the table", edge, polygon);
    return 0;
}

static void tells_apart(scene *s) {
    add_triangle(s, 1, 6, 100);
    add_triangle(s, 2, 5, 200); /* takes the first one's edge for its own */
    fill(s);
    for (uint32_t t = 0; t < 2; t++)
        for (uint32_t e = 0; e < 3; e++) assert_int_equal(partner_of(s, t, e, false), UINT32_MAX);
}

static void pairs_apart(scene *s) {
    for (uint32_t i = 0; i < 20; i++) add_triangle(s, 1000 + 3 * i, 1001 + 3 * i, 1002 + 3 * i);
    add_triangle(s, 1, 6, 100);
    add_triangle(s, 2, 5, 200);
    add_triangle(s, 5, 2, 300);
    add_triangle(s, 6, 1, 400);
    fill(s);
    assert_int_equal(partner_of(s, 20, 0, false), 23);
    assert_int_equal(partner_of(s, 21, 0, false), 22);
    for (uint32_t t = 0; t < 20; t++) assert_int_equal(partner_of(s, t, 1, false), UINT32_MAX);
}

/* Two meet, one that seems to be the third is of another edge, and a third one comes. */
static void fans_apart(scene *s) {
    add_triangle(s, 1, 6, 100);
    add_triangle(s, 6, 1, 200);
    add_triangle(s, 5, 2, 300);
    add_triangle(s, 1, 6, 400);
    fill(s);
    assert_int_equal(partner_of(s, 0, 0, true), 1);
    assert_int_equal(partner_of(s, 2, 0, false), UINT32_MAX);
}

/* In an edge's own direction, as the winding disagrees. */
static void same_way(scene *s) {
    add_triangle(s, 1, 6, 100);
    add_triangle(s, 1, 6, 200);
    fill(s);
    assert_int_equal(partner_of(s, 0, 0, false), 1);
}

/* What a test fills the table with, and finds there. */
typedef struct trial {
    void (*run)(scene *);
} trial;

static void for_all_kernels(void **state) {
    const trial *const t = *state;
    const dp_kernels *list[DP_KERNELS_MAX];
    const uint32_t count = dp_kernels_list(list);
    for (uint32_t k = 0; k < count; k++) {
        scene *const s = malloc(sizeof *s);
        assert_non_null(s);
        begin(s, list[k]);
        t->run(s);
        dp_tile_worker_free(&s->worker);
        free(s);
    }
}

int main(void) {
    static trial trials[] = {{tells_apart}, {pairs_apart}, {fans_apart}, {same_way}};
    const struct CMUnitTest tests[] = {
        {"edges of one name are told apart", for_all_kernels, NULL, NULL, &trials[0]},
        {"pairs of one name are told apart", for_all_kernels, NULL, NULL, &trials[1]},
        {"fans of one name are told apart", for_all_kernels, NULL, NULL, &trials[2]},
        {"edges may run the same way", for_all_kernels, NULL, NULL, &trials[3]},
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
