/* Items sorted into screen tiles, in parallel, in submission order (bin.c). */
#ifndef DP_CORE_BIN_H
#define DP_CORE_BIN_H

#include "base/memory.h"
#include "base/threads.h"

/* Tiles [x0, x1) × [y0, y1), not yet clipped to the picture; empty if x0 >= x1. */
typedef struct dp_tile_rect {
    int16_t x0, y0, x1, y1;
    uint32_t tag;  /* 0 or DP_BIN_TAG, which is added to the item's number in the entries */
    uint32_t only; /* 1 + the one tile of the picture that it reaches; 0: see the rectangle */
} dp_tile_rect;

#define DP_BIN_TAG (1u << 31)

enum { DP_BIN_ROOM = 16 }; /* room for a vector stored beyond the last entry of a list */

/* One chunk of items. Entries of tile t: [offsets[t], offsets[t + 1]), ascending apart from their
 * tags. */
typedef struct dp_bin_chunk {
    uint32_t *entries, *offsets;
    size_t entries_cap, offsets_cap;
    bool failed; /* out of memory */
} dp_bin_chunk;

/* A worker's scratch for one chunk: rectangles, and (tile, item) pairs in the order of items. */
typedef struct dp_bin_scratch {
    dp_tile_rect *rects;
    uint32_t *items, *tiles, *offsets;
    size_t rects_cap, items_cap, tiles_cap, offsets_cap;
} dp_bin_scratch;

typedef struct dp_bins {
    dp_bin_chunk *chunks;
    dp_bin_scratch *scratch; /* by worker */
    uint32_t chunk_count, tile_count;
    size_t chunks_cap, scratch_cap;
} dp_bins;

/* Finds the tiles that items [first, first + count) reach. `worker` as in dp_task. If an item spans
 * more than a few tiles, `touches` (optional) is asked about each of them. */
typedef void dp_bin_place(void *arg, uint32_t first, uint32_t count, dp_tile_rect *rects,
                          uint32_t worker);
typedef bool dp_bin_touches(void *arg, uint32_t index, int32_t tile_x, int32_t tile_y,
                            uint32_t worker);

/* Bins items [0, count), fewer than DP_BIN_TAG, into tiles_x * tiles_y tiles. False: out of
 * memory. */
bool dp_bins_fill(dp_bins *bins, uint32_t count, uint32_t tiles_x, uint32_t tiles_y,
                  dp_bin_place *place, dp_bin_touches *touches, void *arg, dp_threads *threads,
                  const dp_allocator *memory);
void dp_bins_free(dp_bins *bins, const dp_allocator *memory);

/* Memory kept, bytes. */
uint64_t dp_bins_bytes(const dp_bins *bins);

/* Prefetches what a walk over a tile's chunks will read after chunk `c`; it is scattered. */
static inline void dp_bins_prefetch(const dp_bins *bins, uint32_t tile, uint32_t c) {
    const dp_bin_chunk *const chunks = bins->chunks;
    if (c + 8 < bins->chunk_count) __builtin_prefetch(&chunks[c + 8].offsets[tile]);
    if (c + 4 < bins->chunk_count)
        __builtin_prefetch(&chunks[c + 4].entries[chunks[c + 4].offsets[tile]]);
}

/* Number of items in a tile. */
size_t dp_bins_tile_count(const dp_bins *bins, uint32_t tile);

#endif
