/* Intersection candidates: polygons around pixels where faces may cross (intersect.c, meet.inc). */
#ifndef DP_FIND_INTERSECTIONS_H
#define DP_FIND_INTERSECTIONS_H

#include "core/spine.h"
#include "find/visibility.h"

/* Polygons around candidate pixels, sorted by the first row of their boxes. */
typedef struct dp_intersecting {
    uint32_t *polygon;
    float *members;   /* DP_INTERSECTING_… m of polygon i at m * stride + i; px, tile space; d */
    uint32_t *keys;   /* key of corner k of triangle i at k * stride + i; of others: matches none */
    uint32_t *met;    /* output of `meet`: those that one polygon may cross */
    uint32_t *listed; /* before sorting */
    struct dp_crossed *crossed; /* pairs that cross, and where (intersect.c) */
    dp_spine *crossings;
    size_t polygon_cap, members_cap, keys_cap, met_cap, listed_cap, crossed_cap, crossings_cap;
    uint32_t count, stride, crossing_count;
} dp_intersecting;

enum {
    DP_INTERSECTING_LEAST,       /* of the bounds: x, y, d */
    DP_INTERSECTING_MOST = 3,    /* of the bounds: x, y, d */
    DP_INTERSECTING_PLANE = 6,   /* d0, dx, dy; d0: NaN if clipped, edge-on or no triangle */
    DP_INTERSECTING_CORNERS = 9, /* of such a triangle: x, y, d of each corner */
    DP_INTERSECTING_MEMBERS = 18
};
enum { DP_INTERSECTING_ROOM = 16 };

/* For blocks of (1 + sx) × (1 + sy) cells with first cell (cx, cy): whose surroundings of candidate
 * pixels they touch. */
enum { DP_NEAR_FRONT = 1 /* of front faces */, DP_NEAR_BACK = 2 };
typedef uint32_t dp_cell_bits[DP_CELL_SPANS][DP_CELL_SPANS][DP_CELL_ROOM]; /* [sy][sx][cy, cx] */

void dp_intersecting_free(dp_intersecting *intersecting, const dp_allocator *memory);
uint64_t dp_intersecting_bytes(const dp_intersecting *intersecting);

#endif
