/* Composing an x-ray: a tile's layers of surfaces, and the ink between them (xray.c). */
#ifndef DP_SINK_XRAY_H
#define DP_SINK_XRAY_H

#include "raster/xray.h"

enum { DP_XRAY_PIXELS = 64 * 64 };

/* What is seen of a tile from some layer on: by pixel, colour times alpha times weight, with
 * channels of 0 to 255; alpha (of 255) times weight; and the weight, which is what the layers above
 * let through. */
typedef struct dp_xray_tile {
    float rgb[3][DP_XRAY_PIXELS], alpha[DP_XRAY_PIXELS], weight[DP_XRAY_PIXELS];
} dp_xray_tile;

/* Begins a tile: paper, below all layers. */
void dp_xray_paper(const dp_xray *xray, const dp_frame *frame, uint32_t tile, dp_xray_tile *out);

/* Lays layer k over what there is. */
void dp_xray_lay(const dp_xray *xray, const dp_frame *frame, uint32_t tile, uint32_t k,
                 dp_xray_tile *out);

/* Inks pixels of a row of the tile. */
void dp_xray_blend(dp_xray_tile *tile, uint32_t row, const float *coverage, uint64_t pixels,
                   dp_color color);

/* Writes the tile to the target. */
void dp_xray_put(const dp_frame *frame, uint32_t tile, const dp_xray_tile *from);

#endif
