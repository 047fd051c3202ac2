/* Kernels that ink: all agree with plain C, bit for bit, and plain C with the definition. With
 * DRYPOINT_BENCH set, times are printed. */
#include "sink/kernels.h"
#include "core/blend.h"
#include "core/frame.h"
#include "sink/raster.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "kernel_tests.h"

/* Strokes of any length and width, also a point, with and without polygons, in both kinds of
 * views. */
static dp_stroke random_stroke(uint32_t *seed) {
    dp_stroke s = {.half_width = (float)(next_random(seed) % 4000) / 100,
                   .line = (uint8_t)(next_random(seed) % DP_LINE_COUNT)};
    float *const ends[2] = {&s.a.x, &s.b.x};
    for (int e = 0; e < 2; e++)
        for (int k = 0; k < 3; k++)
            ends[e][k] = (float)(next_random(seed) % 6400) / 100 + (float)(k == 2);
    if (next_random(seed) % 5 == 0) s.b = s.a;
    for (int p = 0; p < 2; p++)
        for (int k = 0; k < 3; k++)
            s.plane[p][k] = next_random(seed) % 3 ? (float)(next_random(seed) % 100) / 50 - 1 : NAN;
    return s;
}

enum { TILE_X = 64, TILE_PIXELS = DP_TILE * DP_TILE };

/* Share of pixel (x, y) of the tile that a stroke covers, by the definition, and dp_stroke_limit.
 */
static double defined_share(const dp_frame *frame, const dp_stroke *s, uint32_t x, uint32_t y,
                            float *limit) {
    const double ex = (double)s->b.x - s->a.x, ey = (double)s->b.y - s->a.y,
                 length2 = ex * ex + ey * ey;
    const double px = TILE_X + x + 0.5 - s->a.x, py = y + 0.5 - s->a.y;
    const double t = length2 > 0 ? dp_min(dp_max((px * ex + py * ey) / length2, 0), 1) : 0;
    const double distance = hypot(px - t * ex, py - t * ey), half = (double)s->half_width;
    *limit = dp_stroke_limit(frame, s, (float)(TILE_X + x) + 0.5f, (float)y + 0.5f, (float)t,
                             (float)distance);
    return dp_min(dp_max(dp_min(distance + 0.5, half) - dp_max(distance - 0.5, -half), 0), 1);
}

/* The plain kernel by the definition: the largest share of what was covered before and is now, as
 * far as samples lie no nearer than the limit; those that lie near it are not asked. */
static void expect_cover(const dp_frame *frame, const dp_stroke *s, const dp_ink_patch *patch,
                         const dp_ink_worker *before, const dp_ink_worker *after) {
    const uint32_t samples = frame->target.samples;
    for (uint32_t i = 0; i < TILE_PIXELS; i++) {
        const uint32_t x = i % DP_TILE, y = i / DP_TILE;
        const double had = before->row[y] >> x & 1 ? (double)before->coverage[i] : 0,
                     has = after->row[y] >> x & 1 ? (double)after->coverage[i] : 0;
        float limit;
        double share = 0;
        uint32_t seen = 0, close = 0;
        if (x >= patch->x0 && x < patch->x1 && y >= patch->y0 && y < patch->y1)
            share = defined_share(frame, s, x, y, &limit);
        for (uint32_t k = 0; k < samples && share > 0; k++) {
            const float depth = patch->depth ? patch->depth[i * samples + k] : -FLT_MAX;
            seen += depth <= limit;
            close += fabsf(depth - limit) < 1e-3f * (1 + fabsf(limit));
        }
        if (!close) assert_float_equal(has, dp_max(had, share * seen / samples), 1e-4);
    }
}

static dp_ink_patch random_patch(const float *depth, uint32_t *seed) {
    const uint32_t x0 = next_random(seed) % DP_TILE, y0 = next_random(seed) % DP_TILE;
    const uint32_t x1 = x0 + 1 + next_random(seed) % DP_PATCH,
                   y1 = y0 + 1 + next_random(seed) % DP_PATCH;
    return (dp_ink_patch){.tile_x = TILE_X,
                          .x0 = x0,
                          .y0 = y0,
                          .x1 = x1 < DP_TILE ? x1 : DP_TILE,
                          .y1 = y1 < DP_TILE ? y1 : DP_TILE,
                          .depth = next_random(seed) % 4 ? depth : NULL};
}

static void covers_agree(void **state) {
    enum { STROKES = 400 };
    static const uint32_t samples[4] = {1, 4, 8, 16};
    static float depth[16 * TILE_PIXELS];
    static dp_ink_worker before, truth, w;
    dp_width list[DP_WIDTHS_MOST];
    const uint32_t count = dp_widths_list(list);
    uint32_t seed = 3;
    double spent[DP_WIDTHS_MOST] = {0};
    (void)state;
    for (uint32_t i = 0; i < 16 * TILE_PIXELS; i++)
        depth[i] = (float)(next_random(&seed) % 6400) / 100;
    for (uint32_t i = 0; i < TILE_PIXELS; i++) before.coverage[i] = (float)(i % 7) / 6;
    for (uint32_t k = 0; k < STROKES; k++) {
        const dp_frame frame = {.view = make_view(k % 2),
                                .target.samples = samples[k / 2 % 4],
                                .step_scale = k % 2 ? 0 : 1e-3f,
                                .step_offset = k % 2 ? 1e-2f : 0};
        const dp_stroke s = random_stroke(&seed);
        const dp_ink_patch patch = random_patch(depth, &seed);
        for (uint32_t y = 0; y < DP_TILE; y++) before.row[y] = 0xf0f0f0f0f0f0f0f0u << k % 5;
        truth = before;
        dp_sink_kernels_plain.cover(&frame, &s, &patch, &truth);
        expect_cover(&frame, &s, &patch, &before, &truth);
        for (uint32_t i = 0; i < count; i++) {
            w = before;
            const double start = now_ns();
            dp_sink_kernels_for(list[i].lanes)->cover(&frame, &s, &patch, &w);
            spent[i] += now_ns() - start;
            assert_memory_equal(w.row, truth.row, sizeof w.row);
            assert_memory_equal(w.coverage, truth.coverage, sizeof w.coverage);
        }
    }
    for (uint32_t i = 0; i < count && getenv("DRYPOINT_BENCH"); i++)
        print_message("%-10s %-7s %6.2f ns a patch\n", "cover", list[i].name, spent[i] / STROKES);
}

/* Ink over a row of a tile, against dp_blend. */
static void layings_agree(void **state) {
    dp_width list[DP_WIDTHS_MOST];
    const uint32_t count = dp_widths_list(list);
    uint32_t seed = 8;
    (void)state;
    for (uint32_t k = 0; k < 200; k++) {
        const uint32_t width = 1 + next_random(&seed) % DP_TILE;
        const uint64_t in = ~(uint64_t)0 >> (DP_TILE - width),
                       pixels = ((uint64_t)next_random(&seed) << 32 | next_random(&seed)) & in;
        const dp_color color = next_random(&seed);
        uint8_t under[4 * DP_TILE], truth[4 * DP_TILE], row[4 * DP_TILE];
        float coverage[DP_TILE];
        for (uint32_t i = 0; i < DP_TILE; i++)
            coverage[i] = (float)(next_random(&seed) % 101) / 100;
        for (uint32_t i = 0; i < sizeof under; i++) /* some pixels are clear */
            under[i] = i / 4 % 3 ? (uint8_t)next_random(&seed) : 0;
        memcpy(truth, under, sizeof under);
        for (uint32_t i = 0; i < DP_TILE; i++)
            if (pixels >> i & 1) dp_blend(truth + 4 * (size_t)i, color, coverage[i]);
        for (uint32_t i = 0; i < count; i++) {
            memcpy(row, under, sizeof under);
            dp_sink_kernels_for(list[i].lanes)->blend(row, width, coverage, pixels, color);
            assert_memory_equal(row, truth, sizeof truth);
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(covers_agree),
        cmocka_unit_test(layings_agree),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
