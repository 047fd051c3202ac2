/* The memory of what has been found: see piece.h. */
#include "core/piece.h"

#include "base/memory.h"

static const dp_array arrays[] = {DP_ARRAY(dp_found, pieces, pieces_cap),
                                  DP_ARRAY(dp_found, geometry, geometry_cap)};

void dp_found_free(dp_found *found, const dp_allocator *memory) {
    dp_arrays_free(memory, found, DP_ARRAYS(arrays));
}

uint64_t dp_found_bytes(const dp_found *found) { return dp_arrays_bytes(found, DP_ARRAYS(arrays)); }
