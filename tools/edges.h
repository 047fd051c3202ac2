/* Counts edges, for info. */
#ifndef TOOL_EDGES_H
#define TOOL_EDGES_H

#include <drypoint/source.h>

typedef struct edge_counts {
    uint64_t open;                         /* edges with one polygon */
    uint64_t crowded;                      /* edges with three or more */
    uint64_t index, finite, area, corners; /* polygons that would be dropped, by cause */
} edge_counts;

/* Reads the source to its end; fills the extent's exact box and counts too. DP_ERR_MEMORY, or the source's error. */
dp_result count_edges(dp_source *source, dp_extent *extent, edge_counts *counts, dp_diag *diag);

#endif
