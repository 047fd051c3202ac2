/* Memory in blocks, from which pieces are taken one after the other; large ones have a block of
 * their own, which does not end the block in use. Invariant: pieces never move. */
#include "base/arena.h"

#include "base/hostile.h"

#include <string.h>

enum { ALIGNED = 16, BLOCK = DP_TUNED(1 << 16, 64) /* bytes */ };

typedef struct dp_arena_block {
    struct dp_arena_block *next;
    size_t size; /* bytes after this header */
} block;

enum { HEADER = (sizeof(block) + ALIGNED - 1) / ALIGNED * ALIGNED };

static block *add_block(dp_arena *arena, size_t size) {
    if (size > PTRDIFF_MAX - HEADER) return NULL;
    block *const b = dp_alloc(&arena->memory, HEADER + size);
    if (b) *b = (block){NULL, size};
    return b;
}

/* A piece with a block of its own, behind the one in use. */
static void *take_large(dp_arena *arena, size_t size) {
    block *const b = add_block(arena, size);
    if (!b) return NULL;
    block *const last = arena->last;
    b->next = last ? last->next : NULL;
    if (last)
        last->next = b;
    else
        arena->last = b, arena->used = size;
    return memset((char *)b + HEADER, 0, size);
}

void *dp_arena_take(dp_arena *arena, size_t count, size_t size) {
    const size_t all = dp_times(count, size);
    if (all > PTRDIFF_MAX - ALIGNED) return NULL;
    const size_t need = (all + ALIGNED - 1) / ALIGNED * ALIGNED;
    if (need > BLOCK / 4) return take_large(arena, need);
    if (!arena->last || arena->last->size - arena->used < need) {
        block *const b = add_block(arena, BLOCK);
        if (!b) return NULL;
        b->next = arena->last;
        arena->last = b, arena->used = 0;
    }
    char *const piece = (char *)arena->last + HEADER + arena->used;
    arena->used += need;
    return memset(piece, 0, need);
}

void *dp_arena_copy(dp_arena *arena, const void *from, size_t count, size_t size) {
    void *const to = dp_arena_take(arena, count, size);
    if (to && from && count) memcpy(to, from, count * size);
    return to;
}

const char *dp_arena_text(dp_arena *arena, const char *text, bool *enough) {
    char *const copy = text ? dp_arena_copy(arena, text, strlen(text) + 1, 1) : NULL;
    *enough &= !text || copy;
    return copy;
}

void dp_arena_free(dp_arena *arena) {
    for (block *b = arena->last; b;) {
        block *const next = b->next;
        dp_free(&arena->memory, b);
        b = next;
    }
    arena->last = NULL, arena->used = 0;
}
