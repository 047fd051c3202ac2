/* The built-in stroke textures. Every texel holds its priority: the tone below which it is inked
 * (Freudenberg, Masuch and Strothotte, Real-Time Halftoning, 2002). They are computed, always the
 * same: an integer generator, and lattices that wrap around.
 *
 * Hatching: three directions of strokes, the second for dark tones, the third for the darkest.
 * Within a direction, lines come in bit-reversed order, so that the first ones are far apart and
 * each later one falls between them. A line is broken into strokes of uneven length that waver a
 * little. Priority falls off across a stroke: it begins thin and widens as it gets darker.
 *
 * Dots: the cosine screen, turned by 22.6 degrees; a texel's height in it is its priority. */
#include "shade/shade.h"

#include "base/elementary.h"

#include <string.h>

enum { SIZE = DP_STROKES_SIZE, LINES = 32 };

static uint32_t next_random(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

static float between(uint32_t *state, float low, float high) {
    return low + (high - low) * (float)(next_random(state) & 0xffff) / 65536;
}

static uint32_t reversed(uint32_t v, uint32_t bits) {
    uint32_t r = 0;
    for (uint32_t i = 0; i < bits; i++) r |= (v >> i & 1) << (bits - 1 - i);
    return r;
}

/* Texel (a, b) along and across direction d: 0 along u, 1 along v, 2 diagonal. Wraps around. */
static uint8_t *texel(uint8_t *values, int d, int a, int b) {
    const int u = d == 0 ? a : b, v = d == 0 ? b : d == 1 ? a : a + b;
    const int x = d == 2 ? a : u;
    return &values[(v & (SIZE - 1)) * SIZE + (x & (SIZE - 1))];
}

/* Draws a stroke from `from` on, `length` texels long, at `across`. priority: 0 to 255. */
static void draw_stroke(uint8_t *values, int d, int from, int length, float across, float priority,
                        uint32_t *seed) {
    const float bend = between(seed, -2, 2), tilt = between(seed, -1, 1);
    for (int i = 0; i < length; i++) {
        const float t = (float)i / (float)length,
                    ends = dp_minf(dp_minf((float)i, (float)(length - 1 - i)) / 10 + 0.3f, 1);
        const float centre = across + bend * 4 * t * (1 - t) + tilt * (t - 0.5f);
        const float half = 1.9f * ends; /* texels */
        for (int b = (int)floorf(centre - 3); b <= (int)ceilf(centre + 3); b++) {
            const float off = fabsf((float)b - centre),
                        falloff = dp_minf(dp_maxf(1.25f - off / half, 0), 1);
            const float value = priority * falloff;
            uint8_t *const to = texel(values, d, from + i, b);
            if (value > (float)*to) *to = (uint8_t)(value + 0.5f);
        }
    }
}

static void draw_direction(uint8_t *values, int d, float highest, float lowest, uint32_t *seed) {
    for (uint32_t k = 0; k < LINES; k++) {
        const float across =
            ((float)reversed(k, 5) + 0.5f) * SIZE / LINES + between(seed, -1.2f, 1.2f);
        const float priority = highest + (lowest - highest) * (float)k / (LINES - 1);
        int at = (int)(next_random(seed) & (SIZE - 1));
        const int end = at + SIZE;
        while (at < end) {
            const int wanted = (int)between(seed, 50, 120),
                      length = end - at < wanted + 20 ? end - at : wanted;
            draw_stroke(values, d, at, length, across, priority * between(seed, 0.9f, 1), seed);
            at += length - (int)between(seed, 0, 8);
            if (end - at < 12) break;
        }
    }
}

void dp_make_hatching(uint8_t *values) {
    uint32_t seed = 20030203;
    memset(values, 0, (size_t)SIZE * SIZE);
    draw_direction(values, 0, 250, 100, &seed);
    draw_direction(values, 1, 125, 45, &seed);
    draw_direction(values, 2, 60, 12, &seed);
}

void dp_make_halftone(uint8_t *values) {
    /* Waves per side: the lattice of dots, hypot(A, B) = 26 per side, wraps around. */
    enum { A = 24, B = 10 };
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            const double step = 2 * 3.14159265358979323846 / SIZE;
            const double height =
                0.5 + 0.25 * (dp_cos(step * (A * x + B * y)) + dp_cos(step * (A * y - B * x)));
            values[y * SIZE + x] = (uint8_t)(4 + 247 * height + 0.5);
        }
}
