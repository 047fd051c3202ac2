/* A tile's memory, its start, and the test whether a polygon covers a point: see tile.h. */
#include "raster/tile.h"

#include <string.h>

bool dp_tile_begin(dp_tile *tile, const dp_frame *frame) {
    tile->frame = frame;
    tile->memory = *frame->memory;
    tile->failed = false;
    tile->stats = (dp_stats){0};
    tile->away = NULL;
    tile->tests_near_depth =
        frame->lines & DP_INTERSECTION && frame->styles[0].ink == DP_INK_STROKES;
    tile->finds_edges = frame->lines & ~DP_INTERSECTION && frame->styles[0].ink == DP_INK_STROKES &&
                        (!frame->styles[0].edge_table_off || frame->hidden) &&
                        frame->styles[0].edges != DP_EDGES_ADJACENCY;
    dp_sampling_init(&tile->sampling, frame->target.samples);
    dp_block_init(&tile->block, frame->target.samples);
    return dp_reserve(&tile->memory, &tile->winner, &tile->winner_cap, frame->tile_samples,
                      sizeof *tile->winner);
}

static const dp_array arrays[] = {
    DP_ARRAY(dp_tile, winner, winner_cap),   DP_ARRAY(dp_tile, colors, colors_cap),
    DP_ARRAY(dp_tile, ids, ids_cap),         DP_ARRAY(dp_tile, backs, backs_cap),
    DP_ARRAY(dp_tile, culled, culled_cap),   DP_ARRAY(dp_tile, polygons, polygons_cap),
    DP_ARRAY(dp_tile, normals, normals_cap), DP_ARRAY(dp_tile, unsure, unsure_cap),
    DP_ARRAY(dp_tile, points, points_cap),   DP_ARRAY(dp_tile, keys, keys_cap),
    DP_ARRAY(dp_tile, seen, seen_cap),       DP_ARRAY(dp_tile, seen_words, seen_words_cap)};

void dp_tile_free(dp_tile *tile) {
    if (!tile->memory.free) return; /* never used */
    dp_arrays_free(&tile->memory, tile, DP_ARRAYS(arrays));
    dp_outline_scratch_free(&tile->scratch, &tile->memory);
}

uint64_t dp_tile_bytes(const dp_tile *tile) {
    return dp_arrays_bytes(tile, DP_ARRAYS(arrays)) + dp_outline_scratch_bytes(&tile->scratch);
}

/* How a polygon's plane on the screen becomes its normal.
 *
 * A plane through p with normal n has d = m·ray in perspective, with m = n / (n·p) and `ray`
 * through the sample. Let o be the ray through the tile's corner, and x, y its change per px. Then
 *
 *    d0 = m·o,  dx = m·x,  dy = m·y;   so m = dual * (d0, dx, dy), with the dual basis of o, x, y.
 *
 * In orthographic views o is one step of d, and its component is -1. m points away from the eye;
 * normals of front faces point towards it, hence the minus. */
static void find_plane_normal(dp_tile *w) {
    const dp_view *const view = &w->frame->view;
    const double px = w->tile_x, py = w->tile_y;
    const dp_vec3 at = dp_unproject(view, (dp_pointd){px, py, 1}), x = view->across, y = view->down;
    const dp_vec3 o =
        dp_sub(at, view->perspective ? view->eye : dp_unproject(view, (dp_pointd){px, py, 0}));
    const dp_vec3 dual[3] = {dp_cross(x, y), dp_cross(y, o), dp_cross(o, x)};
    const double inverse = -1 / dp_dot(o, dual[0]);
    for (int i = 0; i < 3; i++) {
        float *const out = w->plane_normal[i];
        out[0] = (float)(dual[i].x * inverse), out[1] = (float)(dual[i].y * inverse),
        out[2] = (float)(dual[i].z * inverse);
    }
}

void dp_tile_place(dp_tile *w, uint32_t index) {
    w->index = index;
    w->tile_x = index % w->frame->tiles_x * DP_TILE;
    w->tile_y = index / w->frame->tiles_x * DP_TILE;
}

void dp_tile_open(dp_tile *w, uint32_t index) {
    dp_tile_place(w, index);
    w->depth = w->frame->depth + (size_t)index * w->frame->tile_samples;
    memset(w->winner, 0xff, w->frame->tile_samples * sizeof *w->winner);
    memset(w->candidate_pixels, 0, sizeof w->candidate_pixels);
    if (w->finds_edges) find_plane_normal(w);
    w->close.count = 0;
}

/* Is the point on the inner side of a -> b? Computed in one canonical order of the ends, so that of
 * two polygons that share an edge exactly one covers the point. */
static bool left_of(dp_vertex a, dp_vertex b, float x, float y, bool flip) {
    const bool swap = a.y > b.y || (a.y == b.y && a.x > b.x);
    const dp_vertex s = swap ? b : a, t = swap ? a : b;
    const double e =
        ((double)t.x - s.x) * ((double)y - s.y) - ((double)t.y - s.y) * ((double)x - s.x);
    return swap != flip ? e < 0 : e >= 0;
}

bool dp_tile_covers(const dp_tile *w, const dp_tile_polygon *polygon, float x, float y) {
    const dp_vertex *const p = w->points + polygon->point;
    const bool front = polygon->flags & DP_POLYGON_FRONT;
    for (uint32_t i = 0; i < polygon->points; i++)
        if (!left_of(p[i], p[i + 1 == polygon->points ? 0 : i + 1], x, y, front)) return false;
    return true;
}
