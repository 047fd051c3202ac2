/* Takes folds out of a path: where it turns back on itself and goes on beside what is drawn already, a
 * pen would draw the same line two or three times.
 *
 *     a---------b      a, b, c, d with b and c within FOLDED px of the other line:
 *         c===========d    the path goes straight from a to d
 *     1====0, 1------2     a first point that lies on the next line is left out; so is a last one
 *
 * Outlines of fine meshes and ends of contours fold so, by less than what visibility leaves open.
 * One pass with a stack: each point is put on it once, and taken off once at most. Invariant: no line
 * moves by more than FOLDED px. Not handled: folds that overlap others, tips that nothing goes on
 * from. */
#include "vector/clean.h"

#include <math.h>

static const double FOLDED = 0.1; /* px: what sample points are lifted by (core/spine.h) */

/* Does p lie on the way from a to b, or within FOLDED px of it? */
static bool lies_on(const dp_path_point *p, const dp_path_point *a, const dp_path_point *b) {
    const double ux = (double)b->x - (double)a->x, uy = (double)b->y - (double)a->y,
                 px = (double)p->x - (double)a->x, py = (double)p->y - (double)a->y;
    const double length = sqrt(ux * ux + uy * uy), along = (px * ux + py * uy) / length;
    return length > 0 && fabs(px * uy - py * ux) <= FOLDED * length && along >= -FOLDED &&
           along <= length + FOLDED;
}

static bool turns_back(const dp_path_point *a, const dp_path_point *b, const dp_path_point *c) {
    const double ux = (double)b->x - (double)a->x, uy = (double)b->y - (double)a->y,
                 vx = (double)c->x - (double)b->x, vy = (double)c->y - (double)b->y;
    return ux * vx + uy * vy < 0;
}

/* Do the last four points make a fold? */
static bool is_fold(const dp_path_point *end) {
    const dp_path_point *const a = end - 4, *const b = end - 3, *const c = end - 2,
                               *const d = end - 1;
    return turns_back(a, b, c) && turns_back(b, c, d) && lies_on(c, a, b) && lies_on(b, c, d);
}

size_t dp_unfold(dp_path_point *points, size_t count, bool closed, bool moved[2]) {
    size_t kept = 0;
    moved[0] = moved[1] = false;
    for (size_t i = 0; i < count; i++) {
        points[kept++] = points[i];
        while (kept >= 4 && is_fold(points + kept)) {
            points[kept - 3] = points[kept - 1];
            kept -= 2;
        }
        if (closed || kept != 3 || !turns_back(&points[0], &points[1], &points[2]) ||
            !lies_on(&points[0], &points[1], &points[2]))
            continue;
        points[0] = points[1], points[1] = points[2];
        kept = 2, moved[0] = true;
    }
    while (!closed && kept >= 3 &&
           turns_back(&points[kept - 3], &points[kept - 2], &points[kept - 1]) &&
           lies_on(&points[kept - 1], &points[kept - 3], &points[kept - 2])) {
        points[kept - 2].polygon = UINT64_MAX, points[kept - 2].edge = UINT32_MAX;
        kept--, moved[1] = true;
    }
    return kept;
}
