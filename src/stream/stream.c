/* Drawing a source that does not fit into memory.
 *
 *     first reading    chunks -> faces into the picture's depth; triangles with an edge that may be
 *                        a line are kept
 *     more readings    only where the order of triangles makes too many edges wait: a share each
 *     in between       the triangles kept are a small mesh; its lines are candidates with sample
 *                        points
 *     second reading   chunks -> triangles over sample points hide them
 *     afterwards       segments and ink, as from memory
 *
 * With one reading, the picture's depth samples hide sample points instead (samples.c).
 *
 * Memory: that of the picture (depth, surface, sample points on lines), one part of the source, and
 * the pending triangles; the last two are bounded, however long the source. */
#include "stream/draw.h"

#include "base/diag.h"

#include <string.h>

/* Bytes that are spent on
 *     GATHERED      a triangle drawn from memory: positions, vertices, bins
 *     PER_CHUNK     a chunk of a part: its output, the list, the list drawn in the largest tile of
 *                     each of two workers
 *     PER_PENDING   a pending triangle: itself, its share of mesh, table and lines */
enum {
    GATHERED = 132,
    PER_CHUNK = 2 << 20,
    PER_PENDING = 160,
    CHUNKS_LEAST = DP_TUNED(1, 2),
    CHUNKS_MOST = DP_TUNED(64, 2),
    PENDING_LEAST = 65536, /* triangles */
    PENDING_MOST = 1 << 28 /* triangles: slots, 2 per edge, a power of two, fit 32 bits */
};

bool dp_stream_is_large(const dp_source *source, size_t memory) {
    return dp_input_known(source) > memory / GATHERED;
}

static const dp_array arrays[] = {
    DP_ARRAY(dp_stream_draw, workers, workers_cap),
    DP_ARRAY(dp_stream_draw, outputs, outputs_cap),
    DP_ARRAY(dp_stream_draw, corners, corners_cap),
    DP_ARRAY(dp_stream_draw, numbers, numbers_cap),
    DP_ARRAY(dp_stream_draw, positions, positions_cap),
    DP_ARRAY(dp_stream_draw, edge_flags, flags_cap),
    DP_ARRAY(dp_stream_draw, polygon_numbers, polygon_numbers_cap),
    DP_ARRAY(dp_stream_draw, source_polygons, source_cap),
    DP_ARRAY(dp_stream_draw, intersecting, intersecting_cap),
    DP_ARRAY(dp_stream_draw, away, away_cap),
    DP_ARRAY(dp_stream_draw, candidate_pixels, candidate_pixels_cap),
    DP_ARRAY(dp_stream_draw, flagged, flagged_cap),
    DP_ARRAY(dp_stream_draw, intersecting_counts, intersecting_counts_cap),
    DP_ARRAY(dp_stream_draw, farthest, farthest_cap),
    DP_ARRAY(dp_stream_draw, wanted, wanted_cap),
    DP_ARRAY(dp_stream_draw, lines, lines_cap),
    DP_ARRAY(dp_stream_draw, view.maps.words, view.maps.words_cap)};

void dp_stream_free(dp_stream_draw *s) {
    if (!s) return;
    const dp_allocator *const memory = s->memory;
    dp_input_close(&s->input);
    dp_pending_free(&s->pending);
    dp_fan_table_free(&s->fans, memory);
    for (size_t i = 0; i < s->workers_cap; i++) dp_stream_worker_free(&s->workers[i], memory);
    for (size_t i = 0; i < s->outputs_cap; i++) dp_chunk_output_free(&s->outputs[i], memory);
    for (size_t i = 0; i < s->lines_cap; i++) dp_tile_lines_free(&s->lines[i], memory);
    dp_arrays_free(memory, s, DP_ARRAYS(arrays));
    dp_free(memory, s);
}

uint64_t dp_stream_bytes(const dp_stream_draw *s) {
    if (!s) return 0;
    uint64_t sum = sizeof *s + dp_input_bytes(&s->input) + dp_pending_bytes(&s->pending) +
                   dp_fan_table_bytes(&s->fans) + dp_arrays_bytes(s, DP_ARRAYS(arrays));
    for (size_t i = 0; i < s->workers_cap; i++) sum += dp_stream_worker_bytes(&s->workers[i]);
    for (size_t i = 0; i < s->outputs_cap; i++) sum += dp_chunk_output_bytes(&s->outputs[i]);
    for (size_t i = 0; i < s->lines_cap; i++) sum += s->lines[i].size;
    return sum;
}

static bool make_workers(dp_stream_draw *s) {
    if (!dp_reserve_zeroed(s->memory, &s->workers, &s->workers_cap, s->worker_count,
                           sizeof *s->workers))
        return false;
    for (uint32_t i = 0; i < s->worker_count; i++)
        if (!dp_stream_worker_init(&s->workers[i], &s->input, s->memory)) return false;
    return true;
}

static bool make_outputs(dp_stream_draw *s) {
    const size_t triangles = (size_t)s->chunks * DP_CHUNK;
    if (!dp_reserve_zeroed(s->memory, &s->outputs, &s->outputs_cap, s->chunks, sizeof *s->outputs))
        return false;
    for (uint32_t i = 0; i < s->chunks; i++)
        if (!dp_chunk_output_init(&s->outputs[i], s->memory)) return false;
    return dp_reserve(s->memory, &s->corners, &s->corners_cap, triangles, sizeof *s->corners) &&
           dp_reserve(s->memory, &s->numbers, &s->numbers_cap, triangles, sizeof *s->numbers);
}

/* An array of `need` zeros. */
#define ZEROED(s, array, cap, need)                                                                \
    dp_reserve_zeroed((s)->memory, &(s)->array, &(s)->cap, (need), sizeof *(s)->array)

/* What lasts as long as the picture: nothing is covered yet. */
static bool make_picture(dp_stream_draw *s) {
    const dp_frame *const f = s->frame;
    const size_t tiles = (size_t)f->tiles_x * f->tiles_y, blocks = tiles * DP_BLOCKS * DP_BLOCKS;
    if (!dp_reserve(s->memory, &s->farthest, &s->farthest_cap, blocks, sizeof *s->farthest) ||
        !ZEROED(s, wanted, wanted_cap, tiles * DP_TILE) || !ZEROED(s, lines, lines_cap, tiles) ||
        !ZEROED(s, flagged, flagged_cap, tiles * DP_TILE) ||
        !ZEROED(s, candidate_pixels, candidate_pixels_cap, tiles) ||
        !ZEROED(s, away, away_cap, tiles * f->tile_samples / 64) ||
        !ZEROED(s, intersecting_counts, intersecting_counts_cap, tiles * DP_TILE * DP_TILE))
        return false;
    for (size_t i = 0; i < blocks; i++) s->farthest[i] = DP_DEPTH_EMPTY;
    for (size_t i = 0; i < tiles * f->tile_samples; i++) f->depth[i] = DP_DEPTH_EMPTY;
    if (f->target.normal)
        memset(f->target.normal, 0, 3 * sizeof(float) * f->target.width * f->target.height);
    return true;
}

static dp_result open_stream(dp_stream_draw *s, dp_source *source, dp_diag *diag) {
    const dp_frame *const f = s->frame;
    const size_t limit = s->setup.limit, chunks = limit / 2 / PER_CHUNK;
    s->chunks = chunks < CHUNKS_LEAST  ? CHUNKS_LEAST
                : chunks > CHUNKS_MOST ? CHUNKS_MOST
                                       : (uint32_t)chunks;
    const dp_result result = dp_input_open(&s->input, source, s->chunks, s->memory, s->stats, diag);
    if (result) return result;
    s->view = (dp_chunk_view){.view = &f->view,
                              .kernels = dp_stream_kernels_for(f->lanes),
                              .tiles_x = f->tiles_x,
                              .tiles_y = f->tiles_y,
                              .flat_cosine = f->flat_cosine};
    if (!(f->lines & (DP_RIDGE | DP_VALLEY))) s->view.flat_cosine = -1;
    dp_sampling_init(&s->view.sampling, f->target.samples);
    s->pending = (dp_pending){.memory = s->memory, .view = &s->view, .shares = 1};
    const size_t parts = (size_t)s->chunks * PER_CHUNK;
    s->pending.limit = (limit > parts ? limit - parts : 0) / PER_PENDING;
    if (s->pending.limit < PENDING_LEAST) s->pending.limit = PENDING_LEAST;
    if (s->pending.limit > PENDING_MOST) s->pending.limit = PENDING_MOST;
    s->intersecting_limit = s->pending.limit / 2;
    if (!make_workers(s) || !make_outputs(s) || !make_picture(s))
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a part of the model");
    s->view.farthest = s->farthest;
    return DP_OK;
}

static void add_stats(dp_stream_draw *s) {
    dp_stats *const sum = s->stats;
    for (uint32_t i = 0; i < s->worker_count; i++) {
        sum->dropped_finite += s->workers[i].stats.dropped_finite;
        sum->dropped_area += s->workers[i].stats.dropped_area;
        sum->clipped += s->bin_workers[i].stats.clipped;
    }
}

/* Reads again for edges that were put off, until none is left. */
static dp_result read_edges(dp_stream_draw *s, bool may, double *done, dp_diag *diag) {
    bool enough;
    while (dp_pending_next_share(&s->pending, &enough)) {
        if (!may) {
            s->pending.lost += s->pending.later_count + 1; /* not known how many */
            return DP_OK;
        }
        const double to = *done + (DP_STREAMED - *done) / (s->pending.later_count + 2);
        const dp_result result = dp_stream_read(s, DP_READ_EDGES, *done, to, diag);
        if (result) return result;
        *done = to;
    }
    return enough ? DP_OK : dp_fail(diag, DP_ERR_MEMORY, "out of memory for the lines");
}

/* The first reading, and more where edges were put off. */
static dp_result read_model(dp_stream_draw *s, dp_source *source, dp_diag *diag) {
    const dp_frame *const f = s->frame;
    s->read_again = f->lines && f->styles[0].passes != 1 && dp_source_rewindable(source);
    s->done = s->read_again ? 0.6 : DP_STREAMED;
    dp_result result = open_stream(s, source, diag);
    if (!result) result = dp_stream_read(s, DP_READ_FACES, 0, s->done, diag);
    if (!result) add_stats(s);
    if (!result && f->lines) result = read_edges(s, s->read_again, &s->done, diag);
    s->stats->edges_lost = s->pending.lost + s->pending.thinned;
    s->thinned = s->pending.thinned > 0;
    s->waited_in_vain = s->pending.lost > 0;
    return result;
}

dp_result dp_stream_read_model(const dp_stream_setup *setup, dp_source *source,
                               dp_stream_draw **stream, dp_diag *diag) {
    dp_stream_draw *const s = dp_alloc_zeroed(setup->frame->memory, sizeof *s);
    *stream = s;
    if (!s) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a streamed drawing");
    s->setup = *setup;
    s->frame = setup->frame;
    s->finders = setup->finders;
    s->bin_workers = setup->bin_workers;
    s->stats = setup->stats;
    s->worker_count = setup->workers;
    s->memory = setup->frame->memory;
    return read_model(s, source, diag);
}

/* From now on chunks are classified by the pixels that the second reading looks at. */
static bool want_pixels(dp_stream_draw *s) {
    dp_chunk_view *const v = &s->view;
    v->wanted = s->wanted;
    v->flagged = s->flagged;
    v->maps.row = (v->tiles_x * DP_TILE + 15) / 16;
    v->maps.map = v->tiles_y * DP_TILE * v->maps.row;
    if (!dp_reserve(s->memory, &v->maps.words, &v->maps.words_cap, 4 * (size_t)v->maps.map,
                    sizeof *v->maps.words))
        return false;
    dp_pixel_maps_fill(v);
    return true;
}

dp_result dp_stream_find(dp_stream_draw *s, dp_diag *diag) {
    const bool lines = s->frame->lines;
    if (!dp_stream_find_lines(s) || !dp_stream_choose_flagged(s))
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for the lines");
    if (s->read_again && !want_pixels(s))
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for the second reading");
    const dp_result result =
        s->read_again ? dp_stream_read(s, DP_READ_HIDERS, s->done, DP_STREAMED, diag) : DP_OK;
    if (result) return result;
    if (lines && (!dp_stream_find_crossings(s) || !dp_stream_collect(s)))
        return dp_fail(diag, DP_ERR_MEMORY, "out of memory for the lines");
    return DP_OK;
}
