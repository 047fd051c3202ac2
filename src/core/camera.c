/* Cameras: look-at and projections; matrices as in OpenGL. */
#include "core/camera.h"

#include "base/elementary.h"

#include <string.h>

static const double PI = 3.14159265358979323846;

static bool finite3(const double v[3]) {
    return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]);
}

dp_vec3 dp_usable_up(dp_vec3 forward, dp_vec3 up) {
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
    const dp_vec3 r = dp_unit(dp_cross(f, dp_usable_up(f, dp_v3(up[0], up[1], up[2]))));
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

/* Turns v by the shortest rotation that takes +y to `up`: with w = y × up and c = y · up,
 * v + w × v + w × (w × v) / (1 + c). */
static void turn(const double up[3], const double v[3], double out[3]) {
    const double w[3] = {up[2], 0, -up[0]}, c = up[1];
    if (c < -1 + 1e-12) { /* half a turn about x */
        out[0] = v[0], out[1] = -v[1], out[2] = -v[2];
        return;
    }
    const double once[3] = {-w[2] * v[1], w[2] * v[0] - w[0] * v[2], w[0] * v[1]};
    const double twice[3] = {-w[2] * once[1], w[2] * once[0] - w[0] * once[2], w[0] * once[1]};
    for (int k = 0; k < 3; k++) out[k] = v[k] + once[k] + twice[k] / (1 + c);
}

dp_result dp_camera_sides(const double up[3], double right[3], double front[3]) {
    static const double x[3] = {1, 0, 0}, z[3] = {0, 0, 1};
    if (!up || !right || !front || !finite3(up)) return DP_ERR_ARGUMENT;
    const double length = sqrt(up[0] * up[0] + up[1] * up[1] + up[2] * up[2]);
    if (!isfinite(length)) return DP_ERR_ARGUMENT;
    double unit[3] = {0, 1, 0};
    for (int k = 0; k < 3 && length > 0; k++) unit[k] = up[k] / length;
    turn(unit, x, right);
    turn(unit, z, front);
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
