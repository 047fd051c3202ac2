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

typedef struct box {
    dp_vec3 least, most;
} box;

static box box_of(const dp_polygons *polygons) {
    const uint32_t step = position_step(polygons);
    box b = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (uint32_t v = 0; v < given_count(polygons); v += step) {
        const dp_vec3 p = dp_v3f(dp_vertex_position(polygons, v));
        if (!isfinite(p.x) || !isfinite(p.y) || !isfinite(p.z)) continue;
        b.least = dp_v3(dp_min(b.least.x, p.x), dp_min(b.least.y, p.y), dp_min(b.least.z, p.z));
        b.most = dp_v3(dp_max(b.most.x, p.x), dp_max(b.most.y, p.y), dp_max(b.most.z, p.z));
    }
    return b;
}

void dp_find_tolerances(dp_frame *f) {
    const double precision = dp_precision_of(&f->polygons);
    f->touching = DP_TOUCHING, f->crack = DP_CRACK;
    f->precision = 0;
    if (!(precision > 0)) return;
    const box b = box_of(&f->polygons);
    const double size = dp_length(dp_sub(b.most, b.least)),
                 known = dp_min(precision, COARSEST * size) * SPREAD;
    const dp_vec3 middle = dp_mix(b.least, b.most, 0.5);
    const double *const s = f->view.sight,
                        distance = s[0] * middle.x + s[1] * middle.y + s[2] * middle.z + s[3];
    const double scale =
        f->view.perspective ? f->view.focal / dp_max(distance, 0.1 * size) : f->view.focal;
    if (!isfinite(scale * known)) return;
    f->touching = (float)dp_min(dp_max((double)DP_TOUCHING, known * scale), MOST);
    f->crack = (float)dp_min(dp_max((double)DP_CRACK, known * scale), MOST);
    if (known * scale > (double)DP_TOUCHING) f->precision = known;
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
