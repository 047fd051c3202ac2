/* Ridges (Raskar 2001, 2.2): at each edge of each front-facing polygon a quad at angle theta.
 *
 * It lies before the neighbour where that is folded away by more than theta, and is hidden by it
 * everywhere else: the ordinary depth test decides. Each of the two polygons at an edge covers the
 * other's side. An edge without a neighbour is folded away altogether and shows. */
#include "features/features.h"

static uint32_t paper(const dp_primitive *p, uint32_t edge, const dp_pen *pen, dp_added *out) {
    const dp_vec3 e = dp_edge_direction(p, edge), r = dp_quad_normal(e, p->normal, pen);
    if (dp_dot(dp_view_vector(p->view, p->world[edge]), r) >= 0)
        return 0; /* culled: it faces away */
    return dp_paper_quad(p, edge, dp_quad_direction(e, p->normal, pen), r, pen->reach, out);
}

/* Facing away, a quad at theta < 180 leads in under its own polygon and is not seen. At theta > 180
 * it leans over towards the eye: every neighbour that can be seen is folded by more than theta. */
static uint32_t exact(const dp_primitive *p, uint32_t edge, const dp_pen *pen, dp_added *out) {
    dp_screen_edge room;
    const dp_screen_edge *const e = dp_screen_edge_of(p, edge, &room);
    if (!e) return 0;
    const dp_lean lean = dp_quad_lean(e, pen);
    if (!lean.outward && pen->angle <= 180) return 0;
    dp_screen_quad(e, pen->reach, lean.outward ? dp_min(lean.slope, e->steep) : e->steep, &out[0]);
    return 1 + dp_screen_joint(p, edge, pen, pen->reach, true, &out[1]);
}

uint32_t dp_shade_ridge(const dp_primitive *p, uint32_t edge, const dp_pen *pen,
                        dp_added out[DP_ADDED_MOST]) {
    if (!p->front || (p->edge_flags && !p->edge_flags[edge])) return 0;
    return pen->method == DP_METHOD_PAPER ? paper(p, edge, pen, out) : exact(p, edge, pen, out);
}
