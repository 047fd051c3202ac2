/* Scenes that move, from Assimp's tree to the tables of drypoint/scene.h, which name nodes by their
 * numbers, parents first.
 *
 *     nodes      each with its matrix, and sorted by name, as bones and channels name them
 *     meshes     assimp_mesh.c, with bones (assimp_bones.c)
 *     instances  every mesh of every node; with a skin of its own where bones move it
 *     clips      assimp_clips.c
 *
 * At rest a skinned mesh follows its bones' nodes as they stand: a bone takes it by
 * (node to world) * (mesh space to bone space at binding), so that its own node does not count.
 *
 * Not handled: channels that exchange whole meshes (a remark says so). */
#include "io/assimp_scene.h"

#include "base/diag.h"
#include "base/sort.h"
#include "io/assimp_look.h"
#include "io/builder.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

bool dp_assimp_moves(const struct aiScene *scene) {
    for (unsigned i = 0; i < scene->mNumMeshes; i++)
        if (scene->mMeshes[i] &&
            (scene->mMeshes[i]->mNumBones || scene->mMeshes[i]->mNumAnimMeshes))
            return true;
    return scene->mNumAnimations > 0;
}

/* ------- nodes ------- */

static const struct aiMesh *mesh_of(const struct aiScene *scene, const struct aiNode *node,
                                    unsigned i) {
    return node->mMeshes[i] < scene->mNumMeshes ? scene->mMeshes[node->mMeshes[i]] : NULL;
}

/* Counts nodes and what they hold; 0 of *nodes where they are nested too deep. */
static bool count_nodes(dp_assimp_tables *t, const struct aiNode *node, int depth) {
    if (!node) return true;
    if (depth > DP_ASSIMP_DEEPEST) return false;
    t->node_count++;
    t->instance_count += node->mNumMeshes;
    for (unsigned i = 0; i < node->mNumChildren; i++)
        if (!count_nodes(t, node->mChildren[i], depth + 1)) return false;
    return true;
}

static const double *copy_matrix(dp_assimp_tables *t, const struct aiMatrix4x4 *m) {
    const double rows[12] = {m->a1, m->a2, m->a3, m->a4, m->b1, m->b2,
                             m->b3, m->b4, m->c1, m->c2, m->c3, m->c4};
    return dp_arena_copy(&t->arena, rows, 12, sizeof *rows);
}

/* Adds a node and what is below it; a projective last row is ignored. */
static bool add_nodes(dp_assimp_tables *t, const struct aiNode *node, uint32_t parent) {
    if (!node) return true;
    const uint32_t number = t->node_count++;
    dp_scene_node *const to = &t->nodes[number];
    to->name = *node->mName.data ? node->mName.data : NULL;
    to->parent = parent;
    to->matrix = copy_matrix(t, &node->mTransformation);
    t->sources[number] = node;
    if (!to->matrix) return false;
    for (unsigned i = 0; i < node->mNumChildren; i++)
        if (!add_nodes(t, node->mChildren[i], number + 1)) return false;
    return true;
}

/* A node's parent is who holds it, but for Half-Life's models, where Assimp (5.2) hangs all bones under
 * one node: there it is whom the node itself names. */
static void correct_parents(dp_assimp_tables *t) {
    for (uint32_t n = 0; n < t->node_count; n++) {
        const struct aiNode *const named = t->sources[n]->mParent;
        const uint32_t holder = t->nodes[n].parent;
        if (!named || !holder || t->sources[holder - 1] == named) continue;
        for (uint32_t k = 0; k < t->node_count; k++)
            if (t->sources[k] == named) t->nodes[n].parent = k + 1;
    }
}

static int compare_names(const void *left, const void *right) {
    const dp_assimp_name *const a = left, *const b = right;
    const int order = strcmp(a->text, b->text);
    return order ? order : (a->node > b->node) - (a->node < b->node);
}

static bool sort_names(dp_assimp_tables *t) {
    t->names = dp_arena_take(&t->arena, t->node_count, sizeof *t->names);
    if (!t->names) return false;
    for (uint32_t n = 0; n < t->node_count; n++)
        if (t->nodes[n].name) t->names[t->name_count++] = (dp_assimp_name){t->nodes[n].name, n + 1};
    dp_sort(t->names, t->name_count, sizeof *t->names, compare_names);
    return true;
}

uint32_t dp_assimp_find_node(const dp_assimp_tables *t, const char *name) {
    uint32_t low = 0, high = t->name_count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (strcmp(t->names[middle].text, name) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low < t->name_count && !strcmp(t->names[low].text, name) ? t->names[low].node : 0;
}

static bool fill_nodes(dp_assimp_tables *t) {
    t->nodes = dp_arena_take(&t->arena, t->node_count, sizeof *t->nodes);
    t->sources = dp_arena_take(&t->arena, t->node_count, sizeof *t->sources);
    if (!t->nodes || !t->sources) return false;
    t->node_count = 0;
    if (!add_nodes(t, t->from->mRootNode, 0)) return false;
    correct_parents(t);
    return sort_names(t);
}

/* ------- instances ------- */

/* Adds the skin of a mesh at a node: its bones, and the node for vertices that follow none. */
static bool add_skin(dp_assimp_tables *t, const dp_assimp_mesh *part, uint32_t node) {
    static const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    dp_scene_skin *const skin = &t->skins[t->skin_count];
    const uint32_t count = part->joint_count;
    *skin = (dp_scene_skin){part->joints, part->inverse_bind, count};
    t->skin_count++;
    if (!part->has_loose) return true;
    uint32_t *const joints = dp_arena_take(&t->arena, count + (size_t)1, sizeof *joints);
    double *const binds = dp_arena_take(&t->arena, count + (size_t)1, sizeof identity);
    if (!joints || !binds) return false;
    if (count) memcpy(joints, part->joints, count * sizeof *joints);
    if (count) memcpy(binds, part->inverse_bind, count * sizeof identity);
    joints[count] = node;
    memcpy(binds + 12 * (size_t)count, identity, sizeof identity);
    *skin = (dp_scene_skin){joints, binds, count + 1};
    return true;
}

/* What FBX says of targets at rest is 1 wherever Assimp does not know it. */
static bool add_rest_weights(dp_assimp_tables *t, const struct aiMesh *mesh,
                             dp_scene_instance *to) {
    if (!mesh->mNumAnimMeshes || dp_assimp_is_from(t->from, "Autodesk FBX Importer")) return true;
    float *const weights = dp_arena_take(&t->arena, mesh->mNumAnimMeshes, sizeof *weights);
    if (!weights) return false;
    for (unsigned k = 0; k < mesh->mNumAnimMeshes; k++) {
        const float weight = mesh->mAnimMeshes[k] ? mesh->mAnimMeshes[k]->mWeight : 0;
        weights[k] = isfinite(weight) ? weight : 0;
    }
    to->weights = weights;
    to->weight_count = mesh->mNumAnimMeshes;
    return true;
}

static bool add_instance(dp_assimp_tables *t, uint32_t node, unsigned mesh) {
    dp_scene_instance *const to = &t->instances[t->instance_count];
    const dp_assimp_mesh *const part = &t->parts[mesh];
    if (!part->has_areas) return true;
    *to = (dp_scene_instance){.node = node, .mesh = mesh + 1};
    t->instance_count++;
    if (dp_assimp_is_textured(t->from, t->from->mMeshes[mesh])) t->is_textured = true;
    if (part->joint_count) {
        if (!add_skin(t, part, node)) return false;
        to->skin = t->skin_count;
    }
    return add_rest_weights(t, t->from->mMeshes[mesh], to);
}

static bool fill_instances(dp_assimp_tables *t) {
    t->instances = dp_arena_take(&t->arena, t->instance_count, sizeof *t->instances);
    t->skins = dp_arena_take(&t->arena, t->instance_count, sizeof *t->skins);
    if (!t->instances || !t->skins) return false;
    t->instance_count = 0;
    for (uint32_t n = 0; n < t->node_count; n++)
        for (unsigned i = 0; i < t->sources[n]->mNumMeshes; i++)
            if (mesh_of(t->from, t->sources[n], i) &&
                !add_instance(t, n + 1, t->sources[n]->mMeshes[i]))
                return false;
    return true;
}

/* ------- the whole ------- */

static void write_remark(const dp_assimp_tables *t, char *text, size_t size) {
    static const char *const what[DP_FLAWS] = {
        [DP_FLAW_BONES] = "bones name no node of the file, and move nothing",
        [DP_FLAW_INFLUENCES] = "influences of bones on vertices that have too many are left out",
        [DP_FLAW_CHANNELS] = "channels of its animations name no node, and move nothing",
        [DP_FLAW_MESH_CHANNELS] = "channels that exchange whole meshes are left out"};
    size_t length = 0;
    for (int k = 0; k < DP_FLAWS && length < size; k++)
        if (t->flaws[k])
            length +=
                (size_t)snprintf(text + length, size - length, "%s%llu %s", length ? "; " : "",
                                 (unsigned long long)t->flaws[k], what[k]);
}

static dp_result make_source(dp_assimp_tables *t, const dp_allocator *allocator, dp_source **out,
                             dp_diag *diag) {
    char remark[512] = "";
    write_remark(t, remark, sizeof remark);
    dp_scene_desc desc = {.nodes = t->nodes,
                          .meshes = t->meshes,
                          .instances = t->instances,
                          .skins = t->skins,
                          .clips = t->clips,
                          .node_count = t->node_count,
                          .mesh_count = t->from->mNumMeshes,
                          .instance_count = t->instance_count,
                          .skin_count = t->skin_count,
                          .clip_count = t->from->mNumAnimations,
                          .remark = *remark ? remark : NULL,
                          .color_remark = t->is_textured ? DP_TEXTURES_REMARK : NULL};
    dp_assimp_find_up(t->from, desc.up);
    return dp_source_from_scene(&desc, allocator, out, diag);
}

dp_result dp_assimp_make_scene(const struct aiScene *scene, const dp_allocator *allocator,
                               dp_source **out, dp_diag *diag) {
    dp_assimp_tables t = {.from = scene, .arena.memory = dp_allocator_resolve(allocator)};
    dp_result result = DP_OK;
    if (!count_nodes(&t, scene->mRootNode, 0))
        result =
            dp_fail(diag, DP_ERR_LIMIT, "nodes are nested more than %d deep: flatten the scene",
                    (int)DP_ASSIMP_DEEPEST);
    else if (!fill_nodes(&t) || !dp_assimp_fill_meshes(&t) || !fill_instances(&t) ||
             !dp_assimp_fill_clips(&t))
        result = dp_fail(diag, DP_ERR_MEMORY, "out of memory for the scene");
    else if (!t.instance_count)
        result =
            dp_fail(diag, DP_ERR_FORMAT, "there are no polygons in it: export the model again");
    else
        result = make_source(&t, allocator, out, diag);
    dp_arena_free(&t.arena);
    return result;
}
