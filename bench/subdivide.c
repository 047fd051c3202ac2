/* subdivide IN OUT LEVELS: every triangle becomes four, cut at the middle of its edges; LEVELS
 * times.
 *
 * Makes large models of known ones: four times the triangles, the same shape, vertices shared as in
 * the original. Midpoints are found by hashing an edge's two vertex numbers (open addressing, at
 * most half full). LEVELS 0 only converts, to binary PLY by the name of OUT. */
#include "mesh.h"

#include <stdio.h>
#include <stdlib.h>

typedef struct edges {
    uint64_t *keys;   /* low vertex << 32 | high vertex; 0: free, as no edge joins 0 and 0 */
    uint32_t *middle; /* the vertex in the middle of that edge */
    uint64_t mask;    /* slots - 1, slots a power of two */
} edges;

static bool make_edges(edges *e, size_t triangles) {
    uint64_t slots = 64;
    while (slots < 6 * (uint64_t)triangles) slots *= 2; /* at most three edges each, half full */
    e->mask = slots - 1;
    e->keys = calloc(slots, sizeof *e->keys);
    e->middle = malloc(slots * sizeof *e->middle);
    return e->keys && e->middle;
}

static uint64_t slot_of(const edges *e, uint64_t key) {
    uint64_t slot = (key * 0x9E3779B97F4A7C15u) >> 20 & e->mask; /* 2^64 / golden ratio */
    while (e->keys[slot] && e->keys[slot] != key) slot = (slot + 1) & e->mask;
    return slot;
}

static uint32_t middle_of(edges *e, mesh *m, uint32_t a, uint32_t b) {
    if (a == b) return a;
    const uint64_t key = a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a;
    const uint64_t slot = slot_of(e, key);
    if (e->keys[slot]) return e->middle[slot];
    const uint32_t v = (uint32_t)m->vertex_count++;
    for (int k = 0; k < 3; k++)
        m->positions[3 * (size_t)v + k] =
            0.5f * (m->positions[3 * (size_t)a + k] + m->positions[3 * (size_t)b + k]);
    e->keys[slot] = key;
    e->middle[slot] = v;
    return v;
}

static void split(edges *e, mesh *m, uint32_t *out) {
    for (size_t t = 0; t < m->triangle_count; t++, out += 12) {
        const uint32_t *const v = m->indices + 3 * t;
        const uint32_t ab = middle_of(e, m, v[0], v[1]), bc = middle_of(e, m, v[1], v[2]),
                       ca = middle_of(e, m, v[2], v[0]);
        const uint32_t four[12] = {v[0], ab, ca, ab, v[1], bc, ca, bc, v[2], ab, bc, ca};
        for (int k = 0; k < 12; k++) out[k] = four[k];
    }
}

/* False: out of memory, or more vertices than 32 bits count. */
static bool subdivide(mesh *m) {
    const size_t most = m->vertex_count + 3 * m->triangle_count;
    edges e = {0};
    uint32_t *const indices = malloc(m->triangle_count * sizeof(uint32_t[12]) + 1);
    float *const positions = realloc(m->positions, most * sizeof(float[3]) + 1);
    if (positions) m->positions = positions;
    const bool able =
        most <= UINT32_MAX && indices && positions && make_edges(&e, m->triangle_count);
    if (able) {
        split(&e, m, indices);
        free(m->indices);
        m->indices = indices;
        m->triangle_count *= 4;
    } else {
        free(indices);
    }
    free(e.keys);
    free(e.middle);
    return able;
}

int main(int argc, char **argv) {
    if (argc != 4) return fprintf(stderr, "usage: subdivide IN OUT.ply LEVELS\n"), 2;
    mesh m;
    if (!mesh_read(argv[1], &m)) return EXIT_FAILURE;
    int code = EXIT_SUCCESS;
    for (int level = atoi(argv[3]); level > 0 && !code; level--)
        if (!subdivide(&m)) code = EXIT_FAILURE;
    if (code)
        fprintf(stderr, "subdivide: not enough memory for %s\n", argv[2]);
    else
        code = mesh_write(&m, argv[2]) ? EXIT_SUCCESS : EXIT_FAILURE;
    mesh_free(&m);
    return code;
}
