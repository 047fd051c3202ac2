/* Edges that the table leaves over, and which lookups fall into which pixel (emerge.c). */
#ifndef DP_FIND_EMERGENCE_H
#define DP_FIND_EMERGENCE_H

#include "core/frame.h"

/* Linked lists of points, one for each pixel of the tile. */
typedef struct dp_pixel_lists {
    uint64_t row[DP_TILE];            /* pixels with a list */
    uint32_t head[DP_TILE * DP_TILE]; /* first of a pixel's list; valid where `row` has its bit */
} dp_pixel_lists;

/* An edge with one polygon, which the table leaves over. */
typedef struct dp_unpaired_edge {
    uint32_t polygon, edge; /* tile polygon, corner */
} dp_unpaired_edge;

typedef struct dp_emergence {
    dp_pixel_lists pixels;
    dp_unpaired_edge *unpaired;
    struct dp_lookup *lookups; /* emerge.c */
    size_t unpaired_cap, lookups_cap;
    uint32_t unpaired_count;
} dp_emergence;

void dp_emergence_free(dp_emergence *emergence, const dp_allocator *memory);
uint64_t dp_emergence_bytes(const dp_emergence *emergence);

/* Puts item `index` first into the list of the pixel that holds (x, y), clamped to the tile.
 * Returns the item that was first before, or UINT32_MAX. */
static inline uint32_t dp_pixel_push(dp_pixel_lists *lists, float x, float y, uint32_t index) {
    const uint32_t px = x <= 0 ? 0 : x >= DP_TILE ? DP_TILE - 1 : (uint32_t)x;
    const uint32_t py = y <= 0 ? 0 : y >= DP_TILE ? DP_TILE - 1 : (uint32_t)y;
    uint32_t *const head = &lists->head[py * DP_TILE + px];
    const uint32_t next = lists->row[py] >> px & 1 ? *head : UINT32_MAX;
    lists->row[py] |= (uint64_t)1 << px;
    *head = index;
    return next;
}

#endif
