/* glTF 2.0 (Khronos, ISO/IEC 12113): .gltf with its buffers in data: URIs or in files beside it,
 * and .glb.
 *
 * The file is read whole, its JSON parsed, and what is drawn of it made into tables of a scene,
 * which dp_source_from_scene copies. Nothing in the file is trusted: numbers of objects and
 * bytes are checked where they are used, and messages name the object, by its number from 0 on.
 *
 * Not handled: glTF 1.0, and meshes that are compressed (Draco, meshopt): DP_ERR_UNSUPPORTED, so
 * that Assimp may try; materials but for their colours; cameras and lights. */
#include "io/gltf.h"

#include "io/readers.h"

#include <string.h>

/* ------- the container ------- */

enum { HEADER = 12, CHUNK = 8 /* bytes */ };

static uint32_t little32(const uint8_t *p) {
    return p[0] | (uint32_t)p[1] << 8 | (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
}

/* A chunk at *at; false: there is none, or it is cut off. */
static bool next_chunk(const dp_gltf *g, size_t *at, uint32_t *kind, dp_gltf_bytes *to) {
    if (g->file.size - *at < CHUNK) return false;
    const uint32_t size = little32(g->file.data + *at);
    *kind = little32(g->file.data + *at + 4);
    if (g->file.size - *at - CHUNK < size) return false;
    *to = (dp_gltf_bytes){.data = g->file.data + *at + CHUNK, .size = size};
    *at += CHUNK + size;
    *at += (4 - *at % 4) % 4;
    if (*at > g->file.size) *at = g->file.size;
    return true;
}

static bool open_binary(dp_gltf *g, dp_gltf_bytes *json) {
    static const uint32_t json_kind = 0x4e4f534a, bin_kind = 0x004e4942;
    size_t at = HEADER;
    uint32_t kind;
    dp_gltf_bytes chunk;
    if (g->file.size < HEADER)
        return dp_gltf_fail(g, DP_ERR_FORMAT, "the file ends in its header: it is cut off");
    const uint32_t version = little32(g->file.data + 4);
    if (version == 1)
        return dp_gltf_fail(g, DP_ERR_UNSUPPORTED,
                            "this is glTF 1.0: convert it to 2.0 (gltf-pipeline -i model.glb)");
    if (version != 2)
        return dp_gltf_fail(g, DP_ERR_UNSUPPORTED, "a .glb of version %u; 2 is known", version);
    if (!next_chunk(g, &at, &kind, json) || kind != json_kind)
        return dp_gltf_fail(g, DP_ERR_FORMAT,
                            "its first chunk is not JSON, or is cut off: the file is damaged");
    while (json->size && !json->data[json->size - 1]) json->size--; /* some fill up with zeros */
    while (!g->chunk.data && next_chunk(g, &at, &kind, &chunk))
        if (kind == bin_kind) g->chunk = chunk;
    return true;
}

static bool parse(dp_gltf *g, dp_stream *stream) {
    dp_gltf_bytes json;
    if (!dp_gltf_read_all(g, stream, &g->file)) return false;
    json = g->file;
    if (g->file.size >= 4 && memcmp(g->file.data, "glTF", 4) == 0 && !open_binary(g, &json))
        return false;
    g->result = dp_json_parse((const char *)json.data, json.size, &g->arena, &g->root, g->diag);
    if (g->result) return false;
    return g->root->kind == DP_JSON_OBJECT ||
           dp_gltf_fail(g, DP_ERR_FORMAT, "it is JSON, but no object, as glTF is");
}

/* ------- what the file asks for ------- */

static bool check_version(dp_gltf *g) {
    const dp_json *asset, *version;
    if (!dp_gltf_member(g, g->root, "asset", DP_JSON_OBJECT, &asset)) return false;
    version = dp_json_find(asset, "version");
    if (!version)
        return dp_gltf_fail(g, DP_ERR_FORMAT, "it does not say which version of glTF it is");
    const bool one = version->kind == DP_JSON_NUMBER || dp_json_is(version, "1.0") ||
                     dp_json_is(version, "1.1") || dp_json_is(version, "1");
    if (one)
        return dp_gltf_fail(g, DP_ERR_UNSUPPORTED,
                            "this is glTF 1.0: convert it to 2.0 (gltf-pipeline -i model.gltf)");
    if (version->kind == DP_JSON_STRING && version->as.string.size >= 2 &&
        memcmp(version->as.string.text, "2.", 2) == 0)
        return true;
    return dp_gltf_fail(g, DP_ERR_UNSUPPORTED, "a version of glTF other than 2 and 1");
}

static bool has_text(const dp_json *list, const char *text) {
    for (uint32_t i = 0; i < dp_json_count(list); i++)
        if (dp_json_is(dp_json_item(list, i), text)) return true;
    return false;
}

/* Extensions without which vertices cannot be read. */
static bool check_extensions(dp_gltf *g) {
    static const char *const compressed[] = {"KHR_draco_mesh_compression",
                                             "EXT_meshopt_compression", "KHR_meshopt_compression"};
    const dp_json *required;
    if (!dp_gltf_member(g, g->root, "extensionsRequired", DP_JSON_ARRAY, &required)) return false;
    for (size_t i = 0; i < sizeof compressed / sizeof *compressed; i++)
        if (has_text(required, compressed[i]))
            return dp_gltf_fail(g, DP_ERR_UNSUPPORTED,
                                "its meshes are compressed (%s): export it without compression, or "
                                "unpack it (npx gltf-transform copy in.glb out.glb)",
                                compressed[i]);
    return true;
}

static bool find_tables(dp_gltf *g) {
    const struct {
        const char *name;
        const dp_json **to;
    } tables[] = {{"buffers", &g->buffers},     {"bufferViews", &g->views},
                  {"accessors", &g->accessors}, {"materials", &g->materials},
                  {"meshes", &g->meshes},       {"nodes", &g->nodes},
                  {"skins", &g->skins},         {"animations", &g->animations}};
    for (size_t i = 0; i < sizeof tables / sizeof *tables; i++)
        if (!dp_gltf_member(g, g->root, tables[i].name, DP_JSON_ARRAY, tables[i].to)) return false;
    g->buffer_count = dp_json_count(g->buffers);
    g->buffer = dp_arena_take(&g->arena, g->buffer_count, sizeof *g->buffer);
    return g->buffer || dp_gltf_out_of_memory(g);
}

/* ------- the scene ------- */

static size_t count_polygons(const dp_gltf *g) {
    size_t count = 0;
    for (uint32_t i = 0; i < g->instance_count; i++)
        count += g->scene_meshes[g->instances[i].mesh - 1].batch.polygon_count;
    return count;
}

/* Files' bytes are not needed any more when the tables are made of them. */
static void release_bytes(dp_gltf *g) {
    const dp_allocator memory = g->arena.memory;
    for (uint32_t i = 0; g->buffer && i < g->buffer_count; i++) {
        dp_free(&memory, g->buffer[i].owned);
        g->buffer[i] = (dp_gltf_bytes){0};
    }
    dp_free(&memory, g->file.owned);
    g->file = g->chunk = (dp_gltf_bytes){0};
}

static bool make_source(dp_gltf *g, dp_source **out) {
    const dp_scene_desc desc = {.nodes = g->scene_nodes,
                                .node_count = g->scene_node_count,
                                .meshes = g->scene_meshes,
                                .mesh_count = g->scene_mesh_count,
                                .instances = g->instances,
                                .instance_count = g->instance_count,
                                .skins = g->scene_skins,
                                .skin_count = dp_json_count(g->skins),
                                .clips = g->clips,
                                .clip_count = dp_json_count(g->animations),
                                .up = {0, 1, 0},
                                .remark = *g->remark ? g->remark : NULL,
                                .color_remark = *g->color_remark ? g->color_remark : NULL};
    if (!count_polygons(g))
        return dp_gltf_fail(
            g, DP_ERR_FORMAT,
            "no polygons: there is nothing to draw, export the model with its faces");
    release_bytes(g);
    g->result = dp_source_from_scene(&desc, &g->arena.memory, out, g->diag);
    return !g->result;
}

static void release(dp_gltf *g) {
    const dp_allocator memory = g->arena.memory;
    release_bytes(g);
    dp_free(&memory, g->scene_meshes);
    dp_free(&memory, g->scene_nodes);
    dp_free(&memory, g->instances);
    dp_arena_free(&g->arena);
}

dp_result dp_read_gltf(dp_stream *stream, dp_source **out, dp_diag *diag) {
    dp_gltf g = {.arena = {.memory = stream->allocator}, .stream = stream, .diag = diag};
    if (parse(&g, stream) && check_version(&g) && check_extensions(&g) && find_tables(&g) &&
        dp_gltf_read_meshes(&g) && dp_gltf_read_nodes(&g) && dp_gltf_read_skins(&g) &&
        dp_gltf_read_clips(&g))
        make_source(&g, out);
    release(&g);
    return g.result;
}
