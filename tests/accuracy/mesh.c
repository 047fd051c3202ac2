/* Reads a source into a welded mesh with adjacency.
 *
 * Vertices are welded by an open hash table over the bits of their positions; edges are found by
 * sorting all half-edges by their two vertices. Polygons with fewer than three different corners,
 * no area, an index out of range or a coordinate that is not finite are left out. */
#include "mesh.h"

#include <stdlib.h>
#include <string.h>

void mesh_reserve(void *block_address, size_t *room, size_t need, size_t item_size) {
    void *block;
    if (need <= *room) return;
    size_t more = *room + *room / 2 + 64;
    if (more < need) more = need;
    memcpy(&block, block_address, sizeof block);
    block = realloc(block, more * item_size);
    if (block == NULL) abort();
    memcpy(block_address, &block, sizeof block);
    *room = more;
}

/* Open addressing: slot holds 1 + vertex, or 0. At most half full. */
typedef struct weld_table {
    uint32_t *slots;
    size_t size; /* a power of two */
} weld_table;

static size_t hash_of(v3 p, size_t size) {
    uint64_t bits[3], hash = 0;
    memcpy(bits, &p, sizeof bits);
    for (int k = 0; k < 3; k++) {
        hash = (hash ^ bits[k]) * UINT64_C(0x9E3779B97F4A7C15);
        hash ^= hash >> 29;
    }
    return (size_t)hash & (size - 1);
}

static void weld_grow(weld_table *table, const ref_model *model) {
    free(table->slots);
    table->size = table->size == 0 ? 1024 : 2 * table->size;
    table->slots = calloc(table->size, sizeof *table->slots);
    if (table->slots == NULL) abort();
    for (size_t v = 0; v < model->vertex_count; v++) {
        size_t slot = hash_of(model->positions[v], table->size);
        while (table->slots[slot] != 0) slot = (slot + 1) & (table->size - 1);
        table->slots[slot] = (uint32_t)v + 1;
    }
}

static bool same(v3 a, v3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

static uint32_t weld(weld_table *table, ref_model *model, const float xyz[3]) {
    const v3 p = {(double)(xyz[0] + 0.0f), (double)(xyz[1] + 0.0f), (double)(xyz[2] + 0.0f)};
    if (2 * (model->vertex_count + 1) > table->size) weld_grow(table, model);
    size_t slot = hash_of(p, table->size);
    for (; table->slots[slot] != 0; slot = (slot + 1) & (table->size - 1)) {
        if (same(model->positions[table->slots[slot] - 1], p)) return table->slots[slot] - 1;
    }
    mesh_reserve(&model->positions, &model->vertex_room, model->vertex_count + 1, sizeof(v3));
    model->positions[model->vertex_count] = p;
    table->slots[slot] = (uint32_t)++model->vertex_count;
    return (uint32_t)model->vertex_count - 1;
}

/* Newell: right for polygons that are not quite planar, too. Length: twice the area. */
static v3 newell(const ref_model *model, const uint32_t *corner, uint32_t count) {
    v3 normal = {0, 0, 0};
    const v3 origin = model->positions[corner[0]];
    for (uint32_t i = 1; i + 1 < count; i++) {
        normal = v3_add(normal, v3_cross(v3_sub(model->positions[corner[i]], origin),
                                         v3_sub(model->positions[corner[i + 1]], origin)));
    }
    return normal;
}

/* Closes the polygon of the corners from `first` on, or forgets them. */
static void add_polygon(ref_model *model, size_t first, uint64_t source) {
    const uint32_t count = (uint32_t)(model->corner_count - first);
    mesh_polygon made = {.first = (uint32_t)first, .count = count, .source = source};
    if (count >= 3) made.normal = v3_unit(newell(model, model->corners + first, count));
    if (count < 3 || v3_dot(made.normal, made.normal) < 0.5) {
        model->corner_count = first;
        return;
    }
    for (uint32_t i = 0; i < count; i++)
        made.centre = v3_add(made.centre, model->positions[model->corners[first + i]]);
    made.centre = v3_mul(made.centre, 1.0 / count);
    mesh_reserve(&model->polygons, &model->polygon_room, model->polygon_count + 1, sizeof made);
    model->polygons[model->polygon_count++] = made;
}

static void add_corner(ref_model *model, size_t first, uint32_t vertex, uint8_t flag) {
    const size_t at = model->corner_count;
    if (at > first && model->corners[at - 1] == vertex) {
        model->flags[at - 1] = flag; /* the edge between the two is a point */
        return;
    }
    mesh_reserve(&model->corners, &model->corner_room, at + 1, sizeof *model->corners);
    mesh_reserve(&model->flags, &model->flag_room, at + 1, sizeof *model->flags);
    model->corners[at] = vertex;
    model->flags[at] = flag;
    model->corner_count++;
}

static void read_batch(ref_model *model, weld_table *table, const dp_batch *batch,
                       uint64_t number) {
    const size_t stride = batch->position_stride ? batch->position_stride : 3 * sizeof(float);
    for (size_t p = 0; p < batch->polygon_count; p++, number++) {
        const size_t from = batch->firsts ? batch->firsts[p] : 3 * p;
        const size_t to = batch->firsts ? batch->firsts[p + 1] : 3 * p + 3;
        const size_t first = model->corner_count;
        bool good = true;
        for (size_t c = from; c < to && good; c++) {
            const size_t vertex = batch->indices ? batch->indices[c] : c;
            float xyz[3];
            good = vertex < batch->vertex_count;
            if (!good) break;
            memcpy(xyz, (const char *)batch->positions + vertex * stride, sizeof xyz);
            good = isfinite(xyz[0]) && isfinite(xyz[1]) && isfinite(xyz[2]);
            if (good)
                add_corner(model, first, weld(table, model, xyz),
                           batch->edge_flags ? batch->edge_flags[c] != 0 : 1);
        }
        while (model->corner_count > first + 1 &&
               model->corners[model->corner_count - 1] == model->corners[first])
            model->corner_count--;
        if (!good)
            model->corner_count = first;
        else
            add_polygon(model, first, number);
    }
}

static bool read_source(ref_model *model, dp_source *source) {
    weld_table table = {NULL, 0};
    uint64_t number = 0;
    dp_result result = dp_source_rewindable(source) ? dp_source_rewind(source, NULL) : DP_OK;
    while (result == DP_OK) {
        dp_batch batch;
        result = dp_source_next(source, &batch, NULL);
        if (result != DP_OK || batch.polygon_count == 0) break;
        read_batch(model, &table, &batch, number);
        number += batch.polygon_count;
    }
    free(table.slots);
    return result == DP_OK;
}

/* A polygon's edge on its way to being one of the mesh. */
typedef struct half_edge {
    uint32_t low, high; /* vertices */
    uint32_t polygon;
    uint8_t forward; /* runs from low to high */
    uint8_t flag;
} half_edge;

static int by_vertices(const void *left, const void *right) {
    const half_edge *a = left, *b = right;
    if (a->low != b->low) return a->low < b->low ? -1 : 1;
    if (a->high != b->high) return a->high < b->high ? -1 : 1;
    return a->polygon < b->polygon ? -1 : a->polygon > b->polygon;
}

static void collect_half_edges(const ref_model *model, half_edge *half) {
    for (uint32_t p = 0; p < model->polygon_count; p++) {
        const mesh_polygon *polygon = &model->polygons[p];
        for (uint32_t i = 0; i < polygon->count; i++) {
            const uint32_t a = model->corners[polygon->first + i];
            const uint32_t b = model->corners[polygon->first + (i + 1) % polygon->count];
            *half++ = (half_edge){.low = a < b ? a : b,
                                  .high = a < b ? b : a,
                                  .polygon = p,
                                  .forward = a < b,
                                  .flag = model->flags[polygon->first + i]};
        }
    }
}

static void find_edges(ref_model *model) {
    half_edge *half = malloc((model->corner_count + 1) * sizeof *half);
    model->edges = malloc((model->corner_count + 1) * sizeof *model->edges);
    if (half == NULL || model->edges == NULL) abort();
    collect_half_edges(model, half);
    qsort(half, model->corner_count, sizeof *half, by_vertices);
    for (size_t i = 0; i < model->corner_count; i++) {
        const half_edge *h = &half[i];
        if (i > 0 && h->low == half[i - 1].low && h->high == half[i - 1].high) {
            mesh_edge *edge = &model->edges[model->edge_count - 1];
            if (edge->polygons++ == 1) {
                edge->polygon[1] = h->polygon;
                edge->opposed = h->forward != (edge->a < edge->b);
            }
            edge->flags |= h->flag ? 1 : 2;
            continue;
        }
        model->edges[model->edge_count++] = (mesh_edge){.a = h->forward ? h->low : h->high,
                                                        .b = h->forward ? h->high : h->low,
                                                        .polygon = {h->polygon, RAYS_NOBODY},
                                                        .polygons = 1,
                                                        .flags = h->flag ? 1 : 2};
    }
    free(half);
}

static void measure(ref_model *model) {
    v3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t v = 0; v < model->vertex_count; v++) {
        low = v3_min(low, model->positions[v]);
        high = v3_max(high, model->positions[v]);
    }
    model->size = model->vertex_count > 0 ? v3_len(v3_sub(high, low)) : 0;
}

ref_model *ref_model_create(dp_source *source, bool crossings) {
    ref_model *model = calloc(1, sizeof *model);
    rays_triangle *triangles = NULL;
    size_t count = 0, room = 0;
    if (model == NULL) abort();
    if (!read_source(model, source)) {
        ref_model_destroy(model);
        return NULL;
    }
    measure(model);
    find_edges(model);
    mesh_reserve(&triangles, &room, model->corner_count + 1, sizeof *triangles);
    for (uint32_t p = 0; p < model->polygon_count; p++) {
        const mesh_polygon *polygon = &model->polygons[p];
        const uint32_t *corner = model->corners + polygon->first;
        for (uint32_t i = 1; i + 1 < polygon->count; i++) {
            const v3 *v = model->positions;
            triangles[count++] = (rays_triangle){{v[corner[0]], v[corner[i]], v[corner[i + 1]]}, p};
        }
    }
    model->rays = rays_create(triangles, count);
    if (crossings) mesh_find_crossings(model, triangles, count);
    free(triangles);
    return model;
}

void ref_model_destroy(ref_model *model) {
    if (model == NULL) return;
    rays_destroy(model->rays);
    free(model->positions);
    free(model->corners);
    free(model->flags);
    free(model->polygons);
    free(model->edges);
    free(model->crossings);
    free(model);
}

size_t ref_model_edges(const ref_model *model, uint32_t polygons) {
    size_t count = 0;
    for (size_t e = 0; e < model->edge_count; e++) {
        const mesh_edge *edge = &model->edges[e];
        count += edge->polygons == polygons && (polygons != 2 || edge->opposed);
    }
    return count;
}

size_t ref_model_crossings(const ref_model *model) {
    size_t count = 0;
    for (size_t c = 0; c < model->crossing_count; c++) count += !model->crossings[c].contact;
    return count;
}
