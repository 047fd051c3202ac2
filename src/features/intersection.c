/* Intersections (Raskar 2001, 2.4): nothing is added. A polygon is tested itself, where it lies
 * behind the surface but close to it (printed/quads.c). Here is decided which two polygons may
 * intersect. */
#include "features/features.h"

static const float *corner(const dp_polygons *polygons, uint32_t polygon, uint32_t i) {
    return dp_vertex_position(polygons,
                              dp_corner_vertex(polygons, dp_first_corner(polygons, polygon) + i));
}

bool dp_polygons_touch(const dp_polygons *polygons, uint32_t a, uint32_t b) {
    const uint32_t n = dp_corner_count(polygons, a), m = dp_corner_count(polygons, b);
    for (uint32_t i = 0; i < n; i++) {
        const float *const p = corner(polygons, a, i);
        for (uint32_t k = 0; k < m; k++) {
            const float *const q = corner(polygons, b, k);
            if (p[0] == q[0] && p[1] == q[1] && p[2] == q[2]) return true;
        }
    }
    return false;
}
