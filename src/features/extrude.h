/* The triangles added beside a silhouette edge (Hermosilla and Vázquez 2010, 2.3.2, Figure 2.3).
 *
 *       n1 ---- e1 ------- e2 ---- n2        v = 1
 *         \    /   \     /   \    /
 *          \  /     \   /     \  /
 *           a ----------------- b            v = 0, on the silhouette
 *
 * The quad a, e1, e2, b is a rectangle on the screen. The triangles beside it reach to the
 * projected vertex normals, where the next edge's triangle ends too. */
#ifndef DP_FEATURES_EXTRUDE_H
#define DP_FEATURES_EXTRUDE_H

#include "core/view.h"

/* A vertex for the pixel stage: its position, the (tx, ty) from which u is computed, and v. */
typedef struct dp_fin_point {
    dp_pointd at;  /* screen space */
    double tx, ty; /* px, screen space */
    double v;      /* 0 at the edge, 1 outside */
} dp_fin_point;

/* The strip (Hermosilla and Vázquez 2010, Listing 2.2) in its order: n1, e1, a, e2, b, n2. Triangle
 * i is points i, i + 1 and i + 2. */
enum { DP_FIN_POINTS = 6, DP_FIN_TRIANGLES = 4 };

/* A silhouette edge on the screen. `outward`: points to the side to extrude to; any length and
 * angle. `normal_a`, `normal_b`: of the vertices, projected, unit; (0, 0) if unknown: the edge's is
 * used. */
typedef struct dp_silhouette_edge {
    dp_pointd a, b;
    double outward[2];
    double normal_a[2], normal_b[2];
} dp_silhouette_edge;

/* False: the edge has no length on the screen. `width` in px. A normal that points against the
 * extrusion is reversed, as in Hermosilla and Vázquez 2009. */
bool dp_extrude(const dp_silhouette_edge *edge, double width, dp_fin_point out[DP_FIN_POINTS]);

/* The direction on the screen in which a point at `p` moves along `normal` in space: unit, or (0,
 * 0). Listing 2.2 projects a point one unit further on, which depends on the model's size; this is
 * the limit for small steps. */
void dp_project_direction(const dp_view *view, dp_vec3 p, dp_vec3 normal, double out[2]);

#endif
