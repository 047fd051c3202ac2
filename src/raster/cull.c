/* Which polygons of a tile are hidden behind its front faces; and drawing the back faces that are
 * not.
 *
 *    front faces are drawn first
 *    for each block of pixels, and blocks of these: the furthest sample
 *    a polygon is hidden if its nearest point is well behind the furthest sample in all
 *    blocks around its box
 *
 * Its edges are then hidden too. In a closed model nearly all back faces are: they are not
 * rasterized, add no edges to the table, and hide no line that something nearer does not hide
 * already.
 *
 * The depths compared are those of samples, so "well behind" must cover what the surface does
 * between samples: DP_CULL_SLACK is several pixel sizes, and the blocks reach a pixel beyond the
 * polygon. Beyond the tile, a strip of samples half a pixel outside stands for the surface, within
 * the margin of binning. Errs on the safe side: a hidden polygon may be missed. */
#include "raster/kernels.h"
#include "raster/tile.h"

static float furthest_in_row(const dp_tile *w, uint32_t x, uint32_t y) {
    const float *const d = w->depth + dp_pixel_lane(&w->sampling, x, y);
    dp_f4 least = *(const dp_f4 *)(const void *)d;
    for (uint32_t i = 4; i < DP_BLOCK * w->sampling.samples; i += 4) {
        const dp_f4 next = *(const dp_f4 *)(const void *)(d + i);
        least = dp_select(next < least, next, least);
    }
    return dp_minf(dp_minf(least[0], least[1]), dp_minf(least[2], least[3]));
}

static void find_blocks(const dp_tile *w, float out[DP_RINGED][DP_RINGED]) {
    for (uint32_t by = 0; by < DP_BLOCKS; by++)
        for (uint32_t bx = 0; bx < DP_BLOCKS; bx++) {
            float least = furthest_in_row(w, bx * DP_BLOCK, by * DP_BLOCK);
            for (uint32_t y = 1; y < DP_BLOCK; y++)
                least = dp_minf(least, furthest_in_row(w, bx * DP_BLOCK, by * DP_BLOCK + y));
            out[by + 1][bx + 1] = least;
        }
}

static float furthest_in_strip(const float *strip) {
    float least = strip[0];
    for (int i = 1; i < 2 * DP_BLOCK; i++) least = dp_minf(least, strip[i]);
    return least;
}

/* Beyond the tile's corners depth is unknown, so nothing is hidden there. */
static void find_ring(const dp_tile *w, float out[DP_RINGED][DP_RINGED]) {
    const uint32_t last = DP_RINGED - 1;
    for (uint32_t b = 0; b < DP_BLOCKS; b++) {
        const uint32_t at = 2 * DP_BLOCK * b;
        out[b + 1][0] = furthest_in_strip(w->strip[0] + at);
        out[b + 1][last] = furthest_in_strip(w->strip[1] + at);
        out[0][b + 1] = furthest_in_strip(w->strip[2] + at);
        out[last][b + 1] = furthest_in_strip(w->strip[3] + at);
    }
    out[0][0] = out[0][last] = out[last][0] = out[last][last] = DP_DEPTH_EMPTY;
}

static uint32_t block_after(uint32_t b) { return b + 1 < DP_RINGED ? b + 1 : b; }

/* Ranges of blocks: from the range that is one block shorter and the block after it. */
void dp_tile_find_farthest(dp_tile *w) {
    find_blocks(w, w->farthest[0][0]);
    find_ring(w, w->farthest[0][0]);
    for (uint32_t sx = 1; sx < DP_SPANS; sx++)
        for (uint32_t by = 0; by < DP_RINGED; by++)
            for (uint32_t bx = 0; bx < DP_RINGED; bx++)
                w->farthest[0][sx][by][bx] =
                    dp_minf(w->farthest[0][0][by][bx], w->farthest[0][sx - 1][by][block_after(bx)]);
    for (uint32_t sy = 1; sy < DP_SPANS; sy++)
        for (uint32_t sx = 0; sx < DP_SPANS; sx++)
            for (uint32_t by = 0; by < DP_RINGED; by++)
                for (uint32_t bx = 0; bx < DP_RINGED; bx++)
                    w->farthest[sy][sx][by][bx] = dp_minf(
                        w->farthest[0][sx][by][bx], w->farthest[sy - 1][sx][block_after(by)][bx]);
}

/* The block of a pixel coordinate from -1 to DP_TILE; block 0 is the ring around the tile. */
static inline uint32_t block_of(int px) { return (uint32_t)(px + DP_BLOCK) / DP_BLOCK; }

static inline bool hides(const dp_tile *w, int x0, int y0, int x1, int y1, float nearest) {
    const float limit = nearest + dp_depth_steps(w->frame, nearest, DP_CULL_SLACK);
    const uint32_t bx0 = block_of(x0 - 1), bx1 = block_of(x1 + 1);
    const uint32_t by0 = block_of(y0 - 1), by1 = block_of(y1 + 1);
    if (bx1 - bx0 < DP_SPANS && by1 - by0 < DP_SPANS)
        return limit < w->farthest[by1 - by0][bx1 - bx0][by0][bx0];
    for (uint32_t by = by0; by <= by1; by++)
        for (uint32_t bx = bx0; bx <= bx1; bx++)
            if (!(limit < w->farthest[0][0][by][bx])) return false;
    return true;
}

static int clamp_px(float v) { return v <= 0 ? 0 : v >= DP_TILE - 1 ? DP_TILE - 1 : (int)v; }

bool dp_tile_hides(const dp_tile *w, float x0, float y0, float x1, float y1, float nearest) {
    return hides(w, clamp_px(x0), clamp_px(y0), clamp_px(x1), clamp_px(y1), nearest);
}

bool dp_tile_is_hidden(const dp_tile *w, const dp_tile_polygon *p) {
    return hides(w, p->x0, p->y0, p->x1, p->y1, p->nearest);
}

bool dp_tile_see(dp_tile *w, bool culling) {
    const size_t room = (size_t)w->polygon_count + DP_SEEN_ROOM;
    w->seen_count = 0;
    if (!DP_TILE_RESERVE(w, w, seen, seen_cap, room) ||
        !DP_TILE_RESERVE(w, w, seen_words, seen_words_cap, DP_SEEN_MEMBERS * room))
        return false;
    w->seen_stride = (uint32_t)room;
    dp_raster_kernels_for(w->frame->lanes)->see(w, culling);
    return true;
}

/* Does the polygon reach the tile's border? The strip around the tile knows triangles only. */
static bool may_lie_beside(const dp_tile *w, const dp_tile_polygon *p) {
    const uint32_t last = DP_TILE - 1;
    return w->frame->polygons.firsts && (!p->x0 || !p->y0 || p->x1 == last || p->y1 == last);
}

void dp_tile_faces(dp_tile *w) {
    bool beside = false;
    if (!dp_tile_see(w, true)) return;
    for (uint32_t i = 0; i < w->seen_count && w->seen[i] < w->undrawn; i++) {
        const dp_tile_polygon *const p = &w->polygons[w->seen[i]];
        if (p->flags & (DP_POLYGON_FRONT | DP_POLYGON_EDGE_ON)) continue;
        beside |= may_lie_beside(w, p);
        if (dp_is_surface(w, p)) dp_raster_kernels_for(w->frame->lanes)->raster(w, p, w->seen[i]);
    }
    w->sees_backs = w->won || beside;
    dp_tile_test_near_depth(w);
}
