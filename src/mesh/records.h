/* Triangles that need not be read in their order. */
#ifndef DP_MESH_RECORDS_H
#define DP_MESH_RECORDS_H

#include <drypoint/source.h>

/* Triangles in records of one size (a binary STL), which can be read in any order. */
typedef struct dp_records {
    uint64_t count; /* triangles */
    size_t size;    /* bytes of a record */
    size_t corners; /* byte offset in a record of its 3 x 3 coordinates: float32, native order */
    void *user;     /* of read */
    /* Copies records [first, first + count) to `to`. May be called from several threads at once. */
    dp_result (*read)(void *user, uint64_t first, uint32_t count, uint8_t *to, dp_diag *diag);
    /* As in dp_file_options; called from the thread that reads the source. NULL allowed. */
    int (*progress)(void *progress_user, double fraction);
    void *progress_user;
} dp_records;

/* Those of a source; `read` is NULL where it is read only batch by batch. */
const dp_records *dp_source_records(const dp_source *source);

#endif
