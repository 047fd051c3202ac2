/* Which vertices have a closed one-ring, all of it wound alike.
 *
 *    for each polygon, for each corner
 *        sum of the corner's vertex += (key of next corner - key of previous corner) * weight(own key)
 *    closed where the sum is 0
 *
 * Each neighbour of a vertex is once the next and once the previous corner where two polygons run
 * their edge in opposite directions, and cancels. At a border, at a T-junction and where a polygon is
 * turned over it does not. find/one_rings.inc tells the same of what a tile sees; here it is told of
 * the whole model, so that tiles agree.
 *
 * Data structure: sums by the upper bits of keys. Vertices that share a sum are closed together or not
 * at all; the weight keeps them from closing each other. Invariant: sums wrap, and do not depend on
 * the order in which threads add. */
#include "core/closed.h"

#include <string.h>

enum { BLOCK = DP_TUNED(16384, 5) };

/* Sums for each vertex: of those with a sum to themselves most stay closed. */
enum { ROOM = 4 };

static void add_polygon(dp_frame *f, uint32_t polygon) {
    const dp_polygons *const polygons = &f->polygons;
    const uint32_t first = dp_first_corner(polygons, polygon),
                   n = dp_corner_count(polygons, polygon);
    for (uint32_t i = 0; i < n; i++)
        if (dp_corner_vertex(polygons, first + i) >= polygons->vertex_count) return;
    if (n < 3) return;
    uint32_t last = f->vertices[dp_corner_vertex(polygons, first + n - 1)].key,
             own = f->vertices[dp_corner_vertex(polygons, first)].key;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t next =
                           f->vertices[dp_corner_vertex(polygons, first + (i + 1 == n ? 0 : i + 1))]
                               .key,
                       weight = (own ^ own >> 15) * 0x85ebca77u | 1;
        __atomic_fetch_add(&f->closed[own >> f->closed_shift], (next - last) * weight,
                           __ATOMIC_RELAXED);
        last = own, own = next;
    }
}

static void add_block(void *arg, uint32_t index, uint32_t worker) {
    dp_frame *const f = arg;
    const uint32_t first = index * BLOCK,
                   n = f->polygons.count - first < BLOCK ? f->polygons.count - first : BLOCK;
    (void)worker;
    for (uint32_t i = 0; i < n; i++) add_polygon(f, first + i);
}

bool dp_find_closed(dp_frame *f) {
    const uint64_t least = ROOM * (uint64_t)f->polygons.vertex_count;
    uint32_t bits = 4;
    if (!f->exact_ends) return true;
    while (bits < 31 && (uint64_t)1 << bits < least) bits++;
    f->closed_shift = 32 - bits;
    if (!dp_reserve(f->memory, &f->closed, &f->closed_cap, (size_t)1 << bits, sizeof *f->closed))
        return false;
    memset(f->closed, 0, sizeof *f->closed << bits);
    dp_parallel(f->threads, f->polygons.count / BLOCK + (f->polygons.count % BLOCK != 0), add_block,
                f);
    return true;
}
