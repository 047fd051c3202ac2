/* drypoint/path.h: a camera's way through key views, for films.
 *
 * A path goes smoothly through views that are given with their times: eye and target by cubics
 * through all of them (Catmull-Rom's, for any distances between the times), the angle of view by
 * monotone cubics (Fritsch and Butland 1984), which do not swing beyond the keys. Where neighbouring
 * keys have the same eye, or target, it stands still between them.
 *
 *     {"views": [{"time": 0, "eye": [3, 2, 4], "target": [0, 0, 0], "fov": 35},
 *                {"time": 2, "eye": [-3, 2, 4], "target": [0, 0.5, 0], "fov": 20},
 *                {"time": 5, "eye": [3, 2, 4], "target": [0, 0, 0], "fov": 35}]}
 *
 * A path of three views or more whose last one is the first again is closed: it goes on smoothly
 * from there. */
#ifndef DRYPOINT_PATH_H
#define DRYPOINT_PATH_H

#include <drypoint/camera.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct dp_camera_path dp_camera_path;

/* Where a camera is at a time. Zero is the default where a default is named. */
typedef struct dp_key_view {
    double time;      /* s; ascending from view to view */
    double eye[3];    /* world space */
    double target[3]; /* world space; not the eye */
    double up[3];     /* any length; {0}: the path's `up` */
    double fov_y;     /* perspective: vertical, degrees in (0, 180); 0 means 35 */
    double height;    /* orthographic: of what is seen, world units, > 0; 0: perspective */
} dp_key_view;

/* Makes a path of views, in the order of their times, all in perspective or all orthographic. `up`:
 * what is up in views that do not say so; NULL means +y. The caller destroys *out.
 * DP_ERR_ARGUMENT (the diagnostic's `item` is the view's number), DP_ERR_LIMIT beyond a million,
 * DP_ERR_MEMORY. */
DP_API dp_result dp_camera_path_create(const dp_key_view *views, size_t count, const double up[3],
                                       const dp_allocator *allocator, dp_camera_path **out,
                                       dp_diag *diag);

/* Reads a path from JSON text, as above: an array of views, or an object with one as "views".
 * A view has "eye" and "target", and may have "time" (all have, or none: then they are a second
 * apart), "up", and "fov" or "height". Members of other names are mistakes. The caller destroys *out.
 * DP_ERR_FORMAT with the line, DP_ERR_MEMORY. */
DP_API dp_result dp_camera_path_read(const char *text, size_t size, const double up[3],
                                     const dp_allocator *allocator, dp_camera_path **out,
                                     dp_diag *diag);

/* Times of the first and the last view, s, and whether the path is closed. */
DP_API double dp_camera_path_begin(const dp_camera_path *path);
DP_API double dp_camera_path_end(const dp_camera_path *path);
DP_API bool dp_camera_path_closed(const dp_camera_path *path);

/* The view at a time. A closed path goes round and round; any other stands still before its first
 * view and after its last one. DP_ERR_ARGUMENT for a time that is not finite. */
DP_API dp_result dp_camera_path_view(const dp_camera_path *path, double time, dp_key_view *view);

/* The camera at a time: looks from eye to target, with `up` made perpendicular to that, and with
 * near and far around the box min, max (dp_extent). aspect: width / height of the picture; 0 means
 * 4/3. DP_ERR_ARGUMENT for a time that is not finite, or at which the eye meets its target. */
DP_API dp_result dp_camera_path_at(const dp_camera_path *path, double time, double aspect,
                                   const float min[3], const float max[3], dp_camera *camera,
                                   dp_diag *diag);

/* NULL allowed. */
DP_API void dp_camera_path_destroy(dp_camera_path *path);

#ifdef __cplusplus
}
#endif
#endif
