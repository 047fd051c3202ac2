/* Sends a scene as its tables, which are plain structs because both ends are the same program; a
 * table's pointers tell which arrays of each entry follow it, and its counts how long they are.
 *
 *     desc, remarks
 *     nodes       each: name, matrix
 *     meshes      each: name, batch, morph targets, joints, weights
 *     instances   each: weights
 *     skins       each: joints, inverse bind matrices
 *     clips       each: name, channels; of each channel: times, values
 *
 * Invariant: nothing that is received is trusted, as the sender may have overwritten anything: arrays
 * are as long as the counts beside them say, or the scene is refused; what they hold is checked by
 * dp_source_from_scene. */
#include "transfer_scene.h"

#include "transfer_batch.h"

#include <stdint.h>
#include <string.h>

enum { NAME_MOST = 1 << 16 /* bytes */, MATRIX = 12 };

/* a * b, or SIZE_MAX, which no block can have. */
static size_t times(size_t a, size_t b) { return b && a > SIZE_MAX / b ? SIZE_MAX : a * b; }

/* Floats of a channel's values. */
static size_t channel_values(const dp_scene_channel *c) {
    const size_t width = c->path == DP_SCENE_WEIGHTS    ? c->width
                         : c->path == DP_SCENE_ROTATION ? 4
                                                        : 3;
    const size_t rows = c->interpolation == DP_INTERPOLATION_CUBIC ? 3 : 1;
    return times(times(width, rows), c->key_count);
}

/* ------- sending ------- */

/* An array, if there is one. */
static bool send_array(int to, const void *array, size_t count, size_t size) {
    return !array || pipe_send(to, array, count * size);
}

/* A text, if there is one: its length, then its letters. */
static bool send_text(int to, const char *text) {
    const size_t length = text ? strlen(text) : 0;
    const uint32_t sent = length < NAME_MOST ? (uint32_t)length : NAME_MOST;
    return !text || (pipe_send(to, &sent, sizeof sent) && pipe_send(to, text, sent));
}

static bool send_nodes(int to, const dp_scene_desc *d) {
    bool sent = send_array(to, d->nodes, d->node_count, sizeof *d->nodes);
    for (uint32_t i = 0; sent && i < d->node_count; i++)
        sent = send_text(to, d->nodes[i].name) &&
               send_array(to, d->nodes[i].matrix, MATRIX, sizeof(double));
    return sent;
}

static bool send_morphs(int to, const dp_scene_mesh *m) {
    bool sent = send_array(to, m->morphs, m->morph_count, sizeof *m->morphs);
    for (uint32_t k = 0; sent && m->morphs && k < m->morph_count; k++)
        sent = send_array(to, m->morphs[k].positions, m->batch.vertex_count, 3 * sizeof(float)) &&
               send_array(to, m->morphs[k].normals, m->batch.normals.count, 3 * sizeof(float));
    return sent;
}

static bool send_mesh(int to, const dp_scene_mesh *m) {
    const size_t influences = times(m->batch.vertex_count, m->influences);
    return send_text(to, m->name) && transfer_send_batch(to, &m->batch) && send_morphs(to, m) &&
           send_array(to, m->joints, influences, sizeof *m->joints) &&
           send_array(to, m->weights, influences, sizeof *m->weights);
}

static dp_scene_mesh settled(const dp_scene_mesh *mesh) {
    dp_scene_mesh m = *mesh;
    transfer_settle_batch(&m.batch);
    return m;
}

static bool send_meshes(int to, const dp_scene_desc *d) {
    bool sent = true;
    for (uint32_t i = 0; sent && i < d->mesh_count; i++) {
        const dp_scene_mesh m = settled(&d->meshes[i]);
        sent = pipe_send(to, &m, sizeof m);
    }
    for (uint32_t i = 0; sent && i < d->mesh_count; i++) {
        const dp_scene_mesh m = settled(&d->meshes[i]);
        sent = send_mesh(to, &m);
    }
    return sent;
}

static bool send_instances(int to, const dp_scene_desc *d) {
    bool sent = send_array(to, d->instances, d->instance_count, sizeof *d->instances);
    for (uint32_t i = 0; sent && i < d->instance_count; i++)
        sent = send_array(to, d->instances[i].weights, d->instances[i].weight_count, sizeof(float));
    return sent;
}

static bool send_skins(int to, const dp_scene_desc *d) {
    bool sent = send_array(to, d->skins, d->skin_count, sizeof *d->skins);
    for (uint32_t i = 0; sent && i < d->skin_count; i++) {
        const dp_scene_skin *const s = &d->skins[i];
        sent = send_array(to, s->joints, s->joint_count, sizeof *s->joints) &&
               send_array(to, s->inverse_bind, s->joint_count, MATRIX * sizeof(double));
    }
    return sent;
}

static bool send_clip(int to, const dp_scene_clip *clip) {
    bool sent = send_text(to, clip->name) &&
                send_array(to, clip->channels, clip->channel_count, sizeof *clip->channels);
    for (uint32_t k = 0; sent && clip->channels && k < clip->channel_count; k++) {
        const dp_scene_channel *const c = &clip->channels[k];
        sent = send_array(to, c->times, c->key_count, sizeof *c->times) &&
               send_array(to, c->values, channel_values(c), sizeof *c->values);
    }
    return sent;
}

bool transfer_send_scene(int to, const dp_scene_desc *d) {
    bool sent = pipe_send(to, d, sizeof *d) && send_text(to, d->remark) &&
                send_text(to, d->color_remark) && send_nodes(to, d) && send_meshes(to, d) &&
                send_instances(to, d) && send_skins(to, d) &&
                send_array(to, d->clips, d->clip_count, sizeof *d->clips);
    for (uint32_t i = 0; sent && i < d->clip_count; i++) sent = send_clip(to, &d->clips[i]);
    return sent;
}

/* ------- receiving ------- */

/* Receives an array in the place of the sender's pointer, whose address is given; NULL stays NULL. */
static bool receive_array(pipe_end *end, void *address, size_t count, size_t size) {
    void *block;
    memcpy(&block, address, sizeof block);
    if (!block) return true;
    block = pipe_receive_block(end, count, size);
    memcpy(address, &block, sizeof block);
    return block;
}

static bool receive_text(pipe_end *end, const char **text) {
    uint32_t length;
    return !*text || (pipe_receive(end, &length, sizeof length) && length <= NAME_MOST &&
                      receive_array(end, text, length, 1));
}

/* Receives a table, of which there must be one if it has entries. NULL: it does not come whole. */
static void *receive_table(pipe_end *end, const void *sent, uint32_t count, size_t size) {
    return sent || !count ? pipe_receive_block(end, sent ? count : 0, size) : NULL;
}

static bool receive_nodes(pipe_end *end, dp_scene_desc *d) {
    dp_scene_node *const nodes = receive_table(end, d->nodes, d->node_count, sizeof *nodes);
    bool whole = nodes;
    for (uint32_t i = 0; whole && i < d->node_count; i++)
        whole = receive_text(end, &nodes[i].name) &&
                receive_array(end, &nodes[i].matrix, MATRIX, sizeof(double));
    d->nodes = nodes;
    return whole;
}

static bool receive_morphs(pipe_end *end, dp_scene_mesh *m) {
    dp_scene_morph *const morphs = receive_table(end, m->morphs, m->morph_count, sizeof *morphs);
    bool whole = morphs;
    for (uint32_t k = 0; whole && k < m->morph_count; k++)
        whole =
            receive_array(end, &morphs[k].positions, m->batch.vertex_count, 3 * sizeof(float)) &&
            receive_array(end, &morphs[k].normals, m->batch.normals.count, 3 * sizeof(float));
    m->morphs = morphs;
    return whole;
}

static bool receive_mesh(pipe_end *end, dp_scene_mesh *m) {
    if (!receive_text(end, &m->name) || !transfer_receive_batch(end, &m->batch) ||
        !receive_morphs(end, m))
        return false;
    const size_t influences = times(m->batch.vertex_count, m->influences);
    return receive_array(end, &m->joints, influences, sizeof *m->joints) &&
           receive_array(end, &m->weights, influences, sizeof *m->weights);
}

static bool receive_meshes(pipe_end *end, dp_scene_desc *d) {
    dp_scene_mesh *const meshes = receive_table(end, d->meshes, d->mesh_count, sizeof *meshes);
    bool whole = meshes;
    for (uint32_t i = 0; whole && i < d->mesh_count; i++) whole = receive_mesh(end, &meshes[i]);
    d->meshes = meshes;
    return whole;
}

static bool receive_instances(pipe_end *end, dp_scene_desc *d) {
    dp_scene_instance *const instances =
        receive_table(end, d->instances, d->instance_count, sizeof *instances);
    bool whole = instances;
    for (uint32_t i = 0; whole && i < d->instance_count; i++)
        whole = receive_array(end, &instances[i].weights, instances[i].weight_count, sizeof(float));
    d->instances = instances;
    return whole;
}

static bool receive_skins(pipe_end *end, dp_scene_desc *d) {
    dp_scene_skin *const skins = receive_table(end, d->skins, d->skin_count, sizeof *skins);
    bool whole = skins;
    for (uint32_t i = 0; whole && i < d->skin_count; i++)
        whole = receive_array(end, &skins[i].joints, skins[i].joint_count, sizeof(uint32_t)) &&
                receive_array(end, &skins[i].inverse_bind, skins[i].joint_count,
                              MATRIX * sizeof(double));
    d->skins = skins;
    return whole;
}

static bool receive_clip(pipe_end *end, dp_scene_clip *clip) {
    if (!receive_text(end, &clip->name)) return false;
    dp_scene_channel *const channels =
        receive_table(end, clip->channels, clip->channel_count, sizeof *channels);
    bool whole = channels;
    for (uint32_t k = 0; whole && k < clip->channel_count; k++)
        whole =
            receive_array(end, &channels[k].times, channels[k].key_count, sizeof(double)) &&
            receive_array(end, &channels[k].values, channel_values(&channels[k]), sizeof(float));
    clip->channels = channels;
    return whole;
}

static bool receive_clips(pipe_end *end, dp_scene_desc *d) {
    dp_scene_clip *const clips = receive_table(end, d->clips, d->clip_count, sizeof *clips);
    bool whole = clips;
    for (uint32_t i = 0; whole && i < d->clip_count; i++) whole = receive_clip(end, &clips[i]);
    d->clips = clips;
    return whole;
}

bool transfer_receive_scene(pipe_end *end, dp_source **out, dp_diag *diag) {
    dp_scene_desc d;
    if (!pipe_receive(end, &d, sizeof d) || !receive_text(end, &d.remark) ||
        !receive_text(end, &d.color_remark) || !receive_nodes(end, &d) ||
        !receive_meshes(end, &d) || !receive_instances(end, &d) || !receive_skins(end, &d) ||
        !receive_clips(end, &d))
        return false;
    diag->result = dp_source_from_scene(&d, NULL, out, diag);
    return true;
}
