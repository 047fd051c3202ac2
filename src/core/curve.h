/* Into how many parts the curve over an edge is cut. */
#ifndef DP_CORE_CURVE_H
#define DP_CORE_CURVE_H

#include "core/view.h"
#include "mesh/pn.h"
#include <drypoint/style.h>

typedef struct dp_curve_rule {
    const dp_view *view;
    dp_smoothing what;
    uint32_t level; /* 0: by size on the screen */
} dp_curve_rule;

/* Depends on the edge's ends and their normals alone, and not on its direction. Fills *curve, which
 * is straight where only silhouettes are curved and the edge does not lie near any. */
uint32_t dp_curve_parts(const dp_curve_rule *rule, dp_vec3 a, dp_vec3 b, const dp_pn_end ends[2],
                        dp_pn_edge *curve);

/* Length between unit normals: the least turn along an edge that is looked at. */
#define DP_CURVE_LEAST_TURN 0.02

/* Cosine between the line of sight, from the eye on, and a normal. */
static inline double dp_curve_facing(const dp_view *view, dp_vec3 at, dp_vec3 normal) {
    return dp_dot(dp_view_vector(view, at), normal);
}

/* Is an edge with one normal at each end far from silhouettes, and so straight where only those are
 * curved? From its ends' facing, rounded as it may be; dp_curve_parts, which takes longer, agrees but where
 * rounding decides. */
static inline bool dp_curve_is_far(dp_vec3 normal_a, double facing_a, dp_vec3 normal_b,
                                   double facing_b) {
    const dp_vec3 turn = dp_sub(normal_a, normal_b);
    const double least = dp_min(fabs(facing_a), fabs(facing_b));
    return facing_a * facing_b > 0 && least > DP_CURVE_LEAST_TURN &&
           least * least > dp_dot(turn, turn);
}

#endif
