/* Ends of visible pieces, solved (ends.c): where the stretch begins that hides the next sample
 * point. */
#ifndef DP_FIND_ENDS_H
#define DP_FIND_ENDS_H

#include "core/piece.h"

/* The end of a piece at which a sample point follows that may be hidden, or another tile's. */
typedef struct dp_open_end {
    size_t piece;       /* in the worker's `found` */
    uint32_t candidate; /* whose piece it is */
    uint32_t side;      /* 0: its first sample point; 1: its last */
    uint32_t hider;     /* 1 + the first of what may hide it, in `hiders`; 0: nothing */
    dp_pointd from, to; /* the piece's last sample point and the next one: px, tile space; d: how
                            near a polygon must be to hide it */
} dp_open_end;

/* A polygon of the tile that may hide something between an end's two sample points. */
typedef struct dp_end_hider {
    uint32_t polygon;
    uint32_t next;   /* 1 + the end's next; 0: none */
    double from, to; /* what it hides: 0 is the end's point that is seen, 1 the next */
} dp_end_hider;

typedef struct dp_end_store {
    dp_pointd (*spines)[2]; /* by candidate: its spine's probe_a, probe_b */
    dp_open_end *ends;
    dp_end_hider *hiders;
    size_t spines_cap, ends_cap, hiders_cap;
    uint32_t count, hider_count;
} dp_end_store;

void dp_end_store_free(dp_end_store *store, const dp_allocator *memory);
uint64_t dp_end_store_bytes(const dp_end_store *store);

#endif
