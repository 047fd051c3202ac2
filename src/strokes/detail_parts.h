/* Cleaning a drawing, inside: what its parts share (detail.c, hard_edges.c, support.c). */
#ifndef DP_STROKES_DETAIL_PARTS_H
#define DP_STROKES_DETAIL_PARTS_H

#include "base/hostile.h"
#include "strokes/detail.h"

enum { DP_DETAIL_BLOCK = DP_TUNED(64, 3) };

#define DP_FULL_SUPPORT 48.0f /* with which an outline is drawn as wide as it may be */

/* Of a segment. */
typedef struct dp_line_trait {
    float length;        /* px */
    float regular;       /* 0 to 1 */
    float hard;          /* mean evidence of a hard edge, 0 to 2; at first the most it can be */
    float weight;        /* by its whole chain, 0 to 1 */
    uint32_t first, end; /* samples */
    uint32_t chain;
    bool drawn; /* as part of a hard edge */
} dp_line_trait;

typedef struct dp_line_sample {
    float x, y, along[2]; /* px; unit */
    float length;         /* px that it stands for */
    float at;             /* where on its segment, 0 to 1 */
    float gap;            /* of an outline: px of `unit`; INFINITY: before the paper */
    float outline, hard;  /* evidence */
    float support;
    uint32_t segment;
} dp_line_sample;

/* What a sample gives to others (support.c). */
typedef struct dp_voter {
    float x, y, along[2]; /* as its own */
    float evidence;       /* px */
} dp_voter;

/* One drawing while it is cleaned. Lengths of the method are in its unit, that of a picture whose
 * smaller side is 900 px. */
typedef struct dp_detail {
    const dp_frame *frame;
    dp_lines *lines;
    dp_detail_store *own;
    uint32_t count, sample_count; /* of segments, of samples */
    float unit;                   /* px: 1 at a smaller side of 900 and a detail of 1 */
    uint32_t columns, rows;       /* of cells */
} dp_detail;

static inline const dp_link *dp_links_of(const dp_detail *c, const dp_chain *chain) {
    return c->own->chains.links + chain->first;
}

/* Runs a task for each block of DP_DETAIL_BLOCK of `count` items. */
static inline void dp_in_blocks(dp_detail *c, uint32_t count, dp_task *task) {
    dp_parallel(c->frame->threads, count / DP_DETAIL_BLOCK + (count % DP_DETAIL_BLOCK != 0), task,
                c);
}

/* How segments are chained: whatever their class, at turns of up to 60 degrees; sharp edges over
 * gaps that are rounding, too, as at T-junctions. */
static const dp_chain_rule dp_detail_rule = {
    .sharpest = 0.5f, .gap = 0.25f, .step = 1e30f, .sharp = 40, .any_class = true};

/* Has a chain as much evidence of a hard edge, px, as it needs? Or is it good all along? (hard_edges.c) */
bool dp_is_hard(const dp_detail *detail, float hard);
bool dp_is_good(const dp_detail *detail, float hard, float length);

/* Decides which chains are drawn as hard edges, or as outlines as a whole: traits' hard, weight and
 * drawn (hard_edges.c). */
void dp_judge_chains(dp_detail *detail);

/* Finds what support the samples of outlines have (support.c). False when memory is out. */
bool dp_find_support(dp_detail *detail);

#endif
