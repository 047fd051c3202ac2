/* Composition: edges over shades, and pixels that several surfaces share.
 *
 * Edges, in the order of Nienhaus and Döllner 2003, 5, "Technical Illustrations":
 *
 *     color = mix(color, inner edges' colour,   inner strength)      the map's RGB
 *     color = mix(color, profile edges' colour, profile strength)    the map's A
 *
 * Resolving: a pixel's own surface covers `share` of it. The rest is the paper, or the surface of
 * the one of the eight neighbours whose distance comes nearest to `other`.
 *
 * Colours are not premultiplied. */
#include "gbuffer/edge_map.h"
#include "shade/passes.h"

#include <string.h>

/* Lays an edge of this strength (times its alpha) over colour c. */
static void blend(uint8_t c[4], dp_color edge, float strength) {
    const float s = strength * (float)(edge & 0xff) / 255, under = (float)c[3] / 255,
                alpha = s + under * (1 - s);
    if (!(s > 0)) return;
    for (int k = 0; k < 3; k++) {
        const float over = (float)(edge >> (24 - 8 * k) & 0xff);
        c[k] = (uint8_t)((over * s + (float)c[k] * under * (1 - s)) / alpha + 0.5f);
    }
    c[3] = (uint8_t)(alpha * 255 + 0.5f);
}

static void edges_row(dp_shade_store *s, uint32_t y, uint32_t x0, uint32_t x1) {
    const dp_edge_map *const map = &s->frame->styles[0].edge_map;
    const dp_gbuffer *const g = &s->gbuffer;
    dp_edge_run run;
    dp_edge_map_row(g, map, y, x0, x1, &run);
    uint8_t *const out = s->frame->target.edge_map;
    if (out) dp_edge_map_store(&run, x1 - x0, out + 4 * ((size_t)y * g->width + x0));
    if (!s->colored || map->hidden) return;
    uint8_t *const colors = (s->edges ? s->edges : s->shown) + 4 * ((size_t)y * g->width + x0);
    for (uint64_t bits = run.strong; bits; bits &= bits - 1) {
        const uint32_t i = (uint32_t)__builtin_ctzll(bits);
        blend(colors + 4 * (size_t)i, map->inner, run.inner[i]);
        blend(colors + 4 * (size_t)i, map->profile, run.profile[i]);
    }
}

void dp_edges_tile(dp_shade_store *s, uint32_t tile) {
    const dp_gbuffer *const g = &s->gbuffer;
    const uint32_t first = tile / g->tiles_x * DP_TILE;
    for (uint32_t row = 0; row < DP_TILE && first + row < g->height; row++) {
        uint32_t x0, x1;
        if (dp_gbuffer_span(g, tile, row, &x0, &x1)) edges_row(s, first + row, x0, x1);
    }
}

/* ------- resolving ------- */

/* The colour of what covers the rest of pixel (x, y). */
static const uint8_t *other_color(const dp_shade_store *s, const uint8_t *colors, uint32_t x,
                                  uint32_t y, float other) {
    const dp_gbuffer *const g = &s->gbuffer;
    const uint8_t *best = colors + 4 * ((size_t)y * g->width + x);
    float least = INFINITY;
    for (int dy = -1; dy <= 1; dy++)
        for (int dx = -1; dx <= 1; dx++) {
            const int64_t px = (int64_t)x + dx, py = (int64_t)y + dy;
            if ((!dx && !dy) || px < 0 || py < 0 || px >= g->width || py >= g->height) continue;
            const size_t at = (size_t)py * g->stride + (size_t)px;
            const float off = fabsf(g->distance[at] - other);
            if (!g->id[at] || !(off < least)) continue;
            least = off;
            best = colors + 4 * ((size_t)py * g->width + (size_t)px);
        }
    return best;
}

static void mix_colors(const uint8_t a[4], const uint8_t b[4], uint32_t share, uint8_t out[4]) {
    const uint32_t wa = share * a[3], wb = (255 - share) * b[3], sum = wa + wb;
    if (!sum) {
        for (int k = 0; k < 4; k++) out[k] = b[k];
        return;
    }
    for (int k = 0; k < 3; k++) out[k] = (uint8_t)((wa * a[k] + wb * b[k] + sum / 2) / sum);
    out[3] = (uint8_t)((sum + 127) / 255);
}

/* Resolves a pixel that surfaces share. */
static void resolve_pixel(const dp_shade_store *s, const uint8_t background[4], uint32_t x,
                          uint32_t y) {
    const dp_gbuffer *const g = &s->gbuffer;
    const size_t at = (size_t)y * g->stride + x;
    const bool on_paper = g->other[at] >= DP_FAR || dp_gbuffer_is_partial(g, at);
    mix_colors(s->shown + 4 * ((size_t)y * g->width + x),
               on_paper ? background : other_color(s, s->shown, x, y, g->other[at]), g->share[at],
               s->frame->target.rgba + (size_t)y * s->frame->target.rgba_stride + 4 * (size_t)x);
}

/* Takes the lowest run of ones, [*from, *to), out of *bits. */
static void take_run(uint64_t *bits, uint32_t *from, uint32_t *to) {
    *from = (uint32_t)__builtin_ctzll(*bits);
    const uint64_t gaps = ~*bits & ~(((uint64_t)1 << *from) - 1);
    *to = gaps ? (uint32_t)__builtin_ctzll(gaps) : 64;
    *bits = *to == 64 ? 0 : *bits & ~(((uint64_t)1 << *to) - 1);
}

/* Paints paper where a tile with polygons shows none. */
static void paper_row(const dp_shade_store *s, const uint8_t background[4], uint64_t bits,
                      uint32_t tile_x, uint32_t y) {
    const dp_target *const target = &s->frame->target;
    uint8_t *const out = target->rgba + (size_t)y * target->rgba_stride + 4 * (size_t)tile_x;
    while (bits) {
        uint32_t from, to;
        take_run(&bits, &from, &to);
        for (uint32_t x = from; x < to; x++) memcpy(out + 4 * (size_t)x, background, 4);
    }
}

/* Lays what the tiles have inked over the shaded surfaces. */
static void ink_row(const dp_shade_store *s, uint32_t tile_x, uint32_t width, uint32_t y) {
    const dp_target *const target = &s->frame->target;
    const uint8_t *ink = s->frame->ink_layer + 4 * ((size_t)y * target->width + tile_x);
    uint8_t *out = target->rgba + (size_t)y * target->rgba_stride + 4 * (size_t)tile_x;
    for (uint32_t x = 0; x < width; x++, ink += 4, out += 4)
        if (ink[3]) blend(out, DP_RGB(ink[0], ink[1], ink[2]), (float)ink[3] / 255);
}

void dp_resolve_tile(dp_shade_store *s, uint32_t tile) {
    const dp_gbuffer *const g = &s->gbuffer;
    const dp_target *const target = &s->frame->target;
    const dp_color paper = s->frame->xray ? DP_COLOR_NONE /* it lies below all layers */
                                          : s->frame->styles[0].paper;
    const uint8_t background[4] = {(uint8_t)(paper >> 24), (uint8_t)(paper >> 16),
                                   (uint8_t)(paper >> 8), (uint8_t)paper};
    const uint32_t first = tile / g->tiles_x * DP_TILE, tile_x = tile % g->tiles_x * DP_TILE;
    const uint32_t width = g->width - tile_x < DP_TILE ? g->width - tile_x : DP_TILE;
    if (!target->rgba || g->clean[tile]) return;
    for (uint32_t row = 0; row < DP_TILE && first + row < g->height; row++) {
        const uint32_t y = first + row;
        uint64_t bits = g->mask[(size_t)tile * DP_TILE + row];
        if (s->frame->painted_later)
            paper_row(s, background, ~bits & ~(uint64_t)0 >> (64 - width), tile_x, y);
        uint8_t *const out = target->rgba + (size_t)y * target->rgba_stride + 4 * (size_t)tile_x;
        const uint8_t *const own = s->shown + 4 * ((size_t)y * g->width + tile_x);
        while (bits) { /* first all pixels, then the shared ones again */
            uint32_t from, to;
            take_run(&bits, &from, &to);
            memcpy(out + 4 * (size_t)from, own + 4 * (size_t)from, 4 * (size_t)(to - from));
        }
        for (uint64_t shared = g->shared[(size_t)tile * DP_TILE + row]; shared;
             shared &= shared - 1)
            resolve_pixel(s, background, tile_x + (uint32_t)__builtin_ctzll(shared), y);
        if (s->frame->ink_layer) ink_row(s, tile_x, width, y);
    }
}
