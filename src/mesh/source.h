/* Inside a polygon source: callbacks and an allocator. */
#ifndef DP_MESH_SOURCE_H
#define DP_MESH_SOURCE_H

#include "base/memory.h"
#include <drypoint/source.h>

/* Triangles in records of one size (a binary STL), which can be read in any order. */
typedef struct dp_records {
    uint64_t count; /* triangles */
    size_t size;    /* bytes of a record */
    size_t corners; /* byte offset in a record of its 3 x 3 coordinates: float32, native order */
    /* Copies records [first, first + count) to `to`. May be called from several threads at once. */
    dp_result (*read)(void *user, uint64_t first, uint32_t count, uint8_t *to, dp_diag *diag);
    /* As in dp_file_options; called from the thread that reads the source. NULL allowed. */
    int (*progress)(void *progress_user, double fraction);
    void *progress_user;
} dp_records;

struct dp_source {
    dp_source_callbacks callbacks;
    dp_allocator allocator;
    dp_records records; /* read NULL: only batch by batch */
    bool constant;      /* its batches never change (an application's arrays may) */
    uint64_t key;       /* fingerprint of a constant source (mesh/normals.c); 0: not computed yet */
};

/* DP_ERR_ARGUMENT unless a batch's pointers and strides are aligned (dp_batch). Strides of 0 are
 * tight. */
dp_result dp_check_alignment(const dp_batch *batch, dp_diag *diag);

/* The extent of a source with records, read in parallel (extent.c). */
dp_result dp_records_extent(dp_source *source, dp_extent *extent, dp_diag *diag);

#endif
