/* What the primitive shaders are made of: the paper's formula in space, and rectangles on the screen. */
#include "features/features.h"

#define RADIANS_PER_DEGREE (3.14159265358979323846 / 180)

dp_pen dp_pen_make(dp_method method, double reach, double angle) {
    return (dp_pen){method, reach, angle, cos(angle * RADIANS_PER_DEGREE), sin(angle * RADIANS_PER_DEGREE)};
}

dp_vec3 dp_quad_direction(dp_vec3 e, dp_vec3 n, const dp_pen *pen) {
    return dp_add(dp_scale(n, -pen->sine), dp_scale(dp_cross(e, n), -pen->cosine));
}

dp_vec3 dp_quad_normal(dp_vec3 e, dp_vec3 n, const dp_pen *pen) {
    return dp_add(dp_scale(n, -pen->cosine), dp_scale(dp_cross(e, n), pen->sine));
}

/* ------- the paper's formula ------- */

/* In 2.1 V·N > 0 (the polygon faces away), in 2.2 V·R < 0 (the quad is seen): both mean to move along
 * `direction`, so the quotient's size is taken. */
dp_vec3 dp_paper_offset(const dp_view *view, dp_vec3 p, dp_vec3 e, dp_vec3 direction, dp_vec3 normal,
                        double px) {
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
        points[count++] = (dp_pointd){p.x + (q.x - p.x) * t, p.y + (q.y - p.y) * t, p.d + (q.d - p.d) * t};
    }
    return count >= 3 ? count : 0;
}

/* The plane by Newell's method. False: it covers nothing. */
static bool set_plane(dp_added *out) {
    const dp_pointd *const p = out->points;
    double nx = 0, ny = 0, nz = 0;
    out->nearest = p[0].d;
    for (uint32_t i = 1; i < out->count; i++) {
        out->nearest = fmax(out->nearest, p[i].d);
        if (i + 1 == out->count) break;
        const double ax = p[i].x - p[0].x, ay = p[i].y - p[0].y, ad = p[i].d - p[0].d;
        const double bx = p[i + 1].x - p[0].x, by = p[i + 1].y - p[0].y, bd = p[i + 1].d - p[0].d;
        nx += ay * bd - ad * by;
        ny += ad * bx - ax * bd;
        nz += ax * by - ay * bx;
    }
    out->dx = -nx / nz, out->dy = -ny / nz;
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
    if (out->count) out->count = cut(out->points, out->count, -e->tx, -e->ty, reach + t + e->length);
    return out->count && set_plane(out);
}

/* The formula needs corners in front of the eye: the edge is clipped before it is moved, and what it
 * sweeps is clipped once more. */
bool dp_paper_quad(const dp_primitive *p, uint32_t edge, dp_vec3 direction, dp_vec3 normal, double px,
                   dp_added *out) {
    const uint32_t next = edge + 1 == p->n ? 0 : edge + 1;
    const dp_clip_point ca = p->clip[edge], cb = p->clip[next];
    double t0 = 0, t1 = 1;
    if ((dp_outcode(p->view, ca) | dp_outcode(p->view, cb)) && !dp_clip_segment(p->view, ca, cb, &t0, &t1))
        return false;
    const dp_vec3 e = dp_edge_direction(p, edge);
    const dp_vec3 from = p->world[edge], to = p->world[next];
    const dp_vec3 a = dp_mix(from, to, t0), b = dp_mix(from, to, t1);
    const dp_vec3 quad[4] = {a, b, dp_paper_offset(p->view, b, e, direction, normal, px),
                             dp_paper_offset(p->view, a, e, direction, normal, px)};
    return dp_paper_project(p, edge, quad, 4, DP_PAPER_REACH * px, out);
}

/* ------- on the screen ------- */

/* Shorter edges (px) have no direction to speak of. */
static const double SHORTEST = 1.0 / 4096;

bool dp_screen_edge_make(const dp_primitive *p, uint32_t edge, dp_screen_edge *out) {
    const dp_clip_point a = p->clip[edge], b = p->clip[edge + 1 == p->n ? 0 : edge + 1];
    double t0 = 0, t1 = 1;
    if ((dp_outcode(p->view, a) | dp_outcode(p->view, b)) && !dp_clip_segment(p->view, a, b, &t0, &t1))
        return false;
    /* ends that are not clipped stay as they are, bit for bit: the polygon's own outline runs there */
    const dp_clip_point ca = t0 > 0 ? dp_clip_mix(a, b, t0) : a, cb = t1 < 1 ? dp_clip_mix(a, b, t1) : b;
    out->a = dp_to_screen(p->view, ca);
    out->b = dp_to_screen(p->view, cb);
    out->middle = dp_clip_mix(ca, cb, 0.5);
    const double x = out->b.x - out->a.x, y = out->b.y - out->a.y;
    out->length = sqrt(x * x + y * y);
    if (!(out->length > SHORTEST) || !isfinite(out->length + out->a.d + out->b.d)) return false;
    out->tx = x / out->length, out->ty = y / out->length;
    /* a front-facing polygon has its inside to the left of its edges; the screen's y runs down */
    out->nx = p->front ? -out->ty : out->ty;
    out->ny = p->front ? out->tx : -out->tx;
    out->along = (out->b.d - out->a.d) / out->length;
    out->steep = dp_depth_step(p->view, dp_max(out->a.d, out->b.d), DP_STEEPEST);
    out->direction = dp_edge_direction(p, edge);
    out->own = dp_lean_of(p->view, out, dp_cross(out->direction, p->normal)).slope;
    return true;
}

/* Differentiates the projection at the edge's middle; a plane's depth is affine on the screen, so that
 * one point tells the slope everywhere. */
dp_lean dp_lean_of(const dp_view *view, const dp_screen_edge *edge, dp_vec3 q) {
    const double(*m)[4] = view->clip;
    const dp_clip_point c = edge->middle;
    const double x = m[0][0] * q.x + m[0][1] * q.y + m[0][2] * q.z;
    const double y = m[1][0] * q.x + m[1][1] * q.y + m[1][2] * q.z;
    const double w = m[3][0] * q.x + m[3][1] * q.y + m[3][2] * q.z;
    const double s = view->sight[0] * q.x + view->sight[1] * q.y + view->sight[2] * q.z;
    const double sx = 0.5 * view->width * (x * c.w - c.x * w) / (c.w * c.w);
    const double sy = -0.5 * view->height * (y * c.w - c.y * w) / (c.w * c.w);
    const double d = view->perspective ? -w / (c.w * c.w) : -s;
    const double out = sx * edge->nx + sy * edge->ny, along = sx * edge->tx + sy * edge->ty;
    const double rise = d - edge->along * along;
    const double edge_on = 1e-9 * view->focal / c.w; /* px per world unit */
    const bool outward = out > edge_on;
    return (dp_lean){outward, outward ? rise / out : rise > 0 ? INFINITY : -INFINITY};
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
    out->nearest = fmax(e->a.d, e->b.d) + fmax(d, 0);
}

dp_lean dp_quad_lean(const dp_primitive *p, const dp_screen_edge *edge, const dp_pen *pen) {
    return dp_lean_of(p->view, edge, dp_quad_direction(edge->direction, p->normal, pen));
}

/* Joints are made of triangles whose rims miss the circle by no more than this (px), or as many as there is
 * room for. */
static const double SAGITTA = 0.3;
enum { SPANS = DP_ADDED_MOST - 1 };

static uint32_t spans_of(double angle, double reach) {
    const double span = 2 * acos(1 - dp_min(SAGITTA / reach, 1));
    return (uint32_t)dp_min(ceil(angle / span), SPANS);
}

/* How much the quad at an edge rises over the polygon's own plane, depth per px. NaN: it faces away. */
static double rise_of(const dp_primitive *p, const dp_screen_edge *e, const dp_pen *pen) {
    const dp_lean lean = dp_quad_lean(p, e, pen);
    return lean.outward ? lean.slope - e->own : NAN;
}

/* On the rim, in direction (x, y). */
static dp_pointd rim_point(const dp_screen_edge *e, double reach, double x, double y, double rise) {
    const double t = x * e->tx + y * e->ty, n = x * e->nx + y * e->ny;
    const double d = e->b.d + reach * (e->along * t + e->own * n + rise);
    return (dp_pointd){e->b.x + reach * x, e->b.y + reach * y, dp_min(d, e->b.d + reach * e->steep)};
}

uint32_t dp_screen_joint(const dp_primitive *p, uint32_t edge, const dp_pen *pen, double reach, bool folded,
                         dp_added *out) {
    const uint32_t next = edge + 1 == p->n ? 0 : edge + 1;
    dp_screen_edge rooms[2];
    const dp_screen_edge *const e = dp_screen_edge_of(p, edge, &rooms[0]);
    const dp_screen_edge *const f = dp_screen_edge_of(p, next, &rooms[1]);
    if (!e || !f || dp_outcode(p->view, p->clip[next])) return 0;
    const double from_rise = folded ? rise_of(p, e, pen) : 0, to_rise = folded ? rise_of(p, f, pen) : 0;
    if (!isfinite(e->own) || !isfinite(from_rise + to_rise)) return 0;
    /* the corners of a convex polygon turn one way, or the other way when seen from behind */
    const double hand = p->front ? -1 : 1;
    const double sine = hand * (e->nx * f->ny - e->ny * f->nx), cosine = e->nx * f->nx + e->ny * f->ny;
    if (!(sine > 0) || cosine < -0.999) return 0;
    const double angle = atan2(sine, cosine);
    const uint32_t spans = spans_of(angle, reach);
    uint32_t count = 0;
    dp_pointd from = rim_point(e, reach, e->nx, e->ny, from_rise);
    for (uint32_t i = 1; i <= spans; i++) {
        const double share = (double)i / spans, up = from_rise + (to_rise - from_rise) * share;
        double x = f->nx, y = f->ny;
        if (i < spans) {
            const double c = cos(angle * share), s = sin(hand * angle * share);
            x = e->nx * c - e->ny * s, y = e->nx * s + e->ny * c;
        }
        const dp_pointd to = rim_point(e, reach, x, y, up);
        dp_added *const a = &out[count];
        a->points[0] = a->root[0] = a->root[1] = e->b;
        a->points[1] = from, a->points[2] = to;
        a->count = 3;
        a->joint = true;
        count += set_plane(a);
        from = to;
    }
    return count;
}
