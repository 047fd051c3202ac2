/* Inking plain strokes: round-ended capsules with analytic anti-aliasing, over the surface.
 *
 * The coverage of a pixel is the overlap of a box one pixel wide, moved across the stroke, with the
 * stroke's width: exact for straight strokes, and the same on both sides of a joint. Strokes of one
 * class, level and colour are united by the largest coverage, so that joints of many short segments show
 * no seams; then each class is blended over the picture in the order of dp_layers.
 *
 * Only a surface that is clearly nearer than its spine hides a stroke: beside the spine the surface
 * may come nearer (the sides of a valley) and still belong to it, and so may what lies behind the
 * planes of the polygons that meet at the spine (a rounded outline). Strokes are cut where the
 * surface hides them only if outlines are drawn, at which they then end; without outlines a cut
 * looks like a defect, and strokes end round.
 *
 * Hidden lines lie below visible ones, the highest level first, and are not hidden again. */
#include "sink/raster.h"

#include "sink/kernels.h"
#include "sink/xray.h"
#include "core/blend.h"
#include "raster/samples.h"

#include <string.h>

dp_tile_rect dp_stroke_rect(const dp_stroke *s) {
    const float r = s->half_width + 1;
    const float x0 = dp_minf(s->a.x, s->b.x) - r, x1 = dp_maxf(s->a.x, s->b.x) + r;
    const float y0 = dp_minf(s->a.y, s->b.y) - r, y1 = dp_maxf(s->a.y, s->b.y) + r;
    if (!(x1 > x0 && y1 > y0)) return (dp_tile_rect){0};
    return (dp_tile_rect){(int16_t)floorf(x0 / DP_TILE),
                          (int16_t)floorf(y0 / DP_TILE),
                          (int16_t)(floorf(x1 / DP_TILE) + 1),
                          (int16_t)(floorf(y1 / DP_TILE) + 1),
                          0,
                          0};
}

void dp_place_strokes(void *arg, uint32_t first, uint32_t count, dp_tile_rect *rects,
                      uint32_t worker) {
    const dp_inking *const k = arg;
    (void)worker;
    for (uint32_t i = 0; i < count; i++)
        rects[i] = dp_stroke_rect(&dp_inked(k->drawing)[first + i]);
}

static float distance_to(const dp_stroke *s, float x, float y, float *t) {
    const float ex = s->b.x - s->a.x, ey = s->b.y - s->a.y;
    const float length2 = ex * ex + ey * ey;
    const float along = length2 > 0 ? ((x - s->a.x) * ex + (y - s->a.y) * ey) / length2 : 0;
    *t = dp_minf(dp_maxf(along, 0), 1);
    const float dx = x - s->a.x - *t * ex, dy = y - s->a.y - *t * ey;
    return sqrtf(dx * dx + dy * dy);
}

bool dp_stroke_touches(void *arg, uint32_t index, int32_t tile_x, int32_t tile_y, uint32_t worker) {
    const dp_inking *const k = arg;
    const dp_stroke *const s = &dp_inked(k->drawing)[index];
    (void)worker;
    float t;
    const float half = DP_TILE * 0.5f;
    const float d =
        distance_to(s, ((float)tile_x + 0.5f) * DP_TILE, ((float)tile_y + 0.5f) * DP_TILE, &t);
    return d <= half * 1.4143f + s->half_width + 1;
}

typedef struct tile_ink {
    const dp_frame *frame;
    const dp_stroke *strokes; /* of the drawing */
    dp_ink_worker *worker;
    const float *depth; /* the tile's samples; NULL: there is no surface */
    bool hides;         /* strokes are cut where the surface hides them */
    dp_xray_tile *xray; /* what is inked instead of the target; or NULL */
    bool classes;       /* the target's line_class is filled in */
    uint32_t x0, y0;    /* px of the tile's corner */
    uint32_t x1, y1;    /* of its end, within the picture */
} tile_ink;

/* Share of a pixel's samples that lie no nearer than `limit`. */
static float share_behind(const float *depth, uint32_t samples, float limit) {
    if (samples == 1) return *depth <= limit;
    dp_i4 sum = {0, 0, 0, 0};
    for (uint32_t i = 0; i < samples; i += 4)
        sum -= *(const dp_f4 *)(const void *)(depth + i) <= dp_splat(limit);
    return (float)(sum[0] + sum[1] + sum[2] + sum[3]) / (float)samples;
}

static const float *depth_of(const float *tile_depth, uint32_t px, uint32_t py, uint32_t samples) {
    return tile_depth + (size_t)(py * DP_TILE + px) * samples;
}

float dp_visible_share(const dp_frame *frame, const float *tile_depth, uint32_t x0, uint32_t y0,
                       const dp_stroke *s, uint32_t x, uint32_t y, float t, float distance) {
    if (!tile_depth || !(frame->lines & DP_SILHOUETTE)) return 1;
    const uint32_t samples = frame->target.samples;
    const float limit = dp_stroke_limit(frame, s, (float)x + 0.5f, (float)y + 0.5f, t, distance);
    return share_behind(depth_of(tile_depth, x - x0, y - y0, samples), samples, limit);
}

/* Columns of the rows from y0 to y1 that the stroke can reach: the part of the spine within r of
 * them, widened by r. */
static bool rows_span(const dp_stroke *s, float y0, float y1, float r, float *x0, float *x1) {
    const float ey = s->b.y - s->a.y;
    float t0 = 0, t1 = 1;
    if (fabsf(ey) > 1e-6f) {
        const float u = (y0 - r - s->a.y) / ey, v = (y1 + r - s->a.y) / ey;
        t0 = dp_maxf(0, dp_minf(u, v)), t1 = dp_minf(1, dp_maxf(u, v));
        if (t0 > t1) return false;
    }
    const float p = s->a.x + (s->b.x - s->a.x) * t0, q = s->a.x + (s->b.x - s->a.x) * t1;
    *x0 = dp_minf(p, q) - r, *x1 = dp_maxf(p, q) + r;
    return true;
}

static uint32_t clamp_to(float v, uint32_t lo, uint32_t hi) {
    return v <= (float)lo ? lo : v >= (float)hi ? hi : (uint32_t)v;
}

/* Rows of the tile that a stroke may reach: from *y0 to before *y1. */
static void find_rows(const tile_ink *ink, const dp_stroke *s, uint32_t *y0, uint32_t *y1) {
    const float r = s->half_width + 0.5f;
    *y0 = clamp_to(dp_minf(s->a.y, s->b.y) - r, ink->y0, ink->y1);
    *y1 = clamp_to(dp_maxf(s->a.y, s->b.y) + r + 1, ink->y0, ink->y1);
}

/* Asks for the samples under a stroke, of which most are short: so many pixels of each row, as far
 * apart as a line of the cache at four samples a pixel. They lie scattered, and long ago they were
 * drawn. */
static void prefetch_samples(const tile_ink *ink, const dp_stroke *s) {
    enum { APART = 4, MOST = 4 };
    uint32_t y0, y1;
    find_rows(ink, s, &y0, &y1);
    const uint32_t x0 = clamp_to(dp_minf(s->a.x, s->b.x) - s->half_width, ink->x0, ink->x1 - 1);
    const uint32_t x1 = clamp_to(dp_maxf(s->a.x, s->b.x) + s->half_width, ink->x0, ink->x1 - 1);
    const uint32_t from = x0 / APART, to = x1 / APART < from + MOST ? x1 / APART : from + MOST - 1;
    for (uint32_t y = y0; y < y1; y++)
        for (uint32_t k = from; k <= to; k++)
            __builtin_prefetch(
                depth_of(ink->depth, k * APART - ink->x0, y - ink->y0, ink->frame->target.samples));
}

/* Patch by patch, as many rows at a time as one has. */
static void cover(const tile_ink *ink, const dp_stroke *s) {
    uint32_t y0, y1;
    find_rows(ink, s, &y0, &y1);
    dp_ink_patch patch = {
        .tile_x = ink->x0, .tile_y = ink->y0, .depth = ink->hides ? ink->depth : NULL};
    for (uint32_t y = y0; y < y1; y += DP_PATCH) {
        const uint32_t bottom = y + DP_PATCH < y1 ? y + DP_PATCH : y1;
        float from, to;
        if (!rows_span(s, (float)y + 0.5f, (float)bottom - 0.5f, s->half_width + 1, &from, &to))
            continue;
        const uint32_t x0 = clamp_to(from, ink->x0, ink->x1),
                       x1 = clamp_to(to + 1, ink->x0, ink->x1);
        patch.y0 = y - ink->y0, patch.y1 = bottom - ink->y0;
        for (uint32_t x = x0; x < x1; x += DP_PATCH) {
            patch.x0 = x - ink->x0;
            patch.x1 = (x + DP_PATCH < x1 ? x + DP_PATCH : x1) - ink->x0;
            dp_sink_kernels_for(ink->frame->lanes)->cover(ink->frame, s, &patch, ink->worker);
        }
    }
}

/* Lays what is covered over the picture and forgets it. */
static void flush(const tile_ink *ink, dp_line line, dp_color color) {
    const dp_target *const target = &ink->frame->target;
    for (uint32_t py = 0; py < DP_TILE; py++) {
        const uint64_t pixels = ink->worker->row[py];
        const float *const coverage = &ink->worker->coverage[py * DP_TILE];
        const size_t y = ink->y0 + py;
        if (!pixels) continue;
        if (ink->xray)
            dp_xray_blend(ink->xray, py, coverage, pixels, color);
        else if (target->rgba)
            dp_sink_kernels_for(ink->frame->lanes)
                ->blend(target->rgba + y * target->rgba_stride + 4 * (size_t)ink->x0,
                        ink->x1 - ink->x0, coverage, pixels, color);
        for (uint64_t bits = ink->classes ? pixels : 0; bits; bits &= bits - 1) {
            const uint32_t px = (uint32_t)__builtin_ctzll(bits);
            if (coverage[px] >= 0.5f)
                target->line_class[y * target->width + ink->x0 + px] = (uint8_t)(1 + line);
        }
        ink->worker->row[py] = 0;
    }
}

bool dp_fetch_strokes(const dp_inking *k, dp_ink_worker *w, uint32_t tile, size_t *count) {
    const dp_bins *const bins = &k->raster->bins;
    *count = 0;
    if (!dp_reserve(k->frame->memory, &w->strokes, &w->strokes_cap, dp_bins_tile_count(bins, tile),
                    sizeof *w->strokes))
        return false;
    for (uint32_t c = 0; c < bins->chunk_count; c++) {
        const dp_bin_chunk *const chunk = &bins->chunks[c];
        for (uint32_t i = chunk->offsets[tile]; i < chunk->offsets[tile + 1]; i++)
            w->strokes[(*count)++] = chunk->entries[i];
    }
    return true;
}

/* So many strokes ahead they, and the samples under them, are prefetched. */
enum { LATER = 12, SOON = 4 };

/* Layers of ink: classes by level, level 0 is visible. */
enum { LAYERS = (DP_LEVELS + 1) * DP_LINE_COUNT };
static uint32_t layer_of(uint32_t level, uint32_t line) { return level * DP_LINE_COUNT + line; }

/* Puts the tile's strokes in the order of their layers, each one's as they came: `first` is where
 * each begins. */
static bool sort_strokes(const dp_inking *k, dp_ink_worker *w, size_t count,
                         size_t first[LAYERS + 1]) {
    if (!dp_reserve(k->frame->memory, &w->sorted, &w->sorted_cap, count, sizeof *w->sorted))
        return false;
    const dp_stroke *const strokes = dp_inked(k->drawing);
    size_t next[LAYERS] = {0}, sum = 0;
    for (size_t i = 0; i < count; i++) {
        if (i + LATER < count) __builtin_prefetch(&strokes[w->strokes[i + LATER]]);
        const dp_stroke *const s = &strokes[w->strokes[i]];
        next[layer_of(s->level, s->line)]++;
    }
    for (int i = 0; i < LAYERS; i++) {
        const size_t n = next[i];
        first[i] = next[i] = sum;
        sum += n;
    }
    first[LAYERS] = sum;
    for (size_t i = 0; i < count; i++) {
        const dp_stroke *const s = &strokes[w->strokes[i]];
        w->sorted[next[layer_of(s->level, s->line)]++] = w->strokes[i];
    }
    return true;
}

/* Strokes of one class. */
static void ink_layer(const tile_ink *ink, const uint32_t *strokes, size_t count, dp_line line) {
    dp_color color = 0;
    for (size_t i = 0; i < count; i++) {
        const dp_stroke *const s = &ink->strokes[strokes[i]];
        if (i + SOON < count && ink->hides) prefetch_samples(ink, &ink->strokes[strokes[i + SOON]]);
        if (i && s->color != color) flush(ink, line, color);
        color = s->color;
        cover(ink, s);
    }
    if (count) flush(ink, line, color);
}

/* Begins an x-ray's tile; false: out of memory. */
static bool begin_xray(tile_ink *ink, const dp_xray *xray, uint32_t tile) {
    dp_ink_worker *const w = ink->worker;
    if (!dp_reserve(ink->frame->memory, &w->xray, &w->xray_cap, 1, sizeof *w->xray))
        return !(w->failed = true);
    ink->xray = w->xray;
    dp_xray_paper(xray, ink->frame, tile, ink->xray);
    return true;
}

void dp_ink_plain(const dp_inking *k, dp_ink_worker *worker, uint32_t tile) {
    const dp_frame *const frame = k->frame;
    size_t count, first[LAYERS + 1];
    if (!dp_fetch_strokes(k, worker, tile, &count) || !sort_strokes(k, worker, count, first)) {
        worker->failed = true;
        return;
    }
    if (!count && !(k->xray && k->xray->layers[0].tiles[tile])) return;
    const uint32_t x0 = tile % frame->tiles_x * DP_TILE, y0 = tile / frame->tiles_x * DP_TILE;
    const dp_target *const target = &frame->target;
    const bool empty = frame->tile_pieces[tile].empty;
    tile_ink ink = {.frame = frame,
                    .strokes = dp_inked(k->drawing),
                    .worker = worker,
                    .depth = empty ? NULL : frame->depth + (size_t)tile * frame->tile_samples,
                    .x0 = x0,
                    .y0 = y0,
                    .x1 = x0 + DP_TILE < target->width ? x0 + DP_TILE : target->width,
                    .y1 = y0 + DP_TILE < target->height ? y0 + DP_TILE : target->height};
    memset(worker->row, 0, sizeof worker->row);
    if (k->xray && !begin_xray(&ink, k->xray, tile)) return;
    for (uint32_t level = k->drawing->inks_hidden ? DP_LEVELS + 1 : 1; level-- > 0;) {
        ink.hides = !level && !empty && frame->lines & DP_SILHOUETTE;
        ink.classes = target->line_class && (!level || !frame->xray);
        if (k->xray) dp_xray_lay(k->xray, frame, tile, level, ink.xray);
        for (int i = 0; i < DP_LINE_COUNT; i++) {
            const dp_line line = dp_layers[i];
            const size_t *const from = first + layer_of(level, line);
            if (from[1] > from[0])
                ink_layer(&ink, worker->sorted + from[0], from[1] - from[0], line);
        }
    }
    if (k->xray) dp_xray_put(frame, tile, ink.xray);
}
