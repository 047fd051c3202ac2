/* Animations of glTF (3.11): clips of a scene.
 *
 * A sampler with fewer values than times has as many keys as there are values for; channels
 * without a node, and those that move what extensions add, are left out. */
#include "io/gltf.h"

#include <string.h>

/* What a sampler's two accessors hold. */
typedef struct sampler {
    const double *times;
    const float *values;
    uint32_t key_count;
    dp_interpolation interpolation;
} sampler;

static bool find_path(dp_gltf *g, const dp_json *target, dp_scene_path *path, bool *known) {
    static const char *const names[] = {"translation", "rotation", "scale", "weights"};
    const dp_json *text;
    *known = false;
    if (!dp_gltf_member(g, target, "path", DP_JSON_STRING, &text)) return false;
    for (int k = 0; k < 4; k++)
        if (dp_json_is(text, names[k])) *path = (dp_scene_path)k, *known = true;
    return true;
}

static bool find_interpolation(dp_gltf *g, const dp_json *json, dp_interpolation *to) {
    static const char *const names[] = {"LINEAR", "STEP", "CUBICSPLINE"};
    const dp_json *text;
    *to = DP_INTERPOLATION_LINEAR;
    if (!dp_gltf_member(g, json, "interpolation", DP_JSON_STRING, &text)) return false;
    if (!text) return true;
    for (int k = 0; k < 3; k++)
        if (dp_json_is(text, names[k])) return *to = (dp_interpolation)k, true;
    return dp_gltf_fail(g, DP_ERR_FORMAT, "\"interpolation\" must be LINEAR, STEP or CUBICSPLINE");
}

/* How many numbers a key has: `width`, of splines three times as many. */
static bool read_sampler(dp_gltf *g, const dp_json *json, dp_scene_path path, uint32_t width,
                         sampler *s) {
    dp_gltf_accessor input, output;
    uint32_t times, values;
    if (!dp_gltf_index(g, json, "input", g->accessors, "accessor", &times) ||
        !dp_gltf_index(g, json, "output", g->accessors, "accessor", &values) ||
        !find_interpolation(g, json, &s->interpolation))
        return false;
    if (!times || !values)
        return dp_gltf_fail(g, DP_ERR_FORMAT, "a sampler needs \"input\" and \"output\"");
    if (!dp_gltf_accessor_open(g, times - 1, &input) ||
        !dp_gltf_accessor_open(g, values - 1, &output))
        return false;
    const uint32_t components = path == DP_SCENE_WEIGHTS ? 1 : width;
    if (input.components != 1 || output.components != components)
        return dp_gltf_fail(g, DP_ERR_FORMAT, "accessors %u and %u must hold 1 and %u numbers each",
                            times - 1, values - 1, components);
    const uint64_t elements =
        (uint64_t)width / components * (s->interpolation == DP_INTERPOLATION_CUBIC ? 3 : 1);
    const uint64_t most = elements ? output.count / elements : 0;
    s->key_count = most < input.count ? (uint32_t)most : input.count;
    if (most < input.count)
        dp_gltf_remark(g, "%saccessor %u has values for %u of %u keys", g->where, values - 1,
                       s->key_count, input.count);
    const float *const from = dp_gltf_floats(g, &input, 0, s->key_count, 1);
    double *const to = dp_arena_take(&g->arena, s->key_count, sizeof *to);
    if (!from) return false;
    if (!to) return dp_gltf_out_of_memory(g);
    for (uint32_t i = 0; i < s->key_count; i++) to[i] = from[i];
    s->times = to;
    s->values = dp_gltf_floats(g, &output, 0, (uint32_t)(s->key_count * elements), components);
    return s->values;
}

/* Morph targets of a node's mesh. */
static uint32_t morphs_of(const dp_gltf *g, uint32_t node) {
    const dp_json *const mesh = dp_json_find(dp_json_item(g->nodes, node), "mesh");
    const double number = mesh && mesh->kind == DP_JSON_NUMBER ? mesh->as.number : -1;
    if (!(number >= 0 && number < dp_json_count(g->meshes))) return 0;
    return g->mesh[(uint32_t)number].morph_count;
}

/* Adds a channel to the clip, if it moves something. */
static bool read_channel(dp_gltf *g, const dp_json *json, const dp_json *samplers,
                         dp_scene_clip *clip, dp_scene_channel *channels) {
    const dp_json *target;
    uint32_t number, node;
    dp_scene_path path = DP_SCENE_TRANSLATION;
    bool known;
    sampler s = {0};
    if (!dp_gltf_member(g, json, "target", DP_JSON_OBJECT, &target) ||
        !dp_gltf_index(g, json, "sampler", samplers, "sampler", &number) ||
        !dp_gltf_index(g, target, "node", g->nodes, "node", &node) ||
        !find_path(g, target, &path, &known))
        return false;
    if (!known) dp_gltf_remark(g, "%sa channel moves what is not drawn", g->where);
    if (!node || !known) return true;
    if (!number) return dp_gltf_fail(g, DP_ERR_FORMAT, "a channel names no sampler");
    const uint32_t width = path == DP_SCENE_WEIGHTS    ? morphs_of(g, node - 1)
                           : path == DP_SCENE_ROTATION ? 4
                                                       : 3;
    if (!width) return true;
    if (!read_sampler(g, dp_json_item(samplers, number - 1), path, width, &s)) return false;
    channels[clip->channel_count++] = (dp_scene_channel){.node = node,
                                                         .path = path,
                                                         .interpolation = s.interpolation,
                                                         .times = s.times,
                                                         .values = s.values,
                                                         .key_count = s.key_count,
                                                         .width = width};
    return true;
}

static bool read_clip(dp_gltf *g, uint32_t number, dp_scene_clip *clip) {
    const dp_json *const json = dp_json_item(g->animations, number), *list, *samplers;
    dp_gltf_at(g, "animation %u: ", number);
    clip->name = dp_gltf_name(g, json, "animations", number);
    if (!clip->name || !dp_gltf_member(g, json, "channels", DP_JSON_ARRAY, &list) ||
        !dp_gltf_member(g, json, "samplers", DP_JSON_ARRAY, &samplers))
        return false;
    const uint32_t count = dp_json_count(list);
    dp_scene_channel *const channels = dp_arena_take(&g->arena, count, sizeof *channels);
    if (!channels) return dp_gltf_out_of_memory(g);
    for (uint32_t i = 0; i < count; i++)
        if (!read_channel(g, dp_json_item(list, i), samplers, clip, channels)) return false;
    clip->channels = channels;
    return true;
}

bool dp_gltf_read_clips(dp_gltf *g) {
    const uint32_t count = dp_json_count(g->animations);
    g->clips = dp_arena_take(&g->arena, count, sizeof *g->clips);
    if (!g->clips) return dp_gltf_out_of_memory(g);
    for (uint32_t i = 0; i < count; i++)
        if (!read_clip(g, i, &g->clips[i])) return false;
    *g->where = 0;
    return true;
}
