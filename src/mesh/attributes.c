/* Attributes of several batches: all values in a row, and an index for every corner. */
#include "mesh/attributes.h"

#include <string.h>

static const dp_array arrays[] = {DP_ARRAY(dp_attribute_store, values, values_cap),
                                  DP_ARRAY(dp_attribute_store, indices, indices_cap)};

void dp_attribute_store_free(dp_attribute_store *store, const dp_allocator *memory) {
    dp_arrays_free(memory, store, DP_ARRAYS(arrays));
    *store = (dp_attribute_store){0};
}

uint64_t dp_attribute_store_bytes(const dp_attribute_store *store) {
    return dp_arrays_bytes(store, DP_ARRAYS(arrays));
}

bool dp_attribute_reserve_corners(dp_attribute_store *store, size_t corners,
                                  const dp_allocator *memory) {
    return !store->used || dp_reserve(memory, &store->indices, &store->indices_cap, corners,
                                      sizeof *store->indices);
}

bool dp_attribute_add_values(dp_attribute_store *store, const dp_attribute *from, size_t width,
                             size_t corners, const dp_allocator *memory) {
    if (!from->values || !from->count) return true;
    const size_t count = store->count + from->count;
    if (count >= DP_ATTRIBUTE_NONE || !dp_reserve(memory, &store->values, &store->values_cap,
                                                  dp_times(count, width), sizeof *store->values))
        return false;
    if (!store->used) {
        store->used = true;
        if (!dp_attribute_reserve_corners(store, corners, memory)) return false;
        if (corners) memset(store->indices, 0xff, corners * sizeof *store->indices);
    }
    for (size_t i = 0; i < from->count; i++)
        memcpy(store->values + (store->count + i) * width, dp_attribute_value(from, (uint32_t)i),
               width * sizeof(float));
    store->count = count;
    return true;
}

bool dp_attribute_lacks(const dp_attribute_store *store, size_t count) {
    size_t c = 0;
    if (!store->used) return false;
    while (c < count && store->indices[c] != UINT32_MAX) c++;
    return c < count;
}

bool dp_attribute_fill(dp_attribute_store *store, const dp_attribute *from, size_t width,
                       size_t corners, const dp_allocator *memory) {
    const size_t base = store->count;
    if (!dp_attribute_add_values(store, from, width, corners, memory)) return false;
    for (size_t c = 0; c < corners; c++)
        if (store->indices[c] == UINT32_MAX)
            store->indices[c] = (uint32_t)base + (from->indices ? from->indices[c] : (uint32_t)c);
    return true;
}

dp_attribute dp_attribute_of_store(const dp_attribute_store *store, size_t width) {
    if (!store->used) return (dp_attribute){0};
    return (dp_attribute){.values = store->values,
                          .stride = width * sizeof(float),
                          .count = store->count,
                          .indices = store->indices};
}
