/* A tree of boxes over the corners of one polygon.
 *
 * Corners of the same position are one point. Points are sorted along a Z-order curve; eight that
 * follow each other share a box, eight such boxes a larger one, and so on up to a single one.
 * Invariant: a box is the smallest around the points below it that are left, so what is cut off
 * costs no look-ups any more. A triangle's look-up goes down only into boxes that it may reach;
 * points are then tested exactly as a plain loop over all corners would (dp_flat_side). */
#include "mesh/corner_tree.h"

#include "base/sort.h"

#include <string.h>

enum { FAN = 8 }; /* points of a lowest box, and boxes of a higher one */

typedef struct dp_tree_item {
    uint64_t code; /* place on the curve */
    float at[3];
    uint32_t corner;
} dp_tree_item;

static const dp_array arrays[] = {
    DP_ARRAY(dp_corner_tree, items, items_cap), DP_ARRAY(dp_corner_tree, points, points_cap),
    DP_ARRAY(dp_corner_tree, point_of, point_of_cap), DP_ARRAY(dp_corner_tree, boxes, boxes_cap)};

bool dp_corner_tree_reserve(dp_corner_tree *t, size_t n, const dp_allocator *memory) {
    const size_t boxes = n / (FAN - 1) + DP_TREE_LEVELS; /* n/8 + n/64 + …, each rounded up */
    return dp_reserve(memory, &t->items, &t->items_cap, n, sizeof *t->items) &&
           dp_reserve(memory, &t->points, &t->points_cap, n, sizeof *t->points) &&
           dp_reserve(memory, &t->point_of, &t->point_of_cap, n, sizeof *t->point_of) &&
           dp_reserve(memory, &t->boxes, &t->boxes_cap, boxes, sizeof *t->boxes);
}

void dp_corner_tree_free(dp_corner_tree *tree, const dp_allocator *memory) {
    dp_arrays_free(memory, tree, DP_ARRAYS(arrays));
}

uint64_t dp_corner_tree_bytes(const dp_corner_tree *tree) {
    return dp_arrays_bytes(tree, DP_ARRAYS(arrays));
}

/* ------- boxes ------- */

static const dp_tree_box nothing = {INFINITY, INFINITY, -INFINITY, -INFINITY};

static void include(dp_tree_box *box, double x0, double y0, double x1, double y1) {
    box->x0 = dp_min(x0, box->x0), box->y0 = dp_min(y0, box->y0);
    box->x1 = dp_max(x1, box->x1), box->y1 = dp_max(y1, box->y1);
}

/* The box with number `index` on a level, from what lies below it. */
static dp_tree_box box_of(const dp_corner_tree *t, uint32_t level, uint32_t index) {
    dp_tree_box box = nothing;
    const uint32_t all = level ? t->length[level - 1] : t->count, from = FAN * index;
    const uint32_t to = all - from < FAN ? all : from + FAN;
    for (uint32_t i = from; i < to; i++) {
        if (level) {
            const dp_tree_box *const b = &t->boxes[t->first[level - 1] + i];
            include(&box, b->x0, b->y0, b->x1, b->y1);
        } else if (t->points[i].count) {
            include(&box, t->points[i].x, t->points[i].y, t->points[i].x, t->points[i].y);
        }
    }
    return box;
}

static void build_boxes(dp_corner_tree *t) {
    uint32_t below = t->count, first = 0;
    t->levels = 0;
    do {
        const uint32_t level = t->levels++;
        t->first[level] = first;
        t->length[level] = (below + FAN - 1) / FAN;
        for (uint32_t i = 0; i < t->length[level]; i++) t->boxes[first + i] = box_of(t, level, i);
        below = t->length[level];
        first += below;
    } while (below > 1);
}

/* ------- points ------- */

/* Bits of x at the even places. */
static uint64_t spread(uint64_t x) {
    x = (x | x << 16) & 0x0000ffff0000ffff;
    x = (x | x << 8) & 0x00ff00ff00ff00ff;
    x = (x | x << 4) & 0x0f0f0f0f0f0f0f0f;
    x = (x | x << 2) & 0x3333333333333333;
    return (x | x << 1) & 0x5555555555555555;
}

/* Equal positions are neighbours then. */
static int by_place(const void *left, const void *right) {
    const dp_tree_item *const a = left, *const b = right;
    if (a->code != b->code) return a->code < b->code ? -1 : 1;
    for (int k = 0; k < 3; k++)
        if (a->at[k] != b->at[k]) return a->at[k] < b->at[k] ? -1 : 1;
    return a->corner < b->corner ? -1 : a->corner > b->corner;
}

static dp_vec3 from_first(const dp_flat *f, uint32_t corner) {
    return dp_sub(dp_v3f(f->at[corner]), dp_v3f(f->at[0]));
}

static void sort_corners(dp_corner_tree *t, uint32_t n) {
    const dp_flat *const f = &t->flat;
    dp_tree_box all = nothing;
    double furthest = 0;
    for (uint32_t i = 0; i < n; i++) {
        const dp_vec3 p = from_first(f, i);
        const double x = dp_dot(p, f->u), y = dp_dot(p, f->v);
        include(&all, x, y, x, y);
        furthest = dp_max(furthest, dp_length(p));
    }
    const double size = dp_max(all.x1 - all.x0, all.y1 - all.y0);
    const double scale = size > 0 ? UINT32_MAX / size : 0;
    for (uint32_t i = 0; i < n; i++) {
        const dp_vec3 p = from_first(f, i);
        const uint64_t x = (uint64_t)((dp_dot(p, f->u) - all.x0) * scale),
                       y = (uint64_t)((dp_dot(p, f->v) - all.y0) * scale);
        t->items[i] = (dp_tree_item){.code = spread(x & UINT32_MAX) | spread(y & UINT32_MAX) << 1,
                                     .corner = i};
        memcpy(t->items[i].at, f->at[i], sizeof t->items[i].at);
    }
    dp_sort(t->items, n, sizeof *t->items, by_place);
    /* coordinates and sides come of some ten roundings of numbers that are not larger */
    t->slack = 64 * 0x1p-53 * furthest;
}

static bool same_place(const dp_tree_item *a, const dp_tree_item *b) {
    return a->at[0] == b->at[0] && a->at[1] == b->at[1] && a->at[2] == b->at[2];
}

void dp_corner_tree_build(dp_corner_tree *t, const dp_flat *flat, uint32_t n) {
    t->flat = *flat;
    t->count = 0;
    t->visits = 0;
    sort_corners(t, n);
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t corner = t->items[i].corner;
        if (!i || !same_place(&t->items[i - 1], &t->items[i])) {
            const dp_vec3 p = from_first(flat, corner);
            t->points[t->count++] =
                (dp_tree_point){dp_dot(p, flat->u), dp_dot(p, flat->v), corner, 0};
        }
        t->points[t->count - 1].count++;
        t->point_of[corner] = t->count - 1;
    }
    build_boxes(t);
}

bool dp_corner_tree_remove(dp_corner_tree *t, uint32_t corner) {
    uint32_t index = t->point_of[corner];
    if (--t->points[index].count) return false;
    for (uint32_t level = 0; level < t->levels; level++) {
        index /= FAN;
        dp_tree_box *const box = &t->boxes[t->first[level] + index];
        const dp_tree_box now = box_of(t, level, index);
        if (!memcmp(box, &now, sizeof now)) break;
        *box = now;
    }
    return true;
}

/* ------- look-up ------- */

/* A triangle in the plane. A point is beyond edge i where nx * x + ny * y < least. */
typedef struct probe {
    uint32_t corner[3], own[3]; /* its corners, and their points */
    double nx[3], ny[3], least[3];
    dp_tree_box box;
} probe;

/* Of a triangle whose area is rounding, the exact test may take any point of its line for one in
 * it; the box is then no limit. */
static bool is_needle(const dp_corner_tree *t, const probe *p) {
    double around = 0;
    for (int i = 0; i < 3; i++) around += fabs(p->nx[i]) + fabs(p->ny[i]);
    return dp_flat_side(&t->flat, p->corner[0], p->corner[1], p->corner[2]) < 4 * t->slack * around;
}

static probe make_probe(const dp_corner_tree *t, uint32_t a, uint32_t b, uint32_t c) {
    probe p = {.corner = {a, b, c}, .box = nothing};
    for (int i = 0; i < 3; i++) p.own[i] = t->point_of[p.corner[i]];
    for (int i = 0; i < 3; i++) {
        const dp_tree_point *const from = &t->points[p.own[i]], *const to =
                                                                    &t->points[p.own[(i + 1) % 3]];
        p.nx[i] = from->y - to->y, p.ny[i] = to->x - from->x;
        p.least[i] =
            p.nx[i] * from->x + p.ny[i] * from->y - t->slack * (fabs(p.nx[i]) + fabs(p.ny[i]));
        include(&p.box, from->x - t->slack, from->y - t->slack, from->x + t->slack,
                from->y + t->slack);
    }
    if (is_needle(t, &p)) p.box = (dp_tree_box){-INFINITY, -INFINITY, INFINITY, INFINITY};
    return p;
}

/* May the triangle reach the box? */
static bool reaches(const probe *p, const dp_tree_box *b) {
    if (b->x0 > b->x1 || b->x0 > p->box.x1 || b->x1 < p->box.x0 || b->y0 > p->box.y1 ||
        b->y1 < p->box.y0)
        return false;
    for (int i = 0; i < 3; i++)
        if (p->nx[i] * (p->nx[i] > 0 ? b->x1 : b->x0) + p->ny[i] * (p->ny[i] > 0 ? b->y1 : b->y0) <
            p->least[i])
            return false;
    return true;
}

static bool holds(const dp_corner_tree *t, const probe *p, uint32_t point) {
    const dp_tree_point *const at = &t->points[point];
    const dp_tree_box box = {at->x, at->y, at->x, at->y};
    if (!at->count || point == p->own[0] || point == p->own[1] || point == p->own[2] ||
        !reaches(p, &box))
        return false;
    for (int i = 0; i < 3; i++)
        if (!(dp_flat_side(&t->flat, p->corner[i], p->corner[(i + 1) % 3], at->corner) >= 0))
            return false;
    return true;
}

/* Goes through the boxes from first to last, down into those that the triangle may reach. */
uint32_t dp_corner_tree_find(dp_corner_tree *t, uint32_t a, uint32_t b, uint32_t c) {
    const probe p = make_probe(t, a, b, c);
    uint32_t level = t->levels - 1, index = 0;
    for (;;) {
        t->visits++;
        if (reaches(&p, &t->boxes[t->first[level] + index])) {
            if (level) {
                level--, index *= FAN;
                continue;
            }
            for (uint32_t i = FAN * index; i < t->count && i < FAN * (index + 1); i++)
                if (holds(t, &p, i)) return i;
        }
        /* on to the next box on this level, or where that has no more of this parent's, above */
        while (++index % FAN == 0 || index == t->length[level]) {
            if (++level >= t->levels) return UINT32_MAX;
            index = (index - 1) / FAN;
        }
    }
}
