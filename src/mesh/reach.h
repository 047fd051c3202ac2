/* How far a model reaches in a view: what a camera that shows it whole depends on.
 *
 * All is in the view's axes, counted from `origin`: x to the right, y up, z towards the eye. A plane
 * of slope s that closes the view on the right touches the model where x + s z is largest. */
#ifndef DP_MESH_REACH_H
#define DP_MESH_REACH_H

#include <drypoint/source.h>

#include <stdbool.h>
#include <stddef.h>

enum { DP_REACH_SLOPES = 64, DP_REACH_GROUP = 8, DP_REACH_LEVELS = 64 };

typedef enum dp_reach_side {
    DP_REACH_RIGHT = 0,
    DP_REACH_LEFT,
    DP_REACH_ABOVE,
    DP_REACH_BELOW,
    DP_REACH_SIDES
} dp_reach_side;

typedef struct dp_reach {
    double axis[3][3];                /* x, y and z in world space: unit vectors, perpendicular */
    double origin[3];                 /* world space */
    bool placed;                      /* the origin is known */
    double slope[2][DP_REACH_SLOPES]; /* of planes beside and above: ascending */
    double most[DP_REACH_SIDES]
               [DP_REACH_SLOPES]; /* largest ± x + s z, or ± y + s z; -INFINITY: of nothing */
    double least[DP_REACH_SIDES][DP_REACH_SLOPES / DP_REACH_GROUP]; /* of each group of most */
    double back, front;                                             /* least and largest z */
    /* How far to each side a point may lie and surely change nothing: at z = low + level / scale,
     * and linear between levels. Made now and then from what is known. */
    double limit[DP_REACH_LEVELS + 1][DP_REACH_SIDES];
    double low, scale;
    unsigned late; /* points that passed the limits since */
} dp_reach;

/* The reach of nothing, for planes of slopes between these, beside and above. */
void dp_reach_begin(dp_reach *reach, const double axis[3][3], const double from[2],
                    const double to[2]);

/* Can a point of this box change anything? `min` and `max` count from the origin. */
bool dp_reach_may_grow(const dp_reach *reach, const double min[3], const double max[3]);

static inline double dp_reach_along(const double axis[3], const double p[3]) {
    return axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2];
}

/* Does a point lie inside all limits, and so changes nothing? Never before there are any. */
static inline bool dp_reach_has(const dp_reach *reach, const double point[3]) {
    const double z = dp_reach_along(reach->axis[2], point),
                 height = (z - reach->low) * reach->scale;
    if (!(height > 0 && height < DP_REACH_LEVELS)) return false;
    const double x = dp_reach_along(reach->axis[0], point),
                 y = dp_reach_along(reach->axis[1], point);
    const double share = height - (int)height;
    const double *const a = reach->limit[(int)height], *const b = reach->limit[(int)height + 1];
    double limit[DP_REACH_SIDES];
    for (int side = 0; side < DP_REACH_SIDES; side++)
        limit[side] = a[side] + share * (b[side] - a[side]);
    return (x <= limit[DP_REACH_RIGHT]) & (-x <= limit[DP_REACH_LEFT]) &
           (y <= limit[DP_REACH_ABOVE]) & (-y <= limit[DP_REACH_BELOW]);
}

void dp_reach_add(dp_reach *reach, const double point[3]);

/* Makes limits of what is known: useful after some points from all over the model. */
void dp_reach_set_limits(dp_reach *reach);

/* dp_source_extent, and in the same reading how far what is drawn reaches in a view: polygons that
 * have an area and no bad corner. `reach` has just begun; NULL: only the extent (extent.c). */
dp_result dp_source_measure(dp_source *source, dp_extent *extent, dp_reach *reach, dp_diag *diag);

/* Adds what another one of the same view and origin has. Any order gives the same bits. */
void dp_reach_join(dp_reach *reach, const dp_reach *other);

#endif
