/* Adjacency: for every edge of every polygon, the edge of the other polygon that coincides with it.
 *
 *     weld          stands_for[v] = the first vertex at v's position, so that index buffers, split
 *                     vertices and soups give the same adjacency
 *     fill_buckets  counting sort: each corner into the bucket of its edge's lower vertex
 *     match         each bucket, in parallel: sort by higher vertex; for each run of one edge
 *                     1 corner     open
 *                     2 corners    pair, flipped if both run the edge the same way
 *                     more: a fan  sort by angle about the edge; pair neighbours whose fronts face
 *                                    each other (they bound one wedge of the outside), again and
 *                                    again; pair the others as they come
 *     note_odd      polygons with an open or flipped edge
 *     note_fans     corners of fans
 *
 * Linear in the number of edges. Invariant: across[across[c]] == c, flipped or not.
 *
 * Not handled: neighbours that share no corner (T-junctions); their edges are open. Beyond
 * LARGEST_FAN polygons at an edge, the others are open. */
#include "mesh/adjacency.h"

#include "base/elementary.h"
#include "base/hostile.h"
#include "base/sort.h"
#include "base/vec.h"
#include "mesh/fingerprint.h"
#include "mesh/places.h"
#include "mesh/batch.h"
#include <drypoint/adjacency.h>

#include "base/diag.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { BLOCK = DP_TUNED(16384, 5), LARGEST_FAN = 64 };

typedef struct builder {
    dp_adjacency *out;
    const dp_polygons *polygons;
    uint32_t *stands_for; /* [vertices] the first vertex at its position */
    uint32_t *first;      /* [vertices + 1] bucket of a lower vertex */
    uint32_t *bucket;     /* corners by lower vertex; within it in order, until matched */
} builder;

static const dp_array arrays[] = {DP_ARRAY(dp_adjacency, across, across_cap),
                                  DP_ARRAY(dp_adjacency, polygon_of, polygon_cap),
                                  DP_ARRAY(dp_adjacency, twins, twins_cap),
                                  DP_ARRAY(dp_adjacency, odd, odd_cap),
                                  DP_ARRAY(dp_adjacency, fans, fans_cap),
                                  DP_ARRAY(dp_adjacency, fan_corners, fan_corners_cap)};

void dp_adjacency_free(dp_adjacency *adjacency, const dp_allocator *memory) {
    dp_arrays_free(memory, adjacency, DP_ARRAYS(arrays));
    *adjacency = (dp_adjacency){0};
}

uint64_t dp_adjacency_bytes(const dp_adjacency *adjacency) {
    return dp_arrays_bytes(adjacency, DP_ARRAYS(arrays));
}

/* ------- is it still valid? ------- */

static uint32_t corner_total(const dp_polygons *p) {
    return p->firsts ? p->firsts[p->count] : 3 * p->count;
}

static bool same_place(const float *p, const float *q) {
    return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
}

static bool twins_hold(const dp_adjacency *a, const dp_polygons *p) {
    for (size_t i = 0; i < a->twin_count; i++)
        if (!same_place(dp_vertex_position(p, a->twins[i][0]),
                        dp_vertex_position(p, a->twins[i][1])))
            return false;
    return true;
}

/* ------- vertices by position ------- */

static bool add_twin(builder *b, const dp_allocator *memory, uint32_t vertex, uint32_t first) {
    dp_adjacency *const a = b->out;
    if (!dp_reserve(memory, &a->twins, &a->twins_cap, a->twin_count + 1, sizeof *a->twins))
        return false;
    a->twins[a->twin_count][0] = vertex, a->twins[a->twin_count++][1] = first;
    return true;
}

static bool weld(builder *b, const dp_allocator *memory) {
    b->out->twin_count = 0;
    if (!dp_find_places(b->polygons, b->stands_for, memory)) return false;
    for (uint32_t v = 0; v < b->polygons->vertex_count; v++)
        if (b->stands_for[v] != v && !add_twin(b, memory, v, b->stands_for[v])) return false;
    return true;
}

/* ------- edges into buckets ------- */

typedef struct edge {
    uint32_t from, to; /* vertices that stand for their position */
} edge;

static uint32_t vertex_at(const builder *b, uint32_t corner) {
    const uint32_t v = dp_corner_vertex(b->polygons, corner);
    return v < b->polygons->vertex_count ? b->stands_for[v] : UINT32_MAX;
}

static uint32_t next_corner(const builder *b, uint32_t corner) {
    const uint32_t polygon = dp_polygon_of_corner(b->out, corner);
    const uint32_t first = dp_first_corner(b->polygons, polygon),
                   n = dp_corner_count(b->polygons, polygon);
    return corner + 1 - first == n ? first : corner + 1;
}

static edge edge_at(const builder *b, uint32_t corner) {
    return (edge){vertex_at(b, corner), vertex_at(b, next_corner(b, corner))};
}

static uint32_t lower(edge e) { return e.from < e.to ? e.from : e.to; }
static uint32_t higher(edge e) { return e.from < e.to ? e.to : e.from; }

/* Every index in range; and a triangle needs three places. */
static bool is_useful(const builder *b, uint32_t first, uint32_t n) {
    for (uint32_t i = 0; i < n; i++)
        if (vertex_at(b, first + i) == UINT32_MAX) return false;
    if (n != 3) return n > 3;
    const uint32_t p = vertex_at(b, first), q = vertex_at(b, first + 1),
                   r = vertex_at(b, first + 2);
    return p != q && q != r && r != p;
}

static void name_polygons(builder *b) {
    const dp_polygons *const p = b->polygons;
    for (uint32_t i = 0; b->out->polygon_of && i < p->count; i++)
        for (uint32_t c = p->firsts[i]; c < p->firsts[i + 1]; c++) b->out->polygon_of[c] = i;
}

/* Counting sort by lower vertex. Corners without an edge become DP_ACROSS_NONE. */
static void fill_buckets(builder *b) {
    const dp_polygons *const p = b->polygons;
    memset(b->first, 0, ((size_t)p->vertex_count + 1) * sizeof *b->first);
    for (int placing = 0; placing < 2; placing++) {
        for (uint32_t i = 0; i < p->count; i++) {
            const uint32_t first = dp_first_corner(p, i), n = dp_corner_count(p, i);
            const bool useful = is_useful(b, first, n);
            for (uint32_t c = first; c < first + n; c++) {
                const edge e = useful ? edge_at(b, c) : (edge){0, 0};
                if (e.from == e.to)
                    b->out->across[c] = DP_ACROSS_NONE;
                else if (placing)
                    b->bucket[b->first[lower(e)]++] = c;
                else
                    b->first[lower(e)]++, b->out->across[c] = DP_ACROSS_OPEN;
            }
        }
        uint32_t sum = 0, last = 0;
        for (uint32_t v = 0; v <= p->vertex_count; v++) {
            const uint32_t count = b->first[v];
            /* placing has moved each start to its end, which is the next one's start */
            b->first[v] = placing ? last : sum;
            sum += count, last = count;
        }
    }
}

/* ------- matching ------- */

static void pair(const builder *b, uint32_t c, uint32_t d) {
    const bool flipped = edge_at(b, c).from == edge_at(b, d).from;
    b->out->across[c] = d | (flipped ? DP_ACROSS_FLIPPED : 0);
    b->out->across[d] = c | (flipped ? DP_ACROSS_FLIPPED : 0);
}

/* A polygon at an edge with more than two. */
typedef struct incident_face {
    double angle; /* about the edge, from lower to higher vertex */
    uint32_t corner;
    bool forward; /* runs the edge from lower to higher: its front faces growing angles */
} incident_face;

static int by_angle(const void *left, const void *right) {
    const incident_face *const l = left, *const r = right;
    if (l->angle != r->angle) return l->angle < r->angle ? -1 : 1;
    if (l->forward != r->forward)
        return l->forward ? 1 : -1; /* two sides of a sheet, with the inside between them */
    return (l->corner > r->corner) - (l->corner < r->corner);
}

static dp_vec3 position(const builder *b, uint32_t vertex) {
    return dp_v3f(dp_vertex_position(b->polygons, vertex));
}

static incident_face make_incident_face(const builder *b, uint32_t corner, dp_vec3 from, dp_vec3 x,
                                        dp_vec3 y) {
    const uint32_t polygon = dp_polygon_of_corner(b->out, corner);
    const uint32_t first = dp_first_corner(b->polygons, polygon),
                   n = dp_corner_count(b->polygons, polygon);
    const uint32_t far = first + (corner - first + 1 + n / 2) % n;
    const dp_vec3 w = dp_sub(position(b, vertex_at(b, far)), from);
    const edge e = edge_at(b, corner);
    return (incident_face){dp_atan2(dp_dot(w, y), dp_dot(w, x)), corner, e.from == lower(e)};
}

/* Pairs neighbours in the circle whose fronts face each other, and takes them out, until there are
 * none; returns how many are left. */
static uint32_t pair_wedges(const builder *b, incident_face *faces, uint32_t n) {
    for (bool found = true; found && n > 1;) {
        found = false;
        for (uint32_t i = 0; i < n && n > 1; i++) {
            const uint32_t next = i + 1 == n ? 0 : i + 1;
            if (!faces[i].forward || faces[next].forward) continue;
            pair(b, faces[i].corner, faces[next].corner);
            const uint32_t high = i > next ? i : next, low = i > next ? next : i;
            memmove(faces + high, faces + high + 1, (n - high - 1) * sizeof *faces);
            memmove(faces + low, faces + low + 1, (n - low - 2) * sizeof *faces);
            n -= 2;
            found = true;
        }
    }
    return n;
}

static void match_fan(const builder *b, const uint32_t *corners, uint32_t n) {
    incident_face faces[LARGEST_FAN];
    if (n > LARGEST_FAN) n = LARGEST_FAN; /* the others stay open */
    const edge e = edge_at(b, corners[0]);
    const dp_vec3 from = position(b, lower(e)), d = dp_unit(dp_sub(position(b, higher(e)), from));
    const dp_vec3 axis = fabs(d.x) < 0.6 ? dp_v3(1, 0, 0) : dp_v3(0, 1, 0);
    const dp_vec3 x = dp_unit(dp_cross(axis, d)), y = dp_cross(d, x);
    for (uint32_t i = 0; i < n; i++) faces[i] = make_incident_face(b, corners[i], from, x, y);
    dp_sort(faces, n, sizeof *faces, by_angle);
    const uint32_t left = pair_wedges(b, faces, n);
    for (uint32_t i = 0; i + 1 < left; i += 2) pair(b, faces[i].corner, faces[i + 1].corner);
}

/* An entry of a bucket with its key. */
typedef struct entry {
    uint32_t higher, corner;
} entry;

static int by_higher(const void *left, const void *right) {
    const entry *const l = left, *const r = right;
    if (l->higher != r->higher) return l->higher < r->higher ? -1 : 1;
    return (l->corner > r->corner) - (l->corner < r->corner);
}

static void match_run(const builder *b, const uint32_t *corners, uint32_t n) {
    if (n == 2)
        pair(b, corners[0], corners[1]);
    else if (n > 2)
        match_fan(b, corners, n);
}

/* Sorts a bucket by insertion, which is fast for the few edges of most vertices. */
static void sort_small(const builder *b, uint32_t *corners, uint32_t n) {
    for (uint32_t i = 1; i < n; i++) {
        const uint32_t corner = corners[i], key = higher(edge_at(b, corner));
        uint32_t k = i;
        for (; k && higher(edge_at(b, corners[k - 1])) > key; k--) corners[k] = corners[k - 1];
        corners[k] = corner;
    }
}

/* The same for a vertex with many edges; `entries` has room for the bucket. */
static void sort_large(const builder *b, uint32_t *corners, uint32_t n, entry *entries) {
    for (uint32_t i = 0; i < n; i++)
        entries[i] = (entry){higher(edge_at(b, corners[i])), corners[i]};
    dp_sort(entries, n, sizeof *entries, by_higher);
    for (uint32_t i = 0; i < n; i++) corners[i] = entries[i].corner;
}

typedef struct matching {
    const builder *builder;
    const dp_allocator *memory;
    bool *failed; /* [blocks] */
} matching;

enum { SMALL = DP_TUNED(48, 3) };

static bool match_vertex(const matching *m, uint32_t v) {
    const builder *const b = m->builder;
    uint32_t *const corners = b->bucket + b->first[v];
    const uint32_t n = b->first[v + 1] - b->first[v];
    if (n <= SMALL)
        sort_small(b, corners, n);
    else {
        entry *const entries = dp_alloc_array(m->memory, n, sizeof *entries);
        if (!entries) return false;
        sort_large(b, corners, n, entries);
        dp_free(m->memory, entries);
    }
    uint32_t start = 0;
    for (uint32_t i = 1; i <= n; i++) {
        if (i < n && higher(edge_at(b, corners[i])) == higher(edge_at(b, corners[start]))) continue;
        match_run(b, corners + start, i - start);
        start = i;
    }
    return true;
}

static void match_block(void *arg, uint32_t index, uint32_t worker) {
    const matching *const m = arg;
    const uint32_t first = index * BLOCK, count = m->builder->polygons->vertex_count;
    const uint32_t last = count - first < BLOCK ? count : first + BLOCK;
    (void)worker;
    for (uint32_t v = first; v < last; v++)
        if (!match_vertex(m, v)) m->failed[index] = true;
}

static bool match(const builder *b, dp_threads *threads, const dp_allocator *memory) {
    const uint32_t blocks = b->polygons->vertex_count / BLOCK + 1;
    matching m = {b, memory, dp_alloc_zeroed(memory, blocks)};
    if (!m.failed) return false;
    dp_parallel(threads, b->polygons->vertex_count % BLOCK ? blocks : blocks - 1, match_block, &m);
    bool sound = true;
    for (uint32_t i = 0; i < blocks; i++) sound = sound && !m.failed[i];
    dp_free(memory, m.failed);
    return sound;
}

static int by_corner(const void *left, const void *right) {
    const dp_fan_corner *const l = left, *const r = right;
    return (l->corner > r->corner) - (l->corner < r->corner);
}

static bool note_fan(const builder *b, const uint32_t *corners, uint32_t n,
                     const dp_allocator *memory) {
    dp_adjacency *const a = b->out;
    if (!dp_reserve(memory, &a->fans, &a->fans_cap, a->fan_count + n, sizeof *a->fans) ||
        !dp_reserve(memory, &a->fan_corners, &a->fan_corners_cap, a->fan_count + n,
                    sizeof *a->fan_corners))
        return false;
    const uint32_t first = (uint32_t)a->fan_count;
    for (uint32_t i = 0; i < n; i++) {
        a->fans[first + i] = corners[i];
        a->fan_corners[first + i] = (dp_fan_corner){corners[i], first, n};
        a->odd[dp_polygon_of_corner(a, corners[i])] = true;
    }
    a->fan_count += n;
    return true;
}

/* Notes runs of more than two in the buckets, which matching has sorted. */
static bool note_fans(const builder *b, const dp_allocator *memory) {
    b->out->fan_count = 0;
    for (uint32_t v = 0; v < b->polygons->vertex_count; v++) {
        const uint32_t end = b->first[v + 1];
        for (uint32_t start = b->first[v], i = start; i < end; start = i) {
            const uint32_t key = higher(edge_at(b, b->bucket[start]));
            while (i < end && higher(edge_at(b, b->bucket[i])) == key) i++;
            if (i - start > 2 && !note_fan(b, b->bucket + start, i - start, memory)) return false;
        }
    }
    if (b->out->fan_count)
        dp_sort(b->out->fan_corners, b->out->fan_count, sizeof *b->out->fan_corners, by_corner);
    return true;
}

const dp_fan_corner *dp_fan_at(const dp_adjacency *a, uint32_t corner) {
    const dp_fan_corner key = {corner, 0, 0};
    return a->fan_count ? bsearch(&key, a->fan_corners, a->fan_count, sizeof key, by_corner) : NULL;
}

/* Notes polygons with an edge that is open or whose neighbour is wound the other way. */
static void note_odd(const builder *b) {
    for (uint32_t i = 0; i < b->polygons->count; i++) {
        const uint32_t first = dp_first_corner(b->polygons, i), n = dp_corner_count(b->polygons, i);
        b->out->odd[i] = false;
        for (uint32_t c = first; c < first + n; c++)
            if (b->out->across[c] == DP_ACROSS_OPEN ||
                (dp_is_across(b->out->across[c]) && b->out->across[c] & DP_ACROSS_FLIPPED))
                b->out->odd[i] = true;
    }
}

/* ------- the whole ------- */

static bool build(builder *b, dp_threads *threads, const dp_allocator *memory) {
    dp_adjacency *const a = b->out;
    const dp_polygons *const p = b->polygons;
    a->corners = corner_total(p), a->polygons = p->count, a->vertices = p->vertex_count;
    if (!p->firsts) {
        dp_free(memory, a->polygon_of);
        a->polygon_of = NULL, a->polygon_cap = 0;
    } else if (!dp_reserve(memory, &a->polygon_of, &a->polygon_cap, (size_t)a->corners + 1,
                           sizeof *a->polygon_of))
        return false;
    if (!dp_reserve(memory, &a->across, &a->across_cap, (size_t)a->corners + 1,
                    sizeof *a->across) ||
        !dp_reserve(memory, &a->odd, &a->odd_cap, (size_t)p->count + 1, 1))
        return false;
    name_polygons(b);
    if (!weld(b, memory)) return false;
    fill_buckets(b);
    if (!match(b, threads, memory)) return false;
    note_odd(b);
    return note_fans(b, memory);
}

static double now_ms(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

bool dp_adjacency_update(dp_adjacency *a, const dp_polygons *p, dp_threads *threads,
                         const dp_allocator *memory, bool *built) {
    const double start = now_ms();
    if (built) *built = false;
    const uint64_t key = dp_topology_fingerprint(p, threads);
    if (a->key == key && twins_hold(a, p)) return true;
    builder b = {.out = a, .polygons = p};
    a->key = 0;
    b.stands_for = dp_alloc_array(memory, (size_t)p->vertex_count + 1, sizeof *b.stands_for);
    b.first = dp_alloc_array(memory, (size_t)p->vertex_count + 1, sizeof *b.first);
    b.bucket = dp_alloc_array(memory, (size_t)corner_total(p) + 1, sizeof *b.bucket);
    const bool sound = b.stands_for && b.first && b.bucket && build(&b, threads, memory);
    dp_free(memory, b.stands_for);
    dp_free(memory, b.first);
    dp_free(memory, b.bucket);
    if (sound) a->key = key;
    a->ms = now_ms() - start;
    if (built) *built = sound;
    return sound;
}

void dp_adjacency_six(const dp_adjacency *a, const dp_polygons *p, uint32_t triangle,
                      uint32_t six[6]) {
    for (uint32_t i = 0; i < 3; i++) {
        const uint32_t corner = 3 * triangle + i, across = a->across[corner];
        six[2 * i] = dp_corner_vertex(p, corner);
        const uint32_t other = dp_is_across(across) ? dp_across_corner(across) : corner;
        six[2 * i + 1] = dp_corner_vertex(p, other / 3 * 3 + (other + 2 - other / 3 * 3) % 3);
    }
}

dp_result dp_adjacency_indices(const dp_batch *triangles, const dp_allocator *allocator,
                               uint32_t *six, dp_diag *diag) {
    if (!triangles || !six || !triangles->positions || triangles->firsts)
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "dp_adjacency_indices: it takes triangles with positions, and a place for "
                       "six indices each");
    if (triangles->polygon_count > UINT32_MAX / 4 || triangles->vertex_count >= UINT32_MAX)
        return dp_fail(diag, DP_ERR_LIMIT, "more than %u triangles or vertices", UINT32_MAX / 4);
    if (triangles->corner_count / 3 < triangles->polygon_count)
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "dp_adjacency_indices: %zu triangles need three times as many corners; "
                       "corner_count is %zu",
                       triangles->polygon_count, triangles->corner_count);
    const dp_result misplaced = dp_check_alignment(triangles, diag);
    if (misplaced) return misplaced;
    const dp_allocator memory = dp_allocator_resolve(allocator);
    const dp_polygons polygons = {.positions = triangles->positions,
                                  .stride =
                                      triangles->position_stride ? triangles->position_stride : 12,
                                  .vertex_count = (uint32_t)triangles->vertex_count,
                                  .corners = triangles->indices,
                                  .count = (uint32_t)triangles->polygon_count};
    dp_adjacency adjacency = {0};
    dp_threads *const threads = dp_threads_create(1, NULL, NULL, &memory);
    const bool sound =
        threads && dp_adjacency_update(&adjacency, &polygons, threads, &memory, NULL);
    for (uint32_t t = 0; sound && t < polygons.count; t++)
        dp_adjacency_six(&adjacency, &polygons, t, six + 6 * (size_t)t);
    dp_adjacency_free(&adjacency, &memory);
    dp_threads_destroy(threads);
    return sound ? DP_OK : dp_fail(diag, DP_ERR_MEMORY, "out of memory for adjacency");
}
