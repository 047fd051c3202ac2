/* The arrays of a batch, listed with their sizes.
 *
 * Invariant: nothing that is received is trusted: counts are checked here, and so are `firsts`, indices
 * by drawing. */
#include "transfer_batch.h"

#include <stdint.h>
#include <string.h>

enum { ARRAYS = 9 };

/* An array of a batch: where its pointer is, how many items, and the size of one. */
typedef struct array {
    size_t at, count, size;
} array;

static void list_arrays(const dp_batch *b, array arrays[ARRAYS]) {
#define AT(member) offsetof(dp_batch, member)
    const size_t number = sizeof(uint32_t);
    const array list[ARRAYS] = {
        {AT(positions), b->vertex_count, b->position_stride},
        {AT(indices), b->corner_count, number},
        {AT(firsts), b->polygon_count + 1, number},
        {AT(groups), b->polygon_count, sizeof(uint16_t)},
        {AT(normals.values), b->normals.count, b->normals.stride},
        {AT(normals.indices), b->corner_count, number},
        {AT(texcoords.values), b->texcoords.count, b->texcoords.stride},
        {AT(texcoords.indices), b->corner_count, number},
        {AT(colors), b->vertex_count, number},
    };
#undef AT
    memcpy(arrays, list, sizeof list);
}

static void *array_of(const dp_batch *b, const array *a) {
    void *block;
    memcpy(&block, (const char *)b + a->at, sizeof block);
    return block;
}

static void set_array(dp_batch *b, const array *a, void *block) {
    memcpy((char *)b + a->at, &block, sizeof block);
}

void transfer_settle_batch(dp_batch *b) {
    if (!b->position_stride) b->position_stride = 3 * sizeof(float);
    if (!b->normals.stride) b->normals.stride = 3 * sizeof(float);
    if (!b->texcoords.stride) b->texcoords.stride = 2 * sizeof(float);
    b->edge_flags = NULL;
}

bool transfer_send_batch(int to, const dp_batch *batch) {
    array arrays[ARRAYS];
    list_arrays(batch, arrays);
    for (int k = 0; k < ARRAYS; k++) {
        const void *const block = array_of(batch, &arrays[k]);
        if (block && !pipe_send(to, block, arrays[k].count * arrays[k].size)) return false;
    }
    return true;
}

/* Are the counts possible? Without indices, vertices are the corners; without `firsts`, polygons are
 * triangles. */
static bool is_plausible(const dp_batch *b) {
    return (b->positions || !b->vertex_count) && b->vertex_count <= UINT32_MAX &&
           b->corner_count <= UINT32_MAX && b->polygon_count <= UINT32_MAX &&
           b->normals.count <= UINT32_MAX && b->texcoords.count <= UINT32_MAX &&
           b->position_stride == 3 * sizeof(float) && b->normals.stride == 3 * sizeof(float) &&
           b->texcoords.stride == 2 * sizeof(float) &&
           (b->firsts || b->corner_count == 3 * b->polygon_count);
}

bool transfer_receive_batch(pipe_end *end, dp_batch *batch) {
    const dp_batch sent = *batch;
    array arrays[ARRAYS];
    *batch = (dp_batch){0};
    if (!is_plausible(&sent)) return false;
    dp_batch received = sent;
    received.edge_flags = NULL;
    list_arrays(&sent, arrays);
    for (int k = 0; k < ARRAYS; k++) {
        if (!array_of(&sent, &arrays[k])) continue;
        void *const block = pipe_receive_block(end, arrays[k].count, arrays[k].size);
        if (!block) return false;
        set_array(&received, &arrays[k], block);
    }
    *batch = received;
    return true;
}
