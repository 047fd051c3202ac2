/* Cameras: look-at, projections, and fitting a box into the picture; matrices as in OpenGL.
 *
 * A box fits if all eight corners lie inside the picture's half angles. Each axis gives linear
 * constraints on distance and shift, so the least distance follows directly, without iteration. */
#include <drypoint/camera.h>

#include "base/elementary.h"
#include "base/vec.h"

#include <string.h>

static const double PI = 3.14159265358979323846;

static bool finite3(const double v[3]) {
    return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]);
}

/* An axis that is not nearly parallel to `forward`; y first, since most models stand on y. */
static dp_vec3 usable_up(dp_vec3 forward, dp_vec3 up) {
    const dp_vec3 choices[3] = {up, {0, 0, forward.y > 0 ? 1 : -1}, {0, 1, 0}};
    for (int i = 0; i < 3; i++)
        if (dp_length(dp_cross(forward, dp_unit(choices[i]))) > 1e-6) return choices[i];
    return dp_v3(1, 0, 0);
}

dp_result dp_camera_look_at(dp_camera *camera, const double eye[3], const double target[3],
                            const double up[3]) {
    if (!camera || !eye || !target || !up || !finite3(eye) || !finite3(target) || !finite3(up))
        return DP_ERR_ARGUMENT;
    const dp_vec3 from = dp_v3(eye[0], eye[1], eye[2]);
    const dp_vec3 line = dp_sub(dp_v3(target[0], target[1], target[2]), from);
    if (!(dp_length(line) > 0)) return DP_ERR_ARGUMENT;
    const dp_vec3 f = dp_unit(line);
    const dp_vec3 r = dp_unit(dp_cross(f, usable_up(f, dp_v3(up[0], up[1], up[2]))));
    const dp_vec3 u = dp_cross(r, f);
    const double view[16] = {r.x,
                             u.x,
                             -f.x,
                             0,
                             r.y,
                             u.y,
                             -f.y,
                             0,
                             r.z,
                             u.z,
                             -f.z,
                             0,
                             -dp_dot(r, from),
                             -dp_dot(u, from),
                             dp_dot(f, from),
                             1};
    memcpy(camera->view, view, sizeof view);
    return DP_OK;
}

dp_result dp_camera_perspective(dp_camera *camera, double fov_y, double aspect, double near_z,
                                double far_z) {
    if (!camera || !(fov_y > 0 && fov_y < 180) || !(aspect > 0) || !(near_z > 0) ||
        !(far_z > near_z) || !isfinite(far_z) || !isfinite(aspect))
        return DP_ERR_ARGUMENT;
    const double f = 1 / dp_tan(fov_y * PI / 360);
    const double m[16] = {f / aspect,
                          0,
                          0,
                          0,
                          0,
                          f,
                          0,
                          0,
                          0,
                          0,
                          -(far_z + near_z) / (far_z - near_z),
                          -1,
                          0,
                          0,
                          -2 * far_z * near_z / (far_z - near_z),
                          0};
    memcpy(camera->projection, m, sizeof m);
    return DP_OK;
}

dp_result dp_camera_orthographic(dp_camera *camera, double height, double aspect, double near_z,
                                 double far_z) {
    if (!camera || !(height > 0) || !isfinite(height) || !(aspect > 0) || !isfinite(aspect) ||
        !(far_z > near_z) || !isfinite(far_z - near_z))
        return DP_ERR_ARGUMENT;
    const double depth = far_z - near_z;
    const double m[16] = {
        2 / (height * aspect),     0, 0, 0, 0, 2 / height, 0, 0, 0, 0, -2 / depth, 0, 0, 0,
        -(far_z + near_z) / depth, 1};
    memcpy(camera->projection, m, sizeof m);
    return DP_OK;
}

/* Distance of a point along the line of sight; positive in front of the eye. */
static double distance_along(const dp_camera *camera, double x, double y, double z) {
    const double *const v = camera->view;
    return -(v[2] * x + v[6] * y + v[10] * z + v[14]);
}

void dp_camera_near_far(const dp_camera *camera, const float min[3], const float max[3],
                        double *near_z, double *far_z) {
    double lo = INFINITY, hi = -INFINITY;
    for (int i = 0; i < 8; i++) {
        const double d = distance_along(camera, i & 1 ? max[0] : min[0], i & 2 ? max[1] : min[1],
                                        i & 4 ? max[2] : min[2]);
        lo = dp_min(lo, d);
        hi = dp_max(hi, d);
    }
    if (!(hi > 0)) hi = 1; /* everything is behind the eye: any range draws nothing */
    *far_z = hi * 1.01;
    *near_z = dp_max(lo * 0.99, *far_z * 1e-4);
    if (*near_z >= *far_z) *near_z = *far_z * 0.5;
}

static dp_vec3 or_default(const double v[3], dp_vec3 other) {
    const dp_vec3 given = dp_v3(v[0], v[1], v[2]);
    return dp_length(given) > 0 ? given : other;
}

/* The box's eight corners relative to its centre, along the camera's axes; and the tangents of half
 * the picture's angles. */
typedef struct framing {
    dp_vec3 corner[8]; /* right, up, away from the eye */
    double tan_x, tan_y;
} framing;

/* Share of the picture's half width or height that stays free. */
static const double MARGIN = 0.04;

/* Along one axis, all corners are seen if shift + tan * distance >= *a and -shift + tan * distance
 * >= *b. */
static void constrain(const framing *f, bool vertical, double tangent, double *a, double *b) {
    *a = *b = -INFINITY;
    for (int i = 0; i < 8; i++) {
        const double x = vertical ? f->corner[i].y : f->corner[i].x, z = f->corner[i].z;
        *a = dp_max(*a, x - tangent * z);
        *b = dp_max(*b, -x - tangent * z);
    }
}

/* The least distance from which the whole box is seen, and how far the camera's axis then passes
 * beside its centre. */
static double frame_perspective(const framing *f, double shift[2]) {
    double ax, bx, ay, by, nearest = 0;
    constrain(f, false, f->tan_x * (1 - MARGIN), &ax, &bx);
    constrain(f, true, f->tan_y * (1 - MARGIN), &ay, &by);
    for (int i = 0; i < 8; i++) nearest = dp_max(nearest, -f->corner[i].z);
    shift[0] = (ax - bx) / 2, shift[1] = (ay - by) / 2;
    const double distance =
        dp_max((ax + bx) / 2 / f->tan_x, (ay + by) / 2 / f->tan_y) / (1 - MARGIN);
    return dp_max(distance, nearest * 1.001);
}

/* The least height of the view in which the whole box is seen. */
static double frame_orthographic(const framing *f, double aspect, double shift[2]) {
    double ax, bx, ay, by;
    constrain(f, false, 0, &ax, &bx);
    constrain(f, true, 0, &ay, &by);
    shift[0] = (ax - bx) / 2, shift[1] = (ay - by) / 2;
    return dp_max(ay + by, (ax + bx) / aspect) / (1 - MARGIN);
}

static framing framing_of(dp_vec3 min, dp_vec3 max, dp_vec3 forward, dp_vec3 up) {
    framing f;
    const dp_vec3 right = dp_unit(dp_cross(forward, usable_up(forward, up))),
                  upward = dp_cross(right, forward);
    const dp_vec3 half = dp_scale(dp_sub(max, min), 0.5);
    for (int i = 0; i < 8; i++) {
        const dp_vec3 c =
            dp_v3(i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 4 ? half.z : -half.z);
        f.corner[i] = dp_v3(dp_dot(c, right), dp_dot(c, upward), dp_dot(c, forward));
    }
    return f;
}

typedef struct fitted {
    dp_vec3 centre, forward, up;
    double distance, height, shift[2];
} fitted;

static dp_result look(dp_camera *camera, const fitted *f) {
    const dp_vec3 right = dp_unit(dp_cross(f->forward, usable_up(f->forward, f->up)));
    const dp_vec3 upward = dp_cross(right, f->forward);
    const dp_vec3 at = dp_mad(dp_mad(f->centre, right, f->shift[0]), upward, f->shift[1]);
    const dp_vec3 eye = dp_mad(at, f->forward, -f->distance);
    return dp_camera_look_at(camera, (const double[3]){eye.x, eye.y, eye.z},
                             (const double[3]){at.x, at.y, at.z},
                             (const double[3]){f->up.x, f->up.y, f->up.z});
}

/* The box: exact_min and exact_max, or, where those are 0, min and max. */
static void box_of(const dp_fit *fit, dp_vec3 *min, dp_vec3 *max) {
    const double *const a = fit->exact_min, *const b = fit->exact_max;
    const bool exact = a[0] != 0 || a[1] != 0 || a[2] != 0 || b[0] != 0 || b[1] != 0 || b[2] != 0;
    *min = exact ? dp_v3(a[0], a[1], a[2]) : dp_v3f(fit->min);
    *max = exact ? dp_v3(b[0], b[1], b[2]) : dp_v3f(fit->max);
}

dp_result dp_camera_fit(dp_camera *camera, const dp_fit *fit) {
    if (!camera || !fit || !finite3(fit->direction) || !finite3(fit->up)) return DP_ERR_ARGUMENT;
    dp_vec3 min, max;
    box_of(fit, &min, &max);
    double radius = dp_length(dp_sub(max, min)) / 2;
    if (!isfinite(radius) || min.x > max.x || min.y > max.y || min.z > max.z)
        return DP_ERR_ARGUMENT; /* also the extent of a source without polygons */
    if (!(radius > 0)) radius = 1;
    const double fov = fit->fov_y != 0 ? fit->fov_y : 35;
    const double aspect = fit->aspect != 0 ? fit->aspect : 4.0 / 3.0;
    const double zoom = fit->zoom != 0 ? fit->zoom : 1;
    if (!(fov > 0 && fov < 180) || !(aspect > 0) || !(zoom > 0)) return DP_ERR_ARGUMENT;

    const double half_y = fov * PI / 360, half = dp_min(half_y, dp_atan(dp_tan(half_y) * aspect));
    fitted f = {.centre = dp_scale(dp_add(min, max), 0.5),
                .forward = dp_scale(dp_unit(or_default(fit->direction, dp_v3(1, 0.6, 1))), -1),
                .up = or_default(fit->up, dp_v3(0, 1, 0)),
                .distance = radius / dp_sin(half),
                .height = 2 * radius / dp_min(1, aspect)};
    framing frame = framing_of(min, max, f.forward, f.up);
    frame.tan_x = dp_tan(half_y) * aspect, frame.tan_y = dp_tan(half_y);
    const bool flat = !(dp_length(dp_sub(max, min)) > 0); /* a point cannot fill the picture */
    if (!fit->steady && !flat && fit->orthographic)
        f.height = frame_orthographic(&frame, aspect, f.shift);
    else if (!fit->steady && !flat)
        f.distance = frame_perspective(&frame, f.shift);
    if (fit->height > 0) f.height = fit->height;
    const dp_result result = look(camera, &f);
    if (result) return result;

    const double far_z = f.distance + 1.01 * radius, near_z = f.distance - 1.01 * radius;
    if (fit->orthographic)
        return dp_camera_orthographic(camera, f.height / zoom, aspect, near_z, far_z);
    /* Zoom narrows the field of view and does not move the eye, so the perspective stays. */
    const double zoomed = 2 * dp_atan(dp_tan(half_y) / zoom) * 180 / PI;
    return dp_camera_perspective(camera, zoomed, aspect, dp_max(near_z, 1e-4 * f.distance), far_z);
}
