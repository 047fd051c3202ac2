/* Batches of polygons: what readers of sources ask of them. */
#ifndef DP_MESH_BATCH_H
#define DP_MESH_BATCH_H

#include <drypoint/source.h>

/* What moves a batch's positions so that they count from another origin. False: nothing is to be
 * moved. */
static inline bool dp_batch_shift(const dp_batch *batch, const double origin[3], double shift[3]) {
    for (int k = 0; k < 3; k++) shift[k] = batch->origin[k] - origin[k];
    return shift[0] != 0 || shift[1] != 0 || shift[2] != 0;
}

/* DP_ERR_ARGUMENT unless a batch's pointers and strides are aligned (dp_batch). Strides of 0 are
 * tight. */
dp_result dp_check_alignment(const dp_batch *batch, dp_diag *diag);

/* Can a batch, whose position_stride is set, be walked safely? DP_ERR_ARGUMENT, DP_ERR_LIMIT. */
dp_result dp_check_batch(const dp_batch *batch, dp_diag *diag);

#endif
