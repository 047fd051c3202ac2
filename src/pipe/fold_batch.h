/* Edges where two triangles meet, taken many at once (kernel/folds.inc, edges.c). */
#ifndef DP_PIPE_FOLD_BATCH_H
#define DP_PIPE_FOLD_BATCH_H

#include "pipe/spine.h"

enum { DP_FOLDS = 32 };

/* By member, axis and edge. */
typedef struct dp_fold_batch {
    float a[3][3][DP_FOLDS], b[3][3][DP_FOLDS]; /* the triangles' corners: [corner][axis], world space */
    float from[3][DP_FOLDS], to[3][DP_FOLDS];   /* the edge, in a's direction */
    double normal_a[3][DP_FOLDS], normal_b[3][DP_FOLDS], normal[3][DP_FOLDS]; /* as in dp_fold */
    double end_a[3][DP_FOLDS], end_b[3][DP_FOLDS], probe_a[3][DP_FOLDS], probe_b[3][DP_FOLDS]; /* as in dp_spine: x, y, d */
    double plain[DP_FOLDS]; /* 0: it has to be clipped, or has no mean normal, and is left to the general way */
} dp_fold_batch;

#endif
