/* A chunk: some thousand consecutive triangles of a source that is streamed, as one worker sees
 * them. */
#ifndef DP_STREAM_CHUNK_H
#define DP_STREAM_CHUNK_H

#include "raster/tile.h"
#include "stream/kernels.h"

#include <string.h>

enum {
    DP_CHUNK = DP_TUNED(4096, 3),         /* triangles */
    DP_CHUNK_EDGES = 3 * DP_CHUNK,        /* fewer than 65536: they are numbered in 16 bits */
    DP_CHUNK_SLOTS = DP_TUNED(32768, 32), /* of the table of edges; a power of two, twice as many */
    DP_CHUNK_ROOM =
        16 /* so many triangles may be written beyond the last: kernels write whole vectors */
};

/* Lines and samples are looked for this far outside the picture (px), as bins are widened. */
#define DP_CLASSIFY_MARGIN 2
/* A triangle hides behind the surface when it lies this much further in the blocks around it (pixel
 * sizes), as in cull.c. */
#define DP_CLASSIFY_SLACK 6
/* Rounding of places on the screen, px. */
#define DP_CLASSIFY_ROUNDING (1.0f / 512)

/* What is known of a triangle of a chunk. */
enum {
    DP_TRIANGLE_LIVE = 1,     /* it may be seen, and so may its edges */
    DP_TRIANGLE_COVERS = 2,   /* it may cover a sample */
    DP_TRIANGLE_FRONT = 4,    /* surely faces the eye */
    DP_TRIANGLE_BACK = 8,     /* surely faces away; neither: seen edge-on */
    DP_TRIANGLE_FLAGGED = 16, /* touches a pixel where faces may cross */
    DP_TRIANGLE_WITHIN = 32   /* lies in the picture whole; may be left out */
};

typedef struct dp_chunk_edge {
    uint16_t a, b; /* triangles */
    uint8_t edge_a, edge_b;
    uint8_t met; /* 1, 2, or 3: more than two triangles, or two that run it the same way */
} dp_chunk_edge;

typedef struct dp_chunk {
    uint32_t count; /* triangles */
    uint32_t unsure_count;
    uint16_t unsure[DP_CHUNK]; /* triangles that the kernel leaves to the general way */
    uint16_t listed[DP_CHUNK]; /* for whoever goes through some of them */
    uint8_t state[DP_CHUNK + DP_CHUNK_ROOM];
    float normal[DP_CHUNK + DP_CHUNK_ROOM][4]; /* not of unit length; squared length */
    uint32_t edge_key[3][DP_CHUNK +
                         DP_CHUNK_ROOM]; /* from the ends' positions, the same from both sides */
    uint8_t lines[DP_CHUNK];             /* set of edges that may be lines */
    uint8_t alone[DP_CHUNK];             /* set of edges that no other triangle of the chunk has */
    dp_chunk_edge edges[DP_CHUNK_EDGES];
    uint32_t edge_count;
    uint32_t slots[DP_CHUNK_SLOTS]; /* high half of the key, 1 + edge */
} dp_chunk;

/* Which pixels the second reading looks at, in four maps: of the pixel itself, of it and its right
 * neighbour, of it and the one below, of all four. So the box of a small triangle is one look into
 * one map, which is chosen by the pixels that it spans. Two bits a pixel: it is wanted; it is
 * flagged. */
typedef struct dp_pixel_maps {
    uint32_t *words; /* 16 pixels each */
    uint32_t row;    /* words */
    uint32_t map;    /* words */
} dp_pixel_maps;

/* What a chunk is held against. */
typedef struct dp_chunk_view {
    const dp_view *view;
    const dp_stream_kernels *kernels;
    dp_sampling sampling;
    uint32_t tiles_x, tiles_y;
    const float *farthest;   /* [tile][DP_BLOCKS][DP_BLOCKS]: depth of the furthest sample in each
                                block of the picture;   nothing further can be seen */
    const uint64_t *wanted;  /* [tile][DP_TILE] rows of pixels; NULL: every sample is wanted */
    const uint64_t *flagged; /* the same: where faces may cross; only with `wanted` */
    dp_pixel_maps maps;      /* of both */
    float flat_cosine;       /* dp_frame; below 0: folds are no lines */
} dp_chunk_view;

/* Triangles as they lie in a buffer: nine floats each, `stride` bytes apart. */
typedef struct dp_triangles {
    const uint8_t *corners;
    size_t stride;
    uint32_t count;
    const uint8_t *flags; /* set of edges that draw, per triangle; NULL: all */
} dp_triangles;

/* A triangle's corners; -0 is 0, so that equal positions have equal bits. */
static inline void dp_triangle_corners(const dp_triangles *triangles, uint32_t t,
                                       float corners[9]) {
    memcpy(corners, triangles->corners + t * triangles->stride, 9 * sizeof *corners);
    for (int i = 0; i < 9; i++) corners[i] += 0.0f;
}

/* Sets `state`, `normal` and `edge_key`: which triangles can be dropped at once, and which cover
 * samples (or, with `wanted`, pixels that are wanted; normals are not set then). Counts what is
 * dropped for good in *stats. */
void dp_chunk_classify(dp_chunk *chunk, const dp_triangles *triangles, const dp_chunk_view *view,
                       dp_stats *stats);

/* Sets `lines` and `alone`: edges between triangles of the chunk. */
void dp_chunk_edges(dp_chunk *chunk, const dp_triangles *triangles, const dp_chunk_view *view);

/* The pixel in which a triangle's box begins, as an index of [tile][DP_TILE][DP_TILE]; the
 * picture's nearest. */
uint32_t dp_chunk_pixel(const float corners[9], const dp_chunk_view *view);

/* Does the edge from p to q lie in the picture, or may it? */
bool dp_edge_may_be_seen(const float *p, const float *q, const dp_view *view);

/* Fills view->maps, which has the room, from `wanted` and `flagged`. */
void dp_pixel_maps_fill(const dp_chunk_view *view);

/* Is an edge between two triangles of this state and normal surely no line? */
bool dp_edge_is_plain(uint8_t state_a, const float normal_a[4], uint8_t state_b,
                      const float normal_b[4], float flat_cosine);

/* Does a triangle lie well behind what is known of the surface? World space. */
bool dp_triangle_is_hidden(const dp_chunk_view *view, const float *a, const float *b,
                           const float *c);

/* State (DP_TRIANGLE_FRONT, _BACK) and normal of a triangle; false when it has no area. */
bool dp_triangle_facing(const dp_view *view, const float *a, const float *b, const float *c,
                        float normal[4], uint8_t *state);

#endif
