/* The G-buffer: per pixel one surface's normal, linear distance and group (Saito and Takahashi
 * 1990; Nienhaus and Döllner 2003, 4.1.1), and what operators on it share. */
#ifndef DP_GBUFFER_GBUFFER_H
#define DP_GBUFFER_GBUFFER_H

#include "mesh/normals.h"
#include "raster/tile.h"

/* Pixels around the picture that repeat its border, so that operators need not look where they
 * are. */
enum { DP_GBUFFER_MARGIN = 4 };

/* Rows of a tile are worked on in strips of so many pixels from its left border on, the widest
 * vector: so that what a pixel holds does not depend on the width, and nobody looks into the next
 * tile, which may still be being filled. */
enum { DP_GBUFFER_STRIP = 16 };

/* Distance of the background: far beyond everything, and still finite, so that differences are. */
#define DP_FAR 1e30f
/* Its depth. */
static inline float dp_gbuffer_empty_depth(bool perspective) { return perspective ? 0 : -DP_FAR; }

/* Planes of floats, `stride` apart from row to row; pixel (0, 0) is at [0], and rows and columns
 * down to -DP_GBUFFER_MARGIN may be read. Rows have room for whole tiles. A pixel without surface
 * has normal 0, distance DP_FAR and id 0. One that is mostly paper (a partial pixel) is background to
 * whoever looks for edges, distance DP_FAR, but has the id and normal of the surface at its border,
 * whose distance is `other`. Invariant: tiles marked `clean` hold no surface, so that background is
 * written once and then costs nothing. */
typedef struct dp_gbuffer {
    uint32_t width, height;
    size_t stride;
    float *nx, *ny, *nz; /* camera space, unit: x right, y up, z towards the eye */
    float *distance;     /* along the line of sight, world units, at the pixel's centre */
    float *depth; /* the same as depth on the screen, affine on planes (view.h): what is scaled
                     looks at it */
    float *other; /* where `shared`: distance of what covers the rest, DP_FAR for the paper */
    float *u, *v; /* texture coordinates, when asked for; NaN: none */
    uint16_t *id; /* 1 + group */
    uint32_t
        *polygon;   /* whose surface it is, where somebody asks: set by whoever keeps it, or NULL */
    uint8_t *share; /* where `shared`: of the pixel's samples that are of this surface, of 255 */
    uint64_t *mask; /* [tile][DP_TILE]: pixels of a tile's row that hold a surface */
    uint64_t *shared; /* [tile][DP_TILE]: and something else */
    uint8_t *clean;   /* [tile] 1: no surface; 2: nor in the margin beside it */

    /* the camera, for operators: a pixel's ray is ((x - cx) / fx, (cy - y) / fy, -1) in camera
     * space */
    bool perspective;
    float cx, cy, fx, fy;  /* px; fx, fy: px per unit at distance 1 */
    double rotation[3][3]; /* world to camera space */
    dp_vec3 eye;           /* world space */
    float near_z, far_z;   /* of the enhanced groups (as printed, 8 bits) */
    uint32_t tiles_x, tiles_y;

    const struct dp_detectors *detectors; /* for this processor (detect.h) */
    const struct dp_fillers *fillers;     /* the same (fill.h) */
    const dp_packed_normals *normals;     /* of the frame's corners, borrowed; NULL: none */

    void *block; /* all planes */
    size_t block_cap, mask_cap, clean_cap;
    bool textured; /* u, v are there */
} dp_gbuffer;

void dp_gbuffer_free(dp_gbuffer *g, const dp_allocator *memory);

/* Planes for the frame's picture; with texture coordinates when `textured`. False when memory is
 * out. */
bool dp_gbuffer_begin(dp_gbuffer *g, const dp_frame *frame, bool textured);

/* First pass: the surface of the tile that the worker holds (fill.c). */
void dp_gbuffer_fill(dp_gbuffer *g, const dp_tile *worker, dp_normals normals);

/* After all tiles: repeats the border in the margin. */
void dp_gbuffer_pad(dp_gbuffer *g);

/* 8 bits per channel, as in the paper's textures (quantize.c); rows of one tile. */
void dp_gbuffer_quantize(dp_gbuffer *g, uint32_t tile);

/* Near and far that enclose the enhanced groups' vertices before the eye (depth_range.c). */
void dp_gbuffer_fit_range(dp_gbuffer *g, const dp_frame *frame, const uint8_t *enhanced,
                          uint32_t enhanced_count);

static inline bool dp_gbuffer_is_partial(const dp_gbuffer *g, size_t at) {
    return g->id[at] && g->distance[at] >= DP_FAR;
}

/* The part of a tile's row y (px) that holds surface: columns [*x0, *x1) of the picture. False:
 * none. */
static inline bool dp_gbuffer_span(const dp_gbuffer *g, uint32_t tile, uint32_t row, uint32_t *x0,
                                   uint32_t *x1) {
    const uint64_t mask = g->mask[(size_t)tile * DP_TILE + row];
    if (!mask) return false;
    const uint32_t x = tile % g->tiles_x * DP_TILE;
    *x0 = x + (uint32_t)__builtin_ctzll(mask);
    *x1 = x + 64 - (uint32_t)__builtin_clzll(mask);
    return true;
}

#endif
