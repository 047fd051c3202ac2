/* The intersection candidates: polygons around pixels where faces may cross (intersect.c, meet.inc). */
#ifndef DP_FIND_INTERSECTIONS_H
#define DP_FIND_INTERSECTIONS_H

#include "find/visibility.h"

/* Polygons around pixels where faces may cross (intersect.c), sorted by the first row of their
 * boxes. */
typedef struct dp_intersecting {
    uint32_t *polygon;
    float *
        members; /* DP_INTERSECTING_…, px (tile space) and d, `stride` floats from one to the next */
    uint32_t *keys; /* of triangles' corners, by corner, `stride` from one to the next; what belongs
                       to no other: none */
    uint32_t *met;  /* those that one of them may cross */
    uint32_t *listed; /* before they are sorted */
    size_t polygon_cap, members_cap, keys_cap, met_cap, listed_cap;
    uint32_t count, stride;
} dp_intersecting;

enum {
    DP_INTERSECTING_LEAST,       /* x, y, d of the bounds */
    DP_INTERSECTING_MOST = 3,    /* the same */
    DP_INTERSECTING_PLANE = 6,   /* d0, dx, dy; d0 is NaN of all but triangles as they were given,
                             seen from a side */
    DP_INTERSECTING_CORNERS = 9, /* of such triangles: x, y, d of each */
    DP_INTERSECTING_MEMBERS = 18
};
enum { DP_INTERSECTING_ROOM = 16 };

/* What is around candidate pixels in 1 + sx times 1 + sy cells, the first of which is cx, cy. */
enum { DP_NEAR_FRONT = 1 /* for front faces */, DP_NEAR_BACK = 2 };
typedef uint32_t dp_cell_bits[DP_CELL_SPANS][DP_CELL_SPANS][DP_CELL_ROOM]; /* [sy][sx][cy, cx] */

void dp_intersecting_free(dp_intersecting *intersecting, const dp_allocator *memory);
uint64_t dp_intersecting_bytes(const dp_intersecting *intersecting);

#endif
