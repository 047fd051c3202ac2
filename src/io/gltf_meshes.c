/* Meshes of glTF: each primitive of triangles becomes a mesh of a scene.
 *
 * Of an indexed primitive only the vertices between the smallest and the largest index are
 * taken, as many files keep the vertices of all primitives in one accessor. Colours are as in
 * the file, without a conversion; vertices' are multiplied by the material's.
 *
 * Not handled: points and lines (they are left out), textures (that there are some is noted),
 * texture transforms. */
#include "io/gltf.h"

#include "io/color.h"

#include <stdio.h>
#include <string.h>

enum { TRIANGLES = 4, STRIP, FAN, MOST_SETS = 1024 /* of joints: 16 bits count influences */ };

/* What of a primitive is read. */
typedef struct primitive {
    const dp_json *json, *attributes;
    uint32_t vertices;     /* of its accessors */
    uint32_t first, count; /* vertices that are taken */
    dp_scene_mesh *mesh;
} primitive;

/* ------- attributes ------- */

/* 1 + number of an attribute's accessor; 0: there is none. */
static bool find_attribute(dp_gltf *g, const dp_json *attributes, const char *name, uint32_t *to) {
    return dp_gltf_index(g, attributes, name, g->accessors, "accessor", to);
}

/* Opens an attribute that has a value for each vertex. */
static bool open_attribute(dp_gltf *g, const primitive *p, uint32_t number, const char *name,
                           uint32_t least, dp_gltf_accessor *a) {
    if (!dp_gltf_accessor_open(g, number, a)) return false;
    if (a->components < least)
        return dp_gltf_fail(g, DP_ERR_FORMAT, "accessor %u, %s, has only %u numbers per vertex",
                            number, name, a->components);
    if (a->count < p->vertices)
        return dp_gltf_fail(g, DP_ERR_FORMAT,
                            "accessor %u, %s, has %u values for %u vertices: export the model "
                            "again",
                            number, name, a->count, p->vertices);
    return true;
}

/* Values of an attribute, `width` floats each; NULL: there is none. */
static bool read_attribute(dp_gltf *g, const primitive *p, const dp_json *attributes,
                           const char *name, uint32_t width, float **to) {
    dp_gltf_accessor a;
    uint32_t number;
    *to = NULL;
    if (!find_attribute(g, attributes, name, &number)) return false;
    if (!number) return true;
    return open_attribute(g, p, number - 1, name, width, &a) &&
           (*to = dp_gltf_floats(g, &a, p->first, p->count, width));
}

/* ------- polygons ------- */

/* Corners of a strip's or a fan's triangle number i (3.7.2.1), of `v` or of all vertices. */
static void corners_of(uint32_t mode, const uint32_t *v, uint32_t i, uint32_t to[3]) {
    const uint32_t strip[3] = {i, i + 1 + i % 2, i + 2 - i % 2};
    const uint32_t fan[3] = {i + 1, i + 2, 0};
    const uint32_t plain[3] = {3 * i, 3 * i + 1, 3 * i + 2};
    const uint32_t *const from = mode == STRIP ? strip : mode == FAN ? fan : plain;
    for (int k = 0; k < 3; k++) to[k] = v ? v[from[k]] : from[k];
}

/* The range of vertices that are used; indices out of it remain to be dropped. */
static void find_range(primitive *p, const uint32_t *v, uint32_t count) {
    uint32_t min = UINT32_MAX, max = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (v[i] >= p->vertices) continue;
        if (v[i] < min) min = v[i];
        if (v[i] > max) max = v[i];
    }
    p->first = min <= max ? min : 0;
    p->count = min <= max ? max - min + 1 : 0;
}

static bool make_triangles(dp_gltf *g, primitive *p, uint32_t mode, const uint32_t *v,
                           uint32_t count) {
    const uint32_t triangles = mode == TRIANGLES ? count / 3 : count < 3 ? 0 : count - 2;
    uint32_t *const indices = dp_arena_take(&g->arena, triangles, 3 * sizeof *indices);
    if (!indices) return dp_gltf_out_of_memory(g);
    for (uint32_t i = 0; i < triangles; i++) {
        uint32_t corners[3];
        corners_of(mode, v, i, corners);
        for (int k = 0; k < 3; k++) {
            const uint32_t at = corners[k] - p->first;
            indices[3 * (size_t)i + (size_t)k] = at < p->count ? at : UINT32_MAX;
        }
    }
    p->mesh->batch.indices = indices;
    p->mesh->batch.polygon_count = triangles;
    p->mesh->batch.corner_count = 3 * (size_t)triangles;
    p->mesh->batch.vertex_count = p->count;
    return true;
}

static bool read_corners(dp_gltf *g, primitive *p, uint32_t mode) {
    dp_gltf_accessor a;
    uint32_t number;
    p->first = 0, p->count = p->vertices;
    if (!find_attribute(g, p->json, "indices", &number)) return false;
    if (!number) return make_triangles(g, p, mode, NULL, p->vertices);
    if (!dp_gltf_accessor_open(g, number - 1, &a)) return false;
    const uint32_t *const v = dp_gltf_uints(g, &a, 0, a.count, 1);
    if (!v) return false;
    find_range(p, v, a.count);
    return make_triangles(g, p, mode, v, a.count);
}

/* ------- colours ------- */

static bool read_factor(dp_gltf *g, const dp_json *object, const char *name, uint32_t count,
                        float rgb[3]) {
    double factor[4];
    bool has;
    if (!dp_gltf_numbers(g, object, name, count, factor, &has)) return false;
    for (int k = 0; has && k < 3; k++) rgb[k] = (float)factor[k];
    return true;
}

static const char textures_are_left_out[] =
    "the model's textures are not drawn, only its other colours";

static void note_texture(dp_gltf *g, const dp_json *object, const char *name) {
    if (dp_json_find(object, name) && !*g->color_remark)
        snprintf(g->color_remark, sizeof g->color_remark, "%s", textures_are_left_out);
}

/* The material's colour; without a material it is white (3.7.2.1). */
static bool read_material(dp_gltf *g, const primitive *p, float rgb[3]) {
    const dp_json *extensions, *glossy, *metallic;
    uint32_t number;
    if (!dp_gltf_index(g, p->json, "material", g->materials, "material", &number)) return false;
    if (!number) return true;
    const dp_json *const material = dp_json_item(g->materials, number - 1);
    if (!dp_gltf_member(g, material, "pbrMetallicRoughness", DP_JSON_OBJECT, &metallic) ||
        !dp_gltf_member(g, material, "extensions", DP_JSON_OBJECT, &extensions) ||
        !dp_gltf_member(g, extensions, "KHR_materials_pbrSpecularGlossiness", DP_JSON_OBJECT,
                        &glossy) ||
        !read_factor(g, metallic, "baseColorFactor", 4, rgb) ||
        !read_factor(g, glossy, "diffuseFactor", 4, rgb))
        return false;
    note_texture(g, metallic, "baseColorTexture");
    note_texture(g, glossy, "diffuseTexture");
    return true;
}

static bool read_colors(dp_gltf *g, const primitive *p) {
    float rgb[3] = {1, 1, 1}, *values;
    if (!read_material(g, p, rgb) || !read_attribute(g, p, p->attributes, "COLOR_0", 3, &values))
        return false;
    p->mesh->color = dp_color_of(rgb, 1);
    if (!values) return true;
    uint32_t *const colors = dp_arena_take(&g->arena, p->count, sizeof *colors);
    if (!colors) return dp_gltf_out_of_memory(g);
    for (size_t v = 0; v < p->count; v++) {
        const float product[3] = {values[3 * v] * rgb[0], values[3 * v + 1] * rgb[1],
                                  values[3 * v + 2] * rgb[2]};
        colors[v] = dp_color_of(product, 1);
    }
    p->mesh->batch.colors = colors;
    return true;
}

/* ------- skins and morph targets ------- */

static bool count_sets(dp_gltf *g, const primitive *p, uint32_t *sets) {
    char joints[24], weights[24];
    for (*sets = 0; *sets < MOST_SETS; ++*sets) {
        uint32_t joint, weight;
        snprintf(joints, sizeof joints, "JOINTS_%u", *sets);
        snprintf(weights, sizeof weights, "WEIGHTS_%u", *sets);
        if (!find_attribute(g, p->attributes, joints, &joint) ||
            !find_attribute(g, p->attributes, weights, &weight))
            return false;
        if (!joint || !weight) break;
    }
    return true;
}

static bool read_set(dp_gltf *g, const primitive *p, uint32_t set, uint16_t *joints,
                     float *weights) {
    const size_t influences = p->mesh->influences;
    char name[24];
    float *from;
    dp_gltf_accessor a;
    uint32_t number;
    snprintf(name, sizeof name, "WEIGHTS_%u", set);
    if (!read_attribute(g, p, p->attributes, name, 4, &from)) return false;
    for (size_t v = 0; v < p->count; v++)
        memcpy(weights + v * influences + 4 * set, from + 4 * v, 4 * sizeof *from);
    snprintf(name, sizeof name, "JOINTS_%u", set);
    if (!find_attribute(g, p->attributes, name, &number) ||
        !open_attribute(g, p, number - 1, name, 4, &a))
        return false;
    const uint32_t *const numbers = dp_gltf_uints(g, &a, p->first, p->count, 4);
    for (size_t i = 0; numbers && i < 4 * (size_t)p->count; i++)
        joints[i / 4 * influences + 4 * set + i % 4] =
            (uint16_t)(numbers[i] < UINT16_MAX ? numbers[i] : UINT16_MAX);
    return numbers;
}

static bool read_influences(dp_gltf *g, const primitive *p) {
    uint32_t sets;
    if (!count_sets(g, p, &sets)) return false;
    if (!sets) return true;
    p->mesh->influences = 4 * sets;
    const size_t count = dp_times(p->count, 4 * (size_t)sets);
    uint16_t *const joints = dp_arena_take(&g->arena, count, sizeof *joints);
    float *const weights = dp_arena_take(&g->arena, count, sizeof *weights);
    if (!joints || !weights) return dp_gltf_out_of_memory(g);
    for (uint32_t set = 0; set < sets; set++)
        if (!read_set(g, p, set, joints, weights)) return false;
    p->mesh->joints = joints, p->mesh->weights = weights;
    return true;
}

static bool read_morphs(dp_gltf *g, const primitive *p) {
    const dp_json *targets;
    if (!dp_gltf_member(g, p->json, "targets", DP_JSON_ARRAY, &targets)) return false;
    const uint32_t count = dp_json_count(targets);
    dp_scene_morph *const morphs = dp_arena_take(&g->arena, count, sizeof *morphs);
    if (!morphs) return dp_gltf_out_of_memory(g);
    for (uint32_t i = 0; i < count; i++) {
        const dp_json *const target = dp_json_item(targets, i);
        float *positions, *normals;
        if (!read_attribute(g, p, target, "POSITION", 3, &positions) ||
            !read_attribute(g, p, target, "NORMAL", 3, &normals))
            return false;
        morphs[i] = (dp_scene_morph){.positions = positions, .normals = normals};
    }
    p->mesh->morphs = morphs, p->mesh->morph_count = count;
    return true;
}

/* ------- primitives ------- */

static bool read_vertices(dp_gltf *g, const primitive *p) {
    dp_batch *const b = &p->mesh->batch;
    float *positions, *normals, *texcoords;
    if (!read_attribute(g, p, p->attributes, "POSITION", 3, &positions) ||
        !read_attribute(g, p, p->attributes, "NORMAL", 3, &normals) ||
        !read_attribute(g, p, p->attributes, "TEXCOORD_0", 2, &texcoords))
        return false;
    for (size_t v = 0; texcoords && v < p->count; v++) /* v grows upwards, as in other formats */
        texcoords[2 * v + 1] = 1 - texcoords[2 * v + 1];
    b->positions = positions;
    b->normals = (dp_attribute){.values = normals, .count = p->count};
    b->texcoords = (dp_attribute){.values = texcoords, .count = p->count};
    return true;
}

static bool is_compressed(const dp_json *json) {
    const dp_json *const extensions = dp_json_find(json, "extensions");
    return dp_json_find(extensions, "KHR_draco_mesh_compression");
}

/* Finds the primitive's vertices; none are no failure. */
static bool find_vertices(dp_gltf *g, primitive *p) {
    dp_gltf_accessor a;
    uint32_t number;
    if (!dp_gltf_member(g, p->json, "attributes", DP_JSON_OBJECT, &p->attributes) ||
        !find_attribute(g, p->attributes, "POSITION", &number))
        return false;
    if (!number) return true;
    if (is_compressed(p->json) &&
        !dp_json_find(dp_json_item(g->accessors, number - 1), "bufferView"))
        return dp_gltf_fail(g, DP_ERR_UNSUPPORTED,
                            "it is compressed with Draco: export the model without compression");
    if (!dp_gltf_accessor_open(g, number - 1, &a)) return false;
    p->vertices = a.count;
    return true;
}

/* Adds a mesh to the scene's, unless the primitive has no triangles. */
static bool read_primitive(dp_gltf *g, const dp_json *json, const char *name) {
    dp_scene_mesh mesh = {.name = name};
    primitive p = {.json = json, .mesh = &mesh};
    uint32_t mode;
    if (!dp_gltf_uint(g, json, "mode", TRIANGLES, &mode)) return false;
    if (mode > FAN) return dp_gltf_fail(g, DP_ERR_FORMAT, "\"mode\" is %u; 6 is the last", mode);
    if (mode < TRIANGLES) return true;
    if (!find_vertices(g, &p)) return false;
    if (!p.vertices) return true;
    if (!read_corners(g, &p, mode) || !read_vertices(g, &p) || !read_colors(g, &p) ||
        !read_influences(g, &p) || !read_morphs(g, &p))
        return false;
    if (!dp_reserve(&g->arena.memory, &g->scene_meshes, &g->scene_meshes_cap,
                    (size_t)g->scene_mesh_count + 1, sizeof *g->scene_meshes))
        return dp_gltf_out_of_memory(g);
    g->scene_meshes[g->scene_mesh_count++] = mesh;
    return true;
}

/* "wheel", or, where a mesh has several primitives, "wheel-0". */
static const char *name_primitive(dp_gltf *g, const char *mesh, uint32_t i, uint32_t count) {
    if (count < 2) return mesh;
    const size_t size = strlen(mesh) + 16;
    char *const name = dp_arena_take(&g->arena, size, 1);
    if (!name) return dp_gltf_out_of_memory(g), NULL;
    snprintf(name, size, "%s-%u", mesh, i);
    return name;
}

static bool read_mesh(dp_gltf *g, uint32_t number) {
    const dp_json *const json = dp_json_item(g->meshes, number), *primitives;
    dp_gltf_mesh *const mesh = &g->mesh[number];
    dp_gltf_at(g, "mesh %u: ", number);
    const char *const name = dp_gltf_name(g, json, "meshes", number);
    if (!name || !dp_gltf_member(g, json, "primitives", DP_JSON_ARRAY, &primitives)) return false;
    const uint32_t count = dp_json_count(primitives);
    mesh->first = g->scene_mesh_count;
    mesh->morph_count = dp_json_count(dp_json_find(dp_json_item(primitives, 0), "targets"));
    for (uint32_t i = 0; i < count; i++) {
        const char *const own = name_primitive(g, name, i, count);
        dp_gltf_at(g, count > 1 ? "mesh %u, primitive %u: " : "mesh %u: ", number, i);
        if (!own || !read_primitive(g, dp_json_item(primitives, i), own)) return false;
    }
    mesh->count = g->scene_mesh_count - mesh->first;
    return true;
}

bool dp_gltf_read_meshes(dp_gltf *g) {
    const uint32_t count = dp_json_count(g->meshes);
    g->mesh = dp_arena_take(&g->arena, count, sizeof *g->mesh);
    if (!g->mesh) return dp_gltf_out_of_memory(g);
    for (uint32_t i = 0; i < count; i++)
        if (!read_mesh(g, i)) return false;
    *g->where = 0;
    return true;
}
