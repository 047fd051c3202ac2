/* src/scene: nodes, instances, morph targets, skins and clips. */
#include "drawing.h"

#include <math.h>
#include <stdatomic.h>
#include <string.h>

static const float square[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
static const uint32_t square_corners[] = {0, 1, 2, 0, 2, 3};
static const float up_normals[] = {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 0};

static dp_batch square_batch(void) {
    return (dp_batch){.positions = square,
                      .vertex_count = 4,
                      .indices = square_corners,
                      .corner_count = 6,
                      .polygon_count = 2};
}

static dp_source *source_of(const dp_scene_desc *desc) {
    dp_source *source;
    dp_diag diag = {0};
    if (dp_source_from_scene(desc, NULL, &source, &diag)) fail_msg("%s", diag.message);
    return source;
}

static dp_batch read_all(dp_source *source) {
    dp_batch batch, next;
    assert_int_equal(dp_source_rewind(source, NULL), DP_OK);
    assert_int_equal(dp_source_next(source, &batch, NULL), DP_OK);
    assert_int_equal(dp_source_next(source, &next, NULL), DP_OK);
    assert_int_equal(next.polygon_count, 0);
    return batch;
}

static dp_batch read_at(dp_source *source, double time) {
    assert_int_equal(dp_source_set_time(source, time, NULL), DP_OK);
    return read_all(source);
}

static void assert_at(const dp_batch *batch, uint32_t vertex, double x, double y, double z) {
    const double expected[3] = {x, y, z};
    for (int k = 0; k < 3; k++) {
        const double found = batch->origin[k] + (double)batch->positions[3 * vertex + (uint32_t)k];
        if (!(fabs(found - expected[k]) <= 1e-6))
            fail_msg("vertex %u, axis %d: %.9g, not %.9g", vertex, k, found, expected[k]);
    }
}

/* One square at a node. */
typedef struct small {
    dp_scene_node nodes[3];
    dp_scene_mesh mesh;
    dp_scene_instance instances[2];
    dp_scene_skin skin;
    dp_scene_channel channels[2];
    dp_scene_clip clip;
    dp_scene_desc desc;
} small;

static small *new_small(void) {
    static small s;
    s = (small){.nodes = {{.name = "arm"}, {.name = "hand", .parent = 1}},
                .mesh = {.name = "plate", .batch = square_batch(), .color = 0x336699FF},
                .instances = {{.node = 2, .mesh = 1}},
                .clip = {.name = "wave", .channels = s.channels}};
    s.desc = (dp_scene_desc){.nodes = s.nodes,
                             .node_count = 2,
                             .meshes = &s.mesh,
                             .mesh_count = 1,
                             .instances = s.instances,
                             .instance_count = 1,
                             .skins = &s.skin,
                             .clips = &s.clip,
                             .up = {0, 1, 0}};
    return &s;
}

/* ------- at rest ------- */

static void nodes_move_what_hangs_on_them(void **state) {
    (void)state;
    small *const s = new_small();
    static const double matrix[12] = {0, -1, 0, 5, 1, 0, 0, 0, 0, 0, 1, 0}; /* a quarter turn */
    s->nodes[0].matrix = matrix;
    s->nodes[1].translation[0] = 2;
    s->nodes[1].scale[0] = s->nodes[1].scale[1] = s->nodes[1].scale[2] = 3;
    dp_source *const source = source_of(&s->desc);
    const dp_batch batch = read_all(source);
    assert_int_equal(batch.polygon_count, 2);
    assert_true(batch.stable);
    assert_at(&batch, 0, 5, 2, 0);
    assert_at(&batch, 1, 5, 5, 0);
    assert_at(&batch, 3, 2, 2, 0);
    assert_string_equal(dp_source_group_name(source, 0), "hand/plate");
    assert_int_equal(dp_source_group_color(source, 0), 0x336699FF);
    assert_null(dp_source_group_name(source, 1));
    assert_int_equal(dp_source_duration(source), 0);
    dp_source_destroy(source);
}

static void tables_are_copied_and_filled_in(void **state) {
    (void)state;
    small *const s = new_small();
    dp_source *const source = source_of(&s->desc);
    const dp_scene_desc *const d = dp_scene_of(source);
    assert_non_null(d);
    assert_true(d->nodes != s->nodes && d->meshes != &s->mesh);
    assert_string_equal(d->nodes[1].name, "hand");
    assert_true(d->nodes[1].rotation[3] == 1 && d->nodes[1].scale[2] == 1);
    assert_int_equal(d->meshes[0].batch.vertex_count, 4);
    dp_source *again = source_of(d); /* of its own tables */
    dp_source_destroy(source);
    const dp_batch batch = read_all(again);
    assert_at(&batch, 2, 1, 1, 0);
    dp_source_destroy(again);
    const dp_batch plain = square_batch();
    dp_source *arrays;
    assert_int_equal(dp_source_from_arrays(&plain, NULL, &arrays, NULL), DP_OK);
    assert_null(dp_scene_of(arrays));
    assert_null(dp_scene_of(NULL));
    assert_int_equal(dp_scene_play(arrays, 1, NULL), DP_ERR_ARGUMENT);
    dp_source_destroy(arrays);
}

static void mirrored_instances_keep_their_fronts(void **state) {
    (void)state;
    static const uint8_t flags[] = {1, 1, 0, 0, 1, 1}; /* all but the diagonal */
    small *const s = new_small();
    s->mesh.batch.edge_flags = flags;
    s->mesh.batch.normals = (dp_attribute){.values = up_normals, .count = 4};
    s->nodes[1].scale[0] = -1, s->nodes[1].scale[1] = s->nodes[1].scale[2] = 1;
    dp_source *const source = source_of(&s->desc);
    const dp_batch batch = read_all(source);
    static const uint32_t corners[] = {2, 1, 0, 3, 2, 0};
    static const uint8_t turned[] = {1, 1, 0, 1, 0, 1};
    assert_memory_equal(batch.indices, corners, sizeof corners);
    assert_memory_equal(batch.edge_flags, turned, sizeof turned);
    assert_true(batch.normals.values[2] == 1);
    assert_true(batch.normals.values[9] == 0 && batch.normals.values[11] == 0); /* still none */
    dp_source_destroy(source);
}

static void polygons_of_all_kinds_lie_in_one_batch(void **state) {
    (void)state;
    small *const s = new_small();
    static const float five[] = {9, 9, 9, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    static const uint32_t firsts[] = {1, 5}; /* the first corner is no polygon's */
    static const uint32_t numbers[] = {0, 0, 1, 2, 3};
    static const float normals[] = {0, 0, 1, 0, 1, 0, 1, 0, 0, 0, 0, -1};
    static const uint32_t colors[] = {1, 2, 3, 4, 5};
    dp_scene_mesh meshes[2] = {s->mesh, {.name = "four"}};
    meshes[0].batch.indices = (const uint32_t[]){0, 1, 2, 0, 2, 77}; /* one that is not there */
    meshes[1].batch = (dp_batch){.positions = five,
                                 .vertex_count = 5,
                                 .corner_count = 5,
                                 .firsts = firsts,
                                 .polygon_count = 1,
                                 .colors = colors,
                                 .normals = {.values = normals, .count = 4, .indices = numbers}};
    s->instances[1] = (dp_scene_instance){.mesh = 2};
    s->desc.meshes = meshes, s->desc.mesh_count = 2, s->desc.instance_count = 2;
    dp_source *const source = source_of(&s->desc);
    const dp_batch b = read_all(source);
    assert_int_equal(b.polygon_count, 3);
    assert_int_equal(b.vertex_count, 9);
    assert_int_equal(b.firsts[0], 0), assert_int_equal(b.firsts[2], 6);
    assert_int_equal(b.firsts[3], 10);
    assert_int_equal(b.indices[5], UINT32_MAX);
    assert_int_equal(b.indices[6], 5), assert_int_equal(b.indices[9], 8);
    assert_int_equal(b.groups[1], 0), assert_int_equal(b.groups[2], 1);
    assert_int_equal(b.colors[0], 0), assert_int_equal(b.colors[5], 2);
    assert_true(b.normals.indices[0] == UINT32_MAX);
    assert_true(b.normals.values[3 * b.normals.indices[7] + 1] == 1);
    assert_string_equal(dp_source_group_name(source, 1), "four");
    dp_source_destroy(source);
}

static void instances_beyond_the_last_group_share_it(void **state) {
    (void)state;
    enum { MANY = 65540 };
    small *const s = new_small();
    dp_scene_instance *const instances = calloc(MANY, sizeof *instances);
    for (uint32_t i = 0; i < MANY; i++) instances[i] = (dp_scene_instance){.node = 2, .mesh = 1};
    instances[MANY - 1].node = 0;
    s->desc.instances = instances, s->desc.instance_count = MANY;
    dp_source *const source = source_of(&s->desc);
    const dp_batch batch = read_all(source);
    assert_int_equal(batch.polygon_count, 2 * MANY);
    assert_int_equal(batch.groups[2 * MANY - 1], 65535);
    assert_int_equal(batch.groups[2 * 65534], 65534);
    assert_string_equal(dp_source_group_name(source, 65535), "hand/plate");
    dp_source_destroy(source);
    free(instances);
}

static void far_scenes_have_an_origin(void **state) {
    (void)state;
    small *const s = new_small();
    s->nodes[0].translation[0] = 500000.1, s->nodes[0].translation[1] = 5400000.3;
    dp_source *const source = source_of(&s->desc);
    const dp_batch batch = read_all(source);
    assert_true(batch.origin[0] > 499990 && batch.origin[1] > 5399990);
    assert_at(&batch, 1, 500001.1, 5400000.3, 0);
    dp_source_destroy(source);
}

/* ------- moving ------- */

static void play(dp_source *source, uint32_t clip) {
    assert_int_equal(dp_scene_play(source, clip, NULL), DP_OK);
}

static void add_channel(small *s, uint32_t node, dp_scene_path path, dp_interpolation kind,
                        const double *times, const float *values, uint32_t keys) {
    s->channels[s->clip.channel_count++] = (dp_scene_channel){.node = node,
                                                              .path = path,
                                                              .interpolation = kind,
                                                              .times = times,
                                                              .values = values,
                                                              .key_count = keys,
                                                              .width = 1};
    s->desc.clip_count = 1;
}

static void channels_are_sampled(void **state) {
    (void)state;
    static const double times[] = {1, 2, 4};
    static const float values[] = {0, 0, 0, 2, 0, 0, 2, 8, 0};
    small *const s = new_small();
    add_channel(s, 2, DP_SCENE_TRANSLATION, DP_INTERPOLATION_LINEAR, times, values, 3);
    dp_source *const source = source_of(&s->desc);
    dp_batch batch = read_at(source, 1.5);
    assert_at(&batch, 0, 0, 0, 0); /* nothing plays */
    play(source, 1);
    assert_true(dp_source_duration(source) == 4);
    batch = read_all(source);
    assert_at(&batch, 0, 1, 0, 0);
    batch = read_at(source, -7);
    assert_at(&batch, 0, 0, 0, 0);
    batch = read_at(source, 3);
    assert_at(&batch, 0, 2, 4, 0);
    batch = read_at(source, 1e300);
    assert_at(&batch, 0, 2, 8, 0);
    play(source, 0);
    batch = read_all(source);
    assert_at(&batch, 0, 0, 0, 0);
    assert_true(dp_source_duration(source) == 0);
    assert_int_equal(dp_scene_play(source, 2, NULL), DP_ERR_ARGUMENT);
    dp_source_destroy(source);
}

static void steps_hold_and_splines_bend(void **state) {
    (void)state;
    static const double times[] = {0, 2};
    static const float steps[] = {0, 0, 0, 2, 0, 0};
    static const float spline[] = {0, 0, 0, 0, 0, 0, 1, 0, 0, /* in, value, out */
                                   3, 0, 0, 2, 0, 0, 0, 0, 0};
    small *const s = new_small();
    add_channel(s, 1, DP_SCENE_TRANSLATION, DP_INTERPOLATION_STEP, times, steps, 2);
    dp_source *source = source_of(&s->desc);
    play(source, 1);
    dp_batch batch = read_at(source, 1.999);
    assert_at(&batch, 0, 0, 0, 0);
    batch = read_at(source, 2);
    assert_at(&batch, 0, 2, 0, 0);
    dp_source_destroy(source);
    s->channels[0].interpolation = DP_INTERPOLATION_CUBIC;
    s->channels[0].values = spline;
    source = source_of(&s->desc);
    play(source, 1);
    batch = read_at(source, 1); /* 1/2 * 2 + 2 * (1/8 * 1 - 1/8 * 3) */
    assert_at(&batch, 0, 0.5, 0, 0);
    dp_source_destroy(source);
}

static void rotations_go_the_short_way(void **state) {
    (void)state;
    static const double times[] = {0, 1};
    const float h = sqrtf(0.5f);
    const float turns[] = {0, 0, 0, 1, 0, 0, -h, -h}; /* a quarter turn about z, negated */
    small *const s = new_small();
    add_channel(s, 2, DP_SCENE_ROTATION, DP_INTERPOLATION_LINEAR, times, turns, 2);
    dp_source *const source = source_of(&s->desc);
    play(source, 1);
    dp_batch batch = read_at(source, 1.0 / 3);
    assert_at(&batch, 1, sqrt(0.75), 0.5, 0);
    batch = read_at(source, 1);
    assert_at(&batch, 1, 0, 1, 0);
    dp_source_destroy(source);
}

static void bad_keys_are_left_out(void **state) {
    (void)state;
    static const double times[] = {NAN, 1, 0.5, 1, 2, 3, INFINITY};
    static const float values[21] = {[3] = 1, [12] = 2, [15] = NAN, [6] = 50, [9] = 60};
    small *const s = new_small();
    add_channel(s, 2, DP_SCENE_TRANSLATION, DP_INTERPOLATION_LINEAR, times, values, 7);
    dp_source *const source = source_of(&s->desc);
    assert_int_equal(dp_scene_of(source)->clips[0].channels[0].key_count, 2);
    play(source, 1);
    const dp_batch batch = read_at(source, 1.5);
    assert_at(&batch, 0, 1.5, 0, 0);
    assert_true(dp_source_duration(source) == 2);
    dp_source_destroy(source);
}

static void mirroring_may_begin_and_end(void **state) {
    (void)state;
    static const double times[] = {0, 2};
    static const float scales[] = {1, 1, 1, -1, 1, 1};
    small *const s = new_small();
    s->mesh.batch.normals = (dp_attribute){.values = up_normals, .count = 4};
    add_channel(s, 2, DP_SCENE_SCALE, DP_INTERPOLATION_LINEAR, times, scales, 2);
    dp_source *const source = source_of(&s->desc);
    play(source, 1);
    dp_batch batch = read_at(source, 2);
    assert_int_equal(batch.indices[0], 2);
    assert_at(&batch, 1, -1, 0, 0);
    batch = read_at(source, 1); /* flat: no area, and no normal */
    assert_at(&batch, 1, 0, 0, 0);
    assert_true(batch.normals.values[0] == 0 && batch.normals.values[2] == 0);
    batch = read_at(source, 0);
    assert_memory_equal(batch.indices, square_corners, sizeof square_corners);
    assert_true(batch.normals.values[2] == 1);
    dp_source_destroy(source);
}

static void morph_targets_are_weighed(void **state) {
    (void)state;
    static const float lift[12] = {[2] = 1, [11] = 4}, tilt[12] = {[0] = 1};
    static const float slide[12] = {[0] = 10};
    const dp_scene_morph morphs[] = {{.positions = lift, .normals = tilt}, {.positions = slide}};
    static const double times[] = {0, 1};
    static const float weights[] = {0, 1, 1, 0};
    static const float at_rest[] = {0.5f};
    small *const s = new_small();
    s->mesh.morphs = morphs, s->mesh.morph_count = 2;
    s->mesh.batch.normals = (dp_attribute){.values = up_normals, .count = 4};
    s->instances[0].weights = at_rest, s->instances[0].weight_count = 1;
    add_channel(s, 2, DP_SCENE_WEIGHTS, DP_INTERPOLATION_LINEAR, times, weights, 2);
    s->channels[0].width = 2;
    dp_source *const source = source_of(&s->desc);
    dp_batch batch = read_all(source);
    assert_at(&batch, 0, 0, 0, 0.5);
    assert_at(&batch, 3, 0, 1, 2);
    assert_true(batch.normals.values[0] == 0.5f && batch.normals.values[2] == 1);
    play(source, 1);
    batch = read_at(source, 0.25);
    assert_at(&batch, 0, 7.5, 0, 0.25);
    dp_source_destroy(source);
}

static void joints_move_skins(void **state) {
    (void)state;
    static const double times[] = {0, 1};
    static const float lift[] = {0, 0, 0, 0, 0, 6};
    /* Weights that do not sum to one, are bad, or name a joint that is not there. */
    static const uint16_t joints[] = {0, 1, 1, 0, 0, 1, 9, 7};
    static const float weights[] = {1, 0, 8, 8, 3, NAN, 1, -5};
    static const uint32_t list[] = {1, 2};
    static const double inverse[] = {1, 0, 0, -1, 0, 1, 0, 0, 0, 0, 1, 0,
                                     1, 0, 0, -1, 0, 1, 0, 0, 0, 0, 1, 0};
    small *const s = new_small();
    s->nodes[0].translation[0] = 1;
    s->nodes[2].translation[1] = 70; /* the skinned mesh's own: not used */
    s->desc.node_count = 3;
    s->instances[0] = (dp_scene_instance){.node = 3, .mesh = 1, .skin = 1};
    s->mesh.joints = joints, s->mesh.weights = weights, s->mesh.influences = 2;
    s->skin = (dp_scene_skin){.joints = list, .inverse_bind = inverse, .joint_count = 2};
    s->desc.skin_count = 1;
    add_channel(s, 2, DP_SCENE_TRANSLATION, DP_INTERPOLATION_LINEAR, times, lift, 2);
    dp_source *const source = source_of(&s->desc);
    dp_batch batch = read_all(source);
    for (uint32_t v = 0; v < 4; v++) assert_at(&batch, v, square[3 * v], square[3 * v + 1], 0);
    play(source, 1);
    batch = read_at(source, 1);
    assert_at(&batch, 0, 0, 0, 0);
    assert_at(&batch, 1, 1, 0, 3);
    assert_at(&batch, 2, 1, 1, 0);
    assert_at(&batch, 3, 0, 1, 0);
    s->skin.joint_count = 0; /* a skin without joints: the node counts */
    dp_source *const bare = source_of(&s->desc);
    batch = read_all(bare);
    assert_at(&batch, 0, 0, 70, 0);
    dp_source_destroy(bare);
    dp_source_destroy(source);
}

/* ------- what cannot be ------- */

static void assert_refused(const small *s, dp_result expected, const char *word) {
    dp_source *source;
    dp_diag diag = {0};
    assert_int_equal(dp_source_from_scene(&s->desc, NULL, &source, &diag), expected);
    assert_null(source);
    if (!strstr(diag.message, word)) fail_msg("\"%s\" lacks \"%s\"", diag.message, word);
}

static void contradictions_are_refused(void **state) {
    (void)state;
    small *s = new_small();
    s->nodes[0].parent = 2;
    assert_refused(s, DP_ERR_ARGUMENT, "its own ancestor");
    s = new_small(), s->nodes[0].parent = 3;
    assert_refused(s, DP_ERR_ARGUMENT, "node 1 has a parent");
    s = new_small(), s->instances[0].mesh = 2;
    assert_refused(s, DP_ERR_ARGUMENT, "instance 1 names a mesh");
    s = new_small(), s->instances[0].skin = 1;
    assert_refused(s, DP_ERR_ARGUMENT, "instance 1 names a skin");
    s = new_small(), s->mesh.influences = 1;
    assert_refused(s, DP_ERR_ARGUMENT, "mesh 1 has influences");
    s = new_small(), s->mesh.batch.corner_count = 5;
    assert_refused(s, DP_ERR_ARGUMENT, "mesh 1: a batch of 2 triangles");
    s = new_small(), s->desc.nodes = NULL;
    assert_refused(s, DP_ERR_ARGUMENT, "table is NULL");
    s = new_small(), s->mesh.batch.vertex_count = UINT32_MAX;
    assert_refused(s, DP_ERR_LIMIT, "4294967294");
    s = new_small(), add_channel(s, 7, DP_SCENE_SCALE, 0, NULL, NULL, 0);
    assert_refused(s, DP_ERR_ARGUMENT, "clip 1 moves a node");
}

/* ------- memory and threads ------- */

typedef struct meter {
    atomic_long calls, alive;
    long fail_at; /* 0: never */
} meter;

static void *meter_alloc(size_t size, void *user) {
    meter *const m = user;
    if (++m->calls == m->fail_at) return NULL;
    m->alive++;
    return malloc(size);
}
static void *meter_realloc(void *block, size_t size, void *user) {
    meter *const m = user;
    if (++m->calls == m->fail_at) return NULL;
    m->alive += !block;
    return realloc(block, size);
}
static void meter_free(void *block, void *user) {
    ((meter *)user)->alive -= block != NULL;
    free(block);
}

/* A shape's polygons, moved by joints, a morph target and a node. */
static dp_scene_mesh shape_mesh(const char *name, dp_batch *batch, dp_source **shape) {
    *shape = new_shape(name, NULL);
    assert_int_equal(dp_source_next(*shape, batch, NULL), DP_OK);
    const size_t n = batch->vertex_count;
    uint16_t *const joints = calloc(2 * n, sizeof *joints);
    float *const weights = calloc(2 * n, sizeof *weights);
    for (size_t v = 0; v < n; v++) {
        joints[2 * v + 1] = 1;
        weights[2 * v] = (float)(v % 7), weights[2 * v + 1] = (float)(v % 5);
    }
    return (dp_scene_mesh){
        .name = name, .batch = *batch, .joints = joints, .weights = weights, .influences = 2};
}

/* Posed and drawn by several threads, at time 0 after another. */
static void assert_same_with_threads(dp_source *source, const uint8_t *expected) {
    for (uint32_t threads = 2; threads <= 7; threads += 5) {
        static uint8_t rgba[BYTES];
        const dp_context_desc desc = {.threads = threads};
        dp_context *context;
        assert_int_equal(dp_context_create(&desc, &context, NULL), DP_OK);
        for (int time = 1; time >= 0; time--) {
            assert_int_equal(dp_source_set_time(source, time, NULL), DP_OK);
            assert_int_equal(draw(context, source, rgba, NULL), DP_OK);
        }
        assert_memory_equal(rgba, expected, BYTES);
        dp_context_destroy(context);
    }
}

static void frames_allocate_nothing(void **state) {
    (void)state;
    static const double times[] = {0, 1};
    static const float turns[] = {0, 0, 0, 1, 0, 0, 0.6f, 0.8f};
    static const float scales[] = {1, 1, 1, -1, 1, 1};
    static const uint32_t list[] = {1, 2};
    meter m = {0};
    const dp_allocator allocator = {meter_alloc, meter_realloc, meter_free, &m};
    dp_batch batch;
    dp_source *shape, *source;
    small *const s = new_small();
    s->mesh = shape_mesh("gear", &batch, &shape);
    s->skin = (dp_scene_skin){.joints = list, .joint_count = 2};
    s->instances[0] = (dp_scene_instance){.mesh = 1, .skin = 1};
    s->instances[1] = (dp_scene_instance){.mesh = 1, .node = 2};
    s->nodes[1].translation[2] = 1;
    s->desc.instance_count = 2, s->desc.skin_count = 1;
    add_channel(s, 2, DP_SCENE_ROTATION, DP_INTERPOLATION_LINEAR, times, turns, 2);
    add_channel(s, 2, DP_SCENE_SCALE, DP_INTERPOLATION_STEP, times, scales, 2);
    for (long at = 1;; at++) { /* whichever allocation fails */
        m = (meter){.fail_at = at};
        const dp_result result = dp_source_from_scene(&s->desc, &allocator, &source, NULL);
        if (!result) break;
        assert_int_equal(result, DP_ERR_MEMORY);
        assert_int_equal(m.alive, 0);
    }
    m.fail_at = 0;
    play(source, 1);
    dp_context *context;
    static uint8_t rgba[BYTES], first[BYTES];
    meter drawing = {0};
    const dp_allocator beside = {meter_alloc, meter_realloc, meter_free, &drawing};
    const dp_context_desc desc = {.allocator = &beside, .threads = 1};
    assert_int_equal(dp_context_create(&desc, &context, NULL), DP_OK);
    const long made = m.calls;
    const double order[] = {0, 1, 0.5, 0.25, 0.75, 0, 1, 0.5, 0.25, 0.75, 0};
    long calls = 0;
    for (size_t i = 0; i < sizeof order / sizeof *order; i++) {
        assert_int_equal(dp_source_set_time(source, order[i], NULL), DP_OK);
        assert_int_equal(draw(context, source, rgba, NULL), DP_OK);
        if (i == 4)
            calls = drawing.calls; /* each picture was drawn once: its lists are as long as ever */
        if (i == 0) memcpy(first, rgba, BYTES);
    }
    assert_memory_equal(rgba, first, BYTES);
    assert_int_equal(drawing.calls, calls);
    dp_context_destroy(context);
    assert_same_with_threads(source, first);
    assert_int_equal(m.calls, made); /* a pose takes no memory at all */
    dp_source_destroy(source);
    assert_int_equal(m.alive, 0);
    free((void *)s->mesh.joints), free((void *)s->mesh.weights);
    dp_source_destroy(shape);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nodes_move_what_hangs_on_them),
        cmocka_unit_test(tables_are_copied_and_filled_in),
        cmocka_unit_test(mirrored_instances_keep_their_fronts),
        cmocka_unit_test(polygons_of_all_kinds_lie_in_one_batch),
        cmocka_unit_test(instances_beyond_the_last_group_share_it),
        cmocka_unit_test(far_scenes_have_an_origin),
        cmocka_unit_test(channels_are_sampled),
        cmocka_unit_test(steps_hold_and_splines_bend),
        cmocka_unit_test(rotations_go_the_short_way),
        cmocka_unit_test(bad_keys_are_left_out),
        cmocka_unit_test(mirroring_may_begin_and_end),
        cmocka_unit_test(morph_targets_are_weighed),
        cmocka_unit_test(joints_move_skins),
        cmocka_unit_test(contradictions_are_refused),
        cmocka_unit_test(frames_allocate_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
