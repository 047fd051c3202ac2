/* The camera resolved for one picture: world space to pixels and depth.
 *
 *    screen space   x right, y down, px; pixel (i, j) covers [i, i + 1) × [j, j + 1)
 *    distance       along the line of sight, world units
 *    depth d        1 / distance in perspective, -distance in orthographic views
 *
 * Invariant: d is affine in screen x and y on every plane, and larger when nearer. */
#ifndef DP_CORE_VIEW_H
#define DP_CORE_VIEW_H

#include "base/vec.h"
#include <drypoint/camera.h>
#include <float.h>

/* Further away than anything. */
#define DP_DEPTH_EMPTY (-FLT_MAX)

typedef struct dp_view {
    bool perspective;
    double width, height; /* px */
    double clip[4][4]; /* rows x, y, z, w: world to clip space; in perspective, w is the distance */
    double sight[4];   /* row: world space to distance */
    dp_vec3 eye, forward; /* world space; forward: unit, the camera axis C of (Raskar 2001, 2.1) */
    double focal;         /* perspective: px per unit at distance 1; orthographic: px per unit */
    dp_vec3 corner;       /* world space: the screen's point (0, 0) at d = 1 */
    dp_vec3 across, down; /* its change per px of x and y, at d = 1 */
    dp_vec3 inverse[3];   /* columns of the inverse of rows x, y and sight, times `determinant` */
    double determinant;
    double guard; /* vertices further from the axis than guard * w are clipped */
} dp_view;

/* A point on the screen. */
typedef struct dp_point {
    float x, y, d;
} dp_point;

typedef struct dp_pointd {
    double x, y, d;
} dp_pointd;

/* A point in clip space, and its distance. */
typedef struct dp_clip_point {
    double x, y, z, w, distance;
} dp_clip_point;

/* The camera as it sees positions counted from an origin in world space. */
dp_camera dp_camera_about(const dp_camera *camera, const double origin[3]);

/* DP_ERR_ARGUMENT if the matrices are singular, not finite, or not a view and a perspective or
 * orthographic projection. */
dp_result dp_view_init(dp_view *view, const dp_camera *camera, uint32_t width, uint32_t height,
                       dp_diag *diag);

static inline dp_clip_point dp_to_clip(const dp_view *view, dp_vec3 p) {
    const double(*m)[4] = view->clip;
    const double *s = view->sight;
    return (dp_clip_point){m[0][0] * p.x + m[0][1] * p.y + m[0][2] * p.z + m[0][3],
                           m[1][0] * p.x + m[1][1] * p.y + m[1][2] * p.z + m[1][3],
                           m[2][0] * p.x + m[2][1] * p.y + m[2][2] * p.z + m[2][3],
                           m[3][0] * p.x + m[3][1] * p.y + m[3][2] * p.z + m[3][3],
                           s[0] * p.x + s[1] * p.y + s[2] * p.z + s[3]};
}

/* Requires w > 0. */
static inline dp_pointd dp_to_screen(const dp_view *view, dp_clip_point c) {
    const double inverse = 1 / c.w;
    return (dp_pointd){(c.x * inverse * 0.5 + 0.5) * view->width,
                       (0.5 - c.y * inverse * 0.5) * view->height,
                       view->perspective ? inverse : -c.distance};
}

/* World length of one pixel at depth d, seen face on: the pixel size. */
static inline double dp_pixel_size(const dp_view *view, double d) {
    return view->perspective ? 1 / (d * view->focal) : 1 / view->focal;
}

/* Change of depth d over `px` pixel sizes along the line of sight, at depth d. */
static inline double dp_depth_step(const dp_view *view, double d, double px) {
    return view->perspective ? px * d / view->focal : px / view->focal;
}

/* Distance of depth d, world units. */
static inline double dp_distance(const dp_view *view, double d) {
    return view->perspective ? 1 / d : -d;
}

/* Unit vector from the eye to p, or along the line of sight if orthographic: V of (Raskar 2001,
 * 2.1). */
static inline dp_vec3 dp_view_vector(const dp_view *view, dp_vec3 p) {
    return view->perspective ? dp_unit(dp_sub(p, view->eye)) : view->forward;
}

/* The world point at (x, y, d) on the screen. */
dp_vec3 dp_unproject(const dp_view *view, dp_pointd p);

/* Clipping ------------------------------------------------------------------------------------- */

enum {
    DP_CLIP_NEAR = 1,
    DP_CLIP_FAR = 2,
    DP_CLIP_LEFT = 4,
    DP_CLIP_RIGHT = 8,
    DP_CLIP_BOTTOM = 16,
    DP_CLIP_TOP = 32
};

/* A bit for each plane of the (guarded) frustum that the point is outside of. */
static inline int dp_outcode(const dp_view *view, dp_clip_point c) {
    const double g = view->guard * c.w;
    return (c.z < -c.w || !(c.w > 0) ? DP_CLIP_NEAR : 0) | (c.z > c.w ? DP_CLIP_FAR : 0) |
           (c.x < -g ? DP_CLIP_LEFT : 0) | (c.x > g ? DP_CLIP_RIGHT : 0) |
           (c.y < -g ? DP_CLIP_BOTTOM : 0) | (c.y > g ? DP_CLIP_TOP : 0);
}

/* Clips a convex polygon of n points in place against the planes in `codes`. `points` and `scratch`
 * have room for n + 6. Returns the number of points left: 0 or at least 3. */
uint32_t dp_clip_polygon(const dp_view *view, int codes, dp_clip_point *points, uint32_t n,
                         dp_clip_point *scratch);

/* Clips the segment from a to b to [*t0, *t1] of [0, 1] in clip space. False: nothing is left. */
bool dp_clip_segment(const dp_view *view, dp_clip_point a, dp_clip_point b, double *t0, double *t1);

static inline dp_clip_point dp_clip_mix(dp_clip_point a, dp_clip_point b, double t) {
    return (dp_clip_point){a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.z + (b.z - a.z) * t,
                           a.w + (b.w - a.w) * t, a.distance + (b.distance - a.distance) * t};
}

#endif
