/* The pose of a scene at a time: its nodes' transforms, its joints, and the weights of morph
 * targets.
 *
 * A node's transform to world space is kept from pose to pose, with the number of the pose in
 * which it became another. So instances that did not move are not placed again.
 *
 * A mirrored instance has its corners reversed, so that fronts stay fronts. A skinned one is
 * mirrored where most of it follows joints that mirror. */
#include "scene/scene.h"

#include "scene/sample.h"

#include <string.h>

/* ------- sampling ------- */

static void move_node(dp_scene *s, const dp_scene_channel *c) {
    dp_trs *const trs = &s->trs[c->node - 1];
    double *const to = c->path == DP_SCENE_TRANSLATION ? trs->translation
                       : c->path == DP_SCENE_ROTATION  ? trs->rotation
                                                       : trs->scale;
    memcpy(to, s->sampled, c->width * sizeof *to);
    s->moves[c->node - 1] = true;
}

static void move_weights(dp_scene *s, const dp_scene_channel *c) {
    for (uint32_t i = s->node_instances[c->node - 1]; i; i = s->next_instance[i - 1]) {
        const dp_placed *const placed = &s->placed[i - 1];
        const uint32_t most = placed->mesh->morph_count;
        const uint32_t count = c->width < most ? c->width : most;
        memcpy(placed->weights, s->sampled, count * sizeof *s->sampled);
    }
}

static void rest(dp_scene *s) {
    memcpy(s->trs, s->rest, s->desc.node_count * sizeof *s->trs);
    memset(s->moves, 0, s->desc.node_count * sizeof *s->moves);
    for (uint32_t i = 0; i < s->desc.instance_count; i++) {
        const dp_scene_instance *const instance = &s->desc.instances[i];
        for (uint32_t k = 0; k < instance->weight_count; k++)
            s->placed[i].weights[k] = instance->weights[k];
    }
}

static void sample(dp_scene *s) {
    rest(s);
    if (!s->clip) return;
    const dp_scene_clip *const clip = &s->clips[s->clip - 1];
    for (uint32_t k = 0; k < clip->channel_count; k++) {
        const dp_scene_channel *const c = &clip->channels[k];
        if (!dp_channel_sample(c, s->time, s->sampled)) continue;
        if (c->path == DP_SCENE_WEIGHTS)
            move_weights(s, c);
        else
            move_node(s, c);
    }
}

/* ------- transforms ------- */

static dp_affine local_of(const dp_scene *s, uint32_t node) {
    const double *const matrix = s->desc.nodes[node].matrix;
    dp_affine local;
    if (!matrix || s->moves[node]) return dp_affine_of(&s->trs[node]);
    memcpy(local.row, matrix, sizeof local.row);
    return local;
}

static void move_nodes(dp_scene *s) {
    for (uint32_t i = 0; i < s->desc.node_count; i++) {
        const uint32_t node = s->order[i], parent = s->desc.nodes[node].parent;
        dp_affine world = local_of(s, node);
        if (parent) world = dp_affine_compose(&s->worlds[parent - 1], &world);
        if (memcmp(&world, &s->worlds[node], sizeof world) == 0) continue;
        s->worlds[node] = world;
        s->changed[node] = s->pose;
    }
}

static bool joints_changed(const dp_scene *s, uint32_t skin) {
    const dp_scene_skin *const k = &s->desc.skins[skin];
    if (!s->skin_changed[skin]) return true; /* the first pose */
    for (uint32_t j = 0; j < k->joint_count; j++)
        if (s->changed[k->joints[j] - 1] == s->pose) return true;
    return false;
}

static void move_joints(dp_scene *s) {
    for (uint32_t i = 0; i < s->desc.skin_count; i++) {
        const dp_scene_skin *const skin = &s->desc.skins[i];
        if (!joints_changed(s, i)) continue;
        s->skin_changed[i] = s->pose;
        for (uint32_t j = 0; j < skin->joint_count; j++) {
            const dp_affine *const world = &s->worlds[skin->joints[j] - 1];
            dp_affine bind = dp_affine_identity;
            if (skin->inverse_bind)
                memcpy(bind.row, skin->inverse_bind + 12 * (size_t)j, sizeof bind.row);
            s->joints[i][j] = dp_affine_compose(world, &bind);
        }
    }
}

/* ------- instances ------- */

static bool is_mirrored(const dp_scene *s, uint32_t i) {
    const dp_placed *const placed = &s->placed[i];
    const dp_scene_instance *const instance = &s->desc.instances[i];
    if (!placed->is_skinned)
        return instance->node && dp_affine_determinant(&s->worlds[instance->node - 1]) < 0;
    const dp_scene_skin *const skin = &s->desc.skins[instance->skin - 1];
    double sum = 0;
    for (uint32_t j = 0; j < skin->joint_count; j++) {
        const double determinant = dp_affine_determinant(&s->joints[instance->skin - 1][j]);
        sum += determinant < 0 ? -(double)placed->shares[j] : (double)placed->shares[j];
    }
    return sum < 0;
}

static bool has_moved(const dp_scene *s, uint32_t i) {
    const dp_placed *const placed = &s->placed[i];
    const dp_scene_instance *const instance = &s->desc.instances[i];
    const size_t size = placed->mesh->morph_count * sizeof *placed->weights;
    if (size && memcmp(placed->weights, placed->old_weights, size) != 0) return true;
    if (placed->is_skinned) return s->skin_changed[instance->skin - 1] == s->pose;
    return instance->node && s->changed[instance->node - 1] == s->pose;
}

static void mark(dp_scene *s) {
    for (uint32_t i = 0; i < s->desc.instance_count; i++) {
        dp_placed *const placed = &s->placed[i];
        s->dirty[i] = !placed->is_known || has_moved(s, i);
        if (!s->dirty[i]) continue;
        placed->is_known = true;
        memcpy(placed->old_weights, placed->weights,
               placed->mesh->morph_count * sizeof *placed->weights);
        if (is_mirrored(s, i) != placed->is_turned) dp_scene_turn(s, placed);
    }
}

void dp_scene_move(dp_scene *s) {
    s->pose++;
    sample(s);
    move_nodes(s);
    move_joints(s);
    mark(s);
}

/* ------- making room ------- */

/* Fills scene->order; true: node number *bad is its own ancestor. Each node is reached once: a walk
 * goes up until it meets one that is placed, and back down. */
static bool has_circle(dp_scene *s, uint32_t *bad) {
    enum { UNSEEN, ON_WALK, PLACED };
    uint8_t *const state = s->state;
    uint32_t count = 0;
    for (uint32_t i = 0; i < s->desc.node_count; i++) {
        uint32_t end = count, node = i + 1;
        for (; node && state[node - 1] == UNSEEN; node = s->desc.nodes[node - 1].parent) {
            state[node - 1] = ON_WALK;
            s->order[end++] = node - 1;
        }
        *bad = node;
        if (node && state[node - 1] == ON_WALK) return true;
        for (uint32_t a = count, b = end; a + 1 < b; a++, b--) {
            const uint32_t swap = s->order[a];
            s->order[a] = s->order[b - 1], s->order[b - 1] = swap;
        }
        for (; count < end; count++) state[s->order[count]] = PLACED;
    }
    return false;
}

static void find_rest(dp_scene *s) {
    for (uint32_t i = 0; i < s->desc.node_count; i++) {
        const dp_scene_node *const node = &s->desc.nodes[i];
        dp_trs *const trs = &s->rest[i];
        memcpy(trs->translation, node->translation, sizeof trs->translation);
        memcpy(trs->rotation, node->rotation, sizeof trs->rotation);
        memcpy(trs->scale, node->scale, sizeof trs->scale);
        dp_affine matrix;
        if (!node->matrix) continue;
        memcpy(matrix.row, node->matrix, sizeof matrix.row);
        *trs = dp_affine_split(&matrix);
    }
}

/* How much of the mesh each joint moves. */
static void find_shares(const dp_scene *s, dp_placed *placed) {
    const dp_scene_mesh *const mesh = placed->mesh;
    const uint32_t joints = dp_skin_of(s, placed)->joint_count;
    for (size_t i = 0; i < mesh->batch.vertex_count * mesh->influences; i++)
        if (mesh->joints[i] < joints) placed->shares[mesh->joints[i]] += mesh->weights[i];
}

static bool ready_instances(dp_scene *s) {
    for (uint32_t i = s->desc.instance_count; i > 0; i--) { /* chains then run from the first */
        const dp_scene_instance *const instance = &s->desc.instances[i - 1];
        dp_placed *const placed = &s->placed[i - 1];
        placed->weights = dp_arena_take(&s->arena, placed->mesh->morph_count, sizeof(double));
        placed->old_weights = dp_arena_take(&s->arena, placed->mesh->morph_count, sizeof(double));
        if (!placed->weights || !placed->old_weights) return false;
        if (instance->node) {
            s->next_instance[i - 1] = s->node_instances[instance->node - 1];
            s->node_instances[instance->node - 1] = i;
        }
        if (!placed->is_skinned) continue;
        placed->shares =
            dp_arena_take(&s->arena, dp_skin_of(s, placed)->joint_count, sizeof(float));
        if (!placed->shares) return false;
        find_shares(s, placed);
    }
    return true;
}

static bool ready_skins(dp_scene *s) {
    s->joints = dp_arena_take(&s->arena, s->desc.skin_count, sizeof *s->joints);
    s->skin_changed = dp_arena_take(&s->arena, s->desc.skin_count, sizeof *s->skin_changed);
    if (!s->joints || !s->skin_changed) return false;
    for (uint32_t i = 0; i < s->desc.skin_count; i++) {
        s->joints[i] = dp_arena_take(&s->arena, s->desc.skins[i].joint_count, sizeof *s->joints[i]);
        if (!s->joints[i]) return false;
    }
    return true;
}

static uint32_t widest(const dp_scene *s) {
    uint32_t most = 4;
    for (uint32_t i = 0; i < s->desc.clip_count; i++)
        for (uint32_t k = 0; k < s->clips[i].channel_count; k++) {
            const dp_scene_channel *const c = &s->clips[i].channels[k];
            if (c->key_count && c->width > most) most = c->width;
        }
    return most;
}

bool dp_scene_ready(dp_scene *s, uint32_t *circle) {
    dp_arena *const arena = &s->arena;
    const uint32_t nodes = s->desc.node_count, instances = s->desc.instance_count;
    *circle = 0;
    s->order = dp_arena_take(arena, nodes, sizeof *s->order);
    s->state = dp_arena_take(arena, nodes, sizeof *s->state);
    s->rest = dp_arena_take(arena, nodes, sizeof *s->rest);
    s->trs = dp_arena_take(arena, nodes, sizeof *s->trs);
    s->moves = dp_arena_take(arena, nodes, sizeof *s->moves);
    s->worlds = dp_arena_take(arena, nodes, sizeof *s->worlds);
    s->changed = dp_arena_take(arena, nodes, sizeof *s->changed);
    s->node_instances = dp_arena_take(arena, nodes, sizeof *s->node_instances);
    s->next_instance = dp_arena_take(arena, instances, sizeof *s->next_instance);
    s->dirty = dp_arena_take(arena, instances, sizeof *s->dirty);
    s->sampled = dp_arena_take(arena, widest(s), sizeof *s->sampled);
    if (!s->order || !s->state || !s->rest || !s->trs || !s->moves || !s->worlds || !s->changed ||
        !s->node_instances || !s->next_instance || !s->dirty || !s->sampled)
        return false;
    if (has_circle(s, circle)) return true;
    *circle = 0;
    find_rest(s);
    return ready_skins(s) && ready_instances(s);
}
