/* Where samples lie in a pixel: its centre, or the standard rotated patterns of 4, 8 and 16
 * samples, in sixteenths of a pixel (those of Direct3D 11). A line at a small angle passes them one
 * after the other. */
#include "raster/samples.h"

static const int8_t pattern4[4][2] = {{-2, -6}, {6, -2}, {-6, 2}, {2, 6}};
static const int8_t pattern8[8][2] = {{1, -3}, {-1, 3},  {5, 1}, {-3, -5},
                                      {-5, 5}, {-7, -1}, {3, 7}, {7, -7}};
static const int8_t pattern16[16][2] = {{1, 1},  {-1, -3}, {-3, 2}, {4, -1}, {-5, -2}, {2, 5},
                                        {5, 3},  {3, -5},  {-2, 6}, {0, -7}, {-4, -6}, {-6, 4},
                                        {-8, 0}, {7, -4},  {6, 7},  {-7, -8}};

static const int8_t (*pattern_of(uint32_t samples))[2] {
    return samples == 4 ? pattern4 : samples == 8 ? pattern8 : pattern16;
}

void dp_block_init(dp_block *block, uint32_t samples) {
    const int8_t(*const pattern)[2] = pattern_of(samples);
    block->least = 1, block->most = 0;
    for (uint32_t i = 0; i < 16; i++) {
        const uint32_t sample = i % samples;
        block->px[i] = (float)(i / samples);
        block->x[i] = block->px[i] + (samples == 1 ? 0.5f : 0.5f + (float)pattern[sample][0] / 16);
        block->sy[i] = samples == 1 ? 0.5f : 0.5f + (float)pattern[sample][1] / 16;
        const float x = block->x[i] - block->px[i], y = block->sy[i];
        block->least = dp_minf(block->least, dp_minf(x, y));
        block->most = dp_maxf(block->most, dp_maxf(x, y));
    }
}

void dp_sampling_init(dp_sampling *sampling, uint32_t samples) {
    const int8_t(*const pattern)[2] = pattern_of(samples);
    const bool single = samples == 1;
    *sampling = (dp_sampling){.samples = samples,
                              .cell_width = single ? 4 : 1,
                              .cells_x = single ? DP_TILE / 4 : DP_TILE,
                              .vectors = single ? 1 : samples / 4};
    for (uint32_t i = 0; i < sampling->vectors * 4; i++) {
        sampling->x[i / 4][i % 4] = single ? (float)i + 0.5f : 0.5f + (float)pattern[i][0] / 16;
        sampling->y[i / 4][i % 4] = single ? 0.5f : 0.5f + (float)pattern[i][1] / 16;
    }
}
