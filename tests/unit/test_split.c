/* mesh/split: cuts ears in the order of a plain loop over all corners, whatever the polygon, but
 * without looking at all corners again and again. */
#include "mesh/polygons.h"

#include "base/elementary.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { MOST = 100000, PLAIN_MOST = 4096 };

typedef struct polygon {
    uint32_t n;
    float at[MOST][3];
} polygon;

static polygon p;
static dp_split_scratch scratch;

/* ------- the plain loop ------- */

static dp_flat flatten(void) {
    dp_vec3 sum = {0, 0, 0};
    for (uint32_t i = 0; i < p.n; i++) {
        const dp_vec3 o = dp_v3f(p.at[0]);
        sum = dp_add(sum,
                     dp_cross(dp_sub(dp_v3f(p.at[i]), o), dp_sub(dp_v3f(p.at[(i + 1) % p.n]), o)));
    }
    const dp_vec3 normal = dp_unit(sum);
    const dp_vec3 axis = fabs(normal.x) < 0.6 ? dp_v3(1, 0, 0) : dp_v3(0, 1, 0);
    dp_flat f = {.at = scratch.at, .u = dp_unit(dp_cross(axis, normal))};
    f.v = dp_cross(normal, f.u);
    return f;
}

static bool same(const float *a, const float *b) {
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static bool is_ear(const dp_flat *f, const uint32_t *next, uint32_t a, uint32_t b, uint32_t c) {
    if (!(dp_flat_side(f, a, b, c) > 0)) return false;
    for (uint32_t q = next[c]; q != a; q = next[q])
        if (!same(p.at[q], p.at[a]) && !same(p.at[q], p.at[b]) && !same(p.at[q], p.at[c]) &&
            dp_flat_side(f, a, b, q) >= 0 && dp_flat_side(f, b, c, q) >= 0 &&
            dp_flat_side(f, c, a, q) >= 0)
            return false;
    return true;
}

/* Is triangle number t of the result that of the plain loop? */
static void check_against_plain(uint32_t count) {
    static uint32_t next[PLAIN_MOST];
    const dp_flat f = flatten();
    uint32_t a = 0, tries = 0, t = 0;
    assert_true(p.n <= PLAIN_MOST);
    for (uint32_t i = 0; i < p.n; i++) next[i] = (i + 1) % p.n;
    for (uint32_t left = p.n; left > 3;) {
        const uint32_t b = next[a], c = next[b];
        if (tries <= left && !is_ear(&f, next, a, b, c)) {
            a = b, tries++;
            continue;
        }
        const uint32_t want[3] = {a, b, c};
        assert_true(t < count);
        assert_memory_equal(scratch.triangles[t++], want, sizeof want);
        next[a] = c, left--, tries = 0;
    }
    const uint32_t want[3] = {a, next[a], next[next[a]]};
    assert_memory_equal(scratch.triangles[t++], want, sizeof want);
    assert_int_equal(t, count);
    assert_int_equal(t, p.n - 2);
}

/* ------- polygons ------- */

static void put(double x, double y, double z) {
    float *const at = p.at[p.n++];
    at[0] = (float)x, at[1] = (float)y, at[2] = (float)z;
}

static double turn(uint32_t i, uint32_t n) { return 6.283185307179586 * i / n; }

static uint32_t seed;
static uint32_t dice(uint32_t sides) {
    seed = seed * 1664525 + 1013904223;
    return (uint32_t)((uint64_t)seed * sides >> 32);
}

static void put_polar(double r, double angle, double z) {
    put(r * dp_cos(angle), r * dp_sin(angle), z);
}

static void star(uint32_t n) {
    for (uint32_t i = 0; i < n; i++) put_polar(i % 2 ? 1 : 0.5, turn(i, n), 0);
}
static void coast(uint32_t n) {
    for (uint32_t i = 0; i < n; i++)
        put_polar(1 + 0.1 * dp_sin(turn(7 * i, n)) + 0.05 * dp_sin(turn(61 * i, n)) +
                      0.001 * dice(9),
                  turn(i, n), 0);
}
static void comb(uint32_t n) {
    put(0, 0, 0), put(2, 0, 0);
    for (uint32_t i = 0; i < n - 2; i++) put(2 - 2.0 * i / n, i % 2 ? 1 : 0.2, 0);
}
static void spiral(uint32_t n) {
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t k = i < n / 2 ? i : n - 1 - i;
        put_polar(0.1 + 2.0 * k / n + (i < n / 2 ? 0.02 : 0), turn(40 * k, n), 0);
    }
}
static void wave(uint32_t n) { /* not planar */
    for (uint32_t i = 0; i < n; i++)
        put_polar(i % 2 ? 1 : 0.8, turn(i, n), 0.2 * dp_sin(turn(3 * i, n)));
}
static void scribble(uint32_t n) { /* crosses itself */
    for (uint32_t i = 0; i < n; i++) put(dice(1000), dice(1000), 0);
}
static void lattice(uint32_t n) { /* so do many corners coincide and edges fall together */
    for (uint32_t i = 0; i < n; i++) put(dice(5), dice(7), 0);
}
static void stairs(uint32_t n) { /* collinear corners */
    put(0, 0, 0);
    for (uint32_t i = 0; i < n - 2; i++) put((i + 2) / 4, i / 4, 0);
    put(0, n, 0);
}
static void petals(uint32_t n) { /* back to one point again and again */
    for (uint32_t i = 0; i < n / 3; i++) {
        put(0, 0, 0);
        put_polar(1, turn(i, n / 3), 0), put_polar(1, turn(i, n / 3) + 3.0 / n, 0);
    }
    while (p.n < n) put(0, 0, 0);
}
static void holes(uint32_t n) { /* a square with square holes, each joined by a bridge */
    const uint32_t count = n / 7;
    put(0, 0, 0), put(count, 0, 0), put(count, 1, 0);
    for (uint32_t i = count; i-- > 0;) {
        const double x = i + 0.25;
        put(x, 1, 0), put(x, 0.75, 0), put(x + 0.5, 0.75, 0), put(x + 0.5, 0.25, 0);
        put(x, 0.25, 0), put(x, 0.75, 0), put(x, 1, 0);
    }
    put(0, 1, 0);
}
static void point(uint32_t n) {
    for (uint32_t i = 0; i < n; i++) put(3, 3, 3);
}
static void line(uint32_t n) {
    for (uint32_t i = 0; i < n; i++) put(dice(100), 0, 0);
}
static void lens(uint32_t n) {
    for (uint32_t i = 0; i < n; i++) {
        const double s = i < n / 2 ? -1 + 4.0 * i / n : 3 - 4.0 * i / n;
        put(s, (i < n / 2 ? -0.001 : 0.001) * (1 - s * s) + i % 2 * 0.0002, 0);
    }
}

static const struct {
    void (*make)(uint32_t n);
    bool is_simple;
} kinds[] = {{star, true},     {coast, true},  {comb, true},    {spiral, true},  {lens, true},
             {holes, true},    {wave, true},   {stairs, false}, {petals, false}, {scribble, false},
             {lattice, false}, {point, false}, {line, false}};
enum { KINDS = sizeof kinds / sizeof *kinds };

static void tilt(void) {
    const double c = 0.8, s = 0.6;
    for (uint32_t i = 0; i < p.n; i++) {
        float *const at = p.at[i];
        const double x = c * (double)at[0] - s * (double)at[1],
                     y = s * (double)at[0] + c * (double)at[1];
        at[0] = (float)(c * x + s * (double)at[2]), at[1] = (float)y;
        at[2] = (float)(c * (double)at[2] - s * x);
    }
}

static uint32_t split(void) {
    const dp_allocator memory = dp_allocator_resolve(NULL);
    assert_true(dp_split_scratch_reserve(&scratch, p.n, &memory));
    for (uint32_t i = 0; i < p.n; i++) scratch.at[i] = p.at[i];
    return dp_split_polygon(&scratch, p.n);
}

static int free_scratch(void **state) {
    const dp_allocator memory = dp_allocator_resolve(NULL);
    (void)state;
    dp_split_scratch_free(&scratch, &memory);
    return 0;
}

/* ------- tests ------- */

static void cuts_as_a_plain_loop_does(void **state) {
    (void)state;
    for (uint32_t kind = 0; kind < KINDS; kind++)
        for (uint32_t n = 4; n < 700; n = n < 45 ? n + 1 : n * 5 / 3)
            for (int tilted = 0; tilted < 2; tilted++) {
                seed = kind + n;
                p.n = 0;
                kinds[kind].make(n);
                if (p.n < 4) continue;
                if (tilted) tilt();
                check_against_plain(split());
            }
}

static void cuts_random_polygons_as_a_plain_loop_does(void **state) {
    (void)state;
    for (uint32_t round = 0; round < 3000; round++) {
        seed = round;
        p.n = 0;
        const uint32_t n = 33 + dice(60);
        (round % 2 ? lattice : scribble)(n);
        if (round % 3 == 0) tilt();
        check_against_plain(split());
    }
}

static double area_of(const dp_flat *f, uint32_t a, uint32_t b, uint32_t c) {
    return dp_flat_side(f, a, b, c) / 2;
}

/* The triangles fill the polygon once, and no corner took many looks. */
static void cuts_many_corners(void **state) {
    (void)state;
    for (uint32_t kind = 0; kind < KINDS; kind++)
        for (uint32_t n = 5000; n <= MOST; n *= 20) {
            seed = kind;
            p.n = 0;
            kinds[kind].make(n);
            tilt();
            const uint32_t count = split();
            assert_int_equal(count, p.n - 2);
            const dp_flat f = flatten();
            double area = 0, sum = 0;
            for (uint32_t i = 1; i + 1 < p.n; i++) area += area_of(&f, 0, i, i + 1);
            for (uint32_t t = 0; t < count; t++) {
                const uint32_t *const v = scratch.triangles[t];
                const double part = area_of(&f, v[0], v[1], v[2]);
                sum += part;
                if (kinds[kind].is_simple) assert_true(part > -1e-7 * area);
            }
            assert_true(fabs(sum - area) <= 1e-6 * fabs(area) + 1e-9);
            if (scratch.tree.visits > 250 * (uint64_t)n)
                fail_msg("kind %u: %llu visits for %u corners", kind,
                         (unsigned long long)scratch.tree.visits, n);
        }
}

static void many_corners_do_not_stay_whole(void **state) {
    (void)state;
    for (uint32_t n = 4000; n <= 5000; n += 1000) {
        p.n = 0;
        for (uint32_t i = 0; i < n; i++) put_polar(1000000, turn(i, n), 0);
        split();
        assert_int_equal(dp_stays_whole(scratch.at, n), n == 4000);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cuts_as_a_plain_loop_does),
        cmocka_unit_test(cuts_random_polygons_as_a_plain_loop_does),
        cmocka_unit_test(cuts_many_corners),
        cmocka_unit_test(many_corners_do_not_stay_whole),
    };
    return cmocka_run_group_tests(tests, NULL, free_scratch);
}
