/* Spines: see spine.h. */
#include "pipe/spine.h"

/* Distance of sample points on the screen, px: a quarter of a pixel resolves where a line disappears. */
static const double SPACING = 0.25;

static dp_pointd lifted(const dp_view *view, dp_vec3 p, double d, dp_vec3 normal) {
    const dp_vec3 q = dp_mad(p, normal, DP_PROBE_LIFT * dp_pixel_size(view, d));
    return dp_to_screen(view, dp_to_clip(view, q));
}

bool dp_spine_make(const dp_view *view, dp_vec3 a, dp_vec3 b, dp_vec3 normal, dp_spine *spine) {
    const dp_clip_point ca = dp_to_clip(view, a), cb = dp_to_clip(view, b);
    double t0 = 0, t1 = 1;
    if ((dp_outcode(view, ca) | dp_outcode(view, cb)) && !dp_clip_segment(view, ca, cb, &t0, &t1))
        return false;
    const dp_vec3 p = dp_mix(a, b, t0), q = dp_mix(a, b, t1);
    spine->a = dp_to_screen(view, dp_clip_mix(ca, cb, t0));
    spine->b = dp_to_screen(view, dp_clip_mix(ca, cb, t1));
    spine->probe_a = lifted(view, p, spine->a.d, normal);
    spine->probe_b = lifted(view, q, spine->b.d, normal);
    const double length = hypot(spine->b.x - spine->a.x, spine->b.y - spine->a.y);
    spine->n = length > SPACING ? (uint32_t)ceil(length / SPACING) : 1;
    return isfinite(length);
}
