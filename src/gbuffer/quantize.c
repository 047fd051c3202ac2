/* The G-buffer in 8 bits per channel, as the paper's texture stores it: RGB normals, alpha distance
 * between near and far (Nienhaus and Döllner 2003, 4.1.1). Shows what 8 bits do to edges. */
#include "gbuffer/gbuffer.h"

/* Rounds to 256 steps of [0, 1]. */
static inline float to_steps(float v) {
    const float clamped = dp_minf(dp_maxf(v, 0), 1);
    return (float)(int32_t)(clamped * 255 + 0.5f) * (1 / 255.0f);
}

static void quantize_row(const dp_gbuffer *g, size_t at, uint32_t n) {
    const float range = g->far_z - g->near_z, inverse = 1 / range, near = g->near_z;
    float *const planes[3] = {g->nx + at, g->ny + at, g->nz + at};
    for (int k = 0; k < 3; k++)
        for (uint32_t i = 0; i < n; i++)
            planes[k][i] = 2 * to_steps(planes[k][i] * 0.5f + 0.5f) - 1;
    for (uint32_t i = 0; i < n; i++) {
        const float z = g->distance[at + i];
        if (!(z < DP_FAR)) continue;
        const float stepped = near + range * to_steps((z - near) * inverse);
        g->distance[at + i] = stepped;
        g->depth[at + i] = g->perspective ? 1 / stepped : -stepped;
    }
}

void dp_gbuffer_quantize(dp_gbuffer *g, uint32_t tile) {
    const uint32_t y0 = tile / g->tiles_x * DP_TILE;
    for (uint32_t row = 0; row < DP_TILE && y0 + row < g->height; row++) {
        uint32_t x0, x1;
        if (dp_gbuffer_span(g, tile, row, &x0, &x1))
            quantize_row(g, (y0 + row) * g->stride + x0, x1 - x0);
    }
}
