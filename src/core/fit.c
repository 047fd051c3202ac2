/* Cameras that show all of a box, or all that is drawn of a source.
 *
 * A point (x, y, z), in the camera's axes, is seen by an eye at e if it lies inside the picture's
 * half angles: x - e.x <= t (e.z - z), and so on. So a box or a model is seen if, with
 * a = max (x + t z) and b = max (-x + t z), a <= e.x + t e.z and b <= -e.x + t e.z: the least e.z is
 * (a + b) / 2 t, and e.x then (a - b) / 2. The axis that needs the larger e.z, of x and y, has
 * exactly the margin on both sides.
 *
 * On the other axis there is room. The picture is in its middle there when some smaller t closes on
 * both sides: a(t) + b(t) = 2 t e.z. Both are convex, known for a row of slopes (mesh/reach.h), and
 * taken as linear between two of them: never too small, and too large by a few hundred-thousandths
 * of the model's size at most. Where the eye comes so near that this is seen, in wide views, the
 * source is read once more for slopes between those two. A box has eight corners only and takes the
 * plane's own slope. */
#include "core/camera.h"

#include "base/diag.h"
#include "base/elementary.h"
#include "mesh/reach.h"

#include <string.h>

static const double PI = 3.14159265358979323846;

/* Share of the picture's half width or height that stays free. */
static const double MARGIN = 0.04;

static bool finite3(const double v[3]) {
    return isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]);
}

/* A fit's numbers, with defaults. */
typedef struct numbers {
    double half_y;       /* radians: half the vertical field of view */
    double tan_x, tan_y; /* of half the fields of view */
    double aspect, zoom;
} numbers;

static bool resolve(const dp_fit *fit, numbers *n) {
    const double fov = fit->fov_y != 0 ? fit->fov_y : 35;
    *n = (numbers){.half_y = fov * PI / 360,
                   .aspect = fit->aspect != 0 ? fit->aspect : 4.0 / 3.0,
                   .zoom = fit->zoom != 0 ? fit->zoom : 1};
    n->tan_y = dp_tan(n->half_y), n->tan_x = n->tan_y * n->aspect;
    return fov > 0 && fov < 180 && n->aspect > 0 && isfinite(n->aspect) && n->zoom > 0 &&
           finite3(fit->direction) && finite3(fit->up);
}

/* Zoom narrows the field of view and does not move the eye, so the perspective stays. */
static double zoomed_fov(const numbers *n) { return 2 * dp_atan(n->tan_y / n->zoom) * 180 / PI; }

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
    const dp_vec3 right = dp_unit(dp_cross(forward, dp_usable_up(forward, up))),
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
    const dp_vec3 right = dp_unit(dp_cross(f->forward, dp_usable_up(f->forward, f->up)));
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
    numbers n;
    dp_vec3 min, max;
    if (!camera || !fit || !resolve(fit, &n)) return DP_ERR_ARGUMENT;
    box_of(fit, &min, &max);
    double radius = dp_length(dp_sub(max, min)) / 2;
    if (!isfinite(radius) || min.x > max.x || min.y > max.y || min.z > max.z)
        return DP_ERR_ARGUMENT; /* also the extent of a source without polygons */
    if (!(radius > 0)) radius = 1;
    const double half = dp_min(n.half_y, dp_atan(n.tan_x));
    fitted f = {.centre = dp_scale(dp_add(min, max), 0.5),
                .forward = dp_scale(dp_unit(or_default(fit->direction, dp_v3(1, 0.6, 1))), -1),
                .up = or_default(fit->up, dp_v3(0, 1, 0)),
                .distance = radius / dp_sin(half),
                .height = 2 * radius / dp_min(1, n.aspect)};
    framing frame = framing_of(min, max, f.forward, f.up);
    frame.tan_x = n.tan_x, frame.tan_y = n.tan_y;
    const bool flat = !(dp_length(dp_sub(max, min)) > 0); /* a point cannot fill the picture */
    if (!fit->steady && !flat && fit->orthographic)
        f.height = frame_orthographic(&frame, n.aspect, f.shift);
    else if (!fit->steady && !flat)
        f.distance = frame_perspective(&frame, f.shift);
    if (fit->height > 0) f.height = fit->height;
    const dp_result result = look(camera, &f);
    if (result) return result;

    const double far_z = f.distance + 1.01 * radius, near_z = f.distance - 1.01 * radius;
    if (fit->orthographic)
        return dp_camera_orthographic(camera, f.height / n.zoom, n.aspect, near_z, far_z);
    return dp_camera_perspective(camera, zoomed_fov(&n), n.aspect,
                                 dp_max(near_z, 1e-4 * f.distance), far_z);
}

/* ---- what is drawn of a source ---- */

/* Nearest to the eye that a model comes, in its depths: beyond that, near planes would cut it. */
static const double CLEARANCE = 1e-3;

/* The view's axes: right, up, towards the eye. */
static dp_result find_axes(const dp_fit *fit, const dp_source *source, double axis[3][3]) {
    static const double centre[3] = {0};
    double up[3], right[3], front[3], d[3];
    dp_camera camera;
    memcpy(up, fit->up, sizeof up);
    if (up[0] == 0 && up[1] == 0 && up[2] == 0) dp_source_up(source, up);
    memcpy(d, fit->direction, sizeof d);
    if (d[0] == 0 && d[1] == 0 && d[2] == 0) {
        const dp_result wrong = dp_camera_sides(up, right, front);
        if (wrong) return wrong;
        const double length = dp_length(dp_v3(up[0], up[1], up[2]));
        for (int k = 0; k < 3; k++) d[k] = right[k] + 0.6 * up[k] / length + front[k];
    }
    const dp_result wrong = dp_camera_look_at(&camera, d, centre, up);
    for (int k = 0; k < 3 && !wrong; k++)
        for (int i = 0; i < 3; i++) axis[k][i] = camera.view[4 * i + k];
    return wrong;
}

/* By how much the model, between this side and the next, is wider than what an eye at that z sees of it
 * between planes of slope j. */
static double overlap(const dp_reach *reach, int side, int j, double eye_z) {
    return reach->most[side][j] + reach->most[side + 1][j] - 2 * reach->slope[side / 2][j] * eye_z;
}

/* The first slope, but for number 0, at which an eye at that z sees the model. */
static int closing(const dp_reach *reach, int side, double eye_z) {
    int j = 1;
    while (j < DP_REACH_SLOPES - 1 && overlap(reach, side, j, eye_z) > 0) j++;
    return j;
}

/* Where the middle of what an eye at that z sees lies, across, between this side and the next. */
static double middle(const dp_reach *reach, int side, double eye_z) {
    const double *const a = reach->most[side], *const b = reach->most[side + 1];
    const int j = closing(reach, side, eye_z);
    const double before = overlap(reach, side, j - 1, eye_z),
                 after = dp_min(overlap(reach, side, j, eye_z), 0);
    const double share = before > 0 ? before / (before - after) : 0;
    return (a[j - 1] - b[j - 1] + share * (a[j] - b[j] - (a[j - 1] - b[j - 1]))) / 2;
}

/* The least z of an eye that sees the model between this side and the next. */
static double least_z(const dp_reach *reach, int side) {
    const int last = DP_REACH_SLOPES - 1;
    return (reach->most[side][last] + reach->most[side + 1][last]) /
           (2 * reach->slope[side / 2][last]);
}

/* Largest of the model's width, height and depth. */
static double size_of(const dp_reach *r) {
    return dp_max(r->front - r->back,
                  dp_max(r->most[DP_REACH_RIGHT][0] + r->most[DP_REACH_LEFT][0],
                         r->most[DP_REACH_ABOVE][0] + r->most[DP_REACH_BELOW][0]));
}

/* Sets view: the reach's axes, and an eye given in them. */
static void put_eye(dp_camera *camera, const dp_reach *reach, const double eye[3]) {
    memset(camera->view, 0, sizeof camera->view);
    for (int k = 0; k < 3; k++) {
        const double *const axis = reach->axis[k], *const o = reach->origin;
        for (int i = 0; i < 3; i++) camera->view[4 * i + k] = axis[i];
        camera->view[12 + k] = -(axis[0] * o[0] + axis[1] * o[1] + axis[2] * o[2]) - eye[k];
    }
    camera->view[15] = 1;
}

static double clearance(const dp_reach *r) { return CLEARANCE * size_of(r); }

static double eye_z_of(const dp_reach *r) {
    return dp_max(dp_max(least_z(r, DP_REACH_RIGHT), least_z(r, DP_REACH_ABOVE)),
                  r->front + clearance(r));
}

/* `fine` tells the middle, `r` all else. */
static dp_result see_in_perspective(dp_camera *camera, const dp_reach *r, const dp_reach *fine,
                                    const numbers *n) {
    const double z = eye_z_of(r), near_z = z - r->front, far_z = z - r->back;
    const double eye[3] = {middle(fine, DP_REACH_RIGHT, z), middle(fine, DP_REACH_ABOVE, z), z};
    put_eye(camera, r, eye);
    return dp_camera_perspective(camera, zoomed_fov(n), n->aspect, 0.99 * near_z,
                                 1.01 * far_z + clearance(r));
}

static dp_result see_orthographic(dp_camera *camera, const dp_reach *r, const numbers *n,
                                  double height) {
    const double across = r->most[DP_REACH_RIGHT][0] + r->most[DP_REACH_LEFT][0],
                 upright = r->most[DP_REACH_ABOVE][0] + r->most[DP_REACH_BELOW][0];
    const double size = size_of(r);
    const double eye[3] = {middle(r, DP_REACH_RIGHT, 0), middle(r, DP_REACH_ABOVE, 0),
                           r->front + size};
    if (!(height > 0)) height = dp_max(upright, across / n->aspect) / (1 - MARGIN);
    put_eye(camera, r, eye);
    return dp_camera_orthographic(camera, height / n->zoom, n->aspect, 0.99 * size,
                                  2.01 * size + (r->front - r->back));
}

/* Adds the fit's box, if it has one, which counts from world space's 0. */
static dp_result add_box(const dp_fit *fit, dp_reach *reach) {
    dp_vec3 min, max;
    box_of(fit, &min, &max);
    if (!isfinite(dp_length(dp_sub(max, min))) || min.x > max.x || min.y > max.y || min.z > max.z)
        return DP_ERR_ARGUMENT;
    if (dp_length(min) + dp_length(max) <= 0) return DP_OK;
    const double *const o = reach->origin;
    for (int i = 0; i < 8; i++) {
        const double corner[3] = {(i & 1 ? max.x : min.x) - o[0], (i & 2 ? max.y : min.y) - o[1],
                                  (i & 4 ? max.z : min.z) - o[2]};
        dp_reach_add(reach, corner);
    }
    return DP_OK;
}

/* Fits the source's box, of which perhaps nothing is drawn. */
static dp_result fit_extent(dp_camera *camera, const dp_fit *fit, const dp_extent *extent,
                            const dp_reach *reach) {
    dp_fit boxed = *fit;
    memcpy(boxed.exact_min, extent->exact_min, sizeof boxed.exact_min);
    memcpy(boxed.exact_max, extent->exact_max, sizeof boxed.exact_max);
    for (int k = 0; k < 3; k++) {
        boxed.direction[k] = reach->axis[2][k], boxed.up[k] = reach->axis[1][k];
        boxed.min[k] = extent->min[k], boxed.max[k] = extent->max[k];
    }
    return dp_camera_fit(camera, &boxed);
}

/* Is the view so wide, more than 80 degrees, that what lies between two slopes may be seen? */
static bool is_wide(const dp_reach *r) {
    static const double wide = 0.84;
    return r->slope[0][DP_REACH_SLOPES - 1] > wide || r->slope[1][DP_REACH_SLOPES - 1] > wide;
}

/* Reads the source once more, for slopes between those between which the middle lies. */
static dp_result refine(const dp_fit *fit, dp_source *source, const dp_reach *r, dp_reach *fine,
                        dp_diag *diag) {
    dp_extent unused;
    double from[2], to[2];
    for (int k = 0; k < 2; k++) {
        const int j = closing(r, 2 * k, eye_z_of(r));
        from[k] = r->slope[k][j - 1], to[k] = r->slope[k][j];
    }
    dp_reach_begin(fine, r->axis, from, to);
    const dp_result result = dp_source_measure(source, &unused, fine, diag);
    return result ? result : add_box(fit, fine);
}

static dp_result fit_reach(dp_camera *camera, const dp_fit *fit, const numbers *n,
                           dp_source *source, dp_reach *reach, dp_diag *diag) {
    dp_reach fine;
    dp_result wrong = add_box(fit, reach);
    if (wrong) return wrong;
    if (fit->orthographic) return see_orthographic(camera, reach, n, fit->height);
    const bool again = is_wide(reach) && dp_source_rewindable(source);
    if (again) wrong = refine(fit, source, reach, &fine, diag);
    return wrong ? wrong : see_in_perspective(camera, reach, again ? &fine : reach, n);
}

dp_result dp_camera_fit_source(dp_camera *camera, const dp_fit *fit, dp_source *source,
                               dp_extent *extent, dp_diag *diag) {
    static const dp_fit usual = {0};
    numbers n;
    dp_extent own;
    double axis[3][3];
    if (!fit) fit = &usual;
    if (!extent) extent = &own;
    if (!camera || !source || !resolve(fit, &n) || find_axes(fit, source, axis))
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "dp_camera_fit_source: NULL argument, or a fit that is out of range");
    const double share = fit->orthographic ? 0 : 1 - MARGIN;
    const double steepest[2] = {n.tan_x * share, n.tan_y * share};
    dp_reach reach;
    dp_reach_begin(&reach, axis, (const double[2]){0}, steepest);
    dp_result result = dp_source_measure(source, extent, &reach, diag);
    if (!result && (fit->steady || !(size_of(&reach) > 0)))
        result = fit_extent(camera, fit, extent, &reach);
    else if (!result)
        result = fit_reach(camera, fit, &n, source, &reach, diag);
    return result == DP_ERR_ARGUMENT
               ? dp_fail(diag, result, "the model's size cannot be fitted into a picture")
               : result;
}
