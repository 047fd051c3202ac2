/* dp_io_open and dp_io_open_memory: the library's formats by its own readers, others through Assimp
 * with their transforms and names. */
#include "reading.h"

#include <drypoint/io.h>

#include <math.h>

/* AC3D: a square moved by (10, 0, 0), the same one mirrored, and a line. */
#define QUAD                                                                                       \
    "numvert 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\nnumsurf 1\nSURF 0x10\nmat 0\nrefs 4\n0 0 0\n1 0 0\n"   \
    "2 0 0\n3 0 0\nkids 0\n"
#define AC3D                                                                                       \
    "AC3Db\nMATERIAL \"m\" rgb 1 1 1 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 0 trans 0\n"              \
    "OBJECT world\nkids 3\nOBJECT poly\nname \"moved\"\nloc 10 0 0\n" QUAD                         \
    "OBJECT poly\nname \"mirrored\"\nrot -1 0 0 0 1 0 0 0 1\n" QUAD                                \
    "OBJECT poly\nname \"line\"\nnumvert 2\n0 0 0\n1 0 0\nnumsurf 1\nSURF 0x12\nmat 0\nrefs 2\n"   \
    "0 0 0\n1 0 0\nkids 0\n"

static const char *trace_file(const char *ending, const char *content,
                              const dp_file_options *options) {
    const char *const path = write_file(ending, content, strlen(content));
    dp_source *source = NULL;
    dp_diag diag;
    const dp_result result = dp_io_open(path, options, &source, &diag);
    const char *const text = trace_opened(result, source, &diag);
    if (strstr(text, path)) fail_msg("the message names the file: %s", text);
    unlink(path);
    return text;
}

static void own_formats_come_through_own_readers(void **state) {
    (void)state;
    assert_string_equal(trace_file(".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", NULL),
                        "(0 0 0)(1 0 0)(out)\n"); /* Assimp would refuse */
    assert_contains(trace_file(".obj", "v 0 0 zero\n", NULL),
                    "at line 1, byte 0: expected a vertex's z");
}

static void scenes_are_transformed_and_named(void **state) {
    (void)state;
    const char *const text = trace_file(".ac", AC3D, NULL);
    assert_contains(text, "(10 0 0)(11 0 0)(11 1 0)(10 1 0)@moved");
    assert_contains(text, "(0 1 0)(-1 1 0)(-1 0 0)(0 0 0)@mirrored");
    const char *const end = strrchr(text, '@');
    assert_true(end && !strstr(text, "line"));
}

static void extent_of(const char *ending, const char *scene, dp_extent *extent) {
    const char *const path = write_file(ending, scene, strlen(scene));
    dp_source *source = NULL;
    assert_int_equal(dp_io_open(path, NULL, &source, NULL), DP_OK);
    assert_int_equal(dp_source_extent(source, extent, NULL), DP_OK);
    dp_source_destroy(source);
    unlink(path);
}

/* glTF: a triangle at 0 that a node moves far away. */
static const char moved_far[] =
    "{\"asset\": {\"version\": \"2.0\"}, \"scene\": 0, \"scenes\": [{\"nodes\": [0]}],"
    "\"nodes\": [{\"mesh\": 0, \"translation\": [0, 5334567, 0]}],"
    "\"meshes\": [{\"primitives\": [{\"attributes\": {\"POSITION\": 0}}]}],"
    "\"accessors\": [{\"bufferView\": 0, \"componentType\": 5126, \"count\": 3, \"type\": \"VEC3\","
    "\"min\": [0, 0, 0], \"max\": [0.25, 0.7, 0]}],"
    "\"bufferViews\": [{\"buffer\": 0, \"byteLength\": 36}],"
    "\"buffers\": [{\"byteLength\": 36, \"uri\": \"data:application/octet-stream;base64,"
    "AAAAAAAAAAAAAAAAAACAPgAAAAAAAAAAAAAAADMzMz8AAAAA\"}]}";

/* AC3D: the same with the place in its coordinates. */
static const char made_far[] =
    "AC3Db\nMATERIAL \"m\" rgb 1 1 1 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 0 trans 0\n"
    "OBJECT world\nkids 1\nOBJECT poly\nname \"far\"\nnumvert 3\n0 5334567 0\n"
    "0.25 5334567 0\n0 5334567.7 0\nnumsurf 1\nSURF 0x10\nmat 0\nrefs 3\n0 0 0\n1 0 0\n2 0 0\n"
    "kids 0\n";

/* A transform to far away costs no digits; what Assimp itself has rounded is told. */
static void far_scenes_keep_what_assimp_keeps(void **state) {
    dp_extent extent;
    (void)state;
    extent_of(".gltf", moved_far, &extent);
    assert_true(extent.spacing < 1e-6);
    assert_true(extent.exact_min[1] == 5334567);
    assert_true(fabs(extent.exact_max[1] - 5334567.7) < 1e-6);
    extent_of(".ac", made_far, &extent);
    assert_true(extent.spacing == 0.5);
}

static void materials_are_colours(void **state) {
    (void)state;
    static const char scene[] =
        "AC3Db\nMATERIAL \"m\" rgb 1 0.5 0 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 0 trans 0\n"
        "OBJECT world\nkids 1\nOBJECT poly\nname \"square\"\n" QUAD;
    const char *const path = write_file(".ac", scene, strlen(scene));
    dp_source *source = NULL;
    dp_batch batch;
    assert_int_equal(dp_io_open(path, NULL, &source, NULL), DP_OK);
    assert_int_equal(dp_source_next(source, &batch, NULL), DP_OK);
    const uint32_t group = batch.groups ? batch.groups[0] : 0;
    assert_int_equal(dp_source_group_color(source, group), 0xFF8000FFu);
    assert_int_equal(dp_source_group_color(source, 77), 0);
    dp_source_destroy(source);
    unlink(path);
    assert_int_equal(dp_io_open(DP_TESTS_DIR "/fuzz/corpus/obj/plain.obj", NULL, &source, NULL),
                     DP_OK);
    assert_int_equal(dp_source_group_color(source, 0), 0);
    dp_source_destroy(source);
}

/* FBX: one triangle that says what is up. */
#define FBX(axis, sign)                                                                            \
    "; FBX 7.4.0 project file\nFBXHeaderExtension: {\nFBXVersion: 7400\n}\n"                       \
    "GlobalSettings: {\nVersion: 1000\nProperties70: {\n"                                          \
    "P: \"UpAxis\", \"int\", \"Integer\", \"\"," axis "\n"                                         \
    "P: \"UpAxisSign\", \"int\", \"Integer\", \"\"," sign "\n}\n}\n"                               \
    "Objects: {\nGeometry: 1, \"Geometry::g\", \"Mesh\" {\n"                                       \
    "Vertices: *9 {\na: 0,0,0,1,0,0,0,1,0\n}\nPolygonVertexIndex: *3 {\na: 0,1,-3\n}\n}\n"         \
    "Model: 2, \"Model::m\", \"Mesh\" {\nVersion: 232\n}\n}\n"                                     \
    "Connections: {\nC: \"OO\",2,0\nC: \"OO\",1,2\n}\n"

static void assert_up(const char *path, const char *wanted) {
    dp_source *source = NULL;
    char found[64];
    double up[3];
    assert_int_equal(dp_io_open(path, NULL, &source, NULL), DP_OK);
    const bool said = dp_source_up(source, up);
    snprintf(found, sizeof found, "%g %g %g%s", up[0], up[1], up[2], said ? "" : " assumed");
    assert_string_equal(found, wanted);
    dp_source_destroy(source);
}

static void files_say_what_is_up(void **state) {
    static const char *const scenes[][3] = {{".gltf", moved_far, "0 1 0"},
                                            {".ac", made_far, "0 1 0 assumed"},
                                            {".fbx", FBX("1", "1"), "0 1 0"},
                                            {".fbx", FBX("2", "1"), "0 0 1"},
                                            {".fbx", FBX("0", "-1"), "-1 0 0"}};
    (void)state;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        const char *const path = write_file(scenes[i][0], scenes[i][1], strlen(scenes[i][1]));
        assert_up(path, scenes[i][2]);
        unlink(path);
    }
    assert_up(DP_TESTS_DIR "/unit/files/thumbnail.3mf", "0 0 1"); /* on the printer's plate */
}

/* A tetrahedron with a picture of itself, as every slicer writes it. */
static void thumbnails_are_left_alone(void **state) {
    (void)state;
    dp_source *source = NULL;
    dp_diag diag;
    const dp_result result =
        dp_io_open(DP_TESTS_DIR "/unit/files/thumbnail.3mf", NULL, &source, &diag);
    assert_string_equal(trace_opened(result, source, &diag),
                        "(0 0 0)(0 1 0)(1 0 0)@Object_2/2\n(0 0 0)(1 0 0)(0 0 1)@Object_2/2\n"
                        "(0 0 0)(0 0 1)(0 1 0)@Object_2/2\n(1 0 0)(0 1 0)(0 0 1)@Object_2/2\n");
}

static void what_assimp_refuses_is_said_in_one_line(void **state) {
    (void)state;
    const char *const text = trace_file(".ac", "AC3Db rubbish \x01\n", NULL);
    assert_true(!strchr(text, '\n'));
    assert_contains(trace_file(".dae", "<?xml version=\"1.0\"?>\n<nothing/>\n", NULL),
                    "Assimp cannot read it: ");
    assert_contains(trace_file(".xyzzy", "hello\n", NULL), "not in a known format");
    assert_contains(trace_file(".gz", "\x1f\x8b\x08 x", NULL), "unpack it first");
    assert_contains(trace_file("", "Kaydara FBX", NULL), "FBX file: give its path, ending in .fbx");
    assert_contains(trace_file(".off", "\xef\xbb\xbf {\"asset\":", NULL),
                    "JSON text ends"); /* ours */
    assert_contains(trace_file(".ply", "<?xml?>\n<COLLADA>", NULL), "ending in .dae");
    assert_contains(trace_file(".obj", "PK\3\4", NULL), "give its path, ending in .3mf");
    assert_contains(trace_file(".fbx", "Kaydara FBX", NULL), "Assimp cannot read it: ");
    assert_contains(trace_file(".gltf", "{\"asset\":{\"version\":\"1.0\"}}", NULL),
                    "no polygons"); /* glTF 1.0, which Assimp reads */
    assert_contains(trace_file(".dae", "\xff\xfev", NULL), "this is UTF-16 text");
}

/* ------- in memory ------- */

static const char *trace_memory(const dp_memory_file *file, const dp_file_options *options) {
    dp_source *source = NULL;
    dp_diag diag;
    const dp_result result = dp_io_open_memory(file, options, &source, &diag);
    return trace_opened(result, source, &diag);
}

static void scenes_in_memory_are_those_in_files(void **state) {
    char expected[20000];
    const dp_memory_file file = {
        .data = AC3D, .size = sizeof AC3D - 1, .name = "/no/such\\folder/scene.ac"};
    (void)state;
    snprintf(expected, sizeof expected, "%s", trace_file(".ac", AC3D, NULL));
    assert_string_equal(trace_memory(&file, NULL), expected);
    const dp_memory_file nameless = {.data = AC3D, .size = sizeof AC3D - 1};
    assert_string_equal(trace_memory(&nameless, NULL), expected); /* by its content */
    const dp_memory_file cut = {.data = "AC3Db rubbish\n", .size = 14, .name = "cut.ac"};
    assert_string_equal(trace_memory(&cut, NULL), trace_file(".ac", "AC3Db rubbish\n", NULL));
    const dp_memory_file strange = {.data = "hello\n", .size = 6, .name = "x.xyzzy"};
    assert_contains(trace_memory(&strange, NULL), "not in a known format");
    static const char off[] = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    const dp_memory_file own = {.data = off, .size = sizeof off - 1};
    assert_string_equal(trace_memory(&own, NULL), "(0 0 0)(1 0 0)(0 1 0)\n");
}

/* A triangle whose coordinates are in another file. */
#define GLTF                                                                                       \
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"                   \
    "\"nodes\":[{\"mesh\":0,\"name\":\"t\"}],"                                                     \
    "\"meshes\":[{\"name\":\"t\",\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"            \
    "\"buffers\":[{\"uri\":\"parts/t.bin\",\"byteLength\":36}],"                                   \
    "\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\"byteLength\":36}],"                         \
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","       \
    "\"min\":[0,0,0],\"max\":[1,1,0]}]}"

typedef struct parts {
    float position[9];
    int open, asked;
} parts;

static bool open_part(void *user, const char *name, const void **data, size_t *size) {
    parts *const self = user;
    if (strcmp(name, "parts/t.bin") != 0) return false;
    *data = self->position;
    *size = sizeof self->position;
    self->open++;
    self->asked++;
    return true;
}

static void close_part(void *user, const void *data, size_t size) {
    parts *const self = user;
    assert_true(data == self->position && size == sizeof self->position);
    self->open--;
}

static void what_a_scene_names_is_the_application_s(void **state) {
    parts p = {.position = {0, 0, 0, 1, 0, 0, 0, 1, 0}};
    dp_memory_file file = {.data = GLTF,
                           .size = sizeof GLTF - 1,
                           .name = "scenes/t.gltf",
                           .open_beside = open_part,
                           .close_beside = close_part,
                           .user = &p};
    (void)state;
    assert_string_equal(trace_memory(&file, NULL), "(0 0 0)(1 0 0)(0 1 0)@t\n");
    assert_true(p.asked > 0 && p.open == 0);
    file.open_beside = NULL;
    assert_contains(trace_memory(&file, NULL), "which was not given with the model");
}

static void wrong_calls_are_refused(void **state) {
    dp_source *source = NULL;
    dp_diag diag;
    (void)state;
    assert_int_equal(dp_io_open("/nonexistent.fbx", NULL, &source, &diag), DP_ERR_IO);
    assert_int_equal(dp_io_open(NULL, NULL, &source, &diag), DP_ERR_ARGUMENT);
    assert_string_equal(diag.message, "dp_io_open: path is NULL");
    assert_int_equal(dp_io_open("x", NULL, NULL, NULL), DP_ERR_ARGUMENT);
    assert_int_equal(dp_io_open_memory(NULL, NULL, &source, &diag), DP_ERR_ARGUMENT);
    assert_string_equal(diag.message, "dp_io_open_memory: file or its data is NULL");
    assert_int_equal(dp_io_open_memory(&(dp_memory_file){0}, NULL, NULL, NULL), DP_ERR_ARGUMENT);
    assert_int_equal(dp_io_open_memory(&(dp_memory_file){0}, NULL, &source, &diag), DP_ERR_FORMAT);
    const dp_file_options options = {.format = DP_FORMAT_OBJ};
    assert_contains(trace_file(".ac", AC3D, &options), "no polygons"); /* a named format is final */
}

static int stop_at_end(void *user, double fraction) {
    ++*(int *)user;
    return fraction == 1;
}

static void reading_is_stopped(void **state) {
    int calls = 0;
    const dp_file_options options = {.progress = stop_at_end, .user = &calls};
    (void)state;
    assert_contains(trace_file(".ac", AC3D, &options), "cancelled");
    assert_true(calls > 0);
}

/* The n-th allocation fails; Assimp's own are not ours to count. */
static int until_failure;
static void *failing_alloc(size_t size, void *user) {
    (void)user;
    return until_failure-- ? malloc(size) : NULL;
}
static void *failing_realloc(void *block, size_t size, void *user) {
    (void)user;
    return until_failure-- ? realloc(block, size) : NULL;
}
static void failing_free(void *block, void *user) {
    (void)user;
    free(block);
}

static void failing_allocations_are_reported(void **state) {
    const dp_allocator memory = {failing_alloc, failing_realloc, failing_free, NULL};
    const dp_file_options options = {.allocator = &memory};
    int failures = 0;
    (void)state;
    for (int n = 0; n < 100; n++) {
        until_failure = n;
        const char *const text = trace_file(".ac", AC3D, &options);
        if (until_failure >= 0) break;
        if (strstr(text, "out of memory"))
            failures++;
        else
            assert_contains(text, "@moved"); /* an array that could not be cut to size */
    }
    assert_true(failures > 5 && until_failure >= 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(own_formats_come_through_own_readers),
        cmocka_unit_test(scenes_are_transformed_and_named),
        cmocka_unit_test(far_scenes_keep_what_assimp_keeps),
        cmocka_unit_test(materials_are_colours),
        cmocka_unit_test(files_say_what_is_up),
        cmocka_unit_test(thumbnails_are_left_alone),
        cmocka_unit_test(what_assimp_refuses_is_said_in_one_line),
        cmocka_unit_test(scenes_in_memory_are_those_in_files),
        cmocka_unit_test(what_a_scene_names_is_the_application_s),
        cmocka_unit_test(wrong_calls_are_refused),
        cmocka_unit_test(reading_is_stopped),
        cmocka_unit_test(failing_allocations_are_reported),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
