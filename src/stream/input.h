/* A source as a run of numbered triangles, in parts of many chunks. */
#ifndef DP_STREAM_INPUT_H
#define DP_STREAM_INPUT_H

#include "stream/chunk.h"

typedef struct dp_input {
    dp_source *source;
    const dp_allocator *memory;
    dp_stats *stats; /* adds polygons, triangles, split, dropped_index, _finite, _corners */

    uint32_t part; /* triangles in a part: whole chunks */

    /* The current part. */
    uint64_t first; /* number of its first triangle */
    uint32_t count;

    /* Sources without records: the current batch, and the part's triangles copied from batches. */
    dp_batch batch;
    double origin[3];    /* of the first batch, from which all triangles are counted */
    double shift[3];     /* added to the batch's positions … */
    bool moved;          /* … if it has another origin */
    size_t taken;        /* polygons of the batch that were copied */
    uint64_t handed_out; /* polygons of earlier batches */
    float (*corners)[9]; /* [part] */
    uint8_t *flags;      /* [part] */
    uint32_t *polygons;  /* [part] */
    size_t corners_cap, flags_cap, polygons_cap;
    dp_split_scratch scratch;
} dp_input;

/* How many triangles a source is known to have before it is read; 0: that is not known. */
uint64_t dp_input_known(const dp_source *source);

/* Opens a source from its start, in parts of `chunks` chunks. */
dp_result dp_input_open(dp_input *input, dp_source *source, uint32_t chunks,
                        const dp_allocator *memory, dp_stats *stats, dp_diag *diag);
void dp_input_close(dp_input *input);
uint64_t dp_input_bytes(const dp_input *input);

/* Goes to the next part; count 0 at the end. DP_ERR_LIMIT beyond 2^32 - 3 triangles. */
dp_result dp_input_next(dp_input *input, dp_diag *diag);

/* Reads the triangles of chunk `index` of the part. buffer: dp_input_buffer_size bytes, which *out
 * may borrow. From any thread. */
dp_result dp_input_chunk(const dp_input *input, uint32_t index, uint8_t *buffer, dp_triangles *out,
                         dp_diag *diag);
size_t dp_input_buffer_size(const dp_input *input);

/* The polygon of the source that a triangle of the part belongs to. */
static inline uint32_t dp_input_polygon(const dp_input *input, uint32_t number) {
    return input->polygons ? input->polygons[number - (uint32_t)input->first] : number;
}

/* Share of the source that is read, 0 to 1; negative when its length is not known. */
double dp_input_fraction(const dp_input *input);

#endif
