/* Sources made of another one: its mirror image, and itself with a mirror. */
#ifndef DP_MESH_REFLECT_H
#define DP_MESH_REFLECT_H

#include "base/memory.h"
#include <drypoint/source.h>

/* The plane n·p = offset, n of length 1. */
typedef struct dp_plane_equation {
    double n[3], offset;
} dp_plane_equation;

/* The part of `source` on the side that n points to, reflected. Corners run the other way round, so
 * that fronts stay fronts; cut edges never draw. Reads `source`, which the caller keeps. */
dp_result dp_reflect_source(dp_source *source, const dp_plane_equation *plane,
                            const dp_allocator *memory, dp_source **out, dp_diag *diag);

/* `source` and then one quadrilateral of the group. */
dp_result dp_add_quad_source(dp_source *source, const float corners[4][3], uint16_t group,
                             const dp_allocator *memory, dp_source **out, dp_diag *diag);

#endif
