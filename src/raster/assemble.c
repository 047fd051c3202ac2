/* A tile's polygons in tile space, with plane and pixel box. Faces are drawn on the way.
 *
 *    sort the bin's triangles into front and back faces, in submission order   (part, place.inc)
 *    assemble front faces: fetch, plane, box, normal; draw                     (assemble.inc)
 *    find the furthest depth of each block of pixels                           (cull.c)
 *    drop back faces that are hidden                                           (cull.inc)
 *    assemble the other back faces; draw those in sight
 *
 * Triangles go through the kernel; what is here takes any polygon, one at a time. Invariant: front
 * faces come before back faces, and each kind is in submission order. Of polygons with more than
 * three corners all are added in submission order, and back faces are drawn later
 * (dp_tile_faces). */
#include "raster/kernels.h"
#include "raster/tile.h"

#include <string.h>

/* Plane through the points by Newell's method, for any number of points. */
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

static uint8_t clamp_px(float v) {
    return (uint8_t)(v <= 0 ? 0 : v >= DP_TILE - 1 ? DP_TILE - 1 : v);
}

static inline __attribute__((always_inline)) void set_box(dp_tile_polygon *out, float x0, float y0,
                                                          float x1, float y1) {
    out->x0 = clamp_px(x0), out->x1 = clamp_px(x1);
    out->y0 = clamp_px(y0), out->y1 = clamp_px(y1);
    if (x1 >= 0 && y1 >= 0 && x0 < DP_TILE && y0 < DP_TILE) out->flags |= DP_POLYGON_TOUCHES;
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

static void draw(dp_tile *w, uint32_t index, bool backs) {
    const dp_tile_polygon *const p = &w->polygons[index];
    if (!dp_is_surface(w, p)) return;
    if (p->flags & DP_POLYGON_FRONT || (backs && !dp_tile_is_hidden(w, p)))
        dp_raster_kernels_for(w->frame->lanes)->raster(w, p, index);
}

/* Writes a polygon's points, in tile space. */
static void put_points(const dp_tile *w, uint32_t id, const dp_outline *outline,
                       dp_vertex *points) {
    const uint32_t first = dp_first_corner(&w->frame->polygons, id);
    for (uint32_t i = 0; i < outline->count; i++) {
        const dp_point p = outline->points[i];
        const uint32_t key =
            outline->clipped
                ? 0
                : w->frame->vertices[dp_corner_vertex(&w->frame->polygons, first + i)].key;
        points[i] = (dp_vertex){p.x - (float)w->tile_x, p.y - (float)w->tile_y, p.d, key};
    }
}

/* Fills in polygon `index`, with its points from `point` on; there is room for both. Draws it if it
 * is a front face, or, when `backs`, a back face that is not hidden. */
static void set_polygon(dp_tile *w, uint32_t index, uint32_t id, uint32_t point,
                        const dp_outline *outline, bool backs) {
    const dp_facing facing = dp_outline_facing(w->frame, id, outline);
    dp_tile_polygon *const out = &w->polygons[index];
    dp_vertex *const points = w->points + point;
    *out = (dp_tile_polygon){.id = id, .point = point, .points = outline->count & 0xffffff};
    out->flags = (facing.front ? DP_POLYGON_FRONT : 0) | (facing.edge_on ? DP_POLYGON_EDGE_ON : 0) |
                 (outline->clipped ? DP_POLYGON_CLIPPED : 0);
    put_points(w, id, outline, points);
    plane_setup(points, outline->count, out);
    box_setup(points, outline->count, out);
    for (uint32_t i = 0; i < 3 && outline->count == 3; i++)
        if (dp_tile_edge_reaches(w, out, i, DP_BESIDE))
            out->flags |= (uint32_t)DP_POLYGON_NEAR << i & 255;
    draw(w, index, backs);
}

static bool make_outline(dp_tile *w, uint32_t id, dp_outline *outline) {
    const dp_outline_state state = dp_outline_make(w->frame, id, &w->scratch, outline);
    if (state == DP_OUTLINE_MEMORY) w->failed = true;
    return !state;
}

static void add_polygon(dp_tile *w, uint32_t id) {
    dp_outline outline;
    if (!make_outline(w, id, &outline)) return;
    if (!DP_TILE_RESERVE(w, w, polygons, polygons_cap, w->polygon_count + 1u) ||
        !DP_TILE_RESERVE(w, w, points, points_cap, (size_t)w->point_count + outline.count))
        return;
    const uint32_t point = w->point_count;
    w->point_count += outline.count;
    set_polygon(w, w->polygon_count++, id, point, &outline, false);
}

/* A clipped polygon gets new points; its old ones stay unused. */
void dp_tile_reassemble(dp_tile *w, uint32_t index, bool backs) {
    const uint32_t id = w->polygons[index].id;
    uint32_t point = w->polygons[index].point;
    dp_outline outline;
    if (!make_outline(w, id, &outline)) return;
    if (outline.count > 3) {
        if (!DP_TILE_RESERVE(w, w, points, points_cap, (size_t)w->point_count + outline.count))
            return;
        point = w->point_count;
        w->point_count += outline.count;
    }
    set_polygon(w, index, id, point, &outline, backs);
}

/* The tile's polygons in submission order, those tagged as back faces apart. */
static bool collect_ids(dp_tile *w, uint32_t *count, uint32_t *back_count) {
    const dp_bins *const bins = &w->frame->polygon_bins;
    const size_t all = dp_bins_tile_count(bins, w->index);
    const size_t room = all + DP_BIN_ROOM;
    if (!DP_TILE_RESERVE(w, w, ids, ids_cap, room) ||
        !DP_TILE_RESERVE(w, w, backs, backs_cap, room))
        return false;
    *count = *back_count = 0;
    for (uint32_t c = 0; c < bins->chunk_count; c++) {
        const dp_bin_chunk *const chunk = &bins->chunks[c];
        dp_bins_prefetch(bins, w->index, c);
        const uint32_t first = chunk->offsets[w->index], n = chunk->offsets[w->index + 1] - first;
        dp_raster_kernels_for(w->frame->lanes)
            ->part(chunk->entries + first, n, w->ids, count, w->backs, back_count);
    }
    return true;
}

/* The one pass of printed silhouettes draws back faces itself (printed/fins.c). */
static bool draws_backs(const dp_frame *frame) {
    return !(frame->lines && dp_draws_fins(frame) && frame->styles[0].passes == 1);
}

/* Culls back faces; where hidden lines are looked for, those that it drops are kept apart. Both lists
 * are in one order. */
static bool cull_backs(dp_tile *w, uint32_t *back_count) {
    const dp_raster_kernels *const kernels = dp_raster_kernels_for(w->frame->lanes);
    const uint32_t all = *back_count;
    w->culled_count = 0;
    if (!w->frame->hidden) {
        *back_count = kernels->cull(w, w->backs, all);
        return true;
    }
    if (!DP_TILE_RESERVE(w, w, culled, culled_cap, (size_t)all + DP_BIN_ROOM)) return false;
    memcpy(w->culled, w->backs, all * sizeof *w->culled);
    const uint32_t kept = *back_count = kernels->cull(w, w->backs, all);
    for (uint32_t i = 0, k = 0; i < all; i++) {
        if (k < kept && w->culled[i] == w->backs[k])
            k++;
        else
            w->culled[w->culled_count++] = w->culled[i];
    }
    return true;
}

/* Makes and draws front faces, and of polygons with any number of corners all; returns whether back
 * faces are left, `*back_count` of them. */
static bool assemble_fronts(dp_tile *w, uint32_t *back_count) {
    uint32_t count;
    w->polygon_count = w->point_count = w->culled_count = 0;
    for (uint32_t i = 0; i < DP_STRIP_SIDES * DP_STRIP; i++)
        w->strip[i / DP_STRIP][i % DP_STRIP] = DP_DEPTH_EMPTY;
    if (!collect_ids(w, &count, back_count)) return false;
    if (w->frame->polygons.firsts) {
        for (uint32_t i = 0; i < count && !w->failed; i++) add_polygon(w, w->ids[i]);
        return false;
    }
    w->keys_stride = count + *back_count + DP_SEEN_ROOM;
    if (!DP_TILE_RESERVE(w, w, keys, keys_cap, 3 * (size_t)w->keys_stride)) return false;
    dp_raster_kernels_for(w->frame->lanes)->assemble(w, w->ids, count, false);
    return true;
}

void dp_tile_assemble_fronts(dp_tile *w) {
    uint32_t back_count;
    (void)assemble_fronts(w, &back_count);
}

void dp_tile_assemble(dp_tile *w) {
    uint32_t back_count;
    const bool backs = assemble_fronts(w, &back_count);
    w->undrawn = w->polygon_count;
    w->won = 0;
    dp_tile_find_farthest(w);
    if (!backs || (w->frame->culls_backs && !cull_backs(w, &back_count))) return;
    dp_raster_kernels_for(w->frame->lanes)
        ->assemble(w, w->backs, back_count, draws_backs(w->frame));
}

/* What was culled lies behind all samples around it: drawn again it wins none. */
bool dp_tile_complete(dp_tile *w) {
    if (w->culled_count)
        dp_raster_kernels_for(w->frame->lanes)->assemble(w, w->culled, w->culled_count, true);
    w->close.count = 0;
    return !w->failed && dp_tile_see(w, false);
}
