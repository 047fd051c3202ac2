/* How far a model reaches in a view: what a camera that shows it whole depends on.
 *
 * All is in the view's axes, counted from `origin`: x to the right, y up, z towards the eye. A plane
 * of slope s that closes the view on the right touches the model where x + s z is largest. */
#ifndef DP_MESH_REACH_H
#define DP_MESH_REACH_H

#include <stdbool.h>
#include <stddef.h>

enum { DP_REACH_SLOPES = 64, DP_REACH_GROUP = 8 };

typedef enum dp_reach_side {
    DP_REACH_RIGHT = 0,
    DP_REACH_LEFT,
    DP_REACH_ABOVE,
    DP_REACH_BELOW,
    DP_REACH_SIDES
} dp_reach_side;

typedef struct dp_reach {
    double axis[3][3]; /* x, y and z in world space: unit vectors, perpendicular */
    double origin[3];  /* world space */
    bool placed;       /* the origin is known */
    double slope[2][DP_REACH_SLOPES]; /* of planes beside and above: ascending, from 0 */
    double most[DP_REACH_SIDES]
               [DP_REACH_SLOPES]; /* largest ± x + s z, or ± y + s z; -INFINITY: of nothing */
    double least[DP_REACH_SIDES][DP_REACH_SLOPES / DP_REACH_GROUP]; /* of each group of most */
    double back, front;                                            /* least and largest z */
} dp_reach;

/* The reach of nothing, for planes up to these slopes, the tangents of half the view's angles; 0 for
 * an orthographic view. */
void dp_reach_begin(dp_reach *reach, const double axis[3][3], double slope_x, double slope_y);

/* Can a point of this box change anything? `min` and `max` count from the origin. */
bool dp_reach_may_grow(const dp_reach *reach, const double min[3], const double max[3]);

void dp_reach_add(dp_reach *reach, const double point[3]);

/* Adds what another one of the same view and origin has. Any order gives the same bits. */
void dp_reach_join(dp_reach *reach, const dp_reach *other);

#endif
