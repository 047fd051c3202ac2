/* Angle-weighted vertex normals (Thürmer and Wüthrich 1998) with a crease angle, for any polygons.
 *
 *     place[v]    the first vertex at v's position              hash table, one thread
 *     around      corners, by place                             counting sort
 *     each place, in parallel
 *         all its polygons within the crease angle of each other -> one normal, numbered by place
 *         otherwise -> one normal per corner, numbered after those of places
 *
 * Nothing depends on the order of blocks. A key of positions, corners and angle tells whether the
 * normals of the last call are still valid, so that a still model pays only once. */
#include "mesh/normals.h"

#include "base/elementary.h"
#include "base/hostile.h"
#include "base/vec.h"

#include <string.h>

enum {
    BLOCK = DP_TUNED(16384, 3),
    AT_ONCE = DP_TUNED(256, 3), /* blocks that are hashed before their hashes are mixed */
    MOST_AROUND = 512 /* polygons around a place: with more, creases are not sought (quadratic) */
};

/* What is kept, and the scratch. */
static const dp_array arrays[] = {DP_ARRAY(dp_normal_store, values, values_cap),
                                  DP_ARRAY(dp_normal_store, indices, indices_cap),
                                  DP_ARRAY(dp_normal_store, packed.corner, packed_corner_cap),
                                  DP_ARRAY(dp_normal_store, packed.vertex, packed_vertex_cap)};
static const dp_array scratch[] = {
    DP_ARRAY(dp_normal_store, facet, facet_cap),   DP_ARRAY(dp_normal_store, angle, angle_cap),
    DP_ARRAY(dp_normal_store, place, place_cap),   DP_ARRAY(dp_normal_store, starts, starts_cap),
    DP_ARRAY(dp_normal_store, around, around_cap), DP_ARRAY(dp_normal_store, owner, owner_cap),
    DP_ARRAY(dp_normal_store, slots, slots_cap),   DP_ARRAY(dp_normal_store, extra, extra_cap)};

static void free_scratch(dp_normal_store *store, const dp_allocator *memory) {
    dp_arrays_free(memory, store, DP_ARRAYS(scratch));
}

void dp_normal_store_free(dp_normal_store *store, const dp_allocator *memory) {
    free_scratch(store, memory);
    dp_arrays_free(memory, store, DP_ARRAYS(arrays));
    *store = (dp_normal_store){0};
}

uint64_t dp_normal_store_bytes(const dp_normal_store *store) {
    return dp_arrays_bytes(store, DP_ARRAYS(arrays)) + dp_arrays_bytes(store, DP_ARRAYS(scratch));
}

typedef struct job {
    dp_normal_store *store;
    const dp_polygons *polygons;
    size_t corners;
    float crease_cosine;
    size_t first_block; /* hashes[0] is its */
    uint64_t hashes[AT_ONCE];
} job;

static uint32_t blocks(size_t items) { return (uint32_t)(items / BLOCK + (items % BLOCK != 0)); }
static size_t block_end(uint32_t index, size_t items) {
    const size_t end = ((size_t)index + 1) * BLOCK;
    return end < items ? end : items;
}

/* ------- the key ------- */

static uint64_t mix(uint64_t h, uint64_t v) {
    h = (h ^ v) * 0x9fb21c651e98df25u;
    return h ^ h >> 32;
}

static uint64_t hash_words(uint64_t h, const uint32_t *words, size_t count) {
    uint64_t lanes[4] = {h, h + 1, h + 2, h + 3}; /* four chains: multiplications overlap */
    size_t i = 0;
    for (; i + 8 <= count; i += 8)
        for (size_t k = 0; k < 4; k++) {
            uint64_t two;
            memcpy(&two, words + i + 2 * k, sizeof two);
            lanes[k] = mix(lanes[k], two);
        }
    for (; i < count; i++) lanes[0] = mix(lanes[0], words[i]);
    return mix(mix(lanes[0], lanes[1]), mix(lanes[2], lanes[3]));
}

static void hash_positions(void *arg, uint32_t index, uint32_t worker) {
    job *const j = arg;
    const dp_polygons *const p = j->polygons;
    const uint32_t block = (uint32_t)j->first_block + index;
    const size_t first = (size_t)block * BLOCK, last = block_end(block, p->vertex_count);
    uint64_t h = block;
    (void)worker;
    if (p->stride == 3 * sizeof(float)) {
        h = hash_words(h, (const uint32_t *)(const void *)(p->positions + 3 * first),
                       3 * (last - first));
    } else {
        for (size_t v = first; v < last; v++) {
            uint32_t bits[3];
            memcpy(bits, dp_vertex_position(p, (uint32_t)v), sizeof bits);
            h = hash_words(h, bits, 3);
        }
    }
    j->hashes[index] = h;
}

static void hash_corners(void *arg, uint32_t index, uint32_t worker) {
    job *const j = arg;
    const uint32_t block = (uint32_t)j->first_block + index;
    const size_t first = (size_t)block * BLOCK, last = block_end(block, j->corners);
    (void)worker;
    j->hashes[index] = hash_words(block, j->polygons->corners + first, last - first);
}

/* Mixes the hashes of all blocks of so many items, in order. */
static uint64_t hash_all(uint64_t h, job *j, size_t items, dp_task *task, dp_threads *threads) {
    const size_t count = blocks(items);
    for (j->first_block = 0; j->first_block < count; j->first_block += AT_ONCE) {
        const size_t left = count - j->first_block;
        const uint32_t n = (uint32_t)(left < AT_ONCE ? left : AT_ONCE);
        dp_parallel(threads, n, task, j);
        for (uint32_t i = 0; i < n; i++) h = mix(h, j->hashes[i]);
    }
    return h;
}

static uint64_t make_key(job *j, dp_threads *threads) {
    const dp_polygons *const p = j->polygons;
    uint64_t h = mix(mix(p->count, j->corners), p->vertex_count);
    h = hash_all(h, j, p->vertex_count, hash_positions, threads);
    if (p->corners) h = hash_all(h, j, j->corners, hash_corners, threads);
    if (p->firsts) h = mix(h, hash_words(0, p->firsts, (size_t)p->count + 1));
    return h ? h : 1;
}

/* ------- polygons: their normals, and the angles of their corners ------- */

static dp_vec3 position(const dp_polygons *p, uint32_t vertex) {
    return dp_v3f(dp_vertex_position(p, vertex));
}

/* Unit normal by Newell's sum; 0 if there is none. */
static dp_vec3 facet_normal(const dp_polygons *p, uint32_t first, uint32_t n) {
    for (uint32_t i = 0; i < n; i++)
        if (dp_corner_vertex(p, first + i) >= p->vertex_count) return dp_v3(0, 0, 0);
    const dp_vec3 o = position(p, dp_corner_vertex(p, first));
    dp_vec3 sum = {0, 0, 0};
    for (uint32_t i = 1; i + 1 < n; i++) {
        const dp_vec3 a = dp_sub(position(p, dp_corner_vertex(p, first + i)), o);
        const dp_vec3 b = dp_sub(position(p, dp_corner_vertex(p, first + i + 1)), o);
        sum = dp_add(sum, dp_cross(a, b));
    }
    const dp_vec3 unit = dp_unit(sum);
    return isfinite(unit.x + unit.y + unit.z) ? unit : dp_v3(0, 0, 0);
}

static double corner_angle(dp_vec3 before, dp_vec3 at, dp_vec3 after) {
    const dp_vec3 a = dp_sub(before, at), b = dp_sub(after, at);
    return dp_atan2(dp_length(dp_cross(a, b)), dp_dot(a, b));
}

static void measure_polygons(void *arg, uint32_t index, uint32_t worker) {
    const job *const j = arg;
    const dp_polygons *const p = j->polygons;
    (void)worker;
    for (size_t i = (size_t)index * BLOCK; i < block_end(index, p->count); i++) {
        const uint32_t first = dp_first_corner(p, (uint32_t)i), n = dp_corner_count(p, (uint32_t)i);
        const dp_vec3 normal = facet_normal(p, first, n);
        const bool sound = dp_dot(normal, normal) > 0;
        float *const to = j->store->facet[i];
        to[0] = (float)normal.x, to[1] = (float)normal.y, to[2] = (float)normal.z;
        for (uint32_t c = 0; c < n; c++) {
            const uint32_t v = dp_corner_vertex(p, first + c);
            const uint32_t before = dp_corner_vertex(p, first + (c + n - 1) % n);
            const uint32_t after = dp_corner_vertex(p, first + (c + 1) % n);
            j->store->owner[first + c] = (uint32_t)i;
            j->store->angle[first + c] =
                sound ? (float)corner_angle(position(p, before), position(p, v), position(p, after))
                      : 0;
        }
    }
}

/* ------- places ------- */

static uint32_t position_hash(const uint32_t b[3]) {
    uint64_t h = b[0] * 0x9e3779b97f4a7c15u ^ (uint64_t)b[1] << 32 ^ b[2] * 0x85ebca77c2b2ae63u;
    h ^= h >> 29;
    h *= 0xbf58476d1ce4e5b9u;
    return (uint32_t)(h >> 32);
}

/* Finds the first vertex at each position; -0 counts as 0. */
static void find_places(const job *j, size_t slot_count) {
    const dp_polygons *const p = j->polygons;
    uint32_t *const slots = j->store->slots;
    memset(slots, 0, slot_count * sizeof *slots);
    for (uint32_t v = 0; v < p->vertex_count; v++) {
        const float *const at = dp_vertex_position(p, v);
        const float q[3] = {at[0] + 0.0f, at[1] + 0.0f, at[2] + 0.0f};
        uint32_t bits[3];
        memcpy(bits, q, sizeof bits);
        size_t slot = position_hash(bits) & (slot_count - 1);
        for (;; slot = (slot + 1) & (slot_count - 1)) {
            if (!slots[slot]) break;
            const float *const there = dp_vertex_position(p, slots[slot] - 1);
            if (there[0] == q[0] && there[1] == q[1] && there[2] == q[2]) break;
        }
        if (!slots[slot]) slots[slot] = v + 1;
        j->store->place[v] = slots[slot] - 1;
    }
}

/* Lists corners by place (a counting sort), except those of polygons without a normal. */
static void list_corners(const job *j) {
    dp_normal_store *const s = j->store;
    const dp_polygons *const p = j->polygons;
    memset(s->starts, 0, ((size_t)p->vertex_count + 1) * sizeof *s->starts);
    for (size_t c = 0; c < j->corners; c++)
        if (s->angle[c] > 0) s->starts[s->place[dp_corner_vertex(p, (uint32_t)c)] + 1]++;
    for (uint32_t v = 0; v < p->vertex_count; v++) s->starts[v + 1] += s->starts[v];
    for (size_t c = 0; c < j->corners; c++)
        if (s->angle[c] > 0)
            s->around[s->starts[s->place[dp_corner_vertex(p, (uint32_t)c)]]++] = (uint32_t)c;
    for (uint32_t v = p->vertex_count; v > 0; v--) s->starts[v] = s->starts[v - 1];
    s->starts[0] = 0;
}

/* ------- normals ------- */

static dp_vec3 weighted(const dp_normal_store *s, uint32_t corner) {
    return dp_scale(dp_v3f(s->facet[s->owner[corner]]), s->angle[corner]);
}

static dp_vec3 mean_around(const dp_normal_store *s, uint32_t place) {
    dp_vec3 sum = {0, 0, 0};
    for (uint32_t i = s->starts[place]; i < s->starts[place + 1]; i++)
        sum = dp_add(sum, weighted(s, s->around[i]));
    return dp_unit(sum);
}

/* Are all polygons around the place within the crease angle of each other? Quick proof: all are
 * within half of it of their mean. Otherwise pairs decide. */
static bool is_smooth(const job *j, uint32_t place) {
    const dp_normal_store *const s = j->store;
    const uint32_t first = s->starts[place], last = s->starts[place + 1];
    const dp_vec3 mean = mean_around(s, place);
    const double half = sqrt(dp_max(0.5 + 0.5 * (double)j->crease_cosine, 0));
    bool within = true;
    for (uint32_t i = first; i < last && within; i++)
        within = dp_dot(mean, dp_v3f(s->facet[s->owner[s->around[i]]])) >= half;
    if (within) return true;
    if (last - first > MOST_AROUND) return false;
    for (uint32_t i = first; i < last; i++)
        for (uint32_t k = first; k < i; k++)
            if (dp_dot(dp_v3f(s->facet[s->owner[s->around[i]]]),
                       dp_v3f(s->facet[s->owner[s->around[k]]])) < (double)j->crease_cosine)
                return false;
    return dp_dot(mean, mean) > 0;
}

static void count_extra(void *arg, uint32_t index, uint32_t worker) {
    const job *const j = arg;
    (void)worker;
    for (size_t v = (size_t)index * BLOCK; v < block_end(index, j->polygons->vertex_count); v++) {
        const uint32_t n = j->store->starts[v + 1] - j->store->starts[v];
        j->store->extra[v] = n && !is_smooth(j, (uint32_t)v) ? n : 0;
    }
}

static void put(float to[3], dp_vec3 n) {
    to[0] = (float)n.x, to[1] = (float)n.y, to[2] = (float)n.z;
}

/* The mean normal of polygons within the crease angle of the corner's own. */
static dp_vec3 creased(const job *j, uint32_t place, uint32_t corner) {
    const dp_normal_store *const s = j->store;
    const dp_vec3 own = dp_v3f(s->facet[s->owner[corner]]);
    const uint32_t first = s->starts[place], last = s->starts[place + 1];
    if (last - first > MOST_AROUND) return own;
    dp_vec3 sum = {0, 0, 0};
    for (uint32_t i = first; i < last; i++)
        if (dp_dot(own, dp_v3f(s->facet[s->owner[s->around[i]]])) >= (double)j->crease_cosine)
            sum = dp_add(sum, weighted(s, s->around[i]));
    const dp_vec3 unit = dp_unit(sum);
    return dp_dot(unit, unit) > 0 ? unit : own;
}

static void fill_places(void *arg, uint32_t index, uint32_t worker) {
    const job *const j = arg;
    dp_normal_store *const s = j->store;
    (void)worker;
    for (size_t v = (size_t)index * BLOCK; v < block_end(index, j->polygons->vertex_count); v++) {
        const uint32_t place = (uint32_t)v, first = s->starts[v], n = s->starts[v + 1] - first;
        const uint32_t extra = s->extra[v]; /* first of its corners' normals, or UINT32_MAX */
        put(s->values[v], extra == UINT32_MAX && n ? mean_around(s, place) : dp_v3(0, 0, 0));
        for (uint32_t i = 0; i < n; i++) {
            const uint32_t corner = s->around[first + i];
            s->indices[corner] = extra == UINT32_MAX ? place : extra + i;
            if (extra != UINT32_MAX) put(s->values[extra + i], creased(j, place, corner));
        }
    }
}

/* Turns counts into first numbers; returns the number of normals of both kinds. */
static size_t number_extra(const job *j) {
    size_t next = j->polygons->vertex_count;
    for (uint32_t v = 0; v < j->polygons->vertex_count; v++) {
        const uint32_t n = j->store->extra[v];
        j->store->extra[v] = n ? (uint32_t)next : UINT32_MAX;
        next += n;
    }
    return next;
}

static bool reserve(dp_normal_store *s, const dp_polygons *p, size_t corners, size_t slots,
                    const dp_allocator *m) {
    const size_t vertices = p->vertex_count;
    return dp_reserve(m, &s->facet, &s->facet_cap, p->count, sizeof *s->facet) &&
           dp_reserve(m, &s->angle, &s->angle_cap, corners, sizeof *s->angle) &&
           dp_reserve(m, &s->owner, &s->owner_cap, corners, sizeof *s->owner) &&
           dp_reserve(m, &s->around, &s->around_cap, corners, sizeof *s->around) &&
           dp_reserve(m, &s->indices, &s->indices_cap, corners, sizeof *s->indices) &&
           dp_reserve(m, &s->place, &s->place_cap, vertices, sizeof *s->place) &&
           dp_reserve(m, &s->starts, &s->starts_cap, vertices + 1, sizeof *s->starts) &&
           dp_reserve(m, &s->extra, &s->extra_cap, vertices, sizeof *s->extra) &&
           dp_reserve(m, &s->slots, &s->slots_cap, slots, sizeof *s->slots);
}

static bool compute(job *j, dp_threads *threads, const dp_allocator *memory) {
    const dp_polygons *const p = j->polygons;
    size_t slots = 16;
    while (slots < 2 * (size_t)p->vertex_count) slots *= 2;
    if (!reserve(j->store, p, j->corners, slots, memory)) return false;
    memset(j->store->indices, 0xff, j->corners * sizeof *j->store->indices);
    dp_parallel(threads, blocks(p->count), measure_polygons, j);
    find_places(j, slots);
    list_corners(j);
    dp_parallel(threads, blocks(p->vertex_count), count_extra, j);
    j->store->count = number_extra(j);
    if (!dp_reserve(memory, &j->store->values, &j->store->values_cap, j->store->count,
                    sizeof *j->store->values))
        return false;
    dp_parallel(threads, blocks(p->vertex_count), fill_places, j);
    return true;
}

bool dp_normals_make(dp_normal_store *store, const dp_polygons *polygons, float crease,
                     uint64_t *known, dp_threads *threads, const dp_allocator *memory,
                     dp_attribute *out) {
    *out = (dp_attribute){0};
    if (!polygons->count || !polygons->vertex_count) return true;
    job j = {.store = store,
             .polygons = polygons,
             .corners =
                 polygons->firsts ? polygons->firsts[polygons->count] : 3 * (size_t)polygons->count,
             .crease_cosine = (float)dp_cos((double)crease * (3.14159265358979323846 / 180))};
    uint64_t unknown = 0, *const shape = known ? known : &unknown; /* key without the angle */
    if (!*shape) *shape = make_key(&j, threads);
    const uint64_t mixed = mix(*shape, (uint64_t)((double)j.crease_cosine * 1e15)),
                   key = mixed ? mixed : 1;
    if (key != store->key) {
        const bool again = store->key != 0;
        store->key = 0;
        const bool made = compute(&j, threads, memory);
        /* it is many times as large as the result: a still model's is not kept */
        if (!made || !(again || store->moves)) free_scratch(store, memory);
        if (!made) return false;
        store->key = key;
    }
    *out = (dp_attribute){.values = store->values[0],
                          .stride = sizeof *store->values,
                          .count = store->count,
                          .indices = store->indices};
    return true;
}

/* ------- packing ------- */

static void pack_corners(void *arg, uint32_t index, uint32_t worker) {
    const job *const j = arg;
    const dp_polygons *const p = j->polygons;
    (void)worker;
    for (size_t c = (size_t)index * BLOCK; c < block_end(index, j->corners); c++) {
        const uint32_t i = dp_attribute_number(&p->normals, c, dp_corner_vertex(p, (uint32_t)c));
        int16_t *const to = j->store->packed.corner[c];
        to[0] = to[1] = to[2] = 0;
        if (i == UINT32_MAX) continue;
        const float *const n = dp_attribute_value(&p->normals, i);
        const double length = dp_length(dp_v3f(n));
        if (!(length > 0 && length < INFINITY)) continue;
        for (int k = 0; k < 3; k++) to[k] = (int16_t)lrint(n[k] / length * 32767);
    }
}

/* Packs the normal that all corners of a vertex share, or notes that they differ. */
static void pack_vertices(const job *j) {
    enum { SHARED, DIFFER, UNKNOWN };
    const dp_polygons *const p = j->polygons;
    int16_t(*const vertex)[4] = j->store->packed.vertex;
    for (uint32_t v = 0; v < p->vertex_count; v++) vertex[v][3] = UNKNOWN;
    for (size_t c = 0; c < j->corners; c++) {
        const uint32_t v = dp_corner_vertex(p, (uint32_t)c);
        const int16_t *const n = j->store->packed.corner[c];
        if (v >= p->vertex_count || vertex[v][3] == DIFFER) continue;
        if (vertex[v][3] == UNKNOWN)
            memcpy(vertex[v], n, 3 * sizeof *n), vertex[v][3] = SHARED;
        else if (memcmp(vertex[v], n, 3 * sizeof *n))
            vertex[v][3] = DIFFER;
    }
}

static void hash_values(void *arg, uint32_t index, uint32_t worker) {
    job *const j = arg;
    const dp_attribute *const a = &j->polygons->normals;
    const uint32_t block = (uint32_t)j->first_block + index;
    const size_t first = (size_t)block * BLOCK, last = block_end(block, a->count);
    uint64_t h = block;
    (void)worker;
    for (size_t i = first; i < last; i++) {
        uint32_t bits[3];
        memcpy(bits, dp_attribute_value(a, (uint32_t)i), sizeof bits);
        h = mix(mix(h, bits[0] | (uint64_t)bits[1] << 32), bits[2]);
    }
    j->hashes[index] = h;
}

static void hash_indices(void *arg, uint32_t index, uint32_t worker) {
    job *const j = arg;
    const dp_attribute *const a = &j->polygons->normals;
    const uint32_t block = (uint32_t)j->first_block + index;
    const size_t first = (size_t)block * BLOCK, last = block_end(block, j->corners);
    (void)worker;
    j->hashes[index] =
        hash_words(block, (a->indices ? a->indices : j->polygons->corners) + first, last - first);
}

/* The key of a model's own normals. */
static uint64_t make_value_key(job *j, dp_threads *threads) {
    const dp_attribute *const a = &j->polygons->normals;
    uint64_t h = mix(mix(a->count, j->corners), 77);
    h = hash_all(h, j, a->count, hash_values, threads);
    if (a->indices || j->polygons->corners) h = hash_all(h, j, j->corners, hash_indices, threads);
    return h ? h : 1;
}

bool dp_normals_pack(dp_normal_store *store, const dp_polygons *polygons, dp_threads *threads,
                     const dp_allocator *memory) {
    const dp_attribute *const a = &polygons->normals;
    if (!polygons->count) return true;
    job j = {.store = store,
             .polygons = polygons,
             .corners = polygons->firsts ? polygons->firsts[polygons->count]
                                         : 3 * (size_t)polygons->count};
    uint64_t key = store->key; /* of computed normals */
    if (store->count == 0 || a->values != store->values[0]) key = make_value_key(&j, threads);
    if (key == store->packed_key) return true;
    store->packed_key = 0;
    if (!dp_reserve(memory, &store->packed.corner, &store->packed_corner_cap, j.corners,
                    sizeof *store->packed.corner) ||
        !dp_reserve(memory, &store->packed.vertex, &store->packed_vertex_cap,
                    polygons->vertex_count, sizeof *store->packed.vertex))
        return false;
    dp_parallel(threads, blocks(j.corners), pack_corners, &j);
    pack_vertices(&j);
    store->packed_key = key;
    return true;
}
