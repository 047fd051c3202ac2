/* A tile's table of edges: which polygons meet at an edge (edge_table.c). */
#ifndef DP_FIND_EDGE_TABLE_H
#define DP_FIND_EDGE_TABLE_H

#include "find/finder.h"

/* An edge of a polygon of the tile. */
typedef struct dp_half_edge {
    uint32_t polygon, edge; /* tile polygon; number of the corner that the edge starts from */
} dp_half_edge;

/* An edge taken from the table. */
typedef struct dp_edge_entry {
    uint32_t va, vb;         /* vertices, in the direction of polygon a */
    uint32_t a, b;           /* tile polygons; b is UINT32_MAX where a is alone */
    uint32_t edge_a, edge_b; /* corner number within the polygon */
    uint32_t more;           /* 1 + first of the meetings beyond b, 0: none */
    bool opposed;            /* b runs it from vb to va, as it should */
} dp_edge_entry;

/* Lists the edges of all seen polygons, but for many that are flat, and those of triangles whose
 * normals are to be made, then; enters what is listed. False when memory is out. */
bool dp_edge_table_list(dp_finder *worker);
bool dp_edge_table_fill(dp_finder *worker);

/* The number of the first edge from `number` on that may be a line, as the polygon has it that came
 * first; UINT32_MAX: there is none. */
uint32_t dp_edge_table_next(const dp_finder *worker, uint32_t number);

/* What met at such an edge; va and vb are left to dp_edge_ends, which reads what may be asked for
 * in between. */
dp_edge_entry dp_edge_table_entry(const dp_finder *worker, uint32_t number);

/* Whose edge a number is; its vertices, in that polygon's direction; and does it run between these
 * vertices, one way or the other? */
dp_half_edge dp_half_edge_of(const dp_finder *worker, uint32_t number);
void dp_edge_ends(const dp_finder *worker, dp_half_edge edge, uint32_t *va, uint32_t *vb);
bool dp_edge_runs_between(const dp_finder *worker, dp_half_edge edge, uint32_t va, uint32_t vb);

#endif
