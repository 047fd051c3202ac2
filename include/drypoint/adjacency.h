/* drypoint/adjacency.h: the index buffer that a geometry shader with adjacency takes.
 *
 *     uint32_t *six = malloc(6 * triangle_count * sizeof *six);
 *     dp_adjacency_indices(&batch, NULL, six, &diag);
 *     // glDrawElements(GL_TRIANGLES_ADJACENCY, 6 * triangle_count, GL_UNSIGNED_INT, six)
 *
 * Drypoint itself needs it nowhere: dp_style.edges = DP_EDGES_ADJACENCY builds its own. */
#ifndef DRYPOINT_ADJACENCY_H
#define DRYPOINT_ADJACENCY_H

#include <drypoint/source.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Fills six[polygon_count][6] (Hermosilla and Vázquez 2010, Figure 2.2): a triangle's corners at 0,
 * 2 and 4; at 1, 3 and 5 the corner across the edge between its neighbours in the list. Vertices at
 * one position are one; the index written is the neighbour's own. Across an open edge lies the
 * triangle's own third corner, so that it meets its own back there. Where more than two triangles
 * meet at an edge, those are neighbours whose fronts look at each other. Corners whose index is out
 * of range stay so. DP_ERR_ARGUMENT (polygons that are not triangles, too), DP_ERR_LIMIT,
 * DP_ERR_MEMORY. */
DP_API dp_result dp_adjacency_indices(const dp_batch *triangles, const dp_allocator *allocator,
                                      uint32_t *six, dp_diag *diag);

#ifdef __cplusplus
}
#endif
#endif
