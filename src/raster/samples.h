/* Where samples lie in a pixel, and in memory.
 *
 * A tile is DP_TILE × DP_TILE px. Its samples are stored in cells of `vectors` vectors of four
 * lanes:
 *
 *    samples per pixel    1          4, 8, 16
 *    a cell is            4 × 1 px   1 × 1 px
 *    vectors in it        1          1, 2, 4
 *
 * Cell (x, y) starts at lane 4 * vectors * (y * cells_x + x). */
#ifndef DP_RASTER_SAMPLES_H
#define DP_RASTER_SAMPLES_H

#include "core/frame.h"

typedef float dp_f4 __attribute__((vector_size(16)));
typedef int32_t dp_i4 __attribute__((vector_size(16)));

typedef struct dp_sampling {
    uint32_t samples;    /* per pixel: 1, 4, 8, 16 */
    uint32_t cell_width; /* px: 4 or 1 */
    uint32_t cells_x;    /* per tile row */
    uint32_t vectors;    /* per cell: 1, 1, 2, 4 */
    dp_f4 x[4], y[4];    /* of each lane, px from the cell's corner */
} dp_sampling;

/* The samples of a block (raster.inc), px: x of the pixel in the block, x of the sample in the
 * block, and y of the sample below its pixel's upper edge. Samples of a pixel are consecutive. */
typedef struct dp_block {
    float px[16], x[16], sy[16];
    float least, most; /* least and largest position in a pixel, along either axis */
} dp_block;

void dp_block_init(dp_block *block, uint32_t samples);

void dp_sampling_init(dp_sampling *sampling, uint32_t samples);

static inline dp_f4 dp_splat(float v) { return (dp_f4){v, v, v, v}; }
static inline dp_f4 dp_select(dp_i4 mask, dp_f4 a, dp_f4 b) {
    return (dp_f4)((mask & (dp_i4)a) | (~mask & (dp_i4)b));
}
static inline dp_i4 dp_selecti(dp_i4 mask, dp_i4 a, dp_i4 b) { return (mask & a) | (~mask & b); }
static inline bool dp_any(dp_i4 mask) {
    typedef int64_t i2 __attribute__((vector_size(16)));
    const i2 halves = (i2)mask;
    return (halves[0] | halves[1]) != 0;
}

/* Index of the first sample of pixel (x, y), tile space; its others follow. */
static inline size_t dp_pixel_lane(const dp_sampling *s, uint32_t x, uint32_t y) {
    return (size_t)(y * DP_TILE + x) * s->samples;
}

#endif
