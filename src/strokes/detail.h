/* What of a drawing a person would draw (dp_style.detail). */
#ifndef DP_STROKES_DETAIL_H
#define DP_STROKES_DETAIL_H

#include "strokes/lines.h"

/* Its scratch (detail.c). Zero is empty. */
typedef struct dp_detail_store {
    struct dp_line_trait *trait; /* by segment */
    struct dp_line_sample *samples;
    uint32_t *rings, *cells; /* by end: another end at that place; by cell */
    struct dp_voter *voters; /* support.c */
    float *turns;            /* by link: to the next one */
    dp_chain_store chains;
    struct dp_whole_segment *aside; /* parts of segments, but for the first */
    size_t trait_cap, samples_cap, cells_cap, voters_cap, turns_cap, aside_cap;
} dp_detail_store;

void dp_detail_store_free(dp_detail_store *store, const dp_allocator *memory);
uint64_t dp_detail_store_bytes(const dp_detail_store *store);

/* Leaves out what is not worth a line, and thins what hardly is, where the first style's `detail` asks
 * for it. False when memory is out. */
bool dp_clean_lines(const dp_frame *frame, dp_lines *lines, dp_detail_store *store);

#endif
