/* From intensities of discontinuity to the edge map (Nienhaus and Döllner 2003, 4.1.2). */
#ifndef DP_GBUFFER_EDGE_MAP_H
#define DP_GBUFFER_EDGE_MAP_H

#include "gbuffer/detect.h"
#include "gbuffer/gbuffer.h"

/* Strengths of edges in columns [x0, x1) of row y of the picture; x1 - x0 <= DP_TILE. */
void dp_edge_map_row(const dp_gbuffer *g, const dp_edge_map *map, uint32_t y, uint32_t x0,
                     uint32_t x1, dp_edge_run *out);

/* Writes the paper's layout, rgba[n][4]: inner edges in RGB, profile edges in A; 255: no edge. */
void dp_edge_map_store(const dp_edge_run *run, uint32_t n, uint8_t *rgba);

#endif
