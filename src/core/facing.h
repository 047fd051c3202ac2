/* Which way every polygon faces, and whether an edge is an outline: what lines by adjacency
 * (DP_EDGES_ADJACENCY) begin with. */
#ifndef DP_CORE_FACING_H
#define DP_CORE_FACING_H

#include "core/frame.h"

/* Of a polygon, in frame->facing. */
enum {
    DP_FACING_FRONT = 1,  /* it faces the eye; one without area goes with its neighbours */
    DP_FACING_NO_AREA = 2 /* it covers nothing and is seen through */
};

/* Fills frame->facing and frame->outlined (allocated), from frame->vertices and
 * frame->adjacency. */
void dp_find_facing(dp_frame *frame);

/* The line that the edge from `corner` of `polygon` is, seen from that polygon: DP_LINE_SILHOUETTE
 * or DP_LINE_BORDER where the polygon has to draw it (Hermosilla and Vázquez 2010, Listing 2.1: the
 * front-facing one), -1 otherwise. Creases are not told from flat edges here. */
int dp_outline_of_edge(const dp_frame *frame, uint32_t polygon, uint32_t corner);

static inline bool dp_faces_front(const dp_frame *frame, uint32_t polygon) {
    return frame->facing[polygon] & DP_FACING_FRONT;
}

#endif
