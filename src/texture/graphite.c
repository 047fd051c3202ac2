/* The textures of pencil rendering: many strokes along u, and the paper's grain.
 *
 * Each stroke is a soft line that wanders a little, drawn together with its image under half a
 * turn: the texture is the same upside down, as directions on the surface have no sign. It repeats
 * in both directions. */
#include "texture/graphite.h"

#include <math.h>
#include <string.h>

enum { SIZE = DP_GRAPHITE_SIZE, STROKES = 620 };

static uint32_t next(uint32_t *seed) {
    *seed = *seed * 1664525u + 1013904223u;
    uint32_t h = *seed ^ *seed >> 16;
    h *= 0x7feb352du;
    return h ^ h >> 15;
}

static float random01(uint32_t *seed) { return (float)(next(seed) >> 8) / 16777216.0f; }

static uint32_t wrap(int32_t i) { return (uint32_t)(i & (SIZE - 1)); }

/* Multiplies a texel: graphite over graphite gets darker, never black. */
static void darken(float *values, int32_t x, int32_t y, float ink) {
    values[wrap(y) * SIZE + wrap(x)] *= 1 - ink;
    values[wrap(-1 - y) * SIZE + wrap(-1 - x)] *= 1 - ink;
}

static void draw_stroke(float *values, uint32_t *seed) {
    const float x0 = random01(seed) * SIZE, y0 = random01(seed) * SIZE;
    const float length = 70 + 170 * random01(seed), half = 0.7f + 0.9f * random01(seed),
                press = 0.16f + 0.30f * random01(seed);
    const float slope = (random01(seed) - 0.5f) * 0.05f, bend = (random01(seed) - 0.5f) * 5;
    for (int32_t i = 0; (float)i < length; i++) {
        const float t = (float)i / length, ends = 4 * t * (1 - t),
                    fade = ends < 0.4f ? ends / 0.4f : 1;
        const float y = y0 + slope * (float)i + bend * ends;
        for (int32_t k = (int32_t)floorf(y - half - 1); (float)k <= y + half + 1; k++) {
            const float off = fabsf((float)k + 0.5f - y), in = half + 0.5f - off;
            const float cover = in <= 0 ? 0 : in >= 1 ? 1 : in;
            darken(values, (int32_t)x0 + i, k, press * fade * cover);
        }
    }
}

/* The paper's tooth: noise, a little smoothed, with a mean of 0. */
static float grain(uint32_t x, uint32_t y) {
    float sum = 0;
    for (uint32_t k = 0; k < 4; k++) {
        uint32_t h = wrap((int32_t)(x + (k & 1))) * 0x9e3779b1u ^
                     wrap((int32_t)(y + (k >> 1))) * 0x85ebca77u;
        h ^= h >> 15, h *= 0x2c1b3c6du, h ^= h >> 12, h *= 0x297a2d39u, h ^= h >> 15;
        sum += (float)(h >> 8) / 16777216.0f - 0.5f;
    }
    return sum / 2;
}

void dp_make_graphite(uint8_t *out, uint32_t tones, float *scratch) {
    uint32_t seed = 20060712;
    for (size_t i = 0; i < (size_t)SIZE * SIZE; i++) scratch[i] = 1;
    uint32_t drawn = 0;
    for (uint32_t tone = 0; tone < tones; tone++, out += (size_t)SIZE * SIZE) {
        /* A single tone is the middle one. Of several the first is empty, and strokes grow in
         * number so that tones darken evenly. */
        const float share = tones > 1 ? (float)tone / (float)(tones - 1) : 0;
        const uint32_t wanted =
            tones > 1 ? (uint32_t)(share * (0.4f + 2.2f * share) * STROKES) : STROKES;
        for (; drawn < wanted; drawn++) draw_stroke(scratch, &seed);
        for (size_t i = 0; i < (size_t)SIZE * SIZE; i++)
            out[i] = (uint8_t)(scratch[i] * 255 + 0.5f);
    }
}

void dp_make_tooth(int8_t *out) {
    for (uint32_t y = 0; y < SIZE; y++)
        for (uint32_t x = 0; x < SIZE; x++) out[y * SIZE + x] = (int8_t)(127 * grain(x, y));
}
