/* Silhouette edges on the screen, with what extruding them needs: the outside, and vertex
 * normals. */
#ifndef DP_FEATURES_SILHOUETTE_EDGE_H
#define DP_FEATURES_SILHOUETTE_EDGE_H

#include "features/extrude.h"
#include "core/frame.h"

/* The edge that starts at `corner` of `polygon`, clipped to the guarded frustum. False: nothing of
 * it is seen. */
bool dp_find_silhouette_edge(const dp_frame *frame, uint32_t polygon, uint32_t corner,
                             dp_silhouette_edge *out);

/* Unit vector, screen space, to the side of the edge a -> b on which `polygon` does not lie. Needs
 * no adjacency. */
void dp_find_outside(const dp_frame *frame, uint32_t polygon, dp_pointd a, dp_pointd b,
                     double out[2]);

/* Normal of the vertex where the edge at `corner` starts: the mean of the polygons around it, found
 * by stepping from neighbour to neighbour. Unit; zero if it has none. Needs adjacency. */
dp_vec3 dp_vertex_normal(const dp_frame *frame, uint32_t corner);

/* Polar stroke textures: how often the texture repeats in a full turn. A whole number, so that both
 * ends of the turn meet; at the distance of the projected box's corners it has its natural
 * length. */
float dp_polar_repeats(const dp_frame *frame, const dp_stroke_style *stroke, float width);

/* Sets frame->centre and frame->radius, px: the projected centre of the box of all vertices
 * (Hermosilla and Vázquez 2010, 2.3.3), and how far the projected box reaches from it; and
 * frame->middle_pixel. */
void dp_find_centre(dp_frame *frame);

#endif
