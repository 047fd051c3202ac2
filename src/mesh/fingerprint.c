/* Fingerprints: blocks are hashed in parallel, four sums side by side, then the blocks' hashes in
 * order. */
#include "mesh/fingerprint.h"

#include "base/hostile.h"

#include <string.h>

enum { BLOCK = DP_TUNED(65536, 11) };

typedef struct hashing {
    const uint32_t *words;
    size_t count;
    uint64_t *blocks;
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
    const hashing *const h = arg;
    (void)worker;
    const size_t first = (size_t)index * BLOCK,
                 end = h->count - first < BLOCK ? h->count : first + BLOCK;
    uint64_t sums[4] = {1, 2, 3, 4};
    size_t i = first;
    for (; i + 4 <= end; i += 4)
        for (int k = 0; k < 4; k++)
            sums[k] = (sums[k] ^ h->words[i + (size_t)k]) * 0x9e3779b97f4a7c15u;
    for (; i < end; i++) sums[0] = (sums[0] ^ h->words[i]) * 0x9e3779b97f4a7c15u;
    h->blocks[index] = mix(sums[0] ^ mix(sums[1] ^ mix(sums[2] ^ mix(sums[3]))));
}

bool dp_fingerprint(const uint32_t *words, size_t count, dp_threads *threads,
                    const dp_allocator *memory, uint64_t *key) {
    const size_t blocks = count / BLOCK + 1;
    hashing h = {words, count, dp_alloc_array(memory, blocks, sizeof *h.blocks)};
    if (!h.blocks) return false;
    dp_parallel(threads, (uint32_t)blocks, hash_block, &h);
    for (size_t i = 0; i < blocks; i++) *key = mix(*key * 31 + h.blocks[i]);
    dp_free(memory, h.blocks);
    return true;
}

bool dp_topology_fingerprint(const dp_polygons *p, dp_threads *threads, const dp_allocator *memory,
                             uint64_t *key) {
    *key =
        mix(p->count + mix(p->vertex_count + mix((p->corners != NULL) + 2u * (p->firsts != NULL))));
    const size_t corners = p->firsts ? p->firsts[p->count] : 3 * (size_t)p->count;
    if (p->corners && !dp_fingerprint(p->corners, corners, threads, memory, key)) return false;
    if (p->firsts && !dp_fingerprint(p->firsts, (size_t)p->count + 1, threads, memory, key))
        return false;
    if (!*key) *key = 1;
    return true;
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

bool dp_shape_fingerprint(const dp_polygons *p, dp_threads *threads, const dp_allocator *memory,
                          uint64_t *key) {
    if (!dp_topology_fingerprint(p, threads, memory, key)) return false;
    if (p->stride != 3 * sizeof(float))
        add_positions(p, key);
    else if (!dp_fingerprint((const uint32_t *)(const void *)p->positions,
                             3 * (size_t)p->vertex_count, threads, memory, key))
        return false;
    if (!*key) *key = 1;
    return true;
}
