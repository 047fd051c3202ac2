/* A page of drawings as a file that is either whole or not there; and what the core library leaves to
 * libpng and zlib: grounds as PNGs, which SVG takes, and compressed streams of PDF. */
#include <drypoint/io.h>

#include "base/diag.h"
#include "write/file.h"
#include "write/png.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

static dp_result write_bytes(void *user, const char *bytes, size_t size, dp_diag *diag) {
    return dp_output_write(user, bytes, size, diag);
}

/* ------- compression ------- */

enum { PIECE = 1 << 14 /* bytes */ };

/* Feeds all bytes, in parts that zlib's 32-bit counts can hold, and writes what comes. */
static dp_result deflate_all(z_stream *stream, const uint8_t *bytes, size_t size,
                             dp_text_writer *write, void *user, dp_diag *diag) {
    uint8_t piece[PIECE];
    int state = Z_OK;
    while (state != Z_STREAM_END) {
        if (!stream->avail_in && size) {
            const size_t part = size < ((size_t)1 << 30) ? size : (size_t)1 << 30;
            stream->next_in = (Bytef *)(uintptr_t)bytes; /* zlib does not write there */
            stream->avail_in = (uInt)part;
            bytes += part;
            size -= part;
        }
        stream->next_out = piece;
        stream->avail_out = sizeof piece;
        state = deflate(stream, size ? Z_NO_FLUSH : Z_FINISH);
        const dp_result result =
            write(user, (const char *)piece, sizeof piece - stream->avail_out, diag);
        if (result) return result;
    }
    return DP_OK;
}

static dp_result compress_bytes(const void *bytes, size_t size, dp_text_writer *write, void *user,
                                dp_diag *diag) {
    z_stream stream = {.zalloc = NULL};
    if (deflateInit(&stream, Z_DEFAULT_COMPRESSION) != Z_OK)
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for compressing %zu bytes", size);
    const dp_result result = deflate_all(&stream, bytes, size, write, user, diag);
    deflateEnd(&stream);
    return result;
}

/* ------- grounds ------- */

/* Copies of the views with PNGs of their grounds; those that were made here are freed here. */
typedef struct encoded {
    dp_view_on_page *views;
    size_t count;
    const dp_page *page;
} encoded;

static void free_grounds(encoded *e) {
    for (size_t v = 0; v < e->count; v++)
        if (e->views[v].ground_png != e->page->views[v].ground_png)
            free((void *)(uintptr_t)e->views[v].ground_png); /* png.c: dp_png_encode */
    free(e->views);
}

static dp_result encode_grounds(encoded *e, dp_diag *diag) {
    e->views = calloc(e->page->view_count, sizeof *e->views);
    if (!e->views) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a page's views");
    e->count = e->page->view_count;
    memcpy(e->views, e->page->views, e->count * sizeof *e->views);
    for (size_t v = 0; v < e->count; v++) {
        dp_view_on_page *const view = &e->views[v];
        dp_drawing_info info;
        void *png = NULL;
        if (!view->ground || view->ground_png || !view->drawing) continue;
        dp_drawing_info_of(view->drawing, &info);
        const dp_result failed = dp_png_encode(view->ground, info.width, info.height, &png,
                                               &view->ground_png_size, diag);
        if (failed) return failed;
        view->ground_png = png;
    }
    return DP_OK;
}

/* ------- pages ------- */

static dp_result write_page(const char *path, const dp_page *page, dp_format format,
                            dp_diag *diag) {
    dp_output output;
    dp_result result = dp_output_open(&output, path, diag);
    if (result) return result;
    result = dp_page_write(page, format, write_bytes, &output, diag);
    if (!result) return dp_output_commit(&output, diag);
    dp_output_abandon(&output);
    return result;
}

dp_result dp_io_write_page(const char *path, const dp_page *page, dp_format format, dp_diag *diag) {
    if (!path || !page)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_io_write_page: path or page is NULL");
    dp_page full = *page;
    if (!full.compress) full.compress = compress_bytes;
    encoded grounds = {.page = page};
    dp_result result = DP_OK;
    if (format == DP_FORMAT_SVG && page->view_count && page->views) {
        result = encode_grounds(&grounds, diag);
        full.views = grounds.views;
    }
    if (!result) result = write_page(path, &full, format, diag);
    free_grounds(&grounds);
    return result;
}
