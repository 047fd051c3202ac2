/* The cartoon map (Nienhaus and Döllner 2003, 5, "Edge-Enhanced Cartoon-Style Rendering"): the
 * cartoon-shaded picture, smoothed where its patches of one shade meet.
 *
 * Each pixel becomes a mean of its 3 x 3 pixels, weights 1 2 1 in both directions. Neighbours of
 * another group, beyond a step in distance or outside the surface do not count, so that outlines
 * stay sharp. The loop for pixels inside the picture is in cartoon.inc; both give the same bits. */
#include "shade/passes.h"

static const float STEP = 12; /* pixel sizes between neighbours of one surface */

static void smooth_pixel(const dp_shade_store *s, uint32_t x, uint32_t y, uint8_t out[4]) {
    static const uint8_t weights[3] = {1, 2, 1};
    const dp_gbuffer *const g = &s->gbuffer;
    const size_t at = (size_t)y * g->stride + x;
    const float z = g->distance[at], near = STEP * (g->perspective ? z : 1) / g->fy;
    const uint8_t *const centre = s->color + 4 * ((size_t)y * g->width + x);
    if (g->id[at] == 1 + DP_MIRROR_GROUP) { /* a picture that is smooth already */
        for (int k = 0; k < 4; k++) out[k] = centre[k];
        return;
    }
    uint32_t sum[3] = {0, 0, 0}, total = 0;
    for (int dy = -1; dy <= 1; dy++)
        for (int dx = -1; dx <= 1; dx++) {
            const int64_t to = (int64_t)at + dy * (int64_t)g->stride + dx;
            const int64_t px = (int64_t)x + dx, py = (int64_t)y + dy;
            if (px < 0 || py < 0 || px >= g->width || py >= g->height) continue;
            if (g->id[to] != g->id[at] || fabsf(g->distance[to] - z) > near) continue;
            const uint8_t *const c = s->color + 4 * ((size_t)py * g->width + (size_t)px);
            const uint32_t w = (uint32_t)weights[dx + 1] * weights[dy + 1];
            for (int k = 0; k < 3; k++) sum[k] += w * c[k];
            total += w;
        }
    for (int k = 0; k < 3; k++) out[k] = (uint8_t)((sum[k] + total / 2) / total);
    out[3] = centre[3];
}

/* A row of a tile, if all its neighbours lie in the picture. */
static void smooth_row(const dp_shade_store *s, uint32_t x, uint32_t y, uint64_t mask) {
    const dp_gbuffer *const g = &s->gbuffer;
    const size_t at = (size_t)y * g->stride + x, pixel = 4 * ((size_t)y * g->width + x);
    const dp_smooth_run run = {.color = s->color + pixel,
                               .out = s->smooth + pixel,
                               .id = g->id + at,
                               .distance = g->distance + at,
                               .width = g->width,
                               .stride = g->stride,
                               .step = STEP,
                               .fy = g->fy,
                               .perspective = g->perspective};
    s->shaders->smooth(&run, mask);
}

void dp_cartoon_map_tile(dp_shade_store *s, uint32_t tile) {
    const dp_gbuffer *const g = &s->gbuffer;
    const uint32_t first = tile / g->tiles_x * DP_TILE, tile_x = tile % g->tiles_x * DP_TILE;
    const uint32_t n = g->width - tile_x < DP_TILE ? g->width - tile_x : DP_TILE;
    for (uint32_t row = 0; row < DP_TILE && first + row < g->height; row++) {
        const uint32_t y = first + row;
        const uint64_t mask = g->mask[(size_t)tile * DP_TILE + row];
        if (!mask) continue;
        if (y > 0 && y + 1 < g->height && tile_x > 0 && tile_x + n < g->width) {
            smooth_row(s, tile_x, y, mask);
            continue;
        }
        for (uint64_t bits = mask; bits; bits &= bits - 1) {
            const uint32_t x = tile_x + (uint32_t)__builtin_ctzll(bits);
            smooth_pixel(s, x, y, s->smooth + 4 * ((size_t)y * g->width + x));
        }
    }
}
