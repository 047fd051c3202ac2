/* Edges that two or more polygons have: what they make of them (fan.c), and whether something else
 * that is seen there disputes it (dispute.c). */
#ifndef DP_FIND_FAN_H
#define DP_FIND_FAN_H

#include "core/fold.h"
#include "find/edge_table.h"

/* Does the edge only split the polygons that are known to have it? Then it may be an outline, but
 * no crease. */
bool dp_edge_is_diagonal(const dp_finder *finder, const dp_edge_entry *edge);
/* The same, or smoothing found the surface smooth there: it may be an outline, but no fold. */
bool dp_edge_is_no_fold(const dp_finder *finder, const dp_edge_entry *edge);

/* The same of an edge that is left to emerge and has two polygons. */
bool dp_emerges_smooth(const dp_finder *finder, dp_unpaired_edge edge);

/* Adds a line of class `line` along an edge of polygon a, if that draws such lines; or leaves the
 * edge to emerge if something else is seen beside it. `sides`: the tile polygons that are seen to
 * the left and to the right of the edge, in the direction of a; UINT32_MAX: none that is known.
 * `normals`: as in dp_add_candidate. */
void dp_add_line(dp_finder *finder, const dp_edge_entry *edge, dp_line line, const dp_spine *spine,
                 const dp_vec3 normals[2], const uint32_t sides[2]);

/* The line of an edge where the eye must decide. */
void dp_resolve_fan(dp_finder *finder, const dp_edge_entry *edge);

/* Is something seen beside the edge, which has this spine, that passes through it and is none of the
 * polygons `sides` that are expected there? (dispute.c) */
bool dp_is_disputed(const dp_finder *finder, dp_unpaired_edge edge, const dp_spine *spine,
                    const uint32_t sides[2]);

/* With exact ends: can the pair of polygons that met at the edge be trusted as it is wound, and what
 * else shares a vertex with it be passed over? (dispute.c) */
bool dp_trusts_pair(const dp_finder *finder, const dp_edge_entry *edge);

/* Are two polygons beside an edge parts of one side of a sheet? Then its outline is a border. */
static inline bool dp_is_one_side(const dp_tile *tile, uint32_t a, uint32_t b,
                                  const dp_beside *beside_a, const dp_beside *beside_b) {
    const uint32_t turned = tile->polygons[a].flags ^ tile->polygons[b].flags;
    return a == b || (!(turned & DP_POLYGON_FRONT) && dp_is_one_plane(beside_a, beside_b));
}

/* px: larger back faces are what they seem; smaller ones may be folds of a fine mesh. */
enum { DP_FOLDED = 4 };
static inline bool dp_may_be_folded(const dp_tile_polygon *p) {
    return !(p->flags & DP_POLYGON_FRONT) && p->x1 - p->x0 <= DP_FOLDED &&
           p->y1 - p->y0 <= DP_FOLDED;
}

/* Is a hidden fold so slight that it is left out? (hidden.c) */
bool dp_is_smooth(const dp_frame *frame, const dp_fold *fold);

/* Are back faces seen beside the spine, to its right or to its left, more than front faces?
 * (dispute.c) */
bool dp_shows_back_beside(const dp_finder *finder, const dp_spine *spine, bool right);

#endif
