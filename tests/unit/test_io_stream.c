/* io/stream and io/text: windows of any size show the same bytes; errors, progress, standard
 * input. */
#include "io/stream.h"
#include "io/text.h"
#include "reading.h"

#include <errno.h>
#include <sys/stat.h>
#include <sys/wait.h>

static dp_stream *over(const void *data, size_t size, size_t window) {
    dp_stream *stream = NULL;
    assert_int_equal(dp_stream_open_memory(data, size, window, NULL, &stream, NULL), DP_OK);
    return stream;
}

static uint8_t *numbered(size_t size) {
    uint8_t *const data = malloc(size);
    assert_non_null(data);
    for (size_t i = 0; i < size; i++) data[i] = (uint8_t)(i * 7 + i / 251);
    return data;
}

static void small_windows_show_every_byte(void **state) {
    const size_t size = 20000;
    uint8_t *const data = numbered(size);
    (void)state;
    for (size_t window = 2048; window < 2060; window++) {
        dp_stream *const stream = over(data, size, window);
        for (size_t i = 0; i < size; i++) {
            assert_true(dp_stream_have(stream, 1));
            assert_int_equal(dp_stream_offset(stream), i);
            assert_int_equal(*stream->cursor++, data[i]);
        }
        assert_false(dp_stream_have(stream, 1));
        assert_int_equal(*stream->end, 0);
        dp_stream_close(stream);
    }
    free(data);
}

static void looking_ahead_finds_all_or_the_end(void **state) {
    const size_t size = 5000;
    uint8_t *const data = numbered(size);
    (void)state;
    dp_stream *const stream = over(data, size, 2048);
    for (size_t i = 0; i <= size; i += 13) {
        const bool expected = i + DP_STREAM_AHEAD <= size;
        assert_int_equal(dp_stream_have(stream, DP_STREAM_AHEAD), expected);
        if (expected) assert_memory_equal(stream->cursor, data + i, DP_STREAM_AHEAD);
        assert_int_equal(dp_stream_skip(stream, 13), i + 13 <= size);
    }
    dp_stream_close(stream);
    free(data);
}

static void skipping_is_exact(void **state) {
    uint8_t *const data = numbered(10000);
    (void)state;
    for (size_t skip = 0; skip <= 10001; skip += 91) {
        dp_stream *const stream = over(data, 10000, 2048);
        assert_int_equal(dp_stream_skip(stream, skip), skip <= 10000);
        if (skip < 10000) assert_true(dp_stream_have(stream, 1) && *stream->cursor == data[skip]);
        assert_int_equal(dp_stream_rewind(stream, NULL), DP_OK);
        assert_true(dp_stream_have(stream, 1) && *stream->cursor == data[0]);
        assert_false(dp_stream_skip(stream, UINT64_MAX));
        dp_stream_close(stream);
    }
    free(data);
}

static void hints_do_not_exceed_the_file(void **state) {
    static const char data[100] = {0};
    (void)state;
    dp_stream *const stream = over(data, sizeof data, 2048);
    assert_int_equal(dp_stream_hint(stream, 7, 4), 7);
    assert_in_range(dp_stream_hint(stream, UINT64_MAX, 4), 25, 26);
    dp_stream_close(stream);
}

static void lines_are_counted_whatever_ends_them(void **state) {
    (void)state;
    for (size_t shift = 0; shift < 3; shift++) {
        char text[9000];
        static const char *const ends[] = {"\n", "\r\n", "\r"};
        size_t length = 0;
        for (int i = 0; i < 1000; i++)
            length +=
                (size_t)snprintf(text + length, sizeof text - length, " %d%s", i, ends[shift]);
        dp_stream *const stream = over(text, length, 2048);
        for (int i = 0; i < 1000; i++) {
            int64_t value;
            assert_true(dp_text_space(stream));
            assert_true(dp_text_int(stream, &value) && value == i);
            assert_int_equal(stream->line, i + 1);
            if (i % 3 == 0) dp_text_skip_line(stream);
        }
        assert_false(dp_text_space(stream));
        dp_stream_close(stream);
    }
}

static void words_may_be_longer_than_the_window(void **state) {
    char *const text = malloc(10001);
    char word[8];
    float number;
    (void)state;
    assert_non_null(text);
    memset(text, '1', 10001);
    memcpy(text + 9998, " x", 2);
    dp_stream *const stream = over(text, 10000, 2048);
    assert_true(dp_text_space(stream));
    assert_false(dp_text_float(stream, &number)); /* nobody means that */
    assert_int_equal(dp_text_word(stream, word, sizeof word), 9998);
    assert_string_equal(word, "1111111");
    assert_true(dp_text_blank(stream) && *stream->cursor == 'x');
    dp_stream_rewind(stream, NULL);
    dp_text_skip_word(stream);
    dp_text_rest(stream, word, sizeof word);
    assert_string_equal(word, "x");
    dp_stream_close(stream);
    free(text);
}

/* ------- the file system ------- */

static dp_result open_result(const char *path, const dp_file_options *options, dp_diag *diag) {
    dp_source *source = NULL;
    const dp_result result = dp_source_open(path, options, &source, diag);
    assert_int_equal(result == DP_OK, source != NULL);
    dp_source_destroy(source);
    return result;
}

static void what_the_system_refuses_is_said(void **state) {
    dp_diag diag;
    (void)state;
    assert_int_equal(open_result("/nonexistent/model.stl", NULL, &diag), DP_ERR_IO);
    assert_contains(diag.message, strerror(ENOENT));
    assert_int_equal(open_result("/", NULL, &diag), DP_ERR_IO);
    assert_contains(diag.message, strerror(EISDIR));
    const char *const path = write_file(".stl", "x", 1);
    chmod(path, 0);
    if (access(path, R_OK) == 0)
        print_message("run as root: unreadable files are left out\n");
    else
        assert_int_equal(open_result(path, NULL, &diag), DP_ERR_IO);
    unlink(path);
}

static void wrong_calls_are_refused(void **state) {
    dp_source *source = (dp_source *)(void *)&source;
    dp_diag diag;
    (void)state;
    assert_int_equal(dp_source_open("x.obj", NULL, NULL, &diag), DP_ERR_ARGUMENT);
    assert_int_equal(dp_source_open(NULL, NULL, &source, &diag), DP_ERR_ARGUMENT);
    assert_null(source);
    assert_int_equal(dp_source_open("/nonexistent", NULL, &source, NULL), DP_ERR_IO);
    const char *const path = write_file("", "v 0 0 0\n", 8);
    const dp_file_options options = {.format = (dp_file_format)77};
    assert_int_equal(open_result(path, &options, &diag), DP_ERR_ARGUMENT);
    unlink(path);
}

typedef struct watch {
    int calls, stop_at;
    double last;
} watch;

static int tests_near_depth(void *user, double fraction) {
    watch *const self = user;
    self->last = fraction;
    return ++self->calls == self->stop_at;
}

/* An OBJ file or an ASCII STL file of a few windows. */
static size_t big_model(char *text, bool stl) {
    size_t length = 0;
    if (stl)
        length += (size_t)sprintf(text, "solid\n");
    else
        length += (size_t)sprintf(text, "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    while (length < 1500000)
        length += (size_t)sprintf(text + length, "%s",
                                  stl ? "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 "
                                        "vertex 0 1 0 endloop endfacet\n"
                                      : "f 1 2 3\n");
    if (stl) length += (size_t)sprintf(text + length, "endsolid\n");
    return length;
}

static void progress_rises_and_stops(void **state) {
    char *const text = malloc(1600000);
    (void)state;
    assert_non_null(text);
    for (int stl = 0; stl < 2; stl++) {
        const char *const path = write_file("", text, big_model(text, stl));
        watch seen = {.last = -2};
        dp_file_options options = {.progress = tests_near_depth, .user = &seen};
        dp_extent extent;
        dp_diag diag;
        dp_source *source = NULL;
        assert_int_equal(dp_source_open(path, &options, &source, &diag), DP_OK);
        assert_int_equal(dp_source_extent(source, &extent, &diag), DP_OK);
        dp_source_destroy(source);
        assert_true(seen.calls > 3 && seen.last == 1);
        for (int stop = 1; stop < 5; stop++) {
            seen = (watch){.stop_at = stop};
            dp_result result = dp_source_open(path, &options, &source, &diag);
            if (!result) result = dp_source_extent(source, &extent, &diag);
            assert_int_equal(result, DP_ERR_CANCELLED);
            assert_int_equal(diag.result, DP_ERR_CANCELLED);
            assert_int_equal(seen.calls, stop);
            dp_source_destroy(source);
        }
        unlink(path);
    }
    free(text);
}

/* What `act` sees when standard input is a pipe that another process fills. */
static void with_piped(const void *data, size_t size, void (*act)(void)) {
    int ends[2];
    const int saved = dup(STDIN_FILENO);
    assert_int_equal(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0) {
        const uint8_t *p = data;
        close(ends[0]);
        for (size_t left = size; left;) {
            const ssize_t count = write(ends[1], p, left < 1000 ? left : 1000);
            if (count < 0) break;
            p += count;
            left -= (size_t)count;
        }
        _exit(0);
    }
    close(ends[1]);
    dup2(ends[0], STDIN_FILENO);
    close(ends[0]);
    act();
    dup2(saved, STDIN_FILENO);
    close(saved);
    waitpid(child, NULL, 0);
}

static int unknown_size(void *user, double fraction) {
    (void)user;
    assert_true(fraction < 0);
    return 0;
}

static void read_obj_once(void) {
    const dp_file_options options = {.progress = unknown_size};
    dp_source *source = NULL;
    dp_batch batch;
    assert_int_equal(dp_source_open("-", &options, &source, NULL), DP_OK);
    assert_int_equal(dp_source_next(source, &batch, NULL), DP_OK);
    assert_true(batch.stable && batch.vertex_count == 3 && batch.polygon_count > 100000);
    assert_true(dp_source_rewindable(source)); /* it is held whole */
    dp_source_destroy(source);
}

static void read_stl_once(void) {
    dp_source *source = NULL;
    dp_extent extent;
    dp_diag diag;
    assert_int_equal(dp_source_open("-", NULL, &source, NULL), DP_OK);
    assert_false(dp_source_rewindable(source));
    assert_int_equal(dp_source_extent(source, &extent, NULL), DP_OK);
    assert_true(extent.polygons > 10000 && extent.max[1] == 1);
    assert_int_equal(dp_source_rewind(source, &diag), DP_ERR_UNSUPPORTED);
    dp_source_destroy(source);
}

static void pipes_are_read_once(void **state) {
    char *const text = malloc(1600000);
    (void)state;
    assert_non_null(text);
    with_piped(text, big_model(text, false), read_obj_once);
    with_piped(text, big_model(text, true), read_stl_once);
    bytes binary = {.size = 80};
    put(&binary, 70000, 4);
    memcpy(text, binary.data, 84);
    binary.size = 0;
    put(&binary, 0, 4), put(&binary, 0, 4), put_float(&binary, 1);
    for (int c = 0; c < 3; c++)
        put_float(&binary, c == 1), put_float(&binary, c == 2), put_float(&binary, 0);
    put(&binary, 0, 2);
    char *const stl = malloc(84 + 50 * 70000);
    assert_non_null(stl);
    memcpy(stl, text, 84);
    for (size_t i = 0; i < 70000; i++) memcpy(stl + 84 + 50 * i, binary.data, 50);
    with_piped(stl, 84 + 50 * 70000, read_stl_once);
    free(stl);
    free(text);
}

/* Standard input that is a file, and not at its start. */
static void redirected_files_are_rewound_to_where_they_were(void **state) {
    static const char text[] = "skipped\nsolid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
                               "vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n";
    (void)state;
    const char *const path = write_file("", text, sizeof text - 1);
    const int saved = dup(STDIN_FILENO);
    assert_non_null(freopen(path, "r", stdin));
    lseek(STDIN_FILENO, 8, SEEK_SET);
    dp_source *source = NULL;
    dp_diag diag;
    const dp_result result = dp_source_open("-", NULL, &source, &diag);
    assert_string_equal(trace_opened(result, source, &diag), "(0 0 0)(1 0 0)(0 1 0)@a\n");
    dup2(saved, STDIN_FILENO);
    close(saved);
    unlink(path);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(small_windows_show_every_byte),
        cmocka_unit_test(looking_ahead_finds_all_or_the_end),
        cmocka_unit_test(skipping_is_exact),
        cmocka_unit_test(hints_do_not_exceed_the_file),
        cmocka_unit_test(lines_are_counted_whatever_ends_them),
        cmocka_unit_test(words_may_be_longer_than_the_window),
        cmocka_unit_test(what_the_system_refuses_is_said),
        cmocka_unit_test(wrong_calls_are_refused),
        cmocka_unit_test(progress_rises_and_stops),
        cmocka_unit_test(pipes_are_read_once),
        cmocka_unit_test(redirected_files_are_rewound_to_where_they_were),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
