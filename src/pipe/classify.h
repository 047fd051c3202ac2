/* What kind of edge two polygons make: normals and dihedral angle, in double precision. */
#ifndef DP_PIPE_CLASSIFY_H
#define DP_PIPE_CLASSIFY_H

#include "pipe/tile.h"

/* Unit normal by Newell's method, world space; zero for a polygon without area. */
dp_vec3 dp_polygon_normal(const dp_frame *frame, uint32_t polygon);

typedef struct dp_edge_geometry {
    dp_vec3 normal_a, normal_b; /* unit */
    dp_vec3 normal;             /* mean, unit: away from the surface */
    bool concave;
} dp_edge_geometry;

/* Of the edge where frame polygons a and b meet; b's normal is turned to agree with a's winding. */
dp_edge_geometry dp_edge_geometry_of(const dp_frame *frame, const dp_edge_entry *edge, uint32_t a,
                                     uint32_t b);

/* Degrees: 180 is flat, less is convex (Raskar 2001, 2.2). */
double dp_edge_dihedral(const dp_edge_geometry *geometry);

#endif
