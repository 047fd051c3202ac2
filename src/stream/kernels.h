/* The kernels that classify a streamed chunk. */
#ifndef DP_STREAM_KERNELS_H
#define DP_STREAM_KERNELS_H

#include "base/kernels.h"

struct dp_chunk;
struct dp_chunk_view;
struct dp_triangles;

typedef struct dp_stream_kernels {
    /* Sets state and edge keys of a chunk's triangles, and lists those that are left to the general
     * way: in the first reading, with their normals, and in the second (classify.inc,
     * stream/classify.c). */
    void (*classify)(struct dp_chunk *chunk, const struct dp_triangles *triangles,
                     const struct dp_chunk_view *view);
    void (*touch)(struct dp_chunk *chunk, const struct dp_triangles *triangles,
                  const struct dp_chunk_view *view);
} dp_stream_kernels;

DP_KERNEL_TABLES(dp_stream_kernels);

#endif
