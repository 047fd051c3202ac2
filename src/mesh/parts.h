/* What pulling an assembly apart asks of a source. */
#ifndef DP_MESH_PARTS_H
#define DP_MESH_PARTS_H

#include "base/memory.h"
#include <drypoint/source.h>

/* Of a scene of several sources: the number of the one that a group is of. False: it is no scene. */
bool dp_source_part(const dp_source *source, uint32_t group, uint32_t *part);

/* The allocator that the source was made with. */
const dp_allocator *dp_source_memory(const dp_source *source);

#endif
