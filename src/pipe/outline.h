/* Primitive assembly: one polygon's outline on the screen. */
#ifndef DP_PIPE_OUTLINE_H
#define DP_PIPE_OUTLINE_H

#include "pipe/frame.h"

/* Scratch of one worker, grown to the largest polygon. */
typedef struct dp_outline_scratch {
    dp_clip_point *clip; /* 2 * (n + 6) */
    dp_point *points;    /* n + 6 */
    size_t clip_cap, points_cap;
} dp_outline_scratch;

void dp_outline_scratch_free(dp_outline_scratch *scratch, const dp_allocator *memory);

typedef enum dp_outline_state {
    DP_OUTLINE_OK = 0,
    DP_OUTLINE_OUTSIDE,  /* nothing of it within the guarded frustum */
    DP_OUTLINE_INDEX,    /* an index is out of range */
    DP_OUTLINE_FINITE,   /* a coordinate is NaN or infinite */
    DP_OUTLINE_MEMORY
} dp_outline_state;

typedef struct dp_outline {
    const dp_point *points; /* screen space, px; valid until the next outline with this scratch */
    uint32_t count;
    bool clipped;
} dp_outline;

dp_outline_state dp_outline_make(const dp_frame *frame, uint32_t polygon, dp_outline_scratch *scratch,
                                 dp_outline *out);

/* Front, back or edge-on. The screen's y runs down, so a front face's area is negative here. */
typedef enum dp_facing { DP_FACING_FRONT, DP_FACING_BACK, DP_FACING_EDGE_ON } dp_facing;
dp_facing dp_outline_facing(const dp_point *points, uint32_t count);

/* No area in space: all corners on one line. */
bool dp_polygon_has_no_area(const dp_frame *frame, uint32_t polygon);

#endif
