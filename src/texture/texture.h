/* Inside a stroke texture: a pyramid of images, each half as large as the one before. */
#ifndef DP_TEXTURE_TEXTURE_H
#define DP_TEXTURE_TEXTURE_H

#include <drypoint/strokes.h>

enum { DP_TEXTURE_LEVELS = 14 };

struct dp_texture {
    dp_allocator memory;
    uint32_t levels;
    bool coloured; /* false: strokes have the line's colour */
    bool has_gaps; /* some columns hold no ink: strokes are interrupted */
    uint32_t width[DP_TEXTURE_LEVELS], height[DP_TEXTURE_LEVELS];
    uint8_t *pixels[DP_TEXTURE_LEVELS]; /* [height][width][4], colours not premultiplied */
};

/* Colours 0 to 255, ink 0 to 1. */
typedef struct dp_texel {
    float r, g, b, ink;
} dp_texel;

/* The level at which a line `px` wide is about as wide as the image is high; the first that is one
 * texel high at most. */
uint32_t dp_texture_level(const dp_texture *texture, float px);

/* Bilinear sample; u repeats, v is clamped to [0, 1]. */
dp_texel dp_texture_sample(const dp_texture *texture, uint32_t level, float u, float v);

/* The mean over a box around (u, v): `du` repeats long, `dv` of the texture's height across
 * (filter.c). */
dp_texel dp_texture_filtered(const dp_texture *texture, float u, float v, float du, float dv);

/* Length of one repeat on a line `px` wide, px. */
static inline float dp_texture_period(const dp_texture *texture, float px) {
    return px * (float)texture->width[0] / (float)texture->height[0];
}

#endif
