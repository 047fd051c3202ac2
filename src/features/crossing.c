/* The segment in which the interiors of two polygons cross (Raskar 2001, 2.4), in double precision.
 *
 *    cut p with q's plane, and q with p's: two segments on the line where the planes meet
 *    the part that both have in common is the crossing
 *
 * Not handled: polygons in one plane, and those that merely touch; they do not cross. */
#include "features/crossing.h"

#include "core/fold.h"

static dp_vec3 corner(const dp_polygons *polygons, uint32_t polygon, uint32_t i) {
    const uint32_t n = dp_corner_count(polygons, polygon);
    const uint32_t c = dp_first_corner(polygons, polygon) + i % n;
    return dp_v3f(dp_vertex_position(polygons, dp_corner_vertex(polygons, c)));
}

typedef struct cut {
    dp_vec3 from, to; /* the segment in which a plane cuts the polygon */
    bool found;
} cut;

/* Cuts polygon p with the plane through `at` with unit normal n. Corners closer to the plane than
 * `flat` lie in it and make no cut: touching is not crossing. */
static cut cut_polygon(const dp_polygons *polygons, uint32_t p, dp_vec3 at, dp_vec3 n,
                       double flat) {
    const uint32_t count = dp_corner_count(polygons, p);
    cut out = {.found = false};
    int ends = 0;
    double least = 0, most = 0;
    for (uint32_t i = 0; i < count; i++) {
        const dp_vec3 a = corner(polygons, p, i), b = corner(polygons, p, i + 1);
        const double da = dp_dot(dp_sub(a, at), n), db = dp_dot(dp_sub(b, at), n);
        least = dp_min(least, da), most = dp_max(most, da);
        if ((da < 0) == (db < 0)) continue;
        const dp_vec3 q = dp_mix(a, b, da / (da - db));
        if (ends == 0)
            out.from = q;
        else
            out.to = q;
        ends++;
    }
    out.found = ends == 2 && least < -flat && most > flat;
    return out;
}

static double reach(const dp_polygons *polygons, uint32_t p) {
    const dp_vec3 o = corner(polygons, p, 0);
    double most = 0;
    for (uint32_t i = 1; i < dp_corner_count(polygons, p); i++)
        most = dp_max(most, dp_length(dp_sub(corner(polygons, p, i), o)));
    return most;
}

/* Pixel sizes: what is sunk by less touches (find/emergence.h: DP_TOUCHING is twice as much). */
static const double SUNK = 0.01;

/* A corner nearer than this to a plane lies in it: rounding, or what cannot be seen at the distance
 * of the smaller polygon. */
static double flatness(const dp_frame *frame, uint32_t a, uint32_t b) {
    const dp_view *const view = &frame->view;
    const double ra = reach(&frame->polygons, a), rb = reach(&frame->polygons, b);
    const dp_vec3 at = corner(&frame->polygons, ra < rb ? a : b, 0);
    const double *const s = view->sight, distance = s[0] * at.x + s[1] * at.y + s[2] * at.z + s[3];
    const double pixel = view->perspective ? dp_max(distance, 0) / view->focal : 1 / view->focal;
    return dp_max(1e-6 * dp_min(ra, rb), SUNK * pixel);
}

static dp_vec3 towards_eye(const dp_view *view, dp_vec3 normal, dp_vec3 at) {
    return dp_dot(normal, dp_view_vector(view, at)) > 0 ? dp_scale(normal, -1) : normal;
}

bool dp_crossing_find(const dp_frame *frame, uint32_t a, uint32_t b, dp_vec3 *from, dp_vec3 *to,
                      dp_vec3 *normal) {
    const dp_polygons *const polygons = &frame->polygons;
    const dp_vec3 na = dp_polygon_normal(frame, a), nb = dp_polygon_normal(frame, b);
    const dp_vec3 line = dp_cross(na, nb);
    if (dp_length(line) < 1e-6) return false; /* the same plane, within rounding */
    const double flat = flatness(frame, a, b);
    const cut ca = cut_polygon(polygons, a, corner(polygons, b, 0), nb, flat);
    if (!ca.found) return false;
    const cut cb = cut_polygon(polygons, b, corner(polygons, a, 0), na, flat);
    if (!cb.found) return false;
    const dp_vec3 u = dp_unit(line), o = ca.from;
    double a0 = 0, a1 = dp_dot(dp_sub(ca.to, o), u);
    double b0 = dp_dot(dp_sub(cb.from, o), u), b1 = dp_dot(dp_sub(cb.to, o), u);
    if (a0 > a1) a0 = a1, a1 = 0;
    if (b0 > b1) {
        const double swap = b0;
        b0 = b1, b1 = swap;
    }
    const double t0 = dp_max(a0, b0), t1 = dp_min(a1, b1);
    if (t1 - t0 <= flat) return false;
    *from = dp_mad(o, u, t0), *to = dp_mad(o, u, t1);
    *normal =
        dp_unit(dp_add(towards_eye(&frame->view, na, *from), towards_eye(&frame->view, nb, *from)));
    return true;
}
