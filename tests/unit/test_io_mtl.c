/* io/mtl: the colours of an OBJ's materials, where libraries are sought, and their errors. */
#include "reading.h"

#include "io/mtl.h"

#include <sys/stat.h>

/* The colour of one material of a library. */
static uint32_t color_in(const char *library, const char *material) {
    const dp_allocator memory = dp_allocator_resolve(NULL);
    dp_materials m;
    dp_stream *stream = NULL;
    uint16_t number;
    assert_int_equal(
        dp_stream_open_memory(library, strlen(library), 2 * DP_STREAM_AHEAD, NULL, &stream, NULL),
        DP_OK);
    dp_materials_init(&m, &memory);
    assert_true(dp_read_mtl(stream, &m));
    assert_true(dp_materials_find(&m, material, &number));
    const uint32_t color = dp_materials_color(&m, number);
    dp_materials_destroy(&m);
    dp_stream_close(stream);
    return color;
}

static void kd_is_the_colour(void **state) {
    (void)state;
    assert_int_equal(color_in("newmtl a\nKd 1 0.5 0\nnewmtl b\nKa 0 0 0\nKd 0 0 1\n", "a"),
                     0xFF8000FF);
    assert_int_equal(color_in("newmtl a\nKd 1 0.5 0\nnewmtl b\nKa 0 0 0\nKd 0 0 1\n", "b"),
                     0x0000FFFF);
    assert_int_equal(
        color_in("\xef\xbb\xbfnewmtl dark  wood \r\n\tKd\t0.2 \\\n .4 6e-1 # brown\r\n",
                 "dark  wood"),
        0x336699FF);
    assert_int_equal(color_in("newmtl a\rKd 1\r", "a"), 0xFFFFFFFF); /* one number is grey */
    assert_int_equal(color_in("newmtl a\nKd 7 -2 1e999\n", "a"), 0xFF00FFFF);
    assert_int_equal(color_in("newmtl a\nKd 0 0 0", "a"), 0x000000FF); /* black is a colour */
    assert_int_equal(color_in("NEWMTL a\nKD 1 1 1\nnewmtl a\nkd 1 0 0\n", "a"),
                     0xFF0000FF); /* the last one holds */
}

static void what_is_broken_has_no_colour(void **state) {
    static const char *const bodies[] = {"",
                                         "Kd\n",
                                         "Kd 1 1\n",
                                         "Kd red\n",
                                         "Kd nan 0 0\n",
                                         "Kd 1 x 1\n",
                                         "Kd spectral a.rfl 1\n",
                                         "Kd xyz 1 1 1\n",
                                         "Kdx 1 1 1\n",
                                         "map_Kd a.png\n",
                                         "newmtl b\nKd 1 1 1\n",
                                         "Kd 1\x01 1 1\n"};
    (void)state;
    for (size_t i = 0; i < sizeof bodies / sizeof *bodies; i++) {
        char library[100];
        snprintf(library, sizeof library, "newmtl a\n%s", bodies[i]);
        assert_int_equal(color_in(library, "a"), 0);
    }
    assert_int_equal(color_in("", "a"), 0);
    assert_int_equal(color_in("Kd 1 1 1\n", ""), 0); /* before any material */
}

/* ------- with a model ------- */

#define TRIANGLES "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

static char folder[300];

static void put_file(const char *name, const char *content) {
    char path[700];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *const file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(content, 1, strlen(content), file), strlen(content));
    fclose(file);
}

static int make_folder(void **state) {
    (void)state;
    temporary_name(folder, sizeof folder, "mtl");
    return mkdtemp(folder) ? 0 : -1;
}

static int drop_folder(void **state) {
    static const char *const names[] = {"model.obj",     "red.mtl", "two words.mtl", "blue.mtl",
                                        "lib/green.mtl", "lib",     "pipe",          "-"};
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char path[700];
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        remove(path);
    }
    return rmdir(folder);
}

static dp_source *open_model(const char *content) {
    char path[700];
    dp_source *source = NULL;
    put_file("model.obj", content);
    snprintf(path, sizeof path, "%s/model.obj", folder);
    assert_int_equal(dp_source_open(path, NULL, &source, NULL), DP_OK);
    return source;
}

/* The colour of the first face's group, and whether there is a remark. */
static uint32_t color_of(const char *content, bool remarked) {
    dp_source *const source = open_model(content);
    const uint32_t color = dp_source_group_color(source, 0);
    assert_int_equal(dp_source_color_remark(source) != NULL, remarked);
    dp_source_destroy(source);
    return color;
}

static void libraries_lie_beside_the_model(void **state) {
    char path[700], text[1000];
    (void)state;
    put_file("red.mtl", "newmtl m\nKd 1 0 0\n");
    put_file("two words.mtl", "newmtl m\nKd 0 1 1\n");
    put_file("blue.mtl", "newmtl n\nKd 0 0 1\n");
    put_file("-", "newmtl m\nKd 1 1 0\n");
    snprintf(path, sizeof path, "%s/lib", folder);
    assert_int_equal(mkdir(path, 0700), 0);
    put_file("lib/green.mtl", "newmtl m\nKd 0 1 0\n");
    assert_int_equal(color_of("mtllib red.mtl\nusemtl m\n" TRIANGLES "f 1 2 3\n", false),
                     0xFF0000FF);
    assert_int_equal(
        color_of("mtllib two words.mtl\r\nusemtl m\r\n" TRIANGLES "f 1 2 3\r\n", false),
        0x00FFFFFF);
    assert_int_equal(color_of("mtllib lib\\green.mtl\nusemtl m\n" TRIANGLES "f 1 2 3\n", false),
                     0x00FF00FF);
    assert_int_equal(color_of("mtllib red.mtl blue.mtl\nusemtl n\n" TRIANGLES "f 1 2 3\n", false),
                     0x0000FFFF);
    assert_int_equal(color_of("mtllib -\nusemtl m\n" TRIANGLES "f 1 2 3\n", false), 0xFFFF00FF);
    assert_int_equal(color_of("usemtl m\n" TRIANGLES "f 1 2 3\nmtllib red.mtl\n", false),
                     0xFF0000FF); /* named late */
    assert_int_equal(color_of("mtllib red.mtl\nusemtl other\n" TRIANGLES "f 1 2 3\n", false), 0);
    assert_int_equal(color_of("mtllib red.mtl\n" TRIANGLES "f 1 2 3\n", false), 0);
    snprintf(text, sizeof text, "mtllib %s/red.mtl\nusemtl m\n" TRIANGLES "f 1 2 3\n", folder);
    assert_int_equal(color_of(text, false), 0xFF0000FF);
}

static void groups_have_their_material_s_colour(void **state) {
    (void)state;
    dp_source *const source = open_model("mtllib red.mtl blue.mtl\n" TRIANGLES
                                         "o a\nf 1 2 3\nusemtl m\nf 1 2 3\nusemtl n\nf 1 2 3\n"
                                         "o b\nf 1 2 3\nusemtl m\nf 1 2 3\nusemtl none\nf 1 2 3\n");
    static const uint32_t wanted[] = {0, 0xFF0000FF, 0x0000FFFF, 0x0000FFFF, 0xFF0000FF, 0, 0};
    for (uint32_t g = 0; g < 7; g++) assert_int_equal(dp_source_group_color(source, g), wanted[g]);
    assert_string_equal(dp_source_group_name(source, 3), "b/n");
    dp_source_destroy(source);
}

static void missing_libraries_are_remarked(void **state) {
    char path[700];
    (void)state;
    assert_int_equal(color_of("mtllib gone.mtl\nusemtl m\n" TRIANGLES "f 1 2 3\n", true), 0);
    assert_int_equal(color_of("mtllib gone.mtl red.mtl\nusemtl m\n" TRIANGLES "f 1 2 3\n", true),
                     0xFF0000FF);
    assert_int_equal(color_of("mtllib lib\nusemtl m\n" TRIANGLES "f 1 2 3\n", true), 0);
    assert_int_equal(color_of("mtllib\nmtllib \n" TRIANGLES "f 1 2 3\n", false), 0);
    snprintf(path, sizeof path, "%s/pipe", folder);
    assert_int_equal(mkfifo(path, 0600), 0);
    assert_int_equal(color_of("mtllib pipe\nusemtl m\n" TRIANGLES "f 1 2 3\n", true),
                     0); /* and it was not waited for */
    dp_source *const source = open_model("mtllib go\x1bne.mtl\n" TRIANGLES "f 1 2 3\n");
    assert_contains(dp_source_color_remark(source), "no colours from go?ne.mtl: ");
    dp_source_destroy(source);
    assert_null(dp_source_color_remark(NULL));
    /* what comes from memory has no folder */
    assert_trace("mtllib gone.mtl\nusemtl m\n" TRIANGLES "f 1 2 3\n", "(0 0 0)(1 0 0)(0 1 0)@m\n");
}

static void long_names_are_cut_alike(void **state) {
    char material[401], text[2000];
    (void)state;
    memset(material, 'x', 400);
    material[400] = 0;
    snprintf(text, sizeof text, "newmtl %s\nKd 1 0 0\n", material);
    put_file("red.mtl", text);
    snprintf(text, sizeof text, "mtllib red.mtl\nusemtl %s\n" TRIANGLES "f 1 2 3\n", material);
    assert_int_equal(color_of(text, false), 0xFF0000FF);
    memset(text, 'y', sizeof text - 1);
    memcpy(text, "mtllib ", 7);
    memcpy(text + sizeof text - 60, ".mtl\n" TRIANGLES "f 1 2 3\n",
           strlen(".mtl\n" TRIANGLES "f 1 2 3\n") + 1);
    assert_int_equal(color_of(text, true), 0);
}

/* ------- memory ------- */

typedef struct ration {
    int left;
} ration;

static void *give(size_t size, void *user) {
    return ((ration *)user)->left-- > 0 ? malloc(size) : NULL;
}
static void *give_again(void *block, size_t size, void *user) {
    return ((ration *)user)->left-- > 0 ? realloc(block, size) : NULL;
}
static void take(void *block, void *user) {
    (void)user;
    free(block);
}

static void memory_may_run_out(void **state) {
    char path[700];
    dp_result result = DP_ERR_MEMORY;
    (void)state;
    put_file("red.mtl", "newmtl m\nKd 1 0 0\n");
    dp_source_destroy(
        open_model("mtllib red.mtl\nusemtl m\n" TRIANGLES "f 1 2 3\nusemtl n\nf 1 2 3\n"));
    snprintf(path, sizeof path, "%s/model.obj", folder);
    for (int n = 0; result; n++) {
        ration r = {n};
        const dp_allocator allocator = {give, give_again, take, &r};
        dp_source *source = NULL;
        result = dp_source_open(path, &(dp_file_options){.allocator = &allocator}, &source, NULL);
        assert_true((result == DP_OK || result == DP_ERR_MEMORY) && n < 1000);
        if (!result) assert_int_equal(dp_source_group_color(source, 0), 0xFF0000FF);
        dp_source_destroy(source);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kd_is_the_colour),
        cmocka_unit_test(what_is_broken_has_no_colour),
        cmocka_unit_test(libraries_lie_beside_the_model),
        cmocka_unit_test(groups_have_their_material_s_colour),
        cmocka_unit_test(missing_libraries_are_remarked),
        cmocka_unit_test(long_names_are_cut_alike),
        cmocka_unit_test(memory_may_run_out),
    };
    return cmocka_run_group_tests(tests, make_folder, drop_folder);
}
