/* Curvature against surfaces whose curvature is known. */
#include "mesh/curvature.h"

#include "base/vec.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const double pi = 3.14159265358979323846;

enum { MOST = 100 };
static float points[(MOST + 1) * (MOST + 1)][3];
static uint32_t corners[6 * MOST * MOST];
static dp_curvature found[(MOST + 1) * (MOST + 1)];

typedef dp_vec3 surface(double s, double t);

/* n x n squares over [0, 1]², each cut in two, the diagonals this way and that. */
static dp_polygons patch(surface *at, uint32_t n) {
    uint32_t c = 0;
    for (uint32_t i = 0; i <= n; i++)
        for (uint32_t k = 0; k <= n; k++) {
            const dp_vec3 p = at((double)i / n, (double)k / n);
            float *const q = points[i * (n + 1) + k];
            q[0] = (float)p.x, q[1] = (float)p.y, q[2] = (float)p.z;
        }
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t k = 0; k < n; k++) {
            const uint32_t a = i * (n + 1) + k, b = a + n + 1;
            const uint32_t even[6] = {a, b, b + 1, a, b + 1, a + 1},
                           odd[6] = {a, b, a + 1, b, b + 1, a + 1};
            memcpy(corners + c, (i + k) % 2 ? odd : even, sizeof even);
            c += 6;
        }
    return (dp_polygons){.positions = points[0],
                         .stride = 12,
                         .vertex_count = (n + 1) * (n + 1),
                         .corners = corners,
                         .count = 2 * n * n};
}

static void find(const dp_polygons *p) {
    const dp_allocator memory = dp_allocator_resolve(NULL);
    assert_true(dp_curvatures(p, &memory, found));
}

static dp_vec3 sphere_at(double s, double t) {
    const double a = 1.5 * (s - 0.5), b = 1.5 * (t - 0.5);
    return dp_scale(dp_v3(sin(a) * cos(b), sin(b), cos(a) * cos(b)), 3);
}
static dp_vec3 cylinder_at(double s, double t) {
    return dp_v3(2 * sin(3 * s), 4 * t, 2 * cos(3 * s));
}
static dp_vec3 torus_at(double s, double t) {
    const double a = s < 1 ? 2 * pi * s : 0, b = t < 1 ? 2 * pi * t : 0, r = 3 + cos(b);
    return dp_v3(r * cos(a), r * sin(a), sin(b));
}
static dp_vec3 saddle_at(double s, double t) {
    const double x = s - 0.5, y = t - 0.5;
    return dp_v3(x, y, (x * x - 0.5 * y * y) / 2);
}

static void expect(double value, double expected, double tolerance, const char *what, uint32_t i,
                   uint32_t k) {
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%s at %u, %u: %g, not %g", what, i, k, value, expected);
}

static void test_sphere(void **state) {
    (void)state;
    const dp_polygons p = patch(sphere_at, 40);
    find(&p);
    for (uint32_t i = 2; i < 39; i++)
        for (uint32_t k = 2; k < 39; k++) {
            expect((double)found[i * 41 + k].least, 1.0 / 3, 0.01, "least", i, k);
            expect((double)found[i * 41 + k].most, 1.0 / 3, 0.01, "most", i, k);
        }
}

static void test_cylinder(void **state) {
    (void)state;
    const dp_polygons p = patch(cylinder_at, 40);
    find(&p);
    for (uint32_t i = 2; i < 39; i++)
        for (uint32_t k = 2; k < 39; k++) {
            const dp_curvature *const c = &found[i * 41 + k];
            expect((double)c->least, 0, 0.005, "least", i, k);
            expect((double)c->most, 0.5, 0.01, "most", i, k);
            expect(fabs((double)c->along[1]), 1, 0.001, "axis", i, k);
        }
}

/* Seen from inside curvatures change their sign, and the axis stays. */
static void test_a_cylinder_from_inside(void **state) {
    (void)state;
    dp_polygons p = patch(cylinder_at, 40);
    for (uint32_t t = 0; t < p.count; t++) {
        const uint32_t c = corners[3 * t];
        corners[3 * t] = corners[3 * t + 1], corners[3 * t + 1] = c;
    }
    find(&p);
    expect((double)found[20 * 41 + 20].most, -0.5, 0.01, "most", 20, 20);
    expect(fabs((double)found[20 * 41 + 20].along[1]), 1, 0.001, "axis", 20, 20);
}

/* Around the tube 1, the other way cos(b) / (3 + cos(b)). */
static void test_torus(void **state) {
    (void)state;
    const uint32_t n = MOST;
    const dp_polygons p = patch(torus_at, n); /* its seams lie in one place and are one */
    find(&p);
    for (uint32_t i = 0; i < n; i++)
        for (uint32_t k = 0; k < n; k++) {
            const double a = 2 * pi * i / n, b = 2 * pi * k / n;
            const dp_curvature *const c = &found[i * (n + 1) + k];
            expect((double)c->most, 1, 0.01, "most", i, k);
            expect((double)c->least, cos(b) / (3 + cos(b)), 0.01, "least", i, k);
            const double along = (double)c->along[0] * -sin(a) + (double)c->along[1] * cos(a);
            expect(fabs(along), 1, 0.001, "round the hole", i, k);
        }
}

static void test_saddle(void **state) {
    (void)state;
    const dp_polygons p = patch(saddle_at, 40);
    find(&p);
    const dp_curvature *const c = &found[20 * 41 + 20];
    expect((double)c->least, 0.5, 0.01, "least", 20,
           20); /* fronts look up: the hollow way is negative */
    expect((double)c->most, -1, 0.01, "most", 20, 20);
    expect(fabs((double)c->along[1]), 1, 0.001, "along y", 20, 20);
}

/* ------- what is drawn along ------- */

typedef struct curvature {
    dp_curvature_store store;
    dp_threads *threads;
    dp_allocator memory;
} curvature;

static void bend(curvature *b, const dp_polygons *p) {
    b->memory = dp_allocator_resolve(NULL);
    if (!b->threads) b->threads = dp_threads_create(2, NULL, NULL, &b->memory);
    assert_true(dp_curvature_directions(&b->store, p, b->threads, &b->memory));
}

static void unbend(curvature *b) {
    dp_curvature_store_free(&b->store, &b->memory);
    dp_threads_destroy(b->threads);
}

/* Everywhere on a sphere the surface bends alike: level lines. With noise, too, neighbours
 * agree. */
static void test_umbilics_and_noise_get_a_steady_direction(void **state) {
    (void)state;
    const uint32_t n = 40;
    const dp_polygons p = patch(sphere_at, n);
    curvature b;
    memset(&b, 0, sizeof b);
    bend(&b, &p);
    for (uint32_t i = 15; i + 15 <= n;
         i++) /* what the patch's border does to normals has not spread to here */
        for (uint32_t k = 15; k + 15 <= n; k++)
            expect(fabs((double)b.store.along[i * (n + 1) + k][1]), 0, 0.25, "height", i, k);
    uint32_t seed = 1;
    for (uint32_t v = 0; v < p.vertex_count; v++)
        for (int c = 0; c < 3; c++) {
            seed = seed * 1664525u + 1013904223u;
            points[v][c] += 0.002f * ((float)(seed >> 8) / 16777216.0f - 0.5f);
        }
    bend(&b, &p);
    double sum = 0;
    for (uint32_t i = 3; i + 3 <= n; i++)
        for (uint32_t k = 3; k + 3 <= n; k++) {
            const dp_vec3 d = dp_v3f(b.store.along[i * (n + 1) + k]),
                          e = dp_v3f(b.store.along[i * (n + 1) + k + 1]);
            sum += fabs(dp_dot(d, e));
        }
    assert_true(sum / ((n - 5) * (n - 5)) > 0.9);
    unbend(&b);
}

static void test_directions_are_unit_tangent_and_kept(void **state) {
    (void)state;
    const uint32_t n = 30;
    const dp_polygons p = patch(torus_at, n);
    curvature b;
    memset(&b, 0, sizeof b);
    bend(&b, &p);
    for (uint32_t v = 0; v < p.vertex_count; v++)
        assert_true(fabs(dp_length(dp_v3f(b.store.along[v])) - 1) < 1e-5);
    const uint64_t key = b.store.key;
    bend(&b, &p);
    assert_true(b.store.key == key);
    points[5][0] += 0.01f;
    bend(&b, &p);
    assert_true(b.store.key != key);
    unbend(&b);
}

static void test_broken_meshes_are_survived(void **state) {
    (void)state;
    static const float few[4][3] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, NAN, 1}};
    static const uint32_t t[12] = {0, 1, 2, 0, 0, 1, 0, 1, 99, 0, 1, 3};
    const dp_polygons p = {
        .positions = few[0], .stride = 12, .vertex_count = 4, .corners = t, .count = 4};
    curvature b;
    memset(&b, 0, sizeof b);
    find(&p);
    bend(&b, &p);
    unbend(&b);
}

/* From next to nothing to as large as floats go. */
static void test_directions_are_finite_at_any_size(void **state) {
    (void)state;
    static const float sizes[] = {1e-38f, 1e-30f, 1e-22f, 1e-19f, 1e-15f,
                                  1e15f,  1e19f,  1e30f,  2e38f};
    curvature b;
    memset(&b, 0, sizeof b);
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        const dp_polygons p = patch(torus_at, 8);
        for (uint32_t v = 0; v < p.vertex_count; v++)
            for (int k = 0; k < 3; k++) points[v][k] *= sizes[s] / 4;
        bend(&b, &p);
        for (uint32_t v = 0; v < p.vertex_count; v++)
            assert_true(isfinite(dp_length(dp_v3f(b.store.along[v]))));
    }
    unbend(&b);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sphere),
        cmocka_unit_test(test_cylinder),
        cmocka_unit_test(test_a_cylinder_from_inside),
        cmocka_unit_test(test_torus),
        cmocka_unit_test(test_saddle),
        cmocka_unit_test(test_umbilics_and_noise_get_a_steady_direction),
        cmocka_unit_test(test_directions_are_unit_tangent_and_kept),
        cmocka_unit_test(test_broken_meshes_are_survived),
        cmocka_unit_test(test_directions_are_finite_at_any_size),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
