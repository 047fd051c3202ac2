/* The geometry of a curved PN triangle (Vlachos et al. 2001, 3).
 *
 *     edge      b210 = (2 P1 + P2 - w12 N1) / 3,  w12 = (P2 - P1) · N1: the chord's third, projected
 *               into the tangent plane of its end
 *     patch     b111 = E + (E - V) / 2, E the mean of the six such points, V of the corners
 *     normals   quadratic, with n110 = the mean of two corners' normals, reflected across the plane
 *               that cuts the edge in half, so that an S-shaped edge has its inflection
 *
 * Beyond the paper: where a surface is folded along an edge, its end has two normals, and the third
 * is projected on the line that both tangent planes share. So a rim stays watertight and becomes
 * round.
 *
 * Invariant: each control point depends on its own end first, and points are evaluated from the end
 * that comes first in space; two polygons that share an edge thus compute the same bits, whichever way
 * they run it. */
#include "mesh/pn.h"

/* Sine of the steepest that a tangent plane may lie across an edge: a steeper one says that the
 * normal is not that of this edge's surface. (That of a tetrahedron in its sphere: 0.82.) */
static const double STEEPEST = 0.87;

/* Cosine: two tangent planes whose line runs farther off the edge than this (60 degrees) do not make
 * its fold. */
static const double ALONG = 0.5;

/* A third of the edge e, as the surface at its end makes it run. */
static dp_vec3 third(dp_vec3 e, const dp_pn_end *end) {
    const double length = dp_length(e);
    const dp_vec3 straight = dp_scale(e, 1.0 / 3);
    if (end->count == 1) {
        const double steep = dp_dot(e, end->normal[0]);
        return fabs(steep) <= STEEPEST * length ? dp_mad(straight, end->normal[0], -steep / 3)
                                                : straight;
    }
    if (end->count == 2) {
        const dp_vec3 line = dp_unit(dp_cross(end->normal[0], end->normal[1]));
        const double along = dp_dot(e, line);
        return fabs(along) >= ALONG * length ? dp_scale(line, along / 3) : straight;
    }
    return straight;
}

dp_pn_edge dp_pn_edge_between(dp_vec3 a, dp_vec3 b, const dp_pn_end *at_a, const dp_pn_end *at_b) {
    return (dp_pn_edge){
        {a, dp_add(a, third(dp_sub(b, a), at_a)), dp_add(b, third(dp_sub(a, b), at_b)), b}};
}

dp_pn_edge dp_pn_edge_straight(dp_vec3 a, dp_vec3 b) {
    static const dp_pn_end straight = {.count = 0};
    return dp_pn_edge_between(a, b, &straight, &straight);
}

void dp_pn_bend(const dp_pn_edge *edge, dp_vec3 bend[2]) {
    const dp_vec3 *const p = edge->at;
    bend[0] = dp_sub(p[1], dp_mix(p[0], p[3], 1.0 / 3));
    bend[1] = dp_sub(p[2], dp_mix(p[3], p[0], 1.0 / 3));
}

static bool comes_first(dp_vec3 a, dp_vec3 b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

dp_vec3 dp_pn_edge_point(const dp_pn_edge *edge, uint32_t part, uint32_t parts) {
    const dp_vec3 *const p = edge->at;
    const bool onward = comes_first(p[0], p[3]);
    const double t = (double)(onward ? part : parts - part) / parts, s = 1 - t;
    const dp_vec3 first = onward ? p[0] : p[3], second = onward ? p[1] : p[2],
                  next = onward ? p[2] : p[1], last = onward ? p[3] : p[0];
    return dp_mad(
        dp_mad(dp_mad(dp_scale(first, s * s * s), second, 3 * s * s * t), next, 3 * s * t * t),
        last, t * t * t);
}

dp_pn_patch dp_pn_patch_within(const dp_pn_edge edges[3]) {
    dp_pn_patch patch;
    dp_vec3 around = {0, 0, 0}, corners = {0, 0, 0};
    for (int i = 0; i < 3; i++) {
        patch.edges[i] = edges[i];
        around = dp_add(around, dp_add(edges[i].at[1], edges[i].at[2]));
        corners = dp_add(corners, edges[i].at[0]);
    }
    around = dp_scale(around, 1.0 / 6);
    patch.inner = dp_mad(around, dp_sub(around, dp_scale(corners, 1.0 / 3)), 0.5);
    return patch;
}

dp_vec3 dp_pn_point(const dp_pn_patch *patch, const double w[3]) {
    dp_vec3 sum = dp_scale(patch->inner, 6 * w[0] * w[1] * w[2]);
    for (int i = 0; i < 3; i++) {
        const double a = w[i], b = w[(i + 1) % 3];
        sum = dp_mad(sum, patch->edges[i].at[0], a * a * a);
        sum = dp_mad(sum, patch->edges[i].at[1], 3 * a * a * b);
        sum = dp_mad(sum, patch->edges[i].at[2], 3 * a * b * b);
    }
    return sum;
}

dp_pn_normals dp_pn_normals_of(const dp_vec3 at[3], const dp_vec3 corner[3]) {
    dp_pn_normals out;
    for (int i = 0; i < 3; i++) {
        const int next = (i + 1) % 3;
        const dp_vec3 e = dp_sub(at[next], at[i]), sum = dp_add(corner[i], corner[next]);
        const double square = dp_dot(e, e);
        out.corner[i] = corner[i];
        out.middle[i] = dp_unit(square > 0 ? dp_mad(sum, e, -2 * dp_dot(e, sum) / square) : sum);
    }
    return out;
}

dp_vec3 dp_pn_normal(const dp_pn_normals *normals, const double w[3]) {
    dp_vec3 sum = {0, 0, 0};
    for (int i = 0; i < 3; i++) {
        sum = dp_mad(sum, normals->corner[i], w[i] * w[i]);
        sum = dp_mad(sum, normals->middle[i], w[i] * w[(i + 1) % 3]);
    }
    return dp_unit(sum);
}
