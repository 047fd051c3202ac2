/* A bounding volume hierarchy: a balanced binary tree, split at the median of the triangles'
 * centres along the longest axis.
 *
 * Invariant: node n's box holds all triangles [first, first + count) of the array; an inner node's
 * children are n + 1 and `right`, and halve that range. Balanced, so that 64 levels hold any
 * count. */
#include "rays.h"

#include <stdlib.h>
#include <string.h>

enum { LEAF = 4 /* triangles */, STACK = 64 /* levels */ };

typedef struct node {
    v3 min, max;
    uint32_t first, count;
    uint32_t right; /* 0: a leaf */
} node;

struct rays {
    rays_triangle *triangles;
    node *nodes;
    uint32_t node_count;
};

static v3 centre_of(const rays_triangle *t) /* times three */
{
    return v3_add(v3_add(t->corner[0], t->corner[1]), t->corner[2]);
}

/* Orders [first, first + count) around its middle by the centres' coordinate (quickselect). */
static void halve(rays_triangle *t, size_t count, int axis) {
    const size_t middle = count / 2;
    size_t low = 0, high = count - 1;
    while (low < high) {
        const double pivot = v3_axis(centre_of(&t[low + (high - low) / 2]), axis);
        size_t i = low, j = high;
        for (;;) {
            while (v3_axis(centre_of(&t[i]), axis) < pivot) i++;
            while (v3_axis(centre_of(&t[j]), axis) > pivot) j--;
            if (i >= j) break;
            const rays_triangle swap = t[i];
            t[i++] = t[j];
            t[j--] = swap;
        }
        if (middle <= j)
            high = j;
        else
            low = j + 1;
    }
}

static uint32_t grow(rays *set, uint32_t first, uint32_t count) {
    const uint32_t self = set->node_count++;
    rays_triangle *t = set->triangles + first;
    node made = {.min = {INFINITY, INFINITY, INFINITY},
                 .max = {-INFINITY, -INFINITY, -INFINITY},
                 .first = first,
                 .count = count};
    v3 low = made.min, high = made.max; /* of the centres */
    for (uint32_t i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            made.min = v3_min(made.min, t[i].corner[k]);
            made.max = v3_max(made.max, t[i].corner[k]);
        }
        low = v3_min(low, centre_of(&t[i]));
        high = v3_max(high, centre_of(&t[i]));
    }
    if (count > LEAF) {
        const v3 size = v3_sub(high, low);
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        halve(t, count, axis);
        grow(set, first, count / 2);
        made.right = grow(set, first + count / 2, count - count / 2);
    }
    set->nodes[self] = made;
    return self;
}

rays *rays_create(const rays_triangle *triangles, size_t count) {
    rays *set = calloc(1, sizeof *set);
    if (set == NULL || count > UINT32_MAX / 2) abort();
    set->triangles = malloc((count + 1) * sizeof *set->triangles);
    set->nodes = malloc((2 * count + 1) * sizeof *set->nodes);
    if (set->triangles == NULL || set->nodes == NULL) abort();
    if (count > 0) memcpy(set->triangles, triangles, count * sizeof *triangles);
    grow(set, 0, (uint32_t)count);
    return set;
}

void rays_destroy(rays *set) {
    if (set == NULL) return;
    free(set->triangles);
    free(set->nodes);
    free(set);
}

/* Möller and Trumbore, edges included, so that no ray slips between two triangles. */
static double meet(const rays_triangle *t, v3 from, v3 direction) {
    const double edge = 1e-9; /* of the barycentric coordinates; doubles err by 1e-13 or so */
    const v3 a = v3_sub(t->corner[1], t->corner[0]), b = v3_sub(t->corner[2], t->corner[0]);
    const v3 p = v3_cross(direction, b);
    const double det = v3_dot(a, p);
    if (det == 0) return INFINITY;
    const v3 s = v3_sub(from, t->corner[0]);
    const double u = v3_dot(s, p) / det;
    if (!(u >= -edge && u <= 1 + edge)) return INFINITY;
    const v3 q = v3_cross(s, a);
    const double v = v3_dot(direction, q) / det;
    if (!(v >= -edge && u + v <= 1 + edge)) return INFINITY;
    return v3_dot(b, q) / det;
}

/* Whether the ray meets the box in (near, far). Division by a zero component gives infinities, and
 * 0 / 0 a NaN that fmin and fmax pass over. */
static bool enters(const node *n, v3 from, v3 inverse, double near, double far) {
    for (int axis = 0; axis < 3; axis++) {
        const double f = v3_axis(from, axis), i = v3_axis(inverse, axis);
        const double t0 = (v3_axis(n->min, axis) - f) * i, t1 = (v3_axis(n->max, axis) - f) * i;
        near = fmax(near, fmin(t0, t1));
        far = fmin(far, fmax(t0, t1));
    }
    return near <= far * (1 + 1e-12) + 1e-300;
}

static double cast(const rays *set, v3 from, v3 direction, double near, double far,
                   const uint32_t skip[2], bool any) {
    const v3 inverse = {1 / direction.x, 1 / direction.y, 1 / direction.z};
    uint32_t stack[STACK];
    int depth = 0;
    double best = INFINITY;
    stack[depth++] = 0;
    while (depth > 0) {
        const uint32_t self = stack[--depth];
        const node *n = &set->nodes[self];
        if (!enters(n, from, inverse, near, fmin(far, best))) continue;
        if (n->right != 0) {
            stack[depth++] = n->right;
            stack[depth++] = self + 1;
            continue;
        }
        for (uint32_t i = n->first; i < n->first + n->count; i++) {
            const rays_triangle *t = &set->triangles[i];
            if (t->owner == skip[0] || t->owner == skip[1]) continue;
            const double distance = meet(t, from, direction);
            if (distance > near && distance < far && distance < best) best = distance;
        }
        if (any && best < INFINITY) break;
    }
    return best;
}

double rays_nearest(const rays *set, v3 from, v3 direction, double near, double far, uint32_t skip0,
                    uint32_t skip1) {
    return cast(set, from, direction, near, far, (const uint32_t[]){skip0, skip1}, false);
}

bool rays_blocked(const rays *set, v3 from, v3 direction, double near, double far, uint32_t skip0,
                  uint32_t skip1) {
    return cast(set, from, direction, near, far, (const uint32_t[]){skip0, skip1}, true) < INFINITY;
}

static bool boxes_meet(v3 min, v3 max, v3 low, v3 high) {
    return min.x <= high.x && max.x >= low.x && min.y <= high.y && max.y >= low.y &&
           min.z <= high.z && max.z >= low.z;
}

void rays_overlaps(const rays *set, v3 min, v3 max,
                   bool (*visit)(void *user, const rays_triangle *triangle), void *user) {
    uint32_t stack[STACK];
    int depth = 0;
    stack[depth++] = 0;
    while (depth > 0) {
        const uint32_t self = stack[--depth];
        const node *n = &set->nodes[self];
        if (!boxes_meet(min, max, n->min, n->max)) continue;
        if (n->right != 0) {
            stack[depth++] = n->right;
            stack[depth++] = self + 1;
            continue;
        }
        for (uint32_t i = n->first; i < n->first + n->count; i++) {
            const v3 *c = set->triangles[i].corner;
            if (boxes_meet(min, max, v3_min(c[0], v3_min(c[1], c[2])),
                           v3_max(c[0], v3_max(c[1], c[2]))) &&
                !visit(user, &set->triangles[i]))
                return;
        }
    }
}
