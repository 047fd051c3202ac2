/* Silhouettes (Raskar 2001, 2.1): each back-facing polygon is enlarged in its own plane.
 *
 * The paper's 2n-gon is made edge by edge: the quad beyond an edge, and the triangle between it and
 * the next edge's quad. Beside a front-facing neighbour the enlargement shows along its outline;
 * elsewhere it stays hidden behind front faces. The polygon itself is not inked: where it is seen,
 * in an open model, it is surface. */
#include "features/features.h"

static uint32_t paper(const dp_primitive *p, uint32_t edge, const dp_pen *pen, dp_added *out) {
    const dp_vec3 n = p->normal, e = dp_edge_direction(p, edge);
    uint32_t count = dp_paper_quad(p, edge, dp_cross(e, n), n, pen->reach, &out[0]);
    const uint32_t next = edge + 1 == p->n ? 0 : edge + 1;
    if ((p->edge_flags && !dp_flag_may_be_line(p->edge_flags[next])) ||
        dp_outcode(p->view, p->clip[next]))
        return count;
    const dp_vec3 corner = p->world[next], f = dp_edge_direction(p, next);
    const dp_vec3 bevel[3] = {corner,
                              dp_paper_offset(p->view, corner, e, dp_cross(e, n), n, pen->reach),
                              dp_paper_offset(p->view, corner, f, dp_cross(f, n), n, pen->reach)};
    if (!dp_paper_project(p, edge, bevel, 3, DP_PAPER_REACH * pen->reach, &out[count]))
        return count;
    out[count].joint = true;
    return count + 1;
}

/* A polygon seen nearly edge-on would shoot towards the eye, so its slope is limited to
 * DP_STEEPEST. */
static uint32_t exact(const dp_primitive *p, uint32_t edge, const dp_pen *pen, dp_added *out) {
    dp_screen_edge room;
    const dp_screen_edge *const e = dp_screen_edge_of(p, edge, &room);
    if (!e || e->own == -INFINITY)
        return 0; /* it leads straight away from the eye and is not seen */
    dp_screen_quad(e, pen->reach, dp_min(e->own, e->steep), &out[0]);
    return 1 + dp_screen_joint(p, edge, pen, pen->reach, false, &out[1]);
}

uint32_t dp_shade_silhouette(const dp_primitive *p, uint32_t edge, const dp_pen *pen,
                             dp_added out[DP_ADDED_MOST]) {
    if (p->front || (p->edge_flags && !dp_flag_may_be_line(p->edge_flags[edge]))) return 0;
    return pen->method == DP_METHOD_PAPER ? paper(p, edge, pen, out) : exact(p, edge, pen, out);
}
