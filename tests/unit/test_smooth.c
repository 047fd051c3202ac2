/* core/smooth and mesh/pn: the geometry of curved PN triangles, and that no crack opens. */
#include "core/curve.h"
#include "core/smooth.h"
#include "mesh/normals.h"
#include "mesh/pn_grid.h"
#include "reading.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ------- geometry ------- */

static dp_pn_end smooth_end(dp_vec3 n) { return (dp_pn_end){1, {dp_unit(n)}}; }

static dp_pn_edge edge_on_sphere(dp_vec3 a, dp_vec3 b) {
    const dp_pn_end ends[2] = {smooth_end(a), smooth_end(b)};
    return dp_pn_edge_between(a, b, &ends[0], &ends[1]);
}

static dp_pn_patch patch_on_sphere(const dp_vec3 at[3]) {
    dp_pn_edge edges[3];
    for (int i = 0; i < 3; i++) edges[i] = edge_on_sphere(at[i], at[(i + 1) % 3]);
    return dp_pn_patch_within(edges);
}

/* Corners on the unit sphere, about `size` apart. */
static void sphere_triangle(double size, dp_vec3 at[3]) {
    static const double turn[3][2] = {{0, 1}, {0.87, -0.5}, {-0.87, -0.5}};
    for (int i = 0; i < 3; i++)
        at[i] = dp_unit(dp_v3(0.58 * size * turn[i][0], 0.58 * size * turn[i][1], 1));
}

static void a_patch_over_a_sphere_is_nearly_one(void **state) {
    (void)state;
    const double most[2] = {1e-3, 1.2e-2}; /* of the radius */
    for (int s = 0; s < 2; s++) {
        dp_vec3 at[3];
        sphere_triangle(s ? 0.7 : 0.35, at);
        const dp_pn_patch patch = patch_on_sphere(at);
        const dp_pn_normals normals = dp_pn_normals_of(at, at);
        for (int i = 0; i <= 12; i++)
            for (int k = 0; i + k <= 12; k++) {
                const double w[3] = {i / 12.0, k / 12.0, (12 - i - k) / 12.0};
                const dp_vec3 p = dp_pn_point(&patch, w);
                assert_true(fabs(dp_length(p) - 1) < most[s]);
                assert_true(dp_dot(dp_unit(p), dp_pn_normal(&normals, w)) > (s ? 0.995 : 0.9996));
            }
    }
}

static void a_flat_triangle_stays_flat(void **state) {
    (void)state;
    const dp_vec3 at[3] = {{0, 0, 2}, {3, 0.5, 2}, {1, 2, 2}}, up = {0, 0, 1};
    const dp_pn_end end = smooth_end(up);
    dp_pn_edge edges[3];
    for (int i = 0; i < 3; i++) edges[i] = dp_pn_edge_between(at[i], at[(i + 1) % 3], &end, &end);
    const dp_pn_patch patch = dp_pn_patch_within(edges);
    for (int i = 0; i <= 8; i++)
        for (int k = 0; i + k <= 8; k++) {
            const double w[3] = {i / 8.0, k / 8.0, (8 - i - k) / 8.0};
            const dp_vec3 p = dp_pn_point(&patch, w);
            const double x = 3 * w[1] + w[2], y = 0.5 * w[1] + 2 * w[2];
            assert_true(fabs(p.x - x) < 1e-12 && fabs(p.y - y) < 1e-12 && fabs(p.z - 2) < 1e-12);
        }
}

static uint32_t random_state = 1;
static double random_number(void) {
    random_state = random_state * 1664525 + 1013904223;
    return (random_state >> 8) / 16777216.0 * 2 - 1;
}
static dp_vec3 random_vector(void) {
    const double x = random_number(), y = random_number();
    return dp_v3((float)x, (float)y, (float)random_number());
}

static void an_edge_is_the_same_both_ways(void **state) {
    (void)state;
    for (int i = 0; i < 2000; i++) {
        const dp_vec3 a = random_vector(), b = random_vector();
        dp_pn_end at_a = smooth_end(random_vector()), at_b = smooth_end(random_vector());
        if (i % 3 == 1) at_a.count = 2, at_a.normal[1] = dp_unit(random_vector());
        if (i % 5 == 1) at_b.count = 0;
        const dp_pn_edge there = dp_pn_edge_between(a, b, &at_a, &at_b),
                         back = dp_pn_edge_between(b, a, &at_b, &at_a);
        for (uint32_t n = 2; n <= DP_PN_PARTS; n++)
            for (uint32_t k = 1; k < n; k++) {
                const dp_vec3 p = dp_pn_edge_point(&there, k, n),
                              q = dp_pn_edge_point(&back, n - k, n);
                assert_memory_equal(&p, &q, sizeof p);
            }
    }
}

static void a_fold_runs_in_both_tangent_planes(void **state) {
    (void)state;
    /* the rim of a cylinder around y, between the side and the lid */
    const double angle = 0.5;
    const dp_vec3 a = {1, 0, 0}, b = {cos(angle), 0, sin(angle)}, lid = {0, 1, 0};
    const dp_pn_end ends[2] = {{2, {a, lid}}, {2, {lid, b}}};
    const dp_pn_edge rim = dp_pn_edge_between(a, b, &ends[0], &ends[1]);
    for (uint32_t i = 0; i <= 8; i++) {
        const dp_vec3 p = dp_pn_edge_point(&rim, i, 8);
        assert_true(p.y == 0);
        assert_true(fabs(dp_length(p) - 1) < 2e-3);
    }
}

static void a_steep_normal_bends_nothing(void **state) {
    (void)state;
    const dp_vec3 a = {0, 0, 0}, b = {1, 0, 0};
    const dp_pn_end steep = smooth_end(dp_v3(1, 0.2, 0)), none = {.count = 0};
    dp_vec3 bend[2];
    const dp_pn_edge edge = dp_pn_edge_between(a, b, &steep, &none);
    dp_pn_bend(&edge, bend);
    assert_true(dp_length(bend[0]) == 0 && dp_length(bend[1]) == 0);
}

/* ------- the grid ------- */

static double area_of(const dp_pn_grid *g, uint32_t t) {
    const double *const a = g->weights[g->triangles[t][0]],
                        *const b = g->weights[g->triangles[t][1]],
                        *const c = g->weights[g->triangles[t][2]];
    return (b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]);
}

static void a_grid_covers_the_triangle_once(void **state) {
    (void)state;
    static dp_pn_grid g;
    uint32_t parts[3];
    for (parts[0] = 1; parts[0] <= DP_PN_PARTS; parts[0]++)
        for (parts[1] = 1; parts[1] <= DP_PN_PARTS; parts[1]++)
            for (parts[2] = 1; parts[2] <= DP_PN_PARTS; parts[2]++) {
                uint32_t outer[3] = {0, 0, 0};
                double sum = 0;
                dp_pn_grid_make(&g, parts);
                assert_int_equal(g.triangle_count, dp_pn_triangle_count(parts));
                assert_int_equal(g.vertex_count, 3 + dp_pn_new_vertices(parts));
                for (uint32_t t = 0; t < g.triangle_count; t++) {
                    const double area = area_of(&g, t);
                    assert_true(area > 0);
                    sum += area;
                    for (int k = 0; k < 3; k++)
                        if (g.edges[t][k] != DP_PN_INSIDE) outer[g.edges[t][k]]++;
                }
                assert_true(fabs(sum - 1) < 1e-9);
                assert_memory_equal(outer, parts, sizeof outer);
            }
}

/* ------- whole meshes ------- */

enum { VERTICES = 4096, TRIANGLES = 8192 };

typedef struct mesh {
    float positions[VERTICES][3], normals[3 * TRIANGLES][3];
    uint32_t corners[3 * TRIANGLES], firsts[TRIANGLES], vertices, triangles;
    const uint16_t *groups;
    bool has_firsts; /* polygons; `triangles` is their number */
    bool has_normals;
} mesh;

typedef struct smoother {
    dp_threads *threads;
    dp_allocator memory;
    dp_smooth_store store;
    dp_normal_store normals;
    dp_frame frame;
} smoother;

static smoother begin(uint32_t threads) {
    smoother s = {.memory = dp_allocator_resolve(NULL)};
    s.threads = dp_threads_create(threads, NULL, NULL, &s.memory);
    return s;
}

static void end(smoother *s) {
    dp_smooth_store_free(&s->store, &s->memory);
    dp_normal_store_free(&s->normals, &s->memory);
    dp_threads_destroy(s->threads);
}

static void smooth(smoother *s, const mesh *m, dp_smoothing what, uint32_t level) {
    dp_camera camera;
    dp_camera_look_at(&camera, (const double[3]){3, 2, 4}, (const double[3]){0, 0, 0},
                      (const double[3]){0, 1, 0});
    dp_camera_perspective(&camera, 40, 1, 0.1, 100);
    s->frame.memory = &s->memory, s->frame.threads = s->threads;
    s->frame.polygons = (dp_polygons){.positions = m->positions[0],
                                      .stride = 12,
                                      .vertex_count = m->vertices,
                                      .corners = m->corners,
                                      .firsts = m->has_firsts ? m->firsts : NULL,
                                      .groups = m->groups,
                                      .count = m->triangles};
    assert_int_equal(dp_view_init(&s->frame.view, &camera, 800, 800, NULL), DP_OK);
    uint32_t own[3 * TRIANGLES];
    for (uint32_t i = 0; i < 3 * m->triangles; i++) own[i] = i;
    dp_smooth_setup setup = {.what = what, .level = level, .wants_normals = true};
    if (m->has_normals)
        setup.normals.given = (dp_attribute){m->normals[0], 12, 3 * m->triangles, own};
    else
        assert_true(dp_normals_make(&s->normals, &s->frame.polygons, 40, NULL, s->threads,
                                    &s->memory, &setup.normals.made));
    assert_int_equal(dp_smooth_polygons(&s->store, &setup, &s->frame, NULL), DP_OK);
}

static uint32_t add_vertex(mesh *m, dp_vec3 p) {
    assert_true(m->vertices < VERTICES);
    float *const to = m->positions[m->vertices];
    to[0] = (float)p.x, to[1] = (float)p.y, to[2] = (float)p.z;
    return m->vertices++;
}

static void add_triangle(mesh *m, uint32_t a, uint32_t b, uint32_t c) {
    assert_true(m->triangles < TRIANGLES);
    uint32_t *const to = m->corners + 3 * m->triangles++;
    to[0] = a, to[1] = b, to[2] = c;
}

/* A closed surface: a grid that is closed both ways, its vertices moved about. */
static void make_torus(mesh *m, uint32_t across, uint32_t around, double noise) {
    *m = (mesh){.vertices = 0};
    const double turn = 6.283185307179586;
    for (uint32_t i = 0; i < across; i++)
        for (uint32_t k = 0; k < around; k++) {
            const double u = turn * i / across, v = turn * k / around, r = 1 + 0.4 * cos(v);
            add_vertex(m,
                       dp_mad(dp_v3(r * cos(u), 0.4 * sin(v), r * sin(u)), random_vector(), noise));
        }
    for (uint32_t i = 0; i < across; i++)
        for (uint32_t k = 0; k < around; k++) {
            const uint32_t n = (i + 1) % across, l = (k + 1) % around, a = i * around + k,
                           b = n * around + k, c = n * around + l, d = i * around + l;
            add_triangle(m, a, c, b);
            add_triangle(m, a, d, c);
        }
}

static void add_random_normals(mesh *m, bool by_corner) {
    static dp_vec3 of_vertex[VERTICES];
    for (uint32_t v = 0; v < m->vertices; v++) of_vertex[v] = dp_unit(random_vector());
    for (uint32_t c = 0; c < 3 * m->triangles; c++) {
        const dp_vec3 n = by_corner ? dp_unit(random_vector()) : of_vertex[m->corners[c]];
        m->normals[c][0] = (float)n.x, m->normals[c][1] = (float)n.y, m->normals[c][2] = (float)n.z;
    }
    m->has_normals = true;
}

typedef struct half_edge {
    float a[3], b[3]; /* the end that comes first, and the other */
    int sign;
} half_edge;

static int compare(const void *x, const void *y) { return memcmp(x, y, sizeof(float[6])); }

static half_edge half_edge_of(const dp_polygons *p, uint32_t from, uint32_t to) {
    half_edge e = {.sign = 1};
    const float *a = dp_vertex_position(p, from), *b = dp_vertex_position(p, to);
    if (memcmp(a, b, 12) > 0) {
        const float *const other = a;
        a = b, b = other, e.sign = -1;
    }
    for (int k = 0; k < 3; k++) e.a[k] = a[k] + 0.0f, e.b[k] = b[k] + 0.0f;
    return e;
}

/* Half-edges that nothing meets: each edge must be run as often one way as the other. */
static uint32_t unmet(const dp_polygons *p) {
    uint32_t count = 0, bad = 0;
    half_edge *const edges = malloc(sizeof *edges * dp_first_corner(p, p->count));
    assert_non_null(edges);
    for (uint32_t i = 0; i < p->count; i++) {
        const uint32_t first = dp_first_corner(p, i), n = dp_corner_count(p, i);
        for (uint32_t k = 0; k < n; k++)
            edges[count++] =
                half_edge_of(p, p->corners[first + k], p->corners[first + (k + 1) % n]);
    }
    qsort(edges, count, sizeof *edges, compare);
    for (uint32_t i = 0, last; i < count; i = last) {
        int sum = 0;
        for (last = i; last < count && !compare(&edges[i], &edges[last]); last++)
            sum += edges[last].sign;
        bad += (uint32_t)abs(sum);
    }
    free(edges);
    return bad;
}

static void closed_meshes_stay_closed(void **state) {
    (void)state;
    static mesh m;
    smoother s = begin(2);
    for (int i = 0; i < 60; i++) {
        random_state = 100 + (uint32_t)i;
        make_torus(&m, 7 + (uint32_t)i % 5, 5 + (uint32_t)i % 4, i % 3 ? 0.1 * (i % 4) : 0);
        if (i % 2) add_random_normals(&m, i % 4 == 1);
        for (uint32_t level = 0; level <= 6; level += 2)
            for (int what = DP_SMOOTH_SILHOUETTES; what <= DP_SMOOTH_SURFACE; what++) {
                smooth(&s, &m, (dp_smoothing)what, level);
                assert_int_equal(unmet(&s.frame.polygons), 0);
                if (what == DP_SMOOTH_SURFACE && level)
                    assert_true(s.frame.polygons.count > m.triangles);
            }
    }
    end(&s);
}

/* A prism of n sides, its lids polygons of n corners. */
static void make_prism(mesh *m, uint32_t n, double height) {
    *m = (mesh){.has_firsts = true};
    for (uint32_t i = 0; i < 2 * n; i++) {
        const double u = 6.283185307179586 * (i / 2) / n;
        add_vertex(m, dp_v3(cos(u), i % 2 ? height : -height, sin(u)));
    }
    uint32_t c = 0;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t k = (i + 1) % n, side[4] = {2 * i + 1, 2 * k + 1, 2 * k, 2 * i};
        m->firsts[m->triangles++] = c;
        for (int q = 0; q < 4; q++) m->corners[c++] = side[q];
    }
    for (uint32_t lid = 0; lid < 2; lid++) {
        m->firsts[m->triangles++] = c;
        for (uint32_t i = 0; i < n; i++) m->corners[c++] = lid ? 2 * (n - 1 - i) + 1 : 2 * i;
    }
    m->firsts[m->triangles] = c;
}

static double farthest_from_axis(const dp_polygons *p, double least_y) {
    double most = 0;
    for (uint32_t v = 0; v < p->vertex_count; v++) {
        const float *const at = dp_vertex_position(p, v);
        if ((double)at[1] >= least_y)
            most = fmax(most, sqrt((double)(at[0] * at[0] + at[2] * at[2])));
    }
    return most;
}

static void rims_become_round_and_lids_stay_flat(void **state) {
    (void)state;
    static mesh m;
    smoother s = begin(1);
    for (uint32_t n = 10; n <= 40; n += 15) {
        make_prism(&m, n, 0.5);
        smooth(&s, &m, DP_SMOOTH_SURFACE, 3);
        const dp_polygons *const p = &s.frame.polygons;
        assert_int_equal(unmet(p), 0);
        assert_true(p->count >= n * 4 * 2);
        for (uint32_t v = 0; v < p->vertex_count; v++)
            assert_true(fabs((double)dp_vertex_position(p, v)[1]) <= 0.5);
        assert_true(fabs(farthest_from_axis(p, 0.5) - 1) < 0.01);
    }
    end(&s);
}

/* With four sides each fold is a right angle: nothing there is smooth. */
static void a_box_stays_a_box(void **state) {
    (void)state;
    static mesh m;
    smoother s = begin(1);
    make_prism(&m, 4, 0.7);
    for (uint32_t level = 0; level <= DP_SMOOTH_LEVELS; level++) {
        smooth(&s, &m, DP_SMOOTH_SURFACE, level);
        assert_int_equal(s.frame.polygons.count, m.triangles);
        assert_int_equal(s.frame.polygons.made_vertices, 0);
        for (uint32_t c = 0; c < 24; c++) assert_false(dp_edge_is_smooth(&s.frame.polygons, c));
    }
    end(&s);
}

static void what_polygons_have_is_kept(void **state) {
    (void)state;
    static mesh m;
    static uint16_t groups[TRIANGLES];
    smoother s = begin(1);
    make_torus(&m, 8, 6, 0);
    add_random_normals(&m, false);
    for (uint32_t i = 0; i < m.triangles; i++) groups[i] = (uint16_t)(i * 7);
    m.groups = groups;
    smooth(&s, &m, DP_SMOOTH_SURFACE, 2);
    const dp_polygons *const p = &s.frame.polygons;
    uint32_t outer[3] = {0, 0, 0}, of_first = 0;
    for (uint32_t i = 0; i < p->count; i++)
        assert_int_equal(p->groups[i], groups[p->source_polygon[i]]);
    for (uint32_t i = 0; i < p->count; i++)
        for (uint32_t k = 0; k < 3 && p->source_polygon[i] == 0; k++, of_first++)
            if (p->source_edges[3 * i + k] != DP_EDGE_INSIDE) outer[p->source_edges[3 * i + k]]++;
    assert_true(of_first > 3);
    for (int k = 0; k < 3; k++) assert_true(outer[k] == 1 || outer[k] == 3);
    for (uint32_t c = 0; c < 3 * p->count; c++) {
        const uint32_t n = dp_attribute_number(&p->normals, c, p->corners[c]);
        assert_true(n != UINT32_MAX);
        assert_true(fabs(dp_length(dp_v3f(dp_attribute_value(&p->normals, n))) - 1) < 1e-5);
    }
    end(&s);
}

static void levels_have_their_parts(void **state) {
    (void)state;
    static mesh m;
    smoother s = begin(1);
    make_torus(&m, 8, 6, 0);
    for (uint32_t c = 0; c < 3 * m.triangles; c++) { /* exact normals */
        const float *const p = m.positions[m.corners[c]];
        const double r = sqrt((double)(p[0] * p[0] + p[2] * p[2]));
        const dp_vec3 n =
            dp_unit(dp_v3((double)p[0] * (1 - 1 / r), (double)p[1], (double)p[2] * (1 - 1 / r)));
        m.normals[c][0] = (float)n.x, m.normals[c][1] = (float)n.y, m.normals[c][2] = (float)n.z;
    }
    m.has_normals = true;
    for (uint32_t level = 1; level <= DP_SMOOTH_LEVELS; level++) {
        smooth(&s, &m, DP_SMOOTH_SURFACE, level);
        assert_int_equal(s.frame.polygons.count, m.triangles * (level + 1) * (level + 1));
    }
    end(&s);
}

/* ------- counting and making ------- */

/* Corners and normals of a triangle, both sides of which are drawn; `by` moves the first two corners. */
static void make_leaf(mesh *m, const dp_vec3 at[3], const dp_vec3 normal[3], double by) {
    *m = (mesh){.has_normals = true};
    for (int i = 0; i < 3; i++) add_vertex(m, dp_mad(at[i], dp_v3(1, 0.3, -0.4), i < 2 ? by : 0));
    add_triangle(m, 0, 1, 2);
    add_triangle(m, 0, 2, 1);
    for (uint32_t c = 0; c < 6; c++) {
        const dp_vec3 n = normal[m->corners[c]];
        m->normals[c][0] = (float)n.x, m->normals[c][1] = (float)n.y, m->normals[c][2] = (float)n.z;
    }
}

/* By how much the edge between the first two corners is farther from silhouettes than it turns. */
static double beyond(const smoother *s, const mesh *m, double facing[2]) {
    const dp_vec3 a = dp_v3f(m->normals[0]), b = dp_v3f(m->normals[1]);
    for (int k = 0; k < 2; k++)
        facing[k] = dp_curve_facing(&s->frame.view, dp_v3f(m->positions[k]), k ? b : a);
    return dp_min(facing[0], facing[1]) - dp_length(dp_sub(a, b));
}

/* Is the edge far from silhouettes only because what it is known by is rounded? */
static bool is_rounded(const smoother *s, const mesh *m) {
    double f[2];
    const dp_vec3 a = dp_v3f(m->normals[0]), b = dp_v3f(m->normals[1]);
    return beyond(s, m, f) <= 0 && dp_curve_is_far(a, (double)(float)f[0], b, (double)(float)f[1]);
}

/* Moves the corners until rounding decides. False: not found. */
static bool find_rounded(const smoother *s, mesh *m, const dp_vec3 at[3], const dp_vec3 normal[3]) {
    double low = -1, high = 1, f[2];
    make_leaf(m, at, normal, low);
    const bool rises = beyond(s, m, f) < 0;
    make_leaf(m, at, normal, high);
    if (rises == (beyond(s, m, f) < 0)) return false;
    for (int i = 0; i < 60; i++) {
        const double middle = (low + high) / 2;
        make_leaf(m, at, normal, middle);
        *((beyond(s, m, f) < 0) == rises ? &low : &high) = middle;
    }
    for (int i = -40; i <= 40; i++) {
        make_leaf(m, at, normal, low + i * 3e-8);
        if (is_rounded(s, m)) return true;
    }
    return false;
}

static void rounding_does_not_part_counting_from_making(void **state) {
    (void)state;
    static mesh m;
    smoother s = begin(1);
    int found = 0;
    make_torus(&m, 5, 5, 0);
    smooth(&s, &m, DP_SMOOTH_SILHOUETTES, 2); /* for its view */
    random_state = 5;
    for (int i = 0; i < 4000 && found < 5; i++) {
        const dp_vec3 at[3] = {random_vector(), random_vector(), random_vector()};
        const dp_vec3 n = dp_unit(dp_mad(random_vector(), dp_unit(dp_v3(-3, -2, -4)), 0.5)),
                      normal[3] = {n, dp_unit(dp_mad(n, random_vector(), 0.3)),
                                   dp_unit(random_vector())};
        if (!find_rounded(&s, &m, at, normal)) continue;
        smooth(&s, &m, DP_SMOOTH_SILHOUETTES, 2);
        assert_int_equal(unmet(&s.frame.polygons), 0);
        found += s.frame.polygons.count > m.triangles;
    }
    assert_int_equal(found, 5);
    end(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_patch_over_a_sphere_is_nearly_one),
        cmocka_unit_test(a_flat_triangle_stays_flat),
        cmocka_unit_test(an_edge_is_the_same_both_ways),
        cmocka_unit_test(a_fold_runs_in_both_tangent_planes),
        cmocka_unit_test(a_steep_normal_bends_nothing),
        cmocka_unit_test(a_grid_covers_the_triangle_once),
        cmocka_unit_test(closed_meshes_stay_closed),
        cmocka_unit_test(rims_become_round_and_lids_stay_flat),
        cmocka_unit_test(a_box_stays_a_box),
        cmocka_unit_test(what_polygons_have_is_kept),
        cmocka_unit_test(levels_have_their_parts),
        cmocka_unit_test(rounding_does_not_part_counting_from_making),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
