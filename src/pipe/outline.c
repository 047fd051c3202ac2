/* Primitive assembly: corners to an outline on the screen, clipped where it must be.
 *
 * Most polygons only gather their transformed corners. One with a corner outside the guarded frustum
 * is transformed again in double precision and clipped in clip space; its outline is then no longer
 * corner for corner the polygon, and its edges are clipped one by one where lines are looked for. */
#include "pipe/outline.h"

void dp_outline_scratch_free(dp_outline_scratch *scratch, const dp_allocator *memory) {
    dp_free(memory, scratch->clip);
    dp_free(memory, scratch->points);
    *scratch = (dp_outline_scratch){0};
}

static dp_outline_state clip_outline(const dp_frame *frame, uint32_t first, uint32_t n,
                                     dp_outline_scratch *scratch, dp_outline *out) {
    const dp_polygons *const polygons = &frame->polygons;
    const size_t room = (size_t)n + 6;
    if (!dp_reserve(frame->memory, &scratch->clip, &scratch->clip_cap, 2 * room, sizeof *scratch->clip))
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
    const uint32_t left = dp_clip_polygon(&frame->view, any, scratch->clip, n, scratch->clip + room);
    if (!left) return DP_OUTLINE_OUTSIDE;
    for (uint32_t i = 0; i < left; i++) {
        const dp_pointd s = dp_to_screen(&frame->view, scratch->clip[i]);
        scratch->points[i] = (dp_point){(float)s.x, (float)s.y, (float)s.d};
    }
    *out = (dp_outline){scratch->points, left, true};
    return DP_OUTLINE_OK;
}

dp_outline_state dp_outline_make(const dp_frame *frame, uint32_t polygon, dp_outline_scratch *scratch,
                                 dp_outline *out) {
    const dp_polygons *const polygons = &frame->polygons;
    const uint32_t first = dp_first_corner(polygons, polygon), n = dp_corner_count(polygons, polygon);
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

/* Thinner than this on the screen, a polygon's facing is a matter of float32 rounding (px). */
static const double EDGE_ON = 1.0 / 4096;

dp_facing dp_outline_facing(const dp_point *points, uint32_t count) {
    double area = 0, reach = 0;
    for (uint32_t i = 1; i < count; i++) {
        const double ax = (double)points[i].x - points[0].x, ay = (double)points[i].y - points[0].y;
        reach = fmax(reach, fmax(fabs(ax), fabs(ay)));
        if (i + 1 == count) break;
        const double bx = (double)points[i + 1].x - points[0].x;
        const double by = (double)points[i + 1].y - points[0].y;
        area += ax * by - ay * bx;
    }
    if (fabs(area) <= EDGE_ON * reach) return DP_FACING_EDGE_ON;
    return area < 0 ? DP_FACING_FRONT : DP_FACING_BACK;
}

bool dp_polygon_has_no_area(const dp_frame *frame, uint32_t polygon) {
    const dp_polygons *const polygons = &frame->polygons;
    const uint32_t first = dp_first_corner(polygons, polygon), n = dp_corner_count(polygons, polygon);
    const dp_vec3 o = dp_v3f(dp_vertex_position(polygons, dp_corner_vertex(polygons, first)));
    dp_vec3 sum = {0, 0, 0};
    double size = 0;
    for (uint32_t i = 1; i + 1 < n; i++) {
        const dp_vec3 a = dp_sub(dp_v3f(dp_vertex_position(polygons, dp_corner_vertex(polygons, first + i))), o);
        const dp_vec3 b = dp_sub(dp_v3f(dp_vertex_position(polygons, dp_corner_vertex(polygons, first + i + 1))), o);
        sum = dp_add(sum, dp_cross(a, b));
        size = fmax(size, fmax(dp_dot(a, a), dp_dot(b, b)));
    }
    /* the cross product of float32 coordinates is exact to about 1e-15 of the squared size */
    return dp_length(sum) <= 1e-12 * size;
}
