/* Blending ink over one pixel, in 8 bits per channel. */
#ifndef DP_CORE_BLEND_H
#define DP_CORE_BLEND_H

#include <drypoint/style.h>

/* The operator `over` (Porter and Duff 1984), not premultiplied, 8 bits per channel. */
static inline void dp_blend(uint8_t *pixel, dp_color color, float coverage) {
    const float source = coverage * (float)(color & 0xff) / 255, under = (float)pixel[3] / 255;
    const float alpha = source + under * (1 - source);
    if (!(alpha > 0)) return;
    for (int i = 0; i < 3; i++) {
        const float c = (float)(color >> (24 - 8 * i) & 0xff);
        const float mixed = (c * source + (float)pixel[i] * under * (1 - source)) / alpha;
        pixel[i] = (uint8_t)(mixed + 0.5f);
    }
    pixel[3] = (uint8_t)(alpha * 255 + 0.5f);
}

#endif
