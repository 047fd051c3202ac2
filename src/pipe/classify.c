/* Edge classification: see classify.h. */
#include "pipe/classify.h"

static dp_vec3 corner_position(const dp_polygons *polygons, uint32_t corner) {
    return dp_v3f(dp_vertex_position(polygons, dp_corner_vertex(polygons, corner)));
}

dp_vec3 dp_polygon_normal(const dp_frame *frame, uint32_t polygon) {
    const dp_polygons *const polygons = &frame->polygons;
    const uint32_t first = dp_first_corner(polygons, polygon), n = dp_corner_count(polygons, polygon);
    const dp_vec3 o = corner_position(polygons, first);
    dp_vec3 sum = {0, 0, 0}, a = dp_sub(corner_position(polygons, first + 1), o);
    for (uint32_t i = 2; i < n; i++) {
        const dp_vec3 b = dp_sub(corner_position(polygons, first + i), o);
        sum = dp_add(sum, dp_cross(a, b));
        a = b;
    }
    return dp_unit(sum);
}

/* The corner of `polygon` that is furthest from its edge number `edge`: which side of a plane it lies on
 * tells whether the edge is folded towards it. */
static dp_vec3 far_corner(const dp_polygons *polygons, uint32_t polygon, uint32_t edge) {
    const uint32_t first = dp_first_corner(polygons, polygon), n = dp_corner_count(polygons, polygon);
    return corner_position(polygons, first + (edge + 1 + n / 2) % n);
}

dp_edge_geometry dp_edge_geometry_of(const dp_frame *frame, const dp_edge_entry *edge, uint32_t a,
                                     uint32_t b) {
    dp_edge_geometry g = {.normal_a = dp_polygon_normal(frame, a), .normal_b = dp_polygon_normal(frame, b)};
    if (!edge->opposed) g.normal_b = dp_scale(g.normal_b, -1);
    g.normal = dp_unit(dp_add(g.normal_a, g.normal_b));
    const dp_vec3 at = dp_v3f(dp_vertex_position(&frame->polygons, edge->va));
    const dp_vec3 other = far_corner(&frame->polygons, b, edge->edge_b);
    g.concave = dp_dot(g.normal_a, dp_sub(other, at)) > 0;
    return g;
}

double dp_edge_dihedral(const dp_edge_geometry *g) {
    const double fold = atan2(dp_length(dp_cross(g->normal_a, g->normal_b)), dp_dot(g->normal_a, g->normal_b));
    const double degrees = fold * 180 / 3.14159265358979323846;
    return g->concave ? 180 + degrees : 180 - degrees;
}
