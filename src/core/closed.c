/* Which vertices have a closed one-ring, all of it wound alike.
 *
 *    for each polygon, for each corner
 *        sum of the corner's vertex += key of next corner - key of previous corner
 *    for each vertex whose sum is not 0       (of an indexed mesh few)
 *        sum of its place += sum * weight(own key)
 *    closed where the sum of the place is 0
 *
 * Each neighbour of a vertex is once the next and once the previous corner where two polygons run
 * their edge in opposite directions, and cancels. At a border, at a T-junction and where a polygon is
 * turned over it does not. find/one_rings.inc tells the same of what a tile sees; here it is told of
 * the whole model, so that tiles agree.
 *
 * Data structure: sums of places by the upper bits of their keys. Places that share a sum are closed
 * together or not at all; the weight keeps them from closing each other. Invariant: sums wrap, and do
 * not depend on the order in which threads add. */
#include "core/closed.h"

#include <string.h>

enum { BLOCK = DP_TUNED(16384, 5) };

/* Sums for each vertex, or for each whose own sum is not 0 if that takes fewer: so that few places share
 * one with a place that is open. */
enum { ROOM = 8, ROOM_OPEN = 4096 };

static inline void add_to(uint32_t *sum, uint32_t v, bool alone) {
    if (alone)
        *sum += v;
    else
        __atomic_fetch_add(sum, v, __ATOMIC_RELAXED);
}

static bool has_bad_corner(const dp_polygons *polygons, uint32_t first, uint32_t n) {
    for (uint32_t i = 0; i < n; i++)
        if (dp_corner_vertex(polygons, first + i) >= polygons->vertex_count) return true;
    return false;
}

static void add_polygon(dp_frame *f, uint32_t polygon, bool alone) {
    const dp_polygons *const polygons = &f->polygons;
    const uint32_t first = dp_first_corner(polygons, polygon),
                   n = dp_corner_count(polygons, polygon);
    if (n < 3 || has_bad_corner(polygons, first, n)) return;
    uint32_t own = dp_corner_vertex(polygons, first), own_key = f->vertices[own].key,
             last_key = f->vertices[dp_corner_vertex(polygons, first + n - 1)].key;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t next = dp_corner_vertex(polygons, first + (i + 1 == n ? 0 : i + 1)),
                       next_key = f->vertices[next].key;
        add_to(&f->rings[own], next_key - last_key, alone);
        last_key = own_key, own_key = next_key, own = next;
    }
}

/* The same of a triangle. */
static inline void add_triangle(dp_frame *f, uint32_t polygon, bool alone) {
    const dp_polygons *const polygons = &f->polygons;
    const uint32_t count = polygons->vertex_count, a = dp_corner_vertex(polygons, 3 * polygon),
                   b = dp_corner_vertex(polygons, 3 * polygon + 1),
                   c = dp_corner_vertex(polygons, 3 * polygon + 2);
    if (a >= count || b >= count || c >= count) return;
    const uint32_t ka = f->vertices[a].key, kb = f->vertices[b].key, kc = f->vertices[c].key;
    add_to(&f->rings[a], kb - kc, alone);
    add_to(&f->rings[b], kc - ka, alone);
    add_to(&f->rings[c], ka - kb, alone);
}

static uint32_t blocks_of(uint32_t count) { return count / BLOCK + (count % BLOCK != 0); }

static void add_polygons(void *arg, uint32_t index, uint32_t worker) {
    dp_frame *const f = arg;
    const uint32_t first = index * BLOCK,
                   n = f->polygons.count - first < BLOCK ? f->polygons.count - first : BLOCK;
    const bool alone = dp_threads_count(f->threads) == 1, triangles = !f->polygons.firsts;
    (void)worker;
    for (uint32_t i = 0; i < n && triangles; i++) add_triangle(f, first + i, alone);
    for (uint32_t i = 0; i < n && !triangles; i++) add_polygon(f, first + i, alone);
}

static void add_vertices(void *arg, uint32_t index, uint32_t worker) {
    dp_frame *const f = arg;
    const uint32_t count = f->polygons.vertex_count, first = index * BLOCK,
                   n = count - first < BLOCK ? count - first : BLOCK;
    const bool alone = dp_threads_count(f->threads) == 1;
    (void)worker;
    for (uint32_t i = first; i < first + n; i++) {
        const uint32_t key = f->vertices[i].key, weight = (key ^ key >> 15) * 0x85ebca77u | 1;
        if (f->rings[i]) add_to(&f->closed[key >> f->closed_shift], f->rings[i] * weight, alone);
    }
}

/* The number of bits by which a place finds its sum. */
static uint32_t bits_for(const dp_frame *f) {
    const uint32_t vertices = f->polygons.vertex_count;
    uint64_t open = 0;
    uint32_t bits = 4;
    for (uint32_t i = 0; i < vertices; i++) open += f->rings[i] != 0;
    const uint64_t most = ROOM * (uint64_t)vertices,
                   need = ROOM_OPEN * open < most ? ROOM_OPEN * open : most;
    while (bits < 31 && (uint64_t)1 << bits < need) bits++;
    return bits;
}

bool dp_find_closed(dp_frame *f) {
    const uint32_t vertices = f->polygons.vertex_count;
    if (!f->exact_ends) return true;
    if (!dp_reserve(f->memory, &f->rings, &f->rings_cap, vertices, sizeof *f->rings)) return false;
    if (vertices) memset(f->rings, 0, vertices * sizeof *f->rings);
    dp_parallel(f->threads, blocks_of(f->polygons.count), add_polygons, f);
    const uint32_t bits = bits_for(f);
    f->closed_shift = 32 - bits;
    if (!dp_reserve(f->memory, &f->closed, &f->closed_cap, (size_t)1 << bits, sizeof *f->closed))
        return false;
    memset(f->closed, 0, sizeof *f->closed << bits);
    dp_parallel(f->threads, blocks_of(vertices), add_vertices, f);
    return true;
}
