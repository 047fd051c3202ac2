/* A tile's surface to the target: colour, distance and normal, before any ink. */
#include "pipe/classify.h"

#include <string.h>

/* The mean of some samples' colours, not premultiplied. */
typedef struct mean {
    float sum[4]; /* colours weighed by alpha; alpha */
} mean;

static void add_sample(mean *m, dp_color c, float weight) {
    const float alpha = (float)(c & 0xff) * weight;
    for (int k = 0; k < 3; k++) m->sum[k] += alpha * (float)(c >> (24 - 8 * k) & 0xff);
    m->sum[3] += alpha;
}

static void mean_rgba(const mean *m, dp_color paper, float samples, uint8_t out[4]) {
    for (int k = 0; k < 3; k++)
        out[k] = m->sum[3] > 0 ? (uint8_t)(m->sum[k] / m->sum[3] + 0.5f) : (uint8_t)(paper >> (24 - 8 * k));
    out[3] = (uint8_t)(m->sum[3] / samples + 0.5f);
}

static dp_color shown(dp_color surface, dp_color paper) { return surface & 0xff ? surface : paper; }

/* One group: a pixel's colour follows from how many of its samples hold any surface. */
static void shade_one_group(const dp_tile_worker *w, uint32_t x1, uint32_t y1) {
    const dp_target *const target = &w->frame->target;
    const dp_style *const style = &w->frame->styles[0];
    const uint32_t samples = target->samples;
    uint8_t table[17][4];
    for (uint32_t covered = 0; covered <= samples; covered++) {
        mean m = {{0}};
        add_sample(&m, shown(style->surface, style->paper), (float)covered);
        add_sample(&m, style->paper, (float)(samples - covered));
        mean_rgba(&m, style->paper, (float)samples, table[covered]);
    }
    for (uint32_t y = w->tile_y; y < y1; y++) {
        uint8_t *out = target->rgba + (size_t)y * target->rgba_stride + 4 * (size_t)w->tile_x;
        const uint32_t *winner = w->winner + dp_pixel_lane(&w->sampling, 0, y - w->tile_y);
        for (uint32_t x = w->tile_x; x < x1; x++, out += 4, winner += samples) {
            uint32_t covered = 0;
            for (uint32_t i = 0; i < samples; i++) covered += winner[i] != UINT32_MAX;
            memcpy(out, table[covered], 4);
        }
    }
}

static void shade_groups(const dp_tile_worker *w, uint32_t x, uint32_t y) {
    const dp_target *const target = &w->frame->target;
    const size_t lane = dp_pixel_lane(&w->sampling, x - w->tile_x, y - w->tile_y);
    const dp_color paper = w->frame->styles[0].paper;
    mean m = {{0}};
    for (uint32_t i = 0; i < target->samples; i++) {
        const uint32_t winner = w->winner[lane + i];
        const bool none = winner == UINT32_MAX;
        add_sample(&m, none ? paper : shown(dp_polygon_style(w->frame, w->polygons[winner].id)->surface, paper), 1);
    }
    mean_rgba(&m, paper, (float)target->samples, target->rgba + (size_t)y * target->rgba_stride + 4 * (size_t)x);
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
    const bool groups = w->frame->style_count > 1;
    if (target->rgba && !groups) shade_one_group(w, x1, y1);
    for (uint32_t y = w->tile_y; y < y1; y++) {
        for (uint32_t x = w->tile_x; x < x1; x++) {
            if (target->rgba && groups) shade_groups(w, x, y);
            if (target->depth || target->normal) put_geometry(w, x, y);
        }
        if (target->line_class) memset(target->line_class + (size_t)y * target->width + w->tile_x, 0, x1 - w->tile_x);
    }
}
