/* Items sorted to screen tiles, in parallel, in submission order. */
#ifndef DP_PIPE_BIN_H
#define DP_PIPE_BIN_H

#include "base/memory.h"
#include "base/threads.h"

/* Tiles [x0, x1) x [y0, y1); empty when x0 >= x1. */
typedef struct dp_tile_rect {
    int32_t x0, y0, x1, y1;
} dp_tile_rect;

/* One chunk of items: `entries` of tile t are [offsets[t], offsets[t + 1]), ascending. */
typedef struct dp_bin_chunk {
    uint32_t *entries, *offsets;
    uint32_t *items, *tiles; /* the same pairs as they came */
    size_t entries_cap, offsets_cap, items_cap, tiles_cap;
    size_t count;
    bool failed; /* out of memory */
} dp_bin_chunk;

typedef struct dp_bins {
    dp_bin_chunk *chunks;
    uint32_t chunk_count, tile_count;
    size_t chunks_cap;
} dp_bins;

/* Which tiles item `index` touches. `worker` as in dp_task. When it spans more than a few tiles,
 * `touches` (optional) is asked about each of them. */
typedef dp_tile_rect dp_bin_place(void *arg, uint32_t index, uint32_t worker);
typedef bool dp_bin_touches(void *arg, uint32_t index, int32_t tile_x, int32_t tile_y, uint32_t worker);

/* Bins items [0, count) into tiles_x * tiles_y tiles. False when memory is out. */
bool dp_bins_fill(dp_bins *bins, uint32_t count, uint32_t tiles_x, uint32_t tiles_y,
                  dp_bin_place *place, dp_bin_touches *touches, void *arg, dp_threads *threads,
                  const dp_allocator *memory);
void dp_bins_free(dp_bins *bins, const dp_allocator *memory);

/* How many items tile t holds. */
size_t dp_bins_tile_count(const dp_bins *bins, uint32_t tile);

#endif
