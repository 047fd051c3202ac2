/* Normals and texture coordinates of corners, gathered from several batches. */
#ifndef DP_MESH_ATTRIBUTES_H
#define DP_MESH_ATTRIBUTES_H

#include "base/memory.h"
#include <drypoint/source.h>

/* The index of a corner without a value, where its batch had some; UINT32_MAX where it had none. */
#define DP_ATTRIBUTE_NONE (UINT32_MAX - 1)

/* One attribute of all batches so far. Zero is empty. Invariant: if `used`, every corner added has
 * an index. */
typedef struct dp_attribute_store {
    float *values;
    uint32_t *indices;              /* per corner */
    size_t values_cap, indices_cap; /* floats; corners */
    size_t count;                   /* values */
    bool used;                      /* a batch had some */
} dp_attribute_store;

void dp_attribute_store_free(dp_attribute_store *store, const dp_allocator *memory);
uint64_t dp_attribute_store_bytes(const dp_attribute_store *store);

/* Copies a batch's values, `width` floats each; `corners` have been added before. False when memory
 * is out. */
bool dp_attribute_add_values(dp_attribute_store *store, const dp_attribute *from, size_t width,
                             size_t corners, const dp_allocator *memory);

/* Makes room for `corners` in all. False when memory is out. */
bool dp_attribute_reserve_corners(dp_attribute_store *store, size_t corners,
                                  const dp_allocator *memory);

/* Is one of corners[0, count) of a batch without values? */
bool dp_attribute_lacks(const dp_attribute_store *store, size_t count);

/* Gives the corners of batches without values those of `from`, which has some for all
 * corners. False when memory is out. */
bool dp_attribute_fill(dp_attribute_store *store, const dp_attribute *from, size_t width,
                       size_t corners, const dp_allocator *memory);

/* The attribute of all corners added; borrowed. */
dp_attribute dp_attribute_of_store(const dp_attribute_store *store, size_t width);

/* The number of a corner's value, UINT32_MAX for none. */
static inline uint32_t dp_attribute_number(const dp_attribute *a, size_t corner, uint32_t vertex) {
    if (!a->values) return UINT32_MAX;
    const uint32_t number = a->indices ? a->indices[corner] : vertex;
    return number < a->count ? number : UINT32_MAX;
}

static inline const float *dp_attribute_value(const dp_attribute *a, uint32_t number) {
    return (const float *)(const void *)((const char *)a->values + (size_t)number * a->stride);
}

/* Sets corner `to`, which is corner `corner` of the batch whose values were added last. */
static inline void dp_attribute_add_corner(dp_attribute_store *store, const dp_attribute *from,
                                           size_t corner, uint32_t vertex, size_t to) {
    if (!store->used) return;
    const uint32_t number = dp_attribute_number(from, corner, vertex);
    store->indices[to] = !from->values          ? UINT32_MAX
                         : number == UINT32_MAX ? DP_ATTRIBUTE_NONE
                                                : (uint32_t)(store->count - from->count) + number;
}

#endif
