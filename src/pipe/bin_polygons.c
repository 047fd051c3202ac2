/* Which tiles a polygon touches; and the one place where bad polygons are dropped and counted. */
#include "pipe/stages.h"

typedef struct job {
    dp_frame *frame;
    float margin;
    dp_bin_worker *workers;
} job;

static const dp_tile_rect NOWHERE = {0, 0, 0, 0};

/* floor(px / DP_TILE); what is placed lies within a few pictures of the screen, so OFFSET makes it positive. */
static int32_t tile_of(float px) {
    enum { OFFSET = 1 << 14 };
    return (int32_t)(px * (1.0f / DP_TILE) + OFFSET) - OFFSET;
}

/* Silhouettes as printed lie beyond the polygons that they belong to (fringe.c). */
static float margin_of(const job *j, uint32_t polygon) {
    return j->frame->fringe > j->margin && j->frame->outlined[polygon] ? j->frame->fringe : j->margin;
}

static dp_tile_rect rect_around(float margin, float x0, float y0, float x1, float y1) {
    return (dp_tile_rect){tile_of(x0 - margin), tile_of(y0 - margin), tile_of(x1 + margin) + 1, tile_of(y1 + margin) + 1};
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

/* A triangle that needs no clipping and has an area on the screen; false where that is not so. */
static bool place_triangle(const job *j, uint32_t id, dp_tile_rect *rect) {
    const dp_polygons *const polygons = &j->frame->polygons;
    dp_vertex v[3];
    for (uint32_t i = 0; i < 3; i++) {
        const uint32_t vertex = dp_corner_vertex(polygons, 3 * id + i);
        if (vertex >= polygons->vertex_count) return false;
        v[i] = j->frame->vertices[vertex];
    }
    if (dp_needs_clipping(v[0], v[1], v[2])) return false;
    const float bx = v[1].x - v[0].x, by = v[1].y - v[0].y, cx = v[2].x - v[0].x, cy = v[2].y - v[0].y;
    const float reach = dp_maxf(dp_maxf(fabsf(bx), fabsf(by)), dp_maxf(fabsf(cx), fabsf(cy)));
    if (!(fabsf(bx * cy - by * cx) > DP_NEARLY_EDGE_ON * reach)) return false;
    *rect = rect_around(margin_of(j, id), dp_minf(v[0].x, dp_minf(v[1].x, v[2].x)), dp_minf(v[0].y, dp_minf(v[1].y, v[2].y)),
                        dp_maxf(v[0].x, dp_maxf(v[1].x, v[2].x)), dp_maxf(v[0].y, dp_maxf(v[1].y, v[2].y)));
    return true;
}

static dp_tile_rect place(void *arg, uint32_t polygon, uint32_t worker) {
    const job *const j = arg;
    dp_bin_worker *const self = &j->workers[worker];
    dp_tile_rect rect;
    if (!j->frame->polygons.firsts && place_triangle(j, polygon, &rect)) return rect;
    dp_outline outline;
    switch (dp_outline_make(j->frame, polygon, &self->scratch, &outline)) {
    case DP_OUTLINE_OUTSIDE: return NOWHERE;
    case DP_OUTLINE_INDEX: self->stats.dropped_index++; return NOWHERE;
    case DP_OUTLINE_FINITE: self->stats.dropped_finite++; return NOWHERE;
    case DP_OUTLINE_MEMORY: self->failed = true; return NOWHERE;
    case DP_OUTLINE_OK: break;
    }
    if (dp_outline_facing(j->frame, polygon, &outline).edge_on && dp_polygon_has_no_area(j->frame, polygon)) {
        self->stats.dropped_area++;
        return NOWHERE;
    }
    if (outline.clipped) self->stats.clipped++;
    return rect_of(margin_of(j, polygon), &outline);
}

/* False when one edge has the whole widened tile on its outside. The outline is convex; which side is
 * its inside comes from its facing. */
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
        const double x = a > 0 ? x1 : x0, y = b > 0 ? y1 : y0; /* the corner most inside */
        if (a * (x - p.x) + b * (y - p.y) < 0) return false;
    }
    return true;
}

bool dp_bin_polygons(dp_frame *frame, float margin, dp_bin_worker *workers) {
    job j = {frame, margin, workers};
    bool sound = dp_bins_fill(&frame->polygon_bins, frame->polygons.count, frame->tiles_x,
                              frame->tiles_y, place, touches, &j, frame->threads, frame->memory);
    for (uint32_t i = 0; i < dp_threads_count(frame->threads); i++) sound = sound && !workers[i].failed;
    return sound;
}
