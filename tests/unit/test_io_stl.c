/* io/stl: both kinds, solids as groups, batches, and errors. */
#include "reading.h"

#define FACET(a, b, c)                                                                             \
    "facet normal 0 0 1\n outer loop\n  vertex " a "\n  vertex " b "\n  vertex " c                 \
    "\n endloop\nendfacet\n"
#define FIRST  FACET("0 0 0", "1 0 0", "0 1 0")
#define SECOND FACET("0 0 1", "1e0 .0 1.", "-0.5 1 1")

static void put_triangle(bytes *to, float z) {
    for (int i = 0; i < 2; i++) put_float(to, 0);
    put_float(to, 1);
    for (int c = 0; c < 3; c++) put_float(to, c == 1), put_float(to, c == 2), put_float(to, z);
    put(to, 0xabcd, 2);
}

static bytes binary(const char *title, uint32_t announced, int triangles) {
    bytes file = {.size = 80};
    memcpy(file.data, title, strlen(title));
    put(&file, announced, 4);
    for (int i = 0; i < triangles; i++) put_triangle(&file, (float)i);
    return file;
}

static const char *trace_stl(const bytes *file) {
    return trace_bytes(file->data, file->size, "a.stl", DP_FORMAT_AUTO);
}

static void ascii_is_read(void **state) {
    (void)state;
    assert_trace("solid a b \n" FIRST SECOND "endsolid a b\n",
                 "(0 0 0)(1 0 0)(0 1 0)@a b\n(0 0 1)(1 0 1)(-0.5 1 1)@a b\n");
    assert_trace(
        "SOLID\r\nFacet Normal nan -nan(ind) 1.#INF\r\nouter loop vertex 0 0 0 vertex 1 0 0 "
        "VERTEX 0 1 nan endloop endfacet ENDSOLID",
        "(0 0 0)(1 0 0)(0 1 nan)\n");
    assert_trace("\xef\xbb\xbfsolid m\n" FIRST "endsolid\n", "(0 0 0)(1 0 0)(0 1 0)@m\n");
}

static void solids_are_groups(void **state) {
    (void)state;
    assert_trace("solid left\n" FIRST "endsolid left\nsolid right\n" FIRST
                 "endsolid\nsolid left\n" FIRST "endsolid\nsolid\n" FIRST "endsolid\n",
                 "(0 0 0)(1 0 0)(0 1 0)@left\n(0 0 0)(1 0 0)(0 1 0)@right\n"
                 "(0 0 0)(1 0 0)(0 1 0)@left\n(0 0 0)(1 0 0)(0 1 0)\n");
}

static void broken_ascii_is_told_with_its_line(void **state) {
    (void)state;
    assert_contains(trace_text("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0"),
                    "at line 4, byte 0: the file ends where a coordinate (triangle 0)");
    assert_contains(trace_text("solid a\n" FACET("0 0 0", "1 x 0", "0 1 0") "endsolid"),
                    "at line 5, byte 0: expected a coordinate (triangle 0), found `x`");
    assert_contains(
        trace_text("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                   "vertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n"),
        "at line 7, byte 0: expected `endloop` after three vertices");
    assert_contains(trace_text("solid a\n" FIRST "facett\n"), "found `facett`");
    assert_contains(trace_text("solid a\nendsolid a\n"), "without facets");
    assert_contains(trace_text("solid"), "bad file content");
}

/* Many programs leave the last line out. */
static void a_missing_end_is_remarked(void **state) {
    static const char *const texts[] = {"solid a\n" FIRST, "solid a\n" FIRST "endsolid a\n"};
    (void)state;
    for (int i = 0; i < 2; i++) {
        dp_source *source = NULL;
        dp_batch batch;
        const dp_memory_file file = {.data = texts[i], .size = strlen(texts[i])};
        assert_int_equal(dp_source_open_memory(&file, NULL, &source, NULL), DP_OK);
        assert_int_equal(dp_source_next(source, &batch, NULL), DP_OK);
        assert_int_equal(batch.polygon_count, 1);
        if (i)
            assert_null(dp_source_remark(source));
        else
            assert_contains(dp_source_remark(source), "without its last `endsolid`");
        assert_null(dp_source_color_remark(source));
        dp_source_destroy(source);
    }
}

static void binary_is_read(void **state) {
    (void)state;
    const bytes file = binary("title", 2, 2);
    assert_string_equal(trace_stl(&file), "(0 0 0)(1 0 0)(0 1 0)\n(0 0 1)(1 0 1)(0 1 1)\n");
    const bytes solid = binary("solid but binary", 1, 1);
    assert_string_equal(trace_bytes(solid.data, solid.size, NULL, DP_FORMAT_AUTO),
                        "(0 0 0)(1 0 0)(0 1 0)\n");
    bytes more = binary("more behind the triangles", 1, 1);
    put_text(&more, "trailer");
    assert_string_equal(trace_stl(&more), "(0 0 0)(1 0 0)(0 1 0)\n");
    const bytes padded = binary("solid with a trailer", 1, 3);
    assert_string_equal(trace_stl(&padded), "(0 0 0)(1 0 0)(0 1 0)\n");
}

static void broken_binary_is_told_with_its_offset(void **state) {
    (void)state;
    bytes cut = binary("cut", 3, 2);
    assert_contains(trace_stl(&cut),
                    "byte 184: binary STL that announces 3 triangles has bytes for 2");
    cut.size -= 49;
    assert_contains(trace_stl(&cut), "byte 135: ");
    const bytes huge = binary("huge", UINT32_MAX, 1);
    assert_contains(trace_stl(&huge), "announces 4294967295 triangles has bytes for 1");
    const bytes none = binary("none", 0, 0);
    assert_contains(trace_stl(&none), "announces no triangles");
    const bytes few = {.data = {1, 2, 3}, .size = 3};
    assert_contains(trace_stl(&few), "under 84 bytes");
}

/* More than one batch, twice, from a file. */
static void batches_follow_each_other(void **state) {
    const uint32_t count = 20000;
    uint8_t *const data = calloc(84 + 50 * count, 1);
    bytes record = {.size = 0};
    (void)state;
    assert_non_null(data);
    for (int i = 0; i < 4; i++) data[80 + i] = (uint8_t)(count >> 8 * i);
    for (uint32_t i = 0; i < count; i++) {
        record.size = 0;
        put_triangle(&record, (float)i);
        memcpy(data + 84 + 50 * (size_t)i, record.data, 50);
    }
    const char *const path = write_file(".x", data, 84 + 50 * (size_t)count);
    dp_source *source = NULL;
    assert_int_equal(dp_source_open(path, NULL, &source, NULL), DP_OK);
    for (int pass = 0; pass < 3; pass++) {
        uint32_t seen = 0;
        dp_batch batch;
        while (!dp_source_next(source, &batch, NULL) && batch.polygon_count) {
            assert_true(!batch.stable && !batch.indices && !batch.groups);
            for (size_t i = 0; i < batch.polygon_count; i++, seen++)
                assert_true(batch.positions[9 * i + 2] == (float)seen);
            if (pass == 1) break; /* rewound in the middle */
        }
        assert_int_equal(dp_source_next(source, &batch, NULL), DP_OK); /* the end stays the end */
        if (pass != 1) assert_int_equal(seen, count);
        assert_int_equal(dp_source_rewind(source, NULL), DP_OK);
    }
    dp_source_destroy(source);
    unlink(path);
    free(data);
}

static void a_failure_is_final_until_rewound(void **state) {
    static const char text[] = "solid a\n" FIRST "rubbish\n";
    (void)state;
    dp_stream *stream = NULL;
    dp_source *source = NULL;
    dp_diag diag;
    dp_batch batch;
    dp_stream_open_memory(text, sizeof text - 1, 2048, NULL, &stream, NULL);
    assert_int_equal(dp_read_stream(stream, NULL, DP_FORMAT_STL, &source, NULL), DP_OK);
    for (int i = 0; i < 4; i++) {
        assert_int_equal(dp_source_next(source, &batch, &diag), DP_ERR_FORMAT);
        assert_int_equal(diag.line, 9);
        if (i == 1) assert_int_equal(dp_source_rewind(source, NULL), DP_OK);
    }
    dp_source_destroy(source);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ascii_is_read),
        cmocka_unit_test(solids_are_groups),
        cmocka_unit_test(broken_ascii_is_told_with_its_line),
        cmocka_unit_test(a_missing_end_is_remarked),
        cmocka_unit_test(binary_is_read),
        cmocka_unit_test(broken_binary_is_told_with_its_offset),
        cmocka_unit_test(batches_follow_each_other),
        cmocka_unit_test(a_failure_is_final_until_rewound),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
