/* An allocator that keeps what is given back.
 *
 * Data structure: a list of free blocks; each block says how large it is before what the user has of
 * it. The smallest free block that is large enough is taken. Invariant: the same calls in the next
 * frame find the same blocks, so they allocate nothing. Not handled: threads; many blocks, as the list is
 * searched. */
#include "base/pool.h"

#include <string.h>

typedef struct dp_pool_block {
    struct dp_pool_block *next;
    size_t size; /* of the user's part */
} block;

enum { HEAD = sizeof(block) > 16 ? 32 : 16 /* keeps what follows aligned */ };

static void *body_of(block *b) { return (char *)b + HEAD; }
static block *block_of(void *body) { return (block *)(void *)((char *)body - HEAD); }

static block *take_free(dp_pool *pool, size_t size) {
    block **best = NULL;
    for (block **b = &pool->free; *b; b = &(*b)->next)
        if ((*b)->size >= size && (!best || (*b)->size < (*best)->size)) best = b;
    if (!best) return NULL;
    block *const taken = *best;
    *best = taken->next;
    return taken;
}

static void *pool_alloc(size_t size, void *user) {
    dp_pool *const pool = user;
    block *b = take_free(pool, size);
    if (b) return body_of(b);
    if (size > PTRDIFF_MAX - HEAD) return NULL;
    b = dp_alloc(pool->memory, size + HEAD);
    if (!b) return NULL;
    b->size = size;
    pool->bytes += size + HEAD;
    return body_of(b);
}

static void pool_give_back(void *body, void *user) {
    dp_pool *const pool = user;
    if (!body) return;
    block *const b = block_of(body);
    b->next = pool->free;
    pool->free = b;
}

static void *pool_realloc(void *old, size_t size, void *user) {
    if (old && block_of(old)->size >= size) return old;
    void *const body = pool_alloc(size, user);
    if (!body || !old) return body;
    memcpy(body, old, block_of(old)->size);
    pool_give_back(old, user);
    return body;
}

dp_allocator dp_pool_allocator(dp_pool *pool, const dp_allocator *memory) {
    pool->memory = memory;
    return (dp_allocator){pool_alloc, pool_realloc, pool_give_back, pool};
}

void dp_pool_free(dp_pool *pool, const dp_allocator *memory) {
    for (block *b = pool->free, *next; b; b = next) {
        next = b->next;
        dp_free(memory, b);
    }
    *pool = (dp_pool){0};
}
