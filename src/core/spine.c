/* Spines (spine.h): an edge is clipped to the frustum in clip space, projected, divided into sample
 * points, and lifted off the surface for them. Ends are computed as a + t (b - a), from the first
 * end, in double precision; find/folds.inc does the same operations in the same order. */
#include "core/spine.h"

static dp_pointd lifted(const dp_view *view, dp_vec3 p, double d, dp_vec3 normal) {
    const dp_vec3 q = dp_mad(p, normal, DP_PROBE_LIFT * dp_pixel_size(view, d));
    return dp_to_screen(view, dp_to_clip(view, q));
}

/* Places the part of [a, b] that lies in the frustum, from *t0 to *t1. */
static bool place_spine(const dp_view *view, dp_vec3 a, dp_vec3 b, dp_spine *spine, double *t0,
                        double *t1) {
    const dp_clip_point ca = dp_to_clip(view, a), cb = dp_to_clip(view, b);
    *t0 = 0, *t1 = 1;
    if ((dp_outcode(view, ca) | dp_outcode(view, cb)) && !dp_clip_segment(view, ca, cb, t0, t1))
        return false;
    spine->a = dp_to_screen(view, dp_clip_mix(ca, cb, *t0));
    spine->b = dp_to_screen(view, dp_clip_mix(ca, cb, *t1));
    return dp_spine_divide(spine);
}

bool dp_spine_make(const dp_view *view, dp_vec3 a, dp_vec3 b, dp_vec3 normal, dp_spine *spine) {
    double t0, t1;
    if (!place_spine(view, a, b, spine, &t0, &t1)) return false;
    spine->probe_a = lifted(view, dp_mix(a, b, t0), spine->a.d, normal);
    spine->probe_b = lifted(view, dp_mix(a, b, t1), spine->b.d, normal);
    return true;
}

bool dp_spine_ends(const dp_view *view, dp_vec3 a, dp_vec3 b, dp_spine *spine) {
    double t0, t1;
    return place_spine(view, a, b, spine, &t0, &t1);
}

bool dp_spine_range(const dp_spine *s, double x, double y, double beside, uint32_t *k0,
                    uint32_t *k1) {
    double t0 = 0, t1 = 1;
    dp_cut_range(s->a.x, s->b.x, x - beside, x + DP_TILE + beside, &t0, &t1);
    dp_cut_range(s->a.y, s->b.y, y - beside, y + DP_TILE + beside, &t0, &t1);
    if (t0 > t1) return false;
    const double from = ceil(t0 * s->n - 0.5), to = floor(t1 * s->n - 0.5) + 1;
    *k0 = from > 0 ? (uint32_t)from : 0;
    *k1 = to < s->n ? (uint32_t)dp_max(to, 0) : s->n;
    return *k0 < *k1;
}
