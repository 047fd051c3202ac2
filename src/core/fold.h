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

/* An edge as the eye sees it. The plane through it and the eye parts what lies to its left, seen
 * along the edge, from what lies to its right. */
typedef struct dp_sight {
    dp_vec3 along, right, away; /* unit, each perpendicular to the others; away from the eye */
} dp_sight;

/* The sight of the edge from a to b (world space). False: it is seen end on. */
bool dp_sight_make(const dp_view *view, dp_vec3 a, dp_vec3 b, dp_sight *sight);

/* A surface beside an edge: its unit normal, turned to the eye, and how steeply it recedes from the
 * eye to the right of the edge; to the left it recedes by as much less. */
typedef struct dp_beside {
    dp_vec3 normal;
    double recedes; /* a length along the line of sight over one across it */
} dp_beside;

/* Of a polygon that does not face the eye `as_wound` the normal is reversed. */
dp_beside dp_beside_edge(const dp_frame *frame, const dp_sight *sight, uint32_t polygon,
                         bool as_wound);

/* The fold of the surfaces to the left and to the right of an edge. */
dp_fold dp_fold_of_sides(const dp_sight *sight, const dp_beside *left, const dp_beside *right);

/* Are the two parts of one plane, as far as float32 coordinates tell? */
bool dp_is_one_plane(const dp_beside *a, const dp_beside *b);

/* Where an outline's surface ends: the mean of the normal of the nearest surface, which looks to
 * the eye, and of that of the one furthest behind it on the same side, which looks away. `right`:
 * they lie to the right. */
dp_vec3 dp_outline_normal(const dp_sight *sight, const dp_beside *nearest, const dp_beside *behind,
                          bool right);

/* The mean of the normals of two polygons as they are wound, unit; zero where a sheet is folded flat:
 * such an edge is not lifted, and ends where the edge itself does. */
dp_vec3 dp_pair_normal(const dp_frame *frame, uint32_t a, uint32_t b);

/* Are its polygons folded flat onto each other, so that their normals have no mean? */
bool dp_fold_is_flat(const dp_fold *fold);

/* Degrees: 180 is flat, less is convex (Raskar 2001, 2.2). */
double dp_fold_dihedral(const dp_fold *fold);

/* DP_LINE_RIDGE, DP_LINE_VALLEY, or -1 for neither. */
int dp_fold_line(const dp_fold *fold, const dp_style *style);

#endif
