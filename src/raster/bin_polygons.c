/* Sorts polygons into tiles: which tiles each one reaches, with a margin.
 *
 *    triangles: many at once (place.inc); what the kernel cannot place, as any polygon
 *    any polygon: the tiles of its outline's box; of large ones, only tiles inside all edges
 *
 * Invariant: a polygon is in the bin of each tile that owns a sample point of its edges. Bad
 * polygons (an index out of range, a corner that is not finite, no area) are dropped and counted
 * here and nowhere else. Lists and sorting are in core/bin.c. */
#include "raster/kernels.h"
#include "raster/stages.h"

typedef struct job {
    dp_frame *frame;
    float margin;
    dp_bin_worker *workers;
} job;

void dp_bin_worker_begin(dp_bin_worker *worker) {
    worker->stats = (dp_stats){0};
    worker->failed = false;
}

void dp_bin_worker_free(dp_bin_worker *worker, const dp_allocator *memory) {
    dp_outline_scratch_free(&worker->scratch, memory);
}

uint64_t dp_bin_worker_bytes(const dp_bin_worker *worker) {
    return dp_outline_scratch_bytes(&worker->scratch);
}

static const dp_tile_rect NOWHERE = {0};

static int16_t tile_of(float px) { return (int16_t)floorf(px / DP_TILE); }

/* Printed silhouettes lie beside their polygons, up to fin_reach away (printed/fins.c). */
static float margin_of(const job *j, uint32_t polygon) {
    return j->frame->fin_reach > j->margin && j->frame->outlined[polygon] ? j->frame->fin_reach
                                                                          : j->margin;
}

static dp_tile_rect rect_around(float margin, float x0, float y0, float x1, float y1) {
    return (dp_tile_rect){tile_of(x0 - margin),
                          tile_of(y0 - margin),
                          (int16_t)(tile_of(x1 + margin) + 1),
                          (int16_t)(tile_of(y1 + margin) + 1),
                          0,
                          0};
}

static dp_tile_rect rect_of(float margin, const dp_outline *outline) {
    float x0 = outline->points[0].x, x1 = x0, y0 = outline->points[0].y, y1 = y0;
    for (uint32_t i = 1; i < outline->count; i++) {
        const dp_point p = outline->points[i];
        x0 = dp_minf(x0, p.x), x1 = dp_maxf(x1, p.x);
        y0 = dp_minf(y0, p.y), y1 = dp_maxf(y1, p.y);
    }
    return rect_around(margin, x0, y0, x1, y1);
}

static bool are_of_one(const dp_polygons *polygons, uint32_t a, uint32_t b) {
    return polygons->source_polygon && polygons->source_polygon[a] == polygons->source_polygon[b];
}

/* Does the polygon only hold lines (dp_edge_kind)? */
static bool holds_lines(const dp_polygons *polygons, uint32_t polygon) {
    const uint32_t first = dp_first_corner(polygons, polygon),
                   n = dp_corner_count(polygons, polygon);
    for (uint32_t i = 0; polygons->mark_count && i < n; i++)
        if (polygons->edge_flags[first + i] == DP_EDGE_SECTION ||
            polygons->edge_flags[first + i] == DP_EDGE_HATCHING)
            return true;
    return false;
}

/* Is a polygon without area one that the source's user counts? Of a polygon that was split only the
 * last piece is, and only if no other piece has an area. */
static bool counts_as_dropped(const dp_frame *frame, uint32_t polygon) {
    const dp_polygons *const polygons = &frame->polygons;
    if (holds_lines(polygons, polygon)) return false;
    if (polygon + 1 < polygons->count && are_of_one(polygons, polygon, polygon + 1)) return false;
    for (uint32_t i = polygon; i-- > 0 && are_of_one(polygons, i, polygon);)
        if (!dp_polygon_has_no_area(frame, i)) return false;
    return true;
}

static dp_tile_rect place_polygon(const job *j, uint32_t polygon, dp_bin_worker *self) {
    dp_outline outline;
    switch (dp_outline_make(j->frame, polygon, &self->scratch, &outline)) {
    case DP_OUTLINE_OUTSIDE:
        return NOWHERE;
    case DP_OUTLINE_INDEX:
        self->stats.dropped_index++;
        return NOWHERE;
    case DP_OUTLINE_FINITE:
        self->stats.dropped_finite++;
        return NOWHERE;
    case DP_OUTLINE_MEMORY:
        self->failed = true;
        return NOWHERE;
    case DP_OUTLINE_OK:
        break;
    }
    if (dp_outline_is_edge_on(&outline) && dp_polygon_has_no_area(j->frame, polygon)) {
        self->stats.dropped_area += counts_as_dropped(j->frame, polygon);
        return NOWHERE;
    }
    if (outline.clipped) self->stats.clipped++;
    return rect_of(margin_of(j, polygon), &outline);
}

static void place(void *arg, uint32_t first, uint32_t count, dp_tile_rect *rects, uint32_t worker) {
    const job *const j = arg;
    dp_bin_worker *const self = &j->workers[worker];
    if (j->frame->polygons.firsts) {
        for (uint32_t i = 0; i < count; i++) rects[i] = place_polygon(j, first + i, self);
        return;
    }
    dp_raster_kernels_for(j->frame->lanes)->place(j->frame, j->margin, first, count, rects);
    for (uint32_t i = 0; i < count; i++)
        if (rects[i].x0 == DP_UNPLACED || margin_of(j, first + i) > j->margin)
            rects[i] = place_polygon(j, first + i, self);
}

/* False if the widened tile lies outside one edge. The outline is convex; its facing tells which
 * side of an edge is inside. */
static bool touches(void *arg, uint32_t polygon, int32_t tile_x, int32_t tile_y, uint32_t worker) {
    const job *const j = arg;
    dp_outline outline;
    if (dp_outline_make(j->frame, polygon, &j->workers[worker].scratch, &outline)) return true;
    const dp_facing facing = dp_outline_facing(j->frame, polygon, &outline);
    if (facing.edge_on) return true;
    const double sign = facing.front ? -1 : 1;
    const double margin = (double)margin_of(j, polygon);
    const double x0 = (double)tile_x * DP_TILE - margin, x1 = x0 + DP_TILE + 2 * margin;
    const double y0 = (double)tile_y * DP_TILE - margin, y1 = y0 + DP_TILE + 2 * margin;
    for (uint32_t i = 0; i < outline.count; i++) {
        const dp_point p = outline.points[i], q = outline.points[(i + 1) % outline.count];
        const double a = sign * ((double)p.y - q.y), b = sign * ((double)q.x - p.x);
        /* the tile's corner that is farthest inside */
        const double x = a > 0 ? x1 : x0, y = b > 0 ? y1 : y0;
        if (a * (x - p.x) + b * (y - p.y) < 0) return false;
    }
    return true;
}

bool dp_bin_polygons(dp_frame *frame, float margin, dp_bin_worker *workers) {
    job j = {frame, margin, workers};
    bool sound = dp_bins_fill(&frame->polygon_bins, frame->polygons.count, frame->tiles_x,
                              frame->tiles_y, place, touches, &j, frame->threads, frame->memory);
    for (uint32_t i = 0; i < dp_threads_count(frame->threads); i++)
        sound = sound && !workers[i].failed;
    return sound;
}
