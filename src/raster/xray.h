/* X-ray: what lies behind the nearest surface, layer by layer (xray.c). */
#ifndef DP_RASTER_XRAY_H
#define DP_RASTER_XRAY_H

#include "core/frame.h"

struct dp_tile;

/* Pixel sizes: surfaces this close behind each other are one layer. Less than what hides a line
 * (DP_PROBE_SLACK). */
#define DP_LAYER_GAP 0.05f

/* What lies behind this depth, and not just behind a layer there, belongs to the next layers. */
static inline float dp_layer_bound(const dp_frame *f, float depth) {
    return depth - (fabsf(depth) * (DP_LAYER_GAP * f->step_scale) + DP_LAYER_GAP * f->step_offset);
}

/* Surfaces of one layer: of each sample the nearest, the next one, and so on. */
typedef struct dp_xray_layer {
    uint8_t
        *tiles; /* [tile] not 0: the layer has a surface there, elsewhere its planes are not set;
                         2: there may be another layer behind */
    uint8_t
        *covered; /* [pixel] samples that hold it, where all surfaces are of one opacity; else … */
    float *weight; /* [pixel] … share of the pixel's light that comes from it, 0 to 1 */
    uint8_t *rgba; /* [pixel][4] its colour, not premultiplied, where its weight is not 0; not used
                         where all layers have one colour */
    uint8_t *ink;  /* [pixel][4] edges of its edge map, over it; where there is one */
    size_t tiles_cap, covered_cap, weight_cap, rgba_cap, ink_cap;
} dp_xray_layer;

/* The layers of one picture. Zero is empty. */
typedef struct dp_xray {
    dp_xray_layer layers[DP_LEVELS];
    uint32_t count; /* layers that are there, of `most` */
    uint32_t most;
    bool shaded;                 /* colours come from src/shade, … */
    bool edges;                  /* … and edges of an edge map */
    bool uniform;                /* all surfaces are of one opacity: `through` is not used */
    bool plain;                  /* and all layers of one colour, … */
    dp_color color;              /* … this; each tile is peeled at once */
    float weight[DP_LEVELS][17]; /* uniform: by layer and covered samples */
    float *nearest; /* [tile] the nearest of its bounds, and a little more for rounding */
    /* [tile][sample], plain: [worker][sample] */
    float *bound;   /* what lies behind this depth belongs to the next layers */
    float *through; /* share of light that passes all layers so far */
    float *scratch; /* [worker][sample] depth of the layer being peeled */
    uint64_t *lost; /* [worker] samples with more than `most` layers */
    size_t nearest_cap, bound_cap, through_cap, scratch_cap, lost_cap;
} dp_xray;

void dp_xray_free(dp_xray *xray, const dp_allocator *memory);
uint64_t dp_xray_bytes(const dp_xray *xray);

/* Begins a picture, and its first layer. `shaded`: src/shade puts the colours. False: out of memory. */
bool dp_xray_begin(dp_xray *xray, const dp_frame *frame, uint32_t workers, bool shaded);

/* Makes room for the next layer, `count`; false: out of memory. */
bool dp_xray_add_layer(dp_xray *xray, const dp_frame *frame);

/* Takes what a tile's samples hold as its part of layer k; what is peeled next lies behind. */
void dp_xray_take(dp_xray *xray, const struct dp_tile *tile, uint32_t worker, uint32_t k);

/* Draws a tile's part of layer k, which is not the first: the samples hold it then. Returns whether
 * there is any. */
bool dp_xray_peel(dp_xray *xray, struct dp_tile *tile, uint32_t index, uint32_t worker, uint32_t k);

/* Counts the tile's samples that hold something beyond the last layer. */
void dp_xray_count_lost(dp_xray *xray, const struct dp_tile *tile, uint32_t worker);

/* Plain: peels and takes all further layers of a tile whose first one was taken. */
void dp_xray_peel_all(dp_xray *xray, struct dp_tile *tile, uint32_t worker);

/* Forgets layers without any surface. */
void dp_xray_settle(dp_xray *xray, const dp_frame *frame);

/* Weights of layer k in n pixels of a row of a tile. */
void dp_xray_weights(const dp_xray *xray, const dp_frame *frame, uint32_t k, uint32_t tile,
                     uint32_t row, uint32_t n, float *out);

/* A tile's pixels within the picture, px. */
typedef struct dp_span {
    uint32_t x0, y0, x1, y1;
} dp_span;
static inline dp_span dp_span_of_tile(const dp_frame *f, uint32_t tile) {
    const uint32_t x0 = tile % f->tiles_x * DP_TILE, y0 = tile / f->tiles_x * DP_TILE;
    const uint32_t x1 = x0 + DP_TILE, y1 = y0 + DP_TILE;
    return (dp_span){x0, y0, x1 < f->target.width ? x1 : f->target.width,
                     y1 < f->target.height ? y1 : f->target.height};
}

#endif
