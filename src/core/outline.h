/* Primitive assembly: the outline of one polygon on the screen. */
#ifndef DP_CORE_OUTLINE_H
#define DP_CORE_OUTLINE_H

#include "core/frame.h"

/* Scratch of one worker; grows to the largest polygon. */
typedef struct dp_outline_scratch {
    dp_clip_point *clip; /* 2 * (n + 6) */
    dp_point *points;    /* n + 6 */
    size_t clip_cap, points_cap;
} dp_outline_scratch;

void dp_outline_scratch_free(dp_outline_scratch *scratch, const dp_allocator *memory);
uint64_t dp_outline_scratch_bytes(const dp_outline_scratch *scratch);

typedef enum dp_outline_state {
    DP_OUTLINE_OK = 0,
    DP_OUTLINE_OUTSIDE, /* nothing of it lies within the guarded frustum */
    DP_OUTLINE_INDEX,   /* an index is out of range */
    DP_OUTLINE_FINITE,  /* a coordinate is NaN or infinite */
    DP_OUTLINE_MEMORY
} dp_outline_state;

typedef struct dp_outline {
    const dp_point *points; /* screen space; valid until the next outline made with this scratch */
    uint32_t count;
    bool clipped;
} dp_outline;

dp_outline_state dp_outline_make(const dp_frame *frame, uint32_t polygon,
                                 dp_outline_scratch *scratch, dp_outline *out);

/* px: the area of a thinner polygon on the screen does not tell its facing; the angle in space
 * does. Corners are rounded to float32, within a few pictures of the screen. */
static inline float dp_nearly_edge_on(const dp_view *view) {
    return (float)(dp_max(1024, dp_max(view->width, view->height)) / (1 << 19));
}

/* How a frame polygon lies to the eye. */
typedef struct dp_facing {
    bool front;
    bool edge_on; /* too thin on the screen to cover anything */
} dp_facing;
dp_facing dp_outline_facing(const dp_frame *frame, uint32_t polygon, const dp_outline *outline);

/* dp_facing.edge_on alone, which the outline tells without the polygon's positions. */
bool dp_outline_is_edge_on(const dp_outline *outline);

/* Unit normal by Newell's method, world space; zero if the polygon has no area. */
dp_vec3 dp_polygon_normal(const dp_frame *frame, uint32_t polygon);

/* Facing by the angle in space at which the plane is seen. */
bool dp_polygon_faces_eye(const dp_frame *frame, uint32_t polygon);

/* Do all corners lie on one line in space? */
bool dp_polygon_has_no_area(const dp_frame *frame, uint32_t polygon);

/* Does a polygon of this area (px², twice) and reach (px, along an axis) cover nothing? Which way it
 * faces in space then: one that is seen edge-on does not face the eye, whichever way it leans. */
bool dp_area_is_edge_on(double area, double reach);
dp_facing dp_facing_in_space(const dp_frame *frame, uint32_t polygon, bool edge_on);

#endif
