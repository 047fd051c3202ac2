/* Accessors of glTF (3.6.2): elements of numbers in a view, some replaced by sparse values.
 *
 * Components of all types become floats, normalized integers as 3.6.2.2 has it, or whole numbers.
 * Invariant: all bytes that an open accessor may touch are there.
 *
 * Not handled: matrices of small components, whose columns are padded. */
#include "io/gltf.h"

#include <string.h>

enum { BYTE = 5120, UBYTE, SHORT, USHORT, UINT = 5125, FLOAT };

static uint32_t size_of(uint32_t type) {
    switch (type) {
    case BYTE:
    case UBYTE:
        return 1;
    case SHORT:
    case USHORT:
        return 2;
    case UINT:
    case FLOAT:
        return 4;
    default:
        return 0;
    }
}

static bool find_components(dp_gltf *g, const dp_json *accessor, dp_gltf_accessor *a) {
    static const struct {
        const char *name;
        uint32_t count;
    } types[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4},
                 {"MAT2", 4},   {"MAT3", 9}, {"MAT4", 16}};
    const dp_json *type;
    if (!dp_gltf_member(g, accessor, "type", DP_JSON_STRING, &type)) return false;
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (dp_json_is(type, types[i].name)) {
            a->components = types[i].count;
            return true;
        }
    return dp_gltf_fail(g, DP_ERR_FORMAT, "accessor %u has no \"type\" that is known", a->number);
}

static bool find_type(dp_gltf *g, const dp_json *object, uint32_t *type) {
    if (!dp_gltf_uint(g, object, "componentType", 0, type)) return false;
    return size_of(*type) ||
           dp_gltf_fail(g, DP_ERR_FORMAT,
                        "\"componentType\" must be one of 5120 … 5123, 5125, 5126");
}

static bool open_sparse(dp_gltf *g, const dp_json *sparse, dp_gltf_accessor *a) {
    const dp_json *indices, *values;
    uint32_t index_view, value_view, index_at, value_at;
    if (!dp_gltf_uint(g, sparse, "count", 0, &a->sparse_count) ||
        !dp_gltf_member(g, sparse, "indices", DP_JSON_OBJECT, &indices) ||
        !dp_gltf_member(g, sparse, "values", DP_JSON_OBJECT, &values) ||
        !dp_gltf_index(g, indices, "bufferView", g->views, "bufferView", &index_view) ||
        !dp_gltf_index(g, values, "bufferView", g->views, "bufferView", &value_view) ||
        !dp_gltf_uint(g, indices, "byteOffset", 0, &index_at) ||
        !dp_gltf_uint(g, values, "byteOffset", 0, &value_at) ||
        !find_type(g, indices, &a->sparse_type))
        return false;
    if (!index_view || !value_view || a->sparse_type == FLOAT)
        return dp_gltf_fail(g, DP_ERR_FORMAT,
                            "accessor %u has a \"sparse\" without indices or values", a->number);
    const uint64_t count = a->sparse_count, element = size_of(a->type) * a->components;
    return dp_gltf_view(g, index_view - 1, index_at, count * size_of(a->sparse_type),
                        &a->sparse_indices) &&
           dp_gltf_view(g, value_view - 1, value_at, count * element, &a->sparse_values);
}

static bool open_data(dp_gltf *g, const dp_json *accessor, uint32_t view, dp_gltf_accessor *a) {
    uint32_t offset;
    const uint32_t element = size_of(a->type) * a->components;
    if (!dp_gltf_uint(g, accessor, "byteOffset", 0, &offset) ||
        !dp_gltf_stride(g, view, &a->stride))
        return false;
    if (!a->stride) a->stride = element;
    if (a->stride < element)
        return dp_gltf_fail(g, DP_ERR_FORMAT, "\"byteStride\" of bufferView %u is below %u", view,
                            element);
    const uint64_t size = a->count ? (uint64_t)a->stride * (a->count - 1) + element : 0;
    return dp_gltf_view(g, view, offset, size, &a->data);
}

static bool fill(dp_gltf *g, dp_gltf_accessor *a) {
    const dp_json *const accessor = dp_json_item(g->accessors, a->number), *sparse, *normalized;
    uint32_t view;
    if (!dp_gltf_uint(g, accessor, "count", 0, &a->count) || !find_type(g, accessor, &a->type) ||
        !find_components(g, accessor, a) ||
        !dp_gltf_member(g, accessor, "normalized", DP_JSON_BOOL, &normalized) ||
        !dp_gltf_member(g, accessor, "sparse", DP_JSON_OBJECT, &sparse) ||
        !dp_gltf_index(g, accessor, "bufferView", g->views, "bufferView", &view))
        return false;
    a->normalized = normalized && normalized->as.truth;
    if (view && !open_data(g, accessor, view - 1, a)) return false;
    if (!view && a->count > g->bytes && !dp_gltf_read_buffers(g)) return false;
    if (!view && a->count > g->bytes)
        return dp_gltf_fail(g, DP_ERR_FORMAT,
                            "\"count\" is %u without a bufferView: there are not "
                            "that many",
                            a->count);
    return !sparse || open_sparse(g, sparse, a);
}

bool dp_gltf_accessor_open(dp_gltf *g, uint32_t number, dp_gltf_accessor *to) {
    char where[sizeof g->where];
    *to = (dp_gltf_accessor){.number = number};
    memcpy(where, g->where, sizeof where);
    dp_gltf_at(g, "%.60saccessor %u: ", where, number);
    if (!fill(g, to)) return false;
    memcpy(g->where, where, sizeof where);
    return true;
}

/* ------- components ------- */

static uint32_t load(const uint8_t *p, uint32_t size) {
    uint32_t value = 0;
    for (uint32_t i = 0; i < size; i++) value |= (uint32_t)p[i] << 8 * i;
    return value;
}

static float to_float(const uint8_t *p, uint32_t type, bool normalized) {
    const uint32_t bits = load(p, size_of(type));
    float value;
    switch (type) {
    case BYTE:
        value = (float)((int32_t)(bits ^ 0x80) - 0x80);
        return normalized ? value < -127 ? -1 : value / 127 : value;
    case UBYTE:
        return normalized ? (float)bits / 255 : (float)bits;
    case SHORT:
        value = (float)((int32_t)(bits ^ 0x8000) - 0x8000);
        return normalized ? value < -32767 ? -1 : value / 32767 : value;
    case USHORT:
        return normalized ? (float)bits / 65535 : (float)bits;
    case UINT:
        return normalized ? (float)((double)bits / UINT32_MAX) : (float)bits;
    default:
        memcpy(&value, &bits, sizeof value);
        return value;
    }
}

static void put(const dp_gltf_accessor *a, const uint8_t *from, uint32_t width, float *floats,
                uint32_t *uints) {
    const uint32_t size = size_of(a->type);
    for (uint32_t k = 0; k < width; k++) {
        const bool has = from && k < a->components;
        if (floats) floats[k] = has ? to_float(from + k * size, a->type, a->normalized) : 0;
        if (uints) uints[k] = has && a->type != FLOAT ? load(from + k * size, size) : 0;
    }
}

/* Writes to one of the two arrays; the other is NULL. */
static bool copy(dp_gltf *g, const dp_gltf_accessor *a, uint32_t first, uint32_t count,
                 uint32_t width, float *floats, uint32_t *uints) {
    const size_t element = (size_t)size_of(a->type) * a->components;
    const uint32_t index_size = size_of(a->sparse_type);
    for (size_t i = 0; i < count; i++)
        put(a, a->data ? a->data + (first + i) * a->stride : NULL, width,
            floats ? floats + i * width : NULL, uints ? uints + i * width : NULL);
    for (size_t i = 0; i < a->sparse_count; i++) {
        const uint32_t at = load(a->sparse_indices + i * index_size, index_size);
        if (at >= a->count)
            return dp_gltf_fail(g, DP_ERR_FORMAT,
                                "accessor %u: a sparse index is %u, but there are %u elements",
                                a->number, at, a->count);
        if (at < first || at - first >= count) continue;
        const size_t to = (size_t)(at - first) * width;
        put(a, a->sparse_values + i * element, width, floats ? floats + to : NULL,
            uints ? uints + to : NULL);
    }
    return true;
}

float *dp_gltf_floats(dp_gltf *g, const dp_gltf_accessor *a, uint32_t first, uint32_t count,
                      uint32_t width) {
    float *const to = dp_arena_take(&g->arena, dp_times(count, width), sizeof *to);
    if (!to) return dp_gltf_out_of_memory(g), NULL;
    return copy(g, a, first, count, width, to, NULL) ? to : NULL;
}

uint32_t *dp_gltf_uints(dp_gltf *g, const dp_gltf_accessor *a, uint32_t first, uint32_t count,
                        uint32_t width) {
    uint32_t *const to = dp_arena_take(&g->arena, dp_times(count, width), sizeof *to);
    if (!to) return dp_gltf_out_of_memory(g), NULL;
    return copy(g, a, first, count, width, NULL, to) ? to : NULL;
}
