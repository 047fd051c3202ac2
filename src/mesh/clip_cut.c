/* Cuts triangles by planes, and notes the segments along which planes cut them.
 *
 *    for each plane that a triangle crosses: the segment from where it enters the kept side to where it
 *        leaves it, of the whole triangle, so that a section's outline is whole before other planes cut
 *        it; the inside lies to its left
 *    clip by one plane after the other (Sutherland and Hodgman 1974); new edges never draw
 *    what is left: a fan of triangles
 *
 * A point on a plane counts as kept, so a triangle with an edge on it and the third corner beyond leaves
 * nothing but this edge, as a segment. Its neighbour keeps the edge, which then must draw no line of its
 * own: such edges are noted, and taken back when all segments are known. Invariant: a cut edge gives
 * the same point from either of its polygons, as it is computed from its lower end by position. */
#include "mesh/clip.h"

#include "base/sort.h"

#include <float.h>
#include <string.h>

enum { MOST = 3 + DP_CLIP_PLANES /* corners of a triangle cut by all planes */ };

double dp_beyond_plane(const dp_section_plane *plane, const float p[3]) {
    const double x = plane->n.x * p[0], y = plane->n.y * p[1], z = plane->n.z * p[2],
                 d = x + y + z - plane->offset,
                 least = FLT_EPSILON / 2 * (fabs(x) + fabs(y) + fabs(z) + fabs(plane->offset));
    return fabs(d) <= least ? 0 : d;
}

/* ------- the batch ------- */

#define RESERVE(c, array, cap, need)                                                               \
    dp_reserve(&(c)->memory, &(c)->array, &(c)->cap, (need), sizeof *(c)->array)

static bool reserve_triangle(dp_clipping *c) {
    const size_t corners = 3 * (c->made.triangles + 1);
    return RESERVE(c, made.positions, made.positions_cap, 3 * corners) &&
           RESERVE(c, made.normals, made.normals_cap, 3 * corners) &&
           RESERVE(c, made.texcoords, made.texcoords_cap, 2 * corners) &&
           RESERVE(c, made.texcoord_indices, made.texcoord_indices_cap, corners) &&
           RESERVE(c, made.colors, made.colors_cap, corners) &&
           RESERVE(c, made.flags, made.flags_cap, corners) &&
           RESERVE(c, made.groups, made.groups_cap, corners / 3);
}

bool dp_made_add(dp_clipping *c, const dp_cut_corner corners[3], uint16_t group) {
    dp_made_batch *const m = &c->made;
    if (m->triangles >= UINT32_MAX / 4 || !reserve_triangle(c)) return false;
    for (size_t i = 0, at = 3 * m->triangles; i < 3; i++, at++) {
        memcpy(m->positions + 3 * at, corners[i].position, sizeof corners[i].position);
        memcpy(m->normals + 3 * at, corners[i].normal, sizeof corners[i].normal);
        memcpy(m->texcoords + 2 * at, corners[i].texcoord, sizeof corners[i].texcoord);
        m->texcoord_indices[at] = corners[i].has_texcoord ? (uint32_t)at : UINT32_MAX;
        m->colors[at] = corners[i].color;
        m->flags[at] = corners[i].flag;
    }
    m->groups[m->triangles++] = group;
    return true;
}

/* ------- cutting ------- */

static int order_of(const float *p, const float *q) {
    for (int k = 0; k < 3; k++)
        if (p[k] != q[k]) return p[k] < q[k] ? -1 : 1;
    return 0;
}

static float mix(float a, float b, double t) { return (float)(a + ((double)b - a) * t); }

static dp_color mix_color(dp_color a, dp_color b, double t) {
    dp_color out = 0;
    if (!a || !b) return a ? a : b;
    for (int shift = 0; shift < 32; shift += 8) {
        const double p = a >> shift & 0xFF, q = b >> shift & 0xFF;
        out |= (dp_color)(p + (q - p) * t + 0.5) << shift;
    }
    return out;
}

/* Where the edge between corners on either side of a plane meets it; its flag is left to the
 * caller. */
static dp_cut_corner meet(const dp_section_plane *plane, const dp_cut_corner *from,
                          const dp_cut_corner *to) {
    const bool turned = order_of(from->position, to->position) > 0;
    const dp_cut_corner *const a = turned ? to : from, *const b = turned ? from : to;
    const double da = dp_beyond_plane(plane, a->position), db = dp_beyond_plane(plane, b->position),
                 t = da / (da - db);
    dp_cut_corner c = {.has_texcoord = a->has_texcoord && b->has_texcoord,
                       .color = mix_color(a->color, b->color, t)};
    for (int k = 0; k < 3; k++) c.position[k] = mix(a->position[k], b->position[k], t);
    for (int k = 0; k < 3; k++) c.normal[k] = mix(a->normal[k], b->normal[k], t);
    for (int k = 0; k < 2; k++) c.texcoord[k] = mix(a->texcoord[k], b->texcoord[k], t);
    return c;
}

static uint32_t clip(const dp_section_plane *plane, const dp_cut_corner *p, uint32_t n,
                     dp_cut_corner *out) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < n; i++) {
        const dp_cut_corner *const a = &p[i], *const b = &p[i + 1 == n ? 0 : i + 1];
        const double da = dp_beyond_plane(plane, a->position),
                     db = dp_beyond_plane(plane, b->position);
        if (da <= 0) out[count++] = *a;
        if (da <= 0 && db > 0) { /* on along the plane */
            if (da < 0) out[count++] = meet(plane, a, b);
            out[count - 1].flag = DP_EDGE_NEVER;
        } else if (da > 0 && db < 0) {
            out[count] = meet(plane, a, b);
            out[count++].flag = a->flag;
        }
    }
    return count;
}

static dp_flat_point flatten(const dp_section_plane *plane, const float p[3]) {
    return (dp_flat_point){dp_dot(plane->u, dp_v3f(p)), dp_dot(plane->v, dp_v3f(p))};
}

/* Notes where plane k cuts a triangle. */
static bool note_cut(dp_clipping *c, uint32_t k, const dp_cut_corner p[3], uint16_t group) {
    const dp_section_plane *const plane = &c->planes[k];
    dp_cut_corner end[2];
    bool cut[2] = {false, false};
    for (uint32_t i = 0; i < 3; i++) {
        const dp_cut_corner *const a = &p[i], *const b = &p[(i + 1) % 3];
        const double da = dp_beyond_plane(plane, a->position),
                     db = dp_beyond_plane(plane, b->position);
        if ((da <= 0) == (db <= 0)) continue;
        const bool leaves = da <= 0;
        cut[leaves] = true;
        end[leaves] = da == 0 ? *a : db == 0 ? *b : meet(plane, a, b);
    }
    if (!cut[0] || !cut[1]) return true;
    const dp_cut_segment s = {{flatten(plane, end[0].position), flatten(plane, end[1].position)},
                              group};
    if (s.end[0].u == s.end[1].u && s.end[0].v == s.end[1].v) return true;
    if (!dp_reserve(&c->memory, &c->cuts[k], &c->cut_caps[k], c->cut_counts[k] + 1,
                    sizeof *c->cuts[k]))
        return false;
    c->cuts[k][c->cut_counts[k]++] = s;
    return true;
}

/* Notes those edges of the triangle added last that lie on a plane and may draw. */
static bool note_touching(dp_clipping *c, const dp_cut_corner p[3]) {
    const size_t first = 3 * (c->made.triangles - 1);
    for (uint32_t k = 0; k < c->plane_count; k++) {
        bool on[3];
        for (int i = 0; i < 3; i++) on[i] = dp_beyond_plane(&c->planes[k], p[i].position) == 0;
        for (size_t i = 0; i < 3; i++) {
            if (!on[i] || !on[(i + 1) % 3] || p[i].flag == DP_EDGE_NEVER) continue;
            if (!dp_reserve(&c->memory, &c->touching, &c->touching_cap, c->touching_count + 1,
                            sizeof *c->touching))
                return false;
            c->touching[c->touching_count++] = (dp_touching_edge){first + i, k};
        }
    }
    return true;
}

static bool add_fan(dp_clipping *c, const dp_cut_corner *p, uint32_t n, uint16_t group) {
    for (uint32_t i = 1; i + 1 < n; i++) {
        dp_cut_corner t[3] = {p[0], p[i], p[i + 1]};
        if (i > 1) t[0].flag = DP_EDGE_NEVER;
        if (i + 2 < n) t[2].flag = DP_EDGE_NEVER;
        if (!dp_made_add(c, t, group) || !note_touching(c, t)) return false;
    }
    return true;
}

bool dp_clip_triangle(dp_clipping *c, const dp_cut_corner corners[3], uint16_t group) {
    dp_cut_corner polygon[2][MOST];
    uint32_t n = 3, now = 0;
    for (uint32_t k = 0; k < c->plane_count; k++)
        if (!note_cut(c, k, corners, group)) return false;
    memcpy(polygon[0], corners, 3 * sizeof *corners);
    for (uint32_t k = 0; k < c->plane_count && n > 2; k++, now ^= 1)
        n = clip(&c->planes[k], polygon[now], n, polygon[now ^ 1]);
    return n < 3 || add_fan(c, polygon[now], n, group);
}

/* ------- edges that touch ------- */

static dp_cut_segment ordered(dp_flat_point a, dp_flat_point b) {
    const bool turned = a.u != b.u ? a.u > b.u : a.v > b.v;
    return turned ? (dp_cut_segment){{b, a}, 0} : (dp_cut_segment){{a, b}, 0};
}

static int by_place(const void *left, const void *right) {
    const dp_cut_segment *const l = left, *const r = right, a = ordered(l->end[0], l->end[1]),
                                b = ordered(r->end[0], r->end[1]);
    for (int i = 0; i < 2; i++) {
        if (a.end[i].u != b.end[i].u) return a.end[i].u < b.end[i].u ? -1 : 1;
        if (a.end[i].v != b.end[i].v) return a.end[i].v < b.end[i].v ? -1 : 1;
    }
    return 0;
}

static int by_group(const void *left, const void *right) {
    const dp_cut_segment *const l = left, *const r = right;
    if (l->group != r->group) return l->group < r->group ? -1 : 1;
    const int order = by_place(left, right);
    if (order) return order;
    return l->end[0].u != r->end[0].u ? (l->end[0].u < r->end[0].u ? -1 : 1)
                                      : (l->end[0].v > r->end[0].v) - (l->end[0].v < r->end[0].v);
}

static bool is_cut(const dp_clipping *c, uint32_t k, const dp_cut_segment *edge) {
    size_t low = 0, high = c->cut_counts[k];
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        const int order = by_place(&c->cuts[k][middle], edge);
        if (!order) return true;
        if (order < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return false;
}

void dp_clip_settle_touching(dp_clipping *c) {
    for (uint32_t k = 0; k < c->plane_count; k++)
        if (c->touching_count && c->cut_counts[k])
            dp_sort(c->cuts[k], c->cut_counts[k], sizeof *c->cuts[k], by_place);
    for (size_t i = 0; i < c->touching_count; i++) {
        const dp_touching_edge *const t = &c->touching[i];
        const dp_section_plane *const plane = &c->planes[t->plane];
        const size_t next = t->corner % 3 == 2 ? t->corner - 2 : t->corner + 1;
        const dp_cut_segment edge = {{flatten(plane, c->made.positions + 3 * t->corner),
                                      flatten(plane, c->made.positions + 3 * next)},
                                     0};
        if (is_cut(c, t->plane, &edge)) c->made.flags[t->corner] = DP_EDGE_NEVER;
    }
    for (uint32_t k = 0; k < c->plane_count; k++)
        if (c->cut_counts[k]) dp_sort(c->cuts[k], c->cut_counts[k], sizeof *c->cuts[k], by_group);
}

/* ------- memory ------- */

static const dp_array arrays[] = {DP_ARRAY(dp_made_batch, positions, positions_cap),
                                  DP_ARRAY(dp_made_batch, normals, normals_cap),
                                  DP_ARRAY(dp_made_batch, texcoords, texcoords_cap),
                                  DP_ARRAY(dp_made_batch, texcoord_indices, texcoord_indices_cap),
                                  DP_ARRAY(dp_made_batch, colors, colors_cap),
                                  DP_ARRAY(dp_made_batch, flags, flags_cap),
                                  DP_ARRAY(dp_made_batch, groups, groups_cap)};

void dp_clipping_begin(dp_clipping *c) {
    c->made.triangles = c->touching_count = 0;
    memset(c->cut_counts, 0, sizeof c->cut_counts);
}

void dp_clipping_free(dp_clipping *c) {
    dp_arrays_free(&c->memory, &c->made, DP_ARRAYS(arrays));
    for (uint32_t k = 0; k < DP_CLIP_PLANES; k++) dp_free(&c->memory, c->cuts[k]);
    dp_free(&c->memory, c->touching);
}
