/* An orbit's arithmetic, and its numbers as words. The words are what is drawn from: they are as long as a millionth of
 * the distance needs, and no longer, so that a command line can be read. */
#include "orbit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double degree = 0.017453292519943295;

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Towards the eye, and the picture's up and right. */
static void axes_of(const orbit *o, double back[3], double up[3], double right[3]) {
    sides_angles(&o->sides, o->azimuth, o->elevation, back, up);
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        right[k] = up[a] * back[b] - up[b] * back[a];
    }
}

orbit orbit_of(const dp_camera *camera, const model_sides *sides, const dp_extent *extent) {
    const double *const v = camera->view, *const p = camera->projection;
    orbit o = {.sides = *sides, .orthographic = p[11] == 0};
    double eye[3], back[3], up[3], square = 0;
    for (int k = 0; k < 3; k++) {
        const double half = 0.5 * (extent->exact_max[k] - extent->exact_min[k]);
        o.centre[k] = extent->exact_min[k] + half;
        square += half * half;
    }
    o.radius = square > 0 ? sqrt(square) : 1;
    for (int k = 0; k < 3; k++) { /* rows of the rotation are the camera's axes */
        up[k] = v[4 * k + 1], back[k] = v[4 * k + 2];
        eye[k] = -(v[4 * k] * v[12] + v[4 * k + 1] * v[13] + v[4 * k + 2] * v[14]);
    }
    o.elevation = asin(fmin(fmax(dot(back, sides->up), -1), 1)) / degree;
    /* seen from above or below, what is up in the picture tells the azimuth */
    const bool steep = fabs(o.elevation) > 89;
    const double *const level = steep ? up : back, sign = steep && o.elevation > 0 ? -1 : 1;
    o.azimuth = atan2(sign * dot(level, sides->right), sign * dot(level, sides->front)) / degree;
    double depth = 0;
    for (int k = 0; k < 3; k++) depth += (eye[k] - o.centre[k]) * back[k];
    o.fov = o.orthographic ? 35 : 2 * atan(1 / p[5]) / degree;
    o.distance = depth > 0 ? depth : 1;
    o.height = o.orthographic ? 2 / p[5] : 2 * o.distance * tan(0.5 * o.fov * degree);
    for (int k = 0; k < 3; k++) o.target[k] = eye[k] - o.distance * back[k];
    return o;
}

static double seen_height(const orbit *o) {
    return o->orthographic ? o->height : 2 * o->distance * tan(0.5 * o->fov * degree);
}

/* The eye's distance: an orthographic one stands outside the model, as nothing behind it is drawn. */
static double eye_distance(const orbit *o) {
    double square = 0;
    for (int k = 0; k < 3; k++)
        square += (o->target[k] - o->centre[k]) * (o->target[k] - o->centre[k]);
    return o->orthographic ? 1.1 * (sqrt(square) + o->radius) : o->distance;
}

void orbit_turn(orbit *o, double right, double down) {
    o->azimuth = remainder(o->azimuth - 180 * right, 360);
    o->elevation = fmin(fmax(o->elevation + 180 * down, -90), 90);
}

static void shift(orbit *o, double right, double down) {
    double back[3], up[3], across[3];
    axes_of(o, back, up, across);
    for (int k = 0; k < 3; k++) o->target[k] += right * across[k] - down * up[k];
}

void orbit_pan(orbit *o, double right, double down) {
    shift(o, -right * seen_height(o), -down * seen_height(o));
}

void orbit_zoom(orbit *o, double factor, double right, double down) {
    const double before = seen_height(o);
    o->distance /= factor;
    o->height /= factor;
    const double less = before - seen_height(o);
    shift(o, right * less, down * less);
}

void orbit_focus(orbit *o, double depth) {
    double back[3], up[3], right[3];
    const double now = eye_distance(o);
    axes_of(o, back, up, right);
    for (int k = 0; k < 3; k++) o->target[k] += (now - depth) * back[k];
    if (!o->orthographic) o->distance = depth;
}

void orbit_project(orbit *o, bool orthographic) {
    const double height = seen_height(o);
    o->orthographic = orthographic;
    o->height = height;
    /* an eye that stood beside the model goes no nearer than the field of view asks */
    o->distance = 0.5 * height / tan(0.5 * o->fov * degree);
}

/* ------- as words ------- */

/* Digits of a number that is told to `step`. */
static int digits_of(double value, double step) {
    const double digits = ceil(log10(fmax(fabs(value), step) / step)) + 1;
    return (int)fmin(fmax(digits, 1), 17);
}

static void put_point(cmd_options *to, const char *name, const double p[3], double step) {
    char text[128];
    double n[3];
    for (int k = 0; k < 3; k++) n[k] = fabs(p[k]) < 0.5 * step ? 0 : p[k];
    snprintf(text, sizeof text, "%.*g,%.*g,%.*g", digits_of(n[0], step), n[0],
             digits_of(n[1], step), n[1], digits_of(n[2], step), n[2]);
    cmdline_set(to, name, text);
}

static void put_number(cmd_options *to, const char *name, double value) {
    char text[32];
    snprintf(text, sizeof text, "%.7g", value);
    cmdline_set(to, name, text);
}

void orbit_write(const orbit *o, cmd_options *camera) {
    const double distance = eye_distance(o), step = 1e-6 * fmin(distance, seen_height(o));
    double back[3], up[3], right[3], eye[3];
    axes_of(o, back, up, right);
    for (int k = 0; k < 3; k++) eye[k] = o->target[k] + distance * back[k];
    cmdline_clear(camera);
    put_point(camera, "eye", eye, step);
    put_point(camera, "target", o->target, step);
    if (fabs(o->elevation) > 80) put_point(camera, "up", up, 1e-6);
    if (o->orthographic)
        put_number(camera, "ortho", o->height);
    else
        put_number(camera, "fov", o->fov);
}
