/* The fold two polygons make at an edge: normals and dihedral angle, in double precision. */
#ifndef DP_CORE_FOLD_H
#define DP_CORE_FOLD_H

#include "core/outline.h"
#include "core/spine.h"

typedef struct dp_fold {
    dp_vec3 normal_a, normal_b; /* unit */
    dp_vec3 normal;             /* their mean, unit: points away from the surface */
    bool concave;
} dp_fold;

/* The fold of frame polygons a and b, which share b's edge number `edge_b`. The normal of a polygon
 * that is not `as_wound` is reversed. */
dp_fold dp_fold_seen(const dp_frame *frame, uint32_t a, bool a_as_wound, uint32_t b,
                     bool b_as_wound, uint32_t edge_b);

/* The same from known normals and their mean. */
dp_fold dp_fold_between(const dp_frame *frame, dp_vec3 normal_a, dp_vec3 normal_b, dp_vec3 normal,
                        uint32_t b, uint32_t edge_b);

/* The same for polygons that share no corner; `at` is a point of the edge where they meet. */
dp_fold dp_fold_at(const dp_frame *frame, uint32_t a, bool a_as_wound, uint32_t b, bool b_as_wound,
                   dp_vec3 at);

/* Degrees: 180 is flat, less is convex (Raskar 2001, 2.2). */
double dp_fold_dihedral(const dp_fold *fold);

/* DP_LINE_RIDGE, DP_LINE_VALLEY, or -1 for neither. */
int dp_fold_line(const dp_fold *fold, const dp_style *style);

#endif
