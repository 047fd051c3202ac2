/* Writes a tile's surface to the target: colour, distance and normal, before any ink.
 *
 * Colour is the mean of a pixel's samples, weighted by alpha; distance and normal are those of its
 * first sample. Not handled: shading (src/shade), which then paints later. */
#include "raster/tile.h"

#include <string.h>

/* The mean colour of some samples, not premultiplied. */
typedef struct mean {
    float sum[4]; /* sums of alpha * colour; sum of alpha */
} mean;

static void add_sample(mean *m, dp_color c, float weight) {
    const float alpha = (float)(c & 0xff) * weight;
    for (int k = 0; k < 3; k++) m->sum[k] += alpha * (float)(c >> (24 - 8 * k) & 0xff);
    m->sum[3] += alpha;
}

static void mean_rgba(const mean *m, dp_color paper, float samples, uint8_t out[4]) {
    for (int k = 0; k < 3; k++)
        out[k] = m->sum[3] > 0 ? (uint8_t)(m->sum[k] / m->sum[3] + 0.5f)
                               : (uint8_t)(paper >> (24 - 8 * k));
    out[3] = (uint8_t)(m->sum[3] / samples + 0.5f);
}

static dp_color shown(dp_color surface, dp_color paper) { return surface & 0xff ? surface : paper; }

static uint32_t count_covered(const uint32_t *winner, uint32_t samples) {
    dp_i4 sum = {0, 0, 0, 0};
    for (uint32_t i = 0; i < samples; i += 4)
        sum += *(const dp_i4 *)(const void *)(winner + i) != -1;
    return (uint32_t) - (sum[0] + sum[1] + sum[2] + sum[3]);
}

/* With one group of polygons, a pixel's colour depends only on how many of its samples hold a
 * surface. */
static void shade_one_group(const dp_tile *w, uint32_t x1, uint32_t y1) {
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
            memcpy(out,
                   table[samples == 1 ? *winner != UINT32_MAX : count_covered(winner, samples)], 4);
        }
    }
}

static dp_color surface_of(const dp_frame *frame, uint32_t polygon) {
    const dp_style *const style = dp_polygon_style(frame, polygon);
    return style->section && dp_is_section_face(&frame->polygons, polygon) ? style->section
                                                                           : style->surface;
}

/* Colours by 1 + tile polygon, the paper's at 0, where samples of none have theirs. False: no memory. */
static bool list_colors(dp_tile *w) {
    const dp_color paper = w->frame->styles[0].paper;
    if (!DP_TILE_RESERVE(w, w, colors, colors_cap, (size_t)w->polygon_count + 1)) return false;
    w->colors[0] = paper;
    for (uint32_t i = 0; i < w->polygon_count; i++)
        w->colors[i + 1] = shown(surface_of(w->frame, w->polygons[i].id), paper);
    return true;
}

static void put_mean(const dp_tile *w, const uint32_t *winner, uint8_t out[4]) {
    const uint32_t samples = w->frame->target.samples;
    mean m = {{0}};
    for (uint32_t i = 0; i < samples; i++) add_sample(&m, w->colors[winner[i] + 1], 1);
    mean_rgba(&m, w->frame->styles[0].paper, (float)samples, out);
}

/* Most pixels have one colour, although small polygons share them. */
static void shade_groups(dp_tile *w, uint32_t x1, uint32_t y1) {
    const dp_target *const target = &w->frame->target;
    const uint32_t samples = target->samples;
    if (!list_colors(w)) return;
    for (uint32_t y = w->tile_y; y < y1; y++) {
        uint8_t *out = target->rgba + (size_t)y * target->rgba_stride + 4 * (size_t)w->tile_x;
        const uint32_t *winner = w->winner + dp_pixel_lane(&w->sampling, 0, y - w->tile_y);
        for (uint32_t x = w->tile_x; x < x1; x++, out += 4, winner += samples) {
            const dp_color c = w->colors[winner[0] + 1];
            dp_color differ = 0;
            for (uint32_t i = 1; i < samples; i++) differ |= w->colors[winner[i] + 1] ^ c;
            for (int k = 0; k < 4; k++) out[k] = (uint8_t)(c >> (24 - 8 * k));
            if (differ) put_mean(w, winner, out);
        }
    }
}

static void put_geometry(const dp_tile *w, uint32_t x, uint32_t y) {
    const dp_target *const target = &w->frame->target;
    const size_t lane = dp_pixel_lane(&w->sampling, x - w->tile_x, y - w->tile_y);
    const size_t pixel = (size_t)y * target->width + x;
    const uint32_t winner = w->winner[lane];
    const bool none = winner == UINT32_MAX;
    if (target->depth)
        target->depth[pixel] =
            none ? INFINITY : (float)dp_distance(&w->frame->view, w->depth[lane]);
    if (!target->normal) return;
    dp_vec3 n = {0, 0, 0};
    if (!none) {
        n = dp_polygon_normal(w->frame, w->polygons[winner].id);
        if (!(w->polygons[winner].flags & DP_POLYGON_FRONT)) n = dp_scale(n, -1);
    }
    float *const out = target->normal + 3 * pixel;
    out[0] = (float)n.x, out[1] = (float)n.y, out[2] = (float)n.z;
}

typedef struct span {
    uint32_t x0, y0, x1, y1; /* px */
} span;

/* The part of the tile inside the picture. */
static span tile_span(const dp_tile *w) {
    const dp_target *const target = &w->frame->target;
    const uint32_t x1 = w->tile_x + DP_TILE, y1 = w->tile_y + DP_TILE;
    return (span){w->tile_x, w->tile_y, x1 < target->width ? x1 : target->width,
                  y1 < target->height ? y1 : target->height};
}

static void clear_classes(const dp_tile *w, span s) {
    const dp_target *const target = &w->frame->target;
    for (uint32_t y = s.y0; target->line_class && y < s.y1; y++)
        memset(target->line_class + (size_t)y * target->width + s.x0, 0, s.x1 - s.x0);
}

static void clear_ink(const dp_tile *w, span s) {
    uint8_t *const layer = w->frame->ink_layer;
    for (uint32_t y = s.y0; layer && y < s.y1; y++)
        memset(layer + 4 * ((size_t)y * w->frame->target.width + s.x0), 0,
               4 * (size_t)(s.x1 - s.x0));
}

void dp_tile_surface(dp_tile *w) {
    const dp_target *const target = &w->frame->target;
    const span s = tile_span(w);
    const bool paints = target->rgba && !w->frame->painted_later,
               groups = w->frame->style_count > 1 || dp_colors_sections(w->frame);
    clear_classes(w, s);
    clear_ink(w, s);
    if (paints && groups) shade_groups(w, s.x1, s.y1);
    if (paints && !groups) shade_one_group(w, s.x1, s.y1);
    if (!target->depth && !target->normal) return;
    for (uint32_t y = s.y0; y < s.y1; y++)
        for (uint32_t x = s.x0; x < s.x1; x++) put_geometry(w, x, y);
}

/* No polygon touches the tile: it shows paper. */
void dp_tile_empty_surface(dp_tile *w) {
    const dp_target *const target = &w->frame->target;
    const span s = tile_span(w);
    const dp_color paper = w->frame->styles[0].paper;
    const uint8_t rgba[4] = {(uint8_t)(paper >> 24), (uint8_t)(paper >> 16), (uint8_t)(paper >> 8),
                             (uint8_t)paper};
    uint8_t row[4 * DP_TILE];
    for (uint32_t i = 0; i < DP_TILE; i++) memcpy(row + 4 * i, rgba, 4);
    clear_classes(w, s);
    for (uint32_t y = s.y0; y < s.y1; y++) {
        const size_t at = (size_t)y * target->width + s.x0, n = s.x1 - s.x0;
        if (target->rgba)
            memcpy(target->rgba + (size_t)y * target->rgba_stride + 4 * (size_t)s.x0, row, 4 * n);
        for (size_t i = 0; target->depth && i < n; i++) target->depth[at + i] = INFINITY;
        if (target->normal) memset(target->normal + 3 * at, 0, 3 * n * sizeof(float));
    }
}
