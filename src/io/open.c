/* dp_source_open and dp_source_open_memory: open a stream, find the format, and let its reader make
 * the source. Files and memory differ only in the stream. */
#include "io/readers.h"

#include "base/diag.h"

typedef dp_result mesh_reader(dp_stream *stream, dp_builder *builder, dp_diag *diag);

/* Reads all polygons, then hands them out as one stable batch. */
static dp_result read_whole(dp_stream *stream, mesh_reader *reader, dp_source **out,
                            dp_diag *diag) {
    dp_builder builder;
    dp_builder_init(&builder, &stream->allocator);
    dp_result result = reader(stream, &builder, diag);
    if (!result && stream->result) result = dp_stream_fail(stream, diag);
    if (!result) result = dp_builder_finish(&builder, out, diag);
    dp_builder_destroy(&builder);
    return result;
}

static dp_result read_as(dp_stream *stream, dp_file_format format, dp_source **out, dp_diag *diag) {
    switch (format) {
    case DP_FORMAT_PLY:
        return read_whole(stream, dp_read_ply, out, diag);
    case DP_FORMAT_OBJ:
        return read_whole(stream, dp_read_obj, out, diag);
    case DP_FORMAT_OFF:
        return read_whole(stream, dp_read_off, out, diag);
    case DP_FORMAT_STL:
        return dp_read_stl(stream, out, diag);
    case DP_FORMAT_GLTF:
        return dp_read_gltf(stream, out, diag);
    case DP_FORMAT_AUTO:
        break;
    }
    return dp_fail(diag, DP_ERR_ARGUMENT, "dp_source_open: %d is not a file format", (int)format);
}

/* Loads the first window. */
static dp_result check_any(dp_stream *stream, dp_diag *diag) {
    if (dp_stream_have(stream, 1)) return DP_OK;
    if (stream->result) return dp_stream_fail(stream, diag);
    return dp_fail(diag, DP_ERR_FORMAT, "the file is empty: export the model again");
}

dp_result dp_read_stream(dp_stream *stream, const char *name, dp_file_format format,
                         dp_source **out, dp_diag *diag) {
    dp_result result = check_any(stream, diag);
    if (!result && format == DP_FORMAT_AUTO) result = dp_detect(stream, name, &format, diag);
    if (!result) result = read_as(stream, format, out, diag);
    if (result || format != DP_FORMAT_STL) dp_stream_close(stream); /* STL reads on */
    return result;
}

dp_result dp_open_path(const char *path, const dp_file_options *options, bool more_readers,
                       dp_source **out, dp_diag *diag) {
    if (!out) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_source_open: out is NULL");
    *out = NULL;
    if (!path) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_source_open: path is NULL");
    dp_stream *stream = NULL;
    const dp_result result = dp_stream_open(path, options, &stream, diag);
    if (result) return result;
    stream->path = stream->owns_descriptor ? path : NULL;
    stream->more_readers = more_readers;
    return dp_read_stream(stream, path, options ? options->format : DP_FORMAT_AUTO, out, diag);
}

dp_result dp_open_memory(const dp_memory_file *file, const dp_file_options *options,
                         bool more_readers, dp_source **out, dp_diag *diag) {
    if (!out) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_source_open_memory: out is NULL");
    *out = NULL;
    if (!file || (file->size && !file->data))
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_source_open_memory: file or its data is NULL");
    dp_stream *stream = NULL;
    const dp_result result =
        dp_stream_open_memory(file->data, file->size, DP_STREAM_WINDOW, options, &stream, diag);
    if (result) return result;
    stream->file = file;
    stream->more_readers = more_readers;
    return dp_read_stream(stream, file->name, options ? options->format : DP_FORMAT_AUTO, out,
                          diag);
}

dp_result dp_source_open(const char *path, const dp_file_options *options, dp_source **out,
                         dp_diag *diag) {
    return dp_open_path(path, options, false, out, diag);
}

dp_result dp_source_open_memory(const dp_memory_file *file, const dp_file_options *options,
                                dp_source **out, dp_diag *diag) {
    return dp_open_memory(file, options, false, out, diag);
}
