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

#include "raster/tile.h"

#include <string.h>

/* ------- memory ------- */

static const dp_array layer_arrays[] = {DP_ARRAY(dp_xray_layer, tiles, tiles_cap),
                                        DP_ARRAY(dp_xray_layer, weight, weight_cap),
                                        DP_ARRAY(dp_xray_layer, rgba, rgba_cap)};
static const dp_array arrays[] = {
    DP_ARRAY(dp_xray, bound, bound_cap), DP_ARRAY(dp_xray, through, through_cap),
    DP_ARRAY(dp_xray, scratch, scratch_cap), DP_ARRAY(dp_xray, lost, lost_cap)};

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

bool dp_xray_begin(dp_xray *x, const dp_frame *f, uint32_t workers, bool shaded) {
    const size_t samples = dp_times(tile_count(f), f->tile_samples);
    const dp_color surface = f->styles[0].surface;
    x->count = 0;
    x->most = f->xray;
    x->shaded = shaded;
    x->plain = !shaded && f->style_count == 1;
    x->color = surface & 0xff ? surface : f->styles[0].paper;
    x->uniform = f->style_count == 1 && !(f->styles[0].mirror.size > 0);
    if (!dp_reserve(f->memory, &x->bound, &x->bound_cap, samples, sizeof *x->bound) ||
        !dp_reserve(f->memory, &x->scratch, &x->scratch_cap, dp_times(workers, f->tile_samples),
                    sizeof *x->scratch) ||
        !dp_reserve(f->memory, &x->lost, &x->lost_cap, workers, sizeof *x->lost) ||
        (!x->uniform &&
         !dp_reserve(f->memory, &x->through, &x->through_cap, samples, sizeof *x->through)))
        return false;
    memset(x->lost, 0, workers * sizeof *x->lost);
    return dp_xray_add_layer(x, f);
}

bool dp_xray_add_layer(dp_xray *x, const dp_frame *f) {
    dp_xray_layer *const l = &x->layers[x->count];
    const size_t pixels = (size_t)f->target.width * f->target.height;
    if (!dp_reserve(f->memory, &l->tiles, &l->tiles_cap, tile_count(f), sizeof *l->tiles) ||
        !dp_reserve(f->memory, &l->weight, &l->weight_cap, pixels, sizeof *l->weight) ||
        (!x->plain && !dp_reserve(f->memory, &l->rgba, &l->rgba_cap, dp_times(4, pixels), 1)))
        return false;
    memset(l->tiles, 0, tile_count(f));
    x->count++;
    return true;
}

/* ------- one layer of a tile ------- */

static uint32_t count_covered(const uint32_t *winner, uint32_t samples) {
    uint32_t sum = 0;
    for (uint32_t i = 0; i < samples; i++) sum += winner[i] != UINT32_MAX;
    return sum;
}

/* Weights where all surfaces are of one opacity: by how many samples there are. */
static void weigh_row(const dp_tile *w, const float table[17], const uint32_t *winner, uint32_t n,
                      float *weight) {
    const uint32_t samples = w->frame->target.samples;
    for (uint32_t x = 0; x < n; x++, winner += samples)
        weight[x] = table[count_covered(winner, samples)];
}

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

static void weigh_tile(const dp_xray *x, const dp_tile *w, uint32_t k, dp_span s) {
    const uint32_t samples = w->frame->target.samples;
    const float opacity = w->frame->styles[0].xray;
    float table[17], passes = opacity / (float)samples;
    for (uint32_t i = 0; i < k; i++) passes *= 1 - opacity;
    for (uint32_t i = 0; i <= samples; i++) table[i] = (float)i * passes;
    for (uint32_t y = s.y0; y < s.y1; y++)
        weigh_row(w, table, w->winner + dp_pixel_lane(&w->sampling, 0, y - s.y0), s.x1 - s.x0,
                  x->layers[k].weight + (size_t)y * w->frame->target.width + s.x0);
}

static void take_pixels(const dp_xray *x, const dp_tile *w, uint32_t k, dp_span s) {
    const dp_xray_layer *const l = &x->layers[k];
    float *const through = x->through + (size_t)w->index * w->frame->tile_samples;
    for (size_t i = 0; !k && i < w->frame->tile_samples; i++) through[i] = 1;
    for (uint32_t y = s.y0; y < s.y1; y++)
        for (uint32_t px = s.x0; px < s.x1; px++) {
            const size_t lane = dp_pixel_lane(&w->sampling, px - s.x0, y - s.y0),
                         at = (size_t)y * w->frame->target.width + px;
            l->weight[at] = take_pixel(x, w, lane, through + lane, l->rgba + 4 * at);
        }
}

/* The next layer begins behind this one; behind what lets nothing through there is none. */
static void put_bounds(const dp_xray *x, const dp_tile *w) {
    const dp_frame *const f = w->frame;
    const size_t first = (size_t)w->index * f->tile_samples;
    float *const bound = x->bound + first;
    for (size_t i = 0; i < f->tile_samples; i++)
        bound[i] = w->winner[i] == UINT32_MAX ? DP_DEPTH_EMPTY : dp_layer_bound(f, w->depth[i]);
    for (size_t i = 0; !x->uniform && i < f->tile_samples; i++)
        if (!(x->through[first + i] > 0)) bound[i] = DP_DEPTH_EMPTY;
}

void dp_xray_take(dp_xray *x, const dp_tile *w, uint32_t k) {
    const dp_span s = dp_span_of_tile(w->frame, w->index);
    x->layers[k].tiles[w->index] = 1;
    if (x->uniform && (x->plain || x->shaded))
        weigh_tile(x, w, k, s);
    else
        take_pixels(x, w, k, s);
    put_bounds(x, w);
}

bool dp_xray_peel(dp_xray *x, dp_tile *w, uint32_t index, uint32_t worker, uint32_t k) {
    const size_t samples = w->frame->tile_samples;
    float *const depth = x->scratch + worker * samples;
    dp_tile_open(w, index);
    if (!x->layers[k - 1].tiles[index]) return false;
    w->finds_edges = w->tests_near_depth = false; /* until the next picture */
    for (size_t i = 0; i < samples; i++) depth[i] = DP_DEPTH_EMPTY;
    w->depth = depth;
    w->bound = x->bound + (size_t)index * samples;
    w->won = 0;
    dp_tile_assemble_fronts(w);
    w->bound = NULL;
    return w->won;
}

void dp_xray_count_lost(dp_xray *x, const dp_tile *w, uint32_t worker) {
    const dp_span s = dp_span_of_tile(w->frame, w->index);
    for (uint32_t y = s.y0; y < s.y1; y++)
        x->lost[worker] += count_covered(w->winner + dp_pixel_lane(&w->sampling, 0, y - s.y0),
                                         (s.x1 - s.x0) * w->frame->target.samples);
}

void dp_xray_take_colors(dp_xray *x, const dp_frame *f, uint32_t index, uint32_t k) {
    const dp_target *const t = &f->target;
    const dp_span s = dp_span_of_tile(f, index);
    if (!x->layers[k].tiles[index]) return;
    for (uint32_t y = s.y0; y < s.y1; y++)
        memcpy(x->layers[k].rgba + 4 * ((size_t)y * t->width + s.x0),
               t->rgba + (size_t)y * t->rgba_stride + 4 * (size_t)s.x0, 4 * (size_t)(s.x1 - s.x0));
}
