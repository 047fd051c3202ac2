/* Vertices around which a surface is closed and wound alike. */
#ifndef DP_CORE_CLOSED_H
#define DP_CORE_CLOSED_H

#include "core/frame.h"

/* Fills frame->closed from frame->polygons and frame->vertices, where frame->exact_ends. False: out of
 * memory. */
bool dp_find_closed(dp_frame *frame);

/* Is every edge at the vertex with this key run by as many polygons one way as the other? Only asked
 * where frame->exact_ends. Now and then it is not known, and the answer is no. */
static inline bool dp_is_closed_at(const dp_frame *frame, uint32_t key) {
    return !frame->closed[key >> frame->closed_shift];
}

#endif
