/* A polygon source's inside: callbacks and an allocator. */
#ifndef DP_MESH_SOURCE_H
#define DP_MESH_SOURCE_H

#include "base/memory.h"
#include <drypoint/source.h>

struct dp_source {
    dp_source_callbacks callbacks;
    dp_allocator allocator;
};

#endif
