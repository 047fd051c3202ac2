/* Sources made from another source: its mirror image, and the source with a mirror added. */
#ifndef DP_MESH_REFLECT_H
#define DP_MESH_REFLECT_H

#include "base/memory.h"
#include <drypoint/source.h>

/* The plane n·p = offset, n of length 1. */
typedef struct dp_plane_equation {
    double n[3], offset;
} dp_plane_equation;

/* The part of `source` on the side that n points to, reflected. Corners are reversed, so that
 * fronts stay fronts; edges made by cutting never draw. Borrows `source`; the caller destroys
 * *out. */
dp_result dp_reflect_source(dp_source *source, const dp_plane_equation *plane,
                            const dp_allocator *memory, dp_source **out, dp_diag *diag);

/* `source`, then one quadrilateral of a group, corners in world space. Borrows `source`; the caller destroys *out. */
dp_result dp_add_quad_source(dp_source *source, const double corners[4][3], uint16_t group,
                             const dp_allocator *memory, dp_source **out, dp_diag *diag);

#endif
