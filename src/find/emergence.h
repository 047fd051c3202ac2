/* Edges that the table leaves over, and what is looked for beside them (emerge.c, look.inc). */
#ifndef DP_FIND_EMERGENCE_H
#define DP_FIND_EMERGENCE_H

#include "find/visibility.h"
#include "raster/tile.h"

/* An edge of which the table does not know everything. */
typedef struct dp_unpaired_edge {
    uint32_t polygon, edge; /* tile polygon, corner */
    uint32_t partner;       /* 1 + another tile polygon that has it; 0: none is known */
    bool trusted;           /* of what shares a vertex with it only these two matter (dispute.c) */
} dp_unpaired_edge;

/* How far from the edge a polygon is looked for, px: NEAR, close enough to hit the smallest
 * triangle, then FAR enough to reach across a crack. */
#define DP_LOOK_NEAR 0.002f
static inline float dp_look_far(const dp_tile *w) { return w->frame->crack; }

/* The depth by which polygon p's plane may miss a point at depth d and still pass through it:
 * frame->touching is measured across the plane. */
static inline float dp_touching(const dp_tile *w, const dp_tile_polygon *p, float d) {
    return w->frame->touching * (dp_depth_steps(w->frame, d, 1) + fabsf(p->dx) + fabsf(p->dy));
}

/* A surface that lies over a point, but by less than lines are lifted off theirs, hides it too:
 * within this many pixel sizes in front of it, where it is not seen so steeply that rounding
 * decides, and is no neighbour of the edge's polygon: the bulges of a fine mesh do not count. */
#define DP_OVER          0.3f
#define DP_OVER_STEEPEST 3 /* pixel sizes per px */

static inline float dp_over(const dp_tile *w, const dp_tile_polygon *p, float d) {
    const float step = fabsf(dp_depth_steps(w->frame, d, 1)), slope = fabsf(p->dx) + fabsf(p->dy);
    return slope <= DP_OVER_STEEPEST * step ? DP_OVER * (step + slope) : 0;
}

/* A sample point of an edge. */
typedef struct dp_lookout {
    float x, y, d; /* px, tile space; depth */
    float ox, oy;  /* px: unit vector to one side of the edge on the screen */
    float along;   /* change of depth per px along the edge, which has that side to its right */
} dp_lookout;

/* Does the polygon's plane hold the edge, not only the point? Of triangles that merely share a corner
 * with it, as those around a vertex of a fine mesh do, all pass through it near that corner; they
 * are told by the last hundredths of a degree. */
static inline bool dp_holds_edge(const dp_tile *w, const dp_tile_polygon *p, const dp_lookout *at,
                                 bool shares_corner) {
    const float turn = p->dx * at->oy - p->dy * at->ox - at->along,
                scale = fabsf(dp_depth_steps(w->frame, at->d, 1)) + fabsf(p->dx) + fabsf(p->dy);
    const float most = w->frame->precision > 0 ? 0.1f : shares_corner ? 2e-3f : 0.05f;
    return fabsf(turn) <= most * scale;
}

/* Does a polygon that lies over the point, by no more than dp_over, lie over the edge? One that
 * crosses it hides it from where it is nearer than the sample points, which are lifted: with exact
 * ends that decides. */
static inline bool dp_lies_over(const dp_tile *w, const dp_tile_polygon *p, const dp_lookout *at) {
    return !w->frame->exact_ends || dp_holds_edge(w, p, at, false);
}

/* By keys of positions: how many of an edge's ends are corners of the polygon, or 2 only where it has
 * the edge; whether two polygons have a corner in common. */
static inline uint32_t dp_shared_ends(const dp_tile *w, const dp_tile_polygon *p,
                                      dp_unpaired_edge edge) {
    const dp_tile_polygon *const q = &w->polygons[edge.polygon];
    const dp_vertex *const v = w->points + p->point, *const u = w->points + q->point;
    if ((p->flags | q->flags) & DP_POLYGON_CLIPPED) return 0;
    const uint32_t a = u[edge.edge].key, b = u[edge.edge + 1 == q->points ? 0 : edge.edge + 1].key;
    uint32_t most = 0, last = v[p->points - 1u].key;
    for (uint32_t i = 0; i < p->points; i++) {
        const uint32_t key = v[i].key, shared = (key == a || key == b) + (last == a || last == b);
        most = shared > most ? shared : most;
        last = key;
    }
    return most;
}
static inline bool dp_are_neighbours(const dp_tile *w, const dp_tile_polygon *p,
                                     const dp_tile_polygon *q) {
    const dp_vertex *const v = w->points + p->point, *const u = w->points + q->point;
    for (uint32_t i = 0; i < p->points; i++)
        for (uint32_t k = 0; k < q->points; k++)
            if (v[i].key == u[k].key) return true;
    return false;
}

/* Does the polygon touch one of the two of a trusted edge? It does not lie beyond a crack then. */
static inline bool dp_is_beside_pair(const dp_tile *w, const dp_tile_polygon *p,
                                     dp_unpaired_edge edge) {
    return edge.trusted && (dp_are_neighbours(w, p, &w->polygons[edge.polygon]) ||
                            dp_are_neighbours(w, p, &w->polygons[edge.partner - 1]));
}

/* Does the polygon merely meet a trusted edge at one of its ends? (dispute.c) */
bool dp_merely_meets(const dp_tile *tile, const dp_tile_polygon *polygon, dp_unpaired_edge edge);

/* px: so near by another polygon's edge is the same line. */
#define DP_ALONG_NEAR (2 * DP_LOOK_NEAR)

/* The number of an edge that bounds the polygon and runs along this point, within `reach` px;
 * UINT32_MAX: none does (dispute.c). */
uint32_t dp_edge_along(const dp_tile *tile, const dp_tile_polygon *polygon, const dp_lookout *at,
                       double reach);

/* Sample points of edges beside which polygons are looked for, sorted by the cell that they lie in;
 * arrays with room for one vector beyond the last. */
enum { DP_LOOK_CELL = 2 /* px */, DP_LOOK_CELLS = DP_TILE / DP_LOOK_CELL };
typedef struct dp_lookouts {
    float *x, *y, *d; /* px, tile space; depth */
    float *ox, *oy;   /* px: unit vector to the right of the edge on the screen */
    float *step;      /* depth of frame->touching pixel sizes */
    uint32_t *point;  /* its number, in the order of edges */
    uint32_t *own;    /* the edge's polygon */
    size_t x_cap, y_cap, d_cap, ox_cap, oy_cap, step_cap, point_cap, own_cap;
    uint32_t first[DP_LOOK_CELLS * DP_LOOK_CELLS + 1]; /* by cell: its first point */
    uint64_t row[DP_TILE]; /* pixels within dp_look_far of which there are points */
    /* By blocks of cells of DP_CELL px, as dp_cell_bits: do they hold such pixels? */
    uint32_t there[DP_CELL_SPANS][DP_CELL_SPANS][DP_CELL_ROOM];
} dp_lookouts;

enum { DP_LOOK_ROOM = 16 };

/* What has been found at one sample point. Tile polygons and their edges; UINT32_MAX: none.
 * Index 0: to the left of the edge, 1: to the right. */
typedef struct dp_beheld {
    dp_unpaired_edge own;              /* the edge that is looked at */
    dp_unpaired_edge nearest[2];       /* of those that reach the edge, with its edge along here */
    uint32_t furthest[2];              /* of these */
    float nearest_d[2], furthest_d[2]; /* how near they lie a little way off */
    dp_unpaired_edge
        first;       /* of those with an edge along here, the one that comes first in the source */
    bool is_hidden;  /* a surface lies just over the point */
    bool is_drawn;   /* one of them has made a line of it already */
    bool is_foreign; /* one of them is neither the edge's polygon nor its partner */
} dp_beheld;

typedef struct dp_emergence {
    dp_lookouts lookouts;
    dp_unpaired_edge *unpaired;
    dp_lookout *placed;       /* by point, like `beheld` */
    dp_beheld *beheld;        /* by point */
    dp_unpaired_edge *drawn;  /* edges that the table has made lines of */
    dp_unpaired_edge *served; /* those that it has decided together with others (dp_note_served) */
    uint32_t *drawn_of;    /* by tile polygon: a bit for each of its first 32 edges among these */
    uint32_t *emerging_of; /* the same of those that are looked at here, or their partners are */
    struct dp_emerging *edges; /* those with sample points here (emerge.c) */
    size_t unpaired_cap, edges_cap, placed_cap, beheld_cap, drawn_cap, drawn_of_cap,
        emerging_of_cap, served_cap;
    uint32_t unpaired_count, drawn_count, served_count;
} dp_emergence;

void dp_emergence_free(dp_emergence *emergence, const dp_allocator *memory);
uint64_t dp_emergence_bytes(const dp_emergence *emergence);

struct dp_finder;

/* Which edges are drawn, and which emerge (emerging_marks.c): dp_mark_drawn clears the marks, and marks
 * what dp_note_drawn was told. Edges that are neither, flat ones on which something stands, say, make
 * no line. */
bool dp_mark_drawn(struct dp_finder *finder);
void dp_mark_emerging(struct dp_finder *finder, dp_unpaired_edge edge);
bool dp_is_drawn(const struct dp_finder *finder, dp_unpaired_edge edge);
bool dp_emerges(const struct dp_finder *finder, dp_unpaired_edge edge);

/* Tells sample point `lookout` that tile polygon `index`, whose plane passes through it, covers
 * what lies to its left and right: `sides`, bits DP_LOOK_… (emerge.c). */
enum { DP_LOOK_LEFT = 1, DP_LOOK_RIGHT = 2, DP_LOOK_FAR_LEFT = 4, DP_LOOK_FAR_RIGHT = 8 };
void dp_behold(struct dp_finder *finder, uint32_t lookout, uint32_t index, uint32_t sides);

#endif
