/* Finding a tile's surface and lines: faces, edges, visibility, in that order. */
#include "raster/kernels.h"
#include "core/facing.h"
#include "printed/fringe.h"
#include "raster/tile.h"

#include <string.h>

bool dp_tile_worker_init(dp_tile_worker *worker, const dp_frame *frame) {
    worker->frame = frame;
    worker->memory = *frame->memory;
    worker->failed = false;
    worker->stats = (dp_stats){0};
    worker->piece_count = worker->bone_count = 0;
    worker->away = NULL;
    worker->owners = NULL;
    worker->watching = frame->lines & DP_INTERSECTION && frame->styles[0].ink == DP_INK_STROKES;
    worker->finds_edges =
        frame->lines & ~DP_INTERSECTION && frame->styles[0].ink == DP_INK_STROKES &&
        !frame->styles[0].edge_table_off && frame->styles[0].edges != DP_EDGES_ADJACENCY;
    dp_sampling_init(&worker->sampling, frame->target.samples);
    dp_block_init(&worker->block, frame->target.samples);
    return dp_reserve(&worker->memory, &worker->winner, &worker->winner_cap, frame->tile_samples,
                      sizeof *worker->winner);
}

void dp_tile_worker_free(dp_tile_worker *worker) {
    const dp_allocator memory = worker->memory;
    if (!memory.free) return; /* never used */
    dp_free(&memory, worker->winner);
    dp_free(&memory, worker->ids);
    dp_free(&memory, worker->backs);
    dp_free(&memory, worker->polygons);
    dp_free(&memory, worker->normals);
    dp_free(&memory, worker->points);
    dp_free(&memory, worker->seen);
    dp_free(&memory, worker->seen_words);
    dp_free(&memory, worker->keys);
    dp_free(&memory, worker->unsure);
    dp_free(&memory, worker->umbrellas);
    dp_free(&memory, worker->edge_marks);
    dp_free(&memory, worker->pair_first);
    dp_free(&memory, worker->pair_second);
    dp_free(&memory, worker->edges.polygon);
    dp_free(&memory, worker->edges.edge);
    dp_free(&memory, worker->edges.from);
    dp_free(&memory, worker->edges.name);
    dp_free(&memory, worker->slot_meetings);
    dp_free(&memory, worker->meetings);
    dp_free(&memory, worker->edge_slots);
    dp_free(&memory, worker->loose);
    dp_free(&memory, worker->lookups);
    dp_free(&memory, worker->crowd.polygon);
    dp_free(&memory, worker->crowd.members);
    dp_free(&memory, worker->crowd.keys);
    dp_free(&memory, worker->crowd.met);
    dp_free(&memory, worker->crowd.listed);
    dp_free(&memory, worker->candidates);
    dp_free(&memory, worker->probes.x);
    dp_free(&memory, worker->probes.y);
    dp_free(&memory, worker->probes.limit);
    dp_free(&memory, worker->groups.group);
    dp_free(&memory, worker->groups.box);
    dp_free(&memory, worker->groups.limit);
    dp_free(&memory, worker->pieces);
    dp_free(&memory, worker->bones);
    dp_free(&memory, worker->ink);
    dp_free(&memory, worker->ink_depth);
    dp_free(&memory, worker->stencil);
    dp_free(&memory, worker->world);
    dp_free(&memory, worker->clip);
    dp_free(&memory, worker->screen_edges);
    dp_outline_scratch_free(&worker->scratch, &memory);
}

uint64_t dp_tile_worker_bytes(const dp_tile_worker *w) {
    return sizeof *w + w->winner_cap * sizeof *w->winner +
           (w->ids_cap + w->backs_cap) * sizeof *w->ids + w->normals_cap * sizeof *w->normals +
           w->polygons_cap * sizeof *w->polygons + w->points_cap * sizeof *w->points +
           w->edge_marks_cap + w->meetings_cap * sizeof *w->meetings +
           w->umbrellas_cap * sizeof *w->umbrellas +
           (w->unsure_cap + w->pair_first_cap + w->pair_second_cap) * 4 +
           (w->edges.polygon_cap + w->edges.edge_cap + w->edges.from_cap + w->edges.name_cap) * 4 +
           w->slots_cap * sizeof *w->edge_slots + w->slot_meetings_cap * sizeof *w->slot_meetings +
           (w->crowd.polygon_cap + w->crowd.members_cap + w->crowd.keys_cap + w->crowd.met_cap +
            w->crowd.listed_cap) *
               4 +
           (w->seen_cap + w->seen_words_cap + w->keys_cap) * 4 +
           w->candidates_cap * sizeof *w->candidates +
           (w->probe_x_cap + w->probe_y_cap + w->probe_limit_cap + w->groups.box_cap +
            w->groups.limit_cap) *
               4 +
           w->groups.group_cap * sizeof *w->groups.group + w->pieces_cap * sizeof *w->pieces +
           w->bones_cap * sizeof *w->bones +
           w->ink_cap * (sizeof *w->ink + sizeof *w->ink_depth + sizeof *w->stencil);
}

/* With o, x and y what a ray through the tile's corner is and how it changes per px, and m the
 * normal n / (n·p) of a plane through p: d = m·ray in perspective, so d0 = m·o, dx = m·x, dy = m·y;
 * m follows by the dual basis. In orthographic views the same holds of what one step of d is, and
 * -1. m points away from the eye, front faces' normals towards it. */
static void find_plane_normal(dp_tile_worker *w) {
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

void dp_tile_open(dp_tile_worker *w, uint32_t tile) {
    w->tile = tile;
    w->tile_x = tile % w->frame->tiles_x * DP_TILE;
    w->tile_y = tile / w->frame->tiles_x * DP_TILE;
    w->depth = w->frame->depth + (size_t)tile * w->frame->tile_samples;
    memset(w->winner, 0xff, w->frame->tile_samples * sizeof *w->winner);
    memset(w->suspects, 0, sizeof w->suspects);
    if (w->finds_edges) find_plane_normal(w);
    w->close.count = w->candidate_count = w->probe_count = w->loose_count = 0;
}

/* Visible pieces of lines, for strokes. */
static void find_pieces(dp_tile_worker *w) {
    if (w->frame->adjacency)
        dp_tile_adjacent_edges(w);
    else
        dp_tile_edges(w);
    dp_tile_emerge(w);
    dp_tile_intersections(w);
    dp_tile_probe(w);
}

/* Silhouettes and borders as geometry; what has no outside, as strokes. */
static void find_fringes(dp_tile_worker *w) {
    if (w->frame->styles[0].passes == 1)
        dp_tile_fringe_one_pass(w);
    else
        dp_tile_fringe_two_passes(w);
    if (!w->failed && w->frame->lines & ~DP_OUTLINES) find_pieces(w);
}

static void find_lines(dp_tile_worker *w) {
    dp_tile_faces(w);
    dp_tile_surface(w);
    if (!w->frame->lines) return;
    if (w->frame->styles[0].ink == DP_INK_QUADS && !w->frame->adjacency)
        dp_tile_quads(w);
    else
        find_pieces(w);
}

void dp_tile_find(dp_tile_worker *w, uint32_t tile) {
    const size_t first = w->piece_count;
    dp_tile_open(w, tile);
    dp_tile_pieces *const out = &w->frame->tile_pieces[tile];
    out->first = first;
    out->count = 0;
    out->bare = dp_bins_tile_count(&w->frame->polygon_bins, tile) == 0;
    if (out->bare) {
        dp_tile_bare_surface(w);
        return;
    }
    for (size_t i = 0; i < w->frame->tile_samples; i++) w->depth[i] = DP_DEPTH_EMPTY;
    dp_tile_assemble(w);
    if (w->frame->lines && dp_is_fringed(w->frame))
        find_fringes(w);
    else
        find_lines(w);
    out->count = w->piece_count - first;
}
