/* A polygon source's inside: callbacks and an allocator. */
#ifndef DP_MESH_SOURCE_H
#define DP_MESH_SOURCE_H

#include "base/memory.h"
#include <drypoint/source.h>

/* Triangles that lie as fixed records somewhere (a binary STL) and can be read in any order. */
typedef struct dp_records {
    uint64_t count; /* triangles */
    size_t size;    /* bytes of a record */
    size_t corners; /* byte within a record where three corners start, x, y, z each, float32, as
                       this machine has them */
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
    bool constant;      /* what it hands out never changes, as arrays of the application may */
    uint64_t key;       /* of that, once somebody has computed it (mesh/normals.c); 0: nobody has */
};

/* DP_ERR_ARGUMENT where a batch's numbers do not lie where this machine reads them: pointers and
 * strides of floats must be multiples of 4 bytes, and so on. Strides of 0 are tight. */
dp_result dp_check_alignment(const dp_batch *batch, dp_diag *diag);

/* Reads all corners of a source with records, in threads: extent.c. */
dp_result dp_records_extent(dp_source *source, dp_extent *extent, dp_diag *diag);

#endif
