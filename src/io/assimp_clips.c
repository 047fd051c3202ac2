/* Animations of Assimp's as clips: ticks become seconds, and each channel of a node up to three, for
 * its position, rotation and scale, which replace the node's own.
 *
 * A channel that goes on after its last key (LightWave's) gets the keys that it takes to the
 * animation's end, as clips hold their last value: those of a repeated channel once more and again, or
 * one more on the line through the last two.
 *
 * Not handled: channels that go on before their first key; keys that are not joined by lines or arcs
 * (Assimp's readers cut such curves into short lines). */
#include "io/assimp_look.h"
#include "io/assimp_scene.h"

#include <math.h>
#include <string.h>

enum { REPEATED_MOST = 1 << 16 /* keys that repeating may add to a channel */ };

static const double usual_ticks =
    25; /* a second, where the file does not say: as Assimp's viewers */

/* ------- keys ------- */

/* A channel being filled: keys of `width` floats each. */
typedef struct keys {
    double *times;
    float *values;
    uint32_t count, width;
} keys;

static bool begin_keys(dp_assimp_tables *t, keys *k, uint32_t most, uint32_t width) {
    *k = (keys){dp_arena_take(&t->arena, most, sizeof *k->times),
                dp_arena_take(&t->arena, dp_times(most, width), sizeof *k->values), 0, width};
    return k->times && k->values;
}

static void add_key(keys *k, double time, const float *value) {
    memcpy(k->values + (size_t)k->count * k->width, value, k->width * sizeof *value);
    k->times[k->count++] = time;
}

/* How many keys the channel gets after its last one, up to `end`. */
static uint32_t keys_after(enum aiAnimBehaviour after, uint32_t count, double first, double last,
                           double end) {
    if (count < 2 || !(last > first) || !(end > last)) return 0;
    if (after == aiAnimBehaviour_LINEAR) return 1;
    if (after != aiAnimBehaviour_REPEAT) return 0;
    const double added = ceil((end - last) / (last - first)) * count;
    return added <= REPEATED_MOST ? (uint32_t)added : 0;
}

/* A repetition begins where the one before ends: its first key comes just after. */
static void add_repeated(keys *k, uint32_t count, uint32_t added) {
    const double period = k->times[count - 1] - k->times[0];
    for (uint32_t i = 0; i < added; i++) {
        const uint32_t from = i % count;
        const double round = 1 + (double)(i / count);
        const double time = k->times[from] + round * period;
        add_key(k, from ? time : time + 1e-9 * period, k->values + (size_t)from * k->width);
    }
}

/* Straight on from the last two keys; rotations stay as they are. */
static void add_linear(keys *k, double end) {
    const uint32_t last = k->count - 1;
    const double *const time = &k->times[last];
    const float *const b = k->values + (size_t)last * k->width, *const a = b - k->width;
    const double share = (end - time[0]) / (time[0] - time[-1]);
    float value[4];
    for (uint32_t i = 0; i < k->width; i++)
        value[i] = (float)(b[i] + (k->width == 3 ? share * ((double)b[i] - a[i]) : 0));
    add_key(k, end, value);
}

static void end_keys(keys *k, enum aiAnimBehaviour after, uint32_t added, double end) {
    if (added && after == aiAnimBehaviour_LINEAR) add_linear(k, end);
    if (added && after == aiAnimBehaviour_REPEAT) add_repeated(k, k->count, added);
}

/* ------- channels ------- */

/* The clip that is filled. */
typedef struct filling {
    dp_assimp_tables *tables;
    dp_scene_channel *channels;
    uint32_t count;
    double ticks; /* a second */
    double end;   /* ticks */
} filling;

static void add_channel(filling *f, uint32_t node, dp_scene_path path, const keys *k) {
    for (uint32_t i = 0; i < k->count; i++) k->times[i] /= f->ticks;
    f->channels[f->count++] = (dp_scene_channel){.node = node,
                                                 .path = path,
                                                 .times = k->times,
                                                 .values = k->values,
                                                 .key_count = k->count,
                                                 .width = k->width};
}

static bool add_vectors(filling *f, uint32_t node, dp_scene_path path,
                        const struct aiVectorKey *from, uint32_t count,
                        enum aiAnimBehaviour after) {
    keys k;
    if (!count || !from) return true;
    const uint32_t added = keys_after(after, count, from[0].mTime, from[count - 1].mTime, f->end);
    if (!begin_keys(f->tables, &k, count + added, 3)) return false;
    for (uint32_t i = 0; i < count; i++) {
        const struct aiVector3D v = from[i].mValue;
        add_key(&k, from[i].mTime, (float[3]){(float)v.x, (float)v.y, (float)v.z});
    }
    end_keys(&k, after, added, f->end);
    add_channel(f, node, path, &k);
    return true;
}

static bool add_rotations(filling *f, uint32_t node, const struct aiNodeAnim *from) {
    const uint32_t count = from->mNumRotationKeys;
    const struct aiQuatKey *const key = from->mRotationKeys;
    keys k;
    if (!count || !key) return true;
    const uint32_t added =
        keys_after(from->mPostState, count, key[0].mTime, key[count - 1].mTime, f->end);
    if (!begin_keys(f->tables, &k, count + added, 4)) return false;
    for (uint32_t i = 0; i < count; i++) {
        const struct aiQuaternion q = key[i].mValue;
        add_key(&k, key[i].mTime, (float[4]){(float)q.x, (float)q.y, (float)q.z, (float)q.w});
    }
    end_keys(&k, from->mPostState, added, f->end);
    add_channel(f, node, DP_SCENE_ROTATION, &k);
    return true;
}

static bool add_node_channels(filling *f, const struct aiNodeAnim *from) {
    const uint32_t node = from ? dp_assimp_find_node(f->tables, from->mNodeName.data) : 0;
    if (!node) {
        f->tables->flaws[DP_FLAW_CHANNELS]++;
        return true;
    }
    return add_vectors(f, node, DP_SCENE_TRANSLATION, from->mPositionKeys, from->mNumPositionKeys,
                       from->mPostState) &&
           add_rotations(f, node, from) &&
           add_vectors(f, node, DP_SCENE_SCALE, from->mScalingKeys, from->mNumScalingKeys,
                       from->mPostState);
}

/* ------- weights of morph targets ------- */

/* The number of targets of a node's meshes: the most that one of them has. */
static uint32_t targets_of(const dp_assimp_tables *t, uint32_t node) {
    const struct aiNode *const from = t->sources[node - 1];
    uint32_t most = 0;
    for (unsigned i = 0; i < from->mNumMeshes; i++) {
        const unsigned mesh = from->mMeshes[i];
        if (mesh < t->from->mNumMeshes && t->meshes[mesh].morph_count > most)
            most = t->meshes[mesh].morph_count;
    }
    return most;
}

/* Channels name the node; those from FBX with a number behind it ("head*0"); others the mesh. */
static uint32_t find_morphed(const dp_assimp_tables *t, const char *name) {
    char plain[sizeof(((struct aiString *)0)->data)] = "";
    const uint32_t exact = dp_assimp_find_node(t, name);
    const char *const star = strrchr(name, '*');
    if (exact) return exact;
    if (star) memcpy(plain, name, (size_t)(star - name));
    const uint32_t before = star ? dp_assimp_find_node(t, plain) : 0;
    if (before) return before;
    for (uint32_t i = 0; i < t->instance_count; i++) {
        const char *const mesh = t->meshes[t->instances[i].mesh - 1].name;
        if (mesh && !strcmp(mesh, name)) return t->instances[i].node;
    }
    return 0;
}

/* Targets that a key does not name have the weight 0. */
static void add_weights(keys *k, const struct aiMeshMorphKey *from, float *weights) {
    memset(weights, 0, k->width * sizeof *weights);
    for (unsigned i = 0; i < from->mNumValuesAndWeights; i++)
        if (from->mValues[i] < k->width) weights[from->mValues[i]] = (float)from->mWeights[i];
    add_key(k, from->mTime, weights);
}

static bool add_morph_channel(filling *f, const struct aiMeshMorphAnim *from) {
    dp_assimp_tables *const t = f->tables;
    const uint32_t node = from ? find_morphed(t, from->mName.data) : 0;
    const uint32_t width = node ? targets_of(t, node) : 0;
    keys k;
    if (!width) t->flaws[DP_FLAW_CHANNELS]++;
    if (!width || !from->mNumKeys) return true;
    float *const weights = dp_arena_take(&t->arena, width, sizeof *weights);
    if (!weights || !begin_keys(t, &k, from->mNumKeys, width)) return false;
    for (unsigned i = 0; i < from->mNumKeys; i++) add_weights(&k, &from->mKeys[i], weights);
    add_channel(f, node, DP_SCENE_WEIGHTS, &k);
    return true;
}

/* ------- clips ------- */

/* Assimp's reader of Half-Life's models (5.2) says frames * frames a second for a duration: the last key
 * tells. */
static bool counts_frames_twice(const struct aiScene *scene) {
    return dp_assimp_is_from(scene, "Quake Mesh / 3D GameStudio Mesh Importer");
}

static bool fill_clip(dp_assimp_tables *t, const struct aiAnimation *from, dp_scene_clip *to) {
    filling f = {.tables = t, .ticks = from->mTicksPerSecond, .end = from->mDuration};
    const size_t most = 3 * (size_t)from->mNumChannels + from->mNumMorphMeshChannels;
    if (!(f.ticks > 0) || !isfinite(f.ticks)) f.ticks = usual_ticks;
    f.channels = dp_arena_take(&t->arena, most, sizeof *f.channels);
    if (!f.channels) return false;
    for (unsigned i = 0; i < from->mNumChannels; i++)
        if (!add_node_channels(&f, from->mChannels[i])) return false;
    for (unsigned i = 0; i < from->mNumMorphMeshChannels; i++)
        if (!add_morph_channel(&f, from->mMorphMeshChannels[i])) return false;
    t->flaws[DP_FLAW_MESH_CHANNELS] += from->mNumMeshChannels;
    const double duration = counts_frames_twice(t->from) ? 0 : from->mDuration / f.ticks;
    *to = (dp_scene_clip){.name = *from->mName.data ? from->mName.data : NULL,
                          .channels = f.channels,
                          .channel_count = f.count,
                          .duration = duration > 0 && isfinite(duration) ? duration : 0};
    return true;
}

bool dp_assimp_fill_clips(dp_assimp_tables *t) {
    t->clips = dp_arena_take(&t->arena, t->from->mNumAnimations, sizeof *t->clips);
    if (!t->clips) return false;
    for (unsigned i = 0; i < t->from->mNumAnimations; i++)
        if (t->from->mAnimations[i] && !fill_clip(t, t->from->mAnimations[i], &t->clips[i]))
            return false;
    return true;
}
