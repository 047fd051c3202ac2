/* A source cut open by planes (section.h).
 *
 *    for each batch of the inner source
 *        mark each vertex with the planes that it lies beyond, and those that it lies on
 *        nothing is beyond and no edge on a plane    hand the batch on as it is
 *        else hand on those polygons of which this is true; cut the others          clip_cut.c
 *    at its end
 *        for each plane, for each group: chain, fill, outline, hatch                section.c
 *        hand on all that was cut, faces and lines as one batch of triangles
 *
 * Polygons with more than three corners are split before they are cut, in the way in which drawing
 * splits them. Those with an index out of range or a coordinate that is not finite go through, so that
 * they are counted. Invariant: positions in the last batch count from the first batch's origin; what is
 * cut is what a drawing would have made of the positions. Arrays stay for the next reading. */
#include "mesh/clip.h"

#include "base/diag.h"
#include "base/elementary.h"
#include "base/sort.h"
#include "mesh/source.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

static const double PI = 3.14159265358979323846;
static const double HATCH_ANGLE = 45, HATCH_SHARE = 1.0 / 60, LEAST_SHARE = 1.0 / 2000;

/* Where vertices lie: bits of planes. A vertex with a coordinate that is not finite is BAD. */
typedef struct where {
    uint8_t beyond, on, bad;
} where;

typedef struct clipper {
    dp_source *inner;
    dp_clip clip; /* normals of length 1, defaults filled in */
    dp_clipping cutting;
    dp_section_scratch sections;
    where *where;                                                   /* by vertex of the batch */
    dp_cut_corner *corners;                                         /* of one polygon */
    uint32_t *indices, *firsts, *normal_indices, *texcoord_indices; /* of the batch handed on */
    uint8_t *flags;
    uint16_t *groups, *ranks; /* ranks: groups that were cut, ascending */
    dp_split_scratch split;
    size_t where_cap, corners_cap, indices_cap, firsts_cap, normal_cap, texcoord_cap, flags_cap,
        groups_cap, ranks_cap;
    size_t kept_corners, kept, rank_count;
    double origin[3], shift[3]; /* the first batch's; what moves the batch's positions to it */
    bool any_met;               /* a plane has met something, in any reading so far */
    bool begun, ended, any_kept, any_read, moved, timed, has_normals, has_texcoords, has_colors,
        has_groups;
    double low[3], high[3]; /* box of what is kept */
    uint32_t plane;         /* that is filled */
    uint16_t group;
} clipper;

#define RESERVE(c, array, cap, need)                                                               \
    dp_reserve(&(c)->cutting.memory, &(c)->array, &(c)->cap, (need), sizeof *(c)->array)

static dp_result out_of_memory(dp_diag *diag) {
    return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a clipped model");
}

/* ------- planes ------- */

/* To the right and up for who looks against the normal; where that looks straight up or down, as a
 * plan lies: the top view's right. */
static void find_directions(dp_section_plane *p, dp_vec3 up) {
    const bool is_y = fabs(up.y) > 0.5;
    dp_vec3 right = dp_cross(up, p->n);
    if (dp_length(right) < 1e-3) right = dp_cross(is_y ? dp_v3(0, 0, -1) : dp_v3(0, 1, 0), p->n);
    if (dp_length(right) < 1e-3) right = dp_cross(dp_v3(1, 0, 0), p->n);
    p->u = dp_unit(right);
    p->v = dp_cross(p->n, p->u);
}

static void place_planes(clipper *c) {
    double up[3];
    (void)dp_source_up(c->inner, up);
    for (uint32_t k = 0; k < c->clip.plane_count; k++) {
        const dp_clip_plane *const from = &c->clip.planes[k];
        dp_section_plane *const p = &c->cutting.planes[k];
        p->n = dp_v3(from->normal[0], from->normal[1], from->normal[2]);
        p->offset =
            from->offset - (from->normal[0] * c->origin[0] + from->normal[1] * c->origin[1] +
                            from->normal[2] * c->origin[2]);
        find_directions(p, dp_v3(up[0], up[1], up[2]));
    }
    c->cutting.plane_count = c->clip.plane_count;
}

/* ------- a batch ------- */

static const float *position_of(const dp_batch *b, size_t vertex) {
    return (const float *)(const void *)((const char *)b->positions + vertex * b->position_stride);
}

/* As drawing moves positions of later batches. */
static void place(const clipper *c, const float *from, float to[3]) {
    for (int k = 0; k < 3; k++) to[k] = c->moved ? (float)((double)from[k] + c->shift[k]) : from[k];
}

static void widen_box(clipper *c, const float p[3]) {
    for (int k = 0; k < 3; k++) {
        c->low[k] = dp_min(c->low[k], (double)p[k]);
        c->high[k] = dp_max(c->high[k], (double)p[k]);
    }
}

static where find_where(clipper *c, const float p[3]) {
    where at = {0, 0, !(isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]))};
    for (uint32_t k = 0; k < c->cutting.plane_count && !at.bad; k++) {
        const double d = dp_beyond_plane(&c->cutting.planes[k], p);
        at.beyond |= (uint8_t)((d > 0) << k);
        at.on |= (uint8_t)((d == 0) << k);
    }
    if (!at.bad && !at.beyond) widen_box(c, p);
    return at;
}

static bool find_all_where(clipper *c, const dp_batch *b) {
    if (!RESERVE(c, where, where_cap, b->vertex_count)) return false;
    for (size_t v = 0; v < b->vertex_count; v++) {
        float p[3];
        place(c, position_of(b, v), p);
        c->where[v] = find_where(c, p);
    }
    return true;
}

typedef struct span {
    size_t first, n;
} span;

static span corners_of(const dp_batch *b, size_t polygon) {
    if (!b->firsts) return (span){3 * polygon, 3};
    return (span){b->firsts[polygon], b->firsts[polygon + 1] - b->firsts[polygon]};
}

static uint32_t vertex_of(const dp_batch *b, size_t corner) {
    return b->indices ? b->indices[corner] : (uint32_t)corner;
}

/* What becomes of a polygon. */
typedef enum fate { KEPT, CUT, DROPPED } fate;

static fate fate_of(const clipper *c, const dp_batch *b, span s) {
    uint32_t beyond = 0, all = UINT32_MAX, touches = 0,
             last = vertex_of(b, s.first + (s.n ? s.n - 1 : 0));
    if (s.n < 3) return KEPT;
    for (size_t i = 0; i < s.n; i++) {
        const uint32_t v = vertex_of(b, s.first + i);
        if (v >= b->vertex_count || last >= b->vertex_count || c->where[v].bad) return KEPT;
        beyond |= c->where[v].beyond;
        all &= c->where[v].beyond;
        touches |= c->where[v].on & c->where[last].on;
        last = v;
    }
    if (all && beyond == all) return DROPPED; /* no plane crosses it */
    return beyond || touches ? CUT : KEPT;
}

/* ------- polygons that are kept ------- */

static bool reserve_kept(clipper *c, const dp_batch *b) {
    const size_t n = b->corner_count;
    c->kept = c->kept_corners = 0;
    return RESERVE(c, indices, indices_cap, n) && RESERVE(c, flags, flags_cap, n) &&
           RESERVE(c, normal_indices, normal_cap, n) &&
           RESERVE(c, texcoord_indices, texcoord_cap, n) &&
           RESERVE(c, firsts, firsts_cap, b->polygon_count + 1) &&
           RESERVE(c, groups, groups_cap, b->polygon_count);
}

static void copy_numbers(uint32_t *to, const uint32_t *from, span s) {
    if (from) memcpy(to, from + s.first, s.n * sizeof *to);
}

static void keep(clipper *c, const dp_batch *b, size_t polygon, span s) {
    c->firsts[c->kept] = (uint32_t)c->kept_corners;
    c->groups[c->kept++] = b->groups ? b->groups[polygon] : 0;
    const size_t to = c->kept_corners;
    for (size_t i = 0; i < s.n; i++) c->indices[to + i] = vertex_of(b, s.first + i);
    if (b->edge_flags) memcpy(c->flags + to, b->edge_flags + s.first, s.n);
    copy_numbers(c->normal_indices + to, b->normals.indices, s);
    copy_numbers(c->texcoord_indices + to, b->texcoords.indices, s);
    c->kept_corners += s.n;
    c->firsts[c->kept] = (uint32_t)c->kept_corners;
}

static void hand_on_kept(const clipper *c, dp_batch *b) {
    b->indices = c->indices;
    b->corner_count = c->kept_corners;
    if (b->firsts) b->firsts = c->firsts;
    b->polygon_count = c->kept;
    if (b->edge_flags) b->edge_flags = c->flags;
    if (b->groups) b->groups = c->groups;
    if (b->normals.indices) b->normals.indices = c->normal_indices;
    if (b->texcoords.indices) b->texcoords.indices = c->texcoord_indices;
    b->stable = false;
}

/* ------- polygons that are cut ------- */

static dp_cut_corner corner_of(const clipper *c, const dp_batch *b, size_t at) {
    const uint32_t v = vertex_of(b, at), normal = dp_attribute_number(&b->normals, at, v),
                   texcoord = dp_attribute_number(&b->texcoords, at, v);
    dp_cut_corner out = {.color = b->colors ? b->colors[v] : 0,
                         .flag = b->edge_flags ? b->edge_flags[at] : DP_EDGE_NORMAL,
                         .has_texcoord = texcoord != UINT32_MAX};
    place(c, position_of(b, v), out.position);
    if (normal != UINT32_MAX)
        memcpy(out.normal, dp_attribute_value(&b->normals, normal), sizeof out.normal);
    if (texcoord != UINT32_MAX)
        memcpy(out.texcoord, dp_attribute_value(&b->texcoords, texcoord), sizeof out.texcoord);
    return out;
}

/* Cuts the triangle of three of the polygon's n corners. */
static bool cut_piece(clipper *c, const uint32_t piece[3], size_t n, uint16_t group) {
    dp_cut_corner t[3];
    for (int i = 0; i < 3; i++) {
        t[i] = c->corners[piece[i]];
        if (piece[(i + 1) % 3] != (piece[i] + 1) % n) t[i].flag = DP_EDGE_DIAGONAL;
    }
    return dp_clip_triangle(&c->cutting, t, group);
}

static bool cut(clipper *c, const dp_batch *b, size_t polygon, span s) {
    const uint16_t group = b->groups ? b->groups[polygon] : 0;
    const uint32_t n = (uint32_t)s.n;
    if (!RESERVE(c, corners, corners_cap, s.n) ||
        !dp_split_scratch_reserve(&c->split, s.n, &c->cutting.memory))
        return false;
    for (uint32_t i = 0; i < n; i++) {
        c->corners[i] = corner_of(c, b, s.first + i);
        c->split.at[i] = position_of(b, vertex_of(b, s.first + i));
    }
    const bool whole = n == 3 || dp_stays_whole(c->split.at, n);
    const uint32_t count = whole ? n - 2 : dp_split_polygon(&c->split, n);
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t fan[3] = {0, i + 1, i + 2};
        if (!cut_piece(c, whole ? fan : c->split.triangles[i], s.n, group)) return false;
    }
    return true;
}

/* Takes a batch, of which *b becomes what is handed on; false: memory is out. */
static bool take_batch(clipper *c, dp_batch *b) {
    bool changes = false;
    if (!find_all_where(c, b)) return false;
    for (size_t i = 0; i < b->polygon_count && !changes; i++)
        changes = fate_of(c, b, corners_of(b, i)) != KEPT;
    if (!changes) return true;
    c->any_met = true;
    if (!reserve_kept(c, b)) return false;
    for (size_t i = 0; i < b->polygon_count; i++) {
        const span s = corners_of(b, i);
        const fate f = fate_of(c, b, s);
        if (f == KEPT) keep(c, b, i, s);
        if (f == CUT && !cut(c, b, i, s)) return false;
    }
    hand_on_kept(c, b);
    return true;
}

/* ------- sections ------- */

static void raise(const clipper *c, dp_flat_point p, dp_cut_corner *to) {
    const dp_section_plane *const plane = &c->cutting.planes[c->plane];
    const dp_vec3 at = dp_add(dp_add(dp_scale(plane->n, plane->offset), dp_scale(plane->u, p.u)),
                              dp_scale(plane->v, p.v));
    *to = (dp_cut_corner){.position = {(float)at.x, (float)at.y, (float)at.z},
                          .normal = {(float)plane->n.x, (float)plane->n.y, (float)plane->n.z}};
}

static bool add_face(void *user, const dp_flat_point *points, uint32_t count) {
    clipper *const c = user;
    for (uint32_t i = 1; i + 1 < count; i++) {
        dp_cut_corner t[3];
        raise(c, points[0], &t[0]);
        raise(c, points[i], &t[1]);
        raise(c, points[i + 1], &t[2]);
        for (int k = 0; k < 3; k++) t[k].flag = DP_EDGE_FACE;
        if (!dp_made_add(&c->cutting, t, c->group)) return false;
    }
    return true;
}

/* A triangle without area holds a line. */
static bool add_line(void *user, dp_flat_point a, dp_flat_point b, dp_edge_kind flag) {
    clipper *const c = user;
    dp_cut_corner t[3];
    raise(c, a, &t[0]);
    raise(c, b, &t[1]);
    t[2] = t[1];
    t[0].flag = (uint8_t)flag;
    return dp_made_add(&c->cutting, t, c->group);
}

/* What the other planes leave of plane k; a line is drawn along their border once, by the first of
 * two. */
static uint32_t find_halves(const clipper *c, uint32_t k, dp_half_plane halves[DP_CLIP_PLANES],
                            uint32_t *outlined) {
    const dp_section_plane *const p = &c->cutting.planes[k];
    uint32_t count = 0;
    *outlined = 0;
    for (uint32_t i = 0; i < c->cutting.plane_count; i++) {
        const dp_section_plane *const q = &c->cutting.planes[i];
        if (i == k) continue;
        if (i > k) *outlined |= 1u << count;
        halves[count++] = (dp_half_plane){dp_dot(q->n, p->u), dp_dot(q->n, p->v),
                                          q->offset - p->offset * dp_dot(q->n, p->n)};
    }
    return count;
}

static int by_number(const void *left, const void *right) {
    const uint16_t l = *(const uint16_t *)left, r = *(const uint16_t *)right;
    return (l > r) - (l < r);
}

/* Lists the groups that were cut by any plane. */
static bool rank_groups(clipper *c) {
    c->rank_count = 0;
    for (uint32_t k = 0; k < c->cutting.plane_count; k++)
        for (size_t i = 0; i < c->cutting.cut_counts[k]; i++) {
            const uint16_t group = c->cutting.cuts[k][i].group;
            if (i && group == c->cutting.cuts[k][i - 1].group) continue;
            if (!RESERVE(c, ranks, ranks_cap, c->rank_count + 1)) return false;
            c->ranks[c->rank_count++] = group;
        }
    if (c->rank_count) dp_sort(c->ranks, c->rank_count, sizeof *c->ranks, by_number);
    size_t count = 0;
    for (size_t i = 0; i < c->rank_count; i++)
        if (!i || c->ranks[i] != c->ranks[i - 1]) c->ranks[count++] = c->ranks[i];
    c->rank_count = count;
    return true;
}

static size_t rank_of(const clipper *c, uint16_t group) {
    size_t low = 0, high = c->rank_count;
    while (low < high) {
        const size_t middle = low + (high - low) / 2;
        if (c->ranks[middle] < group)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* ISO 128-50: neighbouring parts differ in direction, then in distance. */
static dp_hatching hatching_of(const clipper *c, uint16_t group) {
    static const double turns[] = {0, 90, 0, 90, 30, 120}, wider[] = {1, 1, 1.7, 1.7, 1.3, 1.3};
    const size_t i = rank_of(c, group) % (sizeof turns / sizeof *turns);
    double square = 0;
    for (int k = 0; k < 3; k++) square += (c->high[k] - c->low[k]) * (c->high[k] - c->low[k]);
    const double size = sqrt(square), given = c->clip.hatch_spacing,
                 spacing = given > 0 ? given : c->clip.hatch_share * size;
    return (dp_hatching){.look = c->clip.look,
                         .angle = (c->clip.hatch_angle + turns[i]) * PI / 180,
                         .spacing = dp_max(spacing, LEAST_SHARE * size) * wider[i]};
}

static bool make_section(clipper *c, uint32_t k) {
    const dp_cut_segment *const cuts = c->cutting.cuts[k];
    dp_half_plane halves[DP_CLIP_PLANES];
    dp_section_sink sink = {.face = add_face, .line = add_line, .user = c, .halves = halves};
    sink.half_count = find_halves(c, k, halves, &sink.outlined);
    if (c->clip.look == DP_SECTION_OPEN) sink.outlined = 0;
    c->plane = k;
    for (size_t i = 0, end; i < c->cutting.cut_counts[k]; i = end) {
        for (end = i + 1; end < c->cutting.cut_counts[k] && cuts[end].group == cuts[i].group;)
            end++;
        c->group = cuts[i].group;
        const dp_hatching hatching = hatching_of(c, c->group);
        if (!dp_section_make(&c->sections, cuts + i, end - i, &hatching, &sink, &c->cutting.memory))
            return false;
    }
    return true;
}

static void hand_on_made(const clipper *c, dp_batch *b) {
    const dp_made_batch *const m = &c->cutting.made;
    const size_t corners = 3 * m->triangles;
    *b = (dp_batch){.positions = m->positions,
                    .vertex_count = corners,
                    .corner_count = corners,
                    .polygon_count = m->triangles,
                    .edge_flags = m->flags,
                    .groups = c->has_groups ? m->groups : NULL,
                    .colors = c->has_colors ? m->colors : NULL};
    if (c->has_normals) b->normals = (dp_attribute){.values = m->normals, .count = corners};
    if (c->has_texcoords)
        b->texcoords = (dp_attribute){
            .values = m->texcoords, .count = corners, .indices = m->texcoord_indices};
    memcpy(b->origin, c->origin, sizeof b->origin);
}

static dp_result finish(clipper *c, dp_batch *out, dp_diag *diag) {
    c->ended = true;
    *out = (dp_batch){0};
    dp_clip_settle_touching(&c->cutting);
    for (size_t i = 0; i < 3 * c->cutting.made.triangles; i++)
        widen_box(c, c->cutting.made.positions + 3 * i);
    if (!rank_groups(c)) return out_of_memory(diag);
    for (uint32_t k = 0; k < c->cutting.plane_count; k++)
        if (!make_section(c, k)) return out_of_memory(diag);
    if (c->cutting.made.triangles) hand_on_made(c, out);
    if (c->any_read && !c->any_kept && !c->cutting.made.triangles && !c->timed)
        return dp_fail(
            diag, DP_ERR_ARGUMENT,
            "the clip planes leave nothing of the model: what lies beyond a plane, on the "
            "side that its normal points to, is taken away; turn the normal round, or move "
            "the plane");
    return DP_OK;
}

/* ------- the source ------- */

static void begin_reading(clipper *c) {
    c->begun = c->ended = c->any_kept = c->any_read = false;
    c->has_normals = c->has_texcoords = c->has_colors = c->has_groups = false;
    for (int k = 0; k < 3; k++) c->low[k] = INFINITY, c->high[k] = -INFINITY;
    dp_clipping_begin(&c->cutting);
}

static void note_batch(clipper *c, const dp_batch *b) {
    if (!c->begun) {
        memcpy(c->origin, b->origin, sizeof c->origin);
        place_planes(c);
    }
    c->begun = c->any_read = true;
    c->moved = dp_batch_shift(b, c->origin, c->shift);
    c->has_normals |= b->normals.values != NULL;
    c->has_texcoords |= b->texcoords.values != NULL;
    c->has_colors |= b->colors != NULL;
    c->has_groups |= b->groups != NULL;
}

static dp_result clipper_next(void *user, dp_batch *out, dp_diag *diag) {
    clipper *const c = user;
    while (!c->ended) { /* an empty batch would be the end */
        const dp_result result = dp_source_next(c->inner, out, diag);
        if (result) return result;
        if (!out->polygon_count) return finish(c, out, diag);
        note_batch(c, out);
        if (!take_batch(c, out)) return out_of_memory(diag);
        c->any_kept |= out->polygon_count > 0;
        if (out->polygon_count) return DP_OK;
    }
    *out = (dp_batch){0};
    return DP_OK;
}

static dp_result clipper_rewind(void *user, dp_diag *diag) {
    clipper *const c = user;
    begin_reading(c);
    return dp_source_rewind(c->inner, diag);
}

static dp_result clipper_set_time(void *user, double time, dp_diag *diag) {
    clipper *const c = user;
    begin_reading(c);
    c->timed = true; /* there may be more of it at another time */
    return dp_source_set_time(c->inner, time, diag);
}
static double clipper_duration(void *user) { return dp_source_duration(((clipper *)user)->inner); }
static void clipper_lend(void *user, dp_threads *threads) {
    dp_source_lend(((clipper *)user)->inner, threads);
}

static const char *clipper_group_name(void *user, uint32_t group) {
    return dp_source_group_name(((clipper *)user)->inner, group);
}
static uint32_t clipper_group_color(void *user, uint32_t group) {
    return dp_source_group_color(((clipper *)user)->inner, group);
}
static const char *clipper_remark(void *user) {
    const clipper *const c = user;
    const char *const inner = dp_source_remark(c->inner);
    if (inner || !c->ended || !c->clip.plane_count || c->any_met) return inner;
    return "the clip planes take nothing away: all of the model lies on the side that is kept";
}
static const char *clipper_color_remark(void *user) {
    return dp_source_color_remark(((clipper *)user)->inner);
}

static const dp_array arrays[] = {DP_ARRAY(clipper, where, where_cap),
                                  DP_ARRAY(clipper, corners, corners_cap),
                                  DP_ARRAY(clipper, indices, indices_cap),
                                  DP_ARRAY(clipper, firsts, firsts_cap),
                                  DP_ARRAY(clipper, normal_indices, normal_cap),
                                  DP_ARRAY(clipper, texcoord_indices, texcoord_cap),
                                  DP_ARRAY(clipper, flags, flags_cap),
                                  DP_ARRAY(clipper, groups, groups_cap),
                                  DP_ARRAY(clipper, ranks, ranks_cap)};

/* Frees all but the inner source. */
static void release(clipper *c) {
    const dp_allocator memory = c->cutting.memory;
    dp_arrays_free(&memory, c, DP_ARRAYS(arrays));
    dp_clipping_free(&c->cutting);
    dp_section_scratch_free(&c->sections, &memory);
    dp_split_scratch_free(&c->split, &memory);
    dp_free(&memory, c);
}

static void clipper_destroy(void *user) {
    clipper *const c = user;
    dp_source_destroy(c->inner);
    release(c);
}

/* ------- making ------- */

static dp_result resolve_plane(dp_clip_plane *p, uint32_t number, dp_diag *diag) {
    const double *const n = p->normal;
    const double most = dp_max(fabs(n[0]), dp_max(fabs(n[1]), fabs(n[2])));
    if (!isfinite(n[0] + n[1] + n[2]) || !(most > 0))
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "the normal of clip plane %" PRIu32 " has no direction: its length is 0, or "
                       "not finite",
                       number);
    if (!isfinite(p->offset))
        return dp_fail(diag, DP_ERR_ARGUMENT, "the offset of clip plane %" PRIu32 " is not finite",
                       number);
    const dp_vec3 unit = dp_unit(dp_v3(n[0] / most, n[1] / most, n[2] / most));
    p->normal[0] = unit.x, p->normal[1] = unit.y, p->normal[2] = unit.z;
    return DP_OK;
}

static dp_result resolve(dp_clip *c, dp_diag *diag) {
    if (c->plane_count > DP_CLIP_PLANES)
        return dp_fail(diag, DP_ERR_ARGUMENT, "%" PRIu32 " clip planes; %d are the most",
                       c->plane_count, DP_CLIP_PLANES);
    for (uint32_t k = 0; k < c->plane_count; k++) {
        const dp_result result = resolve_plane(&c->planes[k], k + 1, diag);
        if (result) return result;
    }
    if ((unsigned)c->look > DP_SECTION_OPEN)
        return dp_fail(diag, DP_ERR_ARGUMENT, "the look of sections is not one of its values");
    if (c->hatch_angle == 0) c->hatch_angle = HATCH_ANGLE;
    if (c->hatch_share == 0) c->hatch_share = HATCH_SHARE;
    if (!isfinite(c->hatch_angle) || !(c->hatch_spacing >= 0) || !isfinite(c->hatch_spacing) ||
        !(c->hatch_share > 0 && c->hatch_share <= 1))
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "the hatch angle, spacing or share of a section is out of range");
    return DP_OK;
}

dp_result dp_source_clip(dp_source *inner, const dp_clip *clip, const dp_allocator *allocator,
                         dp_source **out, dp_diag *diag) {
    if (!out) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_source_clip: out is NULL");
    *out = NULL;
    if (!inner || !clip)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_source_clip: inner or clip is NULL");
    dp_clip full = *clip;
    dp_result result = resolve(&full, diag);
    if (result) return result;
    const dp_allocator memory = dp_allocator_resolve(allocator);
    clipper *const c = dp_alloc_zeroed(&memory, sizeof *c);
    if (!c) return out_of_memory(diag);
    c->inner = inner;
    c->clip = full;
    c->cutting.memory = memory;
    begin_reading(c);
    const dp_source_callbacks callbacks = {
        .user = c,
        .next = clipper_next,
        .rewind = dp_source_rewindable(inner) ? clipper_rewind : NULL,
        .destroy = clipper_destroy,
        .group_name = clipper_group_name,
        .group_color = clipper_group_color,
        .remark = clipper_remark,
        .color_remark = clipper_color_remark,
        .set_time = clipper_set_time,
        .duration = clipper_duration,
        .up = {inner->callbacks.up[0], inner->callbacks.up[1], inner->callbacks.up[2]},
        .up_assumed = inner->callbacks.up_assumed};
    result = dp_source_from_callbacks(&callbacks, &memory, out, diag);
    if (result) return release(c), result;
    (*out)->constant = inner->constant;
    (*out)->lend = clipper_lend;
    return DP_OK;
}
