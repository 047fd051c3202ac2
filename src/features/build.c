/* What primitive shaders are made of, in two ways:
 *
 *    dp_paper_…    as printed: move the edge's ends in space, project, clip (Raskar 2001, 2.1, 2.2)
 *    dp_screen_…   a rectangle beside the projected edge, exactly as wide as the pen;
 *                  only its depth follows from the plane in space
 *
 * On the screen, each edge knows how a step along O = E × N and along N moves its middle: px
 * outward, and depth. That is linear in the direction, so it gives the slope of the quad at any
 * angle. Round joints fill the corner between two such rectangles with thin triangles.
 *
 * Invariant: nothing is kept, and nothing but one polygon is known. Not handled: edges without
 * length on the screen; joints at clipped corners. */
#include "features/features.h"

#include "base/elementary.h"

#define RADIANS_PER_DEGREE (3.14159265358979323846 / 180)

dp_pen dp_pen_make(dp_method method, double reach, double angle) {
    return (dp_pen){method, reach, angle, dp_cos(angle * RADIANS_PER_DEGREE),
                    dp_sin(angle * RADIANS_PER_DEGREE)};
}

dp_vec3 dp_quad_direction(dp_vec3 e, dp_vec3 n, const dp_pen *pen) {
    return dp_add(dp_scale(n, -pen->sine), dp_scale(dp_cross(e, n), -pen->cosine));
}

dp_vec3 dp_quad_normal(dp_vec3 e, dp_vec3 n, const dp_pen *pen) {
    return dp_add(dp_scale(n, -pen->cosine), dp_scale(dp_cross(e, n), pen->sine));
}

/* ------- the paper's formula ------- */

/* Silhouettes have V·N > 0, as the polygon faces away (Raskar 2001, 2.1); ridges have V·R < 0, as
 * the quad is seen (2.2). Both are meant to move along `direction`, so the quotient's absolute
 * value is used. */
dp_vec3 dp_paper_offset(const dp_view *view, dp_vec3 p, dp_vec3 e, dp_vec3 direction,
                        dp_vec3 normal, double px) {
    const dp_clip_point c = dp_to_clip(view, p);
    const dp_vec3 v = dp_view_vector(view, p);
    const double wz = px / view->focal * (view->perspective ? c.distance : 1);
    const double cosine = dp_dot(v, e), sine = sqrt(fmax(0, 1 - cosine * cosine));
    const double grazing = fmax(fabs(dp_dot(v, normal)), DP_PAPER_GRAZING);
    return dp_mad(p, direction, wz * sine * dp_dot(v, view->forward) / grazing);
}

/* Keeps the part where a x + b y + c >= 0. */
static uint32_t cut(dp_pointd *points, uint32_t n, double a, double b, double c) {
    dp_pointd in[DP_ADDED_POINTS];
    uint32_t count = 0;
    for (uint32_t i = 0; i < n; i++) in[i] = points[i];
    for (uint32_t i = 0; i < n; i++) {
        const dp_pointd p = in[i], q = in[i + 1 == n ? 0 : i + 1];
        const double ip = a * p.x + b * p.y + c, iq = a * q.x + b * q.y + c;
        if (ip >= 0) points[count++] = p;
        if ((ip < 0) == (iq < 0)) continue;
        const double t = ip / (ip - iq);
        points[count++] =
            (dp_pointd){p.x + (q.x - p.x) * t, p.y + (q.y - p.y) * t, p.d + (q.d - p.d) * t};
    }
    return count >= 3 ? count : 0;
}

/* Plane by Newell's method. False: the polygon covers nothing. */
static bool set_plane(dp_added *out) {
    const dp_pointd *const p = out->points;
    double nx = 0, ny = 0, nz = 0;
    out->nearest = p[0].d;
    for (uint32_t i = 1; i < out->count; i++) {
        out->nearest = dp_max(out->nearest, p[i].d);
        if (i + 1 == out->count) break;
        const double ax = p[i].x - p[0].x, ay = p[i].y - p[0].y, ad = p[i].d - p[0].d;
        const double bx = p[i + 1].x - p[0].x, by = p[i + 1].y - p[0].y, bd = p[i + 1].d - p[0].d;
        nx += ay * bd - ad * by;
        ny += ad * bx - ax * bd;
        nz += ax * by - ay * bx;
    }
    const double inverse = -1 / nz;
    out->dx = nx * inverse, out->dy = ny * inverse;
    out->d0 = p[0].d - out->dx * p[0].x - out->dy * p[0].y;
    return isfinite(out->d0);
}

bool dp_paper_project(const dp_primitive *p, uint32_t edge, const dp_vec3 *points, uint32_t count,
                      double reach, dp_added *out) {
    dp_clip_point clip[DP_ADDED_POINTS], scratch[DP_ADDED_POINTS];
    dp_screen_edge room;
    const dp_screen_edge *const e = dp_screen_edge_of(p, edge, &room);
    if (!e) return false;
    int codes = 0;
    for (uint32_t i = 0; i < count; i++) {
        clip[i] = dp_to_clip(p->view, points[i]);
        codes |= dp_outcode(p->view, clip[i]);
    }
    out->root[0] = e->a, out->root[1] = e->b;
    out->joint = false;
    out->count = dp_clip_polygon(p->view, codes, clip, count, scratch);
    if (!out->count) return false;
    for (uint32_t i = 0; i < out->count; i++) {
        out->points[i] = dp_to_screen(p->view, clip[i]);
        if (!isfinite(out->points[i].x + out->points[i].y + out->points[i].d)) return false;
    }
    const double n = e->nx * e->a.x + e->ny * e->a.y, t = e->tx * e->a.x + e->ty * e->a.y;
    out->count = cut(out->points, out->count, -e->nx, -e->ny, n + reach);
    if (out->count) out->count = cut(out->points, out->count, e->nx, e->ny, reach - n);
    if (out->count) out->count = cut(out->points, out->count, e->tx, e->ty, reach - t);
    if (out->count)
        out->count = cut(out->points, out->count, -e->tx, -e->ty, reach + t + e->length);
    return out->count && set_plane(out);
}

/* The formula needs corners in front of the eye, so the edge is clipped before it is moved, and the
 * quad again afterwards. */
bool dp_paper_quad(const dp_primitive *p, uint32_t edge, dp_vec3 direction, dp_vec3 normal,
                   double px, dp_added *out) {
    const uint32_t next = edge + 1 == p->n ? 0 : edge + 1;
    const dp_clip_point ca = p->clip[edge], cb = p->clip[next];
    double t0 = 0, t1 = 1;
    if ((dp_outcode(p->view, ca) | dp_outcode(p->view, cb)) &&
        !dp_clip_segment(p->view, ca, cb, &t0, &t1))
        return false;
    const dp_vec3 e = dp_edge_direction(p, edge);
    const dp_vec3 from = p->world[edge], to = p->world[next];
    const dp_vec3 a = dp_mix(from, to, t0), b = dp_mix(from, to, t1);
    const dp_vec3 quad[4] = {a, b, dp_paper_offset(p->view, b, e, direction, normal, px),
                             dp_paper_offset(p->view, a, e, direction, normal, px)};
    return dp_paper_project(p, edge, quad, 4, DP_PAPER_REACH * px, out);
}

/* ------- on the screen ------- */

/* px: shorter edges have no reliable direction. */
static const double SHORTEST = 1.0 / 4096;

/* How a step along q moves a point of the edge on the screen. `c`: the point; `inverse2`: 1 / w²
 * there, the same for any q. */
static dp_motion motion_of(const dp_view *view, const dp_screen_edge *edge, dp_clip_point c,
                           double inverse2, dp_vec3 q) {
    const double(*m)[4] = view->clip;
    const double x = m[0][0] * q.x + m[0][1] * q.y + m[0][2] * q.z;
    const double y = m[1][0] * q.x + m[1][1] * q.y + m[1][2] * q.z;
    const double w = m[3][0] * q.x + m[3][1] * q.y + m[3][2] * q.z;
    const double sx = 0.5 * view->width * (x * c.w - c.x * w) * inverse2;
    const double sy = -0.5 * view->height * (y * c.w - c.y * w) * inverse2;
    const double d = view->perspective
                         ? -w * inverse2
                         : -(view->sight[0] * q.x + view->sight[1] * q.y + view->sight[2] * q.z);
    const double out = sx * edge->nx + sy * edge->ny, along = sx * edge->tx + sy * edge->ty;
    return (dp_motion){out, d - edge->along * along};
}

/* How a plane leans that moves so at the edge's middle. Its depth is affine on the screen, so the
 * slope is the same everywhere. */
static dp_lean lean_of(const dp_screen_edge *edge, dp_motion m) {
    const bool outward = m.out > edge->edge_on;
    return (dp_lean){outward, outward ? m.rise / m.out : m.rise > 0 ? INFINITY : -INFINITY};
}

/* Fills in the rest of an edge whose ends on the screen are set. */
static bool finish_edge(const dp_primitive *p, uint32_t edge, dp_clip_point ca, dp_clip_point cb,
                        dp_screen_edge *out) {
    const double x = out->b.x - out->a.x, y = out->b.y - out->a.y;
    out->length = sqrt(x * x + y * y);
    if (!(out->length > SHORTEST) || !isfinite(out->length + out->a.d + out->b.d)) return false;
    const double inverse = 1 / out->length;
    out->tx = x * inverse, out->ty = y * inverse;
    /* A front-facing polygon lies to the left of its edges as seen by the eye, and y points
     * down. */
    out->nx = p->front ? -out->ty : out->ty;
    out->ny = p->front ? out->tx : -out->tx;
    out->along = (out->b.d - out->a.d) * inverse;
    out->steep = dp_depth_step(p->view, dp_max(out->a.d, out->b.d), DP_STEEPEST);
    const dp_clip_point middle = dp_clip_mix(ca, cb, 0.5);
    const double inverse_w = 1 / middle.w, inverse2 = inverse_w * inverse_w;
    out->edge_on = 1e-9 * p->view->focal * inverse_w;
    const dp_vec3 o = dp_cross(dp_edge_direction(p, edge), p->normal);
    out->outward = motion_of(p->view, out, middle, inverse2, o);
    out->normal = motion_of(p->view, out, middle, inverse2, p->normal);
    out->own = lean_of(out, out->outward).slope;
    return true;
}

bool dp_screen_edge_make(const dp_primitive *p, uint32_t edge, dp_screen_edge *out) {
    const dp_clip_point a = p->clip[edge], b = p->clip[edge + 1 == p->n ? 0 : edge + 1];
    const int code_b = dp_outcode(p->view, b);
    double t0 = 0, t1 = 1;
    if ((dp_outcode(p->view, a) | code_b) && !dp_clip_segment(p->view, a, b, &t0, &t1))
        return false;
    /* Ends that are not clipped keep every bit, as the polygon's own outline runs there. */
    const dp_clip_point ca = t0 > 0 ? dp_clip_mix(a, b, t0) : a,
                        cb = t1 < 1 ? dp_clip_mix(a, b, t1) : b;
    out->a = dp_to_screen(p->view, ca);
    out->b = dp_to_screen(p->view, cb);
    out->ends_outside = code_b != 0;
    return finish_edge(p, edge, ca, cb, out);
}

/* Unless something must be clipped, each corner is projected once. */
void dp_screen_edges_make(const dp_primitive *p, dp_screen_edge *out) {
    int codes = 0;
    for (uint32_t i = 0; i < p->n; i++) codes |= dp_outcode(p->view, p->clip[i]);
    if (codes) {
        for (uint32_t i = 0; i < p->n; i++)
            if (!dp_screen_edge_make(p, i, &out[i])) out[i].length = 0;
        return;
    }
    for (uint32_t i = 0; i < p->n; i++) out[i].a = dp_to_screen(p->view, p->clip[i]);
    for (uint32_t i = 0; i < p->n; i++) {
        const uint32_t next = i + 1 == p->n ? 0 : i + 1;
        out[i].b = out[next].a;
        out[i].ends_outside = false;
        if (!finish_edge(p, i, p->clip[i], p->clip[next], &out[i])) out[i].length = 0;
    }
}

void dp_screen_quad(const dp_screen_edge *e, double reach, double slope, dp_added *out) {
    const double x = e->nx * reach, y = e->ny * reach, d = slope * reach;
    out->root[0] = e->a, out->root[1] = e->b;
    out->joint = false;
    out->count = 4;
    out->points[0] = e->a;
    out->points[1] = e->b;
    out->points[2] = (dp_pointd){e->b.x + x, e->b.y + y, e->b.d + d};
    out->points[3] = (dp_pointd){e->a.x + x, e->a.y + y, e->a.d + d};
    out->dx = e->along * e->tx + slope * e->nx;
    out->dy = e->along * e->ty + slope * e->ny;
    out->d0 = e->a.d - out->dx * e->a.x - out->dy * e->a.y;
    out->nearest = dp_max(e->a.d, e->b.d) + dp_max(d, 0);
}

/* Along Q (Raskar 2001, 2.2): motions add like directions. */
dp_lean dp_quad_lean(const dp_screen_edge *edge, const dp_pen *pen) {
    const dp_motion o = edge->outward, n = edge->normal;
    return lean_of(edge, (dp_motion){-pen->sine * n.out - pen->cosine * o.out,
                                     -pen->sine * n.rise - pen->cosine * o.rise});
}

/* px: the triangles of a joint may miss its circle by this much; there are at most SPANS of
 * them. */
static const double SAGITTA = 0.3;
enum { SPANS = DP_ADDED_MOST - 1 };

/* The turn from one unit normal to another, 0 to 180 degrees, as cosine and sine. */
typedef struct turn {
    double c, s;
} turn;

static turn turned(turn a, turn b) { return (turn){a.c * b.c - a.s * b.s, a.s * b.c + a.c * b.s}; }

/* How many spans of 2 acos(1 - sagitta / radius) reach `angle`. */
static uint32_t spans_of(turn angle, double reach) {
    const double half = 1 - dp_min(SAGITTA / reach, 1), c = 2 * half * half - 1;
    const turn span = {c, sqrt(dp_max(1 - c * c, 0))};
    uint32_t count = 1;
    for (turn sum = span; count < SPANS && sum.s > 0 && sum.c > angle.c; sum = turned(sum, span))
        count++;
    return count;
}

/* The turn divided by `spans`. */
static turn share_of(turn angle, uint32_t spans) {
    if (spans == 2) {
        const double c = sqrt(0.5 * (1 + angle.c));
        return (turn){c, angle.s / (2 * c)};
    }
    const double share = dp_atan2(angle.s, angle.c) / spans;
    return (turn){dp_cos(share), dp_sin(share)};
}

/* How much the quad at an edge rises above the polygon's own plane, depth per px. NaN: it faces
 * away. */
static double rise_of(const dp_screen_edge *e, const dp_pen *pen) {
    const dp_lean lean = dp_quad_lean(e, pen);
    return lean.outward ? lean.slope - e->own : NAN;
}

/* The point of the joint's circle in direction (x, y). */
static dp_pointd circle_point(const dp_screen_edge *e, double reach, double x, double y,
                              double rise) {
    const double t = x * e->tx + y * e->ty, n = x * e->nx + y * e->ny;
    const double d = e->b.d + reach * (e->along * t + e->own * n + rise);
    return (dp_pointd){e->b.x + reach * x, e->b.y + reach * y,
                       dp_min(d, e->b.d + reach * e->steep)};
}

/* The thin triangle from the corner where `e` ends to two points of the circle. False: it covers
 * nothing. */
static bool set_thin(const dp_screen_edge *e, dp_pointd from, dp_pointd to, dp_added *out) {
    const dp_pointd o = e->b;
    const double ax = from.x - o.x, ay = from.y - o.y, ad = from.d - o.d;
    const double bx = to.x - o.x, by = to.y - o.y, bd = to.d - o.d;
    const double inverse = -1 / (ax * by - ay * bx);
    out->dx = (ay * bd - ad * by) * inverse, out->dy = (ad * bx - ax * bd) * inverse;
    out->d0 = o.d - out->dx * o.x - out->dy * o.y;
    out->nearest = dp_max(dp_max(o.d, from.d), to.d);
    out->points[0] = out->root[0] = out->root[1] = o;
    out->points[1] = from, out->points[2] = to;
    out->count = 3;
    out->joint = true;
    return isfinite(out->d0);
}

uint32_t dp_screen_joint(const dp_primitive *p, uint32_t edge, const dp_pen *pen, double reach,
                         bool folded, dp_added *out) {
    const uint32_t next = edge + 1 == p->n ? 0 : edge + 1;
    dp_screen_edge rooms[2];
    const dp_screen_edge *const e = dp_screen_edge_of(p, edge, &rooms[0]);
    const dp_screen_edge *const f = dp_screen_edge_of(p, next, &rooms[1]);
    if (!e || !f || e->ends_outside) return 0;
    const double from_rise = folded ? rise_of(e, pen) : 0, to_rise = folded ? rise_of(f, pen) : 0;
    if (!isfinite(e->own) || !isfinite(from_rise + to_rise)) return 0;
    /* A convex polygon's corners all turn one way, and the other way when it is seen from
     * behind. */
    const double sense = p->front ? -1 : 1;
    const turn angle = {e->nx * f->nx + e->ny * f->ny, sense * (e->nx * f->ny - e->ny * f->nx)};
    if (!(angle.s > 0) || angle.c < -0.999) return 0;
    const uint32_t spans = spans_of(angle, reach);
    const turn share = spans > 1 ? share_of(angle, spans) : angle;
    const double step = (to_rise - from_rise) / spans;
    uint32_t count = 0;
    dp_pointd from = circle_point(e, reach, e->nx, e->ny, from_rise);
    turn at = share;
    for (uint32_t i = 1; i < spans; i++, at = turned(at, share)) {
        const double s = sense * at.s, x = e->nx * at.c - e->ny * s, y = e->nx * s + e->ny * at.c;
        const dp_pointd to = circle_point(e, reach, x, y, from_rise + step * i);
        count += set_thin(e, from, to, &out[count]);
        from = to;
    }
    return count + set_thin(e, from, circle_point(e, reach, f->nx, f->ny, to_rise), &out[count]);
}
