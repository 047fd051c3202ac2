/* Classification of edges: which fold two polygons make, and which line that is.
 *
 * Dihedral angle: 180° minus the angle between the normals on a convex edge, 180° plus it on a
 * concave one (Raskar 2001, 2.2). Ridge: at most theta. Valley: more than phi (Raskar 2001, 2.3).
 * Not handled: polygons without area; their normal is zero, and their edges count as flat. */
#include "core/fold.h"

#include "base/elementary.h"

/* Is it long enough to tell a direction? Not the sum of two normals that cancel: of polygons folded flat
 * onto each other. */
static bool has_direction(dp_vec3 mean) { return dp_length(mean) > 1e-3; }

bool dp_fold_is_flat(const dp_fold *fold) {
    return !has_direction(dp_add(fold->normal_a, fold->normal_b));
}

static dp_vec3 corner_position(const dp_polygons *polygons, uint32_t corner) {
    return dp_v3f(dp_vertex_position(polygons, dp_corner_vertex(polygons, corner)));
}

/* The corner of `polygon` that is furthest from its edge number `edge`. The side of a plane it lies
 * on tells whether the edge is convex. */
static dp_vec3 far_corner(const dp_polygons *polygons, uint32_t polygon, uint32_t edge) {
    const uint32_t first = dp_first_corner(polygons, polygon),
                   n = dp_corner_count(polygons, polygon);
    return corner_position(polygons, first + (edge + 1 + n / 2) % n);
}

static dp_vec3 edge_position(const dp_polygons *polygons, uint32_t polygon, uint32_t edge) {
    return corner_position(polygons, dp_first_corner(polygons, polygon) + edge);
}

/* A vector from an edge into its polygon. */
static dp_vec3 from_edge(const dp_polygons *polygons, uint32_t polygon, uint32_t edge) {
    return dp_sub(far_corner(polygons, polygon, edge), edge_position(polygons, polygon, edge));
}

static dp_fold fold_towards(const dp_frame *frame, uint32_t a, bool a_as_wound, uint32_t b,
                            bool b_as_wound, dp_vec3 at, dp_vec3 into_b) {
    dp_fold fold = {.normal_a = dp_polygon_normal(frame, a),
                    .normal_b = dp_polygon_normal(frame, b)};
    if (!a_as_wound) fold.normal_a = dp_scale(fold.normal_a, -1);
    if (!b_as_wound) fold.normal_b = dp_scale(fold.normal_b, -1);
    const dp_vec3 mean = dp_add(fold.normal_a, fold.normal_b);
    /* The two sides of a sheet folded flat have no mean: take the direction to the eye. */
    fold.normal =
        has_direction(mean) ? dp_unit(mean) : dp_scale(dp_view_vector(&frame->view, at), -1);
    fold.concave = dp_dot(fold.normal_a, into_b) > 0;
    return fold;
}

dp_fold dp_fold_seen(const dp_frame *frame, uint32_t a, bool a_as_wound, uint32_t b,
                     bool b_as_wound, uint32_t edge_b) {
    const dp_vec3 on_edge = edge_position(&frame->polygons, b, edge_b);
    const dp_vec3 into_b = from_edge(&frame->polygons, b, edge_b);
    return fold_towards(frame, a, a_as_wound, b, b_as_wound, on_edge, into_b);
}

dp_fold dp_fold_between(const dp_frame *frame, dp_vec3 normal_a, dp_vec3 normal_b, dp_vec3 normal,
                        uint32_t b, uint32_t edge_b) {
    const dp_vec3 into_b = from_edge(&frame->polygons, b, edge_b);
    return (dp_fold){normal_a, normal_b, normal, dp_dot(normal_a, into_b) > 0};
}

dp_fold dp_fold_at(const dp_frame *frame, uint32_t a, bool a_as_wound, uint32_t b, bool b_as_wound,
                   dp_vec3 at) {
    const dp_polygons *const polygons = &frame->polygons;
    const uint32_t first = dp_first_corner(polygons, b), n = dp_corner_count(polygons, b);
    dp_vec3 far = at;
    for (uint32_t i = 0; i < n; i++) {
        const dp_vec3 p = corner_position(polygons, first + i);
        const dp_vec3 na = dp_polygon_normal(frame, a);
        if (i == 0 || fabs(dp_dot(na, dp_sub(p, at))) > fabs(dp_dot(na, dp_sub(far, at)))) far = p;
    }
    return fold_towards(frame, a, a_as_wound, b, b_as_wound, at, dp_sub(far, at));
}

/* ------- as the eye sees it ------- */

bool dp_sight_make(const dp_view *view, dp_vec3 a, dp_vec3 b, dp_sight *sight) {
    const dp_vec3 along = dp_unit(dp_sub(b, a)), from = dp_view_vector(view, dp_mix(a, b, 0.5)),
                  right = dp_cross(from, along);
    sight->along = along, sight->right = dp_unit(right);
    sight->away = dp_cross(along, sight->right);
    return dp_length(right) > 1e-9;
}

dp_beside dp_beside_edge(const dp_frame *frame, const dp_sight *sight, uint32_t polygon,
                         bool as_wound) {
    dp_beside out = {.normal = dp_polygon_normal(frame, polygon)};
    if (!as_wound) out.normal = dp_scale(out.normal, -1);
    /* A plane through the edge leads to the right along (along × normal). */
    const double facing = -dp_dot(out.normal, sight->away);
    out.recedes = dp_dot(out.normal, sight->right) / dp_max(facing, 1e-12);
    return out;
}

dp_fold dp_fold_of_sides(const dp_sight *sight, const dp_beside *left, const dp_beside *right) {
    const dp_vec3 mean = dp_add(left->normal, right->normal);
    return (dp_fold){left->normal, right->normal,
                     has_direction(mean) ? dp_unit(mean) : dp_scale(sight->away, -1),
                     left->recedes > right->recedes};
}

/* The angle of two planes whose corners are rounded: that of which it is known that no crease is
 * so flat. */
static const double ONE_PLANE = 0.9999995; /* cosine of 0.06 degrees */

bool dp_is_one_plane(const dp_beside *a, const dp_beside *b) {
    return dp_dot(a->normal, b->normal) > ONE_PLANE;
}

dp_vec3 dp_outline_normal(const dp_sight *sight, const dp_beside *nearest, const dp_beside *behind,
                          bool right) {
    const dp_vec3 mean = dp_sub(nearest->normal, behind->normal);
    return has_direction(mean) ? dp_unit(mean) : dp_scale(sight->right, right ? -1 : 1);
}

dp_vec3 dp_pair_normal(const dp_frame *frame, uint32_t a, uint32_t b) {
    const dp_vec3 mean = dp_add(dp_polygon_normal(frame, a), dp_polygon_normal(frame, b));
    return has_direction(mean) ? dp_unit(mean) : dp_v3(0, 0, 0);
}

double dp_fold_dihedral(const dp_fold *fold) {
    const double sine = dp_length(dp_cross(fold->normal_a, fold->normal_b));
    const double degrees =
        dp_atan2(sine, dp_dot(fold->normal_a, fold->normal_b)) * 180 / 3.14159265358979323846;
    return fold->concave ? 180 + degrees : 180 - degrees;
}

/* Covers rounding of float32 coordinates, so that edges that meet a threshold exactly all fall on
 * one side of it. */
static const double ROUNDING = 1e-3; /* degrees */

int dp_fold_line(const dp_fold *fold, const dp_style *style) {
    const double dihedral = dp_fold_dihedral(fold);
    if (dihedral <= style->ridge_angle + ROUNDING) return DP_LINE_RIDGE;
    return dihedral > style->valley_angle + ROUNDING ? (int)DP_LINE_VALLEY : -1;
}
