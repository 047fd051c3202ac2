/* Copies the tables of a scene, with defaults filled in.
 *
 * Meshes become tight and uniform: every corner is used and has an index; attributes without
 * indices have a value for each vertex; weights are not negative and finite. Keys of channels
 * ascend and are finite. */
#include "scene/scene.h"

#include <math.h>
#include <string.h>

static double *copy_doubles(dp_arena *arena, const double *from, size_t count, bool *enough) {
    double *const to = from ? dp_arena_copy(arena, from, count, sizeof *to) : NULL;
    *enough &= !from || to;
    return to;
}

/* ------- nodes ------- */

static bool is_zero(const double *values, int count) {
    for (int k = 0; k < count; k++)
        if (values[k] != 0) return false;
    return true;
}

static bool copy_nodes(dp_scene *s, const dp_scene_desc *d) {
    dp_scene_node *const nodes = dp_arena_copy(&s->arena, d->nodes, d->node_count, sizeof *nodes);
    bool enough = nodes;
    for (uint32_t i = 0; enough && i < d->node_count; i++) {
        dp_scene_node *const n = &nodes[i];
        n->name = dp_arena_text(&s->arena, n->name, &enough);
        n->matrix = copy_doubles(&s->arena, n->matrix, 12, &enough);
        if (is_zero(n->rotation, 4)) n->rotation[3] = 1;
        if (is_zero(n->scale, 3)) n->scale[0] = n->scale[1] = n->scale[2] = 1;
    }
    s->desc.nodes = nodes;
    return enough;
}

/* ------- meshes ------- */

/* Rows of `width` floats that lie `stride` bytes apart, made tight; rows from `have` on are 0. */
static float *copy_rows(dp_arena *arena, const float *from, size_t stride, size_t have,
                        size_t count, size_t width, bool *enough) {
    float *const to = dp_arena_take(arena, dp_times(count, width), sizeof *to);
    *enough &= to != NULL;
    if (!stride) stride = width * sizeof *to;
    for (size_t i = 0; to && i < have && i < count; i++)
        memcpy(to + width * i, (const char *)from + stride * i, width * sizeof *to);
    return to;
}

static dp_attribute copy_attribute(dp_arena *arena, const dp_attribute *from, size_t width,
                                   const dp_batch *to, size_t first, bool *enough) {
    dp_attribute a = {0};
    if (!from->values || !from->count) return a;
    a.count = from->indices ? from->count : to->vertex_count;
    a.values = copy_rows(arena, from->values, from->stride, from->count, a.count, width, enough);
    if (from->indices)
        a.indices =
            dp_arena_copy(arena, from->indices + first, to->corner_count, sizeof *a.indices);
    *enough &= !from->indices || a.indices;
    return a;
}

/* Corners from the first to the last that polygons use, with indices. */
static bool copy_corners(dp_arena *arena, const dp_batch *from, size_t first, dp_batch *to) {
    const size_t count = to->corner_count;
    uint32_t *const indices = dp_arena_take(arena, count, sizeof *indices);
    uint32_t *firsts = NULL;
    for (size_t c = 0; indices && c < count; c++)
        indices[c] = from->indices ? from->indices[first + c] : (uint32_t)(first + c);
    to->indices = indices;
    if (from->firsts) {
        firsts = dp_arena_take(arena, to->polygon_count + 1, sizeof *firsts);
        for (size_t i = 0; firsts && i <= to->polygon_count; i++)
            firsts[i] = from->firsts[i] - (uint32_t)first;
    }
    to->firsts = firsts;
    if (from->edge_flags) to->edge_flags = dp_arena_copy(arena, from->edge_flags + first, count, 1);
    return indices && (!from->firsts || firsts) && (!from->edge_flags || to->edge_flags);
}

static bool copy_batch(dp_arena *arena, const dp_batch *from, dp_batch *to) {
    const size_t polygons = from->polygon_count;
    const size_t first = from->firsts && polygons ? from->firsts[0] : 0;
    *to = (dp_batch){.vertex_count = from->vertex_count,
                     .position_stride = 3 * sizeof(float),
                     .polygon_count = polygons,
                     .corner_count =
                         from->firsts && polygons ? from->firsts[polygons] - first : 3 * polygons,
                     .stable = true,
                     .spacing = from->spacing};
    memcpy(to->origin, from->origin, sizeof to->origin);
    bool enough = copy_corners(arena, from, first, to);
    to->positions = copy_rows(arena, from->positions, from->position_stride, from->vertex_count,
                              from->vertex_count, 3, &enough);
    to->normals = copy_attribute(arena, &from->normals, 3, to, first, &enough);
    to->texcoords = copy_attribute(arena, &from->texcoords, 2, to, first, &enough);
    if (from->colors)
        to->colors = dp_arena_copy(arena, from->colors, from->vertex_count, sizeof *to->colors);
    return enough && (!from->colors || to->colors);
}

static bool copy_morphs(dp_arena *arena, const dp_scene_mesh *from, dp_scene_mesh *to) {
    dp_scene_morph *const morphs = dp_arena_take(arena, from->morph_count, sizeof *morphs);
    bool enough = morphs;
    for (uint32_t i = 0; enough && i < from->morph_count; i++) {
        const dp_scene_morph *const m = &from->morphs[i];
        if (m->positions)
            morphs[i].positions = copy_rows(arena, m->positions, 0, to->batch.vertex_count,
                                            to->batch.vertex_count, 3, &enough);
        if (m->normals && to->batch.normals.values)
            morphs[i].normals = copy_rows(arena, m->normals, 0, from->batch.normals.count,
                                          to->batch.normals.count, 3, &enough);
    }
    to->morphs = morphs;
    return enough;
}

static bool copy_influences(dp_arena *arena, const dp_scene_mesh *from, dp_scene_mesh *to) {
    const size_t count = dp_times(to->batch.vertex_count, from->influences);
    float *const weights = dp_arena_copy(arena, from->weights, count, sizeof *weights);
    to->joints = dp_arena_copy(arena, from->joints, count, sizeof *to->joints);
    to->weights = weights;
    if (!weights || !to->joints) return false;
    for (size_t i = 0; i < count; i++)
        if (!(weights[i] > 0) || !isfinite(weights[i])) weights[i] = 0;
    return true;
}

static bool copy_meshes(dp_scene *s, const dp_scene_desc *d) {
    dp_scene_mesh *const meshes = dp_arena_take(&s->arena, d->mesh_count, sizeof *meshes);
    bool enough = meshes;
    for (uint32_t i = 0; enough && i < d->mesh_count; i++) {
        const dp_scene_mesh *const from = &d->meshes[i];
        dp_scene_mesh *const to = &meshes[i];
        to->name = dp_arena_text(&s->arena, from->name, &enough);
        to->color = from->color;
        to->morph_count = from->morph_count;
        to->influences = from->influences;
        enough = enough && copy_batch(&s->arena, &from->batch, &to->batch) &&
                 copy_morphs(&s->arena, from, to) &&
                 (!from->influences || copy_influences(&s->arena, from, to));
    }
    s->desc.meshes = meshes;
    return enough;
}

/* ------- instances and skins ------- */

static bool copy_instances(dp_scene *s, const dp_scene_desc *d) {
    dp_scene_instance *const instances =
        dp_arena_copy(&s->arena, d->instances, d->instance_count, sizeof *instances);
    bool enough = instances;
    for (uint32_t i = 0; enough && i < d->instance_count; i++) {
        const dp_scene_instance *const from = &d->instances[i];
        const uint32_t count = d->meshes[from->mesh - 1].morph_count;
        float *const weights = dp_arena_take(&s->arena, count, sizeof *weights);
        enough = weights;
        for (uint32_t k = 0; weights && k < count && k < from->weight_count; k++)
            weights[k] = isfinite(from->weights[k]) ? from->weights[k] : 0;
        instances[i].weights = weights;
        instances[i].weight_count = count;
    }
    s->desc.instances = instances;
    return enough;
}

static bool copy_skins(dp_scene *s, const dp_scene_desc *d) {
    dp_scene_skin *const skins = dp_arena_copy(&s->arena, d->skins, d->skin_count, sizeof *skins);
    bool enough = skins;
    for (uint32_t i = 0; enough && i < d->skin_count; i++) {
        dp_scene_skin *const skin = &skins[i];
        skin->joints =
            dp_arena_copy(&s->arena, skin->joints, skin->joint_count, sizeof *skin->joints);
        skin->inverse_bind =
            copy_doubles(&s->arena, skin->inverse_bind, dp_times(12, skin->joint_count), &enough);
        enough &= skin->joints != NULL;
    }
    s->desc.skins = skins;
    return enough;
}

/* ------- clips ------- */

static bool is_finite(const float *values, size_t count) {
    for (size_t k = 0; k < count; k++)
        if (!isfinite(values[k])) return false;
    return true;
}

/* Copies the keys that are sound. */
static bool copy_keys(dp_arena *arena, const dp_scene_channel *from, dp_scene_channel *to) {
    const size_t size = dp_times(to->width, from->interpolation == DP_INTERPOLATION_CUBIC ? 3 : 1);
    double *const times = dp_arena_take(arena, from->key_count, sizeof *times);
    float *const values = dp_arena_take(arena, dp_times(from->key_count, size), sizeof *values);
    if (!times || !values) return false;
    uint32_t count = 0;
    for (uint32_t i = 0; i < from->key_count; i++) {
        const double time = from->times[i];
        const float *const value = from->values + i * size;
        if (!isfinite(time) || (count && !(time > times[count - 1])) || !is_finite(value, size))
            continue;
        times[count] = time;
        memcpy(values + count++ * size, value, size * sizeof *values);
    }
    to->times = times, to->values = values;
    to->key_count = to->width ? count : 0;
    return true;
}

static double length_of(const dp_scene_clip *clip) {
    double last = 0;
    for (uint32_t k = 0; k < clip->channel_count; k++) {
        const dp_scene_channel *const c = &clip->channels[k];
        if (c->key_count) last = dp_max(last, c->times[c->key_count - 1]);
    }
    return last;
}

static bool copy_clip(dp_arena *arena, const dp_scene_clip *from, dp_scene_clip *to) {
    dp_scene_channel *const channels =
        dp_arena_copy(arena, from->channels, from->channel_count, sizeof *channels);
    bool enough = channels;
    to->name = dp_arena_text(arena, from->name, &enough);
    for (uint32_t k = 0; enough && k < from->channel_count; k++) {
        dp_scene_channel *const c = &channels[k];
        if (c->path != DP_SCENE_WEIGHTS) c->width = c->path == DP_SCENE_ROTATION ? 4 : 3;
        enough = copy_keys(arena, &from->channels[k], c);
    }
    to->channels = channels;
    to->channel_count = from->channel_count;
    to->duration = from->duration;
    if (enough && (!(to->duration > 0) || !isfinite(to->duration))) to->duration = length_of(to);
    return enough;
}

static bool copy_clips(dp_scene *s, const dp_scene_desc *d) {
    s->clips = dp_arena_take(&s->arena, d->clip_count, sizeof *s->clips);
    s->desc.clips = s->clips;
    for (uint32_t i = 0; s->clips && i < d->clip_count; i++)
        if (!copy_clip(&s->arena, &d->clips[i], &s->clips[i])) return false;
    return s->clips;
}

bool dp_scene_copy(dp_scene *s, const dp_scene_desc *d) {
    bool enough = true;
    s->desc = *d;
    s->desc.remark = dp_arena_text(&s->arena, d->remark, &enough);
    s->desc.color_remark = dp_arena_text(&s->arena, d->color_remark, &enough);
    return enough && copy_nodes(s, d) && copy_meshes(s, d) && copy_instances(s, d) &&
           copy_skins(s, d) && copy_clips(s, d);
}
