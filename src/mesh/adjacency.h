/* Which polygons meet at each edge (Hermosilla and Vázquez 2010, 2.3.1).
 *
 * Only DP_EDGES_ADJACENCY uses this; it is built once per topology. */
#ifndef DP_MESH_ADJACENCY_H
#define DP_MESH_ADJACENCY_H

#include "base/threads.h"
#include "mesh/polygons.h"

/* What lies across an edge: the corner where the other polygon's edge starts, or one of these. */
#define DP_ACROSS_OPEN    UINT32_MAX       /* nothing: a border */
#define DP_ACROSS_NONE    (UINT32_MAX - 1) /* no edge: its ends coincide, or its polygon is bad */
#define DP_ACROSS_FLIPPED 0x80000000u      /* or'ed in: the other polygon is wound the other way */

typedef struct dp_adjacency {
    uint32_t *across;     /* [corners] what lies across the edge that starts at a corner */
    uint32_t *polygon_of; /* [corners]; NULL with triangles: corner / 3 */
    uint32_t (*twins)[2]; /* [twin_count] a vertex, and the first one at its position */
    uint8_t *odd;         /* [polygons] 1: has an edge that is open, in a fan, or flipped */
    uint32_t *fans;       /* [fan_count] corners at edges with more than two polygons, by edge */
    struct dp_fan_corner *fan_corners; /* [fan_count] the same, by corner */
    size_t across_cap, polygon_cap, twins_cap, odd_cap, fans_cap, fan_corners_cap, twin_count,
        fan_count;
    uint32_t corners, polygons, vertices;
    uint64_t key; /* fingerprint of what it was built from; 0: of nothing */
    double ms;    /* time that the last call took to build it */
} dp_adjacency;

/* Makes `adjacency` that of `polygons`. It is built again only if the topology has changed: other
 * indices, or vertices that no longer coincide. *built (NULL allowed): whether it was. False when
 * memory is out. */
bool dp_adjacency_update(dp_adjacency *adjacency, const dp_polygons *polygons, dp_threads *threads,
                         const dp_allocator *memory, bool *built);
void dp_adjacency_free(dp_adjacency *adjacency, const dp_allocator *memory);
uint64_t dp_adjacency_bytes(const dp_adjacency *adjacency);

static inline uint32_t dp_polygon_of_corner(const dp_adjacency *adjacency, uint32_t corner) {
    return adjacency->polygon_of ? adjacency->polygon_of[corner] : corner / 3;
}

/* A corner at an edge with more than two polygons; their corners are fans[first, first + count). */
typedef struct dp_fan_corner {
    uint32_t corner, first, count;
} dp_fan_corner;

/* NULL where at most two polygons meet. */
const dp_fan_corner *dp_fan_at(const dp_adjacency *adjacency, uint32_t corner);

/* Is there a polygon across? */
static inline bool dp_is_across(uint32_t across) { return across < DP_ACROSS_NONE; }
static inline uint32_t dp_across_corner(uint32_t across) { return across & ~DP_ACROSS_FLIPPED; }

/* The six indices of a triangle (Hermosilla and Vázquez 2010, Figure 2.2): its corners at 0, 2 and
 * 4; at 1, 3 and 5 the corner across the edge between its neighbours in the list. Across an open
 * edge that is the triangle's own third corner: its own back, so that the test of Listing 2.1 finds
 * an outline there unchanged. */
void dp_adjacency_six(const dp_adjacency *adjacency, const dp_polygons *polygons, uint32_t triangle,
                      uint32_t six[6]);

#endif
