/* Fingerprints: has an array changed since the last frame? */
#ifndef DP_MESH_FINGERPRINT_H
#define DP_MESH_FINGERPRINT_H

#include "base/threads.h"
#include "mesh/polygons.h"

/* Mixes a run of words into *key, in parallel; the same for any number of threads. */
void dp_fingerprint(const uint32_t *words, size_t count, dp_threads *threads, uint64_t *key);

/* Fingerprint of corners and, if there are any, firsts. Never 0. */
uint64_t dp_topology_fingerprint(const dp_polygons *polygons, dp_threads *threads);

/* The same with positions. */
uint64_t dp_shape_fingerprint(const dp_polygons *polygons, dp_threads *threads);

#endif
