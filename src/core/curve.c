/* How finely an edge's curve is cut: by what is seen of its bend.
 *
 *     far from silhouettes   for silhouettes alone, an edge whose surface faces the eye, or away, at
 *                            both ends, by more than it turns between them: straight
 *     a fixed level          level + 1 parts, if the edge is curved at all (Vlachos et al. 2001: the
 *                            level of detail is the number of points between an edge's ends)
 *     by size on the screen  parts n such that the chords are at most TOLERANCE off the curve: they are
 *                            3/4 b / n^2 off, with b how far a control point lies from the chord's third
 *
 * The bend is measured across the line of sight in any direction, not across the edge: that of an edge
 * seen end-on moves the silhouette most. */
#include "core/curve.h"

/* px. */
static const double TOLERANCE = 0.2;

/* Of its length: an edge is straight that bends by less. */
static const double STRAIGHT = 1e-4;

/* Cosine between the line of sight, from the eye on, and the normal that faces most away; and the one
 * that faces most to the eye. */
typedef struct range {
    double least, most;
} range;

static range facing_at(const dp_view *view, dp_vec3 at, const dp_pn_end *end) {
    range r = {INFINITY, -INFINITY};
    for (uint32_t i = 0; i < end->count; i++) {
        const double cosine = dp_curve_facing(view, at, end->normal[i]);
        r.least = dp_min(r.least, cosine), r.most = dp_max(r.most, cosine);
    }
    return r;
}

/* How far the normals at one end turn to the nearest at the other, as the length between them. */
static double turn_to(const dp_pn_end *from, const dp_pn_end *to) {
    double turn = 0;
    for (uint32_t i = 0; i < from->count && to->count; i++) {
        double nearest = INFINITY;
        for (uint32_t k = 0; k < to->count; k++)
            nearest = dp_min(nearest, dp_length(dp_sub(from->normal[i], to->normal[k])));
        turn = dp_max(turn, nearest);
    }
    return turn;
}

static bool is_near_silhouette(const dp_view *view, dp_vec3 a, dp_vec3 b, const dp_pn_end ends[2]) {
    const range at_a = facing_at(view, a, &ends[0]), at_b = facing_at(view, b, &ends[1]);
    const double turn = dp_max(DP_CURVE_LEAST_TURN,
                               dp_max(turn_to(&ends[0], &ends[1]), turn_to(&ends[1], &ends[0])));
    return dp_min(at_a.least, at_b.least) <= turn && dp_max(at_a.most, at_b.most) >= -turn;
}

/* World length of a pixel at the nearer end; 0: both ends lie behind the eye. */
static double pixel_at(const dp_view *view, dp_vec3 a, dp_vec3 b) {
    if (!view->perspective) return 1 / view->focal;
    const double da = dp_to_clip(view, a).w, db = dp_to_clip(view, b).w;
    const double near = dp_min(da, db), far = dp_max(da, db);
    return far > 0 ? dp_max(near, far / 64) / view->focal : 0; /* near the eye: fine enough */
}

/* px */
static double seen_bend(const dp_view *view, double pixel, const dp_pn_edge *curve) {
    dp_vec3 bend[2];
    double most = 0;
    dp_pn_bend(curve, bend);
    for (int k = 0; k < 2; k++) {
        const dp_vec3 sight = dp_view_vector(view, curve->at[3 * k]);
        const dp_vec3 across = dp_mad(bend[k], sight, -dp_dot(bend[k], sight));
        most = dp_max(most, dp_length(across) / pixel);
    }
    return most;
}

static bool is_straight(const dp_pn_edge *curve) {
    dp_vec3 bend[2];
    dp_pn_bend(curve, bend);
    const double most = STRAIGHT * dp_length(dp_sub(curve->at[3], curve->at[0]));
    return !(dp_length(bend[0]) > most || dp_length(bend[1]) > most);
}

/* Does an edge lie beside the picture, farther off than it is long? */
static bool is_outside(const dp_view *view, double pixel, dp_vec3 a, dp_vec3 b) {
    const dp_clip_point p = dp_to_clip(view, a), q = dp_to_clip(view, b);
    if (!(p.w > 0 && q.w > 0)) return false;
    const double length = dp_length(dp_sub(b, a)) / pixel, x = 1 + 2 * length / view->width,
                 y = 1 + 2 * length / view->height;
    return (p.x > x * p.w && q.x > x * q.w) || (p.x < -x * p.w && q.x < -x * q.w) ||
           (p.y > y * p.w && q.y > y * q.w) || (p.y < -y * p.w && q.y < -y * q.w);
}

static uint32_t parts_by_size(const dp_view *view, const dp_pn_edge *curve) {
    const double pixel = pixel_at(view, curve->at[0], curve->at[3]);
    if (!(pixel > 0) || is_outside(view, pixel, curve->at[0], curve->at[3])) return 1;
    const double off = 0.75 * seen_bend(view, pixel, curve);
    uint32_t n = 1;
    while (n < DP_PN_PARTS && off > TOLERANCE * n * n) n++;
    return n;
}

uint32_t dp_curve_parts(const dp_curve_rule *rule, dp_vec3 a, dp_vec3 b, const dp_pn_end ends[2],
                        dp_pn_edge *curve) {
    if (rule->what != DP_SMOOTH_SILHOUETTES || is_near_silhouette(rule->view, a, b, ends)) {
        *curve = dp_pn_edge_between(a, b, &ends[0], &ends[1]);
        if (!is_straight(curve))
            return rule->level ? rule->level + 1 : parts_by_size(rule->view, curve);
    }
    *curve = dp_pn_edge_straight(a, b);
    return 1;
}
