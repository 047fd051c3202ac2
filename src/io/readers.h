/* The readers of src/io, one per format, and how a stream's format is found. */
#ifndef DP_IO_READERS_H
#define DP_IO_READERS_H

#include "io/builder.h"
#include "io/stream.h"

/* The stream's format, by its first window, then by the ending of `name` (NULL allowed).
 * DP_ERR_UNSUPPORTED: another one, perhaps Assimp's. DP_ERR_FORMAT: in no reader's encoding. */
dp_result dp_detect(dp_stream *stream, const char *name, dp_file_format *format, dp_diag *diag);
/* Does the name's ending tell a format that only the library reads? NULL allowed. */
bool dp_has_own_ending(const char *name);
/* Is an STL file binary? */
bool dp_detect_binary_stl(dp_stream *stream);

/* Read the whole mesh into the builder; the caller keeps the stream. */
dp_result dp_read_ply(dp_stream *stream, dp_builder *builder, dp_diag *diag);
dp_result dp_read_obj(dp_stream *stream, dp_builder *builder, dp_diag *diag);
dp_result dp_read_off(dp_stream *stream, dp_builder *builder, dp_diag *diag);
/* Makes a source of the whole file, and of those that it names. */
dp_result dp_read_gltf(dp_stream *stream, dp_source **out, dp_diag *diag);
/* Makes a source that reads batch by batch; it owns the stream on success. */
dp_result dp_read_stl(dp_stream *stream, dp_source **out, dp_diag *diag);

/* dp_source_open and dp_source_open_memory. more_readers: the caller can read other formats too,
 * and messages say how. */
dp_result dp_open_path(const char *path, const dp_file_options *options, bool more_readers,
                       dp_source **out, dp_diag *diag);
dp_result dp_open_memory(const dp_memory_file *file, const dp_file_options *options,
                         bool more_readers, dp_source **out, dp_diag *diag);

/* The same after the file is opened. Owns the stream in any case. `name` tells the format
 * where the content does not. */
dp_result dp_read_stream(dp_stream *stream, const char *name, dp_file_format format,
                         dp_source **out, dp_diag *diag);

#endif
