/* Many pieces of memory that are freed together. */
#ifndef DP_BASE_ARENA_H
#define DP_BASE_ARENA_H

#include "base/memory.h"

/* Zero but for `memory` is empty. */
typedef struct dp_arena {
    dp_allocator memory;
    struct dp_arena_block *last; /* the block that pieces are taken from */
    size_t used;                 /* bytes of it */
} dp_arena;

/* count * size bytes of zeros, aligned as malloc's blocks are; NULL: memory is out. */
void *dp_arena_take(dp_arena *arena, size_t count, size_t size);
/* A copy of count items; `from` may be NULL if there are none. NULL: memory is out. */
void *dp_arena_copy(dp_arena *arena, const void *from, size_t count, size_t size);
/* A copy of text; NULL for NULL, or if memory is out (*enough is false then). */
const char *dp_arena_text(dp_arena *arena, const char *text, bool *enough);
void dp_arena_free(dp_arena *arena);

#endif
