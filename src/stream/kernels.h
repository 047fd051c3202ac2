/* The kernels that classify a streamed chunk. */
#ifndef DP_STREAM_KERNELS_H
#define DP_STREAM_KERNELS_H

#include "base/kernels.h"

struct dp_chunk;
struct dp_chunk_view;
struct dp_triangles;

typedef struct dp_stream_kernels {
    /* Set states and edge keys of a chunk's triangles, and list those that they leave undecided:
     *     classify   first reading; sets normals too
     *     touch      second reading
     * classify.c decides the others. */
    void (*classify)(struct dp_chunk *chunk, const struct dp_triangles *triangles,
                     const struct dp_chunk_view *view);
    void (*touch)(struct dp_chunk *chunk, const struct dp_triangles *triangles,
                  const struct dp_chunk_view *view);
} dp_stream_kernels;

DP_KERNEL_TABLES(dp_stream_kernels);

#endif
