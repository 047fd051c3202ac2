/* Writing the triangles of a curved patch, and all that its corners have, into a frame's polygons. */
#ifndef DP_CORE_PATCH_H
#define DP_CORE_PATCH_H

#include "mesh/edge_normals.h"
#include "mesh/pn_grid.h"
#include "mesh/polygons.h"

/* What is noted of an edge: into how many parts it is cut, and … */
enum {
    DP_NOTED_PARTS = 31,
    DP_NOTED_CURVED = 64, /* its polygon, whose first edge it is, becomes patches */
    DP_NOTED_SMOOTH = 128 /* the surface is smooth across it */
};

/* Is edge k of the patch over corners 0, i and i + 1 of n a diagonal of the polygon? */
static inline bool dp_is_fan_diagonal(uint32_t n, uint32_t i, int k) {
    return (k == 0 && i > 1) || (k == 2 && i + 2 < n);
}

/* Where to put what comes next, and the arrays; NULL: not wanted. New normals and texture coordinates
 * have the numbers of new vertices, after those that there were. */
typedef struct dp_patch_target {
    const dp_polygons *from;
    float (*positions)[3];
    uint32_t *corners, *firsts, *source_polygon, *colors;
    uint16_t *source_edges, *groups;
    uint8_t *edge_flags, *smooth_edges;
    const uint8_t *noted; /* [corners] of what there was; DP_NOTED_SMOOTH: smooth across the edge */
    const dp_corner_normals *corner_normals;
    float (*normals)[3];
    float (*texcoords)[2];
    uint32_t *normal_at, *texcoord_at;
    uint32_t normal_base;             /* the first new normal's number */
    uint32_t polygon, corner, vertex; /* of the next */
    dp_pn_grid *grid;                 /* of the last patch: many are cut alike */
} dp_patch_target;

/* A polygon as it is. */
void dp_patch_put_flat(dp_patch_target *target, uint32_t polygon);

/* The patch over corners 0, i and i + 1 of a polygon. */
void dp_patch_put(dp_patch_target *target, uint32_t polygon, uint32_t i, const dp_pn_edge curves[3],
                  const uint32_t parts[3]);

#endif
