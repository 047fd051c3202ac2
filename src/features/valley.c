/* Valleys (Raskar 2001, 2.3): at each edge of each front-facing polygon a quad at angle phi.
 *
 * The reverse of a ridge: it is behind the neighbour where that rises by more than phi. The quad never
 * writes depth and shows where it lies behind the surface, but trapped close to it (quads.c). */
#include "features/features.h"

static uint32_t paper(const dp_primitive *p, uint32_t edge, const dp_pen *pen, dp_added *out) {
    const dp_vec3 e = dp_edge_direction(p, edge);
    const dp_vec3 r = dp_quad_normal(e, p->normal, pen->angle);
    if (dp_dot(dp_view_vector(p->view, p->world[edge]), r) >= 0) return 0; /* culled: it faces away */
    return dp_paper_quad(p, edge, dp_quad_direction(e, p->normal, pen->angle), r, pen->reach, out);
}

/* A quad that is seen nearly edge-on would cut through whatever lies before it, and be trapped there: it
 * ends where it has come as near as DP_STEEPEST allows.
 * Facing away, a quad at phi > 180 leans over towards the eye: no neighbour that can be seen rises by
 * more. At phi < 180 it leads in under its own polygon: every neighbour that can be seen does. */
static uint32_t exact(const dp_primitive *p, uint32_t edge, const dp_pen *pen, dp_added *out) {
    dp_screen_edge e;
    if (!dp_screen_edge_make(p, edge, &e)) return 0;
    const dp_vec3 q = dp_quad_direction(dp_edge_direction(p, edge), p->normal, pen->angle);
    const dp_lean lean = dp_lean_of(p->view, &e, q);
    if (!lean.outward && pen->angle >= 180) return 0;
    const double slope = lean.outward ? lean.slope : -e.steep;
    const double reach = slope > e.steep ? pen->reach * e.steep / slope : pen->reach;
    dp_screen_quad(&e, reach, slope, &out[0]);
    const uint32_t next = edge + 1 == p->n ? 0 : edge + 1;
    const double rise[2] = {dp_screen_rise(p, edge, pen->angle), dp_screen_rise(p, next, pen->angle)};
    return 1 + dp_screen_joint(p, edge, &e, reach, rise, &out[1]);
}

uint32_t dp_shade_valley(const dp_primitive *p, uint32_t edge, const dp_pen *pen,
                         dp_added out[DP_ADDED_MOST]) {
    if (!p->front || (p->edge_flags && !p->edge_flags[edge])) return 0;
    return pen->method == DP_METHOD_PAPER ? paper(p, edge, pen, out) : exact(p, edge, pen, out);
}
