/* From intensities of discontinuity to the edge map. */
#ifndef DP_GBUFFER_EDGE_MAP_H
#define DP_GBUFFER_EDGE_MAP_H

#include "gbuffer/detect.h"
#include "gbuffer/gbuffer.h"

/* Which pixels of tile row `row` (columns [x0, x1) of the picture) are edges, how much. */
void dp_edge_map_row(const dp_gbuffer *g, const dp_edge_map *map, uint32_t y, uint32_t x0,
                     uint32_t x1, dp_edge_run *out);

/* As the paper lays it out: inner edges in RGB, profile edges in A, 255 where there is none. */
void dp_edge_map_store(const dp_edge_run *run, uint32_t n, uint8_t *rgba);

#endif
