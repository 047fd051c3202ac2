/* Resolves a camera, and clips in homogeneous clip space.
 *
 * Two kinds of projection are accepted: perspective, where the row w is a multiple of the camera's
 * -z, and orthographic, where w is constant. Both are scaled so that w is the distance along the
 * line of sight, or 1. Invariant: depth is affine on the screen for every polygon (view.h). Not
 * handled: other projections; dp_view_init refuses them. */
#include "core/view.h"

#include "base/diag.h"

/* Points further from the axis than this many half pictures are clipped. In a picture 2000 px wide,
 * float32 still places what is within to a thousandth of a pixel. */
static const double GUARD = 5;

static double element(const double *m, int row, int column) { return m[4 * column + row]; }

static bool is_finite(const double m[16]) {
    for (int i = 0; i < 16; i++)
        if (!isfinite(m[i])) return false;
    return true;
}

/* Row r of projection * view, divided by `scale`. */
static void product_row(const dp_camera *camera, int r, double scale, double out[4]) {
    for (int c = 0; c < 4; c++) {
        double sum = 0;
        for (int k = 0; k < 4; k++)
            sum += element(camera->projection, r, k) * element(camera->view, k, c);
        out[c] = sum / scale;
    }
}

static void place_eye(dp_view *view, const dp_camera *camera) {
    const double *const v = camera->view;
    const dp_vec3 right = dp_v3(v[0], v[4], v[8]), up = dp_v3(v[1], v[5], v[9]);
    const dp_vec3 back = dp_v3(v[2], v[6], v[10]);
    const double scale =
        dp_dot(back, back); /* rotation times uniform scale: inverse = transpose / scale² */
    const dp_vec3 sum = dp_mad(dp_mad(dp_scale(right, v[12]), up, v[13]), back, v[14]);
    view->eye = dp_scale(sum, -1 / scale);
    view->forward = dp_scale(dp_unit(back), -1);
}

/* Prepares dp_unproject. */
static void invert(dp_view *view) {
    const double *const X = view->clip[0], *const Y = view->clip[1], *const S = view->sight;
    const dp_vec3 a = dp_v3(X[0], X[1], X[2]), b = dp_v3(Y[0], Y[1], Y[2]),
                  c = dp_v3(S[0], S[1], S[2]);
    view->inverse[0] = dp_cross(b, c), view->inverse[1] = dp_cross(c, a),
    view->inverse[2] = dp_cross(a, b);
    view->determinant = dp_dot(a, view->inverse[0]);
}

dp_camera dp_camera_about(const dp_camera *camera, const double origin[3]) {
    dp_camera about = *camera;
    for (int r = 0; r < 3; r++)
        for (int k = 0; k < 3; k++)
            if (origin[k] != 0) about.view[12 + r] += element(camera->view, r, k) * origin[k];
    return about;
}

dp_result dp_view_init(dp_view *view, const dp_camera *camera, uint32_t width, uint32_t height,
                       dp_diag *diag) {
    const double *const p = camera->projection;
    if (!is_finite(camera->view) || !is_finite(p))
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "the camera's matrices hold values that are not finite");
    const bool perspective = p[11] != 0;
    const double scale = perspective ? -p[11] : p[15];
    const bool known = p[3] == 0 && p[7] == 0 && (p[11] == 0) != (p[15] == 0) && scale > 0;
    if (!known || !(p[5] != 0) || !(p[0] != 0))
        return dp_fail(
            diag, DP_ERR_ARGUMENT,
            "the projection is neither perspective nor orthographic (dp_camera_* make one)");
    *view = (dp_view){.perspective = perspective, .width = width, .height = height, .guard = GUARD};
    for (int r = 0; r < 4; r++) product_row(camera, r, scale, view->clip[r]);
    for (int c = 0; c < 4; c++) view->sight[c] = -element(camera->view, 2, c);
    if (!(dp_length(dp_v3(view->sight[0], view->sight[1], view->sight[2])) > 0))
        return dp_fail(diag, DP_ERR_ARGUMENT, "the camera's view matrix is singular");
    view->focal = fabs(p[5]) / scale * height / 2;
    place_eye(view, camera);
    invert(view);
    view->corner = dp_unproject(view, (dp_pointd){0, 0, 1});
    view->across = dp_sub(dp_unproject(view, (dp_pointd){1, 0, 1}), view->corner);
    view->down = dp_sub(dp_unproject(view, (dp_pointd){0, 1, 1}), view->corner);
    return DP_OK;
}

/* Solves for the point by Cramer's rule: the values of the rows x, y and sight are known there. */
dp_vec3 dp_unproject(const dp_view *view, dp_pointd p) {
    const double distance = dp_distance(view, p.d);
    const double w = view->perspective ? distance : 1;
    const double *const X = view->clip[0], *const Y = view->clip[1], *const S = view->sight;
    const double rx = (2 * p.x / view->width - 1) * w - X[3];
    const double ry = (1 - 2 * p.y / view->height) * w - Y[3], rs = distance - S[3];
    const dp_vec3 sum =
        dp_mad(dp_mad(dp_scale(view->inverse[0], rx), view->inverse[1], ry), view->inverse[2], rs);
    return dp_scale(sum, 1 / view->determinant);
}

/* How far inside a plane of the frustum a point lies; negative: outside. */
static double inside(const dp_view *view, int plane, dp_clip_point c) {
    const double g = view->guard * c.w;
    switch (plane) {
    case DP_CLIP_NEAR:
        return c.z + c.w;
    case DP_CLIP_FAR:
        return c.w - c.z;
    case DP_CLIP_LEFT:
        return g + c.x;
    case DP_CLIP_RIGHT:
        return g - c.x;
    case DP_CLIP_BOTTOM:
        return g + c.y;
    default:
        return g - c.y;
    }
}

/* (Sutherland and Hodgman 1974), for one plane. */
static uint32_t clip_plane(const dp_view *view, int plane, const dp_clip_point *in, uint32_t n,
                           dp_clip_point *out) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < n; i++) {
        const dp_clip_point a = in[i], b = in[(i + 1) % n];
        const double da = inside(view, plane, a), db = inside(view, plane, b);
        if (da >= 0) out[count++] = a;
        if ((da < 0) != (db < 0)) out[count++] = dp_clip_mix(a, b, da / (da - db));
    }
    return count;
}

uint32_t dp_clip_polygon(const dp_view *view, int codes, dp_clip_point *points, uint32_t n,
                         dp_clip_point *scratch) {
    dp_clip_point *in = points, *out = scratch;
    for (int plane = DP_CLIP_NEAR; plane <= DP_CLIP_TOP && n >= 3; plane <<= 1) {
        if (!(codes & plane)) continue;
        n = clip_plane(view, plane, in, n, out);
        dp_clip_point *const swap = in;
        in = out, out = swap;
    }
    if (n < 3) return 0;
    for (uint32_t i = 0; i < n; i++) {
        if (!(in[i].w > 0)) return 0; /* only if the near plane contains the eye */
        points[i] = in[i];
    }
    return n;
}

bool dp_clip_segment(const dp_view *view, dp_clip_point a, dp_clip_point b, double *t0,
                     double *t1) {
    *t0 = 0, *t1 = 1;
    for (int plane = DP_CLIP_NEAR; plane <= DP_CLIP_TOP; plane <<= 1) {
        const double da = inside(view, plane, a), db = inside(view, plane, b);
        if (da < 0 && db < 0) return false;
        if (da < 0) *t0 = dp_max(*t0, da / (da - db));
        if (db < 0) *t1 = dp_min(*t1, da / (da - db));
    }
    return *t0 < *t1 && dp_clip_mix(a, b, *t0).w > 0 && dp_clip_mix(a, b, *t1).w > 0;
}
