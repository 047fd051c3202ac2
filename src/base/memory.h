/* Memory through the caller's allocator. */
#ifndef DP_BASE_MEMORY_H
#define DP_BASE_MEMORY_H

#include <drypoint/base.h>

/* A copy with defaults filled in; `allocator` may be NULL. */
dp_allocator dp_allocator_resolve(const dp_allocator *allocator);

/* a * b, or SIZE_MAX, which no allocation grants, on overflow. For sizes that a file, a picture or
 * the caller has a say in: 32 bits of size_t are soon exceeded. */
static inline size_t dp_times(size_t a, size_t b) {
    return b && a > SIZE_MAX / b ? SIZE_MAX : a * b;
}

/* NULL: out of memory, or size > PTRDIFF_MAX, which no object may have. */
void *dp_alloc(const dp_allocator *allocator, size_t size);
void *dp_alloc_zeroed(const dp_allocator *allocator, size_t size);
/* count * size bytes. */
void *dp_alloc_array(const dp_allocator *allocator, size_t count, size_t size);
void dp_free(const dp_allocator *allocator, void *block);

/* Makes room for `need` items in *block (the address of any object pointer), growing by at least
 * half. False: out of memory; the block is unchanged. */
bool dp_reserve(const dp_allocator *allocator, void *block_address, size_t *capacity, size_t need,
                size_t item_size);

/* The same; items beyond those that there were are zeros. */
bool dp_reserve_zeroed(const dp_allocator *allocator, void *block_address, size_t *capacity,
                       size_t need, size_t item_size);

/* An array in a struct that dp_reserve grows: where in the struct its pointer and capacity are, and
 * the size of an item. A struct's list of these is used to free its arrays and to count their
 * bytes. */
typedef struct dp_array {
    size_t pointer, capacity, size;
} dp_array;

#define DP_ARRAY(type, pointer, capacity)                                                          \
    { offsetof(type, pointer), offsetof(type, capacity), sizeof *((type *)0)->pointer }
#define DP_ARRAYS(list) (list), sizeof(list) / sizeof *(list)

/* Frees an object's arrays and leaves them empty. */
void dp_arrays_free(const dp_allocator *memory, void *object, const dp_array *arrays, size_t count);

/* Bytes held by an object's arrays. */
uint64_t dp_arrays_bytes(const void *object, const dp_array *arrays, size_t count);

#endif
