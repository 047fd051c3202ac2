/* Fingerprints: blocks are hashed in parallel, four sums side by side, some hundred at a time, then the
 * blocks' hashes in order. */
#include "mesh/fingerprint.h"

#include "base/hostile.h"

#include <string.h>

enum { BLOCK = DP_TUNED(65536, 11), AT_ONCE = DP_TUNED(256, 3) };

typedef struct hashing {
    const uint32_t *words;
    size_t count;
    size_t first; /* block of blocks[0] */
    uint64_t blocks[AT_ONCE];
} hashing;

static uint64_t mix(uint64_t h) {
    h ^= h >> 32;
    h *= 0xd6e8feb86659fd93u;
    h ^= h >> 32;
    h *= 0xd6e8feb86659fd93u;
    return h ^ h >> 32;
}

/* Four chains, so that their multiplications overlap in the processor. */
static void hash_block(void *arg, uint32_t index, uint32_t worker) {
    hashing *const h = arg;
    (void)worker;
    const size_t first = (h->first + index) * BLOCK,
                 end = h->count - first < BLOCK ? h->count : first + BLOCK;
    uint64_t sums[4] = {1, 2, 3, 4};
    size_t i = first;
    for (; i + 4 <= end; i += 4)
        for (int k = 0; k < 4; k++)
            sums[k] = (sums[k] ^ h->words[i + (size_t)k]) * 0x9e3779b97f4a7c15u;
    for (; i < end; i++) sums[0] = (sums[0] ^ h->words[i]) * 0x9e3779b97f4a7c15u;
    h->blocks[index] = mix(sums[0] ^ mix(sums[1] ^ mix(sums[2] ^ mix(sums[3]))));
}

void dp_fingerprint(const uint32_t *words, size_t count, dp_threads *threads, uint64_t *key) {
    const size_t blocks = count / BLOCK + 1;
    hashing h = {.words = words, .count = count};
    for (; h.first < blocks; h.first += AT_ONCE) {
        const size_t left = blocks - h.first, n = left < AT_ONCE ? left : AT_ONCE;
        dp_parallel(threads, (uint32_t)n, hash_block, &h);
        for (size_t i = 0; i < n; i++) *key = mix(*key * 31 + h.blocks[i]);
    }
}

uint64_t dp_topology_fingerprint(const dp_polygons *p, dp_threads *threads) {
    uint64_t key =
        mix(p->count + mix(p->vertex_count + mix((p->corners != NULL) + 2u * (p->firsts != NULL))));
    const size_t corners = p->firsts ? p->firsts[p->count] : 3 * (size_t)p->count;
    if (p->corners) dp_fingerprint(p->corners, corners, threads, &key);
    if (p->firsts) dp_fingerprint(p->firsts, (size_t)p->count + 1, threads, &key);
    return key ? key : 1;
}

/* Positions that are not contiguous are hashed one by one. */
static void add_positions(const dp_polygons *p, uint64_t *key) {
    for (uint32_t v = 0; v < p->vertex_count; v++) {
        uint32_t bits[3];
        memcpy(bits, dp_vertex_position(p, v), sizeof bits);
        *key = (*key ^ bits[0] ^ (uint64_t)bits[1] << 32) * 0x9e3779b97f4a7c15u + bits[2];
    }
    *key = mix(*key);
}

uint64_t dp_shape_fingerprint(const dp_polygons *p, dp_threads *threads) {
    uint64_t key = dp_topology_fingerprint(p, threads);
    if (p->stride != 3 * sizeof(float))
        add_positions(p, &key);
    else
        dp_fingerprint((const uint32_t *)(const void *)p->positions, 3 * (size_t)p->vertex_count,
                       threads, &key);
    return key ? key : 1;
}
