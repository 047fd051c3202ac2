/* Pending triangles of a stream: those with an edge that may be a line, or that waits for its other
 * triangle. */
#ifndef DP_STREAM_PENDING_H
#define DP_STREAM_PENDING_H

#include "stream/chunk.h"

/* What is known of an edge of a pending triangle. */
enum {
    DP_EDGE_PLAIN = 0, /* no line, or not followed by this reading */
    DP_EDGE_LINE = 1,  /* may be a line */
    DP_EDGE_ALONE = 2  /* waits for its other triangle */
};

typedef struct dp_pending_triangle {
    float corners[9];
    uint32_t number;  /* in the stream */
    uint32_t polygon; /* of the source */
    uint8_t edges[3], unused;
} dp_pending_triangle;

/* A share of all edges: those with (hash >> 20 & mask) == value. */
typedef struct dp_pending_share {
    uint32_t mask, value;
} dp_pending_share;

enum { DP_SHARES_MOST = 64 };

typedef struct dp_pending {
    const dp_allocator *memory;
    const dp_chunk_view *view;
    dp_pending_triangle *triangles; /* numbers ascend */
    size_t count, cap;
    size_t settled;               /* how many were left after the last look at all of them */
    size_t limit;                 /* triangles, including those of earlier readings */
    dp_pending_triangle *earlier; /* from earlier readings; after the last reading, all */
    size_t earlier_count, earlier_cap;
    dp_pending_share share;                 /* edges that this reading follows */
    dp_pending_share later[DP_SHARES_MOST]; /* put off to later readings */
    uint32_t later_count, shares;           /* shares: how many there are in all */
    uint32_t *slots;                        /* [slot_count][2]: hash | edge, triangle number */
    size_t slots_cap;
    uint32_t slot_count, slots_used; /* used: including slots whose edge was taken out */
    uint64_t lost;                   /* waiting edges given up for want of memory */
    uint64_t thinned;                /* lines left out by thinning, counted from both sides */
    uint32_t *cells;                 /* least rank in each square of pixels, while thinning */
    size_t cells_cap;
    int thinning; /* one line to a square of 2^(thinning - 1) px; 0: all lines */
} dp_pending;

void dp_pending_free(dp_pending *kept);
uint64_t dp_pending_bytes(const dp_pending *kept);

/* Hash of the edge between p and q, the same in both directions; its two lowest bits are 0. */
uint32_t dp_edge_hash_bits(const float *p, const float *q);
/* The same without these two bits. */
static inline uint32_t dp_edge_hash(const float *p, const float *q) {
    return dp_edge_hash_bits(p, q) >> 2;
}

/* Does this share hold a triangle's edge? */
bool dp_pending_follows(dp_pending_share share, const dp_pending_triangle *triangle, uint32_t edge);

/* Stores what the reading has found, and begins the next share of edges; false when there is none.
 * *enough: false when memory is out. */
bool dp_pending_next_share(dp_pending *pending, bool *enough);

/* Joins the edges of triangles [first, count) to those that wait. Drops edges that turn out plain
 * or are no longer followed. False when memory is out. */
bool dp_pending_join(dp_pending *pending, size_t first);

#endif
