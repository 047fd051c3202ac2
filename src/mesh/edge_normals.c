/* Which normals meet at the ends of each edge.
 *
 *     each position     one normal -> smooth: every edge there has it
 *                       several    -> each edge there collects those of its own polygons:
 *                           one, or two within ALIKE of each other -> smooth, their mean
 *                           two                                    -> a crease runs along the edge
 *                           more                                   -> it runs straight
 *
 * Data structures: the smooth normal by vertex; a hash table of the edges with an end where normals
 * differ, by the positions of its ends. Invariant: what an edge gets depends on its ends and on the
 * polygons that have it, not on which of them asks, so that its curve is the same from all sides.
 * Nothing here depends on the view: it is kept while the model stays the same.
 *
 * Not handled: polygons whose corner lies on another's edge (T-junctions), which share no edge. */
#include "mesh/edge_normals.h"

#include "mesh/fingerprint.h"
#include "mesh/places.h"

#include <string.h>

/* Cosines: normals at one position closer than this (1 degree) are one; two at an edge closer than
 * this (30 degrees) do not make a crease. */
static const double SAME = 0.99985, ALIKE = 0.866;

static const dp_array arrays[] = {DP_ARRAY(dp_edge_normals, smooth, smooth_cap),
                                  DP_ARRAY(dp_edge_normals, hard_at, hard_at_cap),
                                  DP_ARRAY(dp_edge_normals, hard, hard_cap)};
static const dp_array scratch[] = {DP_ARRAY(dp_edge_normals, place, place_cap),
                                   DP_ARRAY(dp_edge_normals, differ, differ_cap),
                                   DP_ARRAY(dp_edge_normals, slots, slots_cap)};

static void free_scratch(dp_edge_normals *n, const dp_allocator *memory) {
    dp_arrays_free(memory, n, DP_ARRAYS(scratch));
    dp_pool_free(&n->pool, memory);
}

void dp_edge_normals_free(dp_edge_normals *n, const dp_allocator *memory) {
    dp_arrays_free(memory, n, DP_ARRAYS(arrays));
    free_scratch(n, memory);
    *n = (dp_edge_normals){0};
}

uint64_t dp_edge_normals_bytes(const dp_edge_normals *n) {
    return dp_arrays_bytes(n, DP_ARRAYS(arrays)) + dp_arrays_bytes(n, DP_ARRAYS(scratch)) +
           n->pool.bytes;
}

/* ------- normals of corners ------- */

static bool is_normal(const float n[3]) {
    const double square = dp_dot(dp_v3f(n), dp_v3f(n));
    return square > 0 && square < (double)INFINITY;
}

uint32_t dp_corner_normal_number(const dp_corner_normals *n, uint32_t corner, uint32_t vertex) {
    const uint32_t given = dp_attribute_number(&n->given, corner, vertex);
    if (given != UINT32_MAX && is_normal(dp_attribute_value(&n->given, given))) return given;
    const uint32_t made = dp_attribute_number(&n->made, corner, vertex);
    if (made == UINT32_MAX || !is_normal(dp_attribute_value(&n->made, made))) return UINT32_MAX;
    return (uint32_t)n->given.count + made;
}

typedef struct job {
    dp_edge_normals *out;
    const dp_polygons *polygons;
    const dp_corner_normals *normals;
    const dp_allocator *memory;
    uint32_t corners;
    size_t slots;
} job;

/* The unit normal of a corner; false: none. */
static bool unit_normal(const job *j, uint32_t corner, uint32_t vertex, dp_vec3 *unit) {
    const uint32_t number = dp_corner_normal_number(j->normals, corner, vertex);
    if (number == UINT32_MAX) return false;
    *unit = dp_unit(dp_v3f(dp_corner_normal_value(j->normals, number)));
    return true;
}

static void put(float to[3], dp_vec3 n) {
    to[0] = (float)n.x, to[1] = (float)n.y, to[2] = (float)n.z;
}

/* ------- by position ------- */

/* The first normal at each position, and whether others differ from it. */
static bool collect_places(const job *j) {
    const dp_polygons *const p = j->polygons;
    dp_edge_normals *const out = j->out;
    bool any = false;
    memset(out->differ, 0, p->vertex_count);
    memset(out->smooth, 0, p->vertex_count * sizeof *out->smooth);
    for (uint32_t c = 0; c < j->corners; c++) {
        const uint32_t v = dp_corner_vertex(p, c);
        dp_vec3 n;
        if (v >= p->vertex_count || !unit_normal(j, c, v, &n)) continue;
        float *const first = out->smooth[out->place[v]];
        const dp_vec3 known = dp_v3f(first);
        if (dp_dot(known, known) == 0)
            put(first, n);
        else if (dp_dot(known, n) < SAME)
            any = true, out->differ[out->place[v]] = 1;
    }
    for (uint32_t v = 0; v < p->vertex_count; v++) {
        const uint32_t place = out->place[v];
        if (out->differ[place])
            memset(out->smooth[v], 0, sizeof *out->smooth);
        else if (place != v)
            memcpy(out->smooth[v], out->smooth[place], sizeof *out->smooth);
    }
    return any;
}

/* ------- by edge ------- */

static size_t hash_of(uint32_t a, uint32_t b) {
    uint64_t h = (a * 0x9e3779b97f4a7c15u) ^ (b * 0xc2b2ae3d27d4eb4fu);
    h ^= h >> 29, h *= 0xbf58476d1ce4e5b9u;
    return (size_t)(h >> 32);
}

/* Finds the edge between two positions, or makes it; NULL when memory is out. */
static dp_hard_edge *edge_between(job *j, uint32_t a, uint32_t b) {
    dp_edge_normals *const out = j->out;
    const uint32_t low = a < b ? a : b, high = a < b ? b : a;
    size_t s = hash_of(low, high) & (j->slots - 1);
    for (; out->slots[s]; s = (s + 1) & (j->slots - 1)) {
        dp_hard_edge *const e = &out->hard[out->slots[s] - 1];
        if (e->place[0] == low && e->place[1] == high) return e;
    }
    if (!dp_reserve(j->memory, &out->hard, &out->hard_cap, out->hard_count + (size_t)1,
                    sizeof *out->hard))
        return NULL;
    dp_hard_edge *const e = &out->hard[out->hard_count];
    *e = (dp_hard_edge){.place = {low, high}};
    out->slots[s] = ++out->hard_count;
    return e;
}

/* Adds a polygon's normal at one end. */
static void add_normal(dp_hard_edge *e, int end, dp_vec3 n) {
    for (int i = 0; i < e->count[end] && i < 2; i++)
        if (dp_dot(dp_v3f(e->normal[end][i]), n) >= SAME) return;
    if (e->count[end] < 2) put(e->normal[end][e->count[end]], n);
    if (e->count[end] < 3) e->count[end]++;
}

static bool add_edge(job *j, uint32_t corner, uint32_t next) {
    const dp_polygons *const p = j->polygons;
    const uint32_t v[2] = {dp_corner_vertex(p, corner), dp_corner_vertex(p, next)};
    if (v[0] >= p->vertex_count || v[1] >= p->vertex_count) return true;
    const uint32_t a = j->out->place[v[0]], b = j->out->place[v[1]];
    if (a == b || !(j->out->differ[a] || j->out->differ[b])) return true;
    dp_hard_edge *const e = edge_between(j, a, b);
    if (!e) return false;
    const uint32_t number = (uint32_t)(e - j->out->hard);
    j->out->hard_at[corner] = 1 + 2 * number + (a == e->place[1]);
    for (int k = 0; k < 2; k++) {
        dp_vec3 n;
        if (unit_normal(j, k ? next : corner, v[k], &n))
            add_normal(e, (k ? b : a) == e->place[1], n);
    }
    return true;
}

/* Two normals that are much the same, or opposite ones, as where winding differs, become their
 * mean. */
static void join_alike(dp_hard_edge *e, int end) {
    const dp_vec3 a = dp_v3f(e->normal[end][0]), b = dp_v3f(e->normal[end][1]);
    const double cosine = dp_dot(a, b);
    if (e->count[end] != 2 || fabs(cosine) < ALIKE) return;
    put(e->normal[end][0], dp_unit(cosine > 0 ? dp_add(a, b) : dp_sub(a, b)));
    e->count[end] = 1;
}

static bool collect_edges(job *j) {
    const dp_polygons *const p = j->polygons;
    dp_edge_normals *const out = j->out;
    while (j->slots < 2 * (size_t)j->corners) j->slots *= 2;
    if (!dp_reserve(j->memory, &out->hard_at, &out->hard_at_cap, j->corners,
                    sizeof *out->hard_at) ||
        !dp_reserve(j->memory, &out->slots, &out->slots_cap, j->slots, sizeof *out->slots))
        return false;
    memset(out->hard_at, 0, j->corners * sizeof *out->hard_at);
    memset(out->slots, 0, j->slots * sizeof *out->slots);
    for (uint32_t i = 0; i < p->count; i++) {
        const uint32_t first = dp_first_corner(p, i), n = dp_corner_count(p, i);
        for (uint32_t k = 0; k < n; k++)
            if (!add_edge(j, first + k, first + (k + 1) % n)) return false;
    }
    for (uint32_t i = 0; i < out->hard_count; i++)
        join_alike(&out->hard[i], 0), join_alike(&out->hard[i], 1);
    return true;
}

/* ------- the whole ------- */

static bool collect(job *j) {
    dp_edge_normals *const out = j->out;
    const size_t vertices = j->polygons->vertex_count;
    const dp_allocator pooled = dp_pool_allocator(&out->pool, j->memory);
    out->hard_count = 0;
    if (!dp_reserve(j->memory, &out->smooth, &out->smooth_cap, vertices, sizeof *out->smooth) ||
        !dp_reserve(j->memory, &out->place, &out->place_cap, vertices, sizeof *out->place) ||
        !dp_reserve(j->memory, &out->differ, &out->differ_cap, vertices, 1) ||
        !dp_find_places(j->polygons, out->place, &pooled))
        return false;
    return !collect_places(j) || collect_edges(j);
}

/* Mixes the values and numbers of an attribute into the key. */
static void mix_attribute(const job *j, const dp_attribute *a, dp_threads *threads, uint64_t *key) {
    const size_t words = a->stride / sizeof(uint32_t);
    *key = *key * 31 + a->count;
    if (!a->values || !a->count) return;
    dp_fingerprint((const uint32_t *)(const void *)a->values, (a->count - 1) * words + 3, threads,
                   key);
    if (a->indices) dp_fingerprint(a->indices, j->corners, threads, key);
}

bool dp_edge_normals_collect(dp_edge_normals *out, const dp_polygons *polygons,
                             const dp_corner_normals *normals, dp_threads *threads,
                             const dp_allocator *memory) {
    job j = {out,
             polygons,
             normals,
             memory,
             polygons->firsts ? polygons->firsts[polygons->count] : 3 * polygons->count,
             64};
    uint64_t key = dp_shape_fingerprint(polygons, threads);
    mix_attribute(&j, &normals->given, threads, &key);
    mix_attribute(&j, &normals->made, threads, &key);
    if (key && key == out->key) return true;
    const bool keeps = out->key || out->moves;
    out->key = 0;
    const bool collected = collect(&j);
    if (!collected || !keeps) free_scratch(out, memory);
    if (collected) out->key = key;
    return collected;
}

/* ------- asking ------- */

static dp_pn_end end_of(const dp_hard_edge *e, int end) {
    dp_pn_end out = {.count = e->count[end] <= 2 ? e->count[end] : 0};
    for (uint32_t i = 0; i < out.count; i++) out.normal[i] = dp_v3f(e->normal[end][i]);
    return out;
}

static dp_pn_end own_end(const dp_corner_normals *normals, uint32_t number) {
    if (number == UINT32_MAX) return (dp_pn_end){.count = 0};
    return (dp_pn_end){1, {dp_unit(dp_v3f(dp_corner_normal_value(normals, number)))}};
}

void dp_edge_ends_at(const dp_edge_normals *collected, const dp_corner_normals *normals,
                     const uint32_t vertices[2], uint32_t edge, const uint32_t own[2],
                     dp_pn_end ends[2]) {
    const bool is_diagonal = edge == UINT32_MAX;
    const uint32_t hard = collected->hard_count && !is_diagonal ? collected->hard_at[edge] : 0;
    for (int k = 0; k < 2; k++) {
        const dp_vec3 n = dp_v3f(collected->smooth[vertices[k]]);
        if (dp_dot(n, n) > 0)
            ends[k] = (dp_pn_end){1, {n}};
        else if (hard)
            ends[k] = end_of(&collected->hard[(hard - 1) / 2], k ^ (int)((hard - 1) & 1));
        else
            ends[k] = is_diagonal ? own_end(normals, own[k]) : (dp_pn_end){.count = 0};
    }
}
