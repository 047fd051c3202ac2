/* Ridges (Raskar 2001, 2.2): at each edge of each front-facing polygon a quad at angle theta.
 *
 * It lies before the neighbour where that is folded away by more than theta, and is hidden by it
 * everywhere else: the ordinary depth test decides. Each of the two polygons at an edge covers the
 * other's side. An edge without a neighbour is folded away altogether and shows. */
#include "features/features.h"

static uint32_t paper(const dp_primitive *p, uint32_t edge, const dp_pen *pen, dp_added *out) {
    const dp_vec3 e = dp_edge_direction(p, edge);
    const dp_vec3 r = dp_quad_normal(e, p->normal, pen->angle);
    if (dp_dot(dp_view_vector(p->view, p->world[edge]), r) >= 0) return 0; /* culled: it faces away */
    return dp_paper_quad(p, edge, dp_quad_direction(e, p->normal, pen->angle), r, pen->reach, out);
}

/* Facing away, a quad at theta < 180 leads in under its own polygon and is not seen. At theta > 180 it
 * leans over towards the eye: every neighbour that can be seen is folded by more than theta. */
static uint32_t exact(const dp_primitive *p, uint32_t edge, const dp_pen *pen, dp_added *out) {
    dp_screen_edge e;
    if (!dp_screen_edge_make(p, edge, &e)) return 0;
    const dp_vec3 q = dp_quad_direction(dp_edge_direction(p, edge), p->normal, pen->angle);
    const dp_lean lean = dp_lean_of(p->view, &e, q);
    if (!lean.outward && pen->angle <= 180) return 0;
    const double slope = lean.outward ? fmin(lean.slope, e.steep) : e.steep;
    dp_screen_quad(&e, pen->reach, slope, &out[0]);
    const uint32_t next = edge + 1 == p->n ? 0 : edge + 1;
    const double rise[2] = {dp_screen_rise(p, edge, pen->angle), dp_screen_rise(p, next, pen->angle)};
    return 1 + dp_screen_joint(p, edge, &e, pen->reach, rise, &out[1]);
}

uint32_t dp_shade_ridge(const dp_primitive *p, uint32_t edge, const dp_pen *pen,
                        dp_added out[DP_ADDED_MOST]) {
    if (!p->front || (p->edge_flags && !p->edge_flags[edge])) return 0;
    return pen->method == DP_METHOD_PAPER ? paper(p, edge, pen, out) : exact(p, edge, pen, out);
}
