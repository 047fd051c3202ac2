/* io/gltf: containers, what is read, and what bad files are told. How scenes move is tested in
 * tests/moving and test_scene.c. */
#include "reading.h"

#include <drypoint/scene.h>

/* A triangle that moves, has a skin and a morph target; all numbers are in t.bin. */
#define MODEL                                                                                      \
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"                   \
    "\"nodes\":[{\"name\":\"arm\",\"children\":[1],\"translation\":[0,0,5]},"                      \
    "{\"mesh\":0,\"skin\":0,\"weights\":[0]}],"                                                    \
    "\"meshes\":[{\"name\":\"sail\",\"primitives\":[{\"attributes\":{\"POSITION\":0,"              \
    "\"JOINTS_0\":4,\"WEIGHTS_0\":5},\"indices\":1,\"mode\":4,\"material\":0,"                     \
    "\"targets\":[{\"POSITION\":0}]}]}],"                                                          \
    "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,0,0.2,1]}}],"                \
    "\"skins\":[{\"joints\":[0]}],"                                                                \
    "\"animations\":[{\"name\":\"sway\",\"samplers\":[{\"input\":2,\"output\":3}],"                \
    "\"channels\":[{\"sampler\":0,\"target\":{\"node\":0,\"path\":\"translation\"}}]}],"           \
    "\"buffers\":[{\"uri\":\"t.bin\",\"byteLength\":130}],"                                        \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},"                                           \
    "{\"buffer\":0,\"byteOffset\":36,\"byteLength\":6},"                                           \
    "{\"buffer\":0,\"byteOffset\":44,\"byteLength\":8},"                                           \
    "{\"buffer\":0,\"byteOffset\":52,\"byteLength\":24},"                                          \
    "{\"buffer\":0,\"byteOffset\":76,\"byteLength\":12}],"                                         \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"      \
    "{\"bufferView\":1,\"componentType\":5123,\"count\":3,\"type\":\"SCALAR\"},"                   \
    "{\"bufferView\":2,\"componentType\":5126,\"count\":2,\"type\":\"SCALAR\"},"                   \
    "{\"bufferView\":3,\"componentType\":5126,\"count\":2,\"type\":\"VEC3\"},"                     \
    "{\"componentType\":5121,\"count\":3,\"type\":\"VEC4\"},"                                      \
    "{\"bufferView\":4,\"componentType\":5121,\"normalized\":true,\"count\":3,\"type\":\"VEC4\"}]" \
    "}"

static const struct {
    float positions[9];
    uint16_t indices[4]; /* one more than needed */
    float times[2], values[6];
    uint8_t weights[12], rest[42];
} numbers = {.positions = {0, 0, 0, 1, 0, 0, 0, 1, 0},
             .indices = {0, 1, 2, 0},
             .times = {0, 2},
             .values = {0, 0, 0, 4, 0, 0},
             .weights = {255, 0, 0, 0, 255, 0, 0, 0, 255, 0, 0, 0}};

static bool open_numbers(void *user, const char *name, const void **data, size_t *size) {
    (void)user;
    if (strcmp(name, "t.bin") != 0 && strcmp(name, "my file.bin") != 0) return false;
    *data = &numbers;
    *size = 130;
    return true;
}

static dp_result open_text(const char *text, size_t size, dp_source **source, dp_diag *diag) {
    const dp_memory_file file = {
        .data = text, .size = size, .name = "t.gltf", .open_beside = open_numbers};
    return dp_source_open_memory(&file, NULL, source, diag);
}

/* The model with one place changed. */
static const char *edited(const char *from, const char *to) {
    static char text[4000];
    const char *const at = strstr(MODEL, from);
    if (!at) fail_msg("the model has no %s", from);
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - (const char *)MODEL), MODEL, to,
             at + strlen(from));
    return text;
}

static const char *trace_model(const char *text) {
    dp_source *source = NULL;
    dp_diag diag = {0};
    const dp_result result = open_text(text, strlen(text), &source, &diag);
    return trace_opened(result, source, &diag);
}

#define TRIANGLE "(0 0 5)(1 0 5)(0 1 5)@nodes[1]/sail\n"

static void scenes_are_read(void **state) {
    (void)state;
    dp_source *source = NULL;
    dp_diag diag = {0};
    assert_int_equal(open_text(MODEL, sizeof MODEL - 1, &source, &diag), DP_OK);
    const dp_scene_desc *const scene = dp_scene_of(source);
    assert_int_equal(scene->node_count, 2), assert_int_equal(scene->clip_count, 1);
    assert_string_equal(scene->clips[0].name, "sway");
    assert_true(scene->clips[0].duration == 2);
    assert_int_equal(scene->meshes[0].influences, 4);
    assert_int_equal(scene->meshes[0].morph_count, 1);
    assert_int_equal(dp_source_group_color(source, 0), 0xFF0033FF);
    double up[3];
    assert_true(dp_source_up(source, up) && up[1] == 1);
    assert_string_equal(trace_opened(DP_OK, source, &diag), TRIANGLE);
}

static void clips_move_them(void **state) {
    (void)state;
    char text[200];
    dp_source *source = NULL;
    assert_int_equal(open_text(MODEL, sizeof MODEL - 1, &source, NULL), DP_OK);
    assert_int_equal(dp_scene_play(source, 1, NULL), DP_OK);
    assert_int_equal(dp_source_set_time(source, 1, NULL), DP_OK);
    trace(source, text, sizeof text);
    assert_string_equal(text, "(2 0 0)(3 0 0)(2 1 0)@nodes[1]/sail\n");
    dp_source_destroy(source);
}

/* ------- containers ------- */

/* A .glb of two chunks. */
static size_t binary_of(const char *json, uint8_t *to, uint32_t version) {
    const uint32_t text = (uint32_t)strlen(json), padded = (text + 3) / 4 * 4;
    const uint32_t words[] = {0x46546c67, version, 12 + 8 + padded + 8 + 132, padded, 0x4e4f534a};
    const uint32_t chunk[] = {132, 0x004e4942};
    memcpy(to, words, sizeof words);
    memset(to + 20, ' ', padded);
    memcpy(to + 20, json, text);
    memcpy(to + 20 + padded, chunk, sizeof chunk);
    memset(to + 28 + padded, 0, 132);
    memcpy(to + 28 + padded, &numbers, sizeof numbers < 130 ? sizeof numbers : 130);
    return 28 + padded + 132;
}

static void binary_files_are_read(void **state) {
    (void)state;
    static uint8_t file[5000];
    const char *const json = edited("\"uri\":\"t.bin\",", "");
    const size_t size = binary_of(json, file, 2);
    assert_string_equal(trace_bytes(file, size, NULL, DP_FORMAT_AUTO), TRIANGLE);
    for (size_t cut = 4; cut < size - 2;
         cut += cut < 30 ? 1 : 97) /* 130 bytes are said to be there */
        assert_contains(trace_bytes(file, cut, NULL, DP_FORMAT_AUTO), "bad file content");
    binary_of(json, file, 1);
    assert_contains(trace_bytes(file, size, NULL, DP_FORMAT_AUTO), "not supported");
    binary_of(json, file, 3);
    assert_contains(trace_bytes(file, size, NULL, DP_FORMAT_AUTO), "a .glb of version 3");
}

#define DATA(rest)                                                                                 \
    "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],"                                   \
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"                           \
    "\"buffers\":[{\"byteLength\":9,\"uri\":\"data:application/octet-stream" rest "\"}],"          \
    "\"bufferViews\":[{\"buffer\":0,\"byteLength\":9}],"                                           \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5120,\"count\":3,\"type\":\"VEC3\"}]}"

static void bytes_may_stand_in_the_text(void **state) {
    (void)state;
    assert_string_equal(trace_model(DATA(";base64,AAAAAQAAAP8A")),
                        "(0 0 0)(1 0 0)(0 -1 0)@nodes[0]/meshes[0]\n");
    assert_contains(trace_model(DATA(";base64,AAAAAQAAAP8=")), "bufferView 0 ends at byte 9 of");
    assert_contains(trace_model(DATA(";base64,AAAA*Q")), "is not base64 at letter 4");
    assert_contains(trace_model(DATA(",AAAA")), "must be in base64");
    assert_contains(trace_model(DATA("")), "must be in base64");
}

static void names_of_files_are_unescaped(void **state) {
    (void)state;
    assert_string_equal(trace_model(edited("t.bin", "my%20file.bin")), TRIANGLE);
    assert_contains(trace_model(edited("t.bin", "no.bin")),
                    "buffer 0: no.bin: it was not given with the model");
    assert_contains(trace_model(edited("t.bin", "")), "\"uri\" is empty");
    assert_contains(trace_bytes(MODEL, sizeof MODEL - 1, NULL, DP_FORMAT_AUTO),
                    "in the file t.bin, which was not given with the model");
}

/* ------- what is left out ------- */

static void what_is_not_drawn_is_passed_over(void **state) {
    (void)state;
    assert_string_equal(trace_model(edited("\"node\":0,\"path\"", "\"path\"")), TRIANGLE);
    assert_string_equal(trace_model(edited("\"path\":\"translation\"", "\"path\":\"pointer\"")),
                        TRIANGLE);
    assert_contains(trace_model(edited("\"mode\":4", "\"mode\":1")), "no polygons");
    assert_contains(trace_model(edited("\"scene\":0,\"scenes\":[{\"nodes\":[0]}]",
                                       "\"scenes\":[{},{\"nodes\":[0]}]")),
                    "no polygons");
    assert_string_equal(trace_model(edited("\"scene\":0,\"scenes\":[{\"nodes\":[0]}],", "")),
                        TRIANGLE); /* all roots */
    assert_string_equal(
        trace_model(edited("\"skins\":[{\"joints\":[0]}]", "\"skins\":[{\"joints\":[]}]")),
        TRIANGLE); /* follows its node */
}

static void indices_of_nothing_stay_for_the_engine(void **state) {
    (void)state;
    const char *const text = edited("{\"bufferView\":1,\"componentType\":5123,\"count\":3",
                                    "{\"bufferView\":0,\"componentType\":5125,\"count\":3");
    assert_string_equal(trace_model(text), "(0 0 5)(0 0 5)(0 0 5)@nodes[1]/sail\n");
    assert_contains(trace_model(edited("\"indices\":1", "\"indices\":5")), /* 255 */
                    "(none)");
}

/* ------- bad files ------- */

static void bad_files_are_told(void **state) {
    (void)state;
    static const char *const cases[][3] = {
        {"\"2.0\"", "\"3.1\"", "a version of glTF other than 2 and 1"},
        {"\"version\":\"2.0\"", "", "does not say which version"},
        {"\"2.0\"", "\"1.0\"", "not supported at line 0, byte 0: this is glTF 1.0"},
        {"\"scene\":0", "\"scene\":1", "\"scene\" names scene 1, but 0 is the last"},
        {"\"scene\":0", "\"scene\":-1", "\"scene\" must be a whole number"},
        {"\"scene\":0", "\"scene\":0.5", "\"scene\" must be a whole number"},
        {"\"scene\":0", "\"scene\":\"0\"", "\"scene\" must be a whole number"},
        {"[{\"nodes\":[0]}]", "[{\"nodes\":[0,0]}]", "in the scene twice"},
        {"[{\"nodes\":[0]}]", "[{\"nodes\":[7]}]", "scene 0: \"nodes\" names node 7"},
        {"\"children\":[1]", "\"children\":[0]", "node 0: it is its own ancestor"},
        {"\"children\":[1]", "\"children\":[1,1]", "node 0: its child 1 is one of node 0"},
        {"\"children\":[1]", "\"children\":{}", "\"children\" must be an array"},
        {"[0,0,5]", "[0,0]", "node 0: \"translation\" must be 3 numbers"},
        {"[0,0,5]", "[0,0,true]", "node 0: \"translation\" must be 3 numbers"},
        {"[0,0,5]", "[0,0,1e999]", "a number beyond 1.8e308"},
        {"\"mesh\":0", "\"mesh\":3", "node 1: \"mesh\" names mesh 3"},
        {"\"skin\":0", "\"skin\":1", "node 1: \"skin\" names skin 1"},
        {"\"weights\":[0]", "\"weights\":[\"a\"]", "\"weights\" must be numbers"},
        {"\"POSITION\":0,", "\"POSITION\":9,", "mesh 0: \"POSITION\" names accessor 9"},
        {"\"POSITION\":0,", "\"POSITION\":1,", "accessor 1, POSITION, has only 1 numbers"},
        {"\"JOINTS_0\":4", "\"JOINTS_0\":0", "accessor 0, JOINTS_0, has only 3 numbers"},
        {"\"mode\":4", "\"mode\":7", "\"mode\" is 7"},
        {"[1,0,0.2,1]", "[1,0]", "\"baseColorFactor\" must be 4 numbers"},
        {"\"joints\":[0]", "\"joints\":[5]", "skin 0: \"joints\" names node 5"},
        {"\"joints\":[0]", "\"joints\":[0],\"inverseBindMatrices\":0", "must be a MAT4"},
        {"\"input\":2", "\"input\":22", "animation 0: \"input\" names accessor 22"},
        {"\"input\":2,", "", "a sampler needs \"input\" and \"output\""},
        {"\"output\":3", "\"output\":3,\"interpolation\":\"BEST\"", "must be LINEAR, STEP or"},
        {"\"output\":3", "\"output\":2", "accessors 2 and 2 must hold 1 and 3 numbers"},
        {"{\"sampler\":0,", "{\"sampler\":1,", "\"sampler\" names sampler 1"},
        {"{\"sampler\":0,", "{", "a channel names no sampler"},
        {"\"byteLength\":130", "\"byteLength\":30", "is cut off, or damaged"},
        {"\"byteLength\":36", "\"byteLength\":35", "needs bytes up to 36 of bufferView 0"},
        {"\"byteOffset\":44", "\"byteOffset\":4294967000", "bufferView 2 ends at byte"},
        {"{\"buffer\":0,\"byteLength\":36}", "{\"byteLength\":36}", "bufferView 0 names no buffer"},
        {"\"byteLength\":36}", "\"byteLength\":36,\"byteStride\":8}", "\"byteStride\" of"},
        {"\"byteLength\":36}", "\"byteLength\":36,\"byteStride\":16}", "needs bytes up to 44"},
        {"\"componentType\":5126,\"count\":3", "\"componentType\":5124,\"count\":3",
         "accessor 0: \"componentType\" must be one of"},
        {"\"componentType\":5126,\"count\":3", "\"componentType\":5126,\"count\":4000000000",
         "needs bytes up to 48000000000"},
        {"\"VEC3\"", "\"VEC5\"", "accessor 0 has no \"type\" that is known"},
        {"{\"componentType\":5121,\"count\":3", "{\"componentType\":5121,\"count\":4000000000",
         "accessor 4: \"count\" is 4000000000 without a bufferView"},
        {"{\"componentType\":5121,\"count\":3", "{\"componentType\":5121,\"count\":2",
         "accessor 4, JOINTS_0, has 2 values for 3 vertices"},
        {"{\"componentType\":5121,\"count\":3",
         "{\"sparse\":{\"count\":1},\"componentType\":5121,\"count\":3", "\"componentType\" must"},
        {"\"asset\"", "\"extensionsRequired\":[\"KHR_draco_mesh_compression\"],\"asset\"",
         "not supported at line 0, byte 0: its meshes are compressed"},
        {"\"asset\"", "\"extensionsRequired\":[\"EXT_meshopt_compression\"],\"asset\"",
         "not supported at line 0, byte 0: its meshes are compressed"},
        {"]}]}", "]}]", "at line 1, byte 0: expected ',' or '}', found"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *const text = edited(cases[i][0], cases[i][1]);
        const char *const told = trace_model(text);
        if (!strstr(told, cases[i][2]))
            fail_msg("%s for %s: no `%s` in: %s", cases[i][1], cases[i][0], cases[i][2], told);
    }
    assert_contains(trace_bytes("[\"asset\"]", 9, "a.gltf", DP_FORMAT_AUTO), "no object");
}

/* Clips that are absurd, but draw. */
static void odd_clips_are_sound(void **state) {
    (void)state;
    dp_source *source = NULL;
    const char *const text =
        edited("\"count\":2,\"type\":\"VEC3\"", "\"count\":1,\"type\":\"VEC3\"");
    assert_int_equal(open_text(text, strlen(text), &source, NULL), DP_OK);
    assert_contains(dp_source_remark(source), "accessor 3 has values for 1 of 2 keys");
    assert_int_equal(dp_scene_of(source)->clips[0].channels[0].key_count, 1);
    assert_int_equal(dp_scene_play(source, 1, NULL), DP_OK);
    assert_true(dp_source_duration(source) == 0);
    dp_source_destroy(source);
}

/* ------- memory ------- */

static int until_failure, alive;
static void *failing_alloc(size_t size, void *user) {
    (void)user;
    if (!until_failure--) return NULL;
    alive++;
    return malloc(size);
}
static void *failing_realloc(void *block, size_t size, void *user) {
    (void)user;
    if (!until_failure--) return NULL;
    alive += !block;
    return realloc(block, size);
}
static void failing_free(void *block, void *user) {
    (void)user;
    alive -= block != NULL;
    free(block);
}

static void memory_may_run_out(void **state) {
    (void)state;
    const dp_allocator memory = {failing_alloc, failing_realloc, failing_free, NULL};
    const dp_file_options options = {.allocator = &memory};
    const dp_memory_file file = {
        .data = MODEL, .size = sizeof MODEL - 1, .name = "t.gltf", .open_beside = open_numbers};
    for (int n = 0;; n++) {
        dp_source *source = NULL;
        dp_diag diag = {0};
        until_failure = n, alive = 0;
        const dp_result result = dp_source_open_memory(&file, &options, &source, &diag);
        dp_source_destroy(source);
        assert_int_equal(alive, 0);
        if (!result) break;
        assert_int_equal(result, DP_ERR_MEMORY);
        assert_true(n < 1000);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenes_are_read),
        cmocka_unit_test(clips_move_them),
        cmocka_unit_test(binary_files_are_read),
        cmocka_unit_test(bytes_may_stand_in_the_text),
        cmocka_unit_test(names_of_files_are_unescaped),
        cmocka_unit_test(what_is_not_drawn_is_passed_over),
        cmocka_unit_test(indices_of_nothing_stay_for_the_engine),
        cmocka_unit_test(bad_files_are_told),
        cmocka_unit_test(odd_clips_are_sound),
        cmocka_unit_test(memory_may_run_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
