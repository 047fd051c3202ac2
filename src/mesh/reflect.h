/* Sources made from another source: its mirror image, and the source with a mirror added. */
#ifndef DP_MESH_REFLECT_H
#define DP_MESH_REFLECT_H

#include "base/memory.h"
#include <drypoint/source.h>

/* The plane n·p = offset, n of length 1. */
typedef struct dp_plane_equation {
    double n[3], offset;
} dp_plane_equation;

/* The memory of both, kept from picture to picture. */
typedef struct dp_reflection dp_reflection;

/* NULL: memory is out. */
dp_reflection *dp_reflection_create(const dp_allocator *memory);
void dp_reflection_free(dp_reflection *reflection);            /* NULL allowed */
uint64_t dp_reflection_bytes(const dp_reflection *reflection); /* of NULL 0 */

/* The part of `source` on the side that n points to, reflected. Corners are reversed, so that
 * fronts stay fronts; edges made by cutting never draw. Borrows `source`, which can be rewound; the
 * result is the reflection's, good until the next call. */
dp_source *dp_reflect_source(dp_reflection *reflection, dp_source *source,
                             const dp_plane_equation *plane);

/* `source`, then one quadrilateral of a group, corners in world space. Borrows `source`, which can be
 * rewound; the result is the reflection's, good until the next call. */
dp_source *dp_add_quad_source(dp_reflection *reflection, dp_source *source,
                              const double corners[4][3], uint16_t group);

#endif
