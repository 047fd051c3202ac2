/* Puts the ink of a tile's samples into the picture: over what is under it, and as line class.
 *
 * A pixel's colour is the mean of its samples. Its class is the one most samples hold, if at least
 * half of the samples hold ink. */
#include "printed/marks.h"

/* A silhouette is not inked on a back face that is less than this many line widths behind it. */
static const double SPARE = 4;

static dp_line line_of(const dp_printer *w, uint32_t ink) {
    return w->marked ? (dp_line)w->marks[(ink & ~DP_INK_ADDED) - 1].line : dp_ink_line(ink);
}
static uint32_t style_of(const dp_printer *w, uint32_t ink) {
    return w->marked ? w->marks[(ink & ~DP_INK_ADDED) - 1].style : dp_ink_style(ink);
}

/* In open models back faces are seen themselves, and their enlargements meet each other as folds
 * do; only what reaches beyond an outline is a silhouette. Removes the rest. */
static void spare_back_faces(dp_printer *w) {
    for (size_t i = 0; i < w->tile->frame->tile_samples; i++) {
        const uint32_t winner = w->tile->winner[i], ink = w->ink[i];
        if (!ink || line_of(w, ink) != DP_LINE_SILHOUETTE || winner == UINT32_MAX) continue;
        if (w->tile->polygons[winner].flags & DP_POLYGON_FRONT) continue;
        const double width =
            (double)w->tile->frame->styles[style_of(w, ink)].line[DP_LINE_SILHOUETTE].width;
        const double close =
            dp_depth_step(&w->tile->frame->view, (double)w->tile->depth[i], SPARE * width);
        if ((double)w->ink_depth[i] - (double)w->tile->depth[i] < close) w->ink[i] = 0;
    }
}

static dp_color surface_color(const dp_printer *w, size_t lane) {
    const dp_color paper = w->tile->frame->styles[0].paper;
    if (w->tile->winner[lane] == UINT32_MAX) return paper;
    const dp_color surface =
        dp_polygon_style(w->tile->frame, w->tile->polygons[w->tile->winner[lane]].id)->surface;
    return surface & 0xff ? surface : paper;
}

static dp_color ink_color(const dp_printer *w, size_t lane) {
    const uint32_t ink = w->ink[lane];
    if (!ink) return 0;
    if (w->marked) return w->colors[lane];
    return w->tile->frame->styles[dp_ink_style(ink)].line[dp_ink_line(ink)].color;
}

/* Adds one sample to the sum: ink over the surface or paper; over nothing if these are shaded
 * later. */
static void add_sample(const dp_printer *w, size_t lane, float sum[4]) {
    const dp_color under = w->tile->frame->ink_layer ? 0 : surface_color(w, lane);
    const dp_color over = ink_color(w, lane);
    const float a = (float)(over & 0xff) / 255, b = (float)(under & 0xff) / 255 * (1 - a);
    for (int k = 0; k < 3; k++)
        sum[k] +=
            a * (float)(over >> (24 - 8 * k) & 0xff) + b * (float)(under >> (24 - 8 * k) & 0xff);
    sum[3] += a + b;
}

static void put_color(const dp_printer *w, size_t lane, uint8_t out[4]) {
    const uint32_t samples = w->tile->sampling.samples;
    float sum[4] = {0, 0, 0, 0};
    for (uint32_t i = 0; i < samples; i++) add_sample(w, lane + i, sum);
    for (int k = 0; k < 3 && sum[3] > 0; k++) out[k] = (uint8_t)(sum[k] / sum[3] + 0.5f);
    out[3] = (uint8_t)(255 * sum[3] / (float)samples + 0.5f);
}

/* Does a sample count as inked? Not where a pattern leaves it bare. */
static bool counts_as_ink(const dp_printer *w, size_t lane) {
    return w->ink[lane] && (!w->marked || (w->colors[lane] & 0xff) >= 128);
}

/* The class that most samples hold, if at least half of the samples hold ink; else 0. */
static uint8_t class_of(const dp_printer *w, size_t lane) {
    uint32_t counts[DP_LINE_COUNT] = {0}, all = 0;
    uint8_t best = 0;
    for (uint32_t i = 0; i < w->tile->sampling.samples; i++) {
        if (!counts_as_ink(w, lane + i)) continue;
        counts[line_of(w, w->ink[lane + i])]++;
        all++;
    }
    for (uint8_t i = 1; i < DP_LINE_COUNT; i++)
        if (counts[i] > counts[best]) best = i;
    return all > 0 && 2 * all >= w->tile->sampling.samples ? (uint8_t)(best + 1) : 0;
}

static bool has_ink(const dp_printer *w, size_t lane) {
    for (uint32_t i = 0; i < w->tile->sampling.samples; i++)
        if (w->ink[lane + i]) return true;
    return false;
}

static void put_ink(const dp_printer *w) {
    const dp_target *const target = &w->tile->frame->target;
    for (uint32_t y = w->tile->tile_y; y < w->tile->tile_y + DP_TILE && y < target->height; y++)
        for (uint32_t x = w->tile->tile_x; x < w->tile->tile_x + DP_TILE && x < target->width;
             x++) {
            const size_t lane =
                dp_pixel_lane(&w->tile->sampling, x - w->tile->tile_x, y - w->tile->tile_y);
            if (!has_ink(w, lane)) continue;
            if (target->rgba) put_color(w, lane, dp_ink_place(w->tile->frame, x, y));
            if (target->line_class)
                target->line_class[(size_t)y * target->width + x] = class_of(w, lane);
        }
}

void dp_quads_put(dp_printer *w) {
    spare_back_faces(w);
    if (w->marked && !dp_marks_color(w)) return;
    put_ink(w);
}
