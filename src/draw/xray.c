/* An x-ray's layers, one after the other, between the tiles and the ink.
 *
 *     layer 0 was taken as each tile was found (draw.c), and where all surfaces are of one colour and
 *         opacity all others, too
 *     for each next layer, until there is none:
 *         all tiles: peel it, fill the G-buffer with it              raster/xray.c, gbuffer/fill.c
 *         shade it as a picture of its own, into the layer           shade/passes.c
 *     once more, to count the samples that have still more layers
 *
 * They are put together when they are inked (sink/xray.c). Invariant: the target's
 * other planes are those of the nearest surface, as in any picture. */
#include "draw/context.h"

#include "base/diag.h"

void dp_begin_hidden(dp_frame *f) {
    const dp_hidden *const h = &f->styles[0].hidden;
    f->xray = 0;
    for (uint32_t i = 0; i < f->style_count; i++)
        if (f->styles[i].xray > 0 && f->styles[i].xray < 1) f->xray = f->styles[0].xray_layers;
    f->hidden = f->xray ? f->xray : h->look ? h->levels : 0;
    f->hidden_look = f->xray && !h->look ? DP_HIDDEN_SOLID : h->look;
    f->hidden_smooth = h->smooth || (f->xray && !h->look);
}

static void peel_tile(void *arg, uint32_t index, uint32_t worker) {
    dp_context *const c = arg;
    dp_xray *const x = &c->xray;
    dp_tile *const w = &c->finders[worker].tile;
    const uint32_t k = c->xray_layer;
    const bool any = dp_xray_peel(x, w, index, worker, k);
    if (any) dp_xray_take(x, w, worker, k);
    if (!x->shaded) return;
    if (!any) {
        dp_gbuffer_clear(&c->shade.gbuffer, index);
        return;
    }
    dp_gbuffer_fill(&c->shade.gbuffer, w, c->frame.styles[0].shade.normals);
    dp_shade_at_once(&c->shade, index);
}

static void count_lost(void *arg, uint32_t index, uint32_t worker) {
    dp_context *const c = arg;
    dp_tile *const w = &c->finders[worker].tile;
    if (dp_xray_peel(&c->xray, w, index, worker, c->xray_layer))
        dp_xray_count_lost(&c->xray, w, worker);
}

static bool any_failed(const dp_context *c) {
    for (uint32_t i = 0; i < c->workers; i++)
        if (c->finders[i].tile.failed) return true;
    return false;
}

static dp_result out_of_memory(dp_diag *diag) {
    return dp_fail(diag, DP_ERR_MEMORY, "out of memory for the layers of an x-ray");
}

void dp_shade_layer(dp_context *c, uint32_t layer) {
    dp_target *const t = &c->frame.target;
    if (!layer) c->xray_target = *t;
    c->shade.edges = NULL;
    if (!c->frame.xray || !t->rgba || !c->xray.shaded) return;
    t->rgba = c->xray.layers[layer].rgba, t->rgba_stride = 4 * (size_t)t->width;
    if (c->xray.edges) c->shade.edges = c->xray.layers[layer].ink;
}

/* Peels and shades layer c->xray_layer; forgets it if it has no surface. */
static dp_result draw_layer(dp_context *c, double from, double to, dp_diag *diag) {
    if (!dp_xray_add_layer(&c->xray, &c->frame)) return out_of_memory(diag);
    dp_result result = dp_for_tiles(c, peel_tile, c, from, c->xray.shaded ? from : to, diag);
    if (!result && any_failed(c)) result = out_of_memory(diag);
    if (result) return result;
    dp_xray_settle(&c->xray, &c->frame);
    if (!c->xray.shaded || c->xray.count <= c->xray_layer) return DP_OK;
    dp_shade_layer(c, c->xray_layer);
    return dp_shade_picture(c, from, to, diag);
}

static dp_result draw_layers(dp_context *c, double from, double to, dp_diag *diag) {
    dp_xray *const x = &c->xray;
    const double step = (to - from) / x->most;
    for (uint32_t k = c->xray_layer = 1; k < x->most; c->xray_layer = ++k) {
        const dp_result result = draw_layer(c, from + step * (k - 1), from + step * k, diag);
        if (result || x->count <= k) return result; /* 0: the picture is empty */
    }
    const dp_result result = dp_for_tiles(c, count_lost, c, to - step, to, diag);
    return result || !any_failed(c) ? result : out_of_memory(diag);
}

dp_result dp_draw_layers(dp_context *c, double from, double to, dp_diag *diag) {
    dp_target *const t = &c->frame.target;
    dp_result result = DP_OK;
    if (!c->frame.xray || !t->rgba) return DP_OK;
    t->edge_map = NULL, t->depth = t->normal = t->eye_normal = t->distance = NULL, t->id = NULL;
    if (c->xray.plain)
        dp_xray_settle(&c->xray, &c->frame);
    else
        result = draw_layers(c, from, to, diag);
    *t = c->xray_target;
    c->stats.xray_layers = c->xray.count;
    for (uint32_t i = 0; i < c->workers; i++) c->stats.xray_lost += c->xray.lost[i];
    return result;
}
