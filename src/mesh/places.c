/* Vertices by position. Open addressing, at most half full; slots hold 1 + vertex. -0 equals 0. */
#include "mesh/places.h"

#include <string.h>

static bool same_place(const float *p, const float *q) {
    return p[0] == q[0] && p[1] == q[1] && p[2] == q[2];
}

static uint32_t place_hash(const float *p) {
    const float q[3] = {p[0] + 0.0f, p[1] + 0.0f, p[2] + 0.0f};
    uint32_t b[3];
    memcpy(b, q, sizeof b);
    uint32_t h = b[0] * 0x9e3779b1u ^ (b[1] * 0x85ebca77u + (b[2] ^ b[2] >> 16) * 0xc2b2ae3du);
    h ^= h >> 15, h *= 0x2c1b3c6du, h ^= h >> 12, h *= 0x297a2d39u;
    return h ^ h >> 15;
}

bool dp_find_places(const dp_polygons *polygons, uint32_t *first, const dp_allocator *memory) {
    const uint32_t n = polygons->vertex_count;
    size_t slots = 64;
    while (slots < 2 * (size_t)n) slots *= 2;
    uint32_t *const table = dp_alloc_zeroed(memory, dp_times(slots, sizeof *table));
    if (!table) return false;
    for (uint32_t v = 0; v < n; v++) {
        const float *const p = dp_vertex_position(polygons, v);
        first[v] = v;
        if (!(p[0] == p[0] && p[1] == p[1] && p[2] == p[2])) continue; /* a NaN equals nothing */
        size_t s = place_hash(p) & (slots - 1);
        while (table[s] && !same_place(p, dp_vertex_position(polygons, table[s] - 1)))
            s = (s + 1) & (slots - 1);
        if (!table[s]) table[s] = v + 1;
        first[v] = table[s] - 1;
    }
    dp_free(memory, table);
    return true;
}
