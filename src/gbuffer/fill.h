/* Filling the G-buffer, a row of a tile at a time: what is passed between the general way (fill.c)
 * and the loops that take the time, which are compiled for several kinds of processors
 * (fill.inc). */
#ifndef DP_GBUFFER_FILL_H
#define DP_GBUFFER_FILL_H

#include "base/kernels.h"
#include "gbuffer/gbuffer.h"

/* Pixel sizes between samples of one surface. */
#define DP_SAME_SURFACE 3

typedef struct dp_fill {
    dp_gbuffer *g;
    const dp_tile *w;
    bool facets;   /* normals are the polygons' own */
    bool weighted; /* … or texture coordinates are asked for: corners' weights are needed */
    float step;    /* change of depth over a pixel size, per depth (perspective) or as such */
} dp_fill;

/* One row of the tile. `mask` says where there is a surface; the arrays are 0 elsewhere, `polygon`
 * excepted. */
typedef struct dp_fill_row {
    uint32_t y;      /* of the tile */
    uint32_t x0, x1; /* columns of surface, in whole strips; none: x0 is x1 */
    uint64_t mask;   /* pixels that show a surface */
    uint64_t whole;  /* all samples show one polygon: looked at in the pixel's centre */
    uint64_t mixed;  /* several surfaces: left to the general way */
    uint64_t odd;    /* corners are not the polygon's three points: left to the general way */
    uint32_t polygon[DP_TILE];       /* of the tile */
    float x[DP_TILE], y_at[DP_TILE]; /* where it is sampled, tile space */
    float d[DP_TILE];                /* depth there */
    uint32_t id[DP_TILE];            /* polygon of the frame */
    uint32_t first[DP_TILE];         /* its first corner */
    float weight[3][DP_TILE];        /* of its corners, none below zero; up to a common factor */
    float wx[DP_TILE], wy[DP_TILE],
        wz[DP_TILE]; /* normals in world space, not unit, 0 for the facet's */
    float d0[DP_TILE], dx[DP_TILE], dy[DP_TILE]; /* planes; tile space */
    float nearest[DP_TILE];                      /* depth that a polygon does not exceed */
    float in[DP_TILE];                           /* 1: there is a surface */
    uint8_t share[DP_TILE];                      /* of mixed pixels */
    float other[DP_TILE]; /* of mixed pixels: depth of the rest; DP_DEPTH_EMPTY: paper */
} dp_fill_row;

/* The row's loops, compiled for several kinds of processors; all give the same bits. */
typedef struct dp_fillers {
    uint32_t lanes; /* floats per vector */
    /* Four samples per pixel: which polygon each pixel shows, or that it is mixed. */
    void (*pick)(const dp_fill *f, dp_fill_row *r);
    /* Then, of columns [x0, x1), one after the other, and some rows apart: what is prefetched
     * has come until it is needed. */
    void (*find)(const dp_fill *f,
                 dp_fill_row *r); /* polygons of the frame; prefetches their corners */
    void (*touch)(const dp_fill *f, const dp_fill_row *r); /* prefetches the corners' normals */
    void (*collect)(const dp_fill *f, dp_fill_row *r);     /* what polygons give; which are odd */
    /* To the G-buffer; `pixel`: the place of the tile's first column. */
    void (*finish)(const dp_fill *f, const dp_fill_row *r, size_t pixel);
} dp_fillers;

DP_KERNEL_TABLES(dp_fillers);

/* The normal of a corner, packed (mesh/normals.h). */
static inline const int16_t *dp_fill_normal(const dp_fill *f, uint32_t corner, uint32_t vertex) {
    const int16_t *const shared = f->g->normals->vertex[vertex];
    return shared[3] ? f->g->normals->corner[corner] : shared;
}

#endif
