/* The rasterizer's kernels: vertices, tiles, planes, samples. */
#ifndef DP_RASTER_KERNELS_H
#define DP_RASTER_KERNELS_H

#include "core/view.h"
#include "base/kernels.h"

struct dp_frame;
struct dp_tile_polygon;
struct dp_tile_rect;
struct dp_tile;
struct dp_vertex;

/* Value of a rectangle's x0 if the kernel could not place the polygon. */
#define DP_UNPLACED INT16_MIN

typedef struct dp_raster_kernels {
    /* Transforms `count` positions, `stride` bytes apart, to the screen (transform.inc).
     * `past_caches`: write around the caches, as other processors will read most of it, or it does
     * not fit. */
    void (*transform)(const dp_view *view, const float *positions, size_t stride, uint32_t count,
                      struct dp_vertex *out, bool past_caches);
    /* Finds the tiles that the frame's triangles [first, first + count) reach, widened by margin px
     * (place.inc). */
    void (*place)(const struct dp_frame *frame, float margin, uint32_t first, uint32_t count,
                  struct dp_tile_rect *rects);
    /* Parts a bin's entries: front faces to ids[*count] and on, back faces to backs[*back_count]
     * and on (place.inc). */
    void (*part)(const uint32_t *entries, uint32_t n, uint32_t *ids, uint32_t *count,
                 uint32_t *backs, uint32_t *back_count);
    /* Appends triangles to the tile's polygons, and draws front faces; when `backs`, also back
     * faces that are not hidden (assemble.inc). */
    void (*assemble)(struct dp_tile *worker, const uint32_t *ids, uint32_t count, bool backs);
    /* Keeps the triangles that the tile's front faces do not hide; returns how many (cull.inc). */
    uint32_t (*cull)(struct dp_tile *worker, uint32_t *ids, uint32_t count);
    /* Lists the tile's polygons that are not hidden, and flags the others; lists all unless
     * `culling` (cull.inc). */
    void (*see)(struct dp_tile *worker, bool culling);
    /* Draws one convex polygon into the tile's samples (raster.inc). */
    void (*raster)(struct dp_tile *worker, const struct dp_tile_polygon *polygon, uint32_t index);
    /* Makes the unit normals of the tile's unsure triangles (normals.inc). */
    void (*normals)(struct dp_tile *worker);
    /* Keeps the close samples at which both polygons' planes cross, at least one is a front face or
     * back faces are seen, and, if they are triangles, they share no corner (cross.inc). */
    void (*cross)(struct dp_tile *worker);
    /* Of a layer that the samples hold, unless NULL: counts each pixel's into covered[DP_TILE * DP_TILE],
     * and writes to bound[sample] what the next one lies behind; returns the nearest of these
     * (layer.inc). */
    float (*layer)(const struct dp_tile *worker, uint8_t *covered, float *bound);
} dp_raster_kernels;

DP_KERNEL_TABLES(dp_raster_kernels);

#endif
