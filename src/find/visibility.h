/* Candidates, their sample points (probes), and groups of these: they decide which parts of a line
 * are visible (visibility.c, hide.inc). */
#ifndef DP_FIND_VISIBILITY_H
#define DP_FIND_VISIBILITY_H

#include "core/frame.h"

/* A line that may be visible, with its spine's part in this tile. */
typedef struct dp_candidate {
    uint32_t a, b;   /* frame polygons: owner, partner or UINT32_MAX */
    uint32_t edge;   /* corner of the owner, or DP_CROSSING: an intersection */
    uint32_t n;      /* number of sample points on the whole spine */
    uint32_t k0, k1; /* those in this tile: [k0, k1) */
    uint32_t probe;  /* first of its probes */
    uint32_t line : 6;
    uint32_t seen : 2; /* bit 0: a is seen beside the line, bit 1: b is; else hidden behind it */
    uint32_t geometry : 24; /* 1 + index in the worker's `found`; 0: to be computed again */
} dp_candidate;

/* Sample points of spines (px, tile space; d), as arrays with room for one vector beyond the last.
 * A point is hidden when a polygon other than its candidate's own is nearer than `limit` there; its
 * limit is then infinite. */
typedef struct dp_probes {
    float *x, *y, *limit;
} dp_probes;

/* What is known of a sample point: the number of front faces that lie nearer, and whether anything
 * does. */
enum { DP_LEVEL_COUNT = 127, DP_LEVEL_HIDDEN = 128 };

/* For an x-ray, what lies before a sample point: the nearest front faces, nearest first, and the
 * nearest back face, which is surface where it is the nearest of all. */
enum { DP_STACK = 16 };
typedef struct dp_stack {
    float depth[DP_STACK], back; /* d; of the back face: DP_DEPTH_EMPTY, there is none */
    uint32_t polygon[DP_STACK], back_polygon;
    uint32_t count;
} dp_stack;

enum { DP_PROBES_ROOM = 16 };

/* Consecutive sample points of one candidate. */
typedef struct dp_probe_group {
    uint32_t first, count, candidate;
} dp_probe_group;

enum { DP_GROUP = 16 /* points at most */ };

/* Quarters of a pixel across the tile: a byte holds one coordinate. */
enum { DP_QUARTERS = 4 * DP_TILE };
_Static_assert(DP_QUARTERS <= 256, "as many as a byte has values");

/* Cells of the tile, for a first test where sample points lie. */
enum {
    DP_CELL = 4 /* px */,
    DP_CELLS = DP_TILE / DP_CELL,
    DP_CELL_SPANS = 3,
    DP_CELL_SMALL = 9, /* px; boxes less wide and high than this span at most DP_CELL_SPANS cells */
    DP_CELL_ROOM = DP_CELLS * (DP_CELLS + DP_CELL_SPANS) + 16
};

/* All groups of the tile's sample points, sorted by the cell that holds the upper left corner of
 * their boxes; arrays with room for one vector beyond the last. */
typedef struct dp_probe_groups {
    dp_probe_group *group;
    uint32_t *box; /* bytes x0, y0, 255 - x1, 255 - y1 from the lowest on, quarters of a pixel: one
                      comparison of bytes tells whether two boxes meet */
    float *limit;  /* the least of its points' limits */
    size_t group_cap, box_cap, limit_cap;
    uint32_t first[DP_CELLS * DP_CELLS + 1]; /* by cell: its first group; then their number */
    uint32_t width, height;                  /* of the largest boxes, quarters of a pixel */
    /* The least limit in the block of (1 + sx) × (1 + sy) cells with first cell (cx, cy); infinite
     * if there are no points. */
    float least[DP_CELL_SPANS][DP_CELL_SPANS][DP_CELL_ROOM]; /* [sy][sx][cy, cx] */
} dp_probe_groups;

/* A tile's candidates and what decides which of their points are visible. */
typedef struct dp_line_store {
    dp_candidate *candidates;
    dp_probes probes;
    const uint32_t (*owners)[2]; /* by candidate: polygons that do not hide it; NULL: its a and b */
    uint8_t *level;              /* for hidden lines, by sample point: DP_LEVEL_… */
    uint32_t levels; /* not 0: points are hidden by this many front faces, not by the first polygon;
                        others are counted in `level` (hide.inc) */
    dp_stack *stacks; /* for an x-ray, by sample point */
    float *through;   /* and as in dp_piece */
    bool stacking;    /* hiders go there, and hide nothing */
    bool streamed;    /* the tile does not hold the polygons that have hidden the sample points */
    dp_probe_groups groups;
    size_t candidates_cap, probe_x_cap, probe_y_cap, probe_limit_cap, level_cap, stacks_cap,
        through_cap;
    uint32_t candidate_count, probe_count;
} dp_line_store;

void dp_line_store_free(dp_line_store *store, const dp_allocator *memory);
uint64_t dp_line_store_bytes(const dp_line_store *store);

#endif
