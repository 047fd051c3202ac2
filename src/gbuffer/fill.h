/* Filling the G-buffer, a row of a tile at a time: what fill.c, which conducts and handles special
 * pixels, shares with the kernels (fill.inc), which handle the others. */
#ifndef DP_GBUFFER_FILL_H
#define DP_GBUFFER_FILL_H

#include "base/kernels.h"
#include "gbuffer/gbuffer.h"

/* Pixel sizes: samples of one surface differ by no more in depth. */
#define DP_SAME_SURFACE 3

typedef struct dp_fill {
    dp_gbuffer *g;
    const dp_tile *w;
    bool facets;   /* normals are the polygons' own */
    bool weighted; /* corners' weights are needed: !facets, textured or colored */
    float step;    /* depth of a pixel size; perspective: divided by the depth */
} dp_fill;

/* One row of the tile. Where `mask` has no bit, arrays are 0, except `polygon`. */
typedef struct dp_fill_row {
    uint32_t y;      /* of the tile */
    uint32_t x0, x1; /* columns that enclose the surface, in whole strips; none: x0 == x1 */
    uint64_t mask;   /* pixels that show a surface */
    uint64_t whole;  /* all samples show one polygon: it is sampled at the pixel's centre */
    uint64_t mixed;  /* several surfaces: left to fill.c */
    uint64_t odd;    /* the polygon's points are not its three corners: left to fill.c */
    uint32_t polygon[DP_TILE];       /* of the tile */
    float x[DP_TILE], y_at[DP_TILE]; /* where it is sampled, px in the tile */
    float d[DP_TILE];                /* depth there */
    uint32_t id[DP_TILE];            /* polygon of the frame */
    uint32_t first[DP_TILE];         /* its first corner */
    float weight[3][DP_TILE];        /* of its corners, >= 0, up to a common factor */

    float wx[DP_TILE], wy[DP_TILE], wz[DP_TILE]; /* normal, world space, not unit; 0: the facet's */
    float d0[DP_TILE], dx[DP_TILE], dy[DP_TILE]; /* its plane, tile space */
    float nearest[DP_TILE];                      /* depth of its nearest point */
    float in[DP_TILE];                           /* 1 where there is a surface */
    uint8_t share[DP_TILE];                      /* of mixed pixels, of 255 */
    float other[DP_TILE]; /* of mixed pixels: depth of the rest; DP_DEPTH_EMPTY: paper */
} dp_fill_row;

/* The row's loops, compiled for each width of vectors; all give the same bits. */
typedef struct dp_fillers {
    uint32_t lanes; /* floats per vector */
    /* With four samples per pixel: which polygon each pixel shows, or that it is mixed. */
    void (*pick)(const dp_fill *f, dp_fill_row *r);

    /* These follow for columns [x0, x1), some rows apart, so that what is prefetched has arrived
     * when it is needed. */

    /* Finds the frame's polygons; prefetches their corners. */
    void (*find)(const dp_fill *f, dp_fill_row *r);
    /* Prefetches the corners' normals. */
    void (*touch)(const dp_fill *f, const dp_fill_row *r);
    /* Computes planes, weights and normals; finds the odd pixels. */
    void (*collect)(const dp_fill *f, dp_fill_row *r);
    /* Writes the G-buffer; `pixel`: index of the tile's first column. */
    void (*finish)(const dp_fill *f, const dp_fill_row *r, size_t pixel);
} dp_fillers;

DP_KERNEL_TABLES(dp_fillers);

/* A corner's packed normal (mesh/normals.h). */
static inline const int16_t *dp_fill_normal(const dp_fill *f, uint32_t corner, uint32_t vertex) {
    const int16_t *const shared = f->g->normals->vertex[vertex];
    return shared[3] ? f->g->normals->corner[corner] : shared;
}

#endif
