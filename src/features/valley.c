/* Valleys (Raskar 2001, 2.3): at each edge of each front-facing polygon a quad at angle phi.
 *
 * The reverse of a ridge: it is behind the neighbour where that rises by more than phi. The quad
 * never writes depth and shows where it lies behind the surface, but trapped close to it
 * (quads.c). */
#include "features/features.h"

static uint32_t paper(const dp_primitive *p, uint32_t edge, const dp_pen *pen, dp_added *out) {
    const dp_vec3 e = dp_edge_direction(p, edge), r = dp_quad_normal(e, p->normal, pen);
    if (dp_dot(dp_view_vector(p->view, p->world[edge]), r) >= 0)
        return 0; /* culled: it faces away */
    return dp_paper_quad(p, edge, dp_quad_direction(e, p->normal, pen), r, pen->reach, out);
}

/* A quad that is seen nearly edge-on would cut through whatever lies before it, and be trapped
 * there: it ends where it has come as near as DP_STEEPEST allows. Facing away, a quad at phi > 180
 * leans over towards the eye: no neighbour that can be seen rises by more. At phi < 180 it leads in
 * under its own polygon: every neighbour that can be seen does. */
static uint32_t exact(const dp_primitive *p, uint32_t edge, const dp_pen *pen, dp_added *out) {
    dp_screen_edge room;
    const dp_screen_edge *const e = dp_screen_edge_of(p, edge, &room);
    if (!e) return 0;
    const dp_lean lean = dp_quad_lean(e, pen);
    if (!lean.outward && pen->angle >= 180) return 0;
    const double slope = lean.outward ? lean.slope : -e->steep;
    const double reach = slope > e->steep ? pen->reach * e->steep / slope : pen->reach;
    dp_screen_quad(e, reach, slope, &out[0]);
    return 1 + dp_screen_joint(p, edge, pen, reach, true, &out[1]);
}

uint32_t dp_shade_valley(const dp_primitive *p, uint32_t edge, const dp_pen *pen,
                         dp_added out[DP_ADDED_MOST]) {
    if (!p->front || (p->edge_flags && !p->edge_flags[edge])) return 0;
    return pen->method == DP_METHOD_PAPER ? paper(p, edge, pen, out) : exact(p, edge, pen, out);
}
