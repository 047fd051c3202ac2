/* Curved PN triangles (Vlachos, Peters, Boyd, Mitchell 2001): the cubic patch and the quadratic
 * normals over one triangle and its corner normals. */
#ifndef DP_MESH_PN_H
#define DP_MESH_PN_H

#include "base/vec.h"

#include <stdbool.h>
#include <stdint.h>

enum { DP_PN_PARTS = 16 /* the most that an edge is cut into */ };

/* What the surface does at one end of an edge. One normal: it is smooth there. Two: it is folded
 * along the edge, which then runs in both tangent planes. None: the edge runs straight on. */
typedef struct dp_pn_end {
    uint32_t count;
    dp_vec3 normal[2]; /* unit */
} dp_pn_end;

/* Control points of an edge's cubic curve; [0] and [3] are its ends. */
typedef struct dp_pn_edge {
    dp_vec3 at[4];
} dp_pn_edge;

/* The curve of the edge from a to b. The same the other way round, bit for bit. */
dp_pn_edge dp_pn_edge_between(dp_vec3 a, dp_vec3 b, const dp_pn_end *at_a, const dp_pn_end *at_b);

/* One that is not curved. */
dp_pn_edge dp_pn_edge_straight(dp_vec3 a, dp_vec3 b);

/* How far the curve's two inner control points lie from the chord's thirds. */
void dp_pn_bend(const dp_pn_edge *edge, dp_vec3 bend[2]);

/* The point `part` of `parts` along the edge. The same from either end, bit for bit. */
dp_vec3 dp_pn_edge_point(const dp_pn_edge *edge, uint32_t part, uint32_t parts);

/* A patch. `inner` is b111. */
typedef struct dp_pn_patch {
    dp_pn_edge edges[3]; /* from corner 0 to 1, 1 to 2, 2 to 0 */
    dp_vec3 inner;
} dp_pn_patch;

dp_pn_patch dp_pn_patch_within(const dp_pn_edge edges[3]);

/* The point with barycentric coordinates w[0] + w[1] + w[2] = 1. */
dp_vec3 dp_pn_point(const dp_pn_patch *patch, const double w[3]);

/* Normals at the corners and half-way along the edges. */
typedef struct dp_pn_normals {
    dp_vec3 corner[3], middle[3];
} dp_pn_normals;

dp_pn_normals dp_pn_normals_of(const dp_vec3 at[3], const dp_vec3 corner[3]);

/* Unit normal; 0 where the corners' cancel each other. */
dp_vec3 dp_pn_normal(const dp_pn_normals *normals, const double w[3]);

#endif
