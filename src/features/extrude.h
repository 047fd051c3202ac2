/* The geometry stage of Hermosilla and Vázquez 2010: what is added beside a silhouette edge (2.3.2,
 * Figure 2.3).
 *
 *        n1 ---- e1 ------- e2 ---- n2        v = 1
 *          \    /   \     /   \    /
 *           \  /     \   /     \  /
 *            a ----------------- b            v = 0, on the silhouette
 *
 * The quad a, e1, e2, b lies square to the edge on the screen; the triangles on either side of it
 * reach to the vertices' normals as projected, where the next edge's triangle ends too. */
#ifndef DP_FEATURES_EXTRUDE_H
#define DP_FEATURES_EXTRUDE_H

#include "core/view.h"

/* A vertex for the pixel stage: (x, y) that u is made of, and v. */
typedef struct dp_fin_point {
    dp_pointd at;  /* screen space */
    double tx, ty; /* px, screen space */
    double v;      /* 0 at the edge, 1 outside */
} dp_fin_point;

/* The strip of Listing 2.2, in its order: n1, e1, a, e2, b, n2; triangle i is points i, i + 1 and i
 * + 2. */
enum { DP_FIN_POINTS = 6, DP_FIN_TRIANGLES = 4 };

/* A silhouette edge on the screen. `outward`: the side on which to extrude, unit or not, square to
 * the edge or not; `normal`: of the vertices, projected, unit; 0, 0 where there is none (it then is
 * as the edge's). */
typedef struct dp_silhouette_edge {
    dp_pointd a, b;
    double outward[2];
    double normal_a[2], normal_b[2];
} dp_silhouette_edge;

/* False where the edge has no length on the screen. `width` in px. A normal that points against the
 * extrusion is turned round (Hermosilla and Vázquez 2009). */
bool dp_extrude(const dp_silhouette_edge *edge, double width, dp_fin_point out[DP_FIN_POINTS]);

/* The direction in which a point at `p` moves on the screen when it moves along `normal` in space:
 * unit, or 0, 0. Listing 2.2 projects the point one whole unit further on, which depends on the
 * model's size; this is the limit for small steps. */
void dp_project_direction(const dp_view *view, dp_vec3 p, dp_vec3 normal, double out[2]);

#endif
