/* Which polygons of a tile lie hidden behind its front faces, and the back faces that do not.
 *
 * Front faces are drawn first (assemble.c). Then each block of pixels knows its furthest sample; a polygon whose
 * nearest point lies well behind that in all blocks around it can be seen nowhere, and neither can its
 * edges. In a closed model that is true of nearly all back faces: they are not rasterized at all, add no
 * edges of their own to the table and hide no lines that something nearer does not hide already.
 *
 * The depths compared are those of samples, so "well behind" must cover what the surface does between
 * two of them: SLACK is several pixel sizes, and the blocks reach a pixel beyond the polygon. */
#include "kernel/kernels.h"
#include "pipe/tile.h"

static const float SLACK = 6; /* pixel sizes */

enum { BLOCKS = DP_TILE / DP_BLOCK };

static float furthest_in_row(const dp_tile_worker *w, uint32_t x, uint32_t y) {
    const float *const d = w->depth + dp_pixel_lane(&w->sampling, x, y);
    dp_f4 least = *(const dp_f4 *)(const void *)d;
    for (uint32_t i = 4; i < DP_BLOCK * w->sampling.samples; i += 4) {
        const dp_f4 next = *(const dp_f4 *)(const void *)(d + i);
        least = dp_select(next < least, next, least);
    }
    return dp_minf(dp_minf(least[0], least[1]), dp_minf(least[2], least[3]));
}

/* Pixels beyond the picture's border count as seen: nothing is culled by what lies next to it. */
static void find_farthest(dp_tile_worker *w) {
    for (uint32_t by = 0; by < BLOCKS; by++)
        for (uint32_t bx = 0; bx < BLOCKS; bx++) {
            float least = furthest_in_row(w, bx * DP_BLOCK, by * DP_BLOCK);
            for (uint32_t y = 1; y < DP_BLOCK; y++)
                least = dp_minf(least, furthest_in_row(w, bx * DP_BLOCK, by * DP_BLOCK + y));
            w->farthest[by][bx] = least;
        }
}

static bool is_hidden(const dp_tile_worker *w, const dp_tile_polygon *p) {
    if (!(p->flags & DP_POLYGON_TOUCHES)) return false;
    /* a polygon at the tile's border may be seen beyond it */
    if (p->x0 < 1 || p->y0 < 1 || p->x1 > DP_TILE - 2 || p->y1 > DP_TILE - 2) return false;
    const float nearest = p->nearest + dp_depth_steps(w->frame, p->nearest, SLACK);
    for (uint32_t by = (p->y0 - 1u) / DP_BLOCK; by <= (p->y1 + 1u) / DP_BLOCK; by++)
        for (uint32_t bx = (p->x0 - 1u) / DP_BLOCK; bx <= (p->x1 + 1u) / DP_BLOCK; bx++)
            if (!(nearest < w->farthest[by][bx])) return false;
    return true;
}

void dp_tile_faces(dp_tile_worker *w) {
    find_farthest(w);
    for (uint32_t i = 0; i < w->polygon_count; i++) {
        dp_tile_polygon *const p = &w->polygons[i];
        if (is_hidden(w, p)) p->flags |= DP_POLYGON_HIDDEN;
        else if (!(p->flags & DP_POLYGON_FRONT) && dp_is_surface(w, p)) w->frame->kernels->raster(w, p, i);
    }
}
