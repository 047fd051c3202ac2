/* Fingerprints: has an array changed since the last frame? */
#ifndef DP_MESH_FINGERPRINT_H
#define DP_MESH_FINGERPRINT_H

#include "base/threads.h"
#include "mesh/polygons.h"

/* Mixes a run of words into *key, in parallel; the same for any number of threads. False when
 * memory is out. */
bool dp_fingerprint(const uint32_t *words, size_t count, dp_threads *threads,
                    const dp_allocator *memory, uint64_t *key);

/* Fingerprint of corners and, if there are any, firsts. Never 0. False when memory is out. */
bool dp_topology_fingerprint(const dp_polygons *polygons, dp_threads *threads,
                             const dp_allocator *memory, uint64_t *key);

/* The same with positions. */
bool dp_shape_fingerprint(const dp_polygons *polygons, dp_threads *threads,
                          const dp_allocator *memory, uint64_t *key);

#endif
