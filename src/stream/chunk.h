/* A chunk: some thousand consecutive triangles of a source that is streamed, as one worker sees them. */
#ifndef DP_STREAM_CHUNK_H
#define DP_STREAM_CHUNK_H

#include "pipe/tile.h"

enum {
    DP_CHUNK = DP_TUNED(4096, 3),              /* triangles */
    DP_CHUNK_CORNERS = 3 * DP_CHUNK,           /* fewer than 65536: vertices are numbered in 16 bits */
    DP_CHUNK_SLOTS = DP_TUNED(32768, 32)       /* of a table of vertices or edges; a power of two, twice as many */
};

/* What is known of a triangle of a chunk. */
enum {
    DP_TRIANGLE_LIVE = 1,   /* it may be seen, and so may its edges */
    DP_TRIANGLE_COVERS = 2, /* it may cover a sample */
    DP_TRIANGLE_FRONT = 4,  /* surely faces the eye */
    DP_TRIANGLE_BACK = 8,   /* surely faces away; neither: seen edge-on */
    DP_TRIANGLE_CROWD = 16  /* touches a pixel where faces may cross */
};

typedef struct dp_chunk_edge {
    uint32_t ends;   /* chunk vertices, the smaller one in the high half */
    uint16_t a, b;   /* triangles */
    uint8_t edge_a, edge_b;
    bool ascending;  /* a runs it from the smaller number to the larger */
    uint8_t met;     /* 1, 2, or 3: more than two triangles, or two that run it the same way */
} dp_chunk_edge;

typedef struct dp_chunk {
    uint32_t count;        /* triangles */
    uint32_t vertex_count; /* different positions */
    uint16_t corner[DP_CHUNK_CORNERS];
    float position[DP_CHUNK_CORNERS][3];
    dp_point screen[DP_CHUNK_CORNERS]; /* px, depth; x NaN where the outcode is not 0 */
    uint8_t outcode[DP_CHUNK_CORNERS]; /* dp_outcode, or DP_NOT_FINITE */
    uint8_t state[DP_CHUNK];
    float normal[DP_CHUNK][4];         /* not of unit length; squared length */
    uint8_t lines[DP_CHUNK];           /* set of edges that may be lines */
    uint8_t alone[DP_CHUNK];           /* set of edges that no other triangle of the chunk has */
    dp_chunk_edge edges[DP_CHUNK_CORNERS];
    uint32_t edge_count;
    uint16_t slots[DP_CHUNK_SLOTS];    /* 1 + vertex, then 1 + edge */
} dp_chunk;

enum { DP_NOT_FINITE = 128 };

/* The depth of the furthest sample in each block of the picture; nothing further can be seen. */

/* What a chunk is held against. */
typedef struct dp_chunk_view {
    const dp_view *view;
    dp_sampling sampling;
    uint32_t tiles_x, tiles_y;
    const float *farthest;  /* [tile][DP_BLOCKS][DP_BLOCKS] */
    const uint64_t *wanted; /* [tile][DP_TILE] rows of pixels; NULL: every sample is wanted */
    const uint64_t *crowded; /* the same: where faces may cross; only with `wanted` */
    float flat_cosine;      /* dp_frame; below 0: folds are no lines */
} dp_chunk_view;

/* Triangles as they lie in a buffer: nine floats each, `stride` bytes apart. */
typedef struct dp_triangles {
    const uint8_t *corners;
    size_t stride;
    uint32_t count;
    const uint8_t *flags; /* set of edges that draw, per triangle; NULL: all */
} dp_triangles;

/* Finds equal positions, and where they lie on the screen. */
void dp_chunk_place(dp_chunk *chunk, const dp_triangles *triangles, const dp_view *view);

/* Sets `state` and `normal`: which triangles can be dropped at once, and which cover samples (or, with
 * `wanted`, pixels that are wanted). Counts what is dropped for good in *stats. */
void dp_chunk_sift(dp_chunk *chunk, const dp_chunk_view *view, dp_stats *stats);

/* Sets `lines` and `alone`: edges between triangles of the chunk. */
void dp_chunk_edges(dp_chunk *chunk, const dp_triangles *triangles, const dp_chunk_view *view);

/* The pixel in which a triangle's box begins, as an index of [tile][DP_TILE][DP_TILE]; the picture's nearest. */
uint32_t dp_chunk_pixel(const dp_chunk *chunk, uint32_t triangle, const dp_chunk_view *view);

/* Is an edge between two triangles of this state and normal surely no line? */
bool dp_edge_is_plain(uint8_t state_a, const float normal_a[4], uint8_t state_b, const float normal_b[4],
                      float flat_cosine);

/* Does a triangle lie well behind what is known of the surface? World space. */
bool dp_triangle_is_hidden(const dp_chunk_view *view, const float *a, const float *b, const float *c);

/* State (DP_TRIANGLE_FRONT, _BACK) and normal of a triangle; false when it has no area. */
bool dp_triangle_facing(const dp_view *view, const float *a, const float *b, const float *c, float normal[4],
                        uint8_t *state);

#endif
