/* Primitive shaders (Raskar 2001, Figure 2): from one polygon and the view to added polygons.
 *
 * They stand between primitive assembly and rasterization, and know of no other polygon. Each looks
 * at one edge at a time, keeps nothing and allocates nothing. For an edge from P_i to P_j of a
 * polygon with normal N: E = unit(P_j - P_i); O = E × N points out of the polygon, in its plane.
 *
 *    silhouette     back face    a quad along O, in the polygon's own plane            (2.1)
 *    ridge          front face   a quad along Q(theta), with normal R(theta)           (2.2)
 *    valley         front face   the same with phi; takes the between-test             (2.3)
 *    intersection   any          nothing; the polygon itself takes the between-test    (2.4)
 *
 *    Q(angle) = -N sin(angle) - O cos(angle)
 *    R(angle) = -N cos(angle) + O sin(angle)                                           (2.2)
 *
 * Sections are those of (Raskar 2001); the tests are in printed/quads_fill.c. DP_METHOD_PAPER moves
 * the ends of the edge in space, as printed. DP_METHOD_EXACT builds the polygon on the screen,
 * where widths are exact, and takes only its depth from the plane in space. */
#ifndef DP_FEATURES_FEATURES_H
#define DP_FEATURES_FEATURES_H

#include "mesh/polygons.h"
#include "core/view.h"
#include <drypoint/style.h>

/* What a step in space from the edge's middle does on the screen, per world unit. Linear in the
 * step, so the motions along O and N give that in any direction perpendicular to the edge. */
typedef struct dp_motion {
    double out;  /* px out of the polygon, perpendicular to the edge */
    double rise; /* gain in depth beyond that of a step along the edge */
} dp_motion;

/* An edge on the screen, clipped to the guarded frustum. */
typedef struct dp_screen_edge {
    dp_pointd a, b;
    double length; /* px; 0: nothing of it is seen */
    double tx, ty; /* unit vector along it */
    double nx, ny; /* unit vector out of the polygon */
    double along;  /* change of depth per px along it */
    double own;    /* change of depth per px outward, in the polygon's plane; infinite if edge-on */
    double steep;  /* the largest change of depth per px outward: DP_STEEPEST */
    double edge_on;            /* px per world unit: a plane is edge-on up to this */
    dp_motion outward, normal; /* motions along O and N */
    bool ends_outside;         /* the corner where it ends is outside the frustum */
} dp_screen_edge;

/* A polygon as primitive assembly passes it on. */
typedef struct dp_primitive {
    const dp_view *view;
    uint32_t n;
    const dp_vec3 *world;        /* [n] corners */
    const dp_clip_point *clip;   /* [n] the same in clip space */
    const uint8_t *edge_flags;   /* [n]; NULL: every edge may draw */
    bool has_diagonals;          /* a flag may be above DP_EDGE_NORMAL */
    const dp_screen_edge *edges; /* [n]; NULL: made when needed */
    dp_vec3 normal;              /* unit, as wound */
    bool front;                  /* edge-on polygons count as back-facing */
} dp_primitive;

/* How a line is to be drawn. */
typedef struct dp_pen {
    dp_method method;
    double reach;        /* px: how far added polygons reach from the edge */
    double angle;        /* degrees: theta or phi */
    double cosine, sine; /* of the angle */
} dp_pen;
dp_pen dp_pen_make(dp_method method, double reach, double angle);

enum {
    DP_ADDED_POINTS =
        16,           /* 4 corners + 6 planes of the frustum + 4 sides of the reach, rounded up */
    DP_ADDED_MOST = 8 /* per edge and class */
};

/* An added polygon on the screen: convex, either winding. */
typedef struct dp_added {
    dp_pointd points[DP_ADDED_POINTS];
    uint32_t count;
    double d0, dx, dy; /* depth: min(d0 + dx * x + dy * y, nearest) */
    double nearest;
    dp_pointd root[2]; /* what it grows from: an edge, or a corner twice */
    bool joint;        /* part of a round joint */
} dp_added;

/* Writes the polygons that are added at edge `edge`, and returns how many. */
typedef uint32_t dp_primitive_shader(const dp_primitive *primitive, uint32_t edge,
                                     const dp_pen *pen, dp_added out[DP_ADDED_MOST]);
dp_primitive_shader dp_shade_silhouette;
dp_primitive_shader dp_shade_ridge;
dp_primitive_shader dp_shade_valley;

/* Do two polygons have a corner position in common? Then they meet there by construction and do not
 * count as intersecting, although their planes cross. */
bool dp_polygons_touch(const dp_polygons *polygons, uint32_t a, uint32_t b);

/* The between-test of planes: do two planes cross within `reach` px on the screen? `gap`: how far
 * the fragment is behind the surface, d > 0; `gx`, `gy`: the difference of the planes'
 * gradients. */
static inline bool dp_planes_cross_within(float gap, float gx, float gy, float reach) {
    return gap * gap <= (gx * gx + gy * gy) * reach * reach;
}

/* What the shaders are made of ---------------------------------------------------------------- */

/* With DP_METHOD_PAPER, polygons are cut off at this many times the pen's reach. */
#define DP_PAPER_REACH 1.5
/* The same along an axis of the screen, as they reach both outward and along the edge. */
#define DP_PAPER_MARGIN (DP_PAPER_REACH * 1.4143)
/* Least value of |V·N| and |V·R|, so that the quotients of (Raskar 2001, 2.1 and 2.2) stay finite.
 * A polygon seen at less than 1.8 degrees grows by at most 32 widths in space, and its line gets
 * thinner. */
#define DP_PAPER_GRAZING (1.0 / 32)
/* Pixel sizes per px: an added polygon comes nearer by no more than this, away from its edge. */
#define DP_STEEPEST 4.0

static inline dp_vec3 dp_edge_direction(const dp_primitive *p, uint32_t edge) {
    return dp_unit(dp_sub(p->world[edge + 1 == p->n ? 0 : edge + 1], p->world[edge]));
}

/* Q and R (Raskar 2001, 2.2) for edge direction e, polygon normal n, and the pen's angle. */
dp_vec3 dp_quad_direction(dp_vec3 e, dp_vec3 n, const dp_pen *pen);
dp_vec3 dp_quad_normal(dp_vec3 e, dp_vec3 n, const dp_pen *pen);

/* P_k + w D [z sin(alpha) (V·C) / (V·M)] (Raskar 2001, 2.1 and 2.2), for the corner at p of an edge
 * along e. D = `direction`; M = `normal` of the plane it moves in; w z is what `px` measures at
 * p. */
dp_vec3 dp_paper_offset(const dp_view *view, dp_vec3 p, dp_vec3 e, dp_vec3 direction,
                        dp_vec3 normal, double px);

/* The quad that an edge sweeps along `direction` in the plane with normal `normal`, by that
 * formula, clipped. False: nothing is left. */
bool dp_paper_quad(const dp_primitive *p, uint32_t edge, dp_vec3 direction, dp_vec3 normal,
                   double px, dp_added *out);

/* Projects a polygon, clipped to the frustum and to `reach` px around the projected edge. */
bool dp_paper_project(const dp_primitive *p, uint32_t edge, const dp_vec3 *points, uint32_t count,
                      double reach, dp_added *out);

/* False: nothing of the edge is seen. */
bool dp_screen_edge_make(const dp_primitive *p, uint32_t edge, dp_screen_edge *out);

/* Makes all n edges; those of which nothing is seen get length 0. */
void dp_screen_edges_make(const dp_primitive *p, dp_screen_edge *out);

/* One edge: the primitive's own if it has edges, else made in `room`. NULL: nothing of it is
 * seen. */
static inline const dp_screen_edge *dp_screen_edge_of(const dp_primitive *p, uint32_t edge,
                                                      dp_screen_edge *room) {
    if (p->edges) return p->edges[edge].length > 0 ? &p->edges[edge] : NULL;
    return dp_screen_edge_make(p, edge, room) ? room : NULL;
}

/* How a plane through the edge leans, as seen by the eye. */
typedef struct dp_lean {
    bool outward; /* on the screen it leads out of the polygon: its front is seen */
    double slope; /* change of depth per px outward; infinite if edge-on */
} dp_lean;

/* The rectangle beside the edge, `reach` px wide; its depth changes by `slope` per px. */
void dp_screen_quad(const dp_screen_edge *edge, double reach, double slope, dp_added *out);

/* How the quad at the pen's angle leans (Raskar 2001, 2.2). */
dp_lean dp_quad_lean(const dp_screen_edge *edge, const dp_pen *pen);

/* The round joint between that rectangle and the next edge's, around the corner where `edge` ends,
 * in thin triangles. It is a cone: as far above the polygon's own plane as the quads at the pen's
 * angle; or, if not `folded` (silhouettes), in that plane. Returns the number of triangles; 0 if
 * the corner is clipped, the polygon edge-on, or a quad seen from behind. */
uint32_t dp_screen_joint(const dp_primitive *p, uint32_t edge, const dp_pen *pen, double reach,
                         bool folded, dp_added *out);

/* May the edge be a crease? One that only splits a polygon is none. */
static inline bool dp_may_crease(const dp_primitive *p, uint32_t edge) {
    return !p->edge_flags || p->edge_flags[edge] == DP_EDGE_NORMAL;
}

#endif
