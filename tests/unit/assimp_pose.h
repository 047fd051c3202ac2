/* An evaluator of animations apart from the library's: Assimp's scene as its manual says, by plain sums in
 * double precision. A channel replaces its node's transform by position * rotation * scale; a node
 * stands at its ancestors' product; a vertex of a mesh with bones is the sum of weight * bone's node *
 * offset matrix, any other one stands at its mesh's node. */
#ifndef DP_TESTS_ASSIMP_POSE_H
#define DP_TESTS_ASSIMP_POSE_H

#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/scene.h>

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

typedef struct matrix {
    double m[4][4];
} matrix;

/* As the library imports: FBX with the nodes that its pivots become. NULL: it cannot be read. The
 * caller releases it with aiReleaseImport. */
static const struct aiScene *pose_import(const char *path) {
    struct aiPropertyStore *const properties = aiCreatePropertyStore();
    aiSetImportPropertyInteger(properties, AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, 1);
    const struct aiScene *const scene = aiImportFileExWithProperties(path, 0, NULL, properties);
    aiReleasePropertyStore(properties);
    return scene;
}

static double ticks_of(const struct aiAnimation *a) {
    return a->mTicksPerSecond > 0 ? a->mTicksPerSecond : 25;
}

/* ---- channels ---- */

static void mix(const struct aiVectorKey *keys, unsigned count, double t, double to[3]) {
    unsigned k = 0;
    while (k + 1 < count && keys[k + 1].mTime <= t) k++;
    const struct aiVector3D a = keys[k].mValue;
    to[0] = a.x, to[1] = a.y, to[2] = a.z;
    if (k + 1 == count || t <= keys[k].mTime) return;
    const struct aiVector3D b = keys[k + 1].mValue;
    const double share = (t - keys[k].mTime) / (keys[k + 1].mTime - keys[k].mTime);
    to[0] += share * ((double)b.x - a.x);
    to[1] += share * ((double)b.y - a.y);
    to[2] += share * ((double)b.z - a.z);
}

/* w, x, y, z on the arc between the keys. */
static void turn(const struct aiQuatKey *keys, unsigned count, double t, double to[4]) {
    unsigned k = 0;
    while (k + 1 < count && keys[k + 1].mTime <= t) k++;
    const struct aiQuaternion p = keys[k].mValue;
    const double a[4] = {p.w, p.x, p.y, p.z};
    memcpy(to, a, sizeof a);
    if (k + 1 == count || t <= keys[k].mTime) return;
    const struct aiQuaternion q = keys[k + 1].mValue;
    double b[4] = {q.w, q.x, q.y, q.z}, dot = 0;
    for (int i = 0; i < 4; i++) dot += a[i] * b[i];
    for (int i = 0; i < 4 && dot < 0; i++) b[i] = -b[i];
    const double angle = acos(fmin(fabs(dot), 1));
    const double share = (t - keys[k].mTime) / (keys[k + 1].mTime - keys[k].mTime);
    const bool near = angle < 1e-4;
    const double of_a = near ? 1 - share : sin((1 - share) * angle) / sin(angle);
    const double of_b = near ? share : sin(share * angle) / sin(angle);
    for (int i = 0; i < 4; i++) to[i] = of_a * a[i] + of_b * b[i];
}

static matrix matrix_of(const struct aiMatrix4x4 *m) {
    const matrix result = {{{m->a1, m->a2, m->a3, m->a4},
                            {m->b1, m->b2, m->b3, m->b4},
                            {m->c1, m->c2, m->c3, m->c4},
                            {0, 0, 0, 1}}};
    return result;
}

static matrix product(const matrix *a, const matrix *b) {
    matrix result = {{{0}}};
    for (int r = 0; r < 4; r++)
        for (int c = 0; c < 4; c++)
            for (int k = 0; k < 4; k++) result.m[r][c] += a->m[r][k] * b->m[k][c];
    return result;
}

/* All channels of these files have keys of each kind. */
static matrix channel_at(const struct aiNodeAnim *channel, double t) {
    double p[3], q[4], s[3];
    mix(channel->mPositionKeys, channel->mNumPositionKeys, t, p);
    turn(channel->mRotationKeys, channel->mNumRotationKeys, t, q);
    mix(channel->mScalingKeys, channel->mNumScalingKeys, t, s);
    double square = 0;
    for (int i = 0; i < 4; i++) square += q[i] * q[i];
    for (int i = 0; i < 4; i++) q[i] /= sqrt(square);
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    const double r[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                            {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                            {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}};
    matrix result = {{[3] = {0, 0, 0, 1}}};
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) result.m[i][k] = r[i][k] * s[k];
        result.m[i][3] = p[i];
    }
    return result;
}

/* ---- nodes ---- */

typedef struct pose {
    const struct aiScene *scene;
    const struct aiAnimation *animation; /* NULL: at rest */
    double t;                            /* ticks */
    double (*vertices)[3];
    size_t count;
} pose;

static matrix local(const pose *p, const struct aiNode *node) {
    const struct aiAnimation *const a = p->animation;
    for (unsigned k = a ? a->mNumChannels : 0; k-- > 0;)
        if (!strcmp(a->mChannels[k]->mNodeName.data, node->mName.data))
            return channel_at(a->mChannels[k], p->t);
    return matrix_of(&node->mTransformation);
}

static matrix global(const pose *p, const struct aiNode *node) {
    const matrix own = local(p, node);
    if (!node->mParent) return own;
    const matrix parent = global(p, node->mParent);
    return product(&parent, &own);
}

static const struct aiNode *find(const struct aiNode *node, const char *name) {
    const struct aiNode *found = strcmp(node->mName.data, name) ? NULL : node;
    for (unsigned k = 0; !found && k < node->mNumChildren; k++)
        found = find(node->mChildren[k], name);
    return found;
}

/* ---- vertices ---- */

static void add(const matrix *m, const struct aiVector3D v, double weight, double to[3]) {
    for (int r = 0; r < 3; r++)
        to[r] += weight * (m->m[r][0] * v.x + m->m[r][1] * v.y + m->m[r][2] * v.z + m->m[r][3]);
}

static void add_bones(const pose *p, const struct aiMesh *mesh, double (*to)[3], double *sums) {
    for (unsigned b = 0; b < mesh->mNumBones; b++) {
        const struct aiBone *const bone = mesh->mBones[b];
        const struct aiNode *const node = find(p->scene->mRootNode, bone->mName.data);
        if (!node) continue;
        const matrix at = global(p, node), offset = matrix_of(&bone->mOffsetMatrix);
        const matrix m = product(&at, &offset);
        for (unsigned k = 0; k < bone->mNumWeights; k++) {
            const struct aiVertexWeight w = bone->mWeights[k];
            add(&m, mesh->mVertices[w.mVertexId], w.mWeight, to[w.mVertexId]);
            sums[w.mVertexId] += w.mWeight;
        }
    }
}

static void add_mesh(pose *p, const struct aiNode *node, const struct aiMesh *mesh) {
    const matrix at = global(p, node);
    double(*const to)[3] = p->vertices + p->count;
    double *const sums = calloc(mesh->mNumVertices, sizeof *sums);
    memset(to, 0, mesh->mNumVertices * sizeof *to);
    add_bones(p, mesh, to, sums);
    for (unsigned v = 0; v < mesh->mNumVertices; v++)
        if (sums[v] > 0)
            for (int r = 0; r < 3; r++) to[v][r] /= sums[v];
        else
            add(&at, mesh->mVertices[v], 1, to[v]);
    p->count += mesh->mNumVertices;
    free(sums);
}

static bool has_polygons(const struct aiMesh *mesh) {
    return !mesh->mPrimitiveTypes ||
           (mesh->mPrimitiveTypes & (aiPrimitiveType_TRIANGLE | aiPrimitiveType_POLYGON));
}

static void add_node(pose *p, const struct aiNode *node) {
    for (unsigned k = 0; k < node->mNumMeshes; k++) {
        const struct aiMesh *const mesh = p->scene->mMeshes[node->mMeshes[k]];
        if (!has_polygons(mesh)) continue;
        p->vertices = realloc(p->vertices, (p->count + mesh->mNumVertices) * sizeof *p->vertices);
        add_mesh(p, node, mesh);
    }
    for (unsigned k = 0; k < node->mNumChildren; k++) add_node(p, node->mChildren[k]);
}

/* Vertices of all meshes with polygons, node by node, in world space at a time, s; clip -1: at rest.
 * The caller frees them. */
static double (*pose_vertices(const struct aiScene *scene, int clip, double time,
                              size_t *count))[3] {
    pose p = {.scene = scene};
    if (clip >= 0) p.animation = scene->mAnimations[clip];
    if (clip >= 0) p.t = time * ticks_of(p.animation);
    add_node(&p, scene->mRootNode);
    *count = p.count;
    return p.vertices;
}

#endif
