/* Edges between the triangles of a chunk, and which way triangles face.
 *
 *     for each edge of each live triangle:      open addressing, by the key of the ends' positions
 *         first met here                        -> alone
 *         met by one triangle, run the other way -> pair
 *         otherwise                             -> fan: all of its edges may be lines
 *     pair that faces one way and is nearly flat -> plain: forgotten
 *     any other pair                            -> both edges may be lines
 *
 * A slot also holds half of the key, so that nearly every comparison of positions is with the edge
 * sought. Invariant: at most half of the slots are used. */
#include "stream/chunk.h"

/* ------- facing ------- */

/* dp_triangle_facing in double precision, for triangles that are thin or seen nearly edge-on. */
static bool slow_facing(const dp_view *view, dp_vec3 a, dp_vec3 b, dp_vec3 c, float normal[4],
                        uint8_t *state) {
    const dp_vec3 u = dp_sub(b, a), v = dp_sub(c, a), n = dp_cross(u, v);
    const double size = dp_max(dp_dot(u, u), dp_dot(v, v));
    if (dp_length(n) <= 1e-12 * size) return false; /* as dp_polygon_has_no_area */
    const dp_vec3 unit = dp_unit(n);
    const double sine = dp_dot(unit, dp_view_vector(view, a));
    /* between: seen edge-on, or too small to tell (core/outline.c) */
    *state = sine < -1.1e-3 ? DP_TRIANGLE_FRONT : sine > 1e-6 ? DP_TRIANGLE_BACK : 0;
    normal[0] = (float)unit.x, normal[1] = (float)unit.y, normal[2] = (float)unit.z, normal[3] = 1;
    return true;
}

bool dp_triangle_facing(const dp_view *view, const float *a, const float *b, const float *c,
                        float normal[4], uint8_t *state) {
    const float ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
    const float vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
    const float nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    const float n2 = nx * nx + ny * ny + nz * nz, u2 = ux * ux + uy * uy + uz * uz,
                v2 = vx * vx + vy * vy + vz * vz;
    const float ex = view->perspective ? a[0] - (float)view->eye.x : (float)view->forward.x;
    const float ey = view->perspective ? a[1] - (float)view->eye.y : (float)view->forward.y;
    const float ez = view->perspective ? a[2] - (float)view->eye.z : (float)view->forward.z;
    const float along = nx * ex + ny * ey + nz * ez, e2 = ex * ex + ey * ey + ez * ez;
    if (!(n2 > 1e-6f * u2 * v2) || !(n2 > FLT_MIN) || !(along * along > 1e-6f * n2 * e2) ||
        !isfinite(n2 * e2))
        return slow_facing(view, dp_v3f(a), dp_v3f(b), dp_v3f(c), normal, state);
    normal[0] = nx, normal[1] = ny, normal[2] = nz, normal[3] = n2;
    *state = along < 0 ? DP_TRIANGLE_FRONT : DP_TRIANGLE_BACK;
    return true;
}

bool dp_edge_is_plain(uint8_t state_a, const float normal_a[4], uint8_t state_b,
                      const float normal_b[4], float flat_cosine) {
    const uint8_t both = state_a & state_b & (DP_TRIANGLE_FRONT | DP_TRIANGLE_BACK);
    if (!both || flat_cosine > 1) return false;
    if (flat_cosine < 0) return true;
    const float dot =
        normal_a[0] * normal_b[0] + normal_a[1] * normal_b[1] + normal_a[2] * normal_b[2];
    return dot > 0 && dot * dot > flat_cosine * flat_cosine * (normal_a[3] * normal_b[3]);
}

/* ------- edges ------- */

static bool same_position(const uint8_t *p, const uint8_t *q) {
    uint64_t p_xy, q_xy;
    uint32_t p_z, q_z;
    memcpy(&p_xy, p, sizeof p_xy), memcpy(&q_xy, q, sizeof q_xy);
    memcpy(&p_z, p + sizeof p_xy, sizeof p_z), memcpy(&q_z, q + sizeof q_xy, sizeof q_z);
    if (((p_xy ^ q_xy) | (p_z ^ q_z)) == 0) return true;
    float a[3], b[3];
    memcpy(a, p, sizeof a), memcpy(b, q, sizeof b);
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; /* -0 is 0 */
}

/* 1: one edge in opposite directions, as it should be; -1: in the same direction; 0: two edges. */
static int compare_edges(const dp_triangles *triangles, uint32_t t, uint32_t e, uint32_t u,
                         uint32_t f) {
    enum { CORNER = 3 * sizeof(float) };
    const uint8_t *const a = triangles->corners + t * triangles->stride;
    const uint8_t *const b = triangles->corners + u * triangles->stride;
    const uint8_t *const a0 = a + CORNER * e, *const a1 = a + CORNER * (e == 2 ? 0 : e + 1);
    const uint8_t *const b0 = b + CORNER * f, *const b1 = b + CORNER * (f == 2 ? 0 : f + 1);
    if (same_position(a0, b1) && same_position(a1, b0)) return 1;
    if (same_position(a0, b0) && same_position(a1, b1)) return -1;
    return 0;
}

static void meet(dp_chunk *chunk, dp_chunk_edge *e, uint32_t t, uint32_t edge, bool opposite) {
    if (e->met == 1 && opposite) {
        e->b = (uint16_t)t, e->edge_b = (uint8_t)edge, e->met = 2;
        return;
    }
    if (e->met < 3) { /* a fan: decided later, from all of its triangles */
        chunk->lines[e->a] |= (uint8_t)(1u << e->edge_a);
        if (e->met == 2) chunk->lines[e->b] |= (uint8_t)(1u << e->edge_b);
        e->met = 3;
    }
    chunk->lines[t] |= (uint8_t)(1u << edge);
}

static void add_edge(dp_chunk *chunk, const dp_triangles *triangles, uint32_t t, uint32_t edge) {
    const uint32_t key = chunk->edge_key[edge][t], tag = key & 0xffff0000u;
    for (uint32_t s = key & (DP_CHUNK_SLOTS - 1);; s = (s + 1) & (DP_CHUNK_SLOTS - 1)) {
        const uint32_t found = chunk->slots[s];
        if (!found) {
            chunk->edges[chunk->edge_count] = (dp_chunk_edge){(uint16_t)t, 0, (uint8_t)edge, 0, 1};
            chunk->slots[s] = tag | ++chunk->edge_count;
            return;
        }
        if ((found & 0xffff0000u) != tag) continue;
        dp_chunk_edge *const e = &chunk->edges[(found & 0xffff) - 1];
        const int how = compare_edges(triangles, t, edge, e->a, e->edge_a);
        if (!how) continue;
        meet(chunk, e, t, edge, how > 0);
        return;
    }
}

/* An edge that lies outside the picture is no line. */
static bool may_be_seen(const dp_chunk *chunk, const dp_triangles *triangles,
                        const dp_chunk_edge *e, const dp_view *view) {
    float corners[9];
    if (chunk->state[e->a] & DP_TRIANGLE_WITHIN) return true;
    dp_triangle_corners(triangles, e->a, corners);
    return dp_edge_may_be_seen(corners + 3 * e->edge_a, corners + 3 * ((e->edge_a + 1) % 3), view);
}

void dp_chunk_edges(dp_chunk *chunk, const dp_triangles *triangles, const dp_chunk_view *view) {
    memset(chunk->slots, 0, sizeof chunk->slots);
    memset(chunk->lines, 0, chunk->count);
    memset(chunk->alone, 0, chunk->count);
    chunk->edge_count = 0;
    for (uint32_t t = 0; t < chunk->count; t++) {
        const uint32_t flags = triangles->flags ? triangles->flags[t] : 7;
        if (!(chunk->state[t] & DP_TRIANGLE_LIVE)) continue;
        for (uint32_t e = 0; e < 3; e++)
            if (flags >> e & 1) add_edge(chunk, triangles, t, e);
    }
    for (uint32_t i = 0; i < chunk->edge_count; i++) {
        const dp_chunk_edge *const e = &chunk->edges[i];
        if (e->met == 2) {
            if (dp_edge_is_plain(chunk->state[e->a], chunk->normal[e->a], chunk->state[e->b],
                                 chunk->normal[e->b], view->flat_cosine))
                continue;
            chunk->lines[e->a] |= (uint8_t)(1u << e->edge_a);
            chunk->lines[e->b] |= (uint8_t)(1u << e->edge_b);
        } else if (e->met == 1 && may_be_seen(chunk, triangles, e, view->view)) {
            chunk->alone[e->a] |= (uint8_t)(1u << e->edge_a);
        }
    }
}
