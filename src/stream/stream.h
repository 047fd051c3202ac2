/* Drawing a source that does not fit into memory: it is read in parts, once or twice. */
#ifndef DP_STREAM_STREAM_H
#define DP_STREAM_STREAM_H

#include "draw/context.h"

/* Memory beyond the picture, bytes: what is taken when nothing is said, and the least that
 * works. */
#define DP_MEMORY_DEFAULT ((size_t)256 << 20)
#define DP_MEMORY_LEAST   ((size_t)48 << 20)

/* Is a source of records, whose size is known, too large to be gathered within `memory` bytes? */
bool dp_stream_is_large(const dp_source *source, size_t memory);

/* In place of dp_draw's stages up to the tiles: first all that the faces and edges of the source
 * tell; then the target's surface, the workers' pieces, and frame->polygons, which then holds only
 * the triangles that have lines. What was kept stays with *stream until dp_stream_free. */
typedef struct dp_stream_draw dp_stream_draw;
dp_result dp_stream_read_model(dp_context *context, dp_source *source, dp_stream_draw **stream,
                               dp_diag *diag);
dp_result dp_stream_find(dp_stream_draw *stream, dp_diag *diag);
void dp_stream_free(dp_stream_draw *stream); /* NULL allowed */

#endif
