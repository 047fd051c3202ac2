/* Which way each polygon faces, and whether an edge is an outline; the start of lines by adjacency
 * (DP_EDGES_ADJACENCY). */
#ifndef DP_CORE_FACING_H
#define DP_CORE_FACING_H

#include "core/frame.h"

/* Flags of a polygon, in frame->facing. */
enum {
    DP_FACING_FRONT = 1,  /* faces the eye; a polygon without area follows its neighbours */
    DP_FACING_NO_AREA = 2 /* covers nothing */
};

/* Fills frame->facing and frame->outlined, which are allocated, from frame->vertices and
 * frame->adjacency. */
void dp_find_facing(dp_frame *frame);

/* The line along the edge from `corner` of `polygon`: DP_LINE_SILHOUETTE or DP_LINE_BORDER if this
 * polygon draws it (Hermosilla and Vázquez 2010, Listing 2.1: the front-facing one does), else -1.
 * Does not tell creases from flat edges. */
int dp_outline_of_edge(const dp_frame *frame, uint32_t polygon, uint32_t corner);

static inline bool dp_faces_front(const dp_frame *frame, uint32_t polygon) {
    return frame->facing[polygon] & DP_FACING_FRONT;
}

#endif
