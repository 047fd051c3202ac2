/* An x-ray's tile, put together from the bottom up:
 *
 *     paper; for each layer k, the last one first:
 *         ink of level k + 1, which lies below that layer and above the next one
 *         the layer's surfaces, and the edges of its edge map
 *     ink of level 0
 *
 * With w(k) the weight of layer k in a pixel, t(k) = 1 - w(0) - … - w(k - 1) is what the layers
 * above let through, as the mean of the pixel's samples. What is seen from layer k on, all of it of weight t(k), is
 *
 *     seen(k) = w(k) color(k) + seen(k + 1);  ink of coverage m below layer k - 1:
 *     seen(k) = (1 - m) seen(k) + m t(k) ink
 *
 * So ink covers what lies below it as in any picture, and the layers above it lie over both. Its coverage is
 * that of the pixel, the layers' is by sample: where a stroke runs along the edge of a layer above,
 * the two count as independent. Invariant: colours are not rounded before the end. */
#include "sink/xray.h"

#include <string.h>

/* Adds a colour of some weight to pixel i. */
static inline void add(dp_xray_tile *t, uint32_t i, const float rgba[4], float weight) {
    const float alpha = rgba[3] * weight;
    for (int c = 0; c < 3; c++) t->rgb[c][i] += rgba[c] * alpha;
    t->alpha[i] += alpha;
    t->weight[i] += weight;
}

static void to_floats(dp_color color, float rgba[4]) {
    for (int c = 0; c < 4; c++) rgba[c] = (float)(color >> (24 - 8 * c) & 0xff);
    rgba[3] /= 255;
}

void dp_xray_paper(const dp_xray *x, const dp_frame *f, uint32_t tile, dp_xray_tile *out) {
    const dp_span s = dp_span_of_tile(f, tile);
    float paper[4];
    to_floats(f->styles[0].paper, paper);
    for (uint32_t i = 0; i < DP_TILE * DP_TILE; i++) out->weight[i] = 1;
    for (uint32_t k = 0; k < x->count; k++) {
        if (!x->layers[k].tiles[tile]) continue;
        for (uint32_t y = s.y0; y < s.y1; y++) {
            float weight[DP_TILE];
            dp_xray_weights(x, f, k, tile, y - s.y0, s.x1 - s.x0, weight);
            float *const left = out->weight + (size_t)(y - s.y0) * DP_TILE;
            for (uint32_t i = 0; i < s.x1 - s.x0; i++) left[i] -= weight[i];
        }
    }
    for (uint32_t i = 0; i < DP_TILE * DP_TILE; i++) {
        const float weight = dp_maxf(out->weight[i], 0);
        for (int c = 0; c < 3; c++) out->rgb[c][i] = paper[c] * (paper[3] * weight);
        out->alpha[i] = paper[3] * weight;
        out->weight[i] = weight;
    }
}

/* A row of a layer, all of one colour, or with colours of their own. */
static void lay_row(dp_xray_tile *out, uint32_t first, uint32_t n, const float *weight,
                    const uint8_t *colors, const float rgba[4]) {
    for (uint32_t i = 0; !colors && i < n; i++) add(out, first + i, rgba, weight[i]);
    for (uint32_t i = 0; colors && i < n; i++) {
        const uint8_t *const p = colors + 4 * (size_t)i;
        const float own[4] = {p[0], p[1], p[2], (float)p[3] / 255};
        if (weight[i] > 0) add(out, first + i, own, weight[i]);
    }
}

/* Lays ink over pixel i. */
static inline void blend(dp_xray_tile *t, uint32_t i, const float rgba[4], float coverage) {
    const float ink = coverage * rgba[3], of = ink * t->weight[i];
    for (int c = 0; c < 3; c++) t->rgb[c][i] = t->rgb[c][i] * (1 - ink) + rgba[c] * of;
    t->alpha[i] = t->alpha[i] * (1 - ink) + of;
}

/* A row of a layer's edge map. */
static void ink_edges(dp_xray_tile *out, uint32_t first, uint32_t n, const uint8_t *ink) {
    for (uint32_t i = 0; i < n; i++, ink += 4) {
        const float rgba[4] = {ink[0], ink[1], ink[2], (float)ink[3] / 255};
        if (ink[3]) blend(out, first + i, rgba, 1);
    }
}

void dp_xray_lay(const dp_xray *x, const dp_frame *f, uint32_t tile, uint32_t k,
                 dp_xray_tile *out) {
    if (k >= x->count || !x->layers[k].tiles[tile]) return;
    const dp_xray_layer *const l = &x->layers[k];
    const dp_span s = dp_span_of_tile(f, tile);
    float rgba[4];
    to_floats(x->color, rgba);
    for (uint32_t y = s.y0; y < s.y1; y++) {
        const size_t at = (size_t)y * f->target.width + s.x0;
        float weight[DP_TILE];
        dp_xray_weights(x, f, k, tile, y - s.y0, s.x1 - s.x0, weight);
        lay_row(out, (y - s.y0) * DP_TILE, s.x1 - s.x0, weight, x->plain ? NULL : l->rgba + 4 * at,
                rgba);
        if (x->edges) ink_edges(out, (y - s.y0) * DP_TILE, s.x1 - s.x0, l->ink + 4 * at);
    }
}

void dp_xray_blend(dp_xray_tile *t, uint32_t row, const float *coverage, uint64_t pixels,
                   dp_color color) {
    float rgba[4];
    to_floats(color, rgba);
    for (uint64_t bits = pixels; bits; bits &= bits - 1) {
        const uint32_t px = (uint32_t)__builtin_ctzll(bits);
        blend(t, row * DP_TILE + px, rgba, coverage[px]);
    }
}

static uint8_t rounded(float v) { return (uint8_t)(dp_minf(v, 255) + 0.5f); }

static void put_pixel(const dp_xray_tile *t, uint32_t i, dp_color paper, uint8_t out[4]) {
    const float alpha = t->alpha[i];
    for (int c = 0; c < 3; c++)
        out[c] = alpha > 0 ? rounded(t->rgb[c][i] / alpha) : (uint8_t)(paper >> (24 - 8 * c));
    out[3] = rounded(255 * alpha);
}

void dp_xray_put(const dp_frame *f, uint32_t tile, const dp_xray_tile *from) {
    const dp_span s = dp_span_of_tile(f, tile);
    const dp_color paper = f->styles[0].paper;
    for (uint32_t y = s.y0; y < s.y1; y++) {
        uint8_t *out = f->target.rgba + (size_t)y * f->target.rgba_stride + 4 * (size_t)s.x0;
        for (uint32_t x = s.x0; x < s.x1; x++, out += 4) {
            const uint32_t i = (y - s.y0) * DP_TILE + x - s.x0;
            if (!(from->alpha[i] > 0.9999f)) {
                put_pixel(from, i, paper, out);
                continue;
            }
            for (int c = 0; c < 3; c++) out[c] = rounded(from->rgb[c][i]);
            out[3] = 255;
        }
    }
}
