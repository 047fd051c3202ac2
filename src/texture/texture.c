/* Stroke textures: takes an image as ink, makes its pyramid, samples it.
 *
 * Data structure: levels of RGBA, alpha = ink; each level averages 2 x 2 pixels of the one before,
 * wrapping around in u, colours weighed by ink. Invariant: immutable once made. */
#include "texture/texture.h"

#include "base/diag.h"
#include "base/elementary.h"
#include "base/memory.h"
#include "base/vec.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LARGEST = 8192 };

void dp_texture_destroy(dp_texture *t) {
    if (!t) return;
    const dp_allocator memory = t->memory;
    for (uint32_t i = 0; i < t->levels; i++) dp_free(&memory, t->pixels[i]);
    dp_free(&memory, t);
}

/* ------- an image as ink ------- */

static bool has_alpha(const dp_texture_desc *d) {
    if (d->channels % 2) return false;
    for (uint32_t y = 0; y < d->height; y++) {
        const uint8_t *const row = d->pixels + y * d->stride;
        for (uint32_t x = 0; x < d->width; x++)
            if (row[(size_t)x * d->channels + d->channels - 1] != 255) return true;
    }
    return false;
}

/* The least ink that looks like the pixel on white paper. */
static void ink_on_white(const uint8_t rgb[3], uint8_t out[4]) {
    const uint8_t least = rgb[0] < rgb[1]   ? (rgb[0] < rgb[2] ? rgb[0] : rgb[2])
                          : rgb[1] < rgb[2] ? rgb[1]
                                            : rgb[2];
    const int ink = 255 - least;
    for (int k = 0; k < 3; k++)
        out[k] = (uint8_t)(ink ? (255 * (rgb[k] - least) + ink / 2) / ink : 0);
    out[3] = (uint8_t)ink;
}

static bool is_coloured(const uint8_t p[4]) {
    return p[3] && (abs(p[0] - p[1]) > 8 || abs(p[1] - p[2]) > 8 || abs(p[0] - p[2]) > 8);
}

static void take_pixels(dp_texture *t, const dp_texture_desc *d) {
    const bool alpha = has_alpha(d);
    const uint32_t n = d->channels;
    for (uint32_t y = 0; y < d->height; y++)
        for (uint32_t x = 0; x < d->width; x++) {
            const uint8_t *const in = d->pixels + y * d->stride + (size_t)x * n;
            uint8_t *const out = t->pixels[0] + 4 * ((size_t)y * d->width + x);
            const uint8_t rgb[3] = {in[0], n < 3 ? in[0] : in[1], n < 3 ? in[0] : in[2]};
            if (alpha)
                memcpy(out, rgb, 3), out[3] = in[n - 1];
            else
                ink_on_white(rgb, out);
            t->coloured = t->coloured || is_coloured(out);
        }
}

static bool is_empty_column(const dp_texture *t, uint32_t x) {
    for (uint32_t y = 0; y < t->height[0]; y++)
        if (t->pixels[0][4 * ((size_t)y * t->width[0] + x) + 3]) return false;
    return true;
}

static bool find_gaps(const dp_texture *t) {
    for (uint32_t x = 0; x < t->width[0]; x++)
        if (is_empty_column(t, x)) return true;
    return false;
}

/* ------- the pyramid ------- */

static void average(const uint8_t *const four[4], uint8_t out[4]) {
    uint32_t sums[4] = {0, 0, 0, 0};
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 3; k++) sums[k] += (uint32_t)four[i][k] * four[i][3];
        sums[3] += four[i][3];
    }
    for (int k = 0; k < 3; k++) out[k] = (uint8_t)(sums[3] ? (sums[k] + sums[3] / 2) / sums[3] : 0);
    out[3] = (uint8_t)((sums[3] + 2) / 4);
}

static void halve(const dp_texture *t, uint32_t from) {
    const uint32_t w = t->width[from], h = t->height[from];
    const uint8_t *const in = t->pixels[from];
    for (uint32_t y = 0; y < t->height[from + 1]; y++)
        for (uint32_t x = 0; x < t->width[from + 1]; x++) {
            const uint32_t x0 = 2 * x % w, x1 = (2 * x + 1) % w, y0 = 2 * y,
                           y1 = 2 * y + 1 < h ? 2 * y + 1 : h - 1;
            const uint8_t *const four[4] = {
                in + 4 * ((size_t)y0 * w + x0), in + 4 * ((size_t)y0 * w + x1),
                in + 4 * ((size_t)y1 * w + x0), in + 4 * ((size_t)y1 * w + x1)};
            average(four, t->pixels[from + 1] + 4 * ((size_t)y * t->width[from + 1] + x));
        }
}

static bool add_level(dp_texture *t, uint32_t width, uint32_t height) {
    const uint32_t i = t->levels;
    t->width[i] = width, t->height[i] = height;
    t->pixels[i] = dp_alloc(&t->memory, dp_times((size_t)4 * width, height));
    if (!t->pixels[i]) return false;
    t->levels++;
    return true;
}

static bool add_levels(dp_texture *t) {
    while ((t->height[t->levels - 1] > 1 || t->width[t->levels - 1] > 1) &&
           t->levels < DP_TEXTURE_LEVELS) {
        const uint32_t last = t->levels - 1;
        const uint32_t width = t->width[last] > 1 ? (t->width[last] + 1) / 2 : 1;
        if (!add_level(t, width, (t->height[last] + 1) / 2)) return false;
        halve(t, last);
    }
    return true;
}

dp_result dp_texture_create(const dp_texture_desc *desc, dp_texture **out, dp_diag *diag) {
    if (!desc || !out || !desc->pixels)
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "dp_texture_create: no pixels, or nowhere to put the texture");
    *out = NULL;
    dp_texture_desc d = *desc;
    if (d.width < 1 || d.height < 1 || d.width > LARGEST || d.height > LARGEST)
        return dp_fail(diag, DP_ERR_ARGUMENT, "a texture of %u x %u px; each side must be 1 to %d",
                       d.width, d.height, LARGEST);
    if (d.channels < 1 || d.channels > 4)
        return dp_fail(diag, DP_ERR_ARGUMENT, "a texture with %u channels; it must be 1 to 4",
                       d.channels);
    if (!d.stride) d.stride = (size_t)d.width * d.channels;
    if (d.stride < (size_t)d.width * d.channels)
        return dp_fail(diag, DP_ERR_ARGUMENT, "the texture's stride is less than a row of pixels");
    const dp_allocator memory = dp_allocator_resolve(d.allocator);
    dp_texture *const t = dp_alloc_zeroed(&memory, sizeof *t);
    if (!t) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a texture");
    t->memory = memory;
    bool enough = add_level(t, d.width, d.height);
    if (enough) take_pixels(t, &d);
    t->has_gaps = enough && find_gaps(t);
    enough = enough && add_levels(t);
    if (!enough) {
        dp_texture_destroy(t);
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a texture of %u x %u px", d.width,
                       d.height);
    }
    *out = t;
    return DP_OK;
}

const uint8_t *dp_texture_pixels(const dp_texture *t, uint32_t *width, uint32_t *height) {
    if (width) *width = t ? t->width[0] : 0;
    if (height) *height = t ? t->height[0] : 0;
    return t ? t->pixels[0] : NULL;
}

/* ------- looking it up ------- */

uint32_t dp_texture_level(const dp_texture *t, float px) {
    uint32_t level = 0;
    while (level + 1 < t->levels && t->height[level] > 1 && (float)t->height[level + 1] >= px)
        level++;
    return level;
}

static void mix_in(dp_texel *sum, const uint8_t *p, float weight) {
    const float ink = weight * (float)p[3];
    sum->r += ink * (float)p[0], sum->g += ink * (float)p[1], sum->b += ink * (float)p[2],
        sum->ink += ink;
}

/* floorf without a call, for values well within int. */
static int32_t floor_of(float x) {
    const int32_t i = (int32_t)x;
    return (float)i > x ? i - 1 : i;
}

dp_texel dp_texture_sample(const dp_texture *t, uint32_t level, float u, float v) {
    const int32_t w = (int32_t)t->width[level], h = (int32_t)t->height[level];
    const uint8_t *const pixels = t->pixels[level];
    const float turns = u > -1e6f && u < 1e6f ? u : 0,
                x = (turns - (float)floor_of(turns)) * (float)w - 0.5f;
    const float held = v > 0 ? v < 1 ? v : 1 : 0, y = held * (float)h - 0.5f;
    const int32_t ix = floor_of(x), iy = floor_of(y);
    const int32_t x0 = ix < 0 ? w - 1 : ix < w ? ix : 0, x1 = x0 + 1 < w ? x0 + 1 : 0;
    const int32_t y0 = iy < 0 ? 0 : iy, y1 = iy + 1 < h ? iy + 1 : h - 1;
    const float ax = x - (float)ix, ay = y - (float)iy;
    dp_texel sum = {0, 0, 0, 0};
    mix_in(&sum, pixels + 4 * ((size_t)y0 * (size_t)w + (size_t)x0), (1 - ax) * (1 - ay));
    mix_in(&sum, pixels + 4 * ((size_t)y0 * (size_t)w + (size_t)x1), ax * (1 - ay));
    mix_in(&sum, pixels + 4 * ((size_t)y1 * (size_t)w + (size_t)x0), (1 - ax) * ay);
    mix_in(&sum, pixels + 4 * ((size_t)y1 * (size_t)w + (size_t)x1), ax * ay);
    if (sum.ink > 0) sum.r /= sum.ink, sum.g /= sum.ink, sum.b /= sum.ink;
    sum.ink /= 255;
    return sum;
}

double dp_stroke_polar(double x, double y, double k) {
    const double turns = dp_atan2(y, x) / 6.283185307179586;
    return (turns < 0 ? turns + 1 : turns) + k * dp_hypot(x, y);
}
