/* Scenes of Assimp's made by hand, with all that readers may hand out: what becomes of them, and that
 * none does harm. */
#include "reading.h"

#include "io/assimp_scene.h"

#include <math.h>

/* A triangle at the node "mesh", two bones "left" and "right", moved by 10 and 20, and one animation that
 * moves "right" by 1 in z within two seconds. */
typedef struct hand {
    struct aiScene scene;
    struct aiNode root, node, left, right, *children[3];
    struct aiMesh mesh, *meshes[1];
    unsigned mesh_numbers[1];
    struct aiVector3D vertices[3], targets[2][3];
    struct aiFace face;
    unsigned indices[3];
    struct aiBone bones[2], *bone_list[2];
    struct aiVertexWeight weights[2][3];
    struct aiAnimMesh morphs[2], *morph_list[2];
    struct aiAnimation animation, *animations[1];
    struct aiNodeAnim channel, *channels[1];
    struct aiVectorKey positions[2];
    struct aiMeshMorphAnim morph_channel, *morph_channels[1];
    struct aiMeshMorphKey morph_keys[2];
    unsigned morph_values[1];
    double morph_weights[2];
} hand;

static void name(struct aiString *to, const char *text) {
    to->length = (ai_uint32)strlen(text);
    snprintf(to->data, sizeof to->data, "%s", text);
}

static const struct aiMatrix4x4 unit = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

static void make_node(hand *h, struct aiNode *node, const char *text, float x, int child) {
    name(&node->mName, text);
    node->mTransformation = unit;
    node->mTransformation.a4 = x;
    if (child < 0) return;
    h->children[child] = node;
    node->mParent = &h->root;
}

static void make_bone(hand *h, int k, const char *text, float x) {
    name(&h->bones[k].mName, text);
    h->bones[k].mOffsetMatrix = unit;
    h->bones[k].mOffsetMatrix.a4 = -x; /* at rest, vertices stay where they are */
    h->bones[k].mWeights = h->weights[k];
    h->bone_list[k] = &h->bones[k];
}

/* Without bones, targets and animations yet: these are added by the next functions. */
static hand *make_hand(void) {
    hand *const h = calloc(1, sizeof *h);
    static const float corners[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    assert_non_null(h);
    make_node(h, &h->root, "root", 0, -1);
    make_node(h, &h->node, "mesh", 100, 0);
    make_node(h, &h->left, "left", 10, 1);
    make_node(h, &h->right, "right", 20, 2);
    h->root.mChildren = h->children, h->root.mNumChildren = 3;
    h->node.mMeshes = h->mesh_numbers, h->node.mNumMeshes = 1;
    for (unsigned i = 0; i < 3; i++) {
        h->vertices[i] = (struct aiVector3D){corners[i][0], corners[i][1], corners[i][2]};
        h->indices[i] = i;
    }
    h->face = (struct aiFace){3, h->indices};
    h->mesh.mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
    h->mesh.mVertices = h->vertices, h->mesh.mNumVertices = 3;
    h->mesh.mFaces = &h->face, h->mesh.mNumFaces = 1;
    h->meshes[0] = &h->mesh;
    h->scene.mRootNode = &h->root;
    h->scene.mMeshes = h->meshes, h->scene.mNumMeshes = 1;
    return h;
}

/* Vertices 0 and 1 follow "left", 2 "right". */
static void add_bones(hand *h) {
    make_bone(h, 0, "left", 10);
    make_bone(h, 1, "right", 20);
    h->weights[0][0] = (struct aiVertexWeight){0, 1};
    h->weights[0][1] = (struct aiVertexWeight){1, 1};
    h->weights[1][0] = (struct aiVertexWeight){2, 1};
    h->bones[0].mNumWeights = 2, h->bones[1].mNumWeights = 1;
    h->mesh.mBones = h->bone_list, h->mesh.mNumBones = 2;
}

static void add_animation(hand *h, const char *moved) {
    name(&h->channel.mNodeName, moved);
    h->positions[0] = (struct aiVectorKey){0, {20, 0, 0}};
    h->positions[1] = (struct aiVectorKey){20, {20, 0, 1}};
    h->channel.mPositionKeys = h->positions, h->channel.mNumPositionKeys = 2;
    h->channels[0] = &h->channel;
    name(&h->animation.mName, "move");
    h->animation.mDuration = 20;
    h->animation.mTicksPerSecond = 10;
    h->animation.mChannels = h->channels, h->animation.mNumChannels = 1;
    h->animations[0] = &h->animation;
    h->scene.mAnimations = h->animations, h->scene.mNumAnimations = 1;
}

/* Two targets, which take the vertices to z = 1 and to z = 2. */
static void add_targets(hand *h) {
    for (unsigned k = 0; k < 2; k++) {
        for (unsigned i = 0; i < 3; i++) {
            h->targets[k][i] = h->vertices[i];
            h->targets[k][i].z = (float)(k + 1);
        }
        h->morphs[k].mVertices = h->targets[k];
        h->morphs[k].mNumVertices = 3;
        h->morph_list[k] = &h->morphs[k];
    }
    h->mesh.mAnimMeshes = h->morph_list, h->mesh.mNumAnimMeshes = 2;
}

/* The second target's weight goes from 0 to 1 in two seconds. */
static void add_morph_channel(hand *h, const char *moved) {
    add_animation(h, "nobody");
    h->animation.mNumChannels = 0;
    name(&h->morph_channel.mName, moved);
    h->morph_values[0] = 1, h->morph_weights[1] = 1;
    for (unsigned k = 0; k < 2; k++)
        h->morph_keys[k] =
            (struct aiMeshMorphKey){20.0 * k, h->morph_values, h->morph_weights + k, 1};
    h->morph_channel.mKeys = h->morph_keys, h->morph_channel.mNumKeys = 2;
    h->morph_channels[0] = &h->morph_channel;
    h->animation.mMorphMeshChannels = h->morph_channels, h->animation.mNumMorphMeshChannels = 1;
}

static dp_source *make_source(const hand *h) {
    dp_source *source = NULL;
    dp_diag diag = {0};
    assert_true(dp_assimp_moves(&h->scene));
    if (dp_assimp_make_scene(&h->scene, NULL, &source, &diag)) fail_msg("%s", diag.message);
    return source;
}

/* The corners of the first animation, or at rest with a negative time. */
static const char *trace_at(const hand *h, double time) {
    dp_source *const source = make_source(h);
    if (time >= 0) assert_int_equal(dp_scene_play(source, 1, NULL), DP_OK);
    assert_int_equal(dp_source_set_time(source, fmax(time, 0), NULL), DP_OK);
    dp_diag diag = {0};
    return trace_opened(DP_OK, source, &diag);
}

#define assert_at(hand, time, expected) assert_contains(trace_at(hand, time), expected)

static const char *remark_of(const hand *h, dp_source **source) {
    *source = make_source(h);
    const char *const remark = dp_source_remark(*source);
    return remark ? remark : "";
}

static void assert_remark(const hand *h, const char *expected) {
    dp_source *source;
    assert_string_equal(remark_of(h, &source), expected);
    dp_source_destroy(source);
}

/* ---- what is right ---- */

static void nodes_and_bones_move(void **state) {
    (void)state;
    hand *const h = make_hand();
    add_animation(h, "mesh");
    assert_at(h, -1, "(100 0 0)(101 0 0)(100 1 0)@mesh");
    assert_at(h, 1, "(20 0 0.5)(21 0 0.5)(20 1 0.5)");
    assert_at(h, 9, "(20 0 1)(21 0 1)(20 1 1)");
    add_bones(h);
    add_animation(h, "right");
    assert_at(h, -1, "(0 0 0)(1 0 0)(0 1 0)"); /* the mesh's node does not count */
    assert_at(h, 1, "(0 0 0)(1 0 0)(0 1 0.5)");
    assert_remark(h, "");
    free(h);
}

static void weights_need_not_sum_to_one(void **state) {
    (void)state;
    hand *const h = make_hand();
    add_bones(h);
    add_animation(h, "right");
    h->weights[1][0].mWeight = 0.25f;
    h->weights[1][1] = (struct aiVertexWeight){1, 3};
    h->bones[1].mNumWeights = 2;
    assert_at(h, 2, "(0 0 0)(1 0 0.75)(0 1 1)");
    free(h);
}

static void vertices_without_bones_stay_at_their_node(void **state) {
    (void)state;
    hand *const h = make_hand();
    add_bones(h);
    h->bones[0].mNumWeights = 1;
    assert_at(h, -1, "(0 0 0)(101 0 0)(0 1 0)");
    add_animation(h, "mesh");
    assert_at(h, 2, "(0 0 0)(21 0 1)(0 1 0)");
    free(h);
}

static void morph_targets_are_positions(void **state) {
    (void)state;
    static const char *const names[] = {"mesh", "face", "mesh*0"};
    hand *const h = make_hand();
    add_targets(h);
    name(&h->mesh.mName, "face");
    h->morphs[0].mWeight = 0.5f;
    assert_at(h, -1, "(100 0 0.5)(101 0 0.5)(100 1 0.5)@mesh/face");
    for (int k = 0; k < 3; k++) {
        add_morph_channel(h, names[k]);
        assert_at(h, 1, "(100 0 1)(101 0 1)(100 1 1)");
        assert_remark(h, "");
    }
    free(h);
}

static void channels_may_go_on(void **state) {
    (void)state;
    hand *const h = make_hand();
    add_animation(h, "mesh");
    h->animation.mDuration = 90;
    assert_at(h, 3, "(20 0 1)");
    h->channel.mPostState = aiAnimBehaviour_LINEAR;
    assert_at(h, 3, "(20 0 1.5)");
    assert_at(h, 20, "(20 0 4.5)");
    h->channel.mPostState = aiAnimBehaviour_REPEAT;
    assert_at(h, 3, "(20 0 0.5)");
    assert_at(h, 5.5, "(20 0 0.75)");
    h->animation.mDuration = 1e300;
    assert_at(h, 3, "(20 0 1)"); /* too many repetitions */
    free(h);
}

/* ---- what is wrong ---- */

static void bones_may_be_wrong(void **state) {
    (void)state;
    hand *const h = make_hand();
    add_bones(h);
    h->weights[0][1] = (struct aiVertexWeight){4000000000u, 1};
    h->weights[1][1] = (struct aiVertexWeight){1, NAN};
    h->weights[1][2] = (struct aiVertexWeight){0, -5};
    h->bones[1].mNumWeights = 3;
    assert_at(h, -1, "(0 0 0)(101 0 0)(0 1 0)");
    h->bones[1].mOffsetMatrix.b2 = NAN;
    assert_at(h, -1, "(0 0 0)(101 0 0)(100 1 0)");
    assert_remark(h, "1 bones name no node of the file, and move nothing");
    name(&h->bones[0].mName, "nobody");
    assert_at(h, -1, "(100 0 0)(101 0 0)(100 1 0)");
    h->bone_list[0] = NULL;
    assert_at(h, -1, "(100 0 0)(101 0 0)(100 1 0)");
    free(h);
}

/* 70 bones at one vertex: the strongest 64 move it. */
static void influences_have_an_end(void **state) {
    (void)state;
    enum { MANY = 70 };
    hand *const h = make_hand();
    static struct aiBone bones[MANY], *list[MANY];
    static struct aiVertexWeight weights[MANY];
    add_bones(h);
    for (int k = 0; k < MANY; k++) {
        bones[k] = h->bones[k % 2];
        weights[k] = (struct aiVertexWeight){0, k < 6 ? 1e-3f : 1};
        bones[k].mWeights = &weights[k], bones[k].mNumWeights = 1;
        list[k] = &bones[k];
    }
    h->mesh.mBones = list, h->mesh.mNumBones = MANY;
    add_animation(h, "right");
    assert_at(h, 2, "(0 0 0.5)(101 0 0)(100 1 0)");
    assert_remark(h, "6 influences of bones on vertices that have too many are left out");
    free(h);
}

static void matrices_may_be_nan(void **state) {
    (void)state;
    hand *const h = make_hand();
    dp_extent extent;
    add_animation(h, "left");
    h->node.mTransformation.a1 = NAN;
    dp_source *const source = make_source(h);
    assert_int_equal(dp_source_extent(source, &extent, NULL), DP_OK);
    assert_int_equal(extent.not_finite, 1);
    dp_source_destroy(source);
    free(h);
}

static void times_may_be_absurd(void **state) {
    (void)state;
    static const double ticks[] = {0, -5, NAN, INFINITY, 1e308, 1e-308, 5e-324};
    static const double durations[] = {0, -1, NAN, INFINITY, 1e308, 20};
    hand *const h = make_hand();
    for (size_t i = 0; i < sizeof ticks / sizeof *ticks; i++)
        for (size_t k = 0; k < sizeof durations / sizeof *durations; k++)
            for (int state_after = 0; state_after < 4; state_after++) {
                add_animation(h, "mesh");
                h->animation.mTicksPerSecond = ticks[i];
                h->animation.mDuration = durations[k];
                h->channel.mPostState = (enum aiAnimBehaviour)state_after;
                assert_contains(trace_at(h, 1e-3), "@mesh");
                dp_source *const source = make_source(h);
                assert_int_equal(dp_scene_play(source, 1, NULL), DP_OK);
                assert_true(isfinite(dp_source_duration(source)));
                dp_source_destroy(source);
            }
    add_animation(h, "mesh");
    h->animation.mTicksPerSecond = 0; /* 25, as viewers have it */
    assert_at(h, 0.4, "(20 0 0.5)");
    free(h);
}

static void keys_may_be_wrong(void **state) {
    (void)state;
    hand *const h = make_hand();
    add_animation(h, "mesh");
    h->positions[1].mTime = -3;
    assert_at(h, 2, "(20 0 0)"); /* the second one is left out */
    h->positions[0].mTime = NAN;
    assert_at(h, 2, "(20 0 1)");
    h->positions[1].mValue.x = NAN;
    assert_at(h, 2, "(100 0 0)");
    h->channel.mPositionKeys = NULL;
    assert_at(h, 2, "(100 0 0)");
    free(h);
}

static void names_may_be_missing(void **state) {
    (void)state;
    hand *const h = make_hand();
    dp_source *source;
    add_animation(h, "nobody");
    assert_at(h, 1, "(100 0 0)");
    assert_remark(h, "1 channels of its animations name no node, and move nothing");
    h->channels[0] = NULL;
    assert_at(h, 1, "(100 0 0)");
    h->animations[0] = NULL;
    remark_of(h, &source);
    assert_int_equal(dp_scene_of(source)->clip_count, 1);
    dp_source_destroy(source);
    add_targets(h);
    add_morph_channel(h, "nobody");
    assert_at(h, 1, "(100 0 0)");
    add_morph_channel(h, "left"); /* which has no targets */
    assert_at(h, 1, "(100 0 0)");
    free(h);
}

static void targets_may_be_wrong(void **state) {
    (void)state;
    hand *const h = make_hand();
    add_targets(h);
    add_morph_channel(h, "mesh");
    h->morph_values[0] = 77;
    assert_at(h, 2, "(100 0 0)");
    h->morph_values[0] = 1;
    h->morphs[1].mNumVertices = 2;
    assert_at(h, 2, "(100 0 0)");
    h->morph_list[1] = NULL;
    assert_at(h, 2, "(100 0 0)");
    h->morphs[0].mWeight = NAN;
    assert_at(h, -1, "(100 0 0)");
    free(h);
}

static void thousands_of_clips(void **state) {
    (void)state;
    enum { MANY = 5000 };
    static struct aiAnimation *list[MANY];
    hand *const h = make_hand();
    add_animation(h, "mesh");
    for (int k = 0; k < MANY; k++) list[k] = &h->animation;
    h->scene.mAnimations = list, h->scene.mNumAnimations = MANY;
    dp_source *const source = make_source(h);
    assert_int_equal(dp_scene_of(source)->clip_count, MANY);
    assert_int_equal(dp_scene_play(source, MANY, NULL), DP_OK);
    assert_int_equal(dp_scene_play(source, MANY + 1, NULL), DP_ERR_ARGUMENT);
    dp_source_destroy(source);
    free(h);
}

static void refused(const hand *h, dp_result expected, const char *message) {
    dp_source *source = NULL;
    dp_diag diag = {0};
    assert_int_equal(dp_assimp_make_scene(&h->scene, NULL, &source, &diag), expected);
    assert_contains(diag.message, message);
    assert_null(source);
}

static void trees_may_be_wrong(void **state) {
    (void)state;
    enum { DEEP = 2000 };
    static struct aiNode chain[DEEP], *next[DEEP];
    hand *const h = make_hand();
    add_animation(h, "mesh");
    h->children[1] = NULL;
    h->mesh_numbers[0] = 9;
    refused(h, DP_ERR_FORMAT, "there are no polygons in it");
    h->mesh_numbers[0] = 0;
    assert_at(h, 1, "(20 0 0.5)");
    h->node.mParent = &h->node; /* a circle */
    refused(h, DP_ERR_ARGUMENT, "");
    for (int k = 0; k < DEEP; k++) {
        next[k] = &chain[k];
        if (k) chain[k].mParent = &chain[k - 1];
        if (k + 1 < DEEP) chain[k].mChildren = &next[k + 1], chain[k].mNumChildren = 1;
    }
    h->scene.mRootNode = &chain[0];
    refused(h, DP_ERR_LIMIT, "nested more than 1000 deep");
    h->scene.mRootNode = NULL;
    refused(h, DP_ERR_FORMAT, "no polygons");
    free(h);
}

/* ---- memory ---- */

static int until_failure;
static void *failing_alloc(size_t size, void *user) {
    (void)user;
    return until_failure-- == 0 ? NULL : malloc(size);
}
static void *failing_realloc(void *block, size_t size, void *user) {
    (void)user;
    return until_failure-- == 0 ? NULL : realloc(block, size);
}
static void failing_free(void *block, void *user) {
    (void)user;
    free(block);
}

static void memory_may_fail_anywhere(void **state) {
    (void)state;
    const dp_allocator memory = {failing_alloc, failing_realloc, failing_free, NULL};
    int failures = 0;
    hand *const h = make_hand();
    add_bones(h);
    add_targets(h);
    add_animation(h, "right");
    h->bones[0].mNumWeights = 1;
    for (int n = 0; n < 200; n++) {
        dp_source *source = NULL;
        dp_diag diag = {0};
        until_failure = n;
        const dp_result result = dp_assimp_make_scene(&h->scene, &memory, &source, &diag);
        dp_source_destroy(source);
        if (until_failure >= 0) break;
        assert_true(result == DP_ERR_MEMORY ||
                    result == DP_OK); /* which could not be cut to size */
        failures += result != DP_OK;
    }
    assert_true(failures > 2 && until_failure >= 0);
    free(h);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nodes_and_bones_move),
        cmocka_unit_test(weights_need_not_sum_to_one),
        cmocka_unit_test(vertices_without_bones_stay_at_their_node),
        cmocka_unit_test(morph_targets_are_positions),
        cmocka_unit_test(channels_may_go_on),
        cmocka_unit_test(bones_may_be_wrong),
        cmocka_unit_test(influences_have_an_end),
        cmocka_unit_test(matrices_may_be_nan),
        cmocka_unit_test(times_may_be_absurd),
        cmocka_unit_test(keys_may_be_wrong),
        cmocka_unit_test(names_may_be_missing),
        cmocka_unit_test(targets_may_be_wrong),
        cmocka_unit_test(thousands_of_clips),
        cmocka_unit_test(trees_may_be_wrong),
        cmocka_unit_test(memory_may_fail_anywhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
