/* How a triangle whose edges are cut into parts is cut into triangles. */
#ifndef DP_MESH_PN_GRID_H
#define DP_MESH_PN_GRID_H

#include "mesh/pn.h"

enum {
    DP_PN_TRIANGLES = DP_PN_PARTS * DP_PN_PARTS,
    DP_PN_VERTICES = (DP_PN_PARTS + 1) * (DP_PN_PARTS + 2) / 2,
    DP_PN_INSIDE = 3 /* no outer edge */
};

/* The grid over one triangle. Vertices: its corners, then the points that cut edge 0 (from corner 0
 * to 1), edge 1, edge 2, in the edges' direction, then inner points. */
typedef struct dp_pn_grid {
    uint32_t parts[3];  /* of the edges */
    uint32_t rows;      /* inner points are those of so many rows */
    uint32_t starts[4]; /* first points of the edges; of the inner ones */
    uint32_t vertex_count, triangle_count;
    uint8_t triangles[DP_PN_TRIANGLES][3]; /* vertices, wound as the triangle */
    uint8_t edges[DP_PN_TRIANGLES][3];     /* the outer edge on which theirs lie, or DP_PN_INSIDE */
    double weights[DP_PN_VERTICES][3];     /* barycentric coordinates of the vertices */
} dp_pn_grid;

/* Vertices beyond the three corners, and triangles, that dp_pn_grid_make makes. */
uint32_t dp_pn_new_vertices(const uint32_t parts[3]);
uint32_t dp_pn_triangle_count(const uint32_t parts[3]);

/* parts: 1 to DP_PN_PARTS. */
void dp_pn_grid_make(dp_pn_grid *grid, const uint32_t parts[3]);

#endif
