/* Peeling surfaces that are seen through (Raskar 2001, 5: "Partially transparent front-facing
 * polygons"; depth peeling: Everitt 2001).
 *
 *     layer 0      what the tile's samples hold: the nearest surface, as in any picture
 *     layer k      draw the tile's front faces again, only what lies behind layer k - 1  dp_xray_peel
 *     each layer   weight of each pixel, and its colour; where the next one begins        dp_xray_take
 *
 * A sample's layers are those of front faces, nearest first, which any order of polygons gives; a
 * back face is one where it is the nearest (of open models). What lies within DP_LAYER_GAP behind a
 * layer is part of it: surfaces that are there twice are one. Let a be the opacity of a sample's
 * layer and T what the layers before it let through, the product of their 1 - a: it adds T a of its
 * colour. A pixel's weight is the mean over its samples, so that edges of layers are as smooth as
 * those of the picture, and what one sample shows of a layer never depends on another one.
 *
 * Data structure: by sample the depth behind which the next layer begins; DP_DEPTH_EMPTY: there is
 * none, nothing lies behind that. Invariant: weights of all layers sum to 1 at most. */
#include "raster/xray.h"

#include "raster/kernels.h"
#include "raster/tile.h"

#include <string.h>

/* ------- memory ------- */

static const dp_array layer_arrays[] = {
    DP_ARRAY(dp_xray_layer, tiles, tiles_cap), DP_ARRAY(dp_xray_layer, covered, covered_cap),
    DP_ARRAY(dp_xray_layer, weight, weight_cap), DP_ARRAY(dp_xray_layer, rgba, rgba_cap),
    DP_ARRAY(dp_xray_layer, ink, ink_cap)};
static const dp_array arrays[] = {
    DP_ARRAY(dp_xray, nearest, nearest_cap), DP_ARRAY(dp_xray, bound, bound_cap),
    DP_ARRAY(dp_xray, through, through_cap), DP_ARRAY(dp_xray, scratch, scratch_cap),
    DP_ARRAY(dp_xray, lost, lost_cap)};

void dp_xray_free(dp_xray *x, const dp_allocator *memory) {
    for (int k = 0; k < DP_LEVELS; k++)
        dp_arrays_free(memory, &x->layers[k], DP_ARRAYS(layer_arrays));
    dp_arrays_free(memory, x, DP_ARRAYS(arrays));
}

uint64_t dp_xray_bytes(const dp_xray *x) {
    uint64_t sum = dp_arrays_bytes(x, DP_ARRAYS(arrays));
    for (int k = 0; k < DP_LEVELS; k++)
        sum += dp_arrays_bytes(&x->layers[k], DP_ARRAYS(layer_arrays));
    return sum;
}

static size_t tile_count(const dp_frame *f) { return (size_t)f->tiles_x * f->tiles_y; }

static dp_color shown_color(const dp_frame *f, uint32_t polygon) {
    const dp_color c = dp_polygon_style(f, polygon)->surface;
    return c & 0xff ? c : f->styles[0].paper;
}

/* By layer and covered samples. */
static void find_weights(dp_xray *x, const dp_frame *f) {
    const float opacity = f->styles[0].xray, samples = (float)f->target.samples;
    float passes = 1;
    for (int k = 0; k < DP_LEVELS; k++) {
        for (int i = 0; i <= 16; i++) x->weight[k][i] = passes * opacity * ((float)i / samples);
        passes *= 1 - opacity;
    }
}

static bool reserve_samples(dp_xray *x, const dp_frame *f, uint32_t workers) {
    const size_t tiles = x->plain ? workers : tile_count(f),
                 samples = dp_times(tiles, f->tile_samples);
    return dp_reserve(f->memory, &x->nearest, &x->nearest_cap, tile_count(f), sizeof *x->nearest) &&
           dp_reserve(f->memory, &x->bound, &x->bound_cap, samples, sizeof *x->bound) &&
           dp_reserve(f->memory, &x->scratch, &x->scratch_cap, dp_times(workers, f->tile_samples),
                      sizeof *x->scratch) &&
           dp_reserve(f->memory, &x->lost, &x->lost_cap, workers, sizeof *x->lost) &&
           (x->uniform ||
            dp_reserve(f->memory, &x->through, &x->through_cap, samples, sizeof *x->through));
}

bool dp_xray_begin(dp_xray *x, const dp_frame *f, uint32_t workers, bool shaded) {
    const dp_color surface = f->styles[0].surface;
    x->count = 0;
    x->most = f->xray;
    x->shaded = shaded;
    x->edges = shaded && f->styles[0].edge_map.detector && !f->styles[0].edge_map.hidden;
    x->uniform = f->style_count == 1 && !(f->styles[0].mirror.size > 0);
    x->plain = x->uniform && !shaded;
    x->color = surface & 0xff ? surface : f->styles[0].paper;
    find_weights(x, f);
    if (!reserve_samples(x, f, workers)) return false;
    memset(x->lost, 0, workers * sizeof *x->lost);
    do
        if (!dp_xray_add_layer(x, f)) return false;
    while (x->plain && x->count < x->most);
    return true;
}

bool dp_xray_add_layer(dp_xray *x, const dp_frame *f) {
    dp_xray_layer *const l = &x->layers[x->count];
    const size_t pixels = (size_t)f->target.width * f->target.height;
    if (!dp_reserve(f->memory, &l->tiles, &l->tiles_cap, tile_count(f), sizeof *l->tiles) ||
        (x->uniform && !dp_reserve(f->memory, &l->covered, &l->covered_cap,
                                   dp_times(tile_count(f), DP_TILE * DP_TILE), 1)) ||
        (!x->uniform &&
         !dp_reserve(f->memory, &l->weight, &l->weight_cap, pixels, sizeof *l->weight)) ||
        (!x->plain && !dp_reserve(f->memory, &l->rgba, &l->rgba_cap, dp_times(4, pixels), 1)) ||
        (x->edges && !dp_reserve(f->memory, &l->ink, &l->ink_cap, dp_times(4, pixels), 1)))
        return false;
    if (x->edges) memset(l->ink, 0, 4 * pixels);
    memset(l->tiles, 0, tile_count(f));
    x->count++;
    return true;
}

static bool has_tiles(const dp_xray_layer *l, size_t tiles) {
    for (size_t i = 0; i < tiles; i++)
        if (l->tiles[i]) return true;
    return false;
}

void dp_xray_settle(dp_xray *x, const dp_frame *f) {
    while (x->count && !has_tiles(&x->layers[x->count - 1], tile_count(f))) x->count--;
}

void dp_xray_weights(const dp_xray *x, const dp_frame *f, uint32_t k, uint32_t tile, uint32_t row,
                     uint32_t n, float *out) {
    const dp_span s = dp_span_of_tile(f, tile);
    const uint8_t *const covered = x->layers[k].covered + ((size_t)tile * DP_TILE + row) * DP_TILE;
    if (x->uniform)
        for (uint32_t i = 0; i < n; i++) out[i] = x->weight[k][covered[i]];
    else
        memcpy(out, x->layers[k].weight + (size_t)(s.y0 + row) * f->target.width + s.x0,
               n * sizeof *out);
}

/* ------- one layer of a tile ------- */

/* Sums over a pixel's samples: weights, and these times alpha, times colour. */
typedef struct sums {
    float weight, alpha, rgb[3];
} sums;

static void add_sample(sums *sum, float weight, dp_color c) {
    const float alpha = weight * (float)(c & 0xff);
    sum->weight += weight;
    sum->alpha += alpha;
    for (int i = 0; i < 3; i++) sum->rgb[i] += alpha * (float)(c >> (24 - 8 * i) & 0xff);
}

static void put_color(const sums *sum, uint8_t out[4]) {
    const bool any = sum->alpha > 0;
    for (int i = 0; i < 3; i++) out[i] = any ? (uint8_t)(sum->rgb[i] / sum->alpha + 0.5f) : 255;
    out[3] = any ? (uint8_t)(sum->alpha / sum->weight + 0.5f) : 0;
}

/* One pixel whose samples may differ. `through`: what passes before the layer, of each sample; the
 * same after it. */
static float take_pixel(const dp_xray *x, const dp_tile *w, size_t lane, float *through,
                        uint8_t *out) {
    const uint32_t samples = w->frame->target.samples;
    sums sum = {0};
    for (uint32_t i = 0; i < samples; i++) {
        const uint32_t winner = w->winner[lane + i];
        if (winner == UINT32_MAX) continue;
        const uint32_t id = w->polygons[winner].id;
        const float opacity = dp_opacity_of(w->frame, id);
        add_sample(&sum, through[i] * opacity, x->shaded ? 0 : shown_color(w->frame, id));
        through[i] *= 1 - opacity;
    }
    if (!x->shaded) put_color(&sum, out);
    return sum.weight / (float)samples;
}

/* What a tile has of arrays by sample. */
static size_t first_sample(const dp_xray *x, const dp_tile *w, uint32_t worker) {
    return (size_t)(x->plain ? worker : w->index) * w->frame->tile_samples;
}

static void take_pixels(const dp_xray *x, const dp_tile *w, uint32_t k, dp_span s) {
    const dp_xray_layer *const l = &x->layers[k];
    float *const through = x->through + first_sample(x, w, 0);
    for (size_t i = 0; !k && i < w->frame->tile_samples; i++) through[i] = 1;
    for (uint32_t y = s.y0; y < s.y1; y++)
        for (uint32_t px = s.x0; px < s.x1; px++) {
            const size_t lane = dp_pixel_lane(&w->sampling, px - s.x0, y - s.y0),
                         at = (size_t)y * w->frame->target.width + px;
            l->weight[at] = take_pixel(x, w, lane, through + lane, l->rgba + 4 * at);
        }
}

/* What lets nothing through has nothing behind it. */
static void stop_behind_opaque(const float *through, size_t samples, float *bound) {
    for (size_t i = 0; i < samples; i++)
        if (!(through[i] > 0)) bound[i] = DP_DEPTH_EMPTY;
}

void dp_xray_take(dp_xray *x, const dp_tile *w, uint32_t worker, uint32_t k) {
    const dp_frame *const f = w->frame;
    const size_t first = first_sample(x, w, worker);
    const bool goes_on = !k || w->deeper;
    uint8_t *const covered =
        x->uniform ? x->layers[k].covered + (size_t)w->index * DP_TILE * DP_TILE : NULL;
    x->layers[k].tiles[w->index] = goes_on ? 2 : 1;
    if (!x->uniform) take_pixels(x, w, k, dp_span_of_tile(f, w->index));
    const float nearest =
        dp_raster_kernels_for(f->lanes)->layer(w, covered, goes_on ? x->bound + first : NULL);
    x->nearest[w->index] =
        nearest > DP_DEPTH_EMPTY ? nearest + dp_depth_steps(f, nearest, DP_CULL_SLACK) : nearest;
    if (!x->uniform && goes_on)
        stop_behind_opaque(x->through + first, f->tile_samples, x->bound + first);
}

/* Draws what lies behind the bounds of the tile that is open. */
static bool peel(dp_xray *x, dp_tile *w, uint32_t worker) {
    const size_t samples = w->frame->tile_samples;
    const bool finds_edges = w->finds_edges, tests_near_depth = w->tests_near_depth;
    float *const depth = x->scratch + worker * samples;
    for (size_t i = 0; i < samples; i++) depth[i] = DP_DEPTH_EMPTY;
    w->finds_edges = w->tests_near_depth = false;
    w->depth = depth;
    w->bound = x->bound + first_sample(x, w, worker);
    w->nearest_bound = x->nearest[w->index];
    w->won = w->deeper = 0;
    dp_tile_assemble_fronts(w);
    w->bound = NULL;
    w->finds_edges = finds_edges, w->tests_near_depth = tests_near_depth;
    return w->won;
}

bool dp_xray_peel(dp_xray *x, dp_tile *w, uint32_t index, uint32_t worker, uint32_t k) {
    if (x->layers[k - 1].tiles[index] < 2) return false;
    dp_tile_open(w, index);
    return peel(x, w, worker);
}

void dp_xray_count_lost(dp_xray *x, const dp_tile *w, uint32_t worker) {
    const dp_span s = dp_span_of_tile(w->frame, w->index);
    const uint32_t samples = w->frame->target.samples;
    for (uint32_t y = s.y0; y < s.y1; y++) {
        const float *const depth = w->depth + dp_pixel_lane(&w->sampling, 0, y - s.y0);
        for (uint32_t i = 0; i < (s.x1 - s.x0) * samples; i++)
            x->lost[worker] += depth[i] > DP_DEPTH_EMPTY;
    }
}

void dp_xray_peel_all(dp_xray *x, dp_tile *w, uint32_t worker) {
    for (uint32_t k = 1; x->layers[k - 1].tiles[w->index] == 2 && !w->failed; k++) {
        if (!peel(x, w, worker)) return; /* winners are not asked for */
        if (k == x->most) {
            dp_xray_count_lost(x, w, worker);
            return;
        }
        dp_xray_take(x, w, worker, k);
    }
}
