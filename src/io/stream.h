/* A file, standard input or a block of memory as a window of bytes that moves forward. */
#ifndef DP_IO_STREAM_H
#define DP_IO_STREAM_H

#include "base/memory.h"
#include <drypoint/source.h>

#define DP_STREAM_WINDOW  ((size_t)256 << 10) /* bytes: stays in the second-level cache */
#define DP_STREAM_AHEAD   ((size_t)1024)      /* bytes: how far readers may look ahead */
#define DP_STREAM_UNKNOWN UINT64_MAX

typedef struct dp_stream {
    const uint8_t *cursor; /* the next byte; readers move it */
    const uint8_t *limit;  /* beyond it, fewer than DP_STREAM_AHEAD bytes are in the window */
    const uint8_t *end;    /* one past the window's last byte; *end is always 0 */
    uint64_t line;         /* 1-based, kept by text.c */
    uint64_t size;         /* bytes in all, or DP_STREAM_UNKNOWN */
    dp_result result;      /* the first failure; the stream is at its end from then on */

    dp_allocator allocator;
    uint8_t *window;
    size_t window_size;
    uint64_t loaded; /* bytes put into the window so far */
    bool at_end;     /* nothing comes after the window */
    int error;       /* errno of a failed read */
    int descriptor;  /* -1: memory */
    bool owns_descriptor;
    int64_t start;         /* where in the file the stream begins; -1: cannot go back */
    const uint8_t *memory; /* borrowed */
    /* Where the model's other files are (beside.h); borrowed while it is being opened. */
    const char *path;           /* of a file; or NULL */
    const dp_memory_file *file; /* of a model in memory; or NULL */
    bool more_readers;          /* dp_open_path */
    /* Called with the memory when the stream is closed; NULL: nothing to call. */
    void (*closed)(void *closed_user, const void *data, size_t size);
    void *closed_user;
    int (*progress)(void *user, double fraction);
    void *user;
} dp_stream;

/* path "-" is standard input. options may be NULL. DP_ERR_IO, DP_ERR_MEMORY. */
dp_result dp_stream_open(const char *path, const dp_file_options *options, dp_stream **out,
                         dp_diag *diag);
/* Opens borrowed memory. window_size: at least 2 * DP_STREAM_AHEAD; small ones are for tests. */
dp_result dp_stream_open_memory(const void *data, size_t size, size_t window_size,
                                const dp_file_options *options, dp_stream **out, dp_diag *diag);
void dp_stream_close(dp_stream *stream); /* NULL allowed */

/* Moves the window forward. False at the end, or when reading failed or was cancelled. */
bool dp_stream_refill(dp_stream *stream);
/* Are there `count` (at most DP_STREAM_AHEAD) bytes at the cursor? Loads them if needed. */
static inline bool dp_stream_have(dp_stream *stream, size_t count) {
    if (stream->cursor > stream->limit) dp_stream_refill(stream);
    return (size_t)(stream->end - stream->cursor) >= count;
}
/* Skips `count` bytes; false if the end comes first. */
bool dp_stream_skip(dp_stream *stream, uint64_t count);
/* The cursor's byte offset from the stream's start. */
uint64_t dp_stream_offset(const dp_stream *stream);
/* For how many of `count` announced items, of at least `bytes` each, memory may be allocated: no
 * more than the rest of the file can hold, as headers may be wrong. */
size_t dp_stream_hint(const dp_stream *stream, uint64_t count, size_t bytes);

/* Copies up to `size` bytes from byte `offset` of the stream, which must be rewindable, and does
 * not touch the window; from any thread. *got: bytes copied. False: *error is errno. */
bool dp_stream_read_at(const dp_stream *stream, uint64_t offset, uint8_t *to, size_t size,
                       size_t *got, int *error);

bool dp_stream_rewindable(const dp_stream *stream);
dp_result dp_stream_rewind(dp_stream *stream, dp_diag *diag);
/* Reports stream->result, which must not be DP_OK. */
dp_result dp_stream_fail(const dp_stream *stream, dp_diag *diag);

#endif
