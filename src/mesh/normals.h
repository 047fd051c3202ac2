/* Normals of corners, computed from the polygons where a model has none. */
#ifndef DP_MESH_NORMALS_H
#define DP_MESH_NORMALS_H

#include "base/threads.h"
#include "mesh/polygons.h"

/* Unit normals times 32767; 0: none. Most vertices have one normal for all corners, and a polygon's
 * vertices lie close together, so that few cache lines are read. */
typedef struct dp_packed_normals {
    int16_t (*vertex)[4]; /* [vertices] x, y, z, and 1 where its corners differ */
    int16_t (*corner)[3]; /* [corners] x, y, z */
} dp_packed_normals;

/* What dp_normals_make keeps for the next frame. Zero is empty. */
typedef struct dp_normal_store {
    float (*values)[3]; /* [count] */
    uint32_t *indices;  /* [corners] */
    size_t values_cap, indices_cap, count;
    uint64_t key; /* fingerprint of the polygons and the angle of these normals; 0: none */
    bool
        moves; /* the polygons will be others in the next call: scratch is kept. It also is from the
                   second model on */
    dp_packed_normals packed; /* dp_normals_pack */
    size_t packed_corner_cap, packed_vertex_cap;
    uint64_t packed_key;

    /* scratch of dp_normals_make */
    float (*facet)[3]; /* [polygons] unit; 0 without area */
    float *angle;      /* [corners] weight, radians */
    uint32_t *place;   /* [vertices] the first vertex at its position */
    uint32_t *starts;  /* [vertices + 1] where its corners begin in `around` */
    uint32_t *around;  /* [corners] by place */
    uint32_t *owner;   /* [corners] polygon */
    uint32_t *slots;   /* hash table of places: 1 + vertex; 0: free */
    uint32_t *extra;   /* [vertices] corners that need their own normal; then the first's number */
    size_t facet_cap, angle_cap, place_cap, starts_cap, around_cap, owner_cap, slots_cap, extra_cap;
} dp_normal_store;

void dp_normal_store_free(dp_normal_store *store, const dp_allocator *memory);
uint64_t dp_normal_store_bytes(const dp_normal_store *store);

/* Unit normals of all corners. A corner's is the mean of the polygons around its position, weighed
 * by their angles there (Thürmer and Wüthrich 1998); only of those whose normal lies within
 * `crease` degrees (0 to 180) of its own polygon's. Vertices at one position count as one, so that
 * index buffers, split vertices and soups give the same normals. Bad polygons (no area, not finite,
 * index out of range) do not count, and their corners have index UINT32_MAX.
 *
 * Nothing is computed when neither polygons nor angle have changed since the last call. known:
 * NULL, or where to keep the key of polygons that never change (0 at first), so that it is not
 * computed again. *out is borrowed from the store. False when memory is out. */
bool dp_normals_make(dp_normal_store *store, const dp_polygons *polygons, float crease,
                     uint64_t *known, dp_threads *threads, const dp_allocator *memory,
                     dp_attribute *out);

/* Fills store->packed from polygons->normals (computed or the model's, any length), unless they
 * have not changed since the last call. False when memory is out. */
bool dp_normals_pack(dp_normal_store *store, const dp_polygons *polygons, dp_threads *threads,
                     const dp_allocator *memory);

#endif
