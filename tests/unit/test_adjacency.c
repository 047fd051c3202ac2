/* Adjacency, the geometry stage and polar coordinates of Hermosilla and Vázquez 2010. */
#include <drypoint/drypoint.h>

#include "features/extrude.h"
#include "mesh/adjacency.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static dp_batch batch_of(const float *positions, size_t vertices, const uint32_t *indices,
                         size_t triangles) {
    return (dp_batch){.positions = positions,
                      .vertex_count = vertices,
                      .indices = indices,
                      .corner_count = 3 * triangles,
                      .polygon_count = triangles,
                      .stable = true};
}

static void expect_six(const uint32_t *six, const uint32_t expected[6]) {
    for (int i = 0; i < 6; i++)
        if (six[i] != expected[i]) fail_msg("index %d is %u, not %u", i, six[i], expected[i]);
}

/* Hermosilla and Vázquez 2010, Figure 2.2: corners at 0, 2, 4, what lies across the edges between
 * them at 1, 3, 5. */
static void test_six_indices_are_sorted_as_in_figure_2_2(void **state) {
    (void)state;
    static const float p[6][3] = {{0, 0, 0},  {2, 0, 0}, {1, 2, 0},
                                  {1, -2, 0}, {3, 2, 0}, {-1, 2, 0}};
    static const uint32_t t[12] = {0, 1, 2, 1, 0, 3, 2, 1, 4, 0, 2, 5};
    uint32_t six[24];
    const dp_batch batch = batch_of(p[0], 6, t, 4);
    assert_int_equal(dp_adjacency_indices(&batch, NULL, six, NULL), DP_OK);
    expect_six(six, (const uint32_t[6]){0, 3, 1, 4, 2, 5});
    /* 1 0 3: across its first edge the first triangle's third corner, across open edges its own */
    expect_six(six + 6, (const uint32_t[6]){1, 2, 0, 1, 3, 0});
}

static void test_a_soup_has_the_same_neighbours_as_an_indexed_mesh(void **state) {
    (void)state;
    static const float p[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    static const uint32_t t[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    float soup[12][3];
    for (int i = 0; i < 12; i++) memcpy(soup[i], p[t[i]], sizeof *soup);
    soup[0][0] = -0.0f; /* the same place */
    uint32_t a[24], b[24];
    const dp_batch indexed = batch_of(p[0], 4, t, 4), empty = batch_of(soup[0], 12, NULL, 4);
    assert_int_equal(dp_adjacency_indices(&indexed, NULL, a, NULL), DP_OK);
    assert_int_equal(dp_adjacency_indices(&empty, NULL, b, NULL), DP_OK);
    for (int i = 0; i < 24; i++) assert_int_equal(a[i], t[b[i]]);
    expect_six(a, (const uint32_t[6]){0, 3, 2, 3, 1, 3});
}

/* What lies across the edge from vertex 0 to vertex 1, of up to four triangles at it. */
static void expect_across(const float p[][3], size_t vertices, const uint32_t *t, size_t n,
                          const uint32_t *expected) {
    uint32_t six[24];
    const dp_batch batch = batch_of(p[0], vertices, t, n);
    assert_int_equal(dp_adjacency_indices(&batch, NULL, six, NULL), DP_OK);
    for (size_t i = 0; i < n; i++)
        if (six[6 * i + 1] != expected[i])
            fail_msg("triangle %zu: %u, not %u", i, six[6 * i + 1], expected[i]);
}

/* Two sheets, each with two coincident sides, meet at an edge: sides that face each other belong to
 * different sheets. Of two coincident pages, the later is the neighbour of the one at the next
 * greater angle; the earlier has none. */
static void test_sides_of_one_sheet_do_not_look_at_each_other(void **state) {
    (void)state;
    static const float p[5][3] = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
    static const uint32_t sheets[12] = {0, 1, 2, 1, 0, 2, 0, 1, 3, 1, 0, 3};
    expect_across(p, 4, sheets, 4, (const uint32_t[4]){3, 3, 2, 2});
    static const uint32_t pages[9] = {0, 1, 2, 0, 1, 4, 1, 0, 3};
    expect_across(p, 5, pages, 3, (const uint32_t[3]){2, 3, 4});
}

static void test_wrong_calls_and_bad_indices(void **state) {
    (void)state;
    static const float p[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    static const uint32_t t[6] = {0, 1, 2, 2, 1, 77}, firsts[2] = {0, 3};
    uint32_t six[12];
    dp_batch batch = batch_of(p[0], 3, t, 2);
    assert_int_equal(dp_adjacency_indices(NULL, NULL, six, NULL), DP_ERR_ARGUMENT);
    assert_int_equal(dp_adjacency_indices(&batch, NULL, NULL, NULL), DP_ERR_ARGUMENT);
    assert_int_equal(dp_adjacency_indices(&batch, NULL, six, NULL), DP_OK);
    expect_six(six, (const uint32_t[6]){0, 2, 1, 0, 2, 1}); /* the bad one is nobody's neighbour */
    batch.corner_count = 5;
    dp_diag diag = {0};
    assert_int_equal(dp_adjacency_indices(&batch, NULL, six, &diag), DP_ERR_ARGUMENT);
    assert_non_null(strstr(diag.message, "corner_count is 5"));
    batch.corner_count = 6;
    batch.firsts = firsts, batch.polygon_count = 1;
    assert_int_equal(dp_adjacency_indices(&batch, NULL, six, NULL), DP_ERR_ARGUMENT);
}

/* Inside: what the library itself uses. */
typedef struct made {
    dp_adjacency adjacency;
    dp_polygons polygons;
    dp_threads *threads;
    dp_allocator memory;
    bool built;
} made;

static void make(made *m, const float *positions, uint32_t vertices, const uint32_t *corners,
                 uint32_t count, const uint32_t *firsts) {
    if (!m->threads) {
        m->memory = dp_allocator_resolve(NULL);
        m->threads = dp_threads_create(2, NULL, NULL, &m->memory);
    }
    m->polygons = (dp_polygons){.positions = positions,
                                .stride = 12,
                                .vertex_count = vertices,
                                .corners = corners,
                                .firsts = firsts,
                                .count = count};
    assert_true(
        dp_adjacency_update(&m->adjacency, &m->polygons, m->threads, &m->memory, &m->built));
    for (uint32_t c = 0; c < m->adjacency.corners; c++) { /* the invariant */
        const uint32_t across = m->adjacency.across[c];
        if (!dp_is_across(across)) continue;
        const uint32_t back = m->adjacency.across[dp_across_corner(across)];
        assert_int_equal(dp_across_corner(back), c);
        assert_int_equal(back & DP_ACROSS_FLIPPED, across & DP_ACROSS_FLIPPED);
    }
}

static void unmake(made *m) {
    dp_adjacency_free(&m->adjacency, &m->memory);
    dp_threads_destroy(m->threads);
}

/* Two wedges that touch along z: the fronts of the four pages face each other in pairs, or away. */
static void test_four_pages_are_paired_by_the_wedges_between_them(void **state) {
    (void)state;
    static const float p[6][3] = {{0, 0, 0},  {0, 0, 1},   {1, 1, 0},
                                  {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}};
    /* front of page 0 (at 45 degrees) faces growing angles, of page 1 (at 135) to falling ones,
     * and so on */
    static const uint32_t t[12] = {0, 1, 2, 1, 0, 3, 0, 1, 4, 1, 0, 5};
    made m = {0};
    make(&m, p[0], 6, t, 4, NULL);
    assert_int_equal(m.adjacency.across[0], 3);
    assert_int_equal(m.adjacency.across[6], 9);
    const dp_fan_corner *const fan = dp_fan_at(&m.adjacency, 6);
    assert_true(fan && fan->count == 4 && m.adjacency.fans[fan->first] == 0);
    assert_null(dp_fan_at(&m.adjacency, 1));
    unmake(&m);
}

static void test_pages_wound_alike_are_neighbours_but_flipped(void **state) {
    (void)state;
    static const float p[4][3] = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 0, 0}};
    static const uint32_t t[6] = {0, 1, 2, 0, 1, 3};
    made m = {0};
    make(&m, p[0], 4, t, 2, NULL);
    assert_int_equal(m.adjacency.across[0], 3 | DP_ACROSS_FLIPPED);
    assert_int_equal(m.adjacency.across[1], DP_ACROSS_OPEN);
    unmake(&m);
}

static void test_slivers_with_two_corners_in_one_place_are_left_out(void **state) {
    (void)state;
    static const float p[5][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {1, 0, 0}};
    static const uint32_t t[9] = {0, 1, 2, 0, 4, 1, 4, 0, 3};
    made m = {0};
    make(&m, p[0], 5, t, 3, NULL);
    assert_int_equal(m.adjacency.across[0], 6); /* over the sliver */
    assert_int_equal(m.adjacency.across[3], DP_ACROSS_NONE);
    unmake(&m);
}

static void test_polygons_have_neighbours_too(void **state) {
    (void)state;
    static const float p[6][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0, 0}, {2, 1, 0}};
    static const uint32_t t[8] = {0, 1, 2, 3, 1, 4, 5, 2}, firsts[3] = {0, 4, 8};
    made m = {0};
    make(&m, p[0], 6, t, 2, firsts);
    assert_int_equal(m.adjacency.across[1], 7);
    assert_int_equal(dp_polygon_of_corner(&m.adjacency, 7), 1);
    unmake(&m);
}

/* Positions may change without a new topology; indices may not, and coincident vertices may not
 * part. */
static void test_it_is_built_once_per_topology(void **state) {
    (void)state;
    float p[6][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    uint32_t t[6] = {0, 1, 2, 3, 4, 5};
    made m = {0};
    make(&m, p[0], 6, t, 2, NULL);
    assert_true(m.built);
    assert_int_equal(m.adjacency.across[1], 5);
    p[0][2] = 7;
    make(&m, p[0], 6, t, 2, NULL);
    assert_false(m.built);
    p[3][0] = 5;
    make(&m, p[0], 6, t, 2, NULL);
    assert_true(m.built);
    assert_int_equal(m.adjacency.across[1], DP_ACROSS_OPEN);
    t[0] = 4, t[4] = 0;
    make(&m, p[0], 6, t, 2, NULL);
    assert_true(m.built);
    unmake(&m);
}

/* ------- the geometry stage ------- */

static void expect_point(const dp_fin_point *p, double x, double y, double tx, double ty,
                         double v) {
    if (fabs(p->at.x - x) > 1e-9 || fabs(p->at.y - y) > 1e-9 || fabs(p->tx - tx) > 1e-9 ||
        fabs(p->ty - ty) > 1e-9 || p->v != v)
        fail_msg("(%g, %g) with (%g, %g, %g)", p->at.x, p->at.y, p->tx, p->ty, p->v);
}

/* Hermosilla and Vázquez 2010, Figures 2.3 to 2.5. Normals at 45 degrees: d_a = d_c = 2 * 5
 * sin(22.5), d_b = 10, by hand. */
static void test_extrusion_and_its_texture_coordinates(void **state) {
    (void)state;
    const double s = sqrt(0.5);
    const dp_silhouette_edge edge = {.a = {100, 50, 1},
                                     .b = {110, 50, 2},
                                     .outward = {0.3, -2},
                                     .normal_a = {-s, -s},
                                     .normal_b = {s, -s}};
    dp_fin_point p[DP_FIN_POINTS];
    assert_true(dp_extrude(&edge, 5, p));
    const double corner = 3.826834323650898, t = 10 * corner / (10 + 2 * corner);
    expect_point(&p[0], 100 - 5 * s, 50 - 5 * s, 100, 50, 1);
    expect_point(&p[1], 100, 45, 100 + t, 50, 1);
    expect_point(&p[2], 100, 50, 100, 50, 0);
    expect_point(&p[3], 110, 45, 110 - t, 50, 1);
    expect_point(&p[4], 110, 50, 110, 50, 0);
    expect_point(&p[5], 110 + 5 * s, 50 - 5 * s, 110, 50, 1);
    /* z is unchanged (Hermosilla and Vázquez 2010, Listing 2.2) */
    assert_true(p[1].at.d == 1 && p[3].at.d == 2);
}

static void test_a_normal_against_the_extrusion_is_turned_round(void **state) {
    (void)state;
    const dp_silhouette_edge edge = {
        .a = {0, 0, 1}, .b = {10, 0, 1}, .outward = {0, 1}, .normal_a = {0.6, -0.8}};
    dp_fin_point p[DP_FIN_POINTS];
    assert_true(dp_extrude(&edge, 10, p));
    assert_true(fabs(p[0].at.x + 6) < 1e-9 && fabs(p[0].at.y - 8) < 1e-9);
    assert_true(p[5].at.x == 10 && p[5].at.y == 10); /* none given: square to the edge */
    const dp_silhouette_edge point = {.a = {3, 4, 1}, .b = {3, 4, 1}, .outward = {0, 1}};
    assert_false(dp_extrude(&point, 10, p));
}

/* u = alpha / 2 pi + k d. */
static void test_polar_coordinates_by_hand(void **state) {
    (void)state;
    static const double cases[][4] = {{1, 0, 0, 0},
                                      {0, 2, 0, 0.25},
                                      {-3, 0, 0, 0.5},
                                      {0, -1, 0, 0.75},
                                      {1, 1, 0, 0.125},
                                      {1, -1, 0, 0.875},
                                      {3, 4, 0.1, 0.14758361765043326 + 0.5}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_true(fabs(dp_stroke_polar(cases[i][0], cases[i][1], cases[i][2]) - cases[i][3]) <
                    1e-12);
}

/* ------- pictures ------- */

enum { WIDTH = 320, HEIGHT = 240 };
static uint8_t pictures[2][HEIGHT][WIDTH][4];

static void draw(const char *shape, const dp_style *style, uint32_t threads, uint8_t *rgba,
                 dp_stats *stats) {
    const dp_context_desc desc = {.threads = threads};
    dp_context *context = NULL;
    dp_source *source = NULL;
    dp_camera camera;
    dp_diag diag = {0};
    assert_int_equal(dp_context_create(&desc, &context, NULL), DP_OK);
    assert_int_equal(dp_source_from_shape(&(dp_shape){.name = shape}, &source, NULL), DP_OK);
    dp_camera_fit(&camera, &(dp_fit){.min = {-1, -1, -1}, .max = {1, 1, 1}});
    const dp_target target = {.width = WIDTH, .height = HEIGHT, .rgba = rgba};
    if (dp_draw(context, source, &camera, style, &target, &diag))
        fail_msg("%s: %s", shape, diag.message);
    if (stats) dp_stats_of(context, stats);
    dp_source_destroy(source);
    dp_context_destroy(context);
}

static void expect_same(const char *what) {
    if (memcmp(pictures[0], pictures[1], sizeof pictures[0]))
        fail_msg("%s: the pictures differ", what);
}

/* No pixel differs by more than 30 %. At tile borders the edge table looks again at what lies beside
 * an edge, which may cost or add a point of a line. */
static void expect_alike(const char *what) {
    const uint8_t *const a = pictures[0][0][0], *const b = pictures[1][0][0];
    size_t different = 0;
    for (size_t i = 0; i < sizeof pictures[0]; i++) different += abs(a[i] - b[i]) > 76;
    if (different) fail_msg("%s: the pictures differ in %zu values", what, different);
}

static void test_strokes_are_those_that_emerge(void **state) {
    (void)state;
    static const char *const shapes[] = {"cube", "gear", "bolt", "bracket", "torus", "sphere"};
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        dp_style style = {0};
        dp_stats stats;
        draw(shapes[i], &style, 1, pictures[0][0][0], NULL);
        style.edges = DP_EDGES_ADJACENCY;
        draw(shapes[i], &style, 2, pictures[1][0][0], &stats);
        expect_alike(shapes[i]);
        assert_true(stats.adjacency_bytes > 0 && stats.adjacency_ms > 0);
    }
}

static void test_one_pass_draws_what_two_passes_draw(void **state) {
    (void)state;
    dp_texture *texture = NULL;
    assert_int_equal(dp_texture_named("charcoal", 3, NULL, &texture, NULL), DP_OK);
    for (int i = 0; i < 2; i++) {
        dp_style style = {.edges = DP_EDGES_ADJACENCY,
                          .ink = DP_INK_QUADS,
                          .method = DP_METHOD_PAPER,
                          .passes = 1,
                          .line = {{.width = 14}},
                          .surface = DP_RGB(200, 220, 240)};
        if (i) style.stroke.texture = texture;
        draw("torus", &style, 1, pictures[0][0][0], NULL);
        style.passes = 2;
        draw("torus", &style, 7, pictures[1][0][0], NULL);
        expect_same(i ? "textured" : "plain");
        uint32_t dark = 0;
        for (int y = 0; y < HEIGHT; y++)
            for (int x = 0; x < WIDTH; x++) dark += pictures[0][y][x][0] < 60;
        assert_true(dark > 2000);
    }
    dp_texture_destroy(texture);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_six_indices_are_sorted_as_in_figure_2_2),
        cmocka_unit_test(test_a_soup_has_the_same_neighbours_as_an_indexed_mesh),
        cmocka_unit_test(test_sides_of_one_sheet_do_not_look_at_each_other),
        cmocka_unit_test(test_wrong_calls_and_bad_indices),
        cmocka_unit_test(test_four_pages_are_paired_by_the_wedges_between_them),
        cmocka_unit_test(test_pages_wound_alike_are_neighbours_but_flipped),
        cmocka_unit_test(test_slivers_with_two_corners_in_one_place_are_left_out),
        cmocka_unit_test(test_polygons_have_neighbours_too),
        cmocka_unit_test(test_it_is_built_once_per_topology),
        cmocka_unit_test(test_extrusion_and_its_texture_coordinates),
        cmocka_unit_test(test_a_normal_against_the_extrusion_is_turned_round),
        cmocka_unit_test(test_polar_coordinates_by_hand),
        cmocka_unit_test(test_strokes_are_those_that_emerge),
        cmocka_unit_test(test_one_pass_draws_what_two_passes_draw),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
