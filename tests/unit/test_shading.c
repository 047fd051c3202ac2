/* shade: styles of surfaces and the cartoon map on runs of pixels, worked out by hand; every width
 * of vectors gives the same. */
#include "base/kernels.h"
#include "shade/shade.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum { N = 3 };

typedef struct bench {
    dp_gbuffer g;
    dp_shading_setup setup;
    dp_shade_run run;
    float nx[DP_TILE], ny[DP_TILE], nz[DP_TILE], distance[DP_TILE]; /* whole vectors are read */
} bench;

static const dp_shaders *const plain = &dp_shaders_plain;

/* Three pixels: towards the light (the eye), across, away; the surface is (0.8, 0.4, 0.2). */
static void begin(bench *b) {
    memset(b, 0, sizeof *b);
    b->setup.g = &b->g;
    b->g.fx = b->g.fy = 100;
    b->setup.shade.light[2] = 1;
    b->run = (dp_shade_run){.nx = b->nx, .ny = b->ny, .nz = b->nz, .distance = b->distance, .n = N};
    b->nz[0] = 1, b->nx[1] = 1, b->nz[2] = -1;
    for (int i = 0; i < N; i++) {
        static const float surface[3] = {0.8f, 0.4f, 0.2f};
        for (int k = 0; k < 3; k++) b->run.color[k][i] = surface[k];
        b->distance[i] = 1;
    }
}

static void assert_color(const bench *b, int i, double red, double green, double blue) {
    const double expected[3] = {red, green, blue};
    for (int k = 0; k < 3; k++)
        if (fabs((double)b->run.color[k][i] - expected[k]) > 1e-6)
            fail_msg("pixel %d, channel %d: %g is not %g", i, k, (double)b->run.color[k][i],
                     expected[k]);
}

static void lambert_is_the_cosine(void **state) {
    (void)state;
    bench b;
    begin(&b);
    plain->styles[DP_SHADING_LAMBERT](&b.setup, &b.run);
    assert_color(&b, 0, 0.8, 0.4, 0.2);
    assert_color(&b, 1, 0.8 * 0.3, 0.4 * 0.3, 0.2 * 0.3);
    assert_color(&b, 2, 0.8 * 0.3, 0.4 * 0.3, 0.2 * 0.3);
}

/* cool = (0, 0, b) + alpha k_d, warm = (y, y, 0) + beta k_d, half way where N·L is 0 */
static void gooch_is_cool_to_warm(void **state) {
    (void)state;
    bench b;
    begin(&b);
    b.setup.shade.gooch_blue = 0.4f, b.setup.shade.gooch_yellow = 0.3f;
    b.setup.shade.gooch_alpha = 0.25f, b.setup.shade.gooch_beta = 0.5f;
    plain->styles[DP_SHADING_GOOCH](&b.setup, &b.run);
    assert_color(&b, 0, 0.3 + 0.4, 0.3 + 0.2, 0.1);
    assert_color(&b, 2, 0.2, 0.1, 0.4 + 0.05);
    assert_color(&b, 1, (0.7 + 0.2) / 2, (0.5 + 0.1) / 2, (0.1 + 0.45) / 2);
    begin(&b);
    b.setup.shade.gooch_blue = 0.4f, b.setup.shade.gooch_yellow = 0.3f;
    b.setup.shade.gooch_alpha = 0.25f, b.setup.shade.gooch_beta = 0.5f;
    b.setup.shade.gooch_plain = true;
    plain->styles[DP_SHADING_GOOCH](&b.setup, &b.run);
    assert_color(&b, 0, 0.3 + 0.25, 0.3 + 0.25, 0.25);
}

static void highlights_lie_where_the_light_is_reflected(void **state) {
    (void)state;
    bench b;
    begin(&b);
    b.setup.shade.highlight = 0.5f;
    plain->highlight(&b.setup, &b.run);
    assert_color(&b, 0, 0.9, 0.7, 0.6);
    assert_color(&b, 1, 0.8, 0.4, 0.2);
    assert_color(&b, 2, 0.8, 0.4, 0.2);
}

static void toon_looks_up_the_nearest_shade(void **state) {
    (void)state;
    static const uint8_t shades[4][4] = {
        {0, 0, 0, 255}, {51, 51, 51, 255}, {102, 102, 102, 255}, {255, 255, 255, 255}};
    bench b;
    begin(&b);
    b.setup.shades = shades[0], b.setup.shade_count = 4;
    plain->styles[DP_SHADING_TOON](&b.setup, &b.run);
    assert_color(&b, 0, 0.8, 0.4, 0.2);
    assert_color(&b, 1, 0.8 * 0.4, 0.4 * 0.4, 0.2 * 0.4); /* a half begins the third quarter */
    assert_color(&b, 2, 0, 0, 0);
    begin(&b); /* across the light, but for the rounding of a normal */
    b.setup.shades = shades[0], b.setup.shade_count = 4;
    b.nz[0] = 1e-6f, b.nz[1] = 0, b.nz[2] = -1e-6f;
    plain->styles[DP_SHADING_TOON](&b.setup, &b.run);
    for (int i = 0; i < N; i++) assert_color(&b, i, 0.8 * 0.4, 0.4 * 0.4, 0.2 * 0.4);
}

/* ink = alpha clamp(1/2 + 5 (priority - tone)) */
static void hatching_is_a_smooth_threshold(void **state) {
    (void)state;
    static const uint8_t levels[4] = {0, 100, 200, 255};
    for (int step = 0; step < 8; step++) {
        const int level = step / 2;
        const float alpha = step % 2 ? 1 : 0.25f;
        const uint8_t values[4] = {levels[level], levels[level], levels[level], levels[level]};
        bench b;
        begin(&b);
        b.setup.shade.stroke_scale = 1;
        b.setup.strokes = (dp_strokes_texture){values, 2, 2};
        b.setup.ink[0] = 0.1f, b.setup.ink_alpha = alpha;
        plain->styles[DP_SHADING_HATCH](&b.setup, &b.run);
        const double tones[N] = {1.1776, 0.1976, 0.08}, priority = levels[level] / 255.0;
        for (int i = 0; i < N; i++) {
            const double whole = fmin(fmax(0.5 + 5 * (priority - tones[i]), 0), 1),
                         ink = priority > 0 ? (double)alpha * whole : 0;
            assert_color(&b, i, 0.8 + (0.1 - 0.8) * ink, 0.4 - 0.4 * ink, 0.2 - 0.2 * ink);
        }
    }
}

static float random_between(uint32_t *seed, float low, float high) {
    *seed = *seed * 1664525u + 1013904223u;
    return low + (high - low) * (float)(*seed >> 8) / (1 << 24);
}

/* Normals of any length, none, and not finite; distances, and none; texture coordinates near and
 * far. */
typedef struct pixel_rows {
    float nx[3][DP_TILE], ny[3][DP_TILE], nz[3][DP_TILE], distance[3][DP_TILE], other[3][DP_TILE];
    float u[3][DP_TILE], v[3][DP_TILE];
    uint16_t id[3][DP_TILE];
    uint8_t colors[3][DP_TILE][4], strokes[37 * 21], shades[5][4];
} pixel_rows;

static void make_rows(pixel_rows *p, uint32_t seed) {
    for (int y = 0; y < 3; y++)
        for (int x = 0; x < DP_TILE; x++) {
            p->nx[y][x] = random_between(&seed, -1, 1), p->ny[y][x] = random_between(&seed, -1, 1);
            p->nz[y][x] = x % 17 == 3 ? NAN : x % 13 == 4 ? 0 : random_between(&seed, -1, 1);
            p->distance[y][x] = x % 11 == 5 ? DP_FAR : random_between(&seed, 1, x % 5 ? 1.05f : 3);
            p->other[y][x] = random_between(&seed, 1, 3);
            p->u[y][x] = x % 7 == 6 ? NAN : random_between(&seed, 0, x % 19 == 2 ? 1e30f : 2),
            p->v[y][x] = p->u[y][x] * 0.3f;
            p->id[y][x] = (uint16_t)(x % 23 == 1 ? 0 : 1 + x / 40);
            for (int k = 0; k < 4; k++)
                p->colors[y][x][k] = (uint8_t)random_between(&seed, 0, x % 9 ? 256 : 2);
        }
    for (size_t i = 0; i < sizeof p->strokes; i++)
        p->strokes[i] = (uint8_t)random_between(&seed, 0, 256);
    for (int i = 0; i < 20; i++) p->shades[i / 4][i % 4] = (uint8_t)(12 * i);
}

/* Shades a run of n pixels with one style of one table, and packs it. */
static void shade_run(const dp_shaders *shaders, int style, bool object, bool textured, uint32_t n,
                      pixel_rows *p, uint32_t *words) {
    static dp_gbuffer g;
    g = (dp_gbuffer){.fx = 90,
                     .fy = 80,
                     .cx = 31,
                     .cy = 17,
                     .perspective = style % 2,
                     .stride = DP_TILE,
                     .eye = {1, 2, 3},
                     .other = p->other[0] - 10 * DP_TILE};
    for (int i = 0; i < 3; i++) g.rotation[i][(i + 1) % 3] = 1;
    dp_shading_setup setup = {.ink_alpha = 0.75f,
                              .g = &g,
                              .strokes = {p->strokes, 37, 21},
                              .shades = p->shades[0],
                              .shade_count = 5};
    setup.shade = (dp_shade){.light = {0.6f, 0, 0.8f},
                             .highlight = 0.3f,
                             .gooch_blue = 0.4f,
                             .gooch_yellow = 0.4f,
                             .gooch_alpha = 0.2f,
                             .gooch_beta = 0.6f,
                             .stroke_scale = 0.7f,
                             .object_space = object};
    static dp_shade_run run;
    run = (dp_shade_run){.nx = p->nx[1],
                         .ny = p->ny[1],
                         .nz = p->nz[1],
                         .distance = p->distance[1],
                         .id = p->id[1],
                         .u = textured ? p->u[1] : NULL,
                         .v = textured ? p->v[1] : NULL,
                         .stride = DP_TILE,
                         .y = 11,
                         .n = n};
    shaders->paint((const float[4]){0.9f, 0.5f, 0.1f, 1}, &run);
    if (shaders->styles[style]) shaders->styles[style](&setup, &run);
    shaders->pack(&run, words);
}

/* Whatever comes in. */
static void wider_vectors_shade_the_same(void **state) {
    (void)state;
    static pixel_rows p;
    dp_width list[DP_WIDTHS_MOST];
    for (uint32_t k = 0, kinds = dp_widths_list(list); k < kinds; k++)
        for (int style = 0; style < DP_SHADING_COUNT; style++)
            for (int mode = 0; mode < 4; mode++) {
                static const uint32_t lengths[4] = {1, 15, 33, DP_TILE};
                const uint32_t n = lengths[mode] < DP_TILE ? lengths[mode] : DP_TILE;
                uint32_t a[DP_TILE], b[DP_TILE];
                make_rows(&p, (uint32_t)(100 * style + mode));
                shade_run(plain, style, mode & 1, mode & 2, n, &p, a);
                shade_run(dp_shaders_for(list[k].lanes), style, mode & 1, mode & 2, n, &p, b);
                for (uint32_t i = 0; i < n; i++)
                    if (p.id[1][i] && a[i] != b[i])
                        fail_msg("%s, style %d, mode %d, pixel %u: %x, not %x", list[k].name, style,
                                 mode, i, b[i], a[i]);
            }
}

/* The cartoon map, also by hand: a mean of one surface's colours, weighed 1 2 1 in both
 * directions. */
static void wider_vectors_smooth_the_same(void **state) {
    (void)state;
    static uint8_t colors[3][3 * DP_TILE][4], out[2][DP_TILE][4];
    static float distance[3][3 * DP_TILE];
    static uint16_t id[3][3 * DP_TILE];
    dp_width list[DP_WIDTHS_MOST];
    uint32_t seed = 5;
    for (int y = 0; y < 3; y++)
        for (int x = 0; x < 3 * DP_TILE; x++) {
            for (int k = 0; k < 4; k++) colors[y][x][k] = (uint8_t)random_between(&seed, 0, 256);
            distance[y][x] = random_between(&seed, 1, x % 5 ? 1.05f : 3);
            id[y][x] = x % 13 == 2 ? 1 + DP_MIRROR_GROUP : (uint16_t)random_between(&seed, 1, 3);
        }
    for (int k = 0; k < 3; k++)
        memset(colors[k][DP_TILE + 4], 77, 3 * 4), distance[k][DP_TILE + 5] = 1,
                                                                         id[k][DP_TILE + 5] = 1;
    for (int y = 0; y < 3; y++)
        for (int x = 0; x < 3; x++) distance[y][DP_TILE + 6 + x] = 1, id[y][DP_TILE + 6 + x] = 1;
    dp_smooth_run run = {.color = colors[1][DP_TILE],
                         .out = out[0][0],
                         .id = id[1] + DP_TILE,
                         .distance = distance[1] + DP_TILE,
                         .width = 3 * DP_TILE,
                         .stride = 3 * DP_TILE,
                         .step = 12,
                         .fy = 80,
                         .perspective = true};
    plain->smooth(&run, ~(uint64_t)0);
    uint32_t sum = 0;
    for (int y = 0; y < 3; y++)
        for (int x = 0; x < 3; x++)
            sum +=
                (uint32_t)(1 + (x == 1)) * (uint32_t)(1 + (y == 1)) * colors[y][DP_TILE + 6 + x][2];
    assert_int_equal(out[0][7][2], (sum + 8) / 16);
    assert_int_equal(out[0][5][2], 77); /* a patch */
    run.out = out[1][0];
    for (uint32_t k = 0, kinds = dp_widths_list(list); k < kinds; k++) {
        memset(out[1], 0, sizeof out[1]);
        dp_shaders_for(list[k].lanes)->smooth(&run, ~(uint64_t)0);
        assert_memory_equal(out[0], out[1], sizeof out[0]);
    }
}

static double mean_of(const uint8_t *values, int threshold) {
    int inked = 0;
    for (int i = 0; i < DP_STROKES_SIZE * DP_STROKES_SIZE; i++) inked += values[i] > threshold;
    return (double)inked / (DP_STROKES_SIZE * DP_STROKES_SIZE);
}

/* Built-in strokes: the same every time; the darker the tone the more ink, in small steps. */
static void built_in_strokes_grow_with_darkness(void **state) {
    (void)state;
    static uint8_t values[2][DP_STROKES_SIZE * DP_STROKES_SIZE],
        again[DP_STROKES_SIZE * DP_STROKES_SIZE];
    dp_make_hatching(values[0]);
    dp_make_halftone(values[1]);
    dp_make_hatching(again);
    assert_memory_equal(values[0], again, sizeof again);
    for (int t = 0; t < 2; t++) {
        double before = 0;
        for (int tone = 250; tone >= 0; tone -= 10) {
            const double ink = mean_of(values[t], tone);
            if (!(ink >= before && ink - before < 0.15))
                fail_msg("texture %d, tone %d: %g after %g", t, tone, ink, before);
            before = ink;
        }
        assert_true(before > 0.6);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lambert_is_the_cosine),
        cmocka_unit_test(gooch_is_cool_to_warm),
        cmocka_unit_test(highlights_lie_where_the_light_is_reflected),
        cmocka_unit_test(toon_looks_up_the_nearest_shade),
        cmocka_unit_test(hatching_is_a_smooth_threshold),
        cmocka_unit_test(wider_vectors_shade_the_same),
        cmocka_unit_test(wider_vectors_smooth_the_same),
        cmocka_unit_test(built_in_strokes_grow_with_darkness),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
