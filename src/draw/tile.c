/* The stages of one tile, in order: faces, surface and lines; or the papers as printed. */
#include "draw/tile.h"

#include "printed/fins.h"

/* Pieces of lines, for strokes. */
static void find_pieces(dp_finder *f) {
    const size_t first = f->found->piece_count;
    if (f->tile.frame->adjacency)
        dp_find_adjacent_edges(f);
    else
        dp_find_edges(f);
    dp_find_emergent(f);
    dp_find_intersections(f);
    dp_find_marked(f);
    dp_find_visible(f);
    if (f->tile.frame->hidden) dp_find_hidden(f, first);
}

/* Silhouettes and borders as geometry; what has no outside, as strokes. */
static void find_fins(dp_finder *f, dp_printer *printer) {
    if (f->tile.frame->styles[0].passes == 1)
        dp_printed_fins_one_pass(printer);
    else
        dp_printed_fins_two_passes(printer);
    if (!f->tile.failed && f->tile.frame->lines & ~DP_OUTLINES) find_pieces(f);
}

static void find_lines(dp_finder *f, dp_printer *printer) {
    dp_tile_faces(&f->tile);
    dp_tile_surface(&f->tile);
    if (!f->tile.frame->lines) return;
    if (f->tile.frame->styles[0].ink == DP_INK_QUADS && !f->tile.frame->adjacency)
        dp_tile_quads(printer);
    else
        find_pieces(f);
}

void dp_draw_tile(dp_finder *f, dp_printer *printer, uint32_t index) {
    const dp_frame *const frame = f->tile.frame;
    const size_t first = f->found->piece_count;
    dp_finder_open(f, index);
    printer->tile = &f->tile;
    dp_tile_pieces *const out = &frame->tile_pieces[index];
    out->first = first;
    out->count = 0;
    out->empty = dp_bins_tile_count(&frame->polygon_bins, index) == 0 &&
                 (!frame->polygons.mark_count || dp_bins_tile_count(&frame->mark_bins, index) == 0);
    if (out->empty) {
        dp_tile_empty_surface(&f->tile);
        return;
    }
    for (size_t i = 0; i < frame->tile_samples; i++) f->tile.depth[i] = DP_DEPTH_EMPTY;
    dp_tile_assemble(&f->tile);
    if (frame->lines && dp_draws_fins(frame))
        find_fins(f, printer);
    else
        find_lines(f, printer);
    out->count = f->found->piece_count - first;
}
