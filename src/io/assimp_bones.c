/* Bones of Assimp's meshes, which list their vertices, as joints and weights of vertices.
 *
 *     for each bone with a node and a matrix    it becomes the next joint
 *         for each vertex it moves              the vertex's next influence
 *     vertices without any                      follow the joint after the last: the mesh's node
 *
 * A vertex keeps at most MOST influences, the strongest. */
#include "io/assimp_scene.h"

#include <math.h>

enum { MOST = 64, JOINTS_MOST = 65534 };

static bool is_finite_matrix(const struct aiMatrix4x4 *m) {
    const double sum = (double)m->a1 + m->a2 + m->a3 + m->a4 + m->b1 + m->b2 + m->b3 + m->b4 +
                       m->c1 + m->c2 + m->c3 + m->c4;
    return isfinite(sum);
}

/* Does the bone move that vertex? */
static bool moves(const struct aiMesh *mesh, const struct aiVertexWeight *w) {
    return w->mVertexId < mesh->mNumVertices && w->mWeight > 0 && isfinite(w->mWeight);
}

/* The node of each bone that becomes a joint, 1 + number; 0 for the others, which are counted. */
static uint32_t *find_joints(dp_assimp_tables *t, const struct aiMesh *mesh, uint32_t *count) {
    uint32_t *const nodes = dp_arena_take(&t->arena, mesh->mNumBones, sizeof *nodes);
    *count = 0;
    for (unsigned b = 0; nodes && b < mesh->mNumBones; b++) {
        const struct aiBone *const bone = mesh->mBones[b];
        const bool sound = bone && is_finite_matrix(&bone->mOffsetMatrix) && *count < JOINTS_MOST;
        nodes[b] = sound ? dp_assimp_find_node(t, bone->mName.data) : 0;
        if (nodes[b])
            ++*count;
        else
            t->flaws[DP_FLAW_BONES]++;
    }
    return nodes;
}

/* The most influences of any vertex, at most MOST; counts[v] is how many there are. */
static uint32_t count_influences(const struct aiMesh *mesh, const uint32_t *nodes,
                                 uint32_t *counts) {
    uint32_t most = 1;
    for (unsigned b = 0; b < mesh->mNumBones; b++)
        for (unsigned i = 0; nodes[b] && i < mesh->mBones[b]->mNumWeights; i++) {
            const struct aiVertexWeight *const w = &mesh->mBones[b]->mWeights[i];
            if (!moves(mesh, w)) continue;
            const uint32_t count = ++counts[w->mVertexId];
            if (count > most) most = count;
        }
    return most < MOST ? most : MOST;
}

/* What a vertex has so far. */
typedef struct influences {
    uint16_t *joints; /* [most] */
    float *weights;   /* [most]; 0: free */
    uint32_t most;
} influences;

/* Adds one; where there is no room, in place of the weakest. False: something is left out. */
static bool add_influence(const influences *of, uint16_t joint, float weight) {
    uint32_t weakest = 0;
    for (uint32_t k = 0; k < of->most && of->weights[weakest] > 0; k++)
        if (of->weights[k] < of->weights[weakest]) weakest = k;
    const bool free = !(of->weights[weakest] > 0);
    if (weight > of->weights[weakest]) of->joints[weakest] = joint, of->weights[weakest] = weight;
    return free;
}

static void fill_influences(dp_assimp_tables *t, const struct aiMesh *mesh, const uint32_t *nodes,
                            uint16_t *joints, float *weights, uint32_t most) {
    uint16_t joint = 0;
    for (unsigned b = 0; b < mesh->mNumBones; b++) {
        if (!nodes[b]) continue;
        for (unsigned i = 0; i < mesh->mBones[b]->mNumWeights; i++) {
            const struct aiVertexWeight *const w = &mesh->mBones[b]->mWeights[i];
            if (!moves(mesh, w)) continue;
            const size_t at = (size_t)w->mVertexId * most;
            const influences of = {joints + at, weights + at, most};
            if (!add_influence(&of, joint, (float)w->mWeight)) t->flaws[DP_FLAW_INFLUENCES]++;
        }
        joint++;
    }
}

/* Vertices that no bone moves. */
static bool fill_loose(const uint32_t *counts, unsigned vertices, uint32_t joint, uint16_t *joints,
                       float *weights, uint32_t most) {
    bool any = false;
    for (unsigned v = 0; v < vertices; v++) {
        if (counts[v]) continue;
        joints[(size_t)v * most] = (uint16_t)joint;
        weights[(size_t)v * most] = 1;
        any = true;
    }
    return any;
}

/* The joints and what takes the mesh to each. */
static bool fill_binds(dp_assimp_tables *t, const struct aiMesh *mesh, const uint32_t *nodes,
                       dp_assimp_mesh *part) {
    uint32_t *const joints = dp_arena_take(&t->arena, part->joint_count, sizeof *joints);
    double(*const binds)[12] = dp_arena_take(&t->arena, part->joint_count, sizeof *binds);
    uint32_t joint = 0;
    if (!joints || !binds) return false;
    for (unsigned b = 0; b < mesh->mNumBones; b++) {
        if (!nodes[b]) continue;
        const struct aiMatrix4x4 *const m = &mesh->mBones[b]->mOffsetMatrix;
        const double rows[12] = {m->a1, m->a2, m->a3, m->a4, m->b1, m->b2,
                                 m->b3, m->b4, m->c1, m->c2, m->c3, m->c4};
        for (int k = 0; k < 12; k++) binds[joint][k] = rows[k];
        joints[joint++] = nodes[b];
    }
    part->joints = joints;
    part->inverse_bind = binds[0];
    return true;
}

bool dp_assimp_fill_bones(dp_assimp_tables *t, const struct aiMesh *from, dp_scene_mesh *to,
                          dp_assimp_mesh *part) {
    const unsigned vertices = from->mNumVertices;
    const uint32_t *const nodes = find_joints(t, from, &part->joint_count);
    uint32_t *const counts = dp_arena_take(&t->arena, vertices, sizeof *counts);
    if (!nodes || !counts) return false;
    if (!part->joint_count) return true;
    const uint32_t most = count_influences(from, nodes, counts);
    uint16_t *const joints = dp_arena_take(&t->arena, dp_times(vertices, most), sizeof *joints);
    float *const weights = dp_arena_take(&t->arena, dp_times(vertices, most), sizeof *weights);
    if (!joints || !weights || !fill_binds(t, from, nodes, part)) return false;
    fill_influences(t, from, nodes, joints, weights, most);
    part->has_loose = fill_loose(counts, vertices, part->joint_count, joints, weights, most);
    to->joints = joints;
    to->weights = weights;
    to->influences = most;
    return true;
}
