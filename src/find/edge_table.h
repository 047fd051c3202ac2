/* The edge table of a tile: which polygons meet at an edge (edge_table.c). */
#ifndef DP_FIND_EDGE_TABLE_H
#define DP_FIND_EDGE_TABLE_H

#include "find/finder.h"

/* One edge of one polygon of the tile. */
typedef struct dp_half_edge {
    uint32_t polygon, edge; /* tile polygon; number of the corner that the edge starts from */
} dp_half_edge;

/* An edge taken from the table. */
typedef struct dp_edge_entry {
    uint32_t va, vb;         /* vertices, in the direction of polygon a */
    uint32_t a, b;           /* tile polygons; b is UINT32_MAX where a is alone */
    uint32_t edge_a, edge_b; /* corner number within the polygon */
    uint32_t more;           /* 1 + first of the meetings beyond b; 0: none */
    bool opposed;            /* b runs from vb to va, as consistent winding demands */
} dp_edge_entry;

/* `list` lists the half-edges of all seen polygons, without most flat ones, and the triangles whose
 * normals must be made before `fill` enters the list into the table. False: out of memory. */
bool dp_edge_table_list(dp_finder *worker);
bool dp_edge_table_fill(dp_finder *worker);

/* The first half-edge from `number` on that may be a line; of several at one edge it is the one
 * that was entered first. UINT32_MAX: there is none. */
uint32_t dp_edge_table_next(const dp_finder *worker, uint32_t number);

/* What met at this edge. va and vb are left to dp_edge_ends, so that the caller can prefetch what
 * that reads. */
dp_edge_entry dp_edge_table_entry(const dp_finder *worker, uint32_t number);

/* The half-edge with this number in the list; its vertices, in its polygon's direction; whether it
 * runs between two vertices, either way. */
dp_half_edge dp_half_edge_of(const dp_finder *worker, uint32_t number);
void dp_edge_ends(const dp_finder *worker, dp_half_edge edge, uint32_t *va, uint32_t *vb);
bool dp_edge_runs_between(const dp_finder *worker, dp_half_edge edge, uint32_t va, uint32_t vb);

#endif
