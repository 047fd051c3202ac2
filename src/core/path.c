/* A camera's way through key views.
 *
 * Each coordinate of eye, target and up is a cubic between neighbouring keys, in Hermite's form:
 *
 *     p(s) = h00(s) p0 + h (h10(s) m0) + h01(s) p1 + h (h11(s) m1),   h = t1 - t0, s = (t - t0) / h
 *
 * The slope m at a key is that of the parabola through it and its two neighbours, which for keys at
 * equal distances is Catmull-Rom's. An end of an open path has the slope with which its cubic has no
 * curvature there. Angles and heights take Fritsch and Butland's slope instead (SIAM J. Sci. Stat.
 * Comput. 5, 1984): the weighted harmonic mean of both sides', and 0 at an extremum, so that nothing
 * swings beyond the keys. A point that two neighbouring keys share has slope 0 at both.
 *
 * Invariant: times ascend; all views are of one projection; up is never 0. */
#include <drypoint/path.h>

#include "base/diag.h"
#include "base/memory.h"
#include "core/path.h"

#include <math.h>
#include <string.h>

struct dp_camera_path {
    dp_allocator allocator;
    size_t count;
    bool closed;
    dp_key_view views[]; /* [count] */
};

enum { VIEWS_MOST = 1000000 };
static const double usual_fov = 35; /* degrees, as dp_fit's */

/* ---- making ---- */

static dp_result refuse(dp_diag *diag, size_t view, const char *what) {
    const dp_result result =
        dp_fail(diag, DP_ERR_ARGUMENT, "view %zu of a path %s", view + 1, what);
    if (diag) diag->item = view;
    return result;
}

static bool is_finite3(const double p[3]) {
    return isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]);
}

static bool same_point(const double a[3], const double b[3]) {
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

static bool is_zero(const double p[3]) { return p[0] == 0 && p[1] == 0 && p[2] == 0; }

const char *dp_key_view_mistake(const dp_key_view *view, const dp_key_view *before) {
    if (!isfinite(view->time)) return "has a time that is not finite";
    if (before && !(view->time > before->time))
        return "is not later than the one before it; give times that ascend";
    if (!is_finite3(view->eye) || !is_finite3(view->target) || !is_finite3(view->up))
        return "has a coordinate that is not finite";
    if (same_point(view->eye, view->target)) return "has its eye where it looks at; move one";
    if (!(view->fov_y >= 0 && view->fov_y < 180))
        return "has a field of view that is not between 0 and 180 degrees";
    if (!(view->height >= 0 && isfinite(view->height))) return "has a height that is not above 0";
    if (before && (view->height > 0) != (before->height > 0))
        return "has another projection than the one before it; give all of them a fov, or all a "
               "height";
    return NULL;
}

/* Same directions, and of the same sense, whatever their lengths? */
static bool same_look(const dp_key_view *a, const dp_key_view *b) {
    return same_point(a->eye, b->eye) && same_point(a->target, b->target) &&
           same_point(a->up, b->up) && a->fov_y == b->fov_y && a->height == b->height;
}

/* Directions count, not lengths. */
static void normalize(double v[3]) {
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int k = 0; k < 3 && length > 0 && isfinite(length); k++) v[k] /= length;
}

dp_result dp_camera_path_create(const dp_key_view *views, size_t count, const double up[3],
                                const dp_allocator *allocator, dp_camera_path **out,
                                dp_diag *diag) {
    static const double usual_up[3] = {0, 1, 0};
    if (!out) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_camera_path_create: out is NULL");
    *out = NULL;
    if (!views || !count) return dp_fail(diag, DP_ERR_ARGUMENT, "a path without a view");
    if (count > VIEWS_MOST)
        return dp_fail(diag, DP_ERR_LIMIT, "a path of %zu views; %d are the most", count,
                       VIEWS_MOST);
    for (size_t k = 0; k < count; k++) {
        const char *const wrong = dp_key_view_mistake(&views[k], k ? &views[k - 1] : NULL);
        if (wrong) return refuse(diag, k, wrong);
    }
    if (up && (!is_finite3(up) || is_zero(up))) up = NULL;
    const dp_allocator memory = dp_allocator_resolve(allocator);
    dp_camera_path *const path = dp_alloc(&memory, sizeof *path + count * sizeof *views);
    if (!path) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a path of %zu views", count);
    path->allocator = memory;
    path->count = count;
    memcpy(path->views, views, count * sizeof *views);
    for (size_t k = 0; k < count; k++) {
        dp_key_view *const v = &path->views[k];
        if (is_zero(v->up)) memcpy(v->up, up ? up : usual_up, sizeof v->up);
        normalize(v->up);
        if (!(v->fov_y > 0)) v->fov_y = usual_fov;
    }
    path->closed = count > 2 && same_look(&path->views[0], &path->views[count - 1]);
    *out = path;
    return DP_OK;
}

void dp_camera_path_destroy(dp_camera_path *path) {
    if (!path) return;
    const dp_allocator memory = path->allocator;
    dp_free(&memory, path);
}

double dp_camera_path_begin(const dp_camera_path *path) { return path->views[0].time; }
double dp_camera_path_end(const dp_camera_path *path) { return path->views[path->count - 1].time; }
bool dp_camera_path_closed(const dp_camera_path *path) { return path->closed; }

/* ---- between keys ---- */

/* The keys around a place of the path, and which of them there are. */
typedef struct stretch {
    const dp_key_view *key[4]; /* before, from, to, after; NULL: the path ends */
    double length[3];          /* s: of the intervals between them */
    double s;                  /* in [0, 1]: how far from `from` to `to` */
} stretch;

static double slope(double d0, double d1, double h0, double h1) {
    return (h1 * d0 + h0 * d1) / (h0 + h1);
}

static double monotone_slope(double d0, double d1, double h0, double h1) {
    if (!(d0 * d1 > 0)) return 0;
    return 3 * (h0 + h1) / ((2 * h1 + h0) / d0 + (h1 + 2 * h0) / d1);
}

static double hermite(const stretch *at, double p0, double p1, double m0, double m1) {
    const double s = at->s, r = 1 - s, h = at->length[1];
    return r * r * ((1 + 2 * s) * p0 + s * h * m0) + s * s * ((1 + 2 * r) * p1 - r * h * m1);
}

/* Values of one coordinate at the keys; those of absent keys are not used. */
static double between(const stretch *at, const double p[4], bool still_before, bool still_after,
                      double (*slope_of)(double, double, double, double)) {
    const double *const h = at->length;
    const double d = (p[2] - p[1]) / h[1];
    const double before = at->key[0] ? (p[1] - p[0]) / h[0] : 0,
                 after = at->key[3] ? (p[3] - p[2]) / h[2] : 0;
    double m0 = at->key[0] ? slope_of(before, d, h[0], h[1]) : d,
           m1 = at->key[3] ? slope_of(d, after, h[1], h[2]) : d;
    if (still_before) m0 = 0;
    if (still_after) m1 = 0;
    /* no curvature at an open end: 3 d = 2 m + the other slope */
    if (!at->key[0]) m0 = 0.5 * (3 * d - m1);
    if (!at->key[3]) m1 = 0.5 * (3 * d - m0);
    if (!at->key[0] && !at->key[3]) m0 = m1 = d;
    return hermite(at, p[1], p[2], m0, m1);
}

static const double *point_of(const dp_key_view *view, size_t member) {
    return (const double *)(const void *)((const char *)view + member);
}

static void point_between(const stretch *at, size_t member, double out[3]) {
    const double *p[4];
    for (int i = 0; i < 4; i++) p[i] = point_of(at->key[i] ? at->key[i] : at->key[1], member);
    if (same_point(p[1], p[2])) {
        memcpy(out, p[1], 3 * sizeof *out);
        return;
    }
    const bool still_before = at->key[0] && same_point(p[0], p[1]),
               still_after = at->key[3] && same_point(p[2], p[3]);
    for (int k = 0; k < 3; k++) {
        const double c[4] = {p[0][k], p[1][k], p[2][k], p[3][k]};
        out[k] = between(at, c, still_before, still_after, slope);
    }
}

static double value_between(const stretch *at, size_t member) {
    double c[4];
    for (int i = 0; i < 4; i++) c[i] = *point_of(at->key[i] ? at->key[i] : at->key[1], member);
    const double low = fmin(c[1], c[2]), high = fmax(c[1], c[2]);
    return fmin(fmax(between(at, c, false, false, monotone_slope), low), high);
}

/* ---- a time's place ---- */

/* The last key at or before the time, but not the path's last one. */
static size_t find_key(const dp_camera_path *path, double time) {
    size_t low = 0, high = path->count - 1;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (path->views[middle].time <= time)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static double wrapped(const dp_camera_path *path, double time) {
    const double begin = dp_camera_path_begin(path), end = dp_camera_path_end(path);
    if (!path->closed) return fmin(fmax(time, begin), end);
    const double rounds = (time - begin) / (end - begin);
    const double part = time - (end - begin) * floor(rounds);
    return fmin(fmax(part, begin), end);
}

static void find_stretch(const dp_camera_path *path, double time, stretch *at) {
    const size_t k = find_key(path, time), last = path->count - 1;
    const dp_key_view *const v = path->views;
    at->key[1] = &v[k], at->key[2] = &v[k + 1];
    at->key[0] = k > 0 ? &v[k - 1] : path->closed ? &v[last - 1] : NULL;
    at->key[3] = k + 1 < last ? &v[k + 2] : path->closed ? &v[1] : NULL;
    at->length[1] = v[k + 1].time - v[k].time;
    at->length[0] = k > 0 ? v[k].time - v[k - 1].time : v[last].time - v[last - 1].time;
    at->length[2] = k + 1 < last ? v[k + 2].time - v[k + 1].time : v[1].time - v[0].time;
    at->s = (time - v[k].time) / at->length[1];
}

dp_result dp_camera_path_view(const dp_camera_path *path, double time, dp_key_view *view) {
    if (!path || !view || !isfinite(time)) return DP_ERR_ARGUMENT;
    stretch at;
    *view = path->views[0];
    if (path->count > 1) {
        find_stretch(path, wrapped(path, time), &at);
        point_between(&at, offsetof(dp_key_view, eye), view->eye);
        point_between(&at, offsetof(dp_key_view, target), view->target);
        point_between(&at, offsetof(dp_key_view, up), view->up);
        normalize(view->up);
        view->fov_y = value_between(&at, offsetof(dp_key_view, fov_y));
        view->height = value_between(&at, offsetof(dp_key_view, height));
    }
    view->time = time;
    return DP_OK;
}

dp_result dp_camera_path_at(const dp_camera_path *path, double time, double aspect,
                            const float min[3], const float max[3], dp_camera *camera,
                            dp_diag *diag) {
    dp_key_view v;
    double near_z, far_z;
    if (!camera || !min || !max || dp_camera_path_view(path, time, &v))
        return dp_fail(diag, DP_ERR_ARGUMENT, "a path is asked for a time that is not finite");
    if (!(aspect > 0)) aspect = 4.0 / 3;
    memset(camera, 0, sizeof *camera);
    if (dp_camera_look_at(camera, v.eye, v.target, v.up))
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "at %.6g s the path's eye meets its target; move one of them", time);
    dp_camera_near_far(camera, min, max, &near_z, &far_z);
    const dp_result wrong = v.height > 0
                                ? dp_camera_orthographic(camera, v.height, aspect, near_z, far_z)
                                : dp_camera_perspective(camera, v.fov_y, aspect, near_z, far_z);
    if (!wrong) return DP_OK;
    return dp_fail(diag, DP_ERR_ARGUMENT, "at %.6g s the path's camera cannot see anything", time);
}
