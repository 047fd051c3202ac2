/* Smoothing, between gathering and vertices: the frame's polygons become those of curved patches.
 *
 *     count    each polygon: into how many parts its edges are cut (curve.h), by block in parallel;
 *              how many polygons, corners and vertices it becomes
 *     number   where each block's begin
 *     make     each polygon, by block in parallel: itself where no edge is cut, else the triangles of
 *              its patches
 *
 * A polygon of more than three corners is a fan of patches around its first corner; their common edges
 * are curved like others. Vertices of a patch are its own: positions name vertices, so that neighbours
 * still meet (docs/architecture.md, invariant 6). Original vertices keep their numbers.
 *
 * Invariant: the points on an edge depend on its positions and their normals alone; so neighbours have
 * the same ones, bit for bit, and no crack opens. Nothing depends on threads.
 *
 * Not handled: T-junctions; there cracks are as wide as the curve leaves the chord. */
#include "core/smooth.h"

#include "base/diag.h"
#include "base/hostile.h"
#include "core/curve.h"
#include "core/patch.h"

#include <string.h>

enum { BLOCK = DP_TUNED(1024, 3), MOST = 1 << 30 };

typedef struct dp_smooth_block {
    uint64_t polygons, corners, vertices; /* how many; then the first's number */
} dp_smooth_block;

static const dp_array arrays[] = {DP_ARRAY(dp_smooth_store, parts, parts_cap),
                                  DP_ARRAY(dp_smooth_store, blocks, blocks_cap),
                                  DP_ARRAY(dp_smooth_store, facing, facing_cap),
                                  DP_ARRAY(dp_smooth_store, positions, positions_cap),
                                  DP_ARRAY(dp_smooth_store, corners, corners_cap),
                                  DP_ARRAY(dp_smooth_store, firsts, firsts_cap),
                                  DP_ARRAY(dp_smooth_store, source_polygon, source_cap),
                                  DP_ARRAY(dp_smooth_store, colors, colors_cap),
                                  DP_ARRAY(dp_smooth_store, groups, groups_cap),
                                  DP_ARRAY(dp_smooth_store, source_edges, source_edges_cap),
                                  DP_ARRAY(dp_smooth_store, edge_flags, flags_cap),
                                  DP_ARRAY(dp_smooth_store, smooth_edges, smooth_edges_cap),
                                  DP_ARRAY(dp_smooth_store, normals, normals_cap),
                                  DP_ARRAY(dp_smooth_store, texcoords, texcoords_cap),
                                  DP_ARRAY(dp_smooth_store, normal_at, normal_at_cap),
                                  DP_ARRAY(dp_smooth_store, texcoord_at, texcoord_at_cap)};

void dp_smooth_store_free(dp_smooth_store *store, const dp_allocator *memory) {
    dp_edge_normals_free(&store->edges, memory);
    dp_arrays_free(memory, store, DP_ARRAYS(arrays));
    *store = (dp_smooth_store){0};
}

uint64_t dp_smooth_store_bytes(const dp_smooth_store *store) {
    return dp_edge_normals_bytes(&store->edges) + dp_arrays_bytes(store, DP_ARRAYS(arrays));
}

typedef struct job {
    dp_smooth_store *store;
    const dp_smooth_setup *setup;
    const dp_polygons *from;
    dp_curve_rule rule;
    uint32_t blocks, corner_total;
    bool flags;
} job;

static uint32_t block_end(const job *j, uint32_t index) {
    const uint32_t first = index * BLOCK;
    return j->from->count - first < BLOCK ? j->from->count : first + BLOCK;
}

/* ------- count ------- */

/* How smooth vertices face the eye; 0: not known. */
static void face_block(void *arg, uint32_t index, uint32_t worker) {
    const job *const j = arg;
    const uint32_t first = index * BLOCK, count = j->from->vertex_count,
                   last = count - first < BLOCK ? count : first + BLOCK;
    (void)worker;
    for (uint32_t v = first; v < last; v++)
        j->store->facing[v] =
            (float)dp_curve_facing(j->rule.view, dp_v3f(dp_vertex_position(j->from, v)),
                                   dp_v3f(j->store->edges.smooth[v]));
}

/* Can a polygon be curved? Binning drops those that cannot be drawn. */
static bool is_sound(const dp_polygons *p, uint32_t first, uint32_t n) {
    if (n < 3 || n >= UINT16_MAX) return false;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t v = dp_corner_vertex(p, first + i);
        if (v >= p->vertex_count) return false;
        const float *const at = dp_vertex_position(p, v);
        if (!isfinite(at[0]) || !isfinite(at[1]) || !isfinite(at[2])) return false;
    }
    return true;
}

/* For silhouettes alone: is the edge between two vertices known to be straight, by how these face the
 * eye? */
static bool is_far(const job *j, const uint32_t v[2]) {
    const dp_smooth_store *const s = j->store;
    return j->rule.what == DP_SMOOTH_SILHOUETTES &&
           dp_curve_is_far(dp_v3f(s->edges.smooth[v[0]]), (double)s->facing[v[0]],
                           dp_v3f(s->edges.smooth[v[1]]), (double)s->facing[v[1]]);
}

/* The curve from one corner to another; what is noted of it. `edge`: the corner where the polygon's edge between them
 * starts, or UINT32_MAX for a diagonal. The same whenever it is asked: counting and making must agree. */
static uint32_t curve_between(const job *j, uint32_t from, uint32_t to, uint32_t edge,
                              dp_pn_edge *curve) {
    const dp_polygons *const p = j->from;
    const uint32_t v[2] = {dp_corner_vertex(p, from), dp_corner_vertex(p, to)};
    const dp_vec3 a = dp_v3f(dp_vertex_position(p, v[0])), b = dp_v3f(dp_vertex_position(p, v[1]));
    if (is_far(j, v)) {
        *curve = dp_pn_edge_straight(a, b);
        return 1 | DP_NOTED_SMOOTH;
    }
    uint32_t own[2] = {UINT32_MAX, UINT32_MAX};
    if (edge == UINT32_MAX) {
        own[0] = dp_corner_normal_number(&j->setup->normals, from, v[0]);
        own[1] = dp_corner_normal_number(&j->setup->normals, to, v[1]);
    }
    dp_pn_end ends[2];
    dp_edge_ends_at(&j->store->edges, &j->setup->normals, v, edge, own, ends);
    const uint32_t parts = dp_curve_parts(&j->rule, a, b, ends, curve);
    return ends[0].count == 1 && ends[1].count == 1 ? parts | DP_NOTED_SMOOTH : parts;
}

/* Notes into how many parts its edges are cut; is any cut? */
static bool cut_edges(const job *j, uint32_t first, uint32_t n) {
    bool any = false;
    if (!is_sound(j->from, first, n)) {
        memset(j->store->parts + first, 1, n);
        return false;
    }
    for (uint32_t i = 0; i < n; i++) {
        dp_pn_edge curve;
        const uint32_t edge = first + i, next = first + (i + 1 == n ? 0 : i + 1);
        const uint32_t noted = curve_between(j, edge, next, edge, &curve);
        j->store->parts[edge] = (uint8_t)noted;
        any |= (noted & DP_NOTED_PARTS) > 1;
    }
    return any;
}

/* The curves and parts of the patch over corners 0, i and i + 1 of a polygon. */
static void curves_of(const job *j, uint32_t first, uint32_t n, uint32_t i, dp_pn_edge curves[3],
                      uint32_t parts[3]) {
    const uint32_t corner[3] = {first, first + i, first + i + 1};
    for (int k = 0; k < 3; k++) {
        const bool diagonal = dp_is_fan_diagonal(n, i, k);
        parts[k] = DP_NOTED_PARTS & curve_between(j, corner[k], corner[(k + 1) % 3],
                                                  diagonal ? UINT32_MAX : corner[k], &curves[k]);
    }
}

static void count_curved(const job *j, uint32_t first, uint32_t n, dp_smooth_block *sum) {
    for (uint32_t i = 1; i + 1 < n; i++) {
        dp_pn_edge curves[3];
        uint32_t parts[3];
        for (uint32_t k = 0; k < 3; k++) parts[k] = j->store->parts[first + k] & DP_NOTED_PARTS;
        if (n > 3) curves_of(j, first, n, i, curves, parts);
        const uint32_t triangles = dp_pn_triangle_count(parts);
        sum->polygons += triangles;
        sum->corners += 3 * (uint64_t)triangles;
        sum->vertices += dp_pn_new_vertices(parts);
    }
}

static void count_block(void *arg, uint32_t index, uint32_t worker) {
    const job *const j = arg;
    dp_smooth_block sum = {0, 0, 0};
    (void)worker;
    for (uint32_t i = index * BLOCK; i < block_end(j, index); i++) {
        const uint32_t first = dp_first_corner(j->from, i), n = dp_corner_count(j->from, i);
        if (cut_edges(j, first, n)) {
            count_curved(j, first, n, &sum);
            j->store->parts[first] |= DP_NOTED_CURVED;
        } else {
            sum.polygons++, sum.corners += n;
        }
    }
    j->store->blocks[index] = sum;
}

/* Turns counts into first numbers; returns the sums. */
static dp_smooth_block number(const job *j) {
    dp_smooth_block sum = {0, 0, j->from->vertex_count};
    for (uint32_t i = 0; i < j->blocks; i++) {
        const dp_smooth_block block = j->store->blocks[i];
        j->store->blocks[i] = sum;
        sum.polygons += block.polygons;
        sum.corners += block.corners;
        sum.vertices += block.vertices;
    }
    return sum;
}

/* ------- make ------- */

static dp_patch_target target_of(const job *j, const dp_smooth_block *at, dp_pn_grid *grid) {
    dp_smooth_store *const s = j->store;
    return (dp_patch_target){
        .from = j->from,
        .positions = s->positions,
        .corners = s->corners,
        .firsts = j->from->firsts ? s->firsts : NULL,
        .source_polygon = s->source_polygon,
        .source_edges = s->source_edges,
        .groups = j->from->groups ? s->groups : NULL,
        .edge_flags = j->flags ? s->edge_flags : NULL,
        .colors = j->from->colors ? s->colors : NULL,
        .noted = s->parts,
        .smooth_edges = s->smooth_edges,
        .corner_normals = &j->setup->normals,
        .normals = j->setup->wants_normals ? s->normals : NULL,
        .normal_at = s->normal_at,
        .normal_base = (uint32_t)(j->setup->normals.given.count + j->setup->normals.made.count),
        .texcoords = j->from->texcoords.values ? s->texcoords : NULL,
        .texcoord_at = s->texcoord_at,
        .grid = grid,
        .polygon = (uint32_t)at->polygons,
        .corner = (uint32_t)at->corners,
        .vertex = (uint32_t)at->vertices};
}

static void make_curved(const job *j, dp_patch_target *t, uint32_t polygon) {
    const uint32_t first = dp_first_corner(j->from, polygon), n = dp_corner_count(j->from, polygon);
    for (uint32_t i = 1; i + 1 < n; i++) {
        dp_pn_edge curves[3];
        uint32_t parts[3];
        curves_of(j, first, n, i, curves, parts);
        dp_patch_put(t, polygon, i, curves, parts);
    }
}

static void make_block(void *arg, uint32_t index, uint32_t worker) {
    const job *const j = arg;
    dp_pn_grid grid = {.parts = {0, 0, 0}};
    dp_patch_target t = target_of(j, &j->store->blocks[index], &grid);
    (void)worker;
    for (uint32_t i = index * BLOCK; i < block_end(j, index); i++) {
        if (dp_corner_count(j->from, i) &&
            j->store->parts[dp_first_corner(j->from, i)] & DP_NOTED_CURVED)
            make_curved(j, &t, i);
        else
            dp_patch_put_flat(&t, i);
    }
}

/* What was there keeps its number. */
static void copy_vertices(void *arg, uint32_t index, uint32_t worker) {
    const job *const j = arg;
    const uint32_t first = index * BLOCK, count = j->from->vertex_count,
                   last = count - first < BLOCK ? count : first + BLOCK;
    (void)worker;
    for (uint32_t v = first; v < last; v++)
        memcpy(j->store->positions[v], dp_vertex_position(j->from, v), sizeof(float[3]));
    if (j->from->colors)
        memcpy(j->store->colors + first, j->from->colors + first,
               (last - first) * sizeof *j->store->colors);
}

static void copy_values(const dp_attribute *a, void *to, size_t size) {
    for (size_t i = 0; i < a->count && a->values; i++)
        memcpy((char *)to + i * size, dp_attribute_value(a, (uint32_t)i), size);
}

static void copy_attributes(const job *j) {
    const dp_corner_normals *const n = &j->setup->normals;
    if (j->setup->wants_normals) {
        copy_values(&n->given, j->store->normals, sizeof *j->store->normals);
        copy_values(&n->made, j->store->normals + n->given.count, sizeof *j->store->normals);
    }
    if (j->from->texcoords.values)
        copy_values(&j->from->texcoords, j->store->texcoords, sizeof *j->store->texcoords);
}

/* ------- the whole ------- */

static bool reserve_attributes(const job *j, const dp_smooth_block *sum, const dp_allocator *m) {
    dp_smooth_store *const s = j->store;
    const dp_corner_normals *const n = &j->setup->normals;
    const size_t corners = sum->corners, added = sum->vertices - j->from->vertex_count;
    return (!j->setup->wants_normals ||
            (dp_reserve(m, &s->normals, &s->normals_cap, n->given.count + n->made.count + added + 1,
                        sizeof *s->normals) &&
             dp_reserve(m, &s->normal_at, &s->normal_at_cap, corners, sizeof *s->normal_at))) &&
           (!j->from->texcoords.values ||
            (dp_reserve(m, &s->texcoords, &s->texcoords_cap, j->from->texcoords.count + added + 1,
                        sizeof *s->texcoords) &&
             dp_reserve(m, &s->texcoord_at, &s->texcoord_at_cap, corners, sizeof *s->texcoord_at)));
}

static bool reserve(const job *j, const dp_smooth_block *sum, const dp_allocator *m) {
    dp_smooth_store *const s = j->store;
    const dp_polygons *const p = j->from;
    const size_t polygons = sum->polygons, corners = sum->corners, vertices = sum->vertices;
    return dp_reserve(m, &s->positions, &s->positions_cap, vertices, sizeof *s->positions) &&
           dp_reserve(m, &s->corners, &s->corners_cap, corners, sizeof *s->corners) &&
           dp_reserve(m, &s->source_polygon, &s->source_cap, polygons, sizeof *s->source_polygon) &&
           dp_reserve(m, &s->source_edges, &s->source_edges_cap, corners,
                      sizeof *s->source_edges) &&
           dp_reserve(m, &s->smooth_edges, &s->smooth_edges_cap, corners, 1) &&
           (!p->firsts ||
            dp_reserve(m, &s->firsts, &s->firsts_cap, polygons + 1, sizeof *s->firsts)) &&
           (!p->colors || dp_reserve(m, &s->colors, &s->colors_cap, vertices, sizeof *s->colors)) &&
           (!p->groups || dp_reserve(m, &s->groups, &s->groups_cap, polygons, sizeof *s->groups)) &&
           (!j->flags || dp_reserve(m, &s->edge_flags, &s->flags_cap, corners, 1)) &&
           reserve_attributes(j, sum, m);
}

/* What the store holds, as the frame's polygons. */
static dp_polygons made(const job *j, const dp_smooth_block *sum) {
    const dp_smooth_store *const s = j->store;
    const dp_polygons *const p = j->from;
    const dp_corner_normals *const n = &j->setup->normals;
    const size_t added = sum->vertices - p->vertex_count;
    dp_polygons out = {.positions = s->positions[0],
                       .stride = sizeof *s->positions,
                       .vertex_count = (uint32_t)sum->vertices,
                       .made_vertices = (uint32_t)added,
                       .corners = s->corners,
                       .firsts = p->firsts ? s->firsts : NULL,
                       .edge_flags = j->flags ? s->edge_flags : NULL,
                       .has_diagonals = j->flags,
                       .source_polygon = s->source_polygon,
                       .source_edges = s->source_edges,
                       .smooth_edges = s->smooth_edges,
                       .groups = p->groups ? s->groups : NULL,
                       .colors = p->colors ? s->colors : NULL,
                       .count = (uint32_t)sum->polygons};
    if (p->firsts) s->firsts[out.count] = (uint32_t)sum->corners;
    if (j->setup->wants_normals)
        out.normals = (dp_attribute){.values = s->normals[0],
                                     .stride = sizeof *s->normals,
                                     .count = n->given.count + n->made.count + added,
                                     .indices = s->normal_at};
    if (p->texcoords.values)
        out.texcoords = (dp_attribute){.values = s->texcoords[0],
                                       .stride = sizeof *s->texcoords,
                                       .count = p->texcoords.count + added,
                                       .indices = s->texcoord_at};
    return out;
}

static bool begin(job *j, const dp_frame *f) {
    return dp_edge_normals_collect(&j->store->edges, j->from, &j->setup->normals, f->threads,
                                   f->memory) &&
           dp_reserve(f->memory, &j->store->parts, &j->store->parts_cap, j->corner_total, 1) &&
           dp_reserve(f->memory, &j->store->facing, &j->store->facing_cap, j->from->vertex_count,
                      sizeof *j->store->facing) &&
           dp_reserve(f->memory, &j->store->blocks, &j->store->blocks_cap, j->blocks,
                      sizeof *j->store->blocks);
}

static dp_result smooth(job *j, dp_frame *f, dp_diag *diag) {
    const dp_polygons *const p = j->from;
    if (!begin(j, f)) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for curved triangles");
    const uint32_t vertex_blocks = p->vertex_count / BLOCK + (p->vertex_count % BLOCK != 0);
    if (j->rule.what == DP_SMOOTH_SILHOUETTES)
        dp_parallel(f->threads, vertex_blocks, face_block, j);
    dp_parallel(f->threads, j->blocks, count_block, j);
    const dp_smooth_block sum = number(j);
    if (sum.polygons > MOST || sum.vertices > MOST || sum.corners > UINT32_MAX)
        return dp_fail(diag, DP_ERR_LIMIT,
                       "smoothing makes %llu polygons of %u; %d are the most: choose a lower level",
                       (unsigned long long)sum.polygons, p->count, MOST);
    if (!reserve(j, &sum, f->memory))
        return dp_fail(diag, DP_ERR_MEMORY,
                       "out of memory for %llu curved triangles; a lower level of smoothing makes "
                       "fewer",
                       (unsigned long long)sum.polygons);
    dp_parallel(f->threads, vertex_blocks, copy_vertices, j);
    copy_attributes(j);
    dp_parallel(f->threads, j->blocks, make_block, j);
    f->polygons = made(j, &sum);
    return DP_OK;
}

dp_result dp_smooth_polygons(dp_smooth_store *store, const dp_smooth_setup *setup, dp_frame *f,
                             dp_diag *diag) {
    const dp_polygons from = f->polygons;
    if (!from.count || !from.vertex_count) return DP_OK;
    job j = {.store = store,
             .setup = setup,
             .from = &from,
             .rule = {&f->view, setup->what, setup->level},
             .blocks = from.count / BLOCK + (from.count % BLOCK != 0),
             .corner_total = from.firsts ? from.firsts[from.count] : 3 * from.count,
             .flags = from.edge_flags || setup->wants_flags};
    return smooth(&j, f, diag);
}
