/* A cleaned drawing: paths in one list, their points in another (drypoint/drawing.h).
 *
 * Invariant: paths lie layer by layer from the bottom up; layers differ in class or level. */
#ifndef DP_VECTOR_DRAWING_H
#define DP_VECTOR_DRAWING_H

#include "strokes/lines.h"
#include <drypoint/drawing.h>

/* As dp_path, but for its points: `count` of them from number `first` on. */
typedef struct dp_stored_path {
    dp_line line;
    uint32_t level, group;
    float width, dash[2], length; /* px */
    dp_color color;
    bool closed;
    dp_line_end end[2];
    uint64_t hider[2];
    size_t first, count;
} dp_stored_path;

struct dp_drawing {
    dp_allocator memory;
    dp_drawing_info info;
    dp_stored_path *paths; /* [info.paths] */
    dp_path_point *points; /* [info.points] */
    size_t paths_cap, points_cap;
};

/* What a drawing is made of: the segments of a picture, in an order that does not depend on
 * threads. Their coordinates are finite. */
typedef struct dp_drawn {
    const dp_segment *segments;
    size_t count;
    uint32_t width, height; /* px */
    dp_color paper;
    dp_hidden_look hidden_look;
    bool perspective;
    double focal; /* as in dp_view; 0: depth says nothing of what may be joined */
} dp_drawn;

/* desc may be NULL. DP_ERR_ARGUMENT (a number of it is not finite), DP_ERR_MEMORY, DP_ERR_LIMIT. */
dp_result dp_drawing_make(const dp_drawn *drawn, const dp_drawing_desc *desc,
                          const dp_allocator *memory, dp_drawing **out, dp_diag *diag);

#endif
