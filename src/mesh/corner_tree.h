/* Which corner of a polygon lies in a triangle? Answered without a look at all corners. */
#ifndef DP_MESH_CORNER_TREE_H
#define DP_MESH_CORNER_TREE_H

#include "base/memory.h"
#include "base/vec.h"

/* A polygon seen along its mean normal. */
typedef struct dp_flat {
    const float *const *at; /* position of each corner */
    dp_vec3 u, v;           /* unit vectors in its plane */
} dp_flat;

/* Twice the area of (a, b, c): above 0 where it turns left. */
static inline double dp_flat_side(const dp_flat *f, uint32_t a, uint32_t b, uint32_t c) {
    const dp_vec3 ab = dp_sub(dp_v3f(f->at[b]), dp_v3f(f->at[a]));
    const dp_vec3 ac = dp_sub(dp_v3f(f->at[c]), dp_v3f(f->at[a]));
    return dp_dot(ab, f->u) * dp_dot(ac, f->v) - dp_dot(ab, f->v) * dp_dot(ac, f->u);
}

enum { DP_TREE_LEVELS = 12 };

typedef struct dp_tree_point {
    double x, y;     /* from corner 0, along u and v */
    uint32_t corner; /* one of those that lie here */
    uint32_t count;  /* how many still do */
} dp_tree_point;

typedef struct dp_tree_box {
    double x0, y0, x1, y1; /* of the points that are left; x0 > x1: there are none */
} dp_tree_box;

typedef struct dp_corner_tree {
    dp_flat flat;
    struct dp_tree_item *items; /* while it is built */
    dp_tree_point *points;      /* distinct positions, along a Z-order curve */
    uint32_t *point_of;         /* [corners] */
    dp_tree_box *boxes;         /* [levels]: of 8 points each, of 8 such boxes each, … */
    size_t items_cap, points_cap, point_of_cap, boxes_cap;
    uint32_t count;                  /* of points */
    uint32_t levels;                 /* the last has one box */
    uint32_t first[DP_TREE_LEVELS];  /* box of each level */
    uint32_t length[DP_TREE_LEVELS]; /* boxes of each level */
    double slack;    /* what rounding may make of a distance between points, per unit of length */
    uint64_t visits; /* boxes and points looked at by dp_corner_tree_find since it was built */
} dp_corner_tree;

/* Room for n corners; false when memory is out. */
bool dp_corner_tree_reserve(dp_corner_tree *tree, size_t n, const dp_allocator *memory);
void dp_corner_tree_free(dp_corner_tree *tree, const dp_allocator *memory);
uint64_t dp_corner_tree_bytes(const dp_corner_tree *tree);

/* All n corners; there must be room for them. */
void dp_corner_tree_build(dp_corner_tree *tree, const dp_flat *flat, uint32_t n);

/* A point in the triangle (a, b, c), which turns left, or on its border, but none that lies where
 * one of its corners does; UINT32_MAX: there is none. */
uint32_t dp_corner_tree_find(dp_corner_tree *tree, uint32_t a, uint32_t b, uint32_t c);

/* Takes a corner out. True when its point has no other corner. */
bool dp_corner_tree_remove(dp_corner_tree *tree, uint32_t corner);

#endif
