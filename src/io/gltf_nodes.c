/* Nodes of glTF, skins, and the instances of the scene that is drawn: the default one, or the
 * first, or all that have no parent.
 *
 * Not handled: cameras, lights. */
#include "io/gltf.h"

#include "base/vec.h"

#include <stdio.h>
#include <string.h>

/* For a node of which nothing is to be seen: 0 0 0 would mean that its scale is not given. */
static const double nothing = 1e-200;

enum { MOST_INSTANCES = 1 << 24 /* a small file may ask for more than any memory holds */ };

/* ------- transforms ------- */

static bool read_matrix(dp_gltf *g, const dp_json *json, dp_scene_node *node) {
    double columns[16];
    bool has;
    if (!dp_gltf_numbers(g, json, "matrix", 16, columns, &has)) return false;
    if (!has) return true;
    double *const rows = dp_arena_take(&g->arena, 12, sizeof *rows);
    if (!rows) return dp_gltf_out_of_memory(g);
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 4; c++) rows[4 * r + c] = columns[4 * c + r];
    node->matrix = rows;
    return true;
}

static void keep_small(double scale[3]) {
    if (scale[0] == 0 && scale[1] == 0 && scale[2] == 0) scale[0] = scale[1] = scale[2] = nothing;
}

static bool read_transform(dp_gltf *g, const dp_json *json, dp_scene_node *node) {
    bool has;
    if (!read_matrix(g, json, node) ||
        !dp_gltf_numbers(g, json, "translation", 3, node->translation, &has) ||
        !dp_gltf_numbers(g, json, "rotation", 4, node->rotation, &has) ||
        !dp_gltf_numbers(g, json, "scale", 3, node->scale, &has))
        return false;
    if (has) keep_small(node->scale);
    return true;
}

static bool add_node(dp_gltf *g, const dp_scene_node *node) {
    if (g->scene_node_count == UINT32_MAX) return dp_gltf_fail(g, DP_ERR_LIMIT, "too many nodes");
    if (!dp_reserve(&g->arena.memory, &g->scene_nodes, &g->scene_nodes_cap,
                    (size_t)g->scene_node_count + 1, sizeof *g->scene_nodes))
        return dp_gltf_out_of_memory(g);
    g->scene_nodes[g->scene_node_count++] = *node;
    return true;
}

static bool read_children(dp_gltf *g, uint32_t number) {
    const dp_json *children;
    if (!dp_gltf_member(g, dp_json_item(g->nodes, number), "children", DP_JSON_ARRAY, &children))
        return false;
    for (uint32_t i = 0; i < dp_json_count(children); i++) {
        uint32_t child;
        if (!dp_gltf_index_of(g, dp_json_item(children, i), "children", g->nodes, "node", &child))
            return false;
        uint32_t *const parent = &g->scene_nodes[child - 1].parent;
        if (*parent)
            return dp_gltf_fail(g, DP_ERR_FORMAT,
                                "its child %u is one of node %u already: nodes must form trees",
                                child - 1, *parent - 1);
        *parent = number + 1;
    }
    return true;
}

static bool read_tree(dp_gltf *g) {
    for (uint32_t i = 0; i < dp_json_count(g->nodes); i++) {
        const dp_json *const json = dp_json_item(g->nodes, i);
        dp_scene_node node = {.name = dp_gltf_name(g, json, "nodes", i)};
        dp_gltf_at(g, "node %u: ", i);
        if (!node.name || !read_transform(g, json, &node) || !add_node(g, &node)) return false;
    }
    for (uint32_t i = 0; i < dp_json_count(g->nodes); i++) {
        dp_gltf_at(g, "node %u: ", i);
        if (!read_children(g, i)) return false;
    }
    return true;
}

/* ------- instances ------- */

/* What a node with a mesh has besides. */
typedef struct place {
    uint32_t mesh, skin; /* 1 + numbers */
    const float *weights;
    uint32_t weight_count;
} place;

static bool add_instances(dp_gltf *g, const place *p, uint32_t node) {
    const dp_gltf_mesh *const mesh = &g->mesh[p->mesh - 1];
    if (mesh->count > MOST_INSTANCES - g->instance_count)
        return dp_gltf_fail(g, DP_ERR_LIMIT, "a scene of more than %d parts", (int)MOST_INSTANCES);
    for (uint32_t i = 0; i < mesh->count; i++) {
        if (!dp_reserve(&g->arena.memory, &g->instances, &g->instances_cap,
                        (size_t)g->instance_count + 1, sizeof *g->instances))
            return dp_gltf_out_of_memory(g);
        g->instances[g->instance_count++] = (dp_scene_instance){.node = node,
                                                                .mesh = mesh->first + i + 1,
                                                                .skin = p->skin,
                                                                .weights = p->weights,
                                                                .weight_count = p->weight_count};
    }
    return true;
}

static bool read_weights(dp_gltf *g, const dp_json *json, place *p) {
    const dp_json *array;
    if (!dp_gltf_member(g, json, "weights", DP_JSON_ARRAY, &array)) return false;
    if (!array || p->weights) return true;
    float *const weights = dp_arena_take(&g->arena, array->count, sizeof *weights);
    if (!weights) return dp_gltf_out_of_memory(g);
    for (uint32_t i = 0; i < array->count; i++) {
        if (array->as.items[i].kind != DP_JSON_NUMBER)
            return dp_gltf_fail(g, DP_ERR_FORMAT, "\"weights\" must be numbers");
        weights[i] = (float)array->as.items[i].as.number;
    }
    p->weights = weights, p->weight_count = array->count;
    return true;
}

/* Values of one attribute of EXT_mesh_gpu_instancing; *count is set by the first. */
static bool read_copies(dp_gltf *g, const dp_json *attributes, const char *name, uint32_t width,
                        uint32_t *count, const float **to) {
    dp_gltf_accessor a;
    uint32_t number;
    *to = NULL;
    if (!dp_gltf_index(g, attributes, name, g->accessors, "accessor", &number)) return false;
    if (!number) return true;
    if (!dp_gltf_accessor_open(g, number - 1, &a)) return false;
    if (*count && *count != a.count)
        return dp_gltf_fail(g, DP_ERR_FORMAT, "its copies have %u and %u values", *count, a.count);
    *count = a.count;
    *to = dp_gltf_floats(g, &a, 0, a.count, width);
    return *to;
}

/* A node of its own for each copy. */
static bool add_copies(dp_gltf *g, const dp_json *attributes, const place *p, uint32_t node) {
    const float *translations, *rotations, *scales;
    uint32_t count = 0;
    if (!read_copies(g, attributes, "TRANSLATION", 3, &count, &translations) ||
        !read_copies(g, attributes, "ROTATION", 4, &count, &rotations) ||
        !read_copies(g, attributes, "SCALE", 3, &count, &scales))
        return false;
    for (size_t i = 0; i < count; i++) {
        dp_scene_node copy = {.name = g->scene_nodes[node - 1].name, .parent = node};
        for (size_t k = 0; translations && k < 3; k++)
            copy.translation[k] = translations[3 * i + k];
        for (size_t k = 0; rotations && k < 4; k++) copy.rotation[k] = rotations[4 * i + k];
        for (size_t k = 0; scales && k < 3; k++) copy.scale[k] = scales[3 * i + k];
        if (scales) keep_small(copy.scale);
        if (!add_node(g, &copy) || !add_instances(g, p, g->scene_node_count)) return false;
    }
    return true;
}

static bool read_mesh_of(dp_gltf *g, uint32_t number) {
    const dp_json *const json = dp_json_item(g->nodes, number);
    const dp_json *extensions, *copies, *attributes;
    place p = {0};
    dp_gltf_at(g, "node %u: ", number);
    if (!dp_gltf_index(g, json, "mesh", g->meshes, "mesh", &p.mesh)) return false;
    if (!p.mesh) return true;
    if (!dp_gltf_index(g, json, "skin", g->skins, "skin", &p.skin) || !read_weights(g, json, &p) ||
        !read_weights(g, dp_json_item(g->meshes, p.mesh - 1), &p) ||
        !dp_gltf_member(g, json, "extensions", DP_JSON_OBJECT, &extensions) ||
        !dp_gltf_member(g, extensions, "EXT_mesh_gpu_instancing", DP_JSON_OBJECT, &copies) ||
        !dp_gltf_member(g, copies, "attributes", DP_JSON_OBJECT, &attributes))
        return false;
    if (attributes) return add_copies(g, attributes, &p, number + 1);
    return add_instances(g, &p, number + 1);
}

/* ------- the scene ------- */

/* Nodes that are still to be visited, the next one last. */
typedef struct walk {
    uint32_t *stack; /* [count] numbers of nodes */
    size_t count, cap;
    bool *seen;
} walk;

static bool push(dp_gltf *g, walk *w, uint32_t node) {
    if (!dp_reserve(&g->arena.memory, &w->stack, &w->cap, w->count + 1, sizeof *w->stack))
        return dp_gltf_out_of_memory(g);
    w->stack[w->count++] = node;
    return true;
}

/* The first of the list comes last. */
static bool push_all(dp_gltf *g, walk *w, const dp_json *list) {
    for (uint32_t i = dp_json_count(list); i > 0; i--) {
        uint32_t node;
        if (!dp_gltf_index_of(g, dp_json_item(list, i - 1), "nodes", g->nodes, "node", &node) ||
            !push(g, w, node - 1))
            return false;
    }
    return true;
}

static bool push_roots(dp_gltf *g, walk *w) {
    for (uint32_t i = dp_json_count(g->nodes); i > 0; i--)
        if (!g->scene_nodes[i - 1].parent && !push(g, w, i - 1)) return false;
    return true;
}

/* Begins with the nodes of the scene that is drawn. */
static bool begin(dp_gltf *g, walk *w) {
    const dp_json *scenes, *list;
    uint32_t number;
    *g->where = 0;
    if (!dp_gltf_member(g, g->root, "scenes", DP_JSON_ARRAY, &scenes) ||
        !dp_gltf_index(g, g->root, "scene", scenes, "scene", &number))
        return false;
    if (!dp_json_count(scenes)) return push_roots(g, w);
    if (!number) number = 1;
    dp_gltf_at(g, "scene %u: ", number - 1);
    return dp_gltf_member(g, dp_json_item(scenes, number - 1), "nodes", DP_JSON_ARRAY, &list) &&
           push_all(g, w, list);
}

static bool visit(dp_gltf *g, walk *w) {
    while (w->count) {
        const uint32_t node = w->stack[--w->count];
        if (w->seen[node])
            return dp_gltf_fail(g, DP_ERR_FORMAT,
                                "it is in the scene twice: nodes must form trees");
        w->seen[node] = true;
        if (!read_mesh_of(g, node) ||
            !push_all(g, w, dp_json_find(dp_json_item(g->nodes, node), "children")))
            return false;
    }
    return true;
}

/* A node from which no way up ends is its own ancestor. */
static bool check_circles(dp_gltf *g) {
    const uint32_t count = dp_json_count(g->nodes);
    uint8_t *const state = dp_arena_take(&g->arena, count, 1); /* 1: on this way, 2: sound */
    if (!state) return dp_gltf_out_of_memory(g);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t node = i + 1;
        for (; node && !state[node - 1]; node = g->scene_nodes[node - 1].parent)
            state[node - 1] = 1;
        if (node && state[node - 1] == 1) {
            dp_gltf_at(g, "node %u: ", node - 1);
            return dp_gltf_fail(g, DP_ERR_FORMAT, "it is its own ancestor: nodes must form trees");
        }
        for (node = i + 1; node && state[node - 1] == 1; node = g->scene_nodes[node - 1].parent)
            state[node - 1] = 2;
    }
    return true;
}

bool dp_gltf_read_nodes(dp_gltf *g) {
    walk w = {.seen = dp_arena_take(&g->arena, dp_json_count(g->nodes), sizeof *w.seen)};
    if (!w.seen) return dp_gltf_out_of_memory(g);
    const bool done = read_tree(g) && check_circles(g) && begin(g, &w) && visit(g, &w);
    dp_free(&g->arena.memory, w.stack);
    *g->where = 0;
    return done;
}

/* ------- skins ------- */

static bool read_binds(dp_gltf *g, const dp_json *json, dp_scene_skin *skin) {
    dp_gltf_accessor a;
    uint32_t number;
    if (!dp_gltf_index(g, json, "inverseBindMatrices", g->accessors, "accessor", &number))
        return false;
    if (!number) return true;
    if (!dp_gltf_accessor_open(g, number - 1, &a)) return false;
    if (a.components != 16 || a.count < skin->joint_count)
        return dp_gltf_fail(g, DP_ERR_FORMAT,
                            "accessor %u must be a MAT4 for each of the %u joints", number - 1,
                            skin->joint_count);
    const float *const columns = dp_gltf_floats(g, &a, 0, skin->joint_count, 16);
    double *const rows = dp_arena_take(&g->arena, dp_times(12, skin->joint_count), sizeof *rows);
    if (!columns) return false;
    if (!rows) return dp_gltf_out_of_memory(g);
    for (size_t j = 0; j < skin->joint_count; j++)
        for (size_t r = 0; r < 3; r++)
            for (size_t c = 0; c < 4; c++) rows[12 * j + 4 * r + c] = columns[16 * j + 4 * c + r];
    skin->inverse_bind = rows;
    return true;
}

static bool read_skin(dp_gltf *g, uint32_t number, dp_scene_skin *skin) {
    const dp_json *const json = dp_json_item(g->skins, number), *list;
    dp_gltf_at(g, "skin %u: ", number);
    if (!dp_gltf_member(g, json, "joints", DP_JSON_ARRAY, &list)) return false;
    uint32_t *const joints = dp_arena_take(&g->arena, dp_json_count(list), sizeof *joints);
    if (!joints) return dp_gltf_out_of_memory(g);
    skin->joints = joints, skin->joint_count = dp_json_count(list);
    for (uint32_t i = 0; i < skin->joint_count; i++)
        if (!dp_gltf_index_of(g, dp_json_item(list, i), "joints", g->nodes, "node", &joints[i]))
            return false;
    return read_binds(g, json, skin);
}

bool dp_gltf_read_skins(dp_gltf *g) {
    const uint32_t count = dp_json_count(g->skins);
    g->scene_skins = dp_arena_take(&g->arena, count, sizeof *g->scene_skins);
    if (!g->scene_skins) return dp_gltf_out_of_memory(g);
    for (uint32_t i = 0; i < count; i++)
        if (!read_skin(g, i, &g->scene_skins[i])) return false;
    *g->where = 0;
    return true;
}
