/* Files hold coordinates with three or four decimals: corners that should lie on an edge lie beside
 * it, and planes that should be one are not.
 *
 *    of some positions, spread over the model
 *        the least number of decimals that all coordinates have
 *        their box: how large is the unit of the last decimal in the picture?
 *
 * Not handled: coordinates rounded otherwise (to binary fractions, or before they were moved). */
#include "core/precision.h"

enum { DECIMALS_MOST = 6, POSITIONS = 1024 };

/* px: most that a model's own precision may make of DP_TOUCHING and DP_CRACK. */
static const double MOST = 0.25;

/* Of the model's size: a coarser unit is a choice of the maker's, not rounding. */
static const double COARSEST = 5e-5;

/* Half-units of rounding in three coordinates, of the corner and of the plane or edge beside it. */
static const double SPREAD = 3;

static bool has_decimals(float v, double unit) {
    const double units = (double)v / unit, noise = fabs(units) * 1.2e-7;
    return noise < 0.05 && fabs(units - floor(units + 0.5)) <= 1e-3 + noise;
}

/* Those that smoothing made have decimals of their own. */
static uint32_t given_count(const dp_polygons *polygons) {
    return polygons->vertex_count - polygons->made_vertices;
}

static uint32_t position_step(const dp_polygons *polygons) {
    return given_count(polygons) / POSITIONS + 1;
}

double dp_precision_of(const dp_polygons *polygons) {
    const uint32_t step = position_step(polygons);
    int decimals = 0;
    double unit = 1;
    for (uint32_t v = 0; v < given_count(polygons) && decimals <= DECIMALS_MOST; v += step) {
        const float *const p = dp_vertex_position(polygons, v);
        for (int i = 0; i < 3 && decimals <= DECIMALS_MOST; i++)
            while (decimals <= DECIMALS_MOST && !has_decimals(p[i], unit)) unit /= 10, decimals++;
    }
    return decimals > DECIMALS_MOST || !given_count(polygons) ? 0 : unit / 2;
}

dp_written dp_written_of(const dp_polygons *polygons) {
    const uint32_t step = position_step(polygons);
    dp_written w = {dp_precision_of(polygons),
                    {INFINITY, INFINITY, INFINITY},
                    {-INFINITY, -INFINITY, -INFINITY}};
    if (!(w.precision > 0)) return w;
    for (uint32_t v = 0; v < given_count(polygons); v += step) {
        const dp_vec3 p = dp_v3f(dp_vertex_position(polygons, v));
        if (!isfinite(p.x) || !isfinite(p.y) || !isfinite(p.z)) continue;
        w.least = dp_v3(dp_min(w.least.x, p.x), dp_min(w.least.y, p.y), dp_min(w.least.z, p.z));
        w.most = dp_v3(dp_max(w.most.x, p.x), dp_max(w.most.y, p.y), dp_max(w.most.z, p.z));
    }
    return w;
}

dp_tolerances dp_tolerances_of(const dp_written *w, const dp_view *view) {
    dp_tolerances t = {DP_TOUCHING, DP_CRACK, 0};
    if (!(w->precision > 0)) return t;
    const double size = dp_length(dp_sub(w->most, w->least)),
                 known = dp_min(w->precision, COARSEST * size) * SPREAD;
    const dp_vec3 middle = dp_mix(w->least, w->most, 0.5);
    const double *const s = view->sight,
                        distance = s[0] * middle.x + s[1] * middle.y + s[2] * middle.z + s[3];
    const double scale =
        view->perspective ? view->focal / dp_max(distance, 0.1 * size) : view->focal;
    if (!isfinite(scale * known)) return t;
    t.touching = (float)dp_min(dp_max((double)DP_TOUCHING, known * scale), MOST);
    t.crack = (float)dp_min(dp_max((double)DP_CRACK, known * scale), MOST);
    if (known * scale > (double)DP_TOUCHING) t.precision = known;
    return t;
}

void dp_find_tolerances(dp_frame *f) {
    const dp_written written = dp_written_of(&f->polygons);
    const dp_tolerances t = dp_tolerances_of(&written, &f->view);
    f->touching = t.touching, f->crack = t.crack, f->precision = t.precision;
}

bool dp_is_sliver(const dp_frame *f, uint32_t polygon) {
    const dp_polygons *const polygons = &f->polygons;
    const uint32_t first = dp_first_corner(polygons, polygon),
                   n = dp_corner_count(polygons, polygon);
    const dp_vec3 o = dp_v3f(dp_vertex_position(polygons, dp_corner_vertex(polygons, first)));
    dp_vec3 sum = {0, 0, 0}, a = {0, 0, 0};
    double longest = 0;
    for (uint32_t i = 1; i < n; i++) {
        const dp_vec3 p = dp_v3f(
                          dp_vertex_position(polygons, dp_corner_vertex(polygons, first + i))),
                      b = dp_sub(p, o);
        sum = dp_add(sum, dp_cross(a, b));
        longest = dp_max(longest, dp_max(dp_length(b), dp_length(dp_sub(b, a))));
        a = b;
    }
    return dp_length(sum) <= f->precision * longest;
}
