/* What the tests of the readers share: a model as text, so that expectations can be read. */
#ifndef DP_TESTS_READING_H
#define DP_TESTS_READING_H

#include "temporary.h"

#include "io/readers.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

/* Appends to a text of limited size. */
static inline void append(char *text, size_t size, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
static inline void append(char *text, size_t size, const char *format, ...) {
    const size_t length = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text + length, size - length, format, arguments);
    va_end(arguments);
}

static inline void trace_corner(const dp_batch *batch, size_t c, char *text, size_t size) {
    const uint32_t v = batch->indices ? batch->indices[c] : (uint32_t)c;
    if (v >= batch->vertex_count) {
        append(text, size, v == UINT32_MAX ? "(none)" : "(out)");
        return;
    }
    const float *const p =
        (const float *)(const void *)((const char *)batch->positions + v * batch->position_stride);
    append(text, size, "(%g %g %g)", (double)p[0], (double)p[1], (double)p[2]);
}

/* One line for each polygon: its corners, and @name of its group; "error: …" at a failure. */
static inline void trace(dp_source *source, char *text, size_t size) {
    *text = 0;
    for (;;) {
        dp_batch batch;
        dp_diag diag;
        if (dp_source_next(source, &batch, &diag)) {
            append(text, size, "%s at line %d, byte %d: %s", dp_result_name(diag.result),
                   (int)diag.line, (int)diag.offset, diag.message);
            return;
        }
        if (!batch.polygon_count) return;
        for (size_t i = 0; i < batch.polygon_count; i++) {
            const size_t first = batch.firsts ? batch.firsts[i] : 3 * i;
            const size_t last = batch.firsts ? batch.firsts[i + 1] : 3 * i + 3;
            for (size_t c = first; c < last; c++) trace_corner(&batch, c, text, size);
            const uint32_t group = batch.groups ? batch.groups[i] : 0;
            const char *const name = dp_source_group_name(source, group);
            append(text, size, name ? "@%s\n" : "\n", name);
        }
    }
}

/* A source's trace, or what opening failed with; reads it twice and wants the same. */
static inline const char *trace_opened(dp_result result, dp_source *source, const dp_diag *diag) {
    static char text[20000], again[20000];
    if (result) {
        assert_null(source);
        assert_int_equal(result, diag->result);
        snprintf(text, sizeof text, "%s at line %d, byte %d: %s", dp_result_name(result),
                 (int)diag->line, (int)diag->offset, diag->message);
        return text;
    }
    trace(source, text, sizeof text);
    if (dp_source_rewindable(source)) {
        assert_int_equal(dp_source_rewind(source, NULL), DP_OK);
        trace(source, again, sizeof again);
        assert_string_equal(text, again);
    }
    dp_source_destroy(source);
    return text;
}

/* The trace of a file of `size` bytes. */
static inline const char *trace_bytes(const void *bytes, size_t size, const char *name,
                                      dp_file_format format) {
    dp_stream *stream = NULL;
    dp_source *source = NULL;
    dp_diag diag;
    assert_int_equal(dp_stream_open_memory(bytes, size, 2 * DP_STREAM_AHEAD, NULL, &stream, &diag),
                     DP_OK);
    const dp_result result = dp_read_stream(stream, name, format, &source, &diag);
    return trace_opened(result, source, &diag);
}

/* The trace of a text whose format is to be found. */
static inline const char *trace_text(const char *content) {
    return trace_bytes(content, strlen(content), NULL, DP_FORMAT_AUTO);
}

#define assert_trace(content, expected) assert_string_equal(trace_text(content), expected)
#define assert_contains(text, part)                                                                \
    do {                                                                                           \
        const char *const text_ = (text);                                                          \
        if (!strstr(text_, part)) fail_msg("no `%s` in: %s", part, text_);                         \
    } while (0)

/* A new file with that content; the name is to be unlinked and is good until the next call. */
static inline const char *write_file(const char *ending, const void *bytes, size_t size) {
    static char path[300], named[300];
    temporary_name(path, sizeof path, "test");
    const int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    assert_int_equal(write(descriptor, bytes, size), size);
    close(descriptor);
    snprintf(named, sizeof named, "%.280s%s", path, ending);
    assert_int_equal(rename(path, named), 0);
    return named;
}

/* Bytes put together for the binary formats, in either order. */
typedef struct bytes {
    uint8_t data[4096];
    size_t size;
    bool big;
} bytes;

static inline void put(bytes *to, uint64_t value, size_t size) {
    for (size_t i = 0; i < size; i++)
        to->data[to->size++] = (uint8_t)(value >> 8 * (to->big ? size - 1 - i : i));
}
static inline void put_text(bytes *to, const char *text) {
    memcpy(to->data + to->size, text, strlen(text));
    to->size += strlen(text);
}
static inline void put_float(bytes *to, float value) {
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    put(to, bits, 4);
}
static inline void put_double(bytes *to, double value) {
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    put(to, bits, 8);
}

#endif
