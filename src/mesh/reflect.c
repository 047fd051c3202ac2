/* A source's mirror image, batch by batch, and a source with a quadrilateral after it.
 *
 * A batch with an origin is reflected about it, and has the origin's image for its origin, so that
 * positions stay as small as they are.
 *
 * A reflected batch has all vertices of the batch, reflected, and then those where polygons were
 * cut; each polygon's corners are in reverse order. Polygons that are cut are taken to be convex.
 *
 * Invariant: every corner has a vertex, a flag and, if the batch has them, numbers of its normal
 * and texture coordinate; a cut corner has those of the corner that was kept, and its colour. Arrays
 * stay for the next batch. */
#include "mesh/reflect.h"

#include "base/diag.h"
#include "mesh/attributes.h"
#include "mesh/source.h"

#include <string.h>

typedef struct corner {
    uint32_t vertex, normal, texcoord;
    double side;  /* distance from the plane; kept where >= 0 */
    uint8_t flag; /* of the edge to the next corner */
} corner;

/* A source and a quadrilateral. */
typedef struct with_quad {
    dp_source *source;
    double corners[4][3]; /* world space */
    double origin[3];     /* of the source's last batch */
    float positions[4][3];
    uint16_t group[1];
    bool ended, done;
} with_quad;

struct dp_reflection {
    dp_source image, scene; /* what is handed out */
    with_quad quad;
    dp_source *source;
    dp_plane_equation plane;        /* world space */
    dp_plane_equation turn, border; /* the same about the batch's origin, and about its image's */
    double origin[3];               /* of the reflected batch */
    dp_allocator memory;
    float *positions, *normals;
    uint32_t *indices, *firsts, *normal_indices, *texcoord_indices;
    uint32_t *colors; /* [vertices], while the batch has some */
    uint8_t *flags;
    uint16_t *groups;
    corner *corners, *kept; /* of one polygon */
    size_t positions_cap, normals_cap, indices_cap, firsts_cap, normal_cap, texcoord_cap,
        colors_cap, flags_cap, groups_cap;
    size_t corners_cap, kept_cap;
    size_t vertices, corner_count, polygons; /* of the reflected batch */
    bool colored;                            /* it has colours */
};
typedef dp_reflection reflection;

static const float *position(const reflection *r, uint32_t vertex) {
    return r->positions + 3 * (size_t)vertex;
}

static double side_of(const dp_plane_equation *plane, const float *p) {
    return plane->n[0] * p[0] + plane->n[1] * p[1] + plane->n[2] * p[2] - plane->offset;
}

static void reflect_point(const dp_plane_equation *plane, const float *p, float *to) {
    const double twice = 2 * side_of(plane, p);
    for (int k = 0; k < 3; k++) to[k] = (float)(p[k] - twice * plane->n[k]);
}

static void reflect_direction(const dp_plane_equation *plane, const float *v, float *to) {
    const double twice = 2 * (plane->n[0] * v[0] + plane->n[1] * v[1] + plane->n[2] * v[2]);
    for (int k = 0; k < 3; k++) to[k] = (float)(v[k] - twice * plane->n[k]);
}

#define RESERVE(r, array, cap, need)                                                               \
    dp_reserve(&(r)->memory, &(r)->array, &(r)->cap, (need), sizeof *(r)->array)

static bool reserve_batch(reflection *r, const dp_batch *b) {
    return dp_reserve(&r->memory, &r->positions, &r->positions_cap,
                      dp_times(3, b->vertex_count + 8), sizeof(float)) &&
           dp_reserve(&r->memory, &r->normals, &r->normals_cap, dp_times(3, b->normals.count + 1),
                      sizeof(float)) &&
           RESERVE(r, firsts, firsts_cap, b->polygon_count + 1) &&
           RESERVE(r, colors, colors_cap, b->colors ? b->vertex_count : 0) &&
           RESERVE(r, groups, groups_cap, b->polygon_count + 1);
}

/* Makes room for one more polygon of up to n + 1 corners, two of them at new vertices. */
static bool reserve_polygon(reflection *r, size_t n) {
    const size_t corners = r->corner_count + n + 2;
    return dp_reserve(&r->memory, &r->positions, &r->positions_cap,
                      dp_times(3, r->vertices + 2 * n + 2), sizeof(float)) &&
           RESERVE(r, indices, indices_cap, corners) && RESERVE(r, flags, flags_cap, corners) &&
           RESERVE(r, normal_indices, normal_cap, corners) &&
           RESERVE(r, texcoord_indices, texcoord_cap, corners) &&
           RESERVE(r, colors, colors_cap, r->colored ? r->vertices + 2 * n + 2 : 0) &&
           RESERVE(r, corners, corners_cap, n) && RESERVE(r, kept, kept_cap, 2 * n + 2);
}

/* Adds the vertex where the edge from a to b meets the plane. Positions are reflected already,
 * which does not move points of the plane. */
static uint32_t cut(reflection *r, const corner *a, const corner *b) {
    const float *const p = position(r, a->vertex), *const q = position(r, b->vertex);
    const double t = a->side / (a->side - b->side);
    float *const to = r->positions + 3 * r->vertices;
    for (int k = 0; k < 3; k++) to[k] = (float)(p[k] + (q[k] - p[k]) * t);
    if (r->colored) r->colors[r->vertices] = r->colors[a->side >= 0 ? a->vertex : b->vertex];
    return (uint32_t)r->vertices++;
}

/* Clips by the plane (Sutherland and Hodgman 1974); the edge along it never draws. */
static size_t clip(reflection *r, size_t n) {
    size_t count = 0;
    for (size_t i = 0; i < n; i++) {
        const corner a = r->corners[i], b = r->corners[(i + 1) % n];
        const bool in_a = a.side >= 0, in_b = b.side >= 0;
        if (in_a) r->kept[count++] = a;
        if (in_a == in_b) continue;
        corner c = in_a ? a : b;
        c.vertex = cut(r, &a, &b);
        c.side = 0;
        c.flag = in_a ? DP_EDGE_NEVER : a.flag;
        r->kept[count++] = c;
    }
    return count;
}

static void close_polygon(reflection *r, size_t n, uint16_t group) {
    r->groups[r->polygons] = group;
    for (size_t i = 0; i < n; i++) { /* backwards: edge i leads from corner n - i to n - i - 1 */
        const corner *const c = &r->kept[(n - i) % n];
        const size_t to = r->corner_count++;
        r->indices[to] = c->vertex;
        r->normal_indices[to] = c->normal;
        r->texcoord_indices[to] = c->texcoord;
        r->flags[to] = r->kept[n - 1 - i].flag;
    }
    r->firsts[++r->polygons] = (uint32_t)r->corner_count;
}

static bool add_polygon(reflection *r, const dp_batch *b, size_t i) {
    const size_t first = b->firsts ? b->firsts[i] : 3 * i,
                 last = b->firsts ? b->firsts[i + 1] : 3 * i + 3, n = last - first;
    size_t inside = 0, before = 0, wrong = 0; /* before: on the near side, not only in the plane */
    if (!reserve_polygon(r, n)) return false;
    for (size_t c = first; c < last; c++) {
        const uint32_t v = b->indices ? b->indices[c] : (uint32_t)c;
        corner *const to = &r->corners[c - first];
        *to = (corner){.vertex = v < b->vertex_count ? v : UINT32_MAX,
                       .flag = b->edge_flags ? b->edge_flags[c] : DP_EDGE_NORMAL,
                       .normal = dp_attribute_number(&b->normals, c, v),
                       .texcoord = dp_attribute_number(&b->texcoords, c, v)};
        wrong += to->vertex == UINT32_MAX;
        if (to->vertex != UINT32_MAX)
            to->side = -side_of(&r->border, position(r, v)); /* its image lies beyond */
        inside += to->side >= 0;
        before += to->side > 0;
    }
    if (!before && !wrong) return true;
    size_t count = n;
    if (inside < n && !wrong)
        count = clip(r, n);
    else if (n)
        memcpy(r->kept, r->corners, n * sizeof *r->kept);
    close_polygon(r, count, b->groups ? b->groups[i] : 0);
    return true;
}

static double along(const dp_plane_equation *plane, const double p[3]) {
    return plane->n[0] * p[0] + plane->n[1] * p[1] + plane->n[2] * p[2];
}

/* Without an origin, positions are world space. */
static void place_planes(reflection *r, const double origin[3]) {
    r->turn = r->border = r->plane;
    memset(r->origin, 0, sizeof r->origin);
    if (origin[0] == 0 && origin[1] == 0 && origin[2] == 0) return;
    const double twice = 2 * (along(&r->plane, origin) - r->plane.offset);
    for (int k = 0; k < 3; k++) r->origin[k] = origin[k] - twice * r->plane.n[k];
    r->turn.offset = 0;
    r->border.offset = r->plane.offset - along(&r->plane, r->origin);
}

static bool reflect_batch(reflection *r, const dp_batch *b) {
    if (!reserve_batch(r, b)) return false;
    place_planes(r, b->origin);
    for (size_t v = 0; v < b->vertex_count; v++)
        reflect_point(
            &r->turn,
            (const float *)(const void *)((const char *)b->positions + v * b->position_stride),
            r->positions + 3 * v);
    for (size_t i = 0; b->normals.values && i < b->normals.count; i++)
        reflect_direction(&r->turn, dp_attribute_value(&b->normals, (uint32_t)i),
                          r->normals + 3 * i);
    r->colored = b->colors != NULL;
    if (r->colored) memcpy(r->colors, b->colors, b->vertex_count * sizeof *r->colors);
    r->vertices = b->vertex_count;
    r->corner_count = r->polygons = 0;
    r->firsts[0] = 0;
    for (size_t i = 0; i < b->polygon_count; i++)
        if (!add_polygon(r, b, i)) return false;
    return true;
}

static dp_result reflection_next(void *user, dp_batch *out, dp_diag *diag) {
    reflection *const r = user;
    dp_batch b;
    do { /* skip batches wholly behind the plane: an empty batch would be the end */
        const dp_result result = dp_source_next(r->source, &b, diag);
        if (result || !b.polygon_count) return result;
        if (!reflect_batch(r, &b))
            return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a mirror image");
    } while (!r->polygons);
    *out = (dp_batch){.positions = r->positions,
                      .vertex_count = r->vertices,
                      .indices = r->indices,
                      .corner_count = r->corner_count,
                      .firsts = r->firsts,
                      .polygon_count = r->polygons,
                      .edge_flags = r->flags,
                      .colors = r->colored ? r->colors : NULL,
                      .groups = b.groups ? r->groups : NULL};
    memcpy(out->origin, r->origin, sizeof out->origin);
    if (b.normals.values)
        out->normals = (dp_attribute){
            .values = r->normals, .count = b.normals.count, .indices = r->normal_indices};
    out->texcoords = b.texcoords;
    if (b.texcoords.values) out->texcoords.indices = r->texcoord_indices;
    return DP_OK;
}

static dp_result reflection_rewind(void *user, dp_diag *diag) {
    return dp_source_rewind(((reflection *)user)->source, diag);
}

static uint32_t reflection_color(void *user, uint32_t group) {
    return dp_source_group_color(((reflection *)user)->source, group);
}

static const dp_array arrays[] = {DP_ARRAY(reflection, positions, positions_cap),
                                  DP_ARRAY(reflection, normals, normals_cap),
                                  DP_ARRAY(reflection, indices, indices_cap),
                                  DP_ARRAY(reflection, firsts, firsts_cap),
                                  DP_ARRAY(reflection, normal_indices, normal_cap),
                                  DP_ARRAY(reflection, texcoord_indices, texcoord_cap),
                                  DP_ARRAY(reflection, colors, colors_cap),
                                  DP_ARRAY(reflection, flags, flags_cap),
                                  DP_ARRAY(reflection, groups, groups_cap),
                                  DP_ARRAY(reflection, corners, corners_cap),
                                  DP_ARRAY(reflection, kept, kept_cap)};

/* ------- a source and a quadrilateral ------- */

static dp_result with_quad_next(void *user, dp_batch *out, dp_diag *diag) {
    static const uint32_t firsts[2] = {0, 4};
    with_quad *const q = user;
    if (!q->ended) {
        const dp_result result = dp_source_next(q->source, out, diag);
        if (!result && out->polygon_count) memcpy(q->origin, out->origin, sizeof q->origin);
        if (result || out->polygon_count) return result;
        q->ended = true;
    }
    *out = (dp_batch){0};
    for (int i = 0; i < 12; i++)
        q->positions[i / 3][i % 3] = (float)(q->corners[i / 3][i % 3] - q->origin[i % 3]);
    if (!q->done)
        *out = (dp_batch){.positions = q->positions[0],
                          .vertex_count = 4,
                          .corner_count = 4,
                          .firsts = firsts,
                          .polygon_count = 1,
                          .groups = q->group,
                          .origin = {q->origin[0], q->origin[1], q->origin[2]}};
    q->done = true;
    return DP_OK;
}

static dp_result with_quad_rewind(void *user, dp_diag *diag) {
    with_quad *const q = user;
    q->ended = q->done = false;
    return dp_source_rewind(q->source, diag);
}

static uint32_t with_quad_color(void *user, uint32_t group) {
    return dp_source_group_color(((with_quad *)user)->source, group);
}

/* ------- what is kept ------- */

dp_reflection *dp_reflection_create(const dp_allocator *memory) {
    reflection *const r = dp_alloc_zeroed(memory, sizeof *r);
    if (r) r->memory = *memory;
    return r;
}

void dp_reflection_free(dp_reflection *r) {
    if (!r) return;
    const dp_allocator memory = r->memory;
    dp_arrays_free(&memory, r, DP_ARRAYS(arrays));
    dp_free(&memory, r);
}

uint64_t dp_reflection_bytes(const dp_reflection *r) {
    return r ? sizeof *r + dp_arrays_bytes(r, DP_ARRAYS(arrays)) : 0;
}

dp_source *dp_reflect_source(dp_reflection *r, dp_source *source, const dp_plane_equation *plane) {
    r->source = source;
    r->plane = *plane;
    r->image = (dp_source){.callbacks = {.user = r,
                                         .next = reflection_next,
                                         .rewind = reflection_rewind,
                                         .group_color = reflection_color},
                           .allocator = r->memory,
                           .moves = source->moves};
    return &r->image;
}

dp_source *dp_add_quad_source(dp_reflection *r, dp_source *source, const double corners[4][3],
                              uint16_t group) {
    r->quad = (with_quad){.source = source, .group = {group}};
    memcpy(r->quad.corners, corners, sizeof r->quad.corners);
    r->scene = (dp_source){.callbacks = {.user = &r->quad,
                                         .next = with_quad_next,
                                         .rewind = with_quad_rewind,
                                         .group_color = with_quad_color},
                           .allocator = r->memory,
                           .moves = source->moves};
    return &r->scene;
}
