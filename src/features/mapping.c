/* Texture coordinates of added polygons, in perspective, each polygon on its own.
 *
 *     s = (P - A)·E        along the edge, from its end A
 *     t = (P - A)·D        across: D lies in the added polygon's plane, square to E
 *     v = t / t_outer(s)   0 on the edge, 1 on the outer border, which is straight in that plane
 *
 * P is the point in space that a sample sees on the added polygon. Depth d is affine on the screen,
 * and so are s d and t d in perspective (s and t without it), so that u and v are quotients of two
 * affine functions.
 *
 * u must go on from one edge to the next, though nothing is known of the next:
 *
 *     3/4 of a repeat long, or more  a whole number of repeats from end to end: all ends are
 *                                    alike, and corners meet. Counted from the end whose position
 *                                    is less, so that both polygons of an edge agree
 *     shorter                        the position along an axis of space (or of the screen), that
 *                                    which lies most along the line, of the edge's nearest point:
 *                                    the same at the ends of all edges that choose that axis, so
 *                                    that it goes on through many small ones. Repeats are up to
 *                                    1.7 times longer where a line runs askew
 *
 * Around a corner u runs on straight, from either edge to the middle, as in a picture's frame, and
 * v is the distance from the edge on the screen. A line that is drawn half from each of its polygons
 * takes the texture once across both. */
#include "features/mapping.h"

#include "texture/texture.h"

double dp_pattern_length(const dp_frame *frame, const dp_style *style, float width) {
    const dp_pattern *const p = &style->pattern;
    const dp_stroke_style *const s = &style->stroke;
    const dp_texture *const texture = p->texture ? p->texture : s->texture;
    const double px =
        p->length > 0 ? (double)p->length : (double)(dp_texture_period(texture, width) * s->scale);
    const bool screen = p->texture ? p->screen : s->u != DP_STROKE_WORLD;
    if (p->world_length > 0) return (double)p->world_length / (screen ? frame->middle_pixel : 1);
    return screen ? px : px * frame->middle_pixel;
}

static double affine(const double f[3], double x, double y) { return f[0] + f[1] * x + f[2] * y; }

/* (P - A)·direction as an affine function of the screen, times depth in perspective; P on the plane
 * with depth `d`. */
static void project(const dp_view *view, const double d[3], dp_vec3 a, dp_vec3 direction,
                    double out[3]) {
    const dp_vec3 from = view->perspective ? view->eye : view->corner;
    const dp_vec3 ray = dp_sub(view->corner, from);
    const double at = dp_dot(dp_sub(from, a), direction);
    /* what one unit of d adds: in perspective P d = eye d + ray; else P runs along the axis */
    const double step =
        view->perspective
            ? at
            : dp_dot(dp_sub(dp_unproject(view, (dp_pointd){0, 0, 2}), view->corner), direction);
    out[0] = step * d[0] + (view->perspective ? dp_dot(ray, direction) : at - step);
    out[1] = step * d[1] + dp_dot(view->across, direction);
    out[2] = step * d[2] + dp_dot(view->down, direction);
}

/* Ends of an edge, and what is known of the added polygon's plane. */
typedef struct plane {
    const dp_view *view;
    dp_vec3 a, b, e;       /* the edge's ends in space; unit vector along it */
    double d[3], below[3]; /* depth; what s d and t d are divided by */
    double reach;          /* px */
} plane;

static plane plane_of(const dp_mapped *m) {
    const dp_primitive *const p = m->primitive;
    plane out = {.view = p->view,
                 .a = p->world[m->edge],
                 .b = p->world[m->edge + 1 == p->n ? 0 : m->edge + 1],
                 .e = dp_edge_direction(p, m->edge),
                 .d = {m->d0, m->dx, m->dy},
                 .below = {1, 0, 0},
                 .reach = m->pen.reach};
    for (int k = 0; k < 3 && p->view->perspective; k++) out.below[k] = out.d[k];
    return out;
}

/* Is a's position less than b's? The same for both polygons of an edge, whichever way they run. */
static bool comes_first(dp_vec3 a, dp_vec3 b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

/* ------- along ------- */

/* How often the pattern repeats on an edge; 0: it goes on through many such edges. */
static double repeats_on(double length, double repeat) {
    return length < 0.75 * repeat ? 0 : dp_max(floor(length / repeat + 0.5), 1);
}

static double remainder1(double x) { return x - floor(x); }

/* u = from + scale * s */
static void put_along(const plane *q, double from, double scale, dp_mapping *out) {
    project(q->view, q->d, q->a, q->e, out->u);
    for (int k = 0; k < 3; k++) {
        out->u[k] = scale * out->u[k] + from * q->below[k];
        out->u_over[k] = q->below[k];
    }
}

/* Where a line runs, without signs: along its edge; and an outline, whose edges zigzag where the
 * surface is round, also square to the normal and to the line of sight. Of a sharp outline that says
 * nothing, so both are asked: the product of both. */
static dp_vec3 likely_direction(const dp_mapped *m, const plane *q) {
    const dp_vec3 e = dp_v3(fabs(q->e.x), fabs(q->e.y), fabs(q->e.z));
    if (m->line != DP_LINE_SILHOUETTE) return e;
    const dp_vec3 t = dp_unit(dp_cross(m->primitive->normal, dp_view_vector(q->view, q->a)));
    const dp_vec3 both = dp_v3(e.x * fabs(t.x), e.y * fabs(t.y), e.z * fabs(t.z));
    return dp_dot(both, both) > 1e-6 ? both : e;
}

static dp_vec3 axis_of(dp_vec3 v) {
    return v.x >= v.y && v.x >= v.z ? dp_v3(1, 0, 0) : v.y >= v.z ? dp_v3(0, 1, 0) : dp_v3(0, 0, 1);
}

/* In space: whole repeats from end to end, or the position along an axis. */
static void map_space(const dp_mapped *m, const plane *q, dp_mapping *out) {
    const double length = dp_length(dp_sub(q->b, q->a)), repeats = repeats_on(length, m->length);
    if (repeats >= 1) {
        const bool forward = comes_first(q->a, q->b);
        put_along(q, forward ? 0 : repeats, (forward ? 1 : -1) * repeats / length, out);
        return;
    }
    const dp_vec3 axis = axis_of(likely_direction(m, q));
    put_along(q, remainder1(dp_dot(q->a, axis) / m->length), dp_dot(q->e, axis) / m->length, out);
}

/* On the screen: does the line run across rather than down? As for space. */
static bool runs_level(const dp_mapped *m, const plane *q, const dp_screen_edge *e) {
    double x = fabs(e->tx), y = fabs(e->ty);
    if (m->line == DP_LINE_SILHOUETTE) {
        const dp_vec3 t = dp_cross(m->primitive->normal, dp_view_vector(q->view, q->a));
        x *= fabs(dp_dot(t, q->view->across)), y *= fabs(dp_dot(t, q->view->down));
    }
    return x >= y;
}

/* The same on the screen. */
static void map_screen(const dp_mapped *m, const plane *q, const dp_screen_edge *e,
                       dp_mapping *out) {
    const double repeats = repeats_on(e->length, m->length);
    const bool level = runs_level(m, q, e), forward = comes_first(q->a, q->b);
    double from = forward ? 0 : repeats, scale = (forward ? 1 : -1) * repeats / e->length;
    if (!(repeats >= 1))
        from = (level ? e->a.x : e->a.y) / m->length, scale = (level ? e->tx : e->ty) / m->length;
    out->u[1] = scale * e->tx, out->u[2] = scale * e->ty;
    out->u[0] = from - out->u[1] * e->a.x - out->u[2] * e->a.y;
    out->u_over[0] = 1, out->u_over[1] = out->u_over[2] = 0;
}

/* ------- across ------- */

/* Two points of the outer border. As printed they are the shifted ends of what is seen of the edge;
 * else they lie `reach` px from it. False: the plane does not reach as far before the horizon. */
static bool outer_border(const dp_mapped *m, const plane *q, const dp_screen_edge *e,
                         dp_vec3 out[2]) {
    const dp_primitive *const p = m->primitive;
    if (m->pen.method == DP_METHOD_PAPER) {
        const bool in_plane = m->line == DP_LINE_SILHOUETTE;
        const dp_vec3 n = p->normal;
        const dp_vec3 along = in_plane ? dp_cross(q->e, n) : dp_quad_direction(q->e, n, &m->pen);
        const dp_vec3 normal = in_plane ? n : dp_quad_normal(q->e, n, &m->pen);
        const dp_pointd ends[2] = {e->a, e->b};
        for (int i = 0; i < 2; i++)
            out[i] = dp_paper_offset(q->view, dp_unproject(q->view, ends[i]), q->e, along, normal,
                                     m->pen.reach);
        return true;
    }
    for (int i = 0; i < 2; i++) {
        const dp_pointd end = i ? e->b : e->a;
        dp_pointd at = {end.x + e->nx * q->reach, end.y + e->ny * q->reach, 0};
        at.d = affine(q->d, at.x, at.y);
        if (q->view->perspective && !(at.d > 0.25 * end.d)) return false;
        out[i] = dp_unproject(q->view, at);
    }
    return true;
}

/* v by the distance on the screen. */
static void map_across_screen(const plane *q, const dp_screen_edge *e, dp_mapping *out) {
    out->v[1] = e->nx / q->reach, out->v[2] = e->ny / q->reach;
    out->v[0] = -out->v[1] * e->a.x - out->v[2] * e->a.y;
    out->v_over[0] = 1, out->v_over[1] = out->v_over[2] = 0;
}

/* The border is t = t0 + slope s; v = t d / (t0 d + slope s d). */
static bool map_across(const dp_mapped *m, const plane *q, const dp_screen_edge *e,
                       dp_mapping *out) {
    dp_vec3 border[2];
    double s[2], t[2], along[3];
    if (!outer_border(m, q, e, border)) return false;
    const dp_vec3 off = dp_sub(dp_mix(border[0], border[1], 0.5), q->a);
    const dp_vec3 d = dp_unit(dp_mad(off, q->e, -dp_dot(off, q->e)));
    for (int i = 0; i < 2; i++)
        s[i] = dp_dot(dp_sub(border[i], q->a), q->e), t[i] = dp_dot(dp_sub(border[i], q->a), d);
    const double slope = (t[1] - t[0]) / (s[1] - s[0]), t0 = t[0] - slope * s[0];
    if (!isfinite(slope) || !(t[0] > 0) || !(t[1] > 0)) return false;
    project(q->view, q->d, q->a, d, out->v);
    project(q->view, q->d, q->a, q->e, along);
    for (int k = 0; k < 3; k++) out->v_over[k] = t0 * q->below[k] + slope * along[k];
    return true;
}

void dp_mapping_make(const dp_mapped *m, dp_mapping *out) {
    const plane q = plane_of(m);
    dp_screen_edge room;
    const dp_screen_edge *const e = dp_screen_edge_of(m->primitive, m->edge, &room);
    const bool forward = comes_first(q.a, q.b);
    *out = (dp_mapping){.u_over = {1, 0, 0},
                        .v_over = {1, 0, 0},
                        .v_from = m->whole ? 0 : 0.5,
                        .v_scale = m->whole  ? 1
                                   : forward ? 0.5
                                             : -0.5};
    if (!e) return;
    if (m->screen)
        map_screen(m, &q, e, out);
    else
        map_space(m, &q, out);
    if (m->joint || !map_across(m, &q, e, out)) map_across_screen(&q, e, out);
}

/* A quotient and how much it changes per px. */
static double quotient(const double over[3], const double under[3], double x, double y,
                       double *change) {
    const double inverse = 1 / affine(under, x, y), value = affine(over, x, y) * inverse;
    *change = dp_hypot(over[1] - value * under[1], over[2] - value * under[2]) * fabs(inverse);
    return value;
}

dp_mapped_point dp_mapping_at(const dp_mapping *m, double x, double y) {
    dp_mapped_point out;
    out.u = quotient(m->u, m->u_over, x, y, &out.du);
    out.v = quotient(m->v, m->v_over, x, y, &out.dv);
    out.u = isfinite(out.u) ? remainder1(out.u) : 0;
    out.v = m->v_from + m->v_scale * dp_min(dp_max(out.v, 0), 1);
    out.dv *= fabs(m->v_scale);
    if (!isfinite(out.du)) out.du = 0;
    return out;
}
