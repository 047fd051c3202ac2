/* find/edge_table.c: edges whose keys the table cannot tell apart are told apart by their vertices,
 * and edges around flat interior vertices are not listed, by kernels of any width. */
#include "base/hostile.h"
#include "base/kernels.h"
#include "find/edge_table.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 40 };

/* Keys with one sum and one exclusive or: 1 + 6 and 2 + 5. */
typedef struct scene {
    dp_frame frame;
    dp_finder worker;
    dp_vertex vertices[3 * MOST];
    uint32_t count;
} scene;

static void add_triangle(scene *s, uint32_t a, uint32_t b, uint32_t c) {
    dp_finder *const w = &s->worker;
    const uint32_t key[3] = {a, b, c}, t = s->count++;
    w->tile.polygons[t] =
        (dp_tile_polygon){.id = t,
                          .point = 3 * t,
                          .points = 3,
                          .flags = DP_POLYGON_FRONT | DP_POLYGON_TOUCHES | DP_POLYGON_NEAR * 7};
    for (uint32_t k = 0; k < 3; k++) {
        w->tile.points[3 * t + k] = (dp_vertex){.x = (float)k, .y = (float)(k * k), .key = key[k]};
        w->tile.keys[k * w->tile.keys_stride + t] = key[k];
    }
    memcpy(w->tile.normals[t], (float[4]){0, 0, 1, 0}, sizeof *w->tile.normals);
}

/* Nothing is flat, so that every edge is listed. */
static void begin(scene *s, dp_width kernels) {
    static const float positions[3 * MOST][3];
    dp_finder *const w = &s->worker;
    *s = (scene){.frame = {.lanes = kernels.lanes, .flat_cosine = 2}};
    s->frame.polygons = (dp_polygons){.positions = positions[0],
                                      .stride = sizeof *positions,
                                      .vertex_count = 3 * MOST,
                                      .count = MOST};
    s->frame.vertices = s->vertices;
    w->tile.frame = &s->frame;
    w->tile.memory = dp_allocator_resolve(NULL);
    w->tile.keys_stride = MOST + DP_SEEN_ROOM;
    assert_true(
        DP_TILE_RESERVE(&w->tile, &w->tile, polygons, polygons_cap, (size_t)MOST) &&
        DP_TILE_RESERVE(&w->tile, &w->tile, points, points_cap, (size_t)3 * MOST) &&
        DP_TILE_RESERVE(&w->tile, &w->tile, normals, normals_cap, (size_t)MOST + 16) &&
        DP_TILE_RESERVE(&w->tile, &w->tile, keys, keys_cap, 3 * (size_t)w->tile.keys_stride));
}

static void fill(scene *s) {
    s->worker.tile.polygon_count = s->count;
    assert_true(dp_tile_see(&s->worker.tile, false));
    assert_int_equal(s->worker.tile.seen_count, s->count);
    assert_true(dp_edge_table_list(&s->worker) && dp_edge_table_fill(&s->worker));
}

/* The partner of an edge; UINT32_MAX: none. Fails if the edge is not listed. */
static uint32_t partner_of(const scene *s, uint32_t polygon, uint32_t edge, bool more) {
    for (uint32_t n = dp_edge_table_next(&s->worker, 0); n != UINT32_MAX;
         n = dp_edge_table_next(&s->worker, n + 1)) {
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

/* Two triangles meet; a seeming third is of another edge; then a real third comes. */
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

/* ------- one-rings: what is listed ------- */

/* The key of vertex `i`; all vertices have their own slots of one-rings. */
static uint32_t spread_key(uint32_t i) { return (i + 1) * 0x9e3779b1u; }

static void begin_flat(scene *s) { s->worker.rings.spread = 0.25f * DP_RING_ONE * DP_RING_ONE; }

/* Around vertex 0, vertices 1 to 6 in a ring; all flat. Vertices of the ring are open. */
static void add_ring(scene *s, uint32_t triangles) {
    begin_flat(s);
    for (uint32_t i = 0; i < triangles; i++)
        add_triangle(s, spread_key(0), spread_key(1 + i), spread_key(1 + (i + 1) % 6));
}

static void set_normal(scene *s, uint32_t triangle, float x, float kind) {
    const float z = x * x < 1 ? sqrtf(1 - x * x) : 0;
    memcpy(s->worker.tile.normals[triangle], (float[4]){x, 0, z, kind},
           sizeof *s->worker.tile.normals);
}

/* How many edges the list holds that end at vertex 0. */
static uint32_t count_spokes(scene *s) {
    uint32_t spokes = 0;
    const dp_edge_list *const list = &s->worker.table.edges;
    s->worker.tile.polygon_count = s->count;
    assert_true(dp_tile_see(&s->worker.tile, false) && dp_edge_table_list(&s->worker));
    for (uint32_t i = 0; i < list->count; i++)
        spokes += list->from[i] == spread_key(0) || (list->from[i] ^ list->key[i]) == spread_key(0);
    return spokes;
}

/* The hostile build has so few slots that vertices share them, and more is listed. */
static void expect_spokes(scene *s, uint32_t count) {
    const uint32_t spokes = count_spokes(s);
    assert_true(spokes == count || (DP_TUNED(0, 1) && spokes == 12));
    assert_int_equal(s->worker.table.edges.count + s->worker.table.flat_edges, 3 * s->count);
}

static void expect_flat(scene *s) { expect_spokes(s, 0); }

static void flat(scene *s) {
    add_ring(s, 6);
    expect_flat(s);
    for (uint32_t i = 0; i < 6; i++) set_normal(s, i, i % 2 ? 0.2f : -0.2f, i % 3 ? 0 : DP_ROUGH);
    expect_flat(s);
    for (uint32_t i = 0; i < 6; i++) memcpy(s->worker.tile.normals[i], dp_away, sizeof dp_away);
    expect_flat(s);
}

static void open_ring(scene *s) {
    add_ring(s, 5);
    assert_int_equal(count_spokes(s), 10);
}

static void bent(scene *s) {
    add_ring(s, 6);
    set_normal(s, 3, 0.6f, 0);
    assert_int_equal(count_spokes(s), 12);
}

static void turn_away(scene *s, uint32_t triangle) {
    s->worker.tile.polygons[triangle].flags &= ~(uint32_t)DP_POLYGON_FRONT;
    memcpy(s->worker.tile.normals[triangle], dp_away, sizeof dp_away);
}

/* Of a vertex with flat front faces and some back faces, only edges between them are listed, by
 * both. */
static void contour_vertex(scene *s) {
    add_ring(s, 6);
    turn_away(s, 3);
    expect_spokes(s, 4);
    turn_away(s, 4);
    expect_spokes(s, 4);
    for (uint32_t i = 0; i < s->worker.table.edges.count; i++)
        assert_true(s->worker.table.edges.edge[i] < 3);
    set_normal(s, 0, 0.6f, 0);
    assert_int_equal(count_spokes(s), 12);
}

/* Normals that are unknown are made first, those that are rough only where edges are listed. */
static void unknown(scene *s) {
    static float places[3 * MOST][3];
    add_ring(s, 6);
    s->frame.polygons.positions = places[0];
    memset(places, 0, sizeof places);
    places[3 * 2 + 1][0] = 1, places[3 * 2 + 2][1] = 1;
    set_normal(s, 2, 0, DP_UNKNOWN);
    set_normal(s, 4, 0, DP_ROUGH);
    expect_flat(s);
    assert_true(s->worker.tile.normals[2][2] == 1 && s->worker.tile.normals[2][3] == 0);
    set_normal(s, 2, 0, DP_UNKNOWN);
    places[3 * 2 + 2][2] = 1; /* upright now */
    assert_int_equal(count_spokes(s), 12);
    assert_int_equal(s->worker.tile.unsure_count, 1);
    assert_int_equal(s->worker.tile.unsure[0], 4);
}

/* A triangle that is wound the other way does not close the ring. */
static void wound_wrongly(scene *s) {
    add_ring(s, 5);
    add_triangle(s, spread_key(1), spread_key(6), spread_key(0));
    assert_int_equal(count_spokes(s), 12);
}

/* Three vertices in one slot: a triangle by itself, and a hole. */
static void same_slot(scene *s) {
    begin_flat(s);
    add_triangle(s, 1, 2, 3);
    count_spokes(s);
    assert_int_equal(s->worker.table.edges.count, 3);
    s->count = 0;
    const uint32_t around[3] = {spread_key(1), spread_key(2), spread_key(3)};
    for (uint32_t i = 0; i < 3; i++) {
        add_triangle(s, 1 + (i + 1) % 3, 1 + i, around[i]);
        add_triangle(s, 1 + (i + 1) % 3, around[i], around[(i + 1) % 3]);
    }
    count_spokes(s);
    assert_int_equal(s->worker.table.edges.count, 18);
}

/* What is clipped has its edges listed, and those of the triangles around it. */
static void clipped(scene *s) {
    add_ring(s, 6);
    s->worker.tile.polygons[1].flags |= DP_POLYGON_CLIPPED;
    for (uint32_t i = 0; i < 3 * MOST; i++) s->frame.vertices[i].key = s->worker.tile.points[i].key;
    assert_int_equal(count_spokes(s), 12);
}

/* Triangles elsewhere, so that `count` more make `all`. */
static void fill_up(scene *s, uint32_t count, uint32_t all) {
    while (s->count + count < all) add_triangle(s, spread_key(7), spread_key(10), spread_key(11));
}

/* However many triangles there are, the last one closes its one-ring, or opens it. */
static void last_one(scene *s) {
    for (uint32_t all = 7; all <= MOST; all++) {
        s->count = 0;
        fill_up(s, 6, all);
        add_ring(s, 6);
        expect_flat(s);
        s->count = 0;
        add_ring(s, 6);
        fill_up(s, 1, all);
        add_triangle(s, spread_key(0), spread_key(14), spread_key(15));
        assert_int_equal(count_spokes(s), 14);
    }
}

/* What a test fills the table with, and finds there. */
typedef struct trial {
    void (*run)(scene *);
} trial;

static void for_all_kernels(void **state) {
    const trial *const t = *state;
    dp_width list[DP_WIDTHS_MOST];
    const uint32_t count = dp_widths_list(list);
    for (uint32_t k = 0; k < count; k++) {
        scene *const s = malloc(sizeof *s);
        assert_non_null(s);
        begin(s, list[k]);
        t->run(s);
        dp_finder_free(&s->worker);
        free(s);
    }
}

int main(void) {
    static trial trials[] = {{tells_apart},   {pairs_apart}, {fans_apart}, {same_way},
                             {flat},          {open_ring},   {bent},       {unknown},
                             {wound_wrongly}, {clipped},     {same_slot},  {contour_vertex},
                             {last_one}};
    const struct CMUnitTest tests[] = {
        {"edges of one name are told apart", for_all_kernels, NULL, NULL, &trials[0]},
        {"pairs of one name are told apart", for_all_kernels, NULL, NULL, &trials[1]},
        {"fans of one name are told apart", for_all_kernels, NULL, NULL, &trials[2]},
        {"edges may run the same way", for_all_kernels, NULL, NULL, &trials[3]},
        {"edges around a flat interior vertex are not listed", for_all_kernels, NULL, NULL,
         &trials[4]},
        {"an open one-ring is not flat", for_all_kernels, NULL, NULL, &trials[5]},
        {"a bent one-ring is not flat", for_all_kernels, NULL, NULL, &trials[6]},
        {"normals are made where edges are listed", for_all_kernels, NULL, NULL, &trials[7]},
        {"wrong winding opens a one-ring", for_all_kernels, NULL, NULL, &trials[8]},
        {"a clipped triangle opens a one-ring", for_all_kernels, NULL, NULL, &trials[9]},
        {"one-rings of one slot do not close each other", for_all_kernels, NULL, NULL, &trials[10]},
        {"at a contour vertex, edges between both facings are listed", for_all_kernels, NULL, NULL,
         &trials[11]},
        {"one-rings know of all triangles, the last one too", for_all_kernels, NULL, NULL,
         &trials[12]},
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
