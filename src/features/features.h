/* Primitive shaders (Raskar 2001, Figure 2): from one polygon and the view to added polygons.
 *
 * They stand between primitive assembly and rasterization and know nothing of any other polygon. Each
 * looks at one edge at a time, keeps nothing and allocates nothing. For an edge from P_i to P_j of a
 * polygon with normal N: E = unit(P_j - P_i), O = E x N points out of the polygon, in its plane.
 *
 *   silhouette   back-facing polygons: a fin along O, in the polygon's own plane
 *   ridge        front-facing polygons: a quad along Q(theta), with normal R(theta)
 *   valley       the same with phi; it is to be tested against what has been drawn (quads.c)
 *   intersection no added polygon: the polygon itself is tested so (intersection.c)
 *
 *   Q = -N sin(angle) - O cos(angle)      R = -N cos(angle) + O sin(angle)      (2.2)
 *
 * DP_METHOD_PAPER moves the ends of the edge in space, as printed; DP_METHOD_EXACT builds the polygon on
 * the screen, where widths are exact, and takes only its depth from the plane in space. */
#ifndef DP_FEATURES_FEATURES_H
#define DP_FEATURES_FEATURES_H

#include "mesh/polygons.h"
#include "pipe/view.h"
#include <drypoint/style.h>

/* A polygon as primitive assembly hands it over. */
typedef struct dp_primitive {
    const dp_view *view;
    uint32_t n;
    const dp_vec3 *world;       /* [n] corners */
    const dp_clip_point *clip;  /* [n] the same in clip space */
    const uint8_t *edge_flags;  /* [n]; NULL: every edge draws */
    dp_vec3 normal;             /* unit, as wound */
    bool front;                 /* edge-on counts as back-facing */
} dp_primitive;

/* What is to be drawn. */
typedef struct dp_pen {
    dp_method method;
    double reach; /* px, how far added polygons reach over the edge */
    double angle; /* degrees: theta or phi */
} dp_pen;

enum {
    DP_ADDED_POINTS = 16, /* 4 corners + 6 planes of the frustum + 3 sides of the reach, rounded up */
    DP_ADDED_MOST = 8     /* per edge and class */
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
typedef uint32_t dp_primitive_shader(const dp_primitive *primitive, uint32_t edge, const dp_pen *pen,
                                     dp_added out[DP_ADDED_MOST]);
dp_primitive_shader dp_shade_silhouette;
dp_primitive_shader dp_shade_ridge;
dp_primitive_shader dp_shade_valley;

/* Two polygons whose corners have a position in common meet there by construction and do not count as
 * intersecting, although their planes cross. */
bool dp_polygons_touch(const dp_polygons *polygons, uint32_t a, uint32_t b);

/* The between-test of planes: `gap` is how far a fragment lies behind the surface (depth d, > 0), `gx`
 * and `gy` the difference of the two planes' gradients. True when they cross within `reach` px. */
static inline bool dp_planes_cross_within(float gap, float gx, float gy, float reach) {
    return gap * gap <= (gx * gx + gy * gy) * reach * reach;
}

/* What the shaders are made of ---------------------------------------------------------------- */

/* A paper method's polygon reaches no further than this many times the pen's reach. */
#define DP_PAPER_REACH 1.5
/* |V·N| and |V·R| count as no less than this, so that the paper's quotients stay finite: a polygon seen
 * at less than 1.8 degrees grows by no more than 32 widths in space, and its line gets thinner. */
#define DP_PAPER_GRAZING (1.0 / 32)
/* An added polygon comes nearer by no more than this many pixel sizes per px away from its edge. */
#define DP_STEEPEST 4.0

static inline dp_vec3 dp_edge_direction(const dp_primitive *p, uint32_t edge) {
    return dp_unit(dp_sub(p->world[edge + 1 == p->n ? 0 : edge + 1], p->world[edge]));
}

/* The paper's Q and R for edge direction e, normal n, and an angle in degrees. */
dp_vec3 dp_quad_direction(dp_vec3 e, dp_vec3 n, double degrees);
dp_vec3 dp_quad_normal(dp_vec3 e, dp_vec3 n, double degrees);

/* P_k + w D [z sin(alpha) (V·C) / (V·M)] for the corner at p of an edge along e, with D = `direction` and
 * M = `normal` of the plane it moves in; w z is `px` seen at p. */
dp_vec3 dp_paper_offset(const dp_view *view, dp_vec3 p, dp_vec3 e, dp_vec3 direction, dp_vec3 normal,
                        double px);

/* The quad that edge `edge` sweeps along `direction` in a plane with normal `normal`, by the paper's
 * formula, clipped. False: nothing is left. */
bool dp_paper_quad(const dp_primitive *p, uint32_t edge, dp_vec3 direction, dp_vec3 normal, double px,
                   dp_added *out);

/* A polygon in space, clipped to the frustum and to `reach` px around the projected edge. */
bool dp_paper_project(const dp_primitive *p, uint32_t edge, const dp_vec3 *points, uint32_t count,
                      double reach, dp_added *out);

/* An edge on the screen, clipped to the guarded frustum. */
typedef struct dp_screen_edge {
    dp_pointd a, b;
    dp_clip_point middle;
    double length;  /* px */
    double tx, ty;  /* along, unit */
    double nx, ny;  /* out of the polygon, unit */
    double along;   /* change of depth per px along */
    double steep;   /* change of depth per px at DP_STEEPEST */
} dp_screen_edge;
bool dp_screen_edge_make(const dp_primitive *p, uint32_t edge, dp_screen_edge *out);

/* How the plane through the edge along `direction` (unit, world) lies to the eye. */
typedef struct dp_lean {
    bool outward; /* on the screen the direction leads out of the polygon: the plane's front is seen */
    double slope; /* change of depth per px outward; infinite when the plane is seen edge-on */
} dp_lean;
dp_lean dp_lean_of(const dp_view *view, const dp_screen_edge *edge, dp_vec3 direction);

/* The rectangle of `reach` px outside the edge, with a depth that changes by `slope` per px. */
void dp_screen_quad(const dp_screen_edge *edge, double reach, double slope, dp_added *out);

/* How much the quad of an edge at an angle (degrees) rises over the polygon's own plane, depth per px; NaN
 * where it faces away. */
double dp_screen_rise(const dp_primitive *p, uint32_t edge, double degrees);

/* The round joint between that rectangle and the next edge's, around the corner where `edge` ends, in thin
 * triangles: their outer corners lie `reach` px away, `rise` per px over the polygon's own plane (from
 * rise[0] on this edge's side to rise[1] on the next one's). Returns how many; none when the corner is
 * clipped or the polygon seen edge-on. */
uint32_t dp_screen_joint(const dp_primitive *p, uint32_t edge, const dp_screen_edge *on_screen, double reach,
                         const double rise[2], dp_added *out);

#endif
