/* Curvature at vertices, and the direction of minimal curvature, which a pencil follows. */
#ifndef DP_MESH_CURVATURE_H
#define DP_MESH_CURVATURE_H

#include "base/pool.h"
#include "base/threads.h"
#include "mesh/polygons.h"

/* At a vertex. Curvatures are 1 / radius (1 / world unit), positive where convex. */
typedef struct dp_curvature {
    float least, most; /* principal curvatures, ordered by absolute value */
    float along[3];    /* direction of the least: unit, tangent, of arbitrary sign */
} dp_curvature;

/* What dp_curvature_directions keeps for the next frame. Zero is empty. */
typedef struct dp_curvature_store {
    float (*along)[3]; /* [vertices] smoothed directions */
    size_t along_cap;
    uint64_t key; /* fingerprint of polygons and positions; 0: none */
    double ms;    /* time of the last call; 0 when nothing had changed */
    bool
        moves; /* the polygons will be others in the next call: scratch is kept. It also is from the
                     second model on */
    dp_pool scratch;
} dp_curvature_store;

void dp_curvature_store_free(dp_curvature_store *store, const dp_allocator *memory);
uint64_t dp_curvature_store_bytes(const dp_curvature_store *store);

/* Estimates curvatures, out[vertex_count]; 0 at vertices without sound polygons. False when memory
 * is out. */
bool dp_curvatures(const dp_polygons *polygons, const dp_allocator *memory, dp_curvature *out);

/* Directions of minimal curvature. Uncertain ones are smoothed over neighbours; where all around is
 * flat or equally round, a fixed direction decides. Computed again only when polygons or positions
 * have changed. False when memory is out. */
bool dp_curvature_directions(dp_curvature_store *store, const dp_polygons *polygons,
                             dp_threads *threads, const dp_allocator *memory);

#endif
