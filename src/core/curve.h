/* Into how many parts the curve over an edge is cut. */
#ifndef DP_CORE_CURVE_H
#define DP_CORE_CURVE_H

#include "core/view.h"
#include "mesh/pn.h"
#include <drypoint/style.h>

/* The edge from a to b. With curve NULL its parts alone are asked for. It is 1, and the curve
 * straight, where that is what the picture shows. */
typedef struct dp_curve_rule {
    const dp_view *view;
    dp_smoothing what;
    uint32_t level; /* 0: by size on the screen */
} dp_curve_rule;

/* Depends on the edge's ends and their normals alone, and not on its direction. Fills *curve, which
 * is straight where only silhouettes are curved and the edge does not lie near any. */
uint32_t dp_curve_parts(const dp_curve_rule *rule, dp_vec3 a, dp_vec3 b, const dp_pn_end ends[2],
                        dp_pn_edge *curve);

#endif
