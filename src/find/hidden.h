/* Scratch of the search for hidden lines (hidden.c). */
#ifndef DP_FIND_HIDDEN_H
#define DP_FIND_HIDDEN_H

#include "base/memory.h"

typedef struct dp_hidden_store {
    struct dp_shown *shown; /* the tile's visible pieces, sorted by what names their spines */
    size_t shown_cap;
    uint32_t shown_count;
} dp_hidden_store;

void dp_hidden_store_free(dp_hidden_store *store, const dp_allocator *memory);
uint64_t dp_hidden_store_bytes(const dp_hidden_store *store);

#endif
