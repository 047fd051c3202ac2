/* Spines: the centre lines of feature lines, with the sample points at which visibility is tested.
 *
 * Invariant: a spine is the same in every tile and thread. Its sample points are numbered along the
 * whole of it, so pieces found in different tiles join by number. */
#ifndef DP_CORE_SPINE_H
#define DP_CORE_SPINE_H

#include "core/frame.h"

typedef struct dp_spine {
    dp_pointd a, b;             /* ends on the screen, clipped to the guarded frustum */
    dp_pointd probe_a, probe_b; /* the same, lifted off the surface along its normal */
    uint32_t n;                 /* sample points; point k is (k + 1/2) / n of the way along */
} dp_spine;

/* Pixel sizes: how far sample points are lifted off the surface, and how much nearer a surface must
 * be to hide them. Small against a pixel, large against the error of float32 depth (1e-4 pixel
 * sizes). */
#define DP_PROBE_LIFT  0.1
#define DP_PROBE_SLACK 0.05

/* The spine from a to b (world space), lifted along the unit normal. False: nothing of it is in the
 * frustum. */
bool dp_spine_make(const dp_view *view, dp_vec3 a, dp_vec3 b, dp_vec3 normal, dp_spine *spine);

/* Sets the ends only; probe_a and probe_b are not changed. */
bool dp_spine_ends(const dp_view *view, dp_vec3 a, dp_vec3 b, dp_spine *spine);

/* px on the screen between sample points: a quarter of a pixel resolves where a line disappears. */
#define DP_PROBE_SPACING 0.25

/* Sets n from the ends. False: they are not finite. */
static inline bool dp_spine_divide(dp_spine *spine) {
    const double x = spine->b.x - spine->a.x, y = spine->b.y - spine->a.y,
                 length = sqrt(x * x + y * y);
    spine->n = length > DP_PROBE_SPACING ? (uint32_t)ceil(length / DP_PROBE_SPACING) : 1;
    return isfinite(length);
}

/* The sample points [*k0, *k1) of the spine itself, not lifted, that lie in the tile with corner
 * (x, y) px, or within `beside` px of it. False: there are none. */
bool dp_spine_range(const dp_spine *spine, double x, double y, double beside, uint32_t *k0,
                    uint32_t *k1);

/* Cuts [*t0, *t1] to the part where from + t * (to - from) lies in [lo, hi]; *t1 < *t0 if there is
 * none. */
static inline void dp_cut_range(double from, double to, double lo, double hi, double *t0,
                                double *t1) {
    const double step = to - from;
    if (step == 0) {
        if (from < lo || from > hi) *t1 = -1;
        return;
    }
    const double a = (lo - from) / step, b = (hi - from) / step;
    *t0 = dp_max(*t0, dp_min(a, b));
    *t1 = dp_min(*t1, dp_max(a, b));
}

static inline dp_pointd dp_point_mix(dp_pointd a, dp_pointd b, double t) {
    return (dp_pointd){a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.d + (b.d - a.d) * t};
}

#endif
