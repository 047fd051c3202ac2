/* Edges that are lines by themselves: outlines of sections and their hatching (dp_edge_kind).
 *
 *    bin      each edge's tiles, from its spine's box; of long ones those that it passes
 *    find     an edge of the tile becomes a candidate of the class that its flag names
 *
 * No polygon beside it is asked, so nothing disputes it and no fold is measured; what hides it is
 * found as for every line (visibility.c). Sample points are lifted towards the eye along the line of
 * sight, as the surface that an edge lies on is not known. Invariant: a mark is in the bin of each
 * tile that owns a sample point of it. */
#include "find/finder.h"

static const double MARGIN = 0.75; /* px, as that of polygons */

static bool spine_of(const dp_frame *frame, dp_marked_edge mark, dp_spine *spine) {
    const dp_polygons *const polygons = &frame->polygons;
    const uint32_t first = dp_first_corner(polygons, mark.polygon),
                   n = dp_corner_count(polygons, mark.polygon);
    const uint32_t va = dp_corner_vertex(polygons, first + mark.edge),
                   vb = dp_corner_vertex(polygons, first + (mark.edge + 1) % n);
    if (va >= polygons->vertex_count || vb >= polygons->vertex_count ||
        !dp_spine_ends(&frame->view, dp_v3f(dp_vertex_position(polygons, va)),
                       dp_v3f(dp_vertex_position(polygons, vb)), spine))
        return false;
    spine->probe_a = spine->a, spine->probe_b = spine->b;
    spine->probe_a.d += dp_depth_step(&frame->view, spine->a.d, DP_PROBE_LIFT);
    spine->probe_b.d += dp_depth_step(&frame->view, spine->b.d, DP_PROBE_LIFT);
    return true;
}

/* ------- bins ------- */

static int16_t tile_of(double px) { return (int16_t)floor(px / DP_TILE); }

static dp_tile_rect rect_of(const dp_spine *s) {
    return (dp_tile_rect){tile_of(dp_min(s->a.x, s->b.x) - MARGIN),
                          tile_of(dp_min(s->a.y, s->b.y) - MARGIN),
                          (int16_t)(tile_of(dp_max(s->a.x, s->b.x) + MARGIN) + 1),
                          (int16_t)(tile_of(dp_max(s->a.y, s->b.y) + MARGIN) + 1),
                          0,
                          0};
}

static void place(void *arg, uint32_t first, uint32_t count, dp_tile_rect *rects, uint32_t worker) {
    const dp_frame *const frame = arg;
    (void)worker;
    for (uint32_t i = 0; i < count; i++) {
        dp_spine s;
        const bool is_seen = spine_of(frame, frame->polygons.marks[first + i], &s);
        rects[i] = is_seen ? rect_of(&s) : (dp_tile_rect){0};
    }
}

static bool touches(void *arg, uint32_t index, int32_t tile_x, int32_t tile_y, uint32_t worker) {
    const dp_frame *const frame = arg;
    dp_spine s;
    uint32_t k0, k1;
    (void)worker;
    return spine_of(frame, frame->polygons.marks[index], &s) &&
           dp_spine_range(&s, (double)tile_x * DP_TILE, (double)tile_y * DP_TILE, MARGIN, &k0, &k1);
}

bool dp_bin_marks(dp_frame *f) {
    const uint32_t count = f->lines & (DP_SECTION | DP_HATCHING) ? f->polygons.mark_count : 0;
    f->polygons.mark_count = count;
    return !count || dp_bins_fill(&f->mark_bins, count, f->tiles_x, f->tiles_y, place, touches, f,
                                  f->threads, f->memory);
}

/* ------- lines ------- */

static void add(dp_finder *w, dp_marked_edge mark) {
    const dp_frame *const f = w->tile.frame;
    const dp_polygons *const polygons = &f->polygons;
    const uint8_t flag = polygons->edge_flags[dp_first_corner(polygons, mark.polygon) + mark.edge];
    const dp_line line = flag == DP_EDGE_SECTION ? DP_LINE_SECTION : DP_LINE_HATCHING;
    dp_spine spine;
    if (w->finds_hidden && line == DP_LINE_HATCHING) return; /* it belongs to what is seen */
    if (!(dp_polygon_style(f, mark.polygon)->lines >> line & 1) || !spine_of(f, mark, &spine))
        return;
    const dp_candidate candidate = {
        .a = mark.polygon, .b = UINT32_MAX, .edge = mark.edge, .k1 = UINT32_MAX, .line = line & 63};
    dp_add_candidate(w, candidate, &spine, NULL);
}

void dp_find_marked(dp_finder *w) {
    const dp_frame *const f = w->tile.frame;
    const dp_bins *const bins = &f->mark_bins;
    const uint32_t tile = w->tile.index;
    for (uint32_t c = 0; f->polygons.mark_count && c < bins->chunk_count; c++) {
        const dp_bin_chunk *const chunk = &bins->chunks[c];
        for (uint32_t i = chunk->offsets[tile]; i < chunk->offsets[tile + 1]; i++)
            if (!w->tile.failed) add(w, f->polygons.marks[chunk->entries[i] & ~DP_BIN_TAG]);
    }
}
