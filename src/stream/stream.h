/* Drawing a source that does not fit into memory: it is read in parts, once or twice. */
#ifndef DP_STREAM_STREAM_H
#define DP_STREAM_STREAM_H

#include "find/finder.h"
#include "raster/stages.h"

/* Memory beyond the picture's, bytes: the default, and the least that works. */
#define DP_MEMORY_DEFAULT ((size_t)256 << 20)
#define DP_MEMORY_LEAST   ((size_t)48 << 20)

/* Progress of a drawing when the last reading is over. */
#define DP_STREAMED 0.95

/* Is this a source of records (of known size) too large to be gathered within `memory` bytes? */
bool dp_stream_is_large(const dp_source *source, size_t memory);

/* What a streamed drawing takes; all borrowed. */
typedef struct dp_stream_setup {
    dp_frame *frame;            /* begun: view, style, target, depth */
    dp_finder *finders;         /* [workers] begun */
    dp_bin_worker *bin_workers; /* [workers] */
    uint32_t workers;
    size_t limit;    /* bytes beyond the picture */
    dp_stats *stats; /* counts are added */
    /* Takes the share of the work that is done, 0 to 1; negative: unknown. An error that it
     * returns ends the drawing. */
    dp_result (*report)(void *arg, double done, dp_diag *diag);
    void *arg;
} dp_stream_setup;

/* Takes the place of dp_draw's stages up to the tiles.
 *     dp_stream_read_model  the first reading: faces into frame->depth, pending edges
 *     dp_stream_find        the target's surface, the finders' pieces, and frame->polygons: only
 *                           the triangles that have lines, owned by *stream
 * dp_stream_free frees *stream, also after an error. */
typedef struct dp_stream_draw dp_stream_draw;
dp_result dp_stream_read_model(const dp_stream_setup *setup, dp_source *source,
                               dp_stream_draw **stream, dp_diag *diag);
dp_result dp_stream_find(dp_stream_draw *stream, dp_diag *diag);
void dp_stream_free(dp_stream_draw *stream);            /* NULL allowed */
uint64_t dp_stream_bytes(const dp_stream_draw *stream); /* the same; while no task runs */

#endif
