/* Which way each polygon faces, and which have an outline to draw: the first half of the geometry
 * shader of (Hermosilla and Vázquez 2010, 2.3.2, Listing 2.1).
 *
 * Listing 2.1 computes the facing of a triangle and of its three neighbours for every triangle, so
 * four times in all. Here it is computed once, and the silhouette test is three look-ups.
 *
 * Data structure: a byte of facing per polygon. Invariant: facing agrees with the rest of the
 * pipeline (outline.c): the sign of the area on the screen or, if that is too small to tell, the
 * angle in space. Polygons without area have no facing of their own; they take that of a
 * front-facing neighbour if they have one, so that a sliver between two front faces makes no line.
 * Not handled: neighbours that share no corner with an edge. */
#include "core/facing.h"

#include "mesh/adjacency.h"
#include "core/outline.h"

enum { BLOCK = DP_TUNED(16384, 5) };

static bool any_bad(const dp_frame *frame, uint32_t first, uint32_t n) {
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t v = dp_corner_vertex(&frame->polygons, first + i);
        if (v >= frame->polygons.vertex_count) return true;
        const float *const p = dp_vertex_position(&frame->polygons, v);
        if (!isfinite(p[0]) || !isfinite(p[1]) || !isfinite(p[2])) return true;
    }
    return false;
}

/* For polygons that are clipped: always in space. */
static uint8_t facing_in_space(const dp_frame *frame, uint32_t polygon) {
    const uint32_t first = dp_first_corner(&frame->polygons, polygon),
                   n = dp_corner_count(&frame->polygons, polygon);
    if (n < 3 || any_bad(frame, first, n) || dp_polygon_has_no_area(frame, polygon))
        return DP_FACING_NO_AREA;
    return dp_polygon_faces_eye(frame, polygon) ? DP_FACING_FRONT : 0;
}

/* On the screen, if the area is clear; else 0xff. */
static uint8_t facing_of_triangle(const dp_frame *frame, uint32_t polygon) {
    dp_vertex v[3];
    for (uint32_t i = 0; i < 3; i++) {
        const uint32_t vertex = dp_corner_vertex(&frame->polygons, 3 * polygon + i);
        if (vertex >= frame->polygons.vertex_count) return DP_FACING_NO_AREA;
        v[i] = frame->vertices[vertex];
    }
    if (dp_needs_clipping(v[0], v[1], v[2])) return 0xff;
    const float bx = v[1].x - v[0].x, by = v[1].y - v[0].y, cx = v[2].x - v[0].x,
                cy = v[2].y - v[0].y;
    const float area = bx * cy - by * cx;
    const float reach = dp_maxf(dp_maxf(fabsf(bx), fabsf(by)), dp_maxf(fabsf(cx), fabsf(cy)));
    if (!(fabsf(area) > frame->nearly_edge_on * reach)) {
        const bool edge_on = dp_area_is_edge_on((double)area, (double)reach);
        if (!edge_on || dp_polygon_has_no_area(frame, polygon)) return 0xff;
        return dp_facing_in_space(frame, polygon, true).front ? DP_FACING_FRONT : 0;
    }
    return area < 0 ? DP_FACING_FRONT : 0;
}

static uint8_t facing_of(const dp_frame *frame, uint32_t polygon) {
    const uint8_t quick = frame->polygons.firsts ? 0xff : facing_of_triangle(frame, polygon);
    return quick == 0xff ? facing_in_space(frame, polygon) : quick;
}

static void block_range(const dp_frame *frame, uint32_t index, uint32_t *first, uint32_t *last) {
    *first = index * BLOCK;
    *last = frame->polygons.count - *first < BLOCK ? frame->polygons.count : *first + BLOCK;
}

static void face_block(void *arg, uint32_t index, uint32_t worker) {
    dp_frame *const frame = arg;
    uint32_t first, last;
    (void)worker;
    block_range(frame, index, &first, &last);
    for (uint32_t i = first; i < last; i++) frame->facing[i] = facing_of(frame, i);
}

/* Gives a polygon without area its facing. Reads only neighbours with an area, which do not
 * change. */
static void adopt_facing(dp_frame *frame, uint32_t polygon) {
    const dp_adjacency *const a = frame->adjacency;
    const uint32_t first = dp_first_corner(&frame->polygons, polygon),
                   n = dp_corner_count(&frame->polygons, polygon);
    for (uint32_t c = first; c < first + n; c++) {
        if (!dp_is_across(a->across[c])) continue;
        const uint8_t other =
            frame->facing[dp_polygon_of_corner(a, dp_across_corner(a->across[c]))];
        if ((other & (DP_FACING_NO_AREA | DP_FACING_FRONT)) == DP_FACING_FRONT)
            frame->facing[polygon] |= DP_FACING_FRONT;
    }
}

static dp_clip_point corner_in_clip(const dp_frame *frame, uint32_t corner) {
    const dp_polygons *const p = &frame->polygons;
    return dp_to_clip(&frame->view, dp_v3f(dp_vertex_position(p, dp_corner_vertex(p, corner))));
}

/* An edge of more than two polygons is an outline if all of them lie on one side of it on the
 * screen; else the eye sees a crease there. The first of them draws it. */
static int outline_of_fan(const dp_frame *frame, const dp_fan_corner *fan, uint32_t corner) {
    const dp_adjacency *const a = frame->adjacency;
    const dp_polygons *const p = &frame->polygons;
    const uint32_t *const corners = a->fans + fan->first;
    if (corner != corners[0]) return -1;
    bool any[2] = {false, false};
    dp_pointd s = {0, 0, 0}, t = s;
    for (uint32_t i = 0; i < fan->count; i++) {
        const uint32_t polygon = dp_polygon_of_corner(a, corners[i]),
                       first = dp_first_corner(p, polygon), n = dp_corner_count(p, polygon);
        const uint32_t k = corners[i] - first;
        const dp_clip_point from = corner_in_clip(frame, corners[i]),
                            to = corner_in_clip(frame, first + (k + 1) % n);
        const dp_clip_point far = corner_in_clip(frame, first + (k + 1 + n / 2) % n);
        if (!(from.w > 0 && to.w > 0 && far.w > 0)) return -1;
        if (i == 0) s = dp_to_screen(&frame->view, from), t = dp_to_screen(&frame->view, to);
        const dp_pointd f = dp_to_screen(&frame->view, far);
        any[(t.x - s.x) * (f.y - s.y) - (t.y - s.y) * (f.x - s.x) < 0] = true;
    }
    return any[0] && any[1] ? -1 : (int)DP_LINE_SILHOUETTE;
}

int dp_outline_of_edge(const dp_frame *frame, uint32_t polygon, uint32_t corner) {
    const dp_adjacency *const a = frame->adjacency;
    const uint32_t across = a->across[corner];
    if (across == DP_ACROSS_NONE || frame->facing[polygon] & DP_FACING_NO_AREA) return -1;
    const dp_fan_corner *const fan = a->odd[polygon] ? dp_fan_at(a, corner) : NULL;
    if (fan) return outline_of_fan(frame, fan, corner);
    if (across == DP_ACROSS_OPEN) return DP_LINE_BORDER;
    const uint32_t other = dp_polygon_of_corner(a, dp_across_corner(across));
    const bool front = dp_faces_front(frame, polygon), flipped = across & DP_ACROSS_FLIPPED;
    if (front == (dp_faces_front(frame, other) != flipped)) return -1;
    if (frame->facing[other] & DP_FACING_NO_AREA) return DP_LINE_SILHOUETTE;
    return (flipped ? polygon < other : front) ? DP_LINE_SILHOUETTE : -1;
}

static bool is_outlined(const dp_frame *frame, uint32_t polygon) {
    const uint32_t first = dp_first_corner(&frame->polygons, polygon),
                   n = dp_corner_count(&frame->polygons, polygon);
    for (uint32_t c = first; c < first + n; c++)
        if (dp_outline_of_edge(frame, polygon, c) >= 0) return true;
    return false;
}

/* A front face with a neighbour that is none. A back face draws nothing, unless it is listed as
 * odd. */
static bool is_outlined_triangle(const dp_frame *frame, uint32_t t) {
    const dp_adjacency *const a = frame->adjacency;
    const uint8_t *const facing = frame->facing;
    if (a->odd[t] || facing[t] & DP_FACING_NO_AREA) return is_outlined(frame, t);
    if (!facing[t])
        return frame->any_without_area &&
               is_outlined(frame, t); /* it may draw for a front face without area */
    const uint32_t *const across = a->across + 3 * (size_t)t;
    return !(facing[across[0] / 3] & facing[across[1] / 3] & facing[across[2] / 3] &
             DP_FACING_FRONT);
}

static void outline_block(void *arg, uint32_t index, uint32_t worker) {
    dp_frame *const frame = arg;
    uint32_t first, last;
    (void)worker;
    block_range(frame, index, &first, &last);
    const bool triangles = !frame->polygons.firsts;
    for (uint32_t i = first; i < last; i++)
        frame->outlined[i] = triangles ? is_outlined_triangle(frame, i) : is_outlined(frame, i);
}

void dp_find_facing(dp_frame *frame) {
    const uint32_t count = frame->polygons.count, blocks = count / BLOCK + (count % BLOCK != 0);
    dp_parallel(frame->threads, blocks, face_block, frame);
    frame->any_without_area = false;
    for (uint32_t i = 0; i < count; i++) {
        if (!(frame->facing[i] & DP_FACING_NO_AREA)) continue;
        frame->any_without_area = true;
        adopt_facing(frame, i);
    }
    dp_parallel(frame->threads, blocks, outline_block, frame);
}
