/* The G-buffer: per pixel one surface's normal, linear distance and group (Saito and Takahashi
 * 1990; Nienhaus and Döllner 2003, 4.1.1), and what operators on it share. */
#ifndef DP_GBUFFER_GBUFFER_H
#define DP_GBUFFER_GBUFFER_H

#include "mesh/normals.h"
#include "raster/tile.h"

/* Pixels around the picture that repeat its border, so that operators need not check for it. */
enum { DP_GBUFFER_MARGIN = 4 };

/* Rows of a tile are filled in strips of so many pixels from its left border on, the widest vector.
 * So results do not depend on the width of vectors, and no worker reads the next tile, which
 * another may still be filling. */
enum { DP_GBUFFER_STRIP = 16 };

/* Distance of the background: beyond everything, and finite, so that differences are. */
#define DP_FAR 1e30f
/* Depth of the background. */
static inline float dp_gbuffer_empty_depth(bool perspective) { return perspective ? 0 : -DP_FAR; }

/* Planes, rows `stride` apart; pixel (0, 0) is at [0], rows and columns from -DP_GBUFFER_MARGIN on
 * may be read, and rows have room for whole tiles.
 *
 *     pixel           id         normal     distance   other
 *     surface         1 + group  surface's  surface's  if shared: distance of the rest
 *     partial         1 + group  surface's  DP_FAR     surface's distance
 *     no surface      0          0          DP_FAR     -
 *
 * A partial pixel is mostly paper: background for edge detection, but shaded.
 *
 * Invariant: tiles marked `clean` hold no surface, so that background is written only once. */
typedef struct dp_gbuffer {
    uint32_t width, height; /* px */
    size_t stride;          /* elements */
    float *nx, *ny, *nz;    /* camera space, unit: x right, y up, z towards the eye */
    float *distance;        /* along the line of sight, world units, at the pixel's centre */
    float *depth;           /* the same as depth on the screen, affine on planes (core/view.h) */
    float *other;           /* where `shared`: distance of what covers the rest; DP_FAR: paper */
    float *u, *v;           /* texture coordinates, when asked for; NaN: none */
    uint32_t *color;        /* 0xRRGGBBAA, of the vertices, when asked for; 0: none */
    uint16_t *id;           /* 1 + group */
    uint32_t *polygon;      /* polygon of the frame; the caller's plane, or NULL */
    uint8_t *share;         /* where `shared`: share of samples on this surface, of 255 */
    uint64_t *mask;         /* [tile][DP_TILE] bits: pixels that hold a surface */
    uint64_t *shared;       /* [tile][DP_TILE] bits: pixels that hold something else too */
    uint8_t *clean;         /* [tile] 1: no surface; 2: and the margin beside it is written */

    /* The camera: the ray of pixel (x, y) is ((x - cx) / fx, (cy - y) / fy, -1), camera space. */
    bool perspective;
    float cx, cy, fx, fy;  /* px; fx, fy: px per unit at distance 1 */
    double rotation[3][3]; /* world to camera space */
    dp_vec3 eye;           /* world space */
    float near_z, far_z;   /* of the enhanced groups (as printed, 8 bits) */
    uint32_t tiles_x, tiles_y;

    const struct dp_detectors *detectors; /* kernels for this processor (detect.h) */
    const struct dp_fillers *fillers;     /* kernels for this processor (fill.h) */
    const dp_packed_normals *normals;     /* of the frame's corners, borrowed; NULL: none */

    uint8_t *block; /* all planes */
    size_t block_cap, mask_cap, clean_cap;
    bool textured; /* u, v exist */
    bool colored;  /* color exists */
} dp_gbuffer;

void dp_gbuffer_free(dp_gbuffer *g, const dp_allocator *memory);
uint64_t dp_gbuffer_bytes(const dp_gbuffer *g);

/* Allocates planes for the frame's picture; u and v if `textured`, color if `colored`. False when
 * memory is out. */
bool dp_gbuffer_begin(dp_gbuffer *g, const dp_frame *frame, bool textured, bool colored);

/* Takes rays and rotation from a view. */
void dp_gbuffer_take_camera(dp_gbuffer *g, const dp_view *view);

/* First pass: fills a tile from its samples (fill.c). */
void dp_gbuffer_fill(dp_gbuffer *g, const dp_tile *worker, dp_normals normals);

/* The same for a tile without any surface. */
void dp_gbuffer_clear(dp_gbuffer *g, uint32_t tile);

/* After all tiles: repeats the picture's border in the margin. */
void dp_gbuffer_pad(dp_gbuffer *g);

/* Rounds a tile to 8 bits per channel, as in the paper's textures (quantize.c). */
void dp_gbuffer_quantize(dp_gbuffer *g, uint32_t tile);

/* Fits near_z and far_z to the enhanced groups' vertices before the eye (Nienhaus and Döllner 2003,
 * 4.1.1). */
void dp_gbuffer_fit_range(dp_gbuffer *g, const dp_frame *frame, const uint8_t *enhanced,
                          uint32_t enhanced_count);

static inline bool dp_gbuffer_is_partial(const dp_gbuffer *g, size_t at) {
    return g->id[at] && g->distance[at] >= DP_FAR;
}

/* The columns [*x0, *x1) of the picture that enclose the surface in a tile's row; false: none. */
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
