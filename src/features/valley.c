/* Valleys (Raskar 2001, 2.3): each edge of each front-facing polygon adds a quad at angle phi.
 *
 * The reverse of a ridge: the quad lies behind the neighbour if that rises by more than phi. It
 * never writes depth, and shows where it is behind the surface but close to it
 * (printed/quads.c). */
#include "features/features.h"

static uint32_t paper(const dp_primitive *p, uint32_t edge, const dp_pen *pen, dp_added *out) {
    const dp_vec3 e = dp_edge_direction(p, edge), r = dp_quad_normal(e, p->normal, pen);
    if (dp_dot(dp_view_vector(p->view, p->world[edge]), r) >= 0)
        return 0; /* culled: the quad faces away */
    return dp_paper_quad(p, edge, dp_quad_direction(e, p->normal, pen), r, pen->reach, out);
}

/* A quad seen nearly edge-on would cut through whatever is in front of it, and be trapped there, so
 * it ends where it has come nearer by DP_STEEPEST. If it faces away and phi > 180, it leans over
 * towards the eye, and no neighbour that is seen rises by more than phi. If phi < 180 it leads in
 * under its own polygon, and every neighbour that is seen does. */
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
    if (!p->front || !dp_may_crease(p, edge)) return 0;
    return pen->method == DP_METHOD_PAPER ? paper(p, edge, pen, out) : exact(p, edge, pen, out);
}
