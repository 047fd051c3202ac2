/* Sections: what a plane cuts out of a model. Segments are collected while the model is read; then
 * they are chained to loops, filled, hatched and outlined. */
#ifndef DP_MESH_SECTION_H
#define DP_MESH_SECTION_H

#include "base/memory.h"
#include "base/vec.h"
#include <drypoint/section.h>

/* A point of a plane, along its vectors u and v. */
typedef struct dp_flat_point {
    double u, v;
} dp_flat_point;

/* A plane about the source's origin: n·p = offset, with unit vectors u (to the right) and v (up) for
 * who looks against n. */
typedef struct dp_section_plane {
    dp_vec3 n, u, v;
    double offset;
} dp_section_plane;

/* A half of a plane that another clip plane leaves: a * u + b * v <= c. */
typedef struct dp_half_plane {
    double a, b, c;
} dp_half_plane;

/* Where a polygon was cut; the inside is to the left. */
typedef struct dp_cut_segment {
    dp_flat_point end[2];
    uint16_t group;
} dp_cut_segment;

/* An end of a segment, to be sorted by its place. */
typedef struct dp_placed_end {
    dp_flat_point at;
    uint32_t end; /* 2 * segment: its tail, and 1 more: its head */
} dp_placed_end;

/* An edge of a closed loop: from below (v0) to above (v1), or level, which the sweep does not see. */
typedef struct dp_fill_edge {
    double u0, v0, u1, v1, slope; /* du / dv */
    int32_t winding;              /* what it adds to the winding number on its right */
    int32_t after;                /* the winding number there, while the edge is active */
    uint32_t right;               /* the edge that bounds the trapezoid begun here; … */
    double since;                 /* … where that begins */
    bool begun, ends;             /* it is the left bound of a trapezoid; the right one */
    uint32_t place;               /* in the list of active edges */
    uint32_t crosses;             /* the edge whose crossing was noted last */
} dp_fill_edge;

/* What receives a section: faces as convex polygons, and lines. False: memory is out. */
typedef struct dp_section_sink {
    bool (*face)(void *user, const dp_flat_point *points, uint32_t count);
    bool (*line)(void *user, dp_flat_point a, dp_flat_point b, dp_edge_kind flag);
    void *user;
    const dp_half_plane *halves; /* [half_count] of the other planes */
    uint32_t half_count;
    uint32_t outlined; /* set of halves along whose borders a line is drawn */
} dp_section_sink;

typedef struct dp_loose_end {
    double u, v, length; /* length of its chain */
    uint32_t end, other; /* end of a segment; the chain's other end */
} dp_loose_end;

typedef struct dp_fill_event {
    double v;
    uint32_t edge;
    bool begins;
} dp_fill_event;

typedef struct dp_fill_crossing {
    double v;
    uint32_t left, right;
} dp_fill_crossing;

typedef struct dp_hatch_crossing {
    double line, at;
    int32_t winding;
} dp_hatch_crossing;

/* Scratch for one section after the other; arrays stay. Zero is empty. */
typedef struct dp_section_scratch {
    dp_cut_segment *cuts; /* of one group, each once */
    dp_placed_end *ends;  /* sorted by place */
    uint32_t *partner;    /* by end: the one that it is joined to */
    uint8_t *seen;        /* by segment */
    dp_loose_end *loose;
    uint32_t *nearest;   /* by loose end */
    dp_fill_edge *edges; /* of closed loops */
    dp_fill_event *events;
    dp_fill_crossing *crossings; /* a heap */
    uint32_t *active;
    dp_hatch_crossing *hatches;
    size_t cuts_cap, ends_cap, partner_cap, seen_cap, loose_cap, nearest_cap, edges_cap, events_cap,
        crossings_cap, active_cap, hatches_cap;
    size_t cut_count, gap_count, loose_count, edge_count, event_count, crossing_count, active_count,
        hatch_count;
    uint64_t crossings_left; /* that may still be noted */
} dp_section_scratch;

void dp_section_scratch_free(dp_section_scratch *scratch, const dp_allocator *memory);

/* Hatching of one group. */
typedef struct dp_hatching {
    dp_section_look look;
    double angle;   /* radians */
    double spacing; /* world units */
} dp_hatching;

/* Makes faces, outlines and hatching of segments [0, count), all of one group. False: memory is
 * out. */
bool dp_section_make(dp_section_scratch *scratch, const dp_cut_segment *segments, size_t count,
                     const dp_hatching *hatching, const dp_section_sink *sink,
                     const dp_allocator *memory);

/* The steps of dp_section_make. Fills `edges` with those of closed loops (section_loops.c); hands
 * over the inside as trapezoids (section_fill.c), and lines inside (section_hatch.c). */
bool dp_section_chain(dp_section_scratch *scratch, const dp_allocator *memory);
bool dp_section_fill(dp_section_scratch *scratch, const dp_section_sink *sink,
                     const dp_allocator *memory);
bool dp_section_hatch(dp_section_scratch *scratch, const dp_hatching *hatching,
                      const dp_section_sink *sink, const dp_allocator *memory);
bool dp_section_outline(dp_section_scratch *scratch, const dp_section_sink *sink,
                        const dp_allocator *memory);

/* Cuts a line to what the half planes leave, but for number `except`. False: nothing. */
bool dp_section_cut_line(const dp_section_sink *sink, uint32_t except, dp_flat_point *a,
                         dp_flat_point *b);

#endif
