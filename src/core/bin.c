/* Binning: sorts items into screen tiles, in parallel, in submission order.
 *
 *    for each chunk of consecutive items, on any worker
 *        place: the rectangle of tiles of each item
 *        make (tile, item) pairs; of large items only for tiles they touch
 *        sort the pairs by tile (counting sort, in cache)
 *    a tile reads its entries chunk by chunk
 *
 * Invariant: a tile meets its items in submission order, whichever thread sorted which chunk. */
#include "core/bin.h"

#include "base/hostile.h"

#include <string.h>

enum { CHUNK_LEAST = DP_TUNED(512, 3), CHUNK_MOST = DP_TUNED(8192, 3), FEW_TILES = 4 };

typedef struct job {
    dp_bins *bins;
    uint32_t count, chunk, tiles_x, tiles_y; /* chunk: items per chunk */
    dp_bin_place *place;
    dp_bin_touches *touches;
    void *arg;
    const dp_allocator *memory;
} job;

static bool reserve_pairs(const job *j, dp_bin_scratch *s, size_t need) {
    return dp_reserve(j->memory, &s->items, &s->items_cap, need, sizeof *s->items) &&
           dp_reserve(j->memory, &s->tiles, &s->tiles_cap, need, sizeof *s->tiles);
}

static dp_tile_rect clip(const job *j, dp_tile_rect r) {
    return (dp_tile_rect){r.x0 > 0 ? r.x0 : 0,
                          r.y0 > 0 ? r.y0 : 0,
                          r.x1 < (int32_t)j->tiles_x ? r.x1 : (int16_t)j->tiles_x,
                          r.y1 < (int32_t)j->tiles_y ? r.y1 : (int16_t)j->tiles_y,
                          r.tag,
                          0};
}

/* Adds the pairs of an item that spans several tiles. False: out of memory. */
static bool add_pairs(const job *j, dp_bin_scratch *s, uint32_t item, dp_tile_rect r, size_t *count,
                      uint32_t worker) {
    if (r.x0 >= r.x1 || r.y0 >= r.y1) return true;
    const size_t most = (size_t)(r.x1 - r.x0) * (size_t)(r.y1 - r.y0);
    if (!reserve_pairs(j, s, *count + most + j->chunk)) return false;
    const bool ask = j->touches && most > FEW_TILES;
    for (int32_t y = r.y0; y < r.y1; y++)
        for (int32_t x = r.x0; x < r.x1; x++) {
            if (ask && !j->touches(j->arg, item, x, y, worker)) continue;
            s->tiles[*count] = (uint32_t)y * j->tiles_x + (uint32_t)x;
            s->items[(*count)++] = item | r.tag;
        }
    return true;
}

/* Invariant: there is room for one more pair for each item that is left. */
static bool make_pairs(const job *j, dp_bin_scratch *s, uint32_t first, uint32_t n, size_t *count,
                       uint32_t worker) {
    if (!dp_reserve(j->memory, &s->rects, &s->rects_cap, n, sizeof *s->rects) ||
        !reserve_pairs(j, s, j->chunk))
        return false;
    j->place(j->arg, first, n, s->rects, worker);
    const dp_tile_rect *const rects = s->rects;
    uint32_t *tiles = s->tiles, *items = s->items;
    size_t have = *count;
    for (uint32_t i = 0; i < n; i++) {
        const dp_tile_rect r = rects[i];
        if (r.only) {
            tiles[have] = r.only - 1;
            items[have++] = (first + i) | r.tag;
        } else {
            if (!add_pairs(j, s, first + i, clip(j, r), &have, worker)) return false;
            tiles = s->tiles, items = s->items;
        }
    }
    *count = have;
    return true;
}

/* Counting sort by tile. Consecutive items often lie in one tile, whose count must come back from
 * memory before it can grow again. So the pairs are counted, and placed, from two halves in
 * turn. */
static bool sort_chunk(const job *j, dp_bin_scratch *s, size_t count, dp_bin_chunk *chunk) {
    const uint32_t tile_count = j->bins->tile_count;
    const size_t half = count / 2;
    if (!dp_reserve(j->memory, &chunk->offsets, &chunk->offsets_cap, tile_count + 1,
                    sizeof *chunk->offsets) ||
        !dp_reserve(j->memory, &s->offsets, &s->offsets_cap, tile_count, sizeof *s->offsets) ||
        !dp_reserve(j->memory, &chunk->entries, &chunk->entries_cap, count + 1,
                    sizeof *chunk->entries)) /* not NULL even if there are none */
        return false;
    uint32_t *const left = chunk->offsets, *const right = s->offsets,
                    *const entries = chunk->entries;
    memset(left, 0, (tile_count + 1) * sizeof *left);
    memset(right, 0, tile_count * sizeof *right);
    for (size_t i = 0; i < half; i++) left[s->tiles[i]]++, right[s->tiles[half + i]]++;
    if (count % 2) right[s->tiles[count - 1]]++;
    uint32_t sum = 0;
    for (uint32_t t = 0; t < tile_count; t++) {
        const uint32_t n = left[t], m = right[t];
        left[t] = sum, right[t] = sum + n;
        sum += n + m;
    }
    for (size_t i = 0; i < half; i++) {
        entries[left[s->tiles[i]]++] = s->items[i];
        entries[right[s->tiles[half + i]]++] = s->items[half + i];
    }
    if (count % 2) entries[right[s->tiles[count - 1]]++] = s->items[count - 1];
    /* The right halves' offsets now stand at the ends of their tiles, where the next tiles
     * start. */
    memcpy(left + 1, right, tile_count * sizeof *left);
    left[0] = 0;
    return true;
}

static void bin_chunk(void *arg, uint32_t index, uint32_t worker) {
    const job *const j = arg;
    dp_bin_chunk *const chunk = &j->bins->chunks[index];
    dp_bin_scratch *const scratch = &j->bins->scratch[worker];
    const uint32_t first = index * j->chunk;
    size_t count = 0;
    chunk->failed =
        !make_pairs(j, scratch, first, j->count - first < j->chunk ? j->count - first : j->chunk,
                    &count, worker) ||
        !sort_chunk(j, scratch, count, chunk);
}

bool dp_bins_fill(dp_bins *bins, uint32_t count, uint32_t tiles_x, uint32_t tiles_y,
                  dp_bin_place *place, dp_bin_touches *touches, void *arg, dp_threads *threads,
                  const dp_allocator *memory) {
    const uint32_t chunk = dp_task_size(count, CHUNK_LEAST, CHUNK_MOST),
                   chunks = count / chunk + (count % chunk != 0);
    bins->chunk_count = 0;
    bins->tile_count = tiles_x * tiles_y;
    if (!dp_reserve_zeroed(memory, &bins->chunks, &bins->chunks_cap, chunks,
                           sizeof *bins->chunks) ||
        !dp_reserve_zeroed(memory, &bins->scratch, &bins->scratch_cap, dp_threads_count(threads),
                           sizeof *bins->scratch))
        return false;
    job j = {bins, count, chunk, tiles_x, tiles_y, place, touches, arg, memory};
    dp_parallel(threads, chunks, bin_chunk, &j);
    bins->chunk_count = chunks;
    for (uint32_t i = 0; i < chunks; i++)
        if (bins->chunks[i].failed) return false;
    return true;
}

static const dp_array arrays[] = {DP_ARRAY(dp_bins, chunks, chunks_cap),
                                  DP_ARRAY(dp_bins, scratch, scratch_cap)};
static const dp_array chunk_arrays[] = {DP_ARRAY(dp_bin_chunk, entries, entries_cap),
                                        DP_ARRAY(dp_bin_chunk, offsets, offsets_cap)};
static const dp_array scratch_arrays[] = {
    DP_ARRAY(dp_bin_scratch, rects, rects_cap), DP_ARRAY(dp_bin_scratch, items, items_cap),
    DP_ARRAY(dp_bin_scratch, tiles, tiles_cap), DP_ARRAY(dp_bin_scratch, offsets, offsets_cap)};

void dp_bins_free(dp_bins *bins, const dp_allocator *memory) {
    for (size_t i = 0; i < bins->chunks_cap; i++)
        dp_arrays_free(memory, &bins->chunks[i], DP_ARRAYS(chunk_arrays));
    for (size_t i = 0; i < bins->scratch_cap; i++)
        dp_arrays_free(memory, &bins->scratch[i], DP_ARRAYS(scratch_arrays));
    dp_arrays_free(memory, bins, DP_ARRAYS(arrays));
    *bins = (dp_bins){0};
}

uint64_t dp_bins_bytes(const dp_bins *bins) {
    uint64_t sum = dp_arrays_bytes(bins, DP_ARRAYS(arrays));
    for (size_t i = 0; i < bins->chunks_cap; i++)
        sum += dp_arrays_bytes(&bins->chunks[i], DP_ARRAYS(chunk_arrays));
    for (size_t i = 0; i < bins->scratch_cap; i++)
        sum += dp_arrays_bytes(&bins->scratch[i], DP_ARRAYS(scratch_arrays));
    return sum;
}

size_t dp_bins_tile_count(const dp_bins *bins, uint32_t tile) {
    size_t sum = 0;
    for (uint32_t c = 0; c < bins->chunk_count; c++) {
        if (c + 8 < bins->chunk_count) __builtin_prefetch(&bins->chunks[c + 8].offsets[tile]);
        sum += bins->chunks[c].offsets[tile + 1] - bins->chunks[c].offsets[tile];
    }
    return sum;
}
