/* What the fuzzers of the readers share: a file in memory is read to its end, twice. */
#ifndef DP_FUZZ_READER_H
#define DP_FUZZ_READER_H

#include "io/readers.h"

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Touches all that a batch points to, so that the sanitizer sees it; the sum of the bytes. */
static inline uint64_t dp_fuzz_touch(const void *bytes, size_t size) {
    uint64_t sum = 0;
    for (size_t i = 0; i < size; i++) sum += ((const uint8_t *)bytes)[i] * (uint64_t)(i + 1);
    return sum;
}

static inline uint64_t dp_fuzz_batch(dp_source *source, const dp_batch *batch) {
    uint64_t sum = dp_fuzz_touch(batch->positions, batch->vertex_count * batch->position_stride);
    if (batch->indices) sum += dp_fuzz_touch(batch->indices, 4 * batch->corner_count);
    if (batch->firsts) sum += dp_fuzz_touch(batch->firsts, 4 * (batch->polygon_count + 1));
    if (batch->colors) sum += dp_fuzz_touch(batch->colors, 4 * batch->vertex_count);
    if (!batch->groups) return sum;
    for (size_t i = 0; i < batch->polygon_count; i++) {
        const char *const name = dp_source_group_name(source, batch->groups[i]);
        sum += dp_source_group_color(source, batch->groups[i]);
        if (name) sum += strlen(name);
    }
    return sum;
}

/* Reads to the end or the first failure. */
static inline uint64_t dp_fuzz_drain(dp_source *source) {
    uint64_t sum = 0;
    for (;;) {
        dp_batch batch;
        dp_diag diag;
        const dp_result result = dp_source_next(source, &batch, &diag);
        if (result == DP_ERR_ARGUMENT || (result && !diag.message[0])) abort();
        if (result || !batch.polygon_count) return sum;
        sum += dp_fuzz_batch(source, &batch);
    }
}

/* Windows of both sizes, so that what crosses their ends is met in small files too. */
static inline int dp_fuzz_reader(const uint8_t *data, size_t size, const char *name,
                                 dp_file_format format) {
    const size_t window = size & 1 ? 2 * DP_STREAM_AHEAD : DP_STREAM_WINDOW;
    dp_stream *stream = NULL;
    dp_source *source = NULL;
    dp_diag diag;
    if (dp_stream_open_memory(data, size, window, NULL, &stream, &diag)) return 0;
    const dp_result result = dp_read_stream(stream, name, format, &source, &diag);
    if (result) {
        if (source || !diag.message[0] || diag.result != result) abort();
        return 0;
    }
    const uint64_t first = dp_fuzz_drain(source);
    if (dp_source_rewind(source, &diag) || dp_fuzz_drain(source) != first) abort();
    dp_source_destroy(source);
    return 0;
}

#endif
