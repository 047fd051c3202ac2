/* Which polygons meet at each edge: the adjacency of Hermosilla and Vázquez 2010, 2.3.1.
 *
 * Only lines that ask for it (DP_EDGES_ADJACENCY) use this; it is built once per topology. */
#ifndef DP_MESH_ADJACENCY_H
#define DP_MESH_ADJACENCY_H

#include "base/threads.h"
#include "mesh/polygons.h"

/* What lies across an edge: the corner from which the other polygon's edge starts, or one of
 * these. */
#define DP_ACROSS_OPEN UINT32_MAX /* nothing */
/* this is no edge: its ends coincide, or its polygon is of no use */
#define DP_ACROSS_NONE    (UINT32_MAX - 1)
#define DP_ACROSS_FLIPPED 0x80000000u /* or'ed in: the other polygon is wound the other way */

typedef struct dp_adjacency {
    uint32_t *across;     /* [corners] */
    uint32_t *polygon_of; /* [corners]; NULL with triangles: corner / 3 */
    uint32_t (*twins)[2]; /* vertices at the position of an earlier one, and that one */
    uint8_t *odd;   /* [polygons] has it an edge that is open, shared by more than two, or with one
                       wound the other way? */
    uint32_t *fans; /* corners at edges with more than two polygons, edge by edge */
    struct dp_fan_corner *fan_corners; /* the same by corner */
    size_t across_cap, polygon_cap, twins_cap, odd_cap, fans_cap, fan_corners_cap, twin_count,
        fan_count;
    uint32_t corners, polygons, vertices;
    uint64_t key; /* of what it was built from; 0: of nothing */
    double ms;    /* building took */
} dp_adjacency;

/* Makes `adjacency` that of `polygons`. It is built again only where the topology changed: other
 * indices, or vertices that coincided and do not any more. `built` tells (NULL allowed). False when
 * memory is out. */
bool dp_adjacency_update(dp_adjacency *adjacency, const dp_polygons *polygons, dp_threads *threads,
                         const dp_allocator *memory, bool *built);
void dp_adjacency_free(dp_adjacency *adjacency, const dp_allocator *memory);
uint64_t dp_adjacency_bytes(const dp_adjacency *adjacency);

static inline uint32_t dp_polygon_of_corner(const dp_adjacency *adjacency, uint32_t corner) {
    return adjacency->polygon_of ? adjacency->polygon_of[corner] : corner / 3;
}

/* A corner at an edge with more than two polygons: all of them are fans[first] to fans[first +
 * count - 1]. */
typedef struct dp_fan_corner {
    uint32_t corner, first, count;
} dp_fan_corner;

/* NULL where no more than two meet. */
const dp_fan_corner *dp_fan_at(const dp_adjacency *adjacency, uint32_t corner);

/* Is there a polygon across? */
static inline bool dp_is_across(uint32_t across) { return across < DP_ACROSS_NONE; }
static inline uint32_t dp_across_corner(uint32_t across) { return across & ~DP_ACROSS_FLIPPED; }

/* The six indices of a triangle (Figure 2.2): its corners at 0, 2 and 4, and at 1, 3 and 5 the
 * corner across the edge between its neighbours. At an open edge that is the triangle's own third
 * corner: its back lies across, so that the test of Listing 2.1 finds an outline there as it is. */
void dp_adjacency_six(const dp_adjacency *adjacency, const dp_polygons *polygons, uint32_t triangle,
                      uint32_t six[6]);

#endif
