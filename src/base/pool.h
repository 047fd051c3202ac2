/* An allocator that keeps what is given back, for work that is done again every frame. */
#ifndef DP_BASE_POOL_H
#define DP_BASE_POOL_H

#include "base/memory.h"

typedef struct dp_pool {
    const dp_allocator *memory; /* where blocks come from */
    struct dp_pool_block *free; /* given back, the last one first */
    uint64_t bytes;             /* of all blocks, in use or not */
} dp_pool;

/* Takes its blocks from the pool, which must outlive it. */
dp_allocator dp_pool_allocator(dp_pool *pool, const dp_allocator *memory);

/* Gives back all blocks, none of which may be in use. */
void dp_pool_free(dp_pool *pool, const dp_allocator *memory);

#endif
