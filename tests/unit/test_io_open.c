/* dp_source_open: formats are detected by content before name; every truncation of every sample;
 * every allocation that fails. */
#include "reading.h"

#include <dirent.h>

#define OBJ "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
#define OFF "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
#define STL                                                                                        \
    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n" \
    "endfacet\nendsolid a\n"
#define PLY                                                                                        \
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"                \
    "property float z\nelement face 1\nproperty list uchar int vertex_index\nend_header\n"         \
    "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"

static const char *trace_file(const char *ending, const char *content, dp_file_format format) {
    const char *const path = write_file(ending, content, strlen(content));
    const dp_file_options options = {.format = format};
    dp_source *source = NULL;
    dp_diag diag;
    const dp_result result = dp_source_open(path, &options, &source, &diag);
    const char *const text = trace_opened(result, source, &diag);
    if (strstr(text, path)) fail_msg("the message names the file: %s", text);
    unlink(path);
    return text;
}

static void content_wins_over_the_name(void **state) {
    static const char *const contents[] = {OBJ, OFF, STL, PLY};
    static const char *const endings[] = {".obj", ".off", ".stl", ".ply", ".STL", ".jpg", "", "."};
    (void)state;
    for (size_t c = 0; c < 4; c++)
        for (size_t e = 0; e < sizeof endings / sizeof *endings; e++)
            assert_string_equal(trace_file(endings[e], contents[c], DP_FORMAT_AUTO),
                                c == 2 ? "(0 0 0)(1 0 0)(0 1 0)@a\n" : "(0 0 0)(1 0 0)(0 1 0)\n");
}

static void a_byte_order_mark_is_passed_over(void **state) {
    (void)state;
    assert_trace("\xef\xbb\xbf" OBJ, "(0 0 0)(1 0 0)(0 1 0)\n");
    assert_trace("\xef\xbb\xbf" OFF, "(0 0 0)(1 0 0)(0 1 0)\n");
    assert_trace("\xef\xbb\xbf" STL, "(0 0 0)(1 0 0)(0 1 0)@a\n");
    assert_trace("\xef\xbb\xbf" PLY, "(0 0 0)(1 0 0)(0 1 0)\n");
}

static void the_name_decides_where_content_does_not(void **state) {
    static const char strange[] = "call other.obj\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    (void)state;
    assert_contains(trace_file("", strange, DP_FORMAT_AUTO), "not supported");
    assert_string_equal(trace_file(".Obj", strange, DP_FORMAT_AUTO), "(0 0 0)(1 0 0)(0 1 0)\n");
    assert_string_equal(trace_file("", strange, DP_FORMAT_OBJ), "(0 0 0)(1 0 0)(0 1 0)\n");
    assert_contains(trace_file(".ply", "rubbish\n", DP_FORMAT_AUTO), "expected `ply`");
    assert_contains(trace_file(".off", "rubbish\n", DP_FORMAT_AUTO), "line 1");
    assert_contains(trace_file(".stl", "rubbish\n", DP_FORMAT_AUTO), "neither ASCII STL");
    assert_contains(trace_file(".stl", OBJ, DP_FORMAT_STL), "neither ASCII STL");
}

static void unknown_content_is_refused(void **state) {
    (void)state;
    assert_contains(
        trace_file(".txt", "hello\n", DP_FORMAT_AUTO),
        "convert it to STL, PLY, OBJ or OFF, or, if it is a model, give a file whose name");
    assert_contains(trace_file("", "v\nfrom 0 0 1\n", DP_FORMAT_AUTO), "not supported"); /* NFF */
    assert_contains(trace_file(".ply", "\x1f\x8b\x08 x", DP_FORMAT_AUTO), "unpack it first");
    assert_contains(trace_file(".obj", "Kaydara FBX", DP_FORMAT_AUTO), "FBX");
    assert_contains(trace_file(".stl", "", DP_FORMAT_AUTO),
                    "bad file content at line 0, byte 0: the file is empty");
    assert_contains(trace_file("", "", DP_FORMAT_AUTO), "empty");
}

static void utf16_is_named(void **state) {
    static const char *const encodings[] = {"-f UTF-16 -t UTF-8", "-f UTF-16 -t UTF-8",
                                            "-f UTF-16LE -t UTF-8", "-f UTF-16BE -t UTF-8"};
    (void)state;
    for (int kind = 0; kind < 4; kind++) {
        const bool big = kind % 2, mark = kind < 2;
        char wide[2 * sizeof OBJ + 2];
        dp_source *source = NULL;
        dp_diag diag;
        memcpy(wide, big ? "\xfe\xff" : "\xff\xfe", 2);
        for (size_t i = 0; i + 1 < sizeof OBJ; i++)
            wide[2 + 2 * i + big] = OBJ[i], wide[3 + 2 * i - big] = 0;
        const size_t from = mark ? 0 : 2;
        const dp_memory_file file = {
            .data = wide + from, .size = 2 * sizeof OBJ - from, .name = "wide.obj"};
        assert_int_equal(dp_source_open_memory(&file, NULL, &source, &diag), DP_ERR_FORMAT);
        assert_contains(diag.message, "this is UTF-16 text: convert it to UTF-8, e.g. iconv ");
        assert_contains(diag.message, encodings[kind]);
    }
}

/* ------- samples: the fuzzers' corpus ------- */

typedef void sample_test(const uint8_t *data, size_t size, dp_file_format format);

static void test_sample(const char *path, dp_file_format format, sample_test *test) {
    uint8_t data[4096];
    FILE *const file = fopen(path, "rb");
    assert_non_null(file);
    const size_t size = fread(data, 1, sizeof data, file);
    fclose(file);
    test(data, size, format);
}

static void for_all_samples(sample_test *test) {
    static const struct {
        const char *folder;
        dp_file_format format;
    } kinds[] = {{"stl", DP_FORMAT_STL},
                 {"ply", DP_FORMAT_PLY},
                 {"obj", DP_FORMAT_OBJ},
                 {"off", DP_FORMAT_OFF}};
    int count = 0;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        char path[600];
        snprintf(path, sizeof path, "%s/fuzz/corpus/%s", DP_TESTS_DIR, kinds[k].folder);
        DIR *const folder = opendir(path);
        assert_non_null(folder);
        for (struct dirent *entry; (entry = readdir(folder));) {
            if (entry->d_name[0] == '.') continue;
            snprintf(path, sizeof path, "%s/fuzz/corpus/%s/%s", DP_TESTS_DIR, kinds[k].folder,
                     entry->d_name);
            test_sample(path, kinds[k].format, test);
            count++;
        }
        closedir(folder);
    }
    assert_true(count >= 16);
}

/* Cut anywhere, a file is read or refused with a reason and a place; never by chance memory. */
static void cut_everywhere(const uint8_t *data, size_t size, dp_file_format format) {
    for (size_t length = 0; length < size; length++) {
        uint8_t *const exact = malloc(length ? length : 1); /* so that a sanitizer sees its end */
        assert_non_null(exact);
        memcpy(exact, data, length);
        const char *text = trace_bytes(exact, length, NULL, format);
        const char *const failed = strstr(text, " at line ");
        if (failed) {
            assert_contains(text, "bad file content at line");
            if (length && !strstr(text, "no polygons")) assert_null(strstr(text, "line 0, byte 0"));
        }
        text = trace_bytes(exact, length, "x", DP_FORMAT_AUTO);
        assert_true(!strstr(text, " at line ") || strstr(text, ": "));
        free(exact);
    }
}

static void every_cut_of_every_sample_is_clean(void **state) {
    (void)state;
    for_all_samples(cut_everywhere);
}

/* An allocator that fails from some call on, and counts what is not given back. */
typedef struct limited {
    int calls, fail_at, live;
    bool failed;
} limited;

static bool fails(limited *self) {
    const bool now = self->fail_at >= 0 && self->calls >= self->fail_at;
    self->calls++;
    self->failed |= now;
    return now;
}
static void *limited_alloc(size_t size, void *user) {
    limited *const self = user;
    if (fails(self)) return NULL;
    self->live++;
    return malloc(size);
}
static void *limited_realloc(void *block, size_t size, void *user) {
    limited *const self = user;
    if (fails(self)) return NULL;
    self->live += !block;
    return realloc(block, size);
}
static void limited_free(void *block, void *user) {
    ((limited *)user)->live -= block != NULL;
    free(block);
}

/* The trace with the given allocation failing. */
static const char *trace_limited(const uint8_t *data, size_t size, dp_file_format format,
                                 limited *state) {
    const dp_allocator memory = {limited_alloc, limited_realloc, limited_free, state};
    const dp_file_options options = {.allocator = &memory};
    dp_stream *stream = NULL;
    dp_source *source = NULL;
    dp_diag diag;
    dp_result result = dp_stream_open_memory(data, size, 2048, &options, &stream, &diag);
    if (!result) result = dp_read_stream(stream, NULL, format, &source, &diag);
    return trace_opened(result, source, &diag);
}

static void fail_everywhere(const uint8_t *data, size_t size, dp_file_format format) {
    char expected[20000];
    limited all = {.fail_at = -1};
    snprintf(expected, sizeof expected, "%s", trace_limited(data, size, format, &all));
    assert_int_equal(all.live, 0);
    for (int n = 0; n < all.calls; n++) {
        limited state = {.fail_at = n};
        const char *const text = trace_limited(data, size, format, &state);
        assert_true(state.failed);
        assert_int_equal(state.live, 0);
        if (!strstr(expected, " at line "))
            assert_contains(text, "out of memory at line 0");
        else
            assert_true(strstr(text, "out of memory at line 0") || !strcmp(text, expected));
    }
}

static void every_failing_allocation_is_reported_and_leaks_nothing(void **state) {
    (void)state;
    for_all_samples(fail_everywhere);
}

/* Enough of everything that each array has to grow. */
static void growing_arrays_may_fail_too(void **state) {
    char *const text = calloc(1, 60000);
    size_t length = 0;
    (void)state;
    assert_non_null(text);
    for (int i = 0; i < 300; i++)
        length += (size_t)sprintf(text + length, "v %d 0 0\ng %d\nf 1 -1 2%s\n", i, i % 90,
                                  i % 7 ? "" : " 3");
    fail_everywhere((const uint8_t *)text, length, DP_FORMAT_OBJ);
    free(text);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(content_wins_over_the_name),
        cmocka_unit_test(a_byte_order_mark_is_passed_over),
        cmocka_unit_test(the_name_decides_where_content_does_not),
        cmocka_unit_test(unknown_content_is_refused),
        cmocka_unit_test(utf16_is_named),
        cmocka_unit_test(every_cut_of_every_sample_is_clean),
        cmocka_unit_test(every_failing_allocation_is_reported_and_leaks_nothing),
        cmocka_unit_test(growing_arrays_may_fail_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
