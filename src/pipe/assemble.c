/* A tile's polygons: fetched in submission order, placed in tile space, with plane and pixel box. */
#include "pipe/intersect.h"

/* Plane through the points by Newell's method, which takes any number of them. */
static void plane_setup(const dp_vertex *p, uint32_t n, dp_tile_polygon *out) {
    double nx = 0, ny = 0, nz = 0;
    for (uint32_t i = 2; i < n; i++) {
        const double ax = (double)p[i - 1].x - p[0].x, ay = (double)p[i - 1].y - p[0].y;
        const double ad = (double)p[i - 1].d - p[0].d;
        const double bx = (double)p[i].x - p[0].x, by = (double)p[i].y - p[0].y;
        const double bd = (double)p[i].d - p[0].d;
        nx += ay * bd - ad * by;
        ny += ad * bx - ax * bd;
        nz += ax * by - ay * bx;
    }
    const double dx = nz != 0 ? -nx / nz : 0, dy = nz != 0 ? -ny / nz : 0;
    out->dx = (float)dx, out->dy = (float)dy;
    out->d0 = (float)(p[0].d - dx * p[0].x - dy * p[0].y);
}

static uint8_t clamp_px(float v) { return (uint8_t)(v <= 0 ? 0 : v >= DP_TILE - 1 ? DP_TILE - 1 : v); }

static inline __attribute__((always_inline)) void set_box(dp_tile_polygon *out, float x0, float y0, float x1, float y1) {
    out->x0 = clamp_px(x0), out->x1 = clamp_px(x1);
    out->y0 = clamp_px(y0), out->y1 = clamp_px(y1);
    if (x1 >= 0 && y1 >= 0 && x0 < DP_TILE && y0 < DP_TILE) out->flags |= DP_POLYGON_TOUCHES;
    if (x0 > -DP_BESIDE && y0 > -DP_BESIDE && x1 < DP_TILE + DP_BESIDE && y1 < DP_TILE + DP_BESIDE)
        out->flags |= DP_POLYGON_WITHIN;
}

static void box_setup(const dp_vertex *p, uint32_t n, dp_tile_polygon *out) {
    float x0 = p[0].x, x1 = x0, y0 = p[0].y, y1 = y0, nearest = p[0].d;
    for (uint32_t i = 1; i < n; i++) {
        x0 = dp_minf(x0, p[i].x), x1 = dp_maxf(x1, p[i].x);
        y0 = dp_minf(y0, p[i].y), y1 = dp_maxf(y1, p[i].y);
        nearest = dp_maxf(nearest, p[i].d);
    }
    out->nearest = nearest;
    set_box(out, x0, y0, x1, y1);
}

static dp_vertex to_tile(const dp_tile_worker *w, float x, float y, float d, uint32_t key) {
    return (dp_vertex){x - (float)w->tile_x, y - (float)w->tile_y, d, key};
}

static bool has_room(dp_tile_worker *w, uint32_t points) {
    if (w->polygon_count < w->polygons_cap && w->point_count + points <= w->points_cap) return true;
    return DP_WORKER_RESERVE(w, polygons, polygons_cap, w->polygon_count + 1u) &&
           DP_WORKER_RESERVE(w, points, points_cap, (size_t)w->point_count + points);
}

/* Any polygon, clipped or not. */
static void add_polygon(dp_tile_worker *w, uint32_t id) {
    dp_outline outline;
    const dp_outline_state state = dp_outline_make(w->frame, id, &w->scratch, &outline);
    if (state == DP_OUTLINE_MEMORY) w->failed = true;
    if (state) return;
    const uint32_t n = outline.count, first = dp_first_corner(&w->frame->polygons, id);
    if (!has_room(w, n)) return;
    const dp_facing facing = dp_outline_facing(w->frame, id, &outline);
    dp_tile_polygon *const out = &w->polygons[w->polygon_count++];
    *out = (dp_tile_polygon){.id = id, .point = w->point_count, .points = n};
    out->flags = (facing.front ? DP_POLYGON_FRONT : 0) | (facing.edge_on ? DP_POLYGON_EDGE_ON : 0) |
                 (outline.clipped ? DP_POLYGON_CLIPPED : 0);
    dp_vertex *const points = w->points + w->point_count;
    for (uint32_t i = 0; i < n; i++) {
        const dp_point p = outline.points[i];
        const uint32_t key =
            outline.clipped ? 0 : w->frame->vertices[dp_corner_vertex(&w->frame->polygons, first + i)].key;
        points[i] = to_tile(w, p.x, p.y, p.d, key);
    }
    w->point_count += n;
    plane_setup(points, n, out);
    box_setup(points, n, out);
    out->watch = dp_watch_reach(w, out);
}

/* The same for a triangle that needs no clipping and is not nearly edge-on; false where it is not. */
static bool add_triangle(dp_tile_worker *w, uint32_t id) {
    const dp_polygons *const polygons = &w->frame->polygons;
    const dp_vertex *const vertices = w->frame->vertices;
    const dp_vertex a = vertices[dp_corner_vertex(polygons, 3 * id)];
    const dp_vertex b = vertices[dp_corner_vertex(polygons, 3 * id + 1)];
    const dp_vertex c = vertices[dp_corner_vertex(polygons, 3 * id + 2)];
    if (dp_needs_clipping(a, b, c)) return false;
    const float bx = b.x - a.x, by = b.y - a.y, bd = b.d - a.d, cx = c.x - a.x, cy = c.y - a.y, cd = c.d - a.d;
    const float area = bx * cy - by * cx;
    const float reach = dp_maxf(dp_maxf(fabsf(bx), fabsf(by)), dp_maxf(fabsf(cx), fabsf(cy)));
    if (!(fabsf(area) > DP_NEARLY_EDGE_ON * reach)) return false;
    if (!has_room(w, 3)) return true; /* the worker has failed */
    dp_tile_polygon *const out = &w->polygons[w->polygon_count++];
    dp_vertex *const points = w->points + w->point_count;
    points[0] = to_tile(w, a.x, a.y, a.d, a.key);
    points[1] = to_tile(w, b.x, b.y, b.d, b.key);
    points[2] = to_tile(w, c.x, c.y, c.d, c.key);
    const float inverse = 1 / area;
    const float dx = (bd * cy - by * cd) * inverse, dy = (bx * cd - bd * cx) * inverse;
    *out = (dp_tile_polygon){.id = id, .point = w->point_count, .points = 3,
                             .flags = area < 0 ? DP_POLYGON_FRONT : 0, .dx = dx, .dy = dy,
                             .d0 = a.d - dx * points[0].x - dy * points[0].y};
    w->point_count += 3;
    out->nearest = dp_maxf(a.d, dp_maxf(b.d, c.d));
    set_box(out, dp_minf(points[0].x, dp_minf(points[1].x, points[2].x)),
            dp_minf(points[0].y, dp_minf(points[1].y, points[2].y)),
            dp_maxf(points[0].x, dp_maxf(points[1].x, points[2].x)),
            dp_maxf(points[0].y, dp_maxf(points[1].y, points[2].y)));
    out->watch = dp_watch_reach(w, out);
    return true;
}

void dp_tile_assemble(dp_tile_worker *w) {
    const dp_bins *const bins = &w->frame->polygon_bins;
    const bool polygons = w->frame->polygons.firsts;
    w->polygon_count = w->point_count = 0;
    for (uint32_t c = 0; c < bins->chunk_count; c++) {
        const dp_bin_chunk *const chunk = &bins->chunks[c];
        for (uint32_t i = chunk->offsets[w->tile]; i < chunk->offsets[w->tile + 1] && !w->failed; i++)
            if (polygons || !add_triangle(w, chunk->entries[i])) add_polygon(w, chunk->entries[i]);
    }
}
