/* Memory through the caller's allocator. */
#ifndef DP_BASE_MEMORY_H
#define DP_BASE_MEMORY_H

#include <drypoint/base.h>

/* A copy with the defaults filled in; `allocator` may be NULL. */
dp_allocator dp_allocator_resolve(const dp_allocator *allocator);

/* a * b; SIZE_MAX, which no allocation grants, where that overflows. Sizes that files, pictures or
 * callers have a say in are multiplied by this: a size_t of 32 bits is soon full. */
static inline size_t dp_times(size_t a, size_t b) {
    return b && a > SIZE_MAX / b ? SIZE_MAX : a * b;
}

/* NULL where there is no memory, and for more than PTRDIFF_MAX bytes, which no object may have. */
void *dp_alloc(const dp_allocator *allocator, size_t size);
void *dp_alloc_zeroed(const dp_allocator *allocator, size_t size);
/* count * size. */
void *dp_alloc_array(const dp_allocator *allocator, size_t count, size_t size);
void dp_free(const dp_allocator *allocator, void *block);

/* Makes room for `need` items in *block (any object pointer's address), growing by at least half.
 * False when memory is out: the block stays as it was. */
bool dp_reserve(const dp_allocator *allocator, void *block_address, size_t *capacity, size_t need,
                size_t item_size);

/* An array that a struct holds and dp_reserve grows: where its pointer and its capacity lie in the
 * struct, and the size of an item. A struct's list of them serves to free it and to count it. */
typedef struct dp_array {
    size_t pointer, capacity, size;
} dp_array;

#define DP_ARRAY(type, pointer, capacity)                                                          \
    { offsetof(type, pointer), offsetof(type, capacity), sizeof *((type *)0)->pointer }
#define DP_ARRAYS(list) (list), sizeof(list) / sizeof *(list)

/* Frees an object's arrays and leaves them empty. */
void dp_arrays_free(const dp_allocator *memory, void *object, const dp_array *arrays, size_t count);

/* How many bytes they hold. */
uint64_t dp_arrays_bytes(const void *object, const dp_array *arrays, size_t count);

#endif
