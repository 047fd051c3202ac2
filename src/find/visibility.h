/* Candidates, their sample points (probes), and groups of those: what decides which parts of a line
 * are seen (visibility.c, hide.inc). */
#ifndef DP_FIND_VISIBILITY_H
#define DP_FIND_VISIBILITY_H

#include "core/frame.h"

/* A line that may be visible: its spine's part in this tile is to be probed. */
typedef struct dp_candidate {
    uint32_t a, b;   /* frame polygons: owner, partner or UINT32_MAX */
    uint32_t edge;   /* corner of the owner, or DP_CROSSING */
    uint32_t n;      /* sample points on the whole spine */
    uint32_t k0, k1; /* those in this tile: [k0, k1) */
    uint32_t probe;  /* first of its probes */
    uint32_t line : 8;
    uint32_t geometry : 24; /* 1 + number of the worker's; 0: they are to be found again */
} dp_candidate;

/* Sample points of spines (px, d), each member for itself, with room for one vector beyond the
 * last. A point is hidden when a polygon other than its candidate's own lies nearer than its limit,
 * which is infinite from then on. */
typedef struct dp_probes {
    float *x, *y, *limit;
} dp_probes;

enum { DP_PROBES_ROOM = 16 };

/* Some of a candidate's sample points, one after the other. */
typedef struct dp_probe_group {
    uint32_t first, count, candidate;
} dp_probe_group;

enum { DP_GROUP = 16 /* points, or fewer */ };

/* Of a pixel: a byte holds where in the tile a point lies. */
enum { DP_QUARTERS = 4 * DP_TILE };
_Static_assert(DP_QUARTERS <= 256, "as many as a byte has values");

/* Cells of the tile for a first look at where sample points are. */
enum {
    DP_CELL = 4 /* px */,
    DP_CELLS = DP_TILE / DP_CELL,
    DP_CELL_SPANS = 3,
    DP_CELL_SMALL = 9, /* px; boxes that are less wide and high than this span so many or fewer */
    DP_CELL_ROOM = DP_CELLS * (DP_CELLS + DP_CELL_SPANS) + 16
};

/* All groups of the tile's sample points, sorted by the cell of their boxes' upper left corner;
 * each member for itself, with room for one vector beyond the last. */
typedef struct dp_probe_groups {
    dp_probe_group *group;
    uint32_t *box; /* where its points lie: x0, y0, 255 - x1, 255 - y1 in quarters of a pixel, from
                      the lowest byte on, so that one comparison of bytes tells whether two meet */
    float *limit;  /* the least of its points' */
    size_t group_cap, box_cap, limit_cap;
    uint32_t first[DP_CELLS * DP_CELLS + 1]; /* by cell */
    uint32_t width, height; /* of the largest boxes, from the first quarter to the last */
    /* the least limit in 1 + sx times 1 + sy cells, the first of which is cx, cy; infinite where
     * there are no points */
    float least[DP_CELL_SPANS][DP_CELL_SPANS][DP_CELL_ROOM]; /* [sy][sx][cy, cx] */
} dp_probe_groups;

/* A tile's candidates and what decides of them. */
typedef struct dp_line_store {
    dp_candidate *candidates;
    dp_probes probes;
    const uint32_t (*owners)[2]; /* the candidates' own polygons; NULL: as the candidates say */
    bool streamed; /* the tile does not hold the polygons that have hidden the sample points */
    dp_probe_groups groups;
    size_t candidates_cap, probe_x_cap, probe_y_cap, probe_limit_cap;
    uint32_t candidate_count, probe_count;
} dp_line_store;

void dp_line_store_free(dp_line_store *store, const dp_allocator *memory);
uint64_t dp_line_store_bytes(const dp_line_store *store);

#endif
