/* A tile's surface to the target: colour, distance and normal, before any ink. */
#include "pipe/classify.h"

static void put_pixel(const dp_tile_worker *w, uint32_t x, uint32_t y) {
    const dp_target *const target = &w->frame->target;
    const uint32_t samples = target->samples;
    const size_t lane = dp_pixel_lane(&w->sampling, x - w->tile_x, y - w->tile_y);
    const dp_color paper = w->frame->styles[0].paper;
    float sum[4] = {0, 0, 0, 0};
    for (uint32_t i = 0; i < samples; i++) {
        const uint32_t winner = w->winner[lane + i];
        dp_color c = paper;
        if (winner != UINT32_MAX) {
            const dp_color surface = dp_polygon_style(w->frame, w->polygons[winner].id)->surface;
            if (surface & 0xff) c = surface;
        }
        const float alpha = (float)(c & 0xff);
        for (int k = 0; k < 3; k++) sum[k] += alpha * (float)(c >> (24 - 8 * k) & 0xff);
        sum[3] += alpha;
    }
    uint8_t *const out = target->rgba + (size_t)y * target->rgba_stride + 4 * (size_t)x;
    for (int k = 0; k < 3; k++) out[k] = (uint8_t)(sum[3] > 0 ? sum[k] / sum[3] + 0.5f : (float)(paper >> (24 - 8 * k) & 0xff));
    out[3] = (uint8_t)(sum[3] / (float)samples + 0.5f);
}

static void put_geometry(const dp_tile_worker *w, uint32_t x, uint32_t y) {
    const dp_target *const target = &w->frame->target;
    const size_t lane = dp_pixel_lane(&w->sampling, x - w->tile_x, y - w->tile_y);
    const size_t pixel = (size_t)y * target->width + x;
    const uint32_t winner = w->winner[lane];
    const bool none = winner == UINT32_MAX;
    if (target->depth)
        target->depth[pixel] = none ? INFINITY : (float)dp_distance(&w->frame->view, w->depth[lane]);
    if (!target->normal) return;
    dp_vec3 n = {0, 0, 0};
    if (!none) {
        n = dp_polygon_normal(w->frame, w->polygons[winner].id);
        if (!(w->polygons[winner].flags & DP_POLYGON_FRONT)) n = dp_scale(n, -1);
    }
    float *const out = target->normal + 3 * pixel;
    out[0] = (float)n.x, out[1] = (float)n.y, out[2] = (float)n.z;
}

void dp_tile_surface(dp_tile_worker *w) {
    const dp_target *const target = &w->frame->target;
    const uint32_t x1 = w->tile_x + DP_TILE < target->width ? w->tile_x + DP_TILE : target->width;
    const uint32_t y1 = w->tile_y + DP_TILE < target->height ? w->tile_y + DP_TILE : target->height;
    for (uint32_t y = w->tile_y; y < y1; y++)
        for (uint32_t x = w->tile_x; x < x1; x++) {
            if (target->rgba) put_pixel(w, x, y);
            if (target->depth || target->normal) put_geometry(w, x, y);
            if (target->line_class) target->line_class[(size_t)y * target->width + x] = 0;
        }
}
