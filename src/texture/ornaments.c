/* Ornaments: patterns for wide lines, each a function from (u, v) in [0, 1]² to ink in [0, 1] that
 * repeats along u. On outlines v = 0 is the edge, and 1 lies outside; elsewhere they run across.
 * Borders are soft over about a texel; the pyramid does the rest. */
#include "texture/rules.h"

static const float SOFT = 0.012f;

/* 1 inside, where `inside` is above 0. */
static float cover(float inside) { return dp_minf(dp_maxf(0.5f + inside / (2 * SOFT), 0), 1); }

/* Distance to the nearest whole number. */
static float to_whole(float x) { return fabsf(x - floorf(x + 0.5f)); }

/* A triangular wave, 0 to 1, one swing per unit. */
static float zigzag(float x) { return 2 * to_whole(x); }

/* Slanted strokes between two rules. Two strokes to a repeat as long as the line is wide. */
float dp_rule_hatch(float u, float v, uint32_t seed) {
    (void)seed;
    const float stroke = cover((0.11f - to_whole(2 * u + v)) * 0.45f);
    const float rule = cover(dp_maxf(0.07f - v, v - 0.93f));
    return dp_maxf(stroke, rule);
}

/* Two strands laid round each other: slanted S-shaped strokes between two rims. */
float dp_rule_rope(float u, float v, uint32_t seed) {
    (void)seed;
    const float rim = 0.06f, w = 2 * v - 1, bent = 0.5f * w + 0.22f * w * (1 - w * w);
    const float bulge = 0.90f + 0.10f * (1 - 4 * to_whole(u + bent) * to_whole(u + bent));
    const float body = bulge - fabsf(w);
    const float strand = cover((0.07f - to_whole(u + bent)) * 0.8f);
    const float border = cover((2 * rim - fabsf(body)) * 0.5f);
    return cover(0.5f * (body + 2 * rim)) * dp_maxf(strand, border);
}

/* A sine that swings across the line. */
float dp_rule_waves(float u, float v, uint32_t seed) {
    (void)seed;
    /* three parabolas a turn are close enough to a sine */
    const float t = u - floorf(u), half = t < 0.5f ? t : t - 0.5f, arch = 16 * half * (0.5f - half);
    const float y = 0.5f + (t < 0.5f ? 0.34f : -0.34f) * arch, slope = 1.1f;
    return cover((0.14f - fabsf(v - y)) / slope);
}

/* Two rows of squares. */
float dp_rule_checks(float u, float v, uint32_t seed) {
    (void)seed;
    const float x = to_whole(u + 0.25f) - 0.25f, y = v - 0.5f;
    return x * y > 0 ? cover(dp_minf(fabsf(x), fabsf(y))) : 1 - cover(dp_minf(fabsf(x), fabsf(y)));
}

/* Arrows along the line. */
float dp_rule_chevrons(float u, float v, uint32_t seed) {
    (void)seed;
    return cover((0.25f - to_whole(u + 0.5f * zigzag(v))) * 0.7f);
}

/* Scallops that hang on the edge, each with a hole. */
float dp_rule_lace(float u, float v, uint32_t seed) {
    (void)seed;
    const float x = to_whole(u) * 0.8f, y = v - 0.42f;
    const float r = sqrtf(x * x + y * y);
    const float scallop = dp_maxf(0.48f - r, dp_minf(0.42f - v, 0.4f));
    const float hole = 0.22f - r, band = 0.10f - v;
    return dp_maxf(cover(dp_minf(scallop, -hole)), cover(band));
}

/* The Greek key: hooks on a rule that runs along the edge, on a grid of 6 by 5 squares. */
float dp_rule_meander(float u, float v, uint32_t seed) {
    static const char *const rows[5] = {"######", "#.....", "#.###.", "#...#.", "#####."};
    (void)seed;
    const uint32_t column = (uint32_t)(u * 6) % 6, row = (uint32_t)(v * 5) % 5;
    return rows[row][column] == '#';
}
