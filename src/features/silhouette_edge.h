/* Silhouette edges on the screen, with what their extrusion needs: the outside, and vertex
 * normals. */
#ifndef DP_FEATURES_SILHOUETTE_EDGE_H
#define DP_FEATURES_SILHOUETTE_EDGE_H

#include "features/extrude.h"
#include "core/frame.h"

/* The edge from `corner` of `polygon`, clipped to the guarded frustum. False: nothing of it is
 * seen. */
bool dp_find_silhouette_edge(const dp_frame *frame, uint32_t polygon, uint32_t corner,
                             dp_silhouette_edge *out);

/* The side of the edge a -> b of `polygon` on which the polygon does not lie, unit, screen space.
 * Needs no adjacency. */
void dp_find_outside(const dp_frame *frame, uint32_t polygon, dp_pointd a, dp_pointd b,
                     double out[2]);

/* Normal of the vertex from which the edge at `corner` starts: the mean of the polygons around it,
 * found by walking round it from neighbour to neighbour. Unit; zero where it cannot be told. Needs
 * adjacency. */
dp_vec3 dp_vertex_normal(const dp_frame *frame, uint32_t corner);

/* Polar stroke textures: how often the texture goes round in one turn, a whole number so that the
 * turn's end meets its start. It is as long as natural at the distance of the projected box's
 * corners. */
float dp_polar_repeats(const dp_frame *frame, const dp_stroke_style *stroke, float width);

/* Fills frame->centre and frame->radius: the projected centre of the box of all vertices, and how
 * far the projected box reaches from it; px. */
void dp_find_centre(dp_frame *frame);

#endif
