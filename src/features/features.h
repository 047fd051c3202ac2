/* Primitive shaders (Raskar 2001, Figure 2): from one polygon and the view to added polygons.
 *
 * They stand between primitive assembly and rasterization and know nothing of any other polygon.
 * Each looks at one edge at a time, keeps nothing and allocates nothing. For an edge from P_i to
 * P_j of a polygon with normal N: E = unit(P_j - P_i), O = E x N points out of the polygon, in its
 * plane.
 *
 *   silhouette   back-facing polygons: a fin along O, in the polygon's own plane
 *   ridge        front-facing polygons: a quad along Q(theta), with normal R(theta)
 *   valley       the same with phi; it is to be tested against what has been drawn (quads.c)
 *   intersection no added polygon: the polygon itself is tested so (intersection.c)
 *
 *   Q = -N sin(angle) - O cos(angle)      R = -N cos(angle) + O sin(angle)      (2.2)
 *
 * DP_METHOD_PAPER moves the ends of the edge in space, as printed; DP_METHOD_EXACT builds the
 * polygon on the screen, where widths are exact, and takes only its depth from the plane in
 * space. */
#ifndef DP_FEATURES_FEATURES_H
#define DP_FEATURES_FEATURES_H

#include "mesh/polygons.h"
#include "core/view.h"
#include <drypoint/style.h>

/* What a step from the edge's middle along a direction of space does on the screen, per world unit.
 * Linear in the direction, so that what is known of O and N tells it of any direction square to the
 * edge. */
typedef struct dp_motion {
    double out;  /* px out of the polygon, square to the edge */
    double rise; /* depth that it gains over a step along the edge */
} dp_motion;

/* An edge on the screen, clipped to the guarded frustum. */
typedef struct dp_screen_edge {
    dp_pointd a, b;
    double length; /* px; 0: nothing of it is seen */
    double tx, ty; /* along, unit */
    double nx, ny; /* out of the polygon, unit */
    double along;  /* change of depth per px along */
    double own;   /* change of depth per px outward in the polygon's plane; infinite when edge-on */
    double steep; /* the same at DP_STEEPEST */
    double edge_on;            /* a plane that moves out by no more than this is seen edge-on */
    dp_motion outward, normal; /* along O and N */
    bool ends_outside;         /* the corner where it ends lies outside the frustum */
} dp_screen_edge;

/* A polygon as primitive assembly hands it over. */
typedef struct dp_primitive {
    const dp_view *view;
    uint32_t n;
    const dp_vec3 *world;        /* [n] corners */
    const dp_clip_point *clip;   /* [n] the same in clip space */
    const uint8_t *edge_flags;   /* [n]; NULL: every edge draws */
    const dp_screen_edge *edges; /* [n]; NULL: made when they are needed */
    dp_vec3 normal;              /* unit, as wound */
    bool front;                  /* edge-on counts as back-facing */
} dp_primitive;

/* What is to be drawn. */
typedef struct dp_pen {
    dp_method method;
    double reach;        /* px, how far added polygons reach over the edge */
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
    double d0, dx, dy; /* its depth: min(d0 + dx * x + dy * y, nearest) */
    double nearest;
    dp_pointd root[2]; /* what it grows from: the edge, or a corner twice */
    bool joint;        /* it is part of a round joint */
} dp_added;

/* Fills out with what is added at edge `edge` and returns how many. */
typedef uint32_t dp_primitive_shader(const dp_primitive *primitive, uint32_t edge,
                                     const dp_pen *pen, dp_added out[DP_ADDED_MOST]);
dp_primitive_shader dp_shade_silhouette;
dp_primitive_shader dp_shade_ridge;
dp_primitive_shader dp_shade_valley;

/* Two polygons whose corners have a position in common meet there by construction and do not count
 * as intersecting, although their planes cross. */
bool dp_polygons_touch(const dp_polygons *polygons, uint32_t a, uint32_t b);

/* The between-test of planes: `gap` is how far a fragment lies behind the surface (depth d, > 0),
 * `gx` and `gy` the difference of the two planes' gradients. True when they cross within `reach`
 * px. */
static inline bool dp_planes_cross_within(float gap, float gx, float gy, float reach) {
    return gap * gap <= (gx * gx + gy * gy) * reach * reach;
}

/* What the shaders are made of ---------------------------------------------------------------- */

/* A paper method's polygon reaches no further than this many times the pen's reach. */
#define DP_PAPER_REACH 1.5
/* The same along an axis of the screen: it is both outward and along the edge. */
#define DP_PAPER_MARGIN (DP_PAPER_REACH * 1.4143)
/* |V·N| and |V·R| count as no less than this, so that the paper's quotients stay finite: a polygon
 * seen at less than 1.8 degrees grows by no more than 32 widths in space, and its line gets
 * thinner. */
#define DP_PAPER_GRAZING (1.0 / 32)
/* An added polygon comes nearer by no more than this many pixel sizes per px away from its edge. */
#define DP_STEEPEST 4.0

static inline dp_vec3 dp_edge_direction(const dp_primitive *p, uint32_t edge) {
    return dp_unit(dp_sub(p->world[edge + 1 == p->n ? 0 : edge + 1], p->world[edge]));
}

/* The paper's Q and R for edge direction e, normal n, and the pen's angle. */
dp_vec3 dp_quad_direction(dp_vec3 e, dp_vec3 n, const dp_pen *pen);
dp_vec3 dp_quad_normal(dp_vec3 e, dp_vec3 n, const dp_pen *pen);

/* P_k + w D [z sin(alpha) (V·C) / (V·M)] for the corner at p of an edge along e, with D =
 * `direction` and M = `normal` of the plane it moves in; w z is `px` seen at p. */
dp_vec3 dp_paper_offset(const dp_view *view, dp_vec3 p, dp_vec3 e, dp_vec3 direction,
                        dp_vec3 normal, double px);

/* The quad that edge `edge` sweeps along `direction` in a plane with normal `normal`, by the
 * paper's formula, clipped. False: nothing is left. */
bool dp_paper_quad(const dp_primitive *p, uint32_t edge, dp_vec3 direction, dp_vec3 normal,
                   double px, dp_added *out);

/* A polygon in space, clipped to the frustum and to `reach` px around the projected edge. */
bool dp_paper_project(const dp_primitive *p, uint32_t edge, const dp_vec3 *points, uint32_t count,
                      double reach, dp_added *out);

/* False where nothing of the edge is seen. */
bool dp_screen_edge_make(const dp_primitive *p, uint32_t edge, dp_screen_edge *out);

/* All n edges at once; those of which nothing is seen get length 0. */
void dp_screen_edges_make(const dp_primitive *p, dp_screen_edge *out);

/* The same, looked up where the primitive brings its edges along and made in `room` where not.
 * NULL: nothing of the edge is seen. */
static inline const dp_screen_edge *dp_screen_edge_of(const dp_primitive *p, uint32_t edge,
                                                      dp_screen_edge *room) {
    if (p->edges) return p->edges[edge].length > 0 ? &p->edges[edge] : NULL;
    return dp_screen_edge_make(p, edge, room) ? room : NULL;
}

/* How a plane through the edge lies to the eye. */
typedef struct dp_lean {
    bool outward; /* on the screen it leads out of the polygon: the plane's front is seen */
    double slope; /* change of depth per px outward; infinite when the plane is seen edge-on */
} dp_lean;

/* The rectangle of `reach` px outside the edge, with a depth that changes by `slope` per px. */
void dp_screen_quad(const dp_screen_edge *edge, double reach, double slope, dp_added *out);

/* The plane of the quad at the pen's angle. */
dp_lean dp_quad_lean(const dp_screen_edge *edge, const dp_pen *pen);

/* The round joint between that rectangle and the next edge's, around the corner where `edge` ends,
 * in thin triangles. It is a cone: as far over the polygon's own plane as the quads at the pen's
 * angle are (silhouettes: `folded` is false, and it lies in the plane). Returns how many triangles;
 * none when the corner is clipped, the polygon seen edge-on or a quad seen from behind. */
uint32_t dp_screen_joint(const dp_primitive *p, uint32_t edge, const dp_pen *pen, double reach,
                         bool folded, dp_added *out);

#endif
