/* What a worker needs to find the lines of its tile: edges, candidates, sample points, visible
 * pieces. Each stage declares its own scratch; here they are put together. */
#ifndef DP_FIND_FINDER_H
#define DP_FIND_FINDER_H

#include "core/piece.h"
#include "core/spine.h"
#include "find/edge_list.h"
#include "find/emergence.h"
#include "find/ends.h"
#include "find/hidden.h"
#include "find/intersections.h"
#include "find/visibility.h"

typedef struct dp_finder {
    dp_tile tile;
    dp_one_rings rings;
    dp_edge_store table;
    dp_emergence emergence;
    dp_intersecting intersecting;
    dp_line_store lines;
    dp_hidden_store hidden;
    bool finds_hidden; /* the tile's second look, at all of its polygons (hidden.c) */
    dp_end_store ends;
    dp_found *found; /* of all the worker's tiles in this frame */
} dp_finder;

/* Like dp_tile_…; `found` belongs to the caller (finder.c). */
bool dp_finder_begin(dp_finder *finder, const dp_frame *frame, dp_found *found);
void dp_finder_free(dp_finder *finder);
uint64_t dp_finder_bytes(const dp_finder *finder);
void dp_finder_open(dp_finder *finder, uint32_t index);

/* The stages, each in its own file. */
void dp_find_edges(dp_finder *finder);          /* edges.c */
void dp_find_adjacent_edges(dp_finder *finder); /* adjacent.c: instead, by adjacency */
void dp_find_emergent(dp_finder *finder);       /* emerge.c */
void dp_find_marked(dp_finder *finder);         /* marked.c */
void dp_find_intersections(dp_finder *finder);  /* intersect.c */
void dp_find_crossings(dp_finder *finder);      /* intersect.c: of all polygons, in sight or not */
void dp_find_visible(dp_finder *finder);        /* visibility.c: the next two in turn */
void dp_hide_points(dp_finder *finder);         /* hide.inc: behind the tile's seen polygons */
void dp_collect_pieces(dp_finder *finder);      /* makes pieces of runs of visible sample points */
void dp_solve_ends(dp_finder *finder);          /* ends.c: of the pieces just made */

/* Notes an end of a piece of candidate number `candidate` (ends.c). */
void dp_note_end(dp_finder *finder, uint32_t candidate, size_t piece, uint32_t side);

/* Sorts the noted ends by cell, in place of the sample points, which are not needed any more
 * (visibility.c). */
bool dp_group_ends(dp_finder *finder);

/* Is it one of the polygons that do not hide the candidate? `id`: of the frame. */
static inline bool dp_is_own(const dp_finder *finder, uint32_t candidate, uint32_t id) {
    const uint32_t(*const owners)[2] = finder->lines.owners;
    const dp_candidate *const c = &finder->lines.candidates[candidate];
    return owners ? owners[candidate][0] == id || owners[candidate][1] == id
                  : c->a == id || c->b == id;
}

/* Sorts the frame's marked edges into tiles (marked.c). False: out of memory. */
bool dp_bin_marks(dp_frame *frame);

/* Hidden lines, when all that is visible in the tile has been found: the worker's pieces from number
 * `first` on (hidden.c). */
void dp_find_hidden(dp_finder *finder, size_t first);

/* Adds a candidate, and its sample points in this tile with numbers in [k0, k1). Fills in n, probe,
 * geometry and the final k0, k1 (visibility.c). `normals`: of polygons a and b (a's twice if there
 * is no b); NULL if not at hand. */
void dp_add_candidate(dp_finder *finder, dp_candidate candidate, const dp_spine *spine,
                      const dp_vec3 normals[2]);

/* 1 if the tile polygon is one of those that are seen on either side of a line, else 0. */
static inline uint32_t dp_seen_beside(const uint32_t sides[2], uint32_t polygon) {
    return polygon != UINT32_MAX && (sides[0] == polygon || sides[1] == polygon);
}

/* Notes that a line is made along this edge of a tile polygon; false: out of memory (emerge.c). */
bool dp_note_drawn(dp_finder *finder, uint32_t polygon, uint32_t edge);
/* One that has been decided together with others, of more than two polygons, or wound alike (fan.c): it
 * is drawn, or emerges, with them. */
bool dp_note_served(dp_finder *finder, uint32_t polygon, uint32_t edge);

/* Leaves the edge to emerge. */
void dp_leave_to_emerge(dp_finder *finder, dp_unpaired_edge edge);

/* Appends a polygon's half-edges to the list, which has room for them (edge_table.c). */
void dp_edge_list_polygon(dp_finder *finder, uint32_t polygon);

#endif
