/* Colours as files write them. */
#ifndef DP_IO_COLOR_H
#define DP_IO_COLOR_H

#include <stdint.h>

/* A share of `most`; NaN is 0. */
static inline uint32_t dp_color_byte(float value, float most) {
    const float share = value / most;
    return share > 0 ? share >= 1 ? 255 : (uint32_t)(share * 255 + 0.5f) : 0;
}

/* 0xRRGGBB and full alpha, of shares of `most`. */
static inline uint32_t dp_color_of(const float rgb[3], float most) {
    return dp_color_byte(rgb[0], most) << 24 | dp_color_byte(rgb[1], most) << 16 |
           dp_color_byte(rgb[2], most) << 8 | 255;
}

/* The same where files write shares of 1 or of 255, and only values above 1 tell: *most is 1 at
 * first. */
static inline uint32_t dp_color_guess(const float rgb[3], float *most) {
    if (rgb[0] > 1 || rgb[1] > 1 || rgb[2] > 1) *most = 255;
    return dp_color_of(rgb, *most);
}

#endif
