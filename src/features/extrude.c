/* Extrudes a silhouette edge (Hermosilla and Vázquez 2010, Listing 2.2; extrude.h), in screen
 * space, so that widths are exact in px. Depth is that of the edge's ends; Listing 2.2 does not
 * change z either.
 *
 * Equation (2.1) of that paper gives texture coordinates to e1 and e2. The outer contour n1, e1,
 * e2, n2 is laid onto the edge a, b in proportion to its lengths:
 *
 *    d_a = |n1 e1|,  d_b = |e1 e2|,  d_c = |e2 n2|,  d = |ab|
 *    e1 = a + unit(ab) * d * d_a / (d_a + d_b + d_c)
 *    e2 = b + unit(ba) * d * d_c / (d_a + d_b + d_c)
 *
 * As printed, both lines have d_a, and v = 0. By symmetry the second must be d_c, or an edge and
 * its reverse would differ; and Figure 2.4 says that v is 1 outside. |ab| is read as the unit
 * vector in the first place, and d as the length. */
#include "features/extrude.h"

#include <math.h>

void dp_project_direction(const dp_view *view, dp_vec3 p, dp_vec3 normal, double out[2]) {
    const dp_clip_point c = dp_to_clip(view, p), n = dp_to_clip(view, dp_add(p, normal));
    const double dx = n.x - c.x, dy = n.y - c.y, dw = n.w - c.w;
    const double x = (dx * c.w - c.x * dw) * view->width, y = (c.y * dw - dy * c.w) * view->height;
    const double length = dp_hypot(x, y);
    out[0] = out[1] = 0;
    if (length > 0 && isfinite(length)) out[0] = x / length, out[1] = y / length;
}

static double distance(dp_pointd p, dp_pointd q) { return dp_hypot(q.x - p.x, q.y - p.y); }

/* The corner of the strip beyond one end of the edge. */
static dp_pointd beyond(dp_pointd end, const double normal[2], double ox, double oy, double width) {
    double nx = normal[0], ny = normal[1];
    if (nx == 0 && ny == 0) nx = ox, ny = oy;
    if (nx * ox + ny * oy < 0) nx = -nx, ny = -ny;
    return (dp_pointd){end.x + nx * width, end.y + ny * width, end.d};
}

bool dp_extrude(const dp_silhouette_edge *e, double width, dp_fin_point out[DP_FIN_POINTS]) {
    const double d = distance(e->a, e->b);
    if (!(d > 0)) return false;
    const double ex = (e->b.x - e->a.x) / d, ey = (e->b.y - e->a.y) / d;
    const double side = ex * e->outward[1] - ey * e->outward[0] < 0 ? -1 : 1;
    const double ox = -ey * side, oy = ex * side; /* perpendicular to the edge, outward */
    const dp_pointd e1 = {e->a.x + ox * width, e->a.y + oy * width, e->a.d};
    const dp_pointd e2 = {e->b.x + ox * width, e->b.y + oy * width, e->b.d};
    const dp_pointd n1 = beyond(e->a, e->normal_a, ox, oy, width),
                    n2 = beyond(e->b, e->normal_b, ox, oy, width);
    const double da = distance(n1, e1), db = distance(e1, e2), dc = distance(e2, n2),
                 contour = da + db + dc;
    const double t1 = d * da / contour, t2 = d * dc / contour; /* equation (2.1) */
    out[0] = (dp_fin_point){n1, e->a.x, e->a.y, 1};
    out[1] = (dp_fin_point){e1, e->a.x + ex * t1, e->a.y + ey * t1, 1};
    out[2] = (dp_fin_point){e->a, e->a.x, e->a.y, 0};
    out[3] = (dp_fin_point){e2, e->b.x - ex * t2, e->b.y - ey * t2, 1};
    out[4] = (dp_fin_point){e->b, e->b.x, e->b.y, 0};
    out[5] = (dp_fin_point){n2, e->b.x, e->b.y, 1};
    return true;
}
