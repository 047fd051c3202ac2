/* The readers of src/io, one per format, and how a stream's format is found. */
#ifndef DP_IO_READERS_H
#define DP_IO_READERS_H

#include "io/builder.h"
#include "io/stream.h"

/* The stream's format, from what its first window holds, then from the ending of `name` (NULL
 * allowed). DP_ERR_UNSUPPORTED. */
dp_result dp_detect(dp_stream *stream, const char *name, dp_file_format *format, dp_diag *diag);
/* Whether an STL file is the binary kind. */
bool dp_detect_binary_stl(dp_stream *stream);

/* Read the whole mesh into the builder; the stream stays the caller's. */
dp_result dp_read_ply(dp_stream *stream, dp_builder *builder, dp_diag *diag);
dp_result dp_read_obj(dp_stream *stream, dp_builder *builder, dp_diag *diag);
dp_result dp_read_off(dp_stream *stream, dp_builder *builder, dp_diag *diag);
/* A source that reads on as it is asked to. Takes the stream on success. */
dp_result dp_read_stl(dp_stream *stream, dp_source **out, dp_diag *diag);

/* A source of the stream, which is the function's from then on. `name` tells the format where the
 * content does not. This is dp_source_open behind the opening of the file. */
dp_result dp_read_stream(dp_stream *stream, const char *name, dp_file_format format,
                         dp_source **out, dp_diag *diag);

#endif
