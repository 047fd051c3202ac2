/* Ridges (Raskar 2001, 2.2): each edge of each front-facing polygon adds a quad at angle theta.
 *
 * The quad lies in front of the neighbour if that is folded away by more than theta, and behind it
 * otherwise, so the ordinary depth test decides. Each polygon at an edge draws half of the line, on
 * the other's side. An edge without a neighbour shows its quad: it is drawn as a ridge. */
#include "features/features.h"

static uint32_t paper(const dp_primitive *p, uint32_t edge, const dp_pen *pen, dp_added *out) {
    const dp_vec3 e = dp_edge_direction(p, edge), r = dp_quad_normal(e, p->normal, pen);
    if (dp_dot(dp_view_vector(p->view, p->world[edge]), r) >= 0)
        return 0; /* culled: the quad faces away */
    return dp_paper_quad(p, edge, dp_quad_direction(e, p->normal, pen), r, pen->reach, out);
}

/* If the quad faces away and theta < 180, it leads in under its own polygon and is not seen. If
 * theta > 180 it leans over towards the eye, and any neighbour that is seen is folded by more than
 * theta. */
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
    if (!p->front || !dp_may_crease(p, edge)) return 0;
    return pen->method == DP_METHOD_PAPER ? paper(p, edge, pen, out) : exact(p, edge, pen, out);
}
