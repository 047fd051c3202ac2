/* What is kept of a stream: the triangles whose edges may be lines, or wait for their other
 * triangle. */
#ifndef DP_STREAM_PENDING_H
#define DP_STREAM_PENDING_H

#include "stream/chunk.h"

/* What is known of an edge of a kept triangle. */
enum { DP_EDGE_PLAIN = 0, DP_EDGE_LINE = 1, DP_EDGE_ALONE = 2 };

typedef struct dp_pending_triangle {
    float corners[9];
    uint32_t number;  /* in the stream */
    uint32_t polygon; /* of the source */
    uint8_t edges[3], unused;
} dp_pending_triangle;

/* Edges whose hash has these low bits. */
typedef struct dp_pending_share {
    uint32_t mask, value;
} dp_pending_share;

enum { DP_SHARES_MOST = 64 };

typedef struct dp_pending {
    const dp_allocator *memory;
    const dp_chunk_view *view;
    dp_pending_triangle *triangles; /* numbers ascend */
    size_t count, cap;
    size_t settled;               /* how many were left when all were last looked at */
    size_t limit;                 /* triangles, those of earlier readings included */
    dp_pending_triangle *earlier; /* what earlier readings kept; after the last, all in one */
    size_t earlier_count, earlier_cap;
    dp_pending_share share;                 /* edges that this reading follows */
    dp_pending_share later[DP_SHARES_MOST]; /* and others, still to come */
    uint32_t later_count, shares;
    uint32_t *slots; /* 2 * slot_count: hash and edge, triangle number */
    size_t slots_cap;
    uint32_t slot_count, slots_used; /* used: also by what was taken out */
    uint64_t lost;                   /* edges given up for want of memory while they waited */
    uint64_t thinned; /* lines left out where there are too many, counted from both sides */
    uint32_t *cells;  /* by square of pixels, while lines are thinned */
    size_t cells_cap;
    int thinning; /* one line to a square of 2^(thinning - 1) px; 0: not at all */
} dp_pending;

void dp_pending_free(dp_pending *kept);

/* The same from both sides of the edge from p to q; its two lowest bits are 0. */
uint32_t dp_edge_hash_bits(const float *p, const float *q);
/* One for a table of its own. */
static inline uint32_t dp_edge_hash(const float *p, const float *q) {
    return dp_edge_hash_bits(p, q) >> 2;
}

/* Does a reading that follows this share follow the edge of a triangle? */
bool dp_pending_follows(dp_pending_share share, const dp_pending_triangle *triangle, uint32_t edge);

/* Begins with the next share of edges; false when there is none. *enough: false when memory is
 * out. */
bool dp_pending_next_share(dp_pending *kept, bool *enough);

/* Edges of triangles [first, count) meet those that waited; what turns out plain is dropped, and so
 * are edges that are not followed any more. False when memory is out. */
bool dp_pending_join(dp_pending *kept, size_t first);

uint64_t dp_pending_bytes(const dp_pending *kept);

#endif
