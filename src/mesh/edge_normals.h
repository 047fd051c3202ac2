/* The normals at the ends of edges, for curves that are the same from both sides. */
#ifndef DP_MESH_EDGE_NORMALS_H
#define DP_MESH_EDGE_NORMALS_H

#include "base/pool.h"
#include "base/threads.h"
#include "mesh/pn.h"
#include "mesh/polygons.h"

/* An edge at one of whose ends normals differ. */
typedef struct dp_hard_edge {
    uint32_t place[2];     /* the first vertices at its ends, rising */
    uint8_t count[2];      /* normals at each end; 3: more than two */
    float normal[2][2][3]; /* unit */
} dp_hard_edge;

/* Zero is empty. */
typedef struct dp_edge_normals {
    float (
        *smooth)[3]; /* [vertices] the one normal at the vertex's position, unit; 0: there is none,
                           or several */
    uint32_t *hard_at; /* [corners] 1 + 2 times the hard edge that starts there, + 1 if it starts at
                           its second end; 0: both ends are smooth. With hard_count 0 not there */
    dp_hard_edge *hard; /* [hard_count] */
    uint32_t hard_count;
    uint64_t key; /* fingerprint of what they were made of; 0: nothing */
    bool
        moves; /* the polygons will be others in the next call: scratch is kept. It also is from the
                   second model on */

    /* scratch */
    uint32_t *place; /* [vertices] the first vertex at its position */
    uint8_t *differ; /* [vertices] */
    uint32_t *slots; /* hash table of hard edges: 1 + number; 0: free */
    dp_pool pool;    /* for finding places */
    size_t smooth_cap, hard_at_cap, hard_cap, place_cap, differ_cap, slots_cap;
} dp_edge_normals;

void dp_edge_normals_free(dp_edge_normals *normals, const dp_allocator *memory);
uint64_t dp_edge_normals_bytes(const dp_edge_normals *normals);

/* A corner's own normal, from the model's or, where that has none for it, from those made. */
typedef struct dp_corner_normals {
    dp_attribute given, made; /* values NULL: none */
} dp_corner_normals;

/* Its number: that of the given one, or given.count and on for the made one; UINT32_MAX: none. A normal
 * that is zero or not finite is none. */
uint32_t dp_corner_normal_number(const dp_corner_normals *normals, uint32_t corner,
                                 uint32_t vertex);

/* Of any length. The number must not be UINT32_MAX. */
static inline const float *dp_corner_normal_value(const dp_corner_normals *n, uint32_t number) {
    return number < n->given.count
               ? dp_attribute_value(&n->given, number)
               : dp_attribute_value(&n->made, number - (uint32_t)n->given.count);
}

/* Collects the normals by position and by edge, unless polygons and normals are those of the last
 * call. False when memory is out. */
bool dp_edge_normals_collect(dp_edge_normals *out, const dp_polygons *polygons,
                             const dp_corner_normals *normals, dp_threads *threads,
                             const dp_allocator *memory);

/* The normals at an edge's ends. `edge`: the corner at which a polygon's edge starts, or UINT32_MAX
 * for a diagonal, which has the polygon's own normals: a and b are their numbers. */
void dp_edge_ends_at(const dp_edge_normals *collected, const dp_corner_normals *normals,
                     const uint32_t vertices[2], uint32_t edge, const uint32_t own[2],
                     dp_pn_end ends[2]);

#endif
