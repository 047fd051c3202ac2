/* Leaves points out of a path where it stays as near to them as is asked for.
 *
 *     from an anchor go on while the next point lies in the wedge: the directions in which a line
 *     from the anchor passes all points between within the tolerance
 *     where it does not, or the path turns back, the point before is kept, and is the next anchor
 *
 * (Williams 1978; Sklansky and Gonzalez 1980.) Each point is looked at twice at most. A closed path
 * begins at its sharpest corner, which is moved to the front first. Invariant: points that are kept
 * are as they were, so corners sharper than the tolerance stay where they are. Not handled: fewest
 * points; the wedge may stop a little early. */
#include "vector/clean.h"

#include <math.h>

typedef struct vec {
    double x, y;
} vec;

static vec between(const dp_path_point *a, const dp_path_point *b) {
    return (vec){(double)b->x - (double)a->x, (double)b->y - (double)a->y};
}

static double cross(vec a, vec b) { return a.x * b.y - a.y * b.x; }
static double dot(vec a, vec b) { return a.x * b.x + a.y * b.y; }

/* Between which directions the line may leave the anchor. */
typedef struct wedge {
    bool any; /* no point has narrowed it */
    vec low, high;
    double reach; /* px, of the farthest point from the anchor */
} wedge;

static bool holds(const wedge *w, vec v) {
    return !w->any || (cross(w->low, v) >= 0 && cross(w->high, v) <= 0 && dot(w->low, v) > 0);
}

/* The directions that pass a point at v from the anchor within the tolerance. */
static void narrow(wedge *w, vec v, double tolerance) {
    const double length = sqrt(dot(v, v));
    w->reach = dp_max(w->reach, length);
    if (!(length > tolerance)) return; /* all do */
    const double s = tolerance / length, c = sqrt(1 - s * s);
    const vec low = {c * v.x + s * v.y, c * v.y - s * v.x},
              high = {c * v.x - s * v.y, c * v.y + s * v.x};
    if (!w->any || cross(w->low, low) > 0) w->low = low;
    if (!w->any || cross(w->high, high) < 0) w->high = high;
    w->any = true;
}

/* May the path go straight from the anchor to the point after this one? */
static bool may_skip(wedge *w, const dp_path_point *anchor, const dp_path_point *point,
                     const dp_path_point *next, double tolerance) {
    const vec v = between(anchor, point), to = between(anchor, next);
    narrow(w, v, tolerance);
    return sqrt(dot(to, to)) >= w->reach - tolerance / 2 && holds(w, to);
}

static void reverse(dp_path_point *points, size_t from, size_t to) {
    while (from + 1 < to) {
        const dp_path_point kept = points[from];
        points[from++] = points[--to];
        points[to] = kept;
    }
}

/* How sharply a closed path turns at a point: 0 straight on to 2 back. */
static double turn_at(const dp_path_point *points, size_t count, size_t i) {
    const vec in = between(&points[(i + count - 1) % count], &points[i]),
              out = between(&points[i], &points[(i + 1) % count]);
    const double length = sqrt(dot(in, in) * dot(out, out));
    return length > 0 ? 1 - dot(in, out) / length : 0;
}

void dp_rotate_points(dp_path_point *points, size_t count, size_t first) {
    reverse(points, 0, first);
    reverse(points, first, count);
    reverse(points, 0, count);
}

static void begin_at_corner(dp_path_point *points, size_t count) {
    size_t sharpest = 0;
    double most = turn_at(points, count, 0);
    for (size_t i = 1; i < count; i++) {
        const double turn = turn_at(points, count, i);
        if (turn > most) most = turn, sharpest = i;
    }
    if (sharpest) dp_rotate_points(points, count, sharpest);
}

size_t dp_simplify(dp_path_point *points, size_t count, bool closed, float tolerance) {
    if (closed) begin_at_corner(points, count);
    if (!(tolerance > 0) || count < 3) return count;
    const dp_path_point first = points[0];
    const size_t last =
        closed ? count : count - 1; /* where a closed path comes back to its start */
    dp_path_point anchor = first;
    size_t kept = 1;
    wedge w = {0};
    for (size_t i = 1; i < last; i++) {
        const dp_path_point *const next = i + 1 < count ? &points[i + 1] : &first;
        if (may_skip(&w, &anchor, &points[i], next, (double)tolerance)) continue;
        anchor = points[kept++] = points[i];
        w = (wedge){0};
    }
    if (!closed) points[kept++] = points[count - 1];
    return kept;
}
