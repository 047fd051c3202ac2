/* Memory through the caller's allocator, malloc by default. Sizes are checked for overflow here and
 * nowhere else. Invariant: dp_reserve leaves an array usable and unchanged if memory is out. */
#include "base/memory.h"

#include "base/hostile.h"

#include <stdlib.h>
#include <string.h>

static void *default_alloc(size_t size, void *user) {
    (void)user;
    return malloc(size);
}
static void *default_realloc(void *block, size_t size, void *user) {
    (void)user;
    return realloc(block, size);
}
static void default_free(void *block, void *user) {
    (void)user;
    free(block);
}

dp_allocator dp_allocator_resolve(const dp_allocator *allocator) {
    if (allocator && allocator->alloc && allocator->realloc && allocator->free) return *allocator;
    return (dp_allocator){default_alloc, default_realloc, default_free, NULL};
}

void *dp_alloc(const dp_allocator *allocator, size_t size) {
    if (size > PTRDIFF_MAX) return NULL;
    return allocator->alloc(size ? size : 1, allocator->user);
}

void *dp_alloc_zeroed(const dp_allocator *allocator, size_t size) {
    void *const block = dp_alloc(allocator, size);
    if (block) memset(block, 0, size);
    return block;
}

void *dp_alloc_array(const dp_allocator *allocator, size_t count, size_t size) {
    return dp_alloc(allocator, dp_times(count, size));
}

void dp_free(const dp_allocator *allocator, void *block) {
    if (block) allocator->free(block, allocator->user);
}

bool dp_reserve(const dp_allocator *allocator, void *block_address, size_t *capacity, size_t need,
                size_t item_size) {
    if (need <= *capacity) return true;
    size_t grown = *capacity + *capacity / DP_TUNED(2, 8);
    if (grown < DP_TUNED(64, 1)) grown = DP_TUNED(64, 1);
    if (grown < need || dp_times(grown, item_size) > PTRDIFF_MAX) grown = need;
    if (dp_times(grown, item_size) > PTRDIFF_MAX) return false;
    void *block;
    memcpy(&block, block_address, sizeof block);
    block = allocator->realloc(block, grown * item_size, allocator->user);
    if (!block) return false;
    memcpy(block_address, &block, sizeof block);
    *capacity = grown;
    return true;
}

bool dp_reserve_zeroed(const dp_allocator *allocator, void *block_address, size_t *capacity,
                       size_t need, size_t item_size) {
    const size_t had = *capacity;
    if (!dp_reserve(allocator, block_address, capacity, need, item_size)) return false;
    char *block;
    memcpy(&block, block_address, sizeof block);
    if (*capacity > had) memset(block + had * item_size, 0, (*capacity - had) * item_size);
    return true;
}

static void *pointer_of(const void *object, const dp_array *array) {
    void *pointer;
    memcpy(&pointer, (const char *)object + array->pointer, sizeof pointer);
    return pointer;
}

static size_t capacity_of(const void *object, const dp_array *array) {
    size_t capacity;
    memcpy(&capacity, (const char *)object + array->capacity, sizeof capacity);
    return capacity;
}

void dp_arrays_free(const dp_allocator *memory, void *object, const dp_array *arrays,
                    size_t count) {
    for (size_t i = 0; i < count; i++) {
        dp_free(memory, pointer_of(object, &arrays[i]));
        memset((char *)object + arrays[i].pointer, 0, sizeof(void *));
        memset((char *)object + arrays[i].capacity, 0, sizeof(size_t));
    }
}

uint64_t dp_arrays_bytes(const void *object, const dp_array *arrays, size_t count) {
    uint64_t sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += (uint64_t)capacity_of(object, &arrays[i]) * arrays[i].size;
    return sum;
}
