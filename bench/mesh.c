/* Appends batch after batch, vertices as they come: what the source did not weld stays apart. */
#include "mesh.h"

#include <drypoint/io.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static size_t triangles_of(const dp_batch *b) {
    return b->firsts ? b->firsts[b->polygon_count] - b->firsts[0] - 2 * b->polygon_count
                     : b->polygon_count;
}

static bool grow(mesh *m, const dp_batch *b) {
    const size_t vertices = m->vertex_count + b->vertex_count;
    const size_t triangles = m->triangle_count + triangles_of(b);
    float *const positions = realloc(m->positions, vertices * sizeof(float[3]) + 1);
    if (positions) m->positions = positions;
    uint32_t *const indices = realloc(m->indices, triangles * sizeof(uint32_t[3]) + 1);
    if (indices) m->indices = indices;
    return positions && indices && vertices <= UINT32_MAX;
}

static uint32_t vertex_of(const dp_batch *b, size_t corner) {
    return b->indices ? b->indices[corner] : (uint32_t)corner;
}

/* Room for the batch is there already. Polygons with an index out of range are left out. */
static void append(mesh *m, const dp_batch *b) {
    const size_t stride = b->position_stride ? b->position_stride : sizeof(float[3]);
    const uint32_t base = (uint32_t)m->vertex_count;
    for (size_t v = 0; v < b->vertex_count; v++)
        memcpy(m->positions + 3 * (base + v), (const char *)b->positions + v * stride,
               sizeof(float[3]));
    m->vertex_count += b->vertex_count;
    for (size_t p = 0; p < b->polygon_count; p++) {
        const size_t first = b->firsts ? b->firsts[p] : 3 * p;
        const size_t end = b->firsts ? b->firsts[p + 1] : first + 3;
        for (size_t c = first + 1; c + 1 < end; c++) {
            const uint32_t v[3] = {vertex_of(b, first), vertex_of(b, c), vertex_of(b, c + 1)};
            if (v[0] >= b->vertex_count || v[1] >= b->vertex_count || v[2] >= b->vertex_count)
                continue;
            uint32_t *const out = m->indices + 3 * m->triangle_count++;
            for (int k = 0; k < 3; k++) out[k] = base + v[k];
        }
    }
}

bool mesh_read(const char *path, mesh *m) {
    *m = (mesh){0};
    dp_source *source = NULL;
    dp_diag diag = {0};
    dp_batch batch = {0};
    dp_result result = dp_source_open(path, NULL, &source, &diag);
    while (!result && !(result = dp_source_next(source, &batch, &diag)) && batch.polygon_count) {
        if (!grow(m, &batch)) {
            result = DP_ERR_MEMORY;
            break;
        }
        append(m, &batch);
    }
    dp_source_destroy(source);
    if (result)
        fprintf(stderr, "%s: %s\n", path, diag.message[0] ? diag.message : dp_result_name(result));
    if (result) mesh_free(m);
    return !result;
}

bool mesh_write(const mesh *m, const char *path) {
    const dp_batch arrays = {.positions = m->positions,
                             .vertex_count = m->vertex_count,
                             .indices = m->indices,
                             .corner_count = 3 * m->triangle_count,
                             .polygon_count = m->triangle_count,
                             .stable = true};
    dp_source *source = NULL;
    dp_diag diag = {0};
    dp_result result = dp_source_from_arrays(&arrays, NULL, &source, &diag);
    if (!result) result = dp_io_write_mesh(path, DP_MESH_FILE_AUTO, source, NULL, NULL, &diag);
    dp_source_destroy(source);
    if (result) fprintf(stderr, "%s: %s\n", path, diag.message);
    return !result;
}

void mesh_free(mesh *m) {
    free(m->positions);
    free(m->indices);
    *m = (mesh){0};
}
