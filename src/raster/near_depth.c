/* Candidate pixels: those where faces may cross (Raskar 2001, 2.4).
 *
 *    while faces are drawn: where one comes close in depth to what a sample holds, keep both
 *    later, for each of these close samples
 *        their planes cross within dp_near_depth_px of it   a candidate pixel   (cross.inc)
 *        what it holds is of no polygon of the tile         a candidate pixel if depth is close
 *
 * This is the paper's between-test as a first look; intersect.c tests exactly. At each visible
 * sample of a crossing the two frontmost surfaces meet, in whatever order they are drawn, so one
 * pass finds all.
 *
 * Data structure: a short list of close samples, tested whenever it is full. Not handled: crossings
 * that lie between samples altogether. */
#include "raster/kernels.h"
#include "raster/tile.h"

#include <string.h>

uint32_t dp_shared_corners(const dp_frame *frame, uint32_t a, uint32_t b) {
    const dp_polygons *const polygons = &frame->polygons;
    const uint32_t fa = dp_first_corner(polygons, a), na = dp_corner_count(polygons, a);
    const uint32_t fb = dp_first_corner(polygons, b), nb = dp_corner_count(polygons, b);
    uint32_t shared = 0;
    for (uint32_t i = 0; i < na; i++) {
        const uint32_t key = frame->vertices[dp_corner_vertex(polygons, fa + i)].key;
        for (uint32_t j = 0; j < nb; j++)
            shared += key == frame->vertices[dp_corner_vertex(polygons, fb + j)].key;
    }
    return shared;
}

static void note_candidate_pixel(dp_tile *w, uint32_t lane, bool both_front) {
    const uint32_t pixel = lane / w->sampling.samples;
    w->candidate_pixels[!both_front][pixel / DP_TILE] |= (uint64_t)1 << pixel % DP_TILE;
}

/* The sample holds something that is no polygon of the tile. Only its facing is known, not its
 * slope. */
static void test_unknown(dp_tile *w, uint32_t i) {
    const dp_close_samples *const close = &w->close;
    const uint32_t lane = close->lane[i];
    const bool away = w->away[lane / 64] >> lane % 64 & 1,
               front = w->polygons[close->polygon[i]].flags & DP_POLYGON_FRONT;
    if (away && !front && !w->won) return;
    if (close->gap[i] > fabsf(dp_depth_steps(w->frame, close->depth[i], DP_NEAR_DEPTH_GAP))) return;
    note_candidate_pixel(w, lane, front && !away);
}

void dp_tile_test_near_depth(dp_tile *w) {
    dp_close_samples *const close = &w->close;
    for (uint32_t i = 0; w->away && i < close->count; i++)
        if (close->other[i] == UINT32_MAX) test_unknown(w, i);
    dp_raster_kernels_for(w->frame->lanes)->cross(w);
    for (uint32_t i = 0; i < close->count; i++) {
        const dp_tile_polygon *const p = &w->polygons[close->polygon[i]],
                                     *const q = &w->polygons[close->other[i]];
        if (!w->frame->polygons.firsts || !dp_shared_corners(w->frame, p->id, q->id))
            note_candidate_pixel(w, close->lane[i], p->flags & q->flags & DP_POLYGON_FRONT);
    }
    close->count = 0;
}

/* Adds the neighbours of pixels. False: there are no pixels. */
bool dp_widen(const uint64_t pixels[DP_TILE], uint64_t out[DP_TILE]) {
    const uint64_t all = ~(uint64_t)0 >> (64 - DP_TILE);
    uint64_t any = 0;
    for (int y = 0; y < DP_TILE; y++) {
        uint64_t r = pixels[y];
        if (y > 0) r |= pixels[y - 1];
        if (y + 1 < DP_TILE) r |= pixels[y + 1];
        out[y] = (r | r << 1 | r >> 1) & all;
        any |= r;
    }
    return any;
}

/* Drops candidate pixels without a neighbour: a visible crossing continues from pixel to pixel,
 * while folds of fine meshes come close here and there. */
void dp_drop_lone(uint64_t candidate_pixels[DP_TILE]) {
    uint64_t kept[DP_TILE];
    for (int y = 0; y < DP_TILE; y++) {
        const uint64_t above = y > 0 ? candidate_pixels[y - 1] : 0,
                       below = y + 1 < DP_TILE ? candidate_pixels[y + 1] : 0;
        const uint64_t rows = above | below, all = rows | candidate_pixels[y];
        kept[y] = candidate_pixels[y] & (rows | all << 1 | all >> 1);
    }
    memcpy(candidate_pixels, kept, sizeof kept);
}
