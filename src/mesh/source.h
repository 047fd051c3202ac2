/* Inside a polygon source: callbacks and an allocator. */
#ifndef DP_MESH_SOURCE_H
#define DP_MESH_SOURCE_H

#include "base/memory.h"
#include "base/threads.h"
#include "mesh/batch.h"
#include "mesh/records.h"
#include "mesh/reach.h"
#include <drypoint/source.h>

struct dp_source {
    dp_source_callbacks callbacks;
    dp_allocator allocator;
    dp_records records; /* read NULL: only batch by batch */
    bool constant;      /* its batches never change (an application's arrays may) */
    bool moves;         /* dp_source_set_time has moved it: what is made of it will be made again */
    uint64_t key;       /* fingerprint of a constant source (mesh/normals.c); 0: not computed yet */
    bool holds;         /* dp_source_next is to return this batch, read ahead by dp_source_begin */
    dp_batch held;
    /* Sources that compute what they hand out may use these threads until they are taken back (NULL);
     * one made of others lends them on. NULL: it does not compute. */
    void (*lend)(void *user, dp_threads *threads);
    /* Of a scene: which of its sources a group is of. NULL: it is no scene. */
    uint32_t (*part_of_group)(const void *user, uint32_t group);
};

/* Lends threads to a source for a drawing, or takes them back with NULL. */
void dp_source_lend(dp_source *source, dp_threads *threads);

/* To the source's start, if it can be rewound, and the origin of the batch that comes next: 0 0 0
 * at the end. */
dp_result dp_source_begin(dp_source *source, double origin[3], dp_diag *diag);

/* Makes min and max of exact_min and exact_max; a box of nothing (from INFINITY on) becomes 0. */
void dp_extent_round(dp_extent *extent);

/* dp_source_measure of a source with records, read in parallel (extent_records.c). */
dp_result dp_records_measure(dp_source *source, dp_extent *extent, dp_reach *reach, dp_diag *diag);

/* Adds the polygon of a batch's corners [first, last), if it is drawn; `shift` moves its positions to
 * the reach's origin. */
void dp_reach_add_polygon(dp_reach *reach, const dp_batch *batch, size_t first, size_t last,
                          const double shift[3]);

#endif
