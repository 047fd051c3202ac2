/* A chunk: some thousand consecutive triangles of a streamed source, as one worker sees them. */
#ifndef DP_STREAM_CHUNK_H
#define DP_STREAM_CHUNK_H

#include "raster/tile.h"
#include "stream/kernels.h"

#include <string.h>

enum {
    DP_CHUNK = DP_TUNED(4096, 3),         /* triangles */
    DP_CHUNK_EDGES = 3 * DP_CHUNK,        /* < 65536: edges are numbered in 16 bits */
    DP_CHUNK_SLOTS = DP_TUNED(32768, 32), /* of the edge table; a power of two, >= 2 per edge */
    DP_CHUNK_ROOM = 16                    /* triangles: kernels write whole vectors */
};

/* px: lines and samples this far outside the picture count too, as bins are widened. */
#define DP_CLASSIFY_MARGIN 2
/* Pixel sizes: a triangle is hidden if it lies this far behind the surface in all blocks around it,
 * as in raster/cull.c. */
#define DP_CLASSIFY_SLACK 6
/* px: rounding of positions on the screen. */
#define DP_CLASSIFY_ROUNDING (1.0f / 512)

/* What is known of a triangle of a chunk. */
enum {
    DP_TRIANGLE_LIVE = 1,     /* it may be seen, and so may its edges */
    DP_TRIANGLE_COVERS = 2,   /* it may cover a sample */
    DP_TRIANGLE_FRONT = 4,    /* surely faces the eye */
    DP_TRIANGLE_BACK = 8,     /* surely faces away; neither bit: seen edge-on */
    DP_TRIANGLE_FLAGGED = 16, /* touches a pixel where faces may cross */
    DP_TRIANGLE_WITHIN = 32   /* lies wholly in the picture; only a hint, need not be set */
};

typedef struct dp_chunk_edge {
    uint16_t a, b; /* triangles */
    uint8_t edge_a, edge_b;
    uint8_t met; /* triangles: 1, 2, or 3: more than two, or two that disagree in winding */
} dp_chunk_edge;

typedef struct dp_chunk {
    uint32_t count; /* triangles */
    uint32_t unsure_count;
    uint16_t unsure[DP_CHUNK];               /* triangles that the kernel left undecided */
    uint16_t listed[DP_CHUNK];               /* scratch: some of the triangles */
    uint8_t state[DP_CHUNK + DP_CHUNK_ROOM]; /* DP_TRIANGLE_… */

    /* x, y, z (not of unit length), squared length */
    float normal[DP_CHUNK + DP_CHUNK_ROOM][4];
    /* of the ends' positions, the same in both directions */
    uint32_t edge_key[3][DP_CHUNK + DP_CHUNK_ROOM];

    uint8_t lines[DP_CHUNK]; /* set of edges that may be lines */
    uint8_t alone[DP_CHUNK]; /* set of edges that no other triangle of the chunk has */
    dp_chunk_edge edges[DP_CHUNK_EDGES];
    uint32_t edge_count;
    uint32_t slots[DP_CHUNK_SLOTS]; /* high half of the key, 1 + edge; 0: free */
} dp_chunk;

/* The pixels that the second reading looks at, two bits a pixel: 1 wanted, 2 flagged. Four maps
 * hold the union of the bits over
 *
 *     0   the pixel
 *     1   the pixel and its right neighbour
 *     2   the pixel and the one below
 *     3   all four
 *
 * so that one look into one map decides for the box of a small triangle. */
typedef struct dp_pixel_maps {
    uint32_t *words; /* 16 pixels each */
    size_t words_cap;
    uint32_t row; /* words */
    uint32_t map; /* words */
} dp_pixel_maps;

/* What a chunk's triangles are compared with. */
typedef struct dp_chunk_view {
    const dp_view *view;
    const dp_stream_kernels *kernels;
    dp_sampling sampling;
    uint32_t tiles_x, tiles_y;
    const float *farthest;   /* [tile][DP_BLOCKS][DP_BLOCKS] depth of the farthest sample of each
                                block; nothing farther can be seen */
    const uint64_t *wanted;  /* [tile][DP_TILE] rows of pixels; NULL: every sample is wanted */
    const uint64_t *flagged; /* [tile][DP_TILE]: where faces may cross; only with `wanted` */
    dp_pixel_maps maps;      /* of `wanted` and `flagged` */
    float flat_cosine;       /* of dp_frame; < 0: folds are no lines */
} dp_chunk_view;

/* Triangles in a buffer: nine floats each, `stride` bytes apart, not aligned. */
typedef struct dp_triangles {
    const uint8_t *corners;
    size_t stride;
    uint32_t count;
    const uint8_t *flags; /* set of edges that draw, per triangle; NULL: all */
} dp_triangles;

/* Copies a triangle's corners; -0 becomes 0, so that equal positions have equal bits. */
static inline void dp_triangle_corners(const dp_triangles *triangles, uint32_t t,
                                       float corners[9]) {
    memcpy(corners, triangles->corners + t * triangles->stride, 9 * sizeof *corners);
    for (int i = 0; i < 9; i++) corners[i] += 0.0f;
}

/* Sets `state`, `normal` and `edge_key`. State 0: the triangle is dropped. DP_TRIANGLE_COVERS: it
 * may cover a sample, or, with `wanted`, touches a wanted pixel (normals are not set then). Counts
 * triangles without area or with NaN or infinity in *stats. */
void dp_chunk_classify(dp_chunk *chunk, const dp_triangles *triangles, const dp_chunk_view *view,
                       dp_stats *stats);

/* Sets `lines` and `alone` from the edges between triangles of the chunk. */
void dp_chunk_edges(dp_chunk *chunk, const dp_triangles *triangles, const dp_chunk_view *view);

/* The pixel where a triangle's box begins, clamped to the picture, as an index of
 * [tile][DP_TILE][DP_TILE]. */
uint32_t dp_chunk_pixel(const float corners[9], const dp_chunk_view *view);

/* May the edge from p to q lie in the picture? */
bool dp_edge_may_be_seen(const float *p, const float *q, const dp_view *view);

/* Fills view->maps, which is allocated, from `wanted` and `flagged`. */
void dp_pixel_maps_fill(const dp_chunk_view *view);

/* Is an edge between triangles of these states and normals surely no line? True also where they
 * are nearly in one plane, or both back-facing. */
bool dp_edge_is_plain(uint8_t state_a, const float normal_a[4], uint8_t state_b,
                      const float normal_b[4], float flat_cosine);

/* Does a triangle (world space) lie well behind the surface drawn so far? */
bool dp_triangle_is_hidden(const dp_chunk_view *view, const float *a, const float *b,
                           const float *c);

/* State (DP_TRIANGLE_FRONT, _BACK) and normal of a triangle; false when it has no area. */
bool dp_triangle_facing(const dp_view *view, const float *a, const float *b, const float *c,
                        float normal[4], uint8_t *state);

#endif
