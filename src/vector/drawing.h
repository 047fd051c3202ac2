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

/* Makes a drawing of chained lines (dp_chain_lines). */
dp_result dp_drawing_make(const dp_lines *lines, uint32_t width, uint32_t height,
                          const dp_drawing_desc *desc, const dp_allocator *memory, dp_drawing **out,
                          dp_diag *diag);

#endif
