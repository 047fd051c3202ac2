/* dp_source_open_memory: in every format, a model in memory is the same as its bytes in a file:
 * batches, names, colours, remarks, failures and drawings. Its other files come from the
 * application. */
#include "mesh/source.h"
#include "reading.h"

#include <drypoint/draw.h>
#include <drypoint/io.h>
#include <drypoint/shapes.h>

#include <dirent.h>
#include <sys/stat.h>

enum { WIDTH = 150, HEIGHT = 130 };

typedef struct content {
    uint8_t *data;
    size_t size;
} content;

static content load(const char *path) {
    FILE *const file = fopen(path, "rb");
    struct stat status;
    assert_non_null(file);
    assert_int_equal(fstat(fileno(file), &status), 0);
    const content c = {malloc((size_t)status.st_size + 1), (size_t)status.st_size};
    assert_non_null(c.data);
    assert_int_equal(fread(c.data, 1, c.size, file), c.size);
    fclose(file);
    return c;
}

/* ------- the same source ------- */

static void same_array(const void *a, const void *b, size_t size) {
    assert_int_equal(a != NULL, b != NULL);
    if (a && size) assert_memory_equal(a, b, size);
}

static void same_attribute(const dp_attribute *a, const dp_attribute *b, size_t corners) {
    assert_int_equal(a->count, b->count);
    assert_int_equal(a->stride, b->stride);
    same_array(a->values, b->values, a->count * a->stride);
    same_array(a->indices, b->indices, corners * sizeof *a->indices);
}

static void same_groups(dp_source *a, dp_source *b, const dp_batch *batch) {
    for (size_t i = 0; i < batch->polygon_count; i++) {
        const uint32_t group = batch->groups ? batch->groups[i] : 0;
        const char *const name = dp_source_group_name(a, group);
        same_array(name, dp_source_group_name(b, group), name ? strlen(name) + 1 : 0);
        assert_int_equal(dp_source_group_color(a, group), dp_source_group_color(b, group));
    }
}

static void same_batch(const dp_batch *a, const dp_batch *b) {
    assert_int_equal(a->polygon_count, b->polygon_count);
    assert_int_equal(a->vertex_count, b->vertex_count);
    assert_int_equal(a->corner_count, b->corner_count);
    assert_int_equal(a->position_stride, b->position_stride);
    assert_int_equal(a->stable, b->stable);
    same_array(a->positions, b->positions, a->vertex_count * a->position_stride);
    same_array(a->indices, b->indices, a->corner_count * sizeof *a->indices);
    same_array(a->firsts, b->firsts, (a->polygon_count + 1) * sizeof *a->firsts);
    same_array(a->groups, b->groups, a->polygon_count * sizeof *a->groups);
    same_array(a->edge_flags, b->edge_flags, a->corner_count);
    same_array(a->colors, b->colors, a->vertex_count * sizeof *a->colors);
    same_attribute(&a->normals, &b->normals, a->corner_count);
    same_attribute(&a->texcoords, &b->texcoords, a->corner_count);
}

static void same_diag(const dp_diag *a, const dp_diag *b) {
    assert_string_equal(a->message, b->message);
    assert_true(a->result == b->result && a->line == b->line && a->offset == b->offset &&
                a->item == b->item);
}

static void same_to_the_end(dp_source *a, dp_source *b) {
    for (;;) {
        dp_batch batch_a, batch_b;
        dp_diag diag_a = {0}, diag_b = {0};
        const dp_result result = dp_source_next(a, &batch_a, &diag_a);
        assert_int_equal(dp_source_next(b, &batch_b, &diag_b), result);
        same_diag(&diag_a, &diag_b);
        if (result) return;
        same_batch(&batch_a, &batch_b);
        same_groups(a, b, &batch_a);
        if (!batch_a.polygon_count) return;
    }
}

static void same_source(dp_source *a, dp_source *b) {
    const char *const remark =
        dp_source_color_remark(a); /* why a library is not there may differ */
    same_array(remark, dp_source_color_remark(b), remark ? strcspn(remark, ":") + 1 : 0);
    assert_int_equal(a->constant, b->constant);
    assert_int_equal(a->records.read != NULL, b->records.read != NULL);
    assert_true(dp_source_rewindable(a) && dp_source_rewindable(b));
    for (int round = 0; round < 2; round++) {
        same_to_the_end(a, b);
        assert_int_equal(dp_source_rewind(a, NULL), DP_OK);
        assert_int_equal(dp_source_rewind(b, NULL), DP_OK);
    }
}

static bool nothing_beside(void *user, const char *name, const void **data, size_t *size) {
    (void)user, (void)name, (void)data, (void)size;
    return false;
}

/* Both are opened by name alone and with the format given. */
static void same_opened(const char *path, content c, dp_file_format format) {
    const dp_file_options options = {.format = format};
    const dp_memory_file file = {
        .data = c.data, .size = c.size, .name = path, .open_beside = nothing_beside};
    dp_source *a, *b;
    dp_diag diag_a = {0}, diag_b = {0};
    const dp_result result = dp_source_open(path, &options, &a, &diag_a);
    assert_int_equal(dp_source_open_memory(&file, &options, &b, &diag_b), result);
    same_diag(&diag_a, &diag_b);
    if (result)
        assert_true(!a && !b);
    else
        same_source(a, b);
    dp_source_destroy(a);
    dp_source_destroy(b);
}

static void same_sample(const char *path, const char *ending, dp_file_format format) {
    const content whole = load(path);
    same_opened(path, whole, DP_FORMAT_AUTO);
    for (size_t size = 0; size <= whole.size; size += 1 + whole.size / 17) {
        const content cut = {malloc(size + 1), size}; /* so that a sanitizer sees its end */
        assert_non_null(cut.data);
        memcpy(cut.data, whole.data, size);
        const char *const cut_path = write_file(ending, cut.data, size);
        same_opened(cut_path, cut, DP_FORMAT_AUTO);
        same_opened(cut_path, cut, format);
        unlink(cut_path);
        free(cut.data);
    }
    free(whole.data);
}

static void samples_and_their_cuts_are_the_same(void **state) {
    static const char *const formats[] = {[DP_FORMAT_STL] = "stl",
                                          [DP_FORMAT_PLY] = "ply",
                                          [DP_FORMAT_OBJ] = "obj",
                                          [DP_FORMAT_OFF] = "off"};
    int count = 0;
    (void)state;
    for (int f = DP_FORMAT_STL; f <= DP_FORMAT_OFF; f++) {
        char path[600], ending[8];
        snprintf(ending, sizeof ending, ".%s", formats[f]);
        snprintf(path, sizeof path, "%s/fuzz/corpus/%s", DP_TESTS_DIR, formats[f]);
        DIR *const folder = opendir(path);
        assert_non_null(folder);
        for (struct dirent *entry; (entry = readdir(folder));) {
            if (entry->d_name[0] == '.') continue;
            snprintf(path, sizeof path, "%s/fuzz/corpus/%s/%s", DP_TESTS_DIR, formats[f],
                     entry->d_name);
            same_sample(path, ending, (dp_file_format)f);
            count++;
        }
        closedir(folder);
    }
    assert_true(count >= 16);
}

/* ------- the same drawing ------- */

static void draw(dp_source *source, uint8_t *rgba) {
    dp_context *context = NULL;
    dp_camera camera;
    dp_extent extent;
    dp_diag diag = {0};
    dp_fit fit = {0};
    assert_int_equal(dp_source_extent(source, &extent, &diag), DP_OK);
    memcpy(fit.min, extent.min, sizeof fit.min), memcpy(fit.max, extent.max, sizeof fit.max);
    assert_int_equal(dp_camera_fit(&camera, &fit), DP_OK);
    assert_int_equal(dp_context_create(&(dp_context_desc){.threads = 2}, &context, &diag), DP_OK);
    const dp_target target = {.width = WIDTH, .height = HEIGHT, .rgba = rgba};
    if (dp_draw(context, source, &camera, NULL, &target, &diag)) fail_msg("%s", diag.message);
    dp_context_destroy(context);
}

static void same_drawing(const char *path, content c) {
    static uint8_t a[WIDTH * HEIGHT * 4], b[WIDTH * HEIGHT * 4];
    const dp_memory_file file = {.data = c.data, .size = c.size};
    dp_source *source = NULL;
    assert_int_equal(dp_source_open(path, NULL, &source, NULL), DP_OK);
    draw(source, a);
    dp_source_destroy(source);
    assert_int_equal(dp_source_open_memory(&file, NULL, &source, NULL), DP_OK);
    draw(source, b);
    dp_source_destroy(source);
    assert_memory_equal(a, b, sizeof a);
}

/* A gear in each format that is written. What is streamed: test_stream.c. */
static void shapes_are_the_same_and_draw_the_same(void **state) {
    static const struct {
        dp_mesh_file kind;
        const char *ending;
    } kinds[] = {{DP_MESH_FILE_STL, ".stl"},
                 {DP_MESH_FILE_PLY, ".ply"},
                 {DP_MESH_FILE_PLY_ASCII, ".ply"},
                 {DP_MESH_FILE_OBJ, ".obj"}};
    (void)state;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        const char *const path = write_file(kinds[k].ending, "", 0);
        dp_source *shape = NULL;
        assert_int_equal(dp_source_from_shape(&(dp_shape){.name = "gear"}, &shape, NULL), DP_OK);
        assert_int_equal(dp_io_write_mesh(path, kinds[k].kind, shape, NULL, NULL, NULL), DP_OK);
        dp_source_destroy(shape);
        const content c = load(path);
        same_opened(path, c, DP_FORMAT_AUTO);
        same_drawing(path, c);
        free(c.data);
        unlink(path);
    }
}

/* ------- what lies beside ------- */

typedef struct shelf {
    const char *name, *text; /* the only file there is */
    char asked[400];
    int opened, closed;
    bool empty; /* it has no bytes, and says so with NULL */
} shelf;

static bool open_beside(void *user, const char *name, const void **data, size_t *size) {
    shelf *const self = user;
    append(self->asked, sizeof self->asked, "[%s]", name);
    if (strcmp(name, self->name) != 0) return false;
    self->opened++;
    *data = self->empty ? NULL : self->text;
    *size = self->empty ? 0 : strlen(self->text);
    return true;
}

static void close_beside(void *user, const void *data, size_t size) {
    shelf *const self = user;
    assert_true(data == (self->empty ? NULL : self->text));
    assert_int_equal(size, self->empty ? 0 : strlen(self->text));
    self->closed++;
}

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n"

/* The colour of the only face. */
static uint32_t color_beside(const char *text, shelf *s, const char *asked, const char *remark) {
    const dp_memory_file file = {.data = text,
                                 .size = strlen(text),
                                 .name = "/some/folder/model.obj",
                                 .open_beside = s ? open_beside : NULL,
                                 .close_beside = close_beside,
                                 .user = s};
    dp_source *source = NULL;
    dp_diag diag = {0};
    if (s) s->asked[0] = 0, s->opened = s->closed = 0;
    if (dp_source_open_memory(&file, NULL, &source, &diag)) fail_msg("%s", diag.message);
    if (s) {
        assert_string_equal(s->asked, asked);
        assert_int_equal(s->opened, s->closed);
    }
    const uint32_t color = dp_source_group_color(source, 0);
    const char *const said = dp_source_color_remark(source);
    assert_string_equal(said ? said : "", remark);
    dp_source_destroy(source);
    return color;
}

static void libraries_are_the_application_s(void **state) {
    shelf s = {.name = "lib/red.mtl", .text = "newmtl m\nKd 1 0 0\n"};
    (void)state;
    assert_int_equal(color_beside("mtllib lib/red.mtl\n" TRIANGLE, &s, "[lib/red.mtl]", ""),
                     0xFF0000FF);
    assert_int_equal(color_beside("mtllib lib\\red.mtl\n" TRIANGLE, &s, "[lib/red.mtl]", ""),
                     0xFF0000FF);
    assert_int_equal(color_beside("mtllib a.mtl lib/red.mtl\n" TRIANGLE, &s,
                                  "[a.mtl lib/red.mtl][a.mtl][lib/red.mtl]",
                                  "no colours from a.mtl: it was not given with the model"),
                     0xFF0000FF);
    assert_int_equal(color_beside("mtllib \n" TRIANGLE, &s, "", ""), 0);
    s.empty = true;
    assert_int_equal(color_beside("mtllib lib/red.mtl\n" TRIANGLE, &s, "[lib/red.mtl]", ""), 0);
}

/* Though one lies where the name says. */
static void no_folder_is_looked_into(void **state) {
    char text[400];
    (void)state;
    const char *const path = write_file(".mtl", "newmtl m\nKd 1 0 0\n", 18);
    snprintf(text, sizeof text, "mtllib %s\n" TRIANGLE, path);
    assert_int_equal(color_beside(text, NULL, "", ""), 0);
    unlink(path);
}

/* Each allocation fails once: what was opened is closed all the same. */
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
    static const char text[] = "mtllib red.mtl\n" TRIANGLE;
    const dp_allocator memory = {failing_alloc, failing_realloc, failing_free, NULL};
    const dp_file_options options = {.allocator = &memory};
    int failures = 0;
    (void)state;
    for (int n = 0; n < 100; n++) {
        shelf s = {.name = "red.mtl", .text = "newmtl m\nKd 1 0 0\n"};
        const dp_memory_file file = {.data = text,
                                     .size = sizeof text - 1,
                                     .open_beside = open_beside,
                                     .close_beside = close_beside,
                                     .user = &s};
        dp_source *source = NULL;
        dp_diag diag = {0};
        until_failure = n;
        const dp_result result = dp_source_open_memory(&file, &options, &source, &diag);
        assert_true(result == DP_OK || result == DP_ERR_MEMORY);
        assert_int_equal(s.opened, s.closed);
        failures += result == DP_ERR_MEMORY;
        if (!result) assert_int_equal(dp_source_group_color(source, 0), 0xFF0000FF);
        dp_source_destroy(source);
        if (until_failure >= 0) break;
    }
    assert_true(failures > 5 && until_failure >= 0);
}

/* ------- calls ------- */

static void wrong_calls_are_refused(void **state) {
    dp_source *source = NULL;
    dp_diag diag = {0};
    (void)state;
    assert_int_equal(dp_source_open_memory(NULL, NULL, &source, &diag), DP_ERR_ARGUMENT);
    assert_int_equal(dp_source_open_memory(&(dp_memory_file){.size = 1}, NULL, &source, &diag),
                     DP_ERR_ARGUMENT);
    assert_int_equal(dp_source_open_memory(&(dp_memory_file){0}, NULL, NULL, &diag),
                     DP_ERR_ARGUMENT);
    assert_int_equal(dp_source_open_memory(&(dp_memory_file){0}, NULL, &source, &diag),
                     DP_ERR_FORMAT);
    assert_contains(diag.message, "the file is empty");
    const dp_memory_file scene = {.data = "Kaydara FBX", .size = 11, .name = "part.fbx"};
    assert_int_equal(dp_source_open_memory(&scene, NULL, &source, &diag), DP_ERR_UNSUPPORTED);
    assert_contains(diag.message, "convert it to STL, PLY, OBJ or OFF");
    assert_null(source);
}

static int stop(void *user, double fraction) {
    *(double *)user = fraction;
    return 1;
}

static void reading_is_stopped(void **state) {
    double fraction = -1;
    const dp_file_options options = {.progress = stop, .user = &fraction};
    const dp_memory_file file = {.data = TRIANGLE, .size = sizeof TRIANGLE - 1};
    dp_source *source = NULL;
    (void)state;
    assert_int_equal(dp_source_open_memory(&file, &options, &source, NULL), DP_ERR_CANCELLED);
    assert_true(fraction == 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_and_their_cuts_are_the_same),
        cmocka_unit_test(shapes_are_the_same_and_draw_the_same),
        cmocka_unit_test(libraries_are_the_application_s),
        cmocka_unit_test(no_folder_is_looked_into),
        cmocka_unit_test(failing_allocations_are_reported),
        cmocka_unit_test(wrong_calls_are_refused),
        cmocka_unit_test(reading_is_stopped),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
