/* Vertices by position: the first vertex at a position represents all that lie there. */
#ifndef DP_MESH_PLACES_H
#define DP_MESH_PLACES_H

#include "mesh/polygons.h"

/* Fills first[vertex_count] with the first vertex at the same position. A vertex with a NaN
 * represents itself. False when memory is out. */
bool dp_find_places(const dp_polygons *polygons, uint32_t *first, const dp_allocator *memory);

#endif
