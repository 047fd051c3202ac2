/* Binning: items to screen tiles.
 *
 * Items are cut into chunks of consecutive numbers. A chunk is one task: it writes (tile, item) pairs
 * and sorts them by tile with one counting sort that stays in cache. A tile later walks the chunks in
 * order, so it meets its items in submission order, whatever thread did which chunk. */
#include "pipe/bin.h"

#include "base/hostile.h"

#include <string.h>

enum { CHUNK = DP_TUNED(8192, 3), FEW_TILES = 4 };

typedef struct job {
    dp_bins *bins;
    uint32_t count, tiles_x, tiles_y;
    dp_bin_place *place;
    dp_bin_touches *touches;
    void *arg;
    const dp_allocator *memory;
} job;

static bool reserve_pairs(const job *j, dp_bin_chunk *chunk, size_t need) {
    return dp_reserve(j->memory, &chunk->items, &chunk->items_cap, need, sizeof *chunk->items) &&
           dp_reserve(j->memory, &chunk->tiles, &chunk->tiles_cap, need, sizeof *chunk->tiles);
}

static bool place_in(const job *j, dp_bin_chunk *chunk, uint32_t item, int32_t x, int32_t y) {
    if (chunk->count >= chunk->tiles_cap && !reserve_pairs(j, chunk, chunk->count + 1)) return false;
    chunk->tiles[chunk->count] = (uint32_t)y * j->tiles_x + (uint32_t)x;
    chunk->items[chunk->count++] = item;
    return true;
}

static bool place_item(const job *j, dp_bin_chunk *chunk, uint32_t item, uint32_t worker) {
    dp_tile_rect r = j->place(j->arg, item, worker);
    if (r.x0 < 0) r.x0 = 0;
    if (r.y0 < 0) r.y0 = 0;
    if (r.x1 > (int32_t)j->tiles_x) r.x1 = (int32_t)j->tiles_x;
    if (r.y1 > (int32_t)j->tiles_y) r.y1 = (int32_t)j->tiles_y;
    if (r.x0 >= r.x1 || r.y0 >= r.y1) return true;
    if (r.x1 - r.x0 == 1 && r.y1 - r.y0 == 1) return place_in(j, chunk, item, r.x0, r.y0);
    const size_t most = (size_t)(r.x1 - r.x0) * (size_t)(r.y1 - r.y0);
    if (!reserve_pairs(j, chunk, chunk->count + most)) return false;
    const bool ask = j->touches && most > FEW_TILES;
    for (int32_t y = r.y0; y < r.y1; y++)
        for (int32_t x = r.x0; x < r.x1; x++) {
            if (ask && !j->touches(j->arg, item, x, y, worker)) continue;
            chunk->tiles[chunk->count] = (uint32_t)y * j->tiles_x + (uint32_t)x;
            chunk->items[chunk->count] = item;
            chunk->count++;
        }
    return true;
}

/* Counting sort by tile. */
static bool sort_chunk(const job *j, dp_bin_chunk *chunk, uint32_t tile_count) {
    if (!dp_reserve(j->memory, &chunk->offsets, &chunk->offsets_cap, tile_count + 1,
                    sizeof *chunk->offsets) ||
        !dp_reserve(j->memory, &chunk->entries, &chunk->entries_cap, chunk->count,
                    sizeof *chunk->entries))
        return false;
    uint32_t *const offsets = chunk->offsets;
    memset(offsets, 0, (tile_count + 1) * sizeof *offsets);
    for (size_t i = 0; i < chunk->count; i++) offsets[chunk->tiles[i]]++;
    uint32_t sum = 0;
    for (uint32_t t = 0; t <= tile_count; t++) {
        const uint32_t n = t < tile_count ? offsets[t] : 0;
        offsets[t] = sum;
        sum += n;
    }
    for (size_t i = 0; i < chunk->count; i++)
        chunk->entries[offsets[chunk->tiles[i]]++] = chunk->items[i];
    /* each offset now stands at its tile's end, the start of the next */
    memmove(offsets + 1, offsets, tile_count * sizeof *offsets);
    offsets[0] = 0;
    return true;
}

static void bin_chunk(void *arg, uint32_t index, uint32_t worker) {
    const job *const j = arg;
    dp_bin_chunk *const chunk = &j->bins->chunks[index];
    const uint32_t first = index * CHUNK;
    const uint32_t last = j->count - first < CHUNK ? j->count : first + CHUNK;
    chunk->count = 0;
    chunk->failed = false;
    for (uint32_t i = first; i < last && !chunk->failed; i++)
        chunk->failed = !place_item(j, chunk, i, worker);
    if (!chunk->failed) chunk->failed = !sort_chunk(j, chunk, j->bins->tile_count);
}

bool dp_bins_fill(dp_bins *bins, uint32_t count, uint32_t tiles_x, uint32_t tiles_y,
                  dp_bin_place *place, dp_bin_touches *touches, void *arg, dp_threads *threads,
                  const dp_allocator *memory) {
    const uint32_t chunks = count / CHUNK + (count % CHUNK != 0);
    const size_t had = bins->chunks_cap;
    bins->chunk_count = 0;
    bins->tile_count = tiles_x * tiles_y;
    if (!dp_reserve(memory, &bins->chunks, &bins->chunks_cap, chunks, sizeof *bins->chunks)) return false;
    if (bins->chunks_cap > had)
        memset(bins->chunks + had, 0, (bins->chunks_cap - had) * sizeof *bins->chunks);
    job j = {bins, count, tiles_x, tiles_y, place, touches, arg, memory};
    dp_parallel(threads, chunks, bin_chunk, &j);
    bins->chunk_count = chunks;
    for (uint32_t i = 0; i < chunks; i++)
        if (bins->chunks[i].failed) return false;
    return true;
}

void dp_bins_free(dp_bins *bins, const dp_allocator *memory) {
    for (size_t i = 0; i < bins->chunks_cap; i++) {
        dp_free(memory, bins->chunks[i].entries);
        dp_free(memory, bins->chunks[i].items);
        dp_free(memory, bins->chunks[i].tiles);
        dp_free(memory, bins->chunks[i].offsets);
    }
    dp_free(memory, bins->chunks);
    *bins = (dp_bins){0};
}

size_t dp_bins_tile_count(const dp_bins *bins, uint32_t tile) {
    size_t sum = 0;
    for (uint32_t c = 0; c < bins->chunk_count; c++)
        sum += bins->chunks[c].offsets[tile + 1] - bins->chunks[c].offsets[tile];
    return sum;
}
