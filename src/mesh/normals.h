/* Normals of corners, made from the polygons where a model brings none. */
#ifndef DP_MESH_NORMALS_H
#define DP_MESH_NORMALS_H

#include "base/threads.h"
#include "mesh/polygons.h"

/* Unit normals times 32767, 0: none. Nearly all vertices have one for all their corners, next to
 * which those of the other vertices around a polygon lie: few cache lines. */
typedef struct dp_packed_normals {
    int16_t (*vertex)[4]; /* per vertex: x, y, z, and 1 where its corners differ */
    int16_t (*corner)[3]; /* per corner */
} dp_packed_normals;

/* What dp_normals_make keeps for the next frame. Zero is empty. */
typedef struct dp_normal_store {
    float (*values)[3];
    uint32_t *indices; /* per corner */
    size_t values_cap, indices_cap, count;
    uint64_t key; /* of the polygons and the angle that these normals belong to; 0: none */
    dp_packed_normals packed; /* dp_normals_pack */
    size_t packed_corner_cap, packed_vertex_cap;
    uint64_t packed_key;

    /* scratch while normals are made */
    float (*facet)[3]; /* per polygon, unit; 0 without area */
    float *angle;      /* per corner: its weight, radians */
    uint32_t *place;   /* per vertex: the first vertex at its position */
    uint32_t *starts;  /* per vertex and one more: its corners in `around` */
    uint32_t *around;  /* corners, by place */
    uint32_t *owner;   /* per corner: its polygon */
    uint32_t *slots;   /* hash table of places, 1 + vertex */
    uint32_t *extra; /* per vertex: corners there that need a normal of their own; then the first */
    size_t facet_cap, angle_cap, place_cap, starts_cap, around_cap, owner_cap, slots_cap, extra_cap;
} dp_normal_store;

void dp_normal_store_free(dp_normal_store *store, const dp_allocator *memory);

/* Unit normals of all corners: the mean of the normals of the polygons around the corner's
 * position, weighed by their angles there (Thürmer and Wüthrich 1998), of those polygons only whose
 * normal lies within `crease` degrees (0 to 180) of the corner's own. Positions name vertices, so
 * that index buffers, split vertices and soups give the same normals. A polygon without area, of
 * coordinates that are not finite or of indices out of range neither gets nor gives any: its
 * corners have index UINT32_MAX. Nothing is computed when neither polygons nor angle have changed
 * since the last call. `known` (NULL allowed) keeps the key of polygons that never change, 0 at
 * first, so that not even that is computed again. *out is borrowed from the store. False when
 * memory is out. */
bool dp_normals_make(dp_normal_store *store, const dp_polygons *polygons, float crease,
                     uint64_t *known, dp_threads *threads, const dp_allocator *memory,
                     dp_attribute *out);

/* Fills store->packed with the polygons' normals (polygons->normals, made or the model's, of any
 * length). Nothing is done when nothing has changed since the last call. False when memory is
 * out. */
bool dp_normals_pack(dp_normal_store *store, const dp_polygons *polygons, dp_threads *threads,
                     const dp_allocator *memory);

#endif
