/* Do the tables of a scene agree with each other? What the arrays hold (indices, weights, keys)
 * is looked at where it is used, and never trusted. */
#include "scene/scene.h"

#include "base/diag.h"
#include "mesh/batch.h"

static dp_result wrong(dp_diag *diag, const char *what, uint32_t number, const char *why) {
    return dp_fail(diag, DP_ERR_ARGUMENT, "a scene's %s %u %s", what, number + 1, why);
}

static dp_result check_mesh(const dp_scene_mesh *mesh, uint32_t i, dp_diag *diag) {
    dp_batch batch = mesh->batch;
    if (!batch.position_stride) batch.position_stride = 3 * sizeof(float);
    if (batch.vertex_count && !batch.positions) return wrong(diag, "mesh", i, "has no positions");
    if (mesh->morph_count && !mesh->morphs) return wrong(diag, "mesh", i, "has no morph targets");
    if (mesh->influences && batch.vertex_count && (!mesh->joints || !mesh->weights))
        return wrong(diag, "mesh", i, "has influences, but no joints or no weights");
    const dp_result result = dp_check_batch(&batch, diag);
    if (result && diag) {
        const dp_diag reason = *diag;
        dp_fail(diag, result, "a scene's mesh %u: %.180s", i + 1, reason.message);
    }
    return result;
}

static dp_result check_instance(const dp_scene_desc *d, uint32_t i, dp_diag *diag) {
    const dp_scene_instance *const instance = &d->instances[i];
    if (!instance->mesh || instance->mesh > d->mesh_count)
        return wrong(diag, "instance", i, "names a mesh that is not there");
    if (instance->node > d->node_count)
        return wrong(diag, "instance", i, "names a node that is not there");
    if (instance->skin > d->skin_count)
        return wrong(diag, "instance", i, "names a skin that is not there");
    if (instance->weight_count && !instance->weights)
        return wrong(diag, "instance", i, "has no weights");
    return DP_OK;
}

static dp_result check_skin(const dp_scene_desc *d, uint32_t i, dp_diag *diag) {
    const dp_scene_skin *const skin = &d->skins[i];
    if (skin->joint_count && !skin->joints) return wrong(diag, "skin", i, "has no joints");
    for (uint32_t k = 0; k < skin->joint_count; k++)
        if (!skin->joints[k] || skin->joints[k] > d->node_count)
            return wrong(diag, "skin", i, "names a node that is not there");
    return DP_OK;
}

static dp_result check_clip(const dp_scene_desc *d, uint32_t i, dp_diag *diag) {
    const dp_scene_clip *const clip = &d->clips[i];
    if (clip->channel_count && !clip->channels) return wrong(diag, "clip", i, "has no channels");
    for (uint32_t k = 0; k < clip->channel_count; k++) {
        const dp_scene_channel *const c = &clip->channels[k];
        if (!c->node || c->node > d->node_count)
            return wrong(diag, "clip", i, "moves a node that is not there");
        if ((unsigned)c->path > DP_SCENE_WEIGHTS ||
            (unsigned)c->interpolation > DP_INTERPOLATION_CUBIC)
            return wrong(diag, "clip", i, "has a path or an interpolation that is none");
        if (c->key_count && (!c->times || !c->values))
            return wrong(diag, "clip", i, "has keys without times or values");
    }
    return DP_OK;
}

/* 32 bits number what is in the batch. */
static dp_result check_size(const dp_scene_desc *d, dp_diag *diag) {
    uint64_t corners = 0, values = 0;
    for (uint32_t i = 0; i < d->instance_count; i++) {
        const dp_batch *const b = &d->meshes[d->instances[i].mesh - 1].batch;
        size_t most = b->vertex_count;
        if (b->normals.values && b->normals.count > most) most = b->normals.count;
        if (b->texcoords.values && b->texcoords.count > most) most = b->texcoords.count;
        if (most >= UINT32_MAX || (values += most) >= UINT32_MAX || b->corner_count >= UINT32_MAX ||
            (corners += b->corner_count) >= UINT32_MAX)
            return dp_fail(
                diag, DP_ERR_LIMIT,
                "a scene of more than 4294967294 vertices or corners: draw fewer instances");
    }
    return DP_OK;
}

static dp_result check_tables(const dp_scene_desc *d, dp_diag *diag) {
    if ((d->node_count && !d->nodes) || (d->mesh_count && !d->meshes) ||
        (d->instance_count && !d->instances) || (d->skin_count && !d->skins) ||
        (d->clip_count && !d->clips))
        return dp_fail(diag, DP_ERR_ARGUMENT, "a scene's table is NULL, but its count is not 0");
    return DP_OK;
}

dp_result dp_scene_check(const dp_scene_desc *d, dp_diag *diag) {
    dp_result result = check_tables(d, diag);
    if (result) return result;
    for (uint32_t i = 0; !result && i < d->node_count; i++)
        if (d->nodes[i].parent > d->node_count)
            result = wrong(diag, "node", i, "has a parent that is not there");
    for (uint32_t i = 0; !result && i < d->mesh_count; i++)
        result = check_mesh(&d->meshes[i], i, diag);
    for (uint32_t i = 0; !result && i < d->instance_count; i++) result = check_instance(d, i, diag);
    for (uint32_t i = 0; !result && i < d->skin_count; i++) result = check_skin(d, i, diag);
    for (uint32_t i = 0; !result && i < d->clip_count; i++) result = check_clip(d, i, diag);
    return result ? result : check_size(d, diag);
}
