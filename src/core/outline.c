/* Primitive assembly: a polygon's corners become its outline on the screen, clipped if necessary.
 *
 * Most polygons only gather their transformed corners. If a corner lies outside the guarded
 * frustum, the polygon is transformed again in double precision and clipped in clip space. Points
 * of its outline are then no longer its corners, so its edges are clipped one by one where lines
 * are looked for.
 *
 * Facing: the sign of the area on the screen; by the angle in space if that area is too small to
 * tell. Not handled: polygons that are not convex (they were split on the way in). */
#include "core/outline.h"

static const dp_array arrays[] = {DP_ARRAY(dp_outline_scratch, clip, clip_cap),
                                  DP_ARRAY(dp_outline_scratch, points, points_cap)};

void dp_outline_scratch_free(dp_outline_scratch *scratch, const dp_allocator *memory) {
    dp_arrays_free(memory, scratch, DP_ARRAYS(arrays));
}

uint64_t dp_outline_scratch_bytes(const dp_outline_scratch *scratch) {
    return dp_arrays_bytes(scratch, DP_ARRAYS(arrays));
}

static dp_outline_state clip_outline(const dp_frame *frame, uint32_t first, uint32_t n,
                                     dp_outline_scratch *scratch, dp_outline *out) {
    const dp_polygons *const polygons = &frame->polygons;
    const size_t room = (size_t)n + 6;
    if (!dp_reserve(frame->memory, &scratch->clip, &scratch->clip_cap, 2 * room,
                    sizeof *scratch->clip))
        return DP_OUTLINE_MEMORY;
    int any = 0, all = ~0;
    for (uint32_t i = 0; i < n; i++) {
        const float *const p = dp_vertex_position(polygons, dp_corner_vertex(polygons, first + i));
        if (!isfinite(p[0]) || !isfinite(p[1]) || !isfinite(p[2])) return DP_OUTLINE_FINITE;
        scratch->clip[i] = dp_to_clip(&frame->view, dp_v3f(p));
        const int code = dp_outcode(&frame->view, scratch->clip[i]);
        any |= code, all &= code;
    }
    if (all) return DP_OUTLINE_OUTSIDE;
    const uint32_t left =
        dp_clip_polygon(&frame->view, any, scratch->clip, n, scratch->clip + room);
    if (!left) return DP_OUTLINE_OUTSIDE;
    for (uint32_t i = 0; i < left; i++) {
        const dp_pointd s = dp_to_screen(&frame->view, scratch->clip[i]);
        scratch->points[i] = (dp_point){(float)s.x, (float)s.y, (float)s.d};
    }
    *out = (dp_outline){scratch->points, left, true};
    return DP_OUTLINE_OK;
}

dp_outline_state dp_outline_make(const dp_frame *frame, uint32_t polygon,
                                 dp_outline_scratch *scratch, dp_outline *out) {
    const dp_polygons *const polygons = &frame->polygons;
    const uint32_t first = dp_first_corner(polygons, polygon),
                   n = dp_corner_count(polygons, polygon);
    if (!dp_reserve(frame->memory, &scratch->points, &scratch->points_cap, (size_t)n + 6,
                    sizeof *scratch->points))
        return DP_OUTLINE_MEMORY;
    bool clip = false;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t vertex = dp_corner_vertex(polygons, first + i);
        if (vertex >= polygons->vertex_count) return DP_OUTLINE_INDEX;
        const dp_vertex v = frame->vertices[vertex];
        if (isnan(v.x)) clip = true;
        scratch->points[i] = (dp_point){v.x, v.y, v.d};
    }
    if (clip) return clip_outline(frame, first, n, scratch, out);
    *out = (dp_outline){scratch->points, n, false};
    return DP_OUTLINE_OK;
}

static dp_vec3 corner_position(const dp_polygons *polygons, uint32_t corner) {
    return dp_v3f(dp_vertex_position(polygons, dp_corner_vertex(polygons, corner)));
}

dp_vec3 dp_polygon_normal(const dp_frame *frame, uint32_t polygon) {
    const dp_polygons *const polygons = &frame->polygons;
    const uint32_t first = dp_first_corner(polygons, polygon),
                   n = dp_corner_count(polygons, polygon);
    const dp_vec3 o = corner_position(polygons, first);
    dp_vec3 sum = {0, 0, 0}, a = dp_sub(corner_position(polygons, first + 1), o);
    for (uint32_t i = 2; i < n; i++) {
        const dp_vec3 b = dp_sub(corner_position(polygons, first + i), o);
        sum = dp_add(sum, dp_cross(a, b));
        a = b;
    }
    return dp_unit(sum);
}

/* px: a thinner polygon covers nothing, and its area on the screen is rounding error. */
static const double EDGE_ON = 1.0 / 4096;

/* The sine of the angle at which the plane is seen; negative if the polygon faces the eye. */
static double sine_of(const dp_frame *frame, uint32_t polygon) {
    const dp_polygons *const polygons = &frame->polygons;
    const dp_vec3 at = corner_position(polygons, dp_first_corner(polygons, polygon));
    return dp_dot(dp_polygon_normal(frame, polygon), dp_view_vector(&frame->view, at));
}

/* Within rounding of zero it is edge-on. */
bool dp_polygon_faces_eye(const dp_frame *frame, uint32_t polygon) {
    return sine_of(frame, polygon) < -1e-12;
}

/* A polygon that covers nothing, and is not merely small, is seen edge-on. Whether it faces the eye
 * by a billionth of a degree must not matter: it does not. */
static const double SEEN_EDGE_ON = 1e-3; /* sine */

typedef struct extent {
    double area;  /* twice the area on the screen; negative for a front face: y points down */
    double reach; /* px: largest distance of a point from the first, along either axis */
} extent;

static extent extent_of(const dp_outline *outline) {
    const dp_point *const p = outline->points;
    extent e = {0, 0};
    for (uint32_t i = 1; i < outline->count; i++) {
        const double ax = (double)p[i].x - p[0].x, ay = (double)p[i].y - p[0].y;
        e.reach = dp_max(e.reach, dp_max(fabs(ax), fabs(ay)));
        if (i + 1 == outline->count) break;
        const double bx = (double)p[i + 1].x - p[0].x, by = (double)p[i + 1].y - p[0].y;
        e.area += ax * by - ay * bx;
    }
    return e;
}

static bool is_edge_on(extent e) { return dp_area_is_edge_on(e.area, e.reach); }

bool dp_outline_is_edge_on(const dp_outline *outline) { return is_edge_on(extent_of(outline)); }

dp_facing dp_facing_in_space(const dp_frame *frame, uint32_t polygon, bool edge_on) {
    return (dp_facing){sine_of(frame, polygon) < (edge_on ? -SEEN_EDGE_ON : -1e-12), edge_on};
}

bool dp_area_is_edge_on(double area, double reach) { return fabs(area) <= EDGE_ON * reach; }

dp_facing dp_outline_facing(const dp_frame *frame, uint32_t polygon, const dp_outline *outline) {
    const extent e = extent_of(outline);
    if (fabs(e.area) > (double)frame->nearly_edge_on * e.reach)
        return (dp_facing){e.area < 0, false};
    return dp_facing_in_space(frame, polygon, is_edge_on(e));
}

bool dp_polygon_has_no_area(const dp_frame *frame, uint32_t polygon) {
    const dp_polygons *const polygons = &frame->polygons;
    const uint32_t first = dp_first_corner(polygons, polygon),
                   n = dp_corner_count(polygons, polygon);
    const dp_vec3 o = corner_position(polygons, first);
    dp_vec3 sum = {0, 0, 0};
    double size = 0;
    for (uint32_t i = 1; i + 1 < n; i++) {
        const dp_vec3 a = dp_sub(corner_position(polygons, first + i), o);
        const dp_vec3 b = dp_sub(corner_position(polygons, first + i + 1), o);
        sum = dp_add(sum, dp_cross(a, b));
        size = dp_max(size, dp_max(dp_dot(a, a), dp_dot(b, b)));
    }
    /* The cross product of float32 coordinates is exact to about 1e-15 of the squared size. */
    return dp_length(sum) <= 1e-12 * size;
}
