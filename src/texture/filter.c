/* Filtering a texture: the mean over a pixel's share of it, so that patterns that run into the
 * distance turn to an even tone instead of moiré.
 *
 *     what a sample stands for is a box of du repeats times dv of the texture's height
 *     level     of the pyramid: that at which the box's shorter side is a texel, between two levels
 *               a mean of both
 *     samples   along the box's longer side as many as it is texels long there, at most MOST; where
 *               that is not enough, a coarser level
 *
 * A line is narrow and long, so a texture is often seen small across and large along: a level alone
 * would blur the one or leave the other jagged. */
#include "texture/texture.h"

#include "base/vec.h"

enum { MOST = 12 };

/* The mean along the longer side, at one level. */
static dp_texel mean_along(const dp_texture *t, uint32_t level, float u, float v, float du,
                           float dv, uint32_t count) {
    dp_texel sum = {0, 0, 0, 0};
    for (uint32_t i = 0; i < count; i++) {
        const float off = ((float)i + 0.5f) / (float)count - 0.5f;
        const dp_texel one = dp_texture_sample(t, level, u + off * du, v + off * dv);
        sum.r += one.ink * one.r, sum.g += one.ink * one.g, sum.b += one.ink * one.b;
        sum.ink += one.ink;
    }
    if (sum.ink > 0) sum.r /= sum.ink, sum.g /= sum.ink, sum.b /= sum.ink;
    sum.ink /= (float)count;
    return sum;
}

static dp_texel mix(dp_texel a, dp_texel b, float t) {
    const float x = a.ink * (1 - t), y = b.ink * t, ink = x + y;
    if (!(ink > 0)) return (dp_texel){0, 0, 0, 0};
    return (dp_texel){(a.r * x + b.r * y) / ink, (a.g * x + b.g * y) / ink,
                      (a.b * x + b.b * y) / ink, ink};
}

dp_texel dp_texture_filtered(const dp_texture *t, float u, float v, float du, float dv) {
    /* whole repeats have no remainder that would beat with the pixels */
    if (du >= 0.75f) du = dp_maxf(floorf(dp_minf(du, 1e6f) + 0.5f), 1);
    const float along = du * (float)t->width[0], across = dv * (float)t->height[0]; /* texels */
    const float longer = dp_maxf(along, across), shorter = dp_minf(along, across);
    float size = dp_maxf(dp_maxf(shorter, longer / MOST), 1);
    uint32_t level = 0;
    for (; size >= 2 && level + 1 < t->levels; size /= 2) level++;
    const float texels = longer / (float)(1u << level);
    const uint32_t count = texels > 1 ? (uint32_t)dp_minf(texels + 0.999f, MOST) : 1;
    const float step_u = along >= across ? du : 0, step_v = along >= across ? 0 : dv;
    const dp_texel fine = mean_along(t, level, u, v, step_u, step_v, count);
    if (!(size > 1) || level + 1 >= t->levels) return fine;
    const dp_texel coarse =
        mean_along(t, level + 1, u, v, step_u, step_v, count > 1 ? (count + 1) / 2 : 1);
    return mix(fine, coarse, dp_minf(size - 1, 1));
}
