/* Curvature at vertices, and the direction in which the surface bends least: what a pencil
 * follows. */
#ifndef DP_MESH_CURVATURE_H
#define DP_MESH_CURVATURE_H

#include "base/threads.h"
#include "mesh/polygons.h"

/* At a vertex. Curvatures are 1 / radius, positive where the surface bends away from its front. */
typedef struct dp_curvature {
    float least, most; /* principal curvatures, by absolute value */
    float along[3];    /* direction of the least, unit, tangent; its sign means nothing */
} dp_curvature;

/* What dp_curvature_directions keeps for the next frame. Zero is empty. */
typedef struct dp_curvature_store {
    float (*along)[3]; /* [vertices] smoothed directions */
    size_t along_cap;
    uint64_t key; /* of polygons and positions; 0: none */
    double ms;    /* making took, the last time; 0 when they were kept */
} dp_curvature_store;

void dp_curvature_store_free(dp_curvature_store *store, const dp_allocator *memory);

/* Curvatures as estimated, out[vertex_count]; vertices of no use get zero curvature. False: memory
 * is out. */
bool dp_curvatures(const dp_polygons *polygons, const dp_allocator *memory, dp_curvature *out);

/* Directions of least curvature, smoothed over neighbours as far as they are uncertain, with a
 * steady direction where all around is as flat or as round. Made again only when polygons or
 * positions have changed. */
bool dp_curvature_directions(dp_curvature_store *store, const dp_polygons *polygons,
                             dp_threads *threads, const dp_allocator *memory);

#endif
