/* How far a model reaches in a view.
 *
 * For each of the view's four sides, what is kept is the support function of the model at a row of
 * slopes: the largest x + s z, and so on. The steepest slope is the side plane's own, so it gives
 * the eye exactly; the others tell where the model lies between two planes, once the eye is known
 * (core/fit.c). Only maxima are kept, so neither order nor threads change a bit.
 *
 * Nearly all of a model lies inside what has been seen of it. A point changes nothing if x is at most
 * the least of max (x + s z) - s z over all slopes. That limit is a concave function of z, so what
 * is linear between its values at some levels of z lies below it, and is a limit as well.
 *
 * For a box, x + s z is linear in s at its farthest corner, hence at most its larger value at the
 * two ends of a group of slopes; where that is no more than the least of the group's maxima, the box
 * changes none of them. */
#include "mesh/reach.h"

#include "base/elementary.h"
#include "base/vec.h"

#include <string.h>

enum {
    GROUPS = DP_REACH_SLOPES / DP_REACH_GROUP,
    LATE_MOST = 256 /* points: as much work as making limits */
};

/* Slopes of planes that are equal angles apart. */
static void fill_slopes(double from, double to, double slope[DP_REACH_SLOPES]) {
    const double angle = dp_atan(from), step = (dp_atan(to) - angle) / (DP_REACH_SLOPES - 1);
    for (int j = 0; j < DP_REACH_SLOPES; j++) slope[j] = dp_tan(angle + step * j);
    slope[0] = from, slope[DP_REACH_SLOPES - 1] = to;
}

void dp_reach_begin(dp_reach *reach, const double axis[3][3], const double from[2],
                    const double to[2]) {
    *reach = (dp_reach){.back = INFINITY, .front = -INFINITY};
    memcpy(reach->axis, axis, sizeof reach->axis);
    for (int k = 0; k < 2; k++) fill_slopes(from[k], to[k], reach->slope[k]);
    for (int side = 0; side < DP_REACH_SIDES; side++) {
        for (int j = 0; j < DP_REACH_SLOPES; j++) reach->most[side][j] = -INFINITY;
        for (int g = 0; g < GROUPS; g++) reach->least[side][g] = -INFINITY;
    }
}

/* Beyond the rounding of limits and of boxes: a share of all the lengths that went into them. */
static const double SLACK = 1e-12;

static double least_limit(const double *most, const double *slope, double z) {
    double limit = INFINITY, length = fabs(z) * (1 + slope[DP_REACH_SLOPES - 1]);
    for (int j = 0; j < DP_REACH_SLOPES; j++) {
        limit = dp_min(most[j] - slope[j] * z, limit);
        length = dp_max(fabs(most[j]), length);
    }
    return limit - SLACK * length;
}

void dp_reach_set_limits(dp_reach *reach) {
    reach->late = 0;
    if (!(reach->front > reach->back)) return;
    reach->low = reach->back;
    reach->scale = DP_REACH_LEVELS / (reach->front - reach->back);
    for (int level = 0; level <= DP_REACH_LEVELS; level++)
        for (int side = 0; side < DP_REACH_SIDES; side++)
            reach->limit[level][side] = least_limit(reach->most[side], reach->slope[side / 2],
                                                    reach->low + level / reach->scale);
}

/* Can a point `across` to this side and `z` towards the eye change a group's maxima? */
static bool grows(const dp_reach *reach, int side, int group, double across, double z) {
    const double *const slope = &reach->slope[side / 2][group * DP_REACH_GROUP];
    const double at = across + dp_max(slope[0] * z, slope[DP_REACH_GROUP - 1] * z);
    return !(at <= reach->least[side][group]);
}

/* Half a box's size along an axis, and some: beyond the rounding of its points. */
static double half_along(const double axis[3], const double half[3], double slack) {
    return fabs(axis[0]) * half[0] + fabs(axis[1]) * half[1] + fabs(axis[2]) * half[2] + slack;
}

bool dp_reach_may_grow(const dp_reach *reach, const double min[3], const double max[3]) {
    double centre[3], half[3], slack = 0;
    for (int k = 0; k < 3; k++) {
        half[k] = (max[k] - min[k]) / 2, centre[k] = min[k] + half[k];
        slack += SLACK * (fabs(min[k]) + fabs(max[k]));
    }
    double at[3], size[3];
    for (int k = 0; k < 3; k++) {
        at[k] = dp_reach_along(reach->axis[k], centre);
        size[k] = half_along(reach->axis[k], half, slack);
    }
    const double front = at[2] + size[2];
    if (!(front <= reach->front) || !(at[2] - size[2] >= reach->back)) return true;
    for (int side = 0; side < DP_REACH_SIDES; side++) {
        const int axis = side / 2;
        const double across = (side % 2 ? -at[axis] : at[axis]) + size[axis];
        for (int group = 0; group < GROUPS; group++)
            if (grows(reach, side, group, across, front)) return true;
    }
    return false;
}

static void grow(dp_reach *reach, int side, int group, double across, double z) {
    const int first = group * DP_REACH_GROUP;
    const double *const slope = &reach->slope[side / 2][first];
    double *const most = &reach->most[side][first];
    double least = INFINITY;
    for (int j = 0; j < DP_REACH_GROUP; j++) {
        most[j] = dp_max(across + slope[j] * z, most[j]);
        least = dp_min(most[j], least);
    }
    reach->least[side][group] = least;
}

void dp_reach_add(dp_reach *reach, const double point[3]) {
    double at[3];
    for (int k = 0; k < 3; k++) at[k] = dp_reach_along(reach->axis[k], point);
    reach->front = dp_max(at[2], reach->front);
    reach->back = dp_min(at[2], reach->back);
    for (int side = 0; side < DP_REACH_SIDES; side++) {
        const double across = side % 2 ? -at[side / 2] : at[side / 2];
        for (int group = 0; group < GROUPS; group++)
            if (grows(reach, side, group, across, at[2])) grow(reach, side, group, across, at[2]);
    }
    if (++reach->late == LATE_MOST) dp_reach_set_limits(reach);
}

void dp_reach_join(dp_reach *reach, const dp_reach *other) {
    reach->front = dp_max(other->front, reach->front);
    reach->back = dp_min(other->back, reach->back);
    for (int side = 0; side < DP_REACH_SIDES; side++)
        for (int j = 0; j < DP_REACH_SLOPES; j++) {
            double *const least = &reach->least[side][j / DP_REACH_GROUP];
            const double most = dp_max(other->most[side][j], reach->most[side][j]);
            reach->most[side][j] = most;
            *least = j % DP_REACH_GROUP ? dp_min(most, *least) : most;
        }
}
