/* Bytes from a file, standard input or memory, through one window that moves forward.
 *
 * Invariant: window <= cursor <= end, and *end == 0. limit is end - DP_STREAM_AHEAD while more may
 * come, and end when nothing does. So a reader with cursor <= limit can look ahead by
 * DP_STREAM_AHEAD bytes, or up to the 0 after the last byte, without another check.
 *
 * Files are read, not mapped: a mapped file that is shortened kills the process, pipes need a
 * window anyway, and the copy from the page cache costs only 5 ms for 33 MB.
 *
 * Not handled: compressed files; non-blocking descriptors (they fail with EAGAIN). */
#include "io/stream.h"

#include "base/diag.h"
#include "base/print.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* An empty window before the stream's first byte. */
static void reset(dp_stream *stream) {
    stream->window[0] = 0;
    stream->cursor = stream->end = stream->window;
    stream->limit = stream->window - 1; /* makes the first look ahead load */
    stream->line = 1;
    stream->loaded = 0;
    stream->at_end = false;
    stream->result = DP_OK;
}

/* The window follows the struct, after one byte, so that `limit` may point just before it. */
static dp_stream *create(size_t window_size, const dp_file_options *options) {
    const dp_allocator memory = dp_allocator_resolve(options ? options->allocator : NULL);
    dp_stream *const stream = dp_alloc(&memory, sizeof *stream + 1 + window_size + 1);
    if (!stream) return NULL;
    *stream = (dp_stream){.allocator = memory,
                          .size = DP_STREAM_UNKNOWN,
                          .window = (uint8_t *)(stream + 1) + 1,
                          .window_size = window_size,
                          .descriptor = -1,
                          .start = -1,
                          .progress = options ? options->progress : NULL,
                          .user = options ? options->user : NULL};
    reset(stream);
    return stream;
}

static dp_result open_descriptor(const char *path, int *descriptor, struct stat *status,
                                 dp_diag *diag) {
    const bool standard = strcmp(path, "-") == 0;
    *descriptor = standard ? STDIN_FILENO : open(path, O_RDONLY | O_CLOEXEC);
    if (*descriptor >= 0 && fstat(*descriptor, status) == 0) {
        if (!S_ISDIR(status->st_mode)) return DP_OK;
        errno = EISDIR;
    }
    const int error = errno;
    if (!standard && *descriptor >= 0) close(*descriptor);
    return dp_fail(diag, DP_ERR_IO, "cannot be read: %s",
                   dp_print_error((char[DP_ERROR_TEXT]){0}, error));
}

dp_result dp_stream_open(const char *path, const dp_file_options *options, dp_stream **out,
                         dp_diag *diag) {
    int descriptor;
    struct stat status;
    const dp_result result = open_descriptor(path, &descriptor, &status, diag);
    if (result) return result;
    const bool owned = descriptor != STDIN_FILENO || strcmp(path, "-") != 0;
    dp_stream *const stream = create(DP_STREAM_WINDOW, options);
    if (!stream) {
        if (owned) close(descriptor);
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a file's window");
    }
    stream->descriptor = descriptor;
    stream->owns_descriptor = owned;
    if (S_ISREG(status.st_mode)) stream->start = lseek(descriptor, 0, SEEK_CUR);
    /* Files of /proc report size 0: their size is not known. */
    if (stream->start >= 0 && status.st_size > stream->start)
        stream->size = (uint64_t)(status.st_size - stream->start);
    *out = stream;
    return DP_OK;
}

dp_result dp_stream_open_memory(const void *data, size_t size, size_t window_size,
                                const dp_file_options *options, dp_stream **out, dp_diag *diag) {
    dp_stream *const stream = create(window_size, options);
    if (!stream) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a file's window");
    stream->memory = data;
    stream->size = size;
    stream->start = 0;
    *out = stream;
    return DP_OK;
}

void dp_stream_close(dp_stream *stream) {
    if (!stream) return;
    const dp_allocator memory = stream->allocator;
    if (stream->owns_descriptor) close(stream->descriptor);
    if (stream->closed) stream->closed(stream->closed_user, stream->memory, (size_t)stream->size);
    dp_free(&memory, stream);
}

/* Reads to `to`; returns bytes, 0 at the end or on failure. A file is read by position: where it was
 * read to is the stream's own, also after a fork, when processes share one descriptor. */
static size_t load(dp_stream *stream, uint8_t *to, size_t room) {
    if (stream->descriptor < 0) {
        const uint64_t left = stream->size - stream->loaded;
        const size_t count = left < room ? (size_t)left : room;
        if (count) memcpy(to, stream->memory + stream->loaded, count);
        return count;
    }
    ssize_t count;
    do
        count = stream->start < 0 ? read(stream->descriptor, to, room)
                                  : pread(stream->descriptor, to, room,
                                          (off_t)((uint64_t)stream->start + stream->loaded));
    while (count < 0 && errno == EINTR);
    if (count >= 0) return (size_t)count;
    stream->error = errno;
    stream->result = DP_ERR_IO;
    return 0;
}

static void report(dp_stream *stream) {
    if (!stream->progress || stream->result) return;
    double fraction = -1;
    if (stream->size != DP_STREAM_UNKNOWN && stream->size)
        fraction = (double)stream->loaded / (double)stream->size;
    if (stream->progress(stream->user, fraction > 1 ? 1 : fraction))
        stream->result = DP_ERR_CANCELLED;
}

bool dp_stream_refill(dp_stream *stream) {
    if (stream->at_end) return false;
    const size_t kept = (size_t)(stream->end - stream->cursor);
    memmove(stream->window, stream->cursor, kept);
    uint8_t *end = stream->window + kept;
    size_t room = stream->window_size - kept;
    while (room) { /* pipes give little at a time */
        const size_t count = load(stream, end, room);
        if (!count) break;
        end += count;
        room -= count;
        stream->loaded += count;
    }
    stream->at_end = room > 0;
    report(stream);
    if (stream->result) { /* readers find the end, then ask why */
        stream->at_end = true;
        end = stream->window;
    }
    *end = 0;
    stream->cursor = stream->window;
    stream->end = end;
    stream->limit = stream->at_end ? end : end - DP_STREAM_AHEAD;
    return (size_t)(end - stream->cursor) > kept;
}

bool dp_stream_skip(dp_stream *stream, uint64_t count) {
    for (;;) {
        const size_t here = (size_t)(stream->end - stream->cursor);
        if (count <= here) {
            stream->cursor += count;
            return true;
        }
        count -= here;
        stream->cursor = stream->end;
        if (!dp_stream_refill(stream)) return false;
    }
}

uint64_t dp_stream_offset(const dp_stream *stream) {
    return stream->loaded - (uint64_t)(stream->end - stream->cursor);
}

size_t dp_stream_hint(const dp_stream *stream, uint64_t count, size_t bytes) {
    uint64_t most = 4096; /* a pipe's size is unknown: start small */
    if (stream->size != DP_STREAM_UNKNOWN) {
        const uint64_t offset = dp_stream_offset(stream);
        most = (stream->size > offset ? stream->size - offset : 0) / bytes + 1;
    }
    return (size_t)(count < most ? count : most);
}

bool dp_stream_read_at(const dp_stream *stream, uint64_t offset, uint8_t *to, size_t size,
                       size_t *got, int *error) {
    *got = 0;
    if (stream->descriptor < 0) {
        const uint64_t left = offset < stream->size ? stream->size - offset : 0;
        *got = left < size ? (size_t)left : size;
        if (*got) memcpy(to, stream->memory + offset, *got);
        return true;
    }
    while (*got < size) {
        const ssize_t count = pread(stream->descriptor, to + *got, size - *got,
                                    (off_t)((uint64_t)stream->start + offset + *got));
        if (count == 0) break;
        if (count > 0)
            *got += (size_t)count;
        else if (errno != EINTR) {
            *error = errno;
            return false;
        }
    }
    return true;
}

bool dp_stream_rewindable(const dp_stream *stream) { return stream->start >= 0; }

dp_result dp_stream_rewind(dp_stream *stream, dp_diag *diag) {
    if (stream->descriptor >= 0 &&
        lseek(stream->descriptor, (off_t)stream->start, SEEK_SET) != (off_t)stream->start)
        return dp_fail(diag, DP_ERR_IO, "cannot be read from the start again: %s",
                       dp_print_error((char[DP_ERROR_TEXT]){0}, errno));
    reset(stream);
    return DP_OK;
}

dp_result dp_stream_fail(const dp_stream *stream, dp_diag *diag) {
    if (stream->result == DP_ERR_CANCELLED)
        return dp_fail(diag, DP_ERR_CANCELLED, "reading was stopped");
    return dp_fail_offset(diag, stream->result, stream->loaded, "reading failed: %s",
                          dp_print_error((char[DP_ERROR_TEXT]){0}, stream->error));
}
