/* Edges that two or more polygons have: what they make of them (fan.c), and whether something else
 * that is seen there disputes it (dispute.c). */
#ifndef DP_FIND_FAN_H
#define DP_FIND_FAN_H

#include "find/edge_table.h"

/* Does the edge only split the polygons that are known to have it? Then it may be an outline, but
 * no crease. */
bool dp_edge_is_diagonal(const dp_finder *finder, const dp_edge_entry *edge);

/* Adds a line of class `line` along an edge of polygon a, if that draws such lines; or leaves the
 * edge to emerge if something else is seen beside it. `sides`: the tile polygons that are seen to
 * the left and to the right of the edge, in the direction of a; UINT32_MAX: none that is known.
 * `normals`: as in dp_add_candidate. */
void dp_add_line(dp_finder *finder, const dp_edge_entry *edge, dp_line line, const dp_spine *spine,
                 const dp_vec3 normals[2], const uint32_t sides[2]);

/* The line of an edge where the eye must decide. */
void dp_resolve_fan(dp_finder *finder, const dp_edge_entry *edge);

/* Is something seen beside the spine that passes through it, and is none of the polygons `sides`
 * that are expected there? (dispute.c) */
bool dp_is_disputed(const dp_finder *finder, const dp_spine *spine, const uint32_t sides[2]);

#endif
