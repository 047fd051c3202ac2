/* Models written as PLY, STL and OBJ, and read with the library's own readers: the same polygons,
 * the same bits. What cannot be written is left out or refused; files are complete or untouched. */
#define _XOPEN_SOURCE 700 /* mkdtemp */
#include "temporary.h"

#include <drypoint/io.h>
#include <drypoint/shapes.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static char directory[300];
static char path[340];

static int enter_directory(void **state) {
    (void)state;
    temporary_name(directory, sizeof directory, "mesh");
    return mkdtemp(directory) ? 0 : -1;
}

static int leave_directory(void **state) {
    (void)state;
    unlink(path);
    return rmdir(directory); /* fails when anything was left behind */
}

static const char *name_file(const char *ending) {
    snprintf(path, sizeof path, "%s/model%s", directory, ending);
    return path;
}

/* Corners of all polygons one after the other, and each polygon's number of corners. */
typedef struct content {
    float (*corners)[3];
    uint32_t *sizes;
    size_t corner_count, polygon_count;
    size_t corner_room, polygon_room;
} content;

static void *make_room(void *block, size_t *room, size_t need, size_t size) {
    if (need <= *room) return block;
    *room = 2 * need;
    block = realloc(block, *room * size);
    assert_non_null(block);
    return block;
}

static void add_batch(content *c, const dp_batch *b) {
    c->corners = make_room(c->corners, &c->corner_room, c->corner_count + b->corner_count,
                           sizeof *c->corners);
    c->sizes = make_room(c->sizes, &c->polygon_room, c->polygon_count + b->polygon_count,
                         sizeof *c->sizes);
    for (size_t i = 0; i < b->polygon_count; i++) {
        const size_t first = b->firsts ? b->firsts[i] : 3 * i;
        const size_t last = b->firsts ? b->firsts[i + 1] : 3 * i + 3;
        c->sizes[c->polygon_count++] = (uint32_t)(last - first);
        for (size_t k = first; k < last; k++) {
            const uint32_t v = b->indices ? b->indices[k] : (uint32_t)k;
            assert_true(v < b->vertex_count);
            memcpy(c->corners[c->corner_count++],
                   (const char *)b->positions + v * b->position_stride, 12);
        }
    }
}

static content read_source(dp_source *source) {
    content c = {0};
    dp_batch batch;
    if (dp_source_rewindable(source)) assert_int_equal(dp_source_rewind(source, NULL), DP_OK);
    for (;;) {
        assert_int_equal(dp_source_next(source, &batch, NULL), DP_OK);
        if (!batch.polygon_count) return c;
        add_batch(&c, &batch);
    }
}

static content read_file(void) {
    dp_source *source = NULL;
    dp_diag diag = {0};
    const dp_result result = dp_source_open(path, NULL, &source, &diag);
    if (result) fail_msg("%s: line %llu: %s", path, (unsigned long long)diag.line, diag.message);
    const content c = read_source(source);
    dp_source_destroy(source);
    return c;
}

static void forget(content *c) {
    free(c->corners);
    free(c->sizes);
}

static void assert_same(const content *a, const content *b) {
    assert_int_equal(a->polygon_count, b->polygon_count);
    assert_int_equal(a->corner_count, b->corner_count);
    assert_memory_equal(a->sizes, b->sizes, a->polygon_count * sizeof *a->sizes);
    assert_memory_equal(a->corners, b->corners, a->corner_count * sizeof *a->corners);
}

static const struct {
    const char *ending;
    dp_mesh_file kind;
} files[] = {{".ply", DP_MESH_FILE_AUTO},
             {".ply", DP_MESH_FILE_PLY_ASCII},
             {".stl", DP_MESH_FILE_AUTO},
             {".OBJ", DP_MESH_FILE_AUTO}};
enum { FILES = sizeof files / sizeof *files, STL_FILE = 2 };

/* ---- what comes back ---- */

static void shapes_come_back(void **state) {
    (void)state;
    const dp_shape shape = {.name = "gear", .triangles = 150000, .size = 0.3};
    dp_source *source = NULL;
    assert_int_equal(dp_source_from_shape(&shape, &source, NULL), DP_OK);
    content made = read_source(source);
    for (int k = 0; k < FILES; k++) {
        dp_diag diag = {0};
        const dp_result result =
            dp_io_write_mesh(name_file(files[k].ending), files[k].kind, source, NULL, NULL, &diag);
        if (result) fail_msg("%s: %s", path, diag.message);
        content read = read_file();
        assert_same(&made, &read);
        forget(&read);
        unlink(path);
    }
    forget(&made);
    dp_source_destroy(source);
}

/* A pentagon, a quadrangle, a triangle without indices' order, and what cannot be written: an index
 * out of range, a polygon of two corners, a corner that is not finite. */
static const float positions[][4] = {{0, 0, 0, 9},  {2, 0, 0, 9},  {3, 1.1F, 0, 9},
                                     {1, 2, 0, 9},  {-1, 1, 0, 9}, {1, 0, -1e-30F, 9},
                                     {NAN, 1, 2, 9}};
static const uint32_t indices[] = {0, 1, 2, 3, 4, 4, 3, 2, 1, 5, 3, 1, 0, 1, 99, 2, 3, 0, 1, 6};
static const uint32_t firsts[] = {0, 5, 9, 12, 15, 17, 20};
static const dp_batch arrays = {.positions = positions[0],
                                .position_stride = sizeof *positions,
                                .vertex_count = 7,
                                .indices = indices,
                                .corner_count = 20,
                                .firsts = firsts,
                                .polygon_count = 6};
enum { SOUND_POLYGONS = 3, SOUND_CORNERS = 12, SOUND_TRIANGLES = 3 + 2 + 1 };

static void polygons_come_back(void **state) {
    (void)state;
    for (int k = 0; k < FILES; k++) {
        dp_source *source = NULL;
        assert_int_equal(dp_source_from_arrays(&arrays, NULL, &source, NULL), DP_OK);
        assert_int_equal(
            dp_io_write_mesh(name_file(files[k].ending), files[k].kind, source, NULL, NULL, NULL),
            DP_OK);
        content read = read_file();
        const bool stl = k == STL_FILE;
        assert_int_equal(read.polygon_count, stl ? SOUND_TRIANGLES : SOUND_POLYGONS);
        for (size_t c = 0; c < SOUND_CORNERS && !stl; c++)
            assert_memory_equal(read.corners[c], positions[indices[c]], 12);
        forget(&read);
        dp_source_destroy(source);
        unlink(path);
    }
}

/* More corners than fit the usual byte of a PLY. */
static void large_polygons_come_back(void **state) {
    (void)state;
    enum { CORNERS = 1000 };
    float(*ring)[3] = calloc(CORNERS, sizeof *ring);
    const uint32_t whole[2] = {0, CORNERS};
    assert_non_null(ring);
    for (int k = 0; k < CORNERS; k++)
        ring[k][0] = cosf(k * 0.00628F), ring[k][1] = sinf(k * 0.00628F);
    const dp_batch batch = {.positions = ring[0],
                            .vertex_count = CORNERS,
                            .corner_count = CORNERS,
                            .firsts = whole,
                            .polygon_count = 1};
    for (int k = 0; k < FILES; k++) {
        dp_source *source = NULL;
        assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
        assert_int_equal(
            dp_io_write_mesh(name_file(files[k].ending), files[k].kind, source, NULL, NULL, NULL),
            DP_OK);
        content read = read_file();
        assert_int_equal(read.polygon_count, k == STL_FILE ? CORNERS - 2 : 1);
        forget(&read);
        dp_source_destroy(source);
        unlink(path);
    }
    free(ring);
}

/* ---- sources that can be read only once ---- */

static dp_result next_once(void *user, dp_batch *batch, dp_diag *diag) {
    (void)diag;
    if (!*(bool *)user) *batch = arrays;
    *(bool *)user = true;
    return DP_OK;
}

static dp_source *once(bool *done) {
    const dp_source_callbacks callbacks = {.user = done, .next = next_once};
    dp_source *source = NULL;
    *done = false;
    assert_int_equal(dp_source_from_callbacks(&callbacks, NULL, &source, NULL), DP_OK);
    return source;
}

static void streams_become_stl_and_obj(void **state) {
    (void)state;
    bool done;
    for (int k = STL_FILE; k < FILES; k++) {
        dp_source *const source = once(&done);
        assert_int_equal(
            dp_io_write_mesh(name_file(files[k].ending), files[k].kind, source, NULL, NULL, NULL),
            DP_OK);
        content read = read_file();
        assert_int_equal(read.polygon_count, k == STL_FILE ? SOUND_TRIANGLES : SOUND_POLYGONS);
        forget(&read);
        dp_source_destroy(source);
        unlink(path);
    }
}

static void streams_do_not_become_ply(void **state) {
    (void)state;
    bool done;
    dp_diag diag = {0};
    dp_source *const source = once(&done);
    assert_int_equal(dp_io_write_mesh(name_file(".ply"), 0, source, NULL, NULL, &diag),
                     DP_ERR_UNSUPPORTED);
    assert_true(access(path, F_OK) != 0);
    dp_source_destroy(source);
}

/* ---- stopping and failing ---- */

static int stop_half_way(void *user, double fraction) {
    *(double *)user = fraction;
    return fraction > 0.5;
}

static void stopping_leaves_nothing(void **state) {
    (void)state;
    const dp_shape shape = {.name = "torus", .triangles = 400000};
    dp_source *source = NULL;
    dp_diag diag = {0};
    assert_int_equal(dp_source_from_shape(&shape, &source, NULL), DP_OK);
    for (int k = 0; k < FILES; k++) {
        double last = 0;
        assert_int_equal(dp_io_write_mesh(name_file(files[k].ending), files[k].kind, source,
                                          stop_half_way, &last, &diag),
                         DP_ERR_CANCELLED);
        assert_true(last > 0.5 && last < 0.9);
        assert_true(access(path, F_OK) != 0);
    }
    dp_source_destroy(source);
}

static dp_result fail_next(void *user, dp_batch *batch, dp_diag *diag) {
    (void)batch;
    (void)user;
    *diag = (dp_diag){.result = DP_ERR_FORMAT, .line = 7};
    strcpy(diag->message, "the source's own words");
    return DP_ERR_FORMAT;
}

static void a_failing_source_leaves_nothing(void **state) {
    (void)state;
    const dp_source_callbacks callbacks = {.next = fail_next};
    dp_source *source = NULL;
    dp_diag diag = {0};
    assert_int_equal(dp_source_from_callbacks(&callbacks, NULL, &source, NULL), DP_OK);
    assert_int_equal(dp_io_write_mesh(name_file(".obj"), 0, source, NULL, NULL, &diag),
                     DP_ERR_FORMAT);
    assert_int_equal(diag.line, 7);
    assert_string_equal(diag.message, "the source's own words");
    assert_true(access(path, F_OK) != 0);
    dp_source_destroy(source);
}

static void a_full_disk_is_an_error(void **state) {
    (void)state;
    static const dp_mesh_file kinds[] = {DP_MESH_FILE_PLY, DP_MESH_FILE_STL, DP_MESH_FILE_OBJ};
    const dp_shape shape = {.name = "cube"};
    if (access("/dev/full", W_OK)) skip();
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        dp_source *source = NULL;
        dp_diag diag = {0};
        assert_int_equal(dp_source_from_shape(&shape, &source, NULL), DP_OK);
        assert_int_equal(dp_io_write_mesh("/dev/full", kinds[k], source, NULL, NULL, &diag),
                         DP_ERR_IO);
        assert_non_null(strstr(diag.message, "No space left"));
        dp_source_destroy(source);
    }
}

static void unknown_endings_are_refused(void **state) {
    (void)state;
    const dp_shape shape = {.name = "cube"};
    dp_source *source = NULL;
    dp_diag diag = {0};
    assert_int_equal(dp_source_from_shape(&shape, &source, NULL), DP_OK);
    assert_int_equal(dp_io_write_mesh(name_file(".off"), 0, source, NULL, NULL, &diag),
                     DP_ERR_UNSUPPORTED);
    assert_int_equal(dp_io_write_mesh(NULL, 0, source, NULL, NULL, &diag), DP_ERR_ARGUMENT);
    assert_int_equal(dp_io_write_mesh(path, 0, NULL, NULL, NULL, &diag), DP_ERR_ARGUMENT);
    assert_int_equal(dp_io_write_mesh(path, (dp_mesh_file)99, source, NULL, NULL, NULL),
                     DP_ERR_ARGUMENT);
    assert_true(access(path, F_OK) != 0);
    dp_source_destroy(source);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, enter_directory, leave_directory)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(shapes_come_back),
        TEST(polygons_come_back),
        TEST(large_polygons_come_back),
        TEST(streams_become_stl_and_obj),
        TEST(streams_do_not_become_ply),
        TEST(stopping_leaves_nothing),
        TEST(a_failing_source_leaves_nothing),
        TEST(a_full_disk_is_an_error),
        TEST(unknown_endings_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
