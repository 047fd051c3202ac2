/* drypoint/adjacency.h: the index buffer that a geometry shader with adjacency takes.
 *
 *     uint32_t *six = malloc(6 * triangle_count * sizeof *six);
 *     dp_adjacency_indices(&batch, NULL, six, &diag);
 *     // glDrawElements(GL_TRIANGLES_ADJACENCY, 6 * triangle_count, GL_UNSIGNED_INT, six)
 *
 * Drypoint itself does not need it: dp_style.edges = DP_EDGES_ADJACENCY builds its own. */
#ifndef DRYPOINT_ADJACENCY_H
#define DRYPOINT_ADJACENCY_H

#include <drypoint/source.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Fills six[polygon_count][6], which the caller provides (Hermosilla and Vázquez 2010, Figure 2.2):
 *
 *     0, 2, 4   the triangle's corners
 *     1, 3, 5   the neighbour's third corner across the edges 0-2, 2-4, 4-0
 *
 * Vertices at one position count as one; the index written is the neighbour's own. Across a border
 * lies the triangle's own third corner, so that the triangle is its own back-facing neighbour.
 * Where more than two triangles meet at an edge, neighbours are those whose fronts face each other.
 * Indices out of range are copied. DP_ERR_ARGUMENT (also for polygons that are not triangles,
 * and for a corner_count below 3 * polygon_count), DP_ERR_LIMIT, DP_ERR_MEMORY. */
DP_API dp_result dp_adjacency_indices(const dp_batch *triangles, const dp_allocator *allocator,
                                      uint32_t *six, dp_diag *diag);

#ifdef __cplusplus
}
#endif
#endif
