/* drypoint/camera.h: view and projection, in OpenGL's conventions.
 *
 * Matrices are column-major, multiply column vectors, and use a right-handed camera space that
 * looks along -z. The projection maps to clip space with -w <= x, y, z <= w.
 *
 * These calls, but for dp_camera_fit_source, fail for one reason only, an argument out of the range
 * that is given at each, and so fill no dp_diag. After a failure the camera is not to be used. */
#ifndef DRYPOINT_CAMERA_H
#define DRYPOINT_CAMERA_H

#include <drypoint/source.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct dp_camera {
    double view[16];       /* world to camera space: rotation, translation, uniform scale */
    double projection[16]; /* camera to clip space: perspective or orthographic */
} dp_camera;

/* Sets `view`: from eye to target, both in world space. `up` need not be perpendicular to the line
 * of sight; if it is parallel, another one is chosen. DP_ERR_ARGUMENT if eye == target. */
DP_API dp_result dp_camera_look_at(dp_camera *camera, const double eye[3], const double target[3],
                                   const double up[3]);

/* Sets `projection`. fov_y: vertical, degrees in (0, 180); aspect: width / height of the picture;
 * 0 < near < far: distances along the line of sight. DP_ERR_ARGUMENT. */
DP_API dp_result dp_camera_perspective(dp_camera *camera, double fov_y, double aspect,
                                       double near_z, double far_z);

/* The same, orthographic. height: of what is seen, world units, > 0; near may be negative (behind
 * the eye). */
DP_API dp_result dp_camera_orthographic(dp_camera *camera, double height, double aspect,
                                        double near_z, double far_z);

/* How a camera sees a whole box, or all that is drawn of a source. Zero is the default. */
typedef struct dp_fit {
    float min[3], max[3]; /* the box, world space, as from dp_source_extent */
    double direction[3];  /* towards the eye; {0} means (1, 0.6, 1) */
    double up[3];         /* {0} means +y, or -z / +z when looking down or up along y */
    double fov_y;         /* degrees; 0 means 35 */
    bool orthographic;
    double height; /* orthographic: what is seen, world units; 0 means fitted */
    double aspect; /* width / height of the picture; 0 means 4/3 */
    double zoom;   /* 0 means 1; 2 shows everything twice as large */
    bool steady;   /* fit the box's sphere: the same size from every direction */
    /* The box where float32 is too coarse for it (dp_extent.exact_min); all 0: min and max. */
    double exact_min[3], exact_max[3];
} dp_fit;

/* Sets the camera so that the box fills the picture, with a margin of 4 % on the narrower side, and
 * near and far enclose the box. With `steady`, the eye's distance from the box's centre is half the
 * box's diagonal / sin(fov / 2), with fov the smaller of the vertical and the horizontal one.
 * DP_ERR_ARGUMENT for values out of range, for a box with min above max (that of a source without
 * polygons) or with coordinates that are not finite. */
DP_API dp_result dp_camera_fit(dp_camera *camera, const dp_fit *fit);

/* Sets the camera so that what is drawn of a source fills the picture, in one reading of it from its
 * start to its end; in two where the picture's angle is wider than 80 degrees. On the axis that is filled, both margins are 4 % of half the picture; on the
 * other one, the model is in the middle. Near and far enclose it. Corners count that polygons with an
 * area use; those with a coordinate that is not finite, or an index out of range, do not. The eye
 * comes no nearer than a thousandth of the model's size, also where only an eye inside would fill
 * the picture (wide angles).
 *
 * What the fit leaves out is the source's: up is dp_source_up, and the direction (1, 0.6, 1) turns
 * with it (dp_camera_sides). The fit's box, unless all of it is 0, is seen as well: a mirror, say.
 * With `steady`, the source's box is fitted as dp_camera_fit does. fit NULL: all defaults.
 *
 * *extent, unless NULL, becomes what dp_source_extent would find, also where the fit fails then.
 * DP_ERR_ARGUMENT as for dp_camera_fit, also for a source without polygons; else the source's
 * errors. The source is left at its start, or at its end if it can be read only once. */
DP_API dp_result dp_camera_fit_source(dp_camera *camera, const dp_fit *fit, dp_source *source,
                                      dp_extent *extent, dp_diag *diag);

/* The right and the front side of a model that stands on `up`, as unit vectors: +x and +z turned by
 * the shortest rotation that takes +y to `up`, and half a turn about x for -y. With z up, front is -y
 * and right is +x, as in CAD. up {0} means +y. DP_ERR_ARGUMENT if it is not finite. */
DP_API dp_result dp_camera_sides(const double up[3], double right[3], double front[3]);

/* Near and far for a box: far encloses it; near is as large as the box allows, and at least 1e-4 of
 * far, also for a box around the eye. camera->view must be set. */
DP_API void dp_camera_near_far(const dp_camera *camera, const float min[3], const float max[3],
                               double *near_z, double *far_z);

#ifdef __cplusplus
}
#endif
#endif
