/* Chooses the origin of a model's positions.
 *
 * A float32 tells neighbours apart that are 2^-23 of it away. Along an axis on which a model lies
 * farther from 0 than FAR times its size (the longest side of its box), positions are counted from
 * the middle of its box instead, if float32 cuts anything off; beyond VERY_FAR always, as what is
 * computed of positions has no more digits than they. What float32 cuts off is kept beside each
 * position until that is known, so that models nearer to 0 have the very bits that they would have
 * without all this.
 *
 * The origin is a whole number of steps, a power of two and a quarter to a half of the size: short
 * decimals stay exact, and a model that is changed a little keeps its origin.
 *
 * As a box grows by g, the farthest coordinate grows by no more than g: a model that is once no
 * farther than NEAR times its size never gets beyond NEAR + 1 = FAR. So nearly all models stop
 * keeping rests after a few vertices, and the choice depends on the box only, not on the vertices'
 * order.
 *
 * FAR: of random scenes with parts that touch, 41 moved by 3 times their size all look the same as
 * float32, one of 41 moved by 10 times does not, five moved by 25 times.
 *
 * Vertices at (0, 0, 0) do not count: files have them as a filler. */
#include "mesh/wide.h"

#include "base/vec.h"

#include <math.h>
#include <string.h>

static const double NEAR = 7, FAR = 8, VERY_FAR = 1024;

static double size_of(const dp_wide *w) {
    return dp_max(w->max[0] - w->min[0], dp_max(w->max[1] - w->min[1], w->max[2] - w->min[2]));
}

static double farthest(const dp_wide *w, int axis) {
    return dp_max(fabs(w->min[axis]), fabs(w->max[axis]));
}

static void extend(dp_wide *w, const double p[3]) {
    for (int k = 0; k < 3; k++) {
        w->min[k] = w->any ? dp_min(w->min[k], p[k]) : p[k];
        w->max[k] = w->any ? dp_max(w->max[k], p[k]) : p[k];
    }
    w->any = true;
}

static bool is_finite(const float p[3]) {
    return isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]);
}

double dp_float_spacing(double magnitude) {
    int exponent;
    if (!(magnitude > 0)) return 0;
    frexp(magnitude, &exponent);
    return ldexp(1, exponent - 24);
}

void dp_wide_free(dp_wide *wide, const dp_allocator *memory) {
    dp_free(memory, wide->rests);
    wide->rests = NULL;
    wide->rest_count = wide->rests_cap = 0;
}

bool dp_wide_note(dp_wide *wide, size_t vertex, const double position[3], const float rounded[3],
                  const dp_allocator *memory) {
    if (wide->is_near) return true;
    const bool filler = position[0] == 0 && position[1] == 0 && position[2] == 0;
    if (!filler && is_finite(rounded)) {
        extend(wide, position);
        const double limit = NEAR * size_of(wide);
        wide->is_near =
            farthest(wide, 0) <= limit && farthest(wide, 1) <= limit && farthest(wide, 2) <= limit;
    }
    if (wide->is_near) return dp_wide_free(wide, memory), true;
    if (!dp_reserve(memory, &wide->rests, &wide->rests_cap, vertex + 1, sizeof *wide->rests))
        return false;
    for (; wide->rest_count <= vertex; wide->rest_count++)
        memset(wide->rests[wide->rest_count], 0, sizeof *wide->rests);
    for (int k = 0; k < 3; k++) {
        const float rest = dp_wide_rest(position[k], rounded[k]);
        wide->rests[vertex][k] = rest;
        wide->is_cut |= rest != 0;
    }
    return true;
}

/* The whole number of steps next to the middle of an axis of the box. */
static double middle(const dp_wide *w, int axis) {
    int exponent;
    const double mid = w->min[axis] + (w->max[axis] - w->min[axis]) / 2;
    frexp(size_of(w), &exponent);
    const double steps = mid / ldexp(1, exponent - 2);
    if (!(fabs(steps) < 0x1p52)) return mid; /* a point, or as good as one */
    return floor(steps + 0.5) * ldexp(1, exponent - 2);
}

static bool needs_origin(const dp_wide *w, int axis) {
    const double size = size_of(w), far = farthest(w, axis);
    return !w->is_near && size > 0 && far > (w->is_cut ? FAR : VERY_FAR) * size;
}

void dp_wide_settle(dp_wide *wide, float *positions, size_t count, double origin[3],
                    const dp_allocator *memory) {
    for (int k = 0; k < 3; k++) {
        origin[k] = needs_origin(wide, k) ? middle(wide, k) : 0;
        if (origin[k] == 0) continue;
        for (size_t v = 0; v < count; v++) {
            const float rest = v < wide->rest_count ? wide->rests[v][k] : 0;
            float *const p = &positions[3 * v + (size_t)k];
            *p = dp_wide_place(*p, rest, origin[k]);
        }
    }
    dp_wide_free(wide, memory);
}
