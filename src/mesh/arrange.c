/* A source of another, some of whose groups are left out or moved.
 *
 * A batch of which nothing changes goes through as it is. Else its polygons are copied one after the
 * other, without those left out:
 *
 *     corners     always: a polygon less moves all that follow
 *     vertices    only where some are moved: a vertex that groups share, and which they take to
 *                 different places, becomes several
 *
 * Values of normals and texture coordinates stay where they are; corners say which are theirs.
 * Positions are moved in double precision, about the batch's own origin.
 *
 * Data structure: for each vertex of the batch, what it has last become, and for which group.
 * Invariant: a batch's copy depends on the batch and the placements alone, so that every reading gives
 * the same. */
#include "mesh/source.h"

#include "base/diag.h"
#include "base/vec.h"

#include <drypoint/objects.h>

#include <string.h>

enum { MOST = 65536 /* dp_batch.groups has 16 bits */, ATTRIBUTES = 2 };

typedef struct moved_vertex {
    uint32_t number; /* among the copied vertices; UINT32_MAX: none yet */
    uint32_t group;  /* that has taken it there */
} moved_vertex;

typedef struct arranged {
    dp_source *inner;
    dp_allocator memory;
    dp_placement *placements; /* [count] */
    uint32_t count;

    /* the batch's copy */
    float *positions;
    moved_vertex *moved; /* by vertex of the batch */
    uint32_t *colors, *indices, *firsts, *values[ATTRIBUTES];
    uint8_t *flags;
    uint16_t *groups;
    size_t positions_cap, moved_cap, colors_cap, indices_cap, firsts_cap, values_cap[ATTRIBUTES],
        flags_cap, groups_cap;
} arranged;

static const dp_array arrays[] = {
    DP_ARRAY(arranged, positions, positions_cap), DP_ARRAY(arranged, moved, moved_cap),
    DP_ARRAY(arranged, colors, colors_cap),       DP_ARRAY(arranged, indices, indices_cap),
    DP_ARRAY(arranged, firsts, firsts_cap),       DP_ARRAY(arranged, values[0], values_cap[0]),
    DP_ARRAY(arranged, values[1], values_cap[1]), DP_ARRAY(arranged, flags, flags_cap),
    DP_ARRAY(arranged, groups, groups_cap),
};

/* ------- placements ------- */

static const dp_placement as_it_is = {0};

static const dp_placement *placement_of(const arranged *a, uint32_t group) {
    return group < a->count ? &a->placements[group] : &as_it_is;
}

static uint32_t group_of(const dp_batch *batch, size_t polygon) {
    return batch->groups ? batch->groups[polygon] : 0;
}

static bool is_moved(const dp_placement *p) {
    return p->offset[0] != 0 || p->offset[1] != 0 || p->offset[2] != 0;
}

static bool is_moved_alike(const dp_placement *p, const dp_placement *q) {
    return p->offset[0] == q->offset[0] && p->offset[1] == q->offset[1] &&
           p->offset[2] == q->offset[2];
}

/* What becomes of a batch. */
typedef struct changes {
    size_t kept; /* polygons */
    bool moves;  /* some of these */
} changes;

static changes changes_of(const arranged *a, const dp_batch *batch) {
    changes c = {0, false};
    const size_t step = batch->groups ? 1 : batch->polygon_count; /* all are of group 0 */
    for (size_t i = 0; i < batch->polygon_count; i += step) {
        const dp_placement *const p = placement_of(a, group_of(batch, i));
        if (p->hidden) continue;
        c.kept += step;
        c.moves |= is_moved(p);
    }
    return c;
}

/* ------- the copy ------- */

typedef struct copying {
    arranged *to;
    const dp_batch *from;
    bool moves;
    size_t vertices, corners, polygons; /* copied so far */
} copying;

static const dp_attribute *attribute_of(const dp_batch *batch, int which) {
    return which ? &batch->texcoords : &batch->normals;
}

/* Do corners of the copy say which value they have? Without vertices of its own they need not. */
static bool lists_values(const copying *c, int which) {
    const dp_attribute *const attribute = attribute_of(c->from, which);
    return attribute->values && (attribute->indices || c->moves);
}

static bool add_vertex(copying *c, uint32_t vertex, const dp_placement *placement) {
    arranged *const a = c->to;
    const float *const p = (const float *)(const void *)((const char *)c->from->positions +
                                                         vertex * c->from->position_stride);
    if (!dp_reserve(&a->memory, &a->positions, &a->positions_cap, 3 * (c->vertices + 1),
                    sizeof *a->positions) ||
        (c->from->colors &&
         !dp_reserve(&a->memory, &a->colors, &a->colors_cap, c->vertices + 1, sizeof *a->colors)))
        return false;
    for (int k = 0; k < 3; k++)
        a->positions[3 * c->vertices + (size_t)k] = (float)((double)p[k] + placement->offset[k]);
    if (c->from->colors) a->colors[c->vertices] = c->from->colors[vertex];
    c->vertices++;
    return true;
}

/* The number of a vertex in the copy; one that is out of range stays so. */
static bool find_vertex(copying *c, uint32_t vertex, uint32_t group, uint32_t *number) {
    arranged *const a = c->to;
    *number = vertex;
    if (!c->moves) return true;
    *number = UINT32_MAX;
    if (vertex >= c->from->vertex_count) return true;
    moved_vertex *const m = &a->moved[vertex];
    const dp_placement *const placement = placement_of(a, group);
    if (m->number == UINT32_MAX || !is_moved_alike(placement_of(a, m->group), placement)) {
        *m = (moved_vertex){(uint32_t)c->vertices, group};
        if (!add_vertex(c, vertex, placement)) return false;
    }
    *number = m->number;
    return true;
}

static bool add_corner(copying *c, size_t corner, uint32_t group) {
    const dp_batch *const from = c->from;
    arranged *const a = c->to;
    const uint32_t vertex = from->indices         ? from->indices[corner]
                            : corner < UINT32_MAX ? (uint32_t)corner
                                                  : UINT32_MAX;
    if (!find_vertex(c, vertex, group, &a->indices[c->corners])) return false;
    for (int k = 0; k < ATTRIBUTES; k++) {
        const uint32_t *const values = attribute_of(from, k)->indices;
        if (lists_values(c, k)) a->values[k][c->corners] = values ? values[corner] : vertex;
    }
    if (from->edge_flags) a->flags[c->corners] = from->edge_flags[corner];
    c->corners++;
    return true;
}

static bool add_polygon(copying *c, size_t polygon) {
    const dp_batch *const from = c->from;
    arranged *const a = c->to;
    const uint32_t group = group_of(from, polygon);
    const size_t first = from->firsts ? from->firsts[polygon] : 3 * polygon,
                 last = from->firsts ? from->firsts[polygon + 1] : 3 * polygon + 3;
    if (placement_of(a, group)->hidden) return true;
    for (size_t corner = first; corner < last; corner++)
        if (!add_corner(c, corner, group)) return false;
    if (from->groups) a->groups[c->polygons] = (uint16_t)group;
    c->polygons++;
    if (from->firsts) a->firsts[c->polygons] = (uint32_t)c->corners;
    return true;
}

#define RESERVE(array, count)                                                                      \
    dp_reserve(&a->memory, &a->array, &a->array##_cap, (count), sizeof *a->array)

/* Room for all corners of the batch, and no vertex moved yet. */
static bool begin_copy(const copying *c) {
    arranged *const a = c->to;
    const dp_batch *const from = c->from;
    const size_t corners = from->firsts ? from->corner_count : 3 * from->polygon_count;
    for (int k = 0; k < ATTRIBUTES; k++)
        if (lists_values(c, k) && !dp_reserve(&a->memory, &a->values[k], &a->values_cap[k], corners,
                                              sizeof *a->values[k]))
            return false;
    if (!RESERVE(indices, corners) || (from->edge_flags && !RESERVE(flags, corners)) ||
        (from->groups && !RESERVE(groups, from->polygon_count)) ||
        (from->firsts && !RESERVE(firsts, from->polygon_count + 1)) ||
        (c->moves && (!RESERVE(moved, from->vertex_count) || !RESERVE(positions, 3))))
        return false;
    if (from->firsts) a->firsts[0] = 0;
    for (size_t v = 0; v < from->vertex_count && c->moves; v++) a->moved[v].number = UINT32_MAX;
    return true;
}

static dp_attribute attribute_for(const copying *c, int which) {
    dp_attribute attribute = *attribute_of(c->from, which);
    if (lists_values(c, which)) attribute.indices = c->to->values[which];
    return attribute;
}

/* Puts the copy in the batch's place. */
static void end_copy(const copying *c, dp_batch *batch) {
    const arranged *const a = c->to;
    const dp_attribute normals = attribute_for(c, 0), texcoords = attribute_for(c, 1);
    batch->indices = a->indices;
    batch->corner_count = c->corners;
    batch->polygon_count = c->polygons;
    if (batch->firsts) batch->firsts = a->firsts;
    if (batch->edge_flags) batch->edge_flags = a->flags;
    if (batch->groups) batch->groups = a->groups;
    batch->normals = normals, batch->texcoords = texcoords;
    batch->stable = false;
    if (!c->moves) return;
    batch->positions = a->positions;
    batch->position_stride = 3 * sizeof(float);
    batch->vertex_count = c->vertices;
    if (batch->colors) batch->colors = a->colors;
}

static bool copy(arranged *a, bool moves, dp_batch *batch) {
    const dp_batch from = *batch;
    copying c = {.to = a, .from = &from, .moves = moves};
    if (!begin_copy(&c)) return false;
    for (size_t i = 0; i < from.polygon_count; i++)
        if (!add_polygon(&c, i)) return false;
    end_copy(&c, batch);
    return true;
}

/* ------- the source ------- */

static dp_result arranged_next(void *user, dp_batch *batch, dp_diag *diag) {
    arranged *const a = user;
    for (;;) {
        const dp_result result = dp_source_next(a->inner, batch, diag);
        if (result || !batch->polygon_count) return result;
        const changes c = changes_of(a, batch);
        if (!c.kept) continue;
        if (c.kept == batch->polygon_count && !c.moves) return DP_OK;
        if (copy(a, c.moves, batch)) return DP_OK;
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for an arranged batch of %zu polygons",
                       batch->polygon_count);
    }
}

static dp_result arranged_rewind(void *user, dp_diag *diag) {
    return dp_source_rewind(((arranged *)user)->inner, diag);
}

static dp_result arranged_set_time(void *user, double time, dp_diag *diag) {
    return dp_source_set_time(((arranged *)user)->inner, time, diag);
}

static double arranged_duration(void *user) {
    return dp_source_duration(((const arranged *)user)->inner);
}

static void arranged_lend(void *user, dp_threads *threads) {
    dp_source_lend(((const arranged *)user)->inner, threads);
}

static const char *arranged_group_name(void *user, uint32_t group) {
    return dp_source_group_name(((const arranged *)user)->inner, group);
}

static uint32_t arranged_group_color(void *user, uint32_t group) {
    return dp_source_group_color(((const arranged *)user)->inner, group);
}

static const char *arranged_remark(void *user) {
    return dp_source_remark(((const arranged *)user)->inner);
}

static const char *arranged_color_remark(void *user) {
    return dp_source_color_remark(((const arranged *)user)->inner);
}

/* Frees all but the source within. */
static void release(arranged *a) {
    const dp_allocator memory = a->memory;
    dp_arrays_free(&memory, a, DP_ARRAYS(arrays));
    dp_free(&memory, a->placements);
    dp_free(&memory, a);
}

static void arranged_destroy(void *user) {
    dp_source_destroy(((arranged *)user)->inner);
    release(user);
}

/* ------- making ------- */

static arranged *make(dp_source *inner, const dp_placement *placements, uint32_t count,
                      const dp_allocator *memory) {
    arranged *const a = dp_alloc_zeroed(memory, sizeof *a);
    if (!a) return NULL;
    a->inner = inner, a->memory = *memory, a->count = count;
    if (!count) return a;
    a->placements = dp_alloc_array(memory, count, sizeof *a->placements);
    if (!a->placements) return release(a), NULL;
    memcpy(a->placements, placements, count * sizeof *placements);
    return a;
}

static dp_result check(const dp_placement *placements, uint32_t count, dp_diag *diag) {
    if (count > MOST)
        return dp_fail(diag, DP_ERR_LIMIT, "placements of %u groups; there are %d groups at most",
                       count, MOST);
    for (uint32_t g = 0; g < count; g++)
        for (int k = 0; k < 3; k++)
            if (!isfinite(placements[g].offset[k]))
                return dp_fail(diag, DP_ERR_ARGUMENT, "the offset of group %u is not finite", g);
    return DP_OK;
}

dp_result dp_source_arrange(dp_source *source, const dp_placement *placements, uint32_t count,
                            const dp_allocator *allocator, dp_source **out, dp_diag *diag) {
    if (!out) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_source_arrange: out is NULL");
    *out = NULL;
    if (!source || (count && !placements))
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_source_arrange: source or placements is NULL");
    dp_result result = check(placements, count, diag);
    if (result) return result;
    const dp_allocator memory = dp_allocator_resolve(allocator);
    arranged *const a = make(source, placements, count, &memory);
    if (!a) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for an arranged source");
    const dp_source_callbacks *const inner = &source->callbacks;
    const dp_source_callbacks callbacks = {.user = a,
                                           .next = arranged_next,
                                           .rewind = inner->rewind ? arranged_rewind : NULL,
                                           .destroy = arranged_destroy,
                                           .group_name = arranged_group_name,
                                           .group_color = arranged_group_color,
                                           .remark = arranged_remark,
                                           .color_remark = arranged_color_remark,
                                           .up = {inner->up[0], inner->up[1], inner->up[2]},
                                           .up_assumed = inner->up_assumed,
                                           .set_time = arranged_set_time,
                                           .duration = arranged_duration};
    result = dp_source_from_callbacks(&callbacks, &memory, out, diag);
    if (result) return release(a), result;
    (*out)->constant = source->constant;
    (*out)->lend = arranged_lend;
    return DP_OK;
}
