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
#include "mesh/source.h"

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
    return source->records.read && source->records.count > memory / GATHERED;
}

void dp_stream_free(dp_stream_draw *s) {
    if (!s) return;
    const dp_allocator *const memory = s->memory;
    const dp_frame *const f = s->frame;
    dp_input_close(&s->input);
    for (uint32_t i = 0; s->workers && i < s->worker_count; i++) {
        dp_free(memory, s->workers[i].chunk);
        dp_free(memory, s->workers[i].buffer);
        dp_free(memory, s->workers[i].intersecting);
        dp_free(memory, s->workers[i].depth);
        dp_free(memory, s->workers[i].partners);
        dp_free(memory, s->workers[i].owners);
    }
    for (uint32_t i = 0; s->outputs && i < s->chunks; i++) {
        dp_free(memory, s->outputs[i].corners);
        dp_free(memory, s->outputs[i].numbers);
        dp_free(memory, s->outputs[i].pending);
        dp_free(memory, s->outputs[i].pixels);
    }
    for (uint32_t i = 0; s->lines && i < f->tiles_x * f->tiles_y; i++)
        dp_free(memory, s->lines[i].candidates);
    dp_pending_free(&s->pending);
    void *const blocks[] = {s->workers,
                            s->outputs,
                            s->corners,
                            s->numbers,
                            s->positions,
                            s->edge_flags,
                            s->polygon_numbers,
                            s->source_polygons,
                            s->intersecting,
                            s->away,
                            s->candidate_pixels,
                            s->flagged,
                            s->intersecting_counts,
                            s->fans,
                            s->fan_slots,
                            s->fan_filter,
                            s->farthest,
                            s->wanted,
                            s->view.maps.words,
                            s->lines};
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) dp_free(memory, blocks[i]);
    dp_free(memory, s);
}

static bool make_workers(dp_stream_draw *s) {
    s->workers = dp_alloc_zeroed(s->memory, s->worker_count * sizeof *s->workers);
    for (uint32_t i = 0; s->workers && i < s->worker_count; i++) {
        s->workers[i].chunk = dp_alloc(s->memory, sizeof *s->workers[i].chunk);
        s->workers[i].buffer = dp_alloc(s->memory, dp_input_buffer_size(&s->input));
        if (!s->workers[i].chunk || !s->workers[i].buffer) return false;
    }
    return s->workers;
}

static bool make_outputs(dp_stream_draw *s) {
    s->outputs = dp_alloc_zeroed(s->memory, s->chunks * sizeof *s->outputs);
    for (uint32_t i = 0; s->outputs && i < s->chunks; i++) {
        dp_chunk_output *const output = &s->outputs[i];
        output->corners = dp_alloc_array(s->memory, DP_CHUNK, sizeof *output->corners);
        output->numbers = dp_alloc_array(s->memory, DP_CHUNK, sizeof *output->numbers);
        output->pending = dp_alloc_array(s->memory, DP_CHUNK, sizeof *output->pending);
        output->pixels = dp_alloc_array(s->memory, DP_CHUNK, sizeof *output->pixels);
        if (!output->corners || !output->numbers || !output->pending || !output->pixels)
            return false;
    }
    s->corners = dp_alloc_array(s->memory, (size_t)s->chunks * DP_CHUNK, sizeof *s->corners);
    s->numbers = dp_alloc_array(s->memory, (size_t)s->chunks * DP_CHUNK, sizeof *s->numbers);
    return s->outputs && s->corners && s->numbers;
}

/* Makes what lasts as long as the picture, with nothing covered yet. */
static bool make_picture(dp_stream_draw *s) {
    const dp_frame *const f = s->frame;
    const size_t tiles = (size_t)f->tiles_x * f->tiles_y, blocks = tiles * DP_BLOCKS * DP_BLOCKS;
    s->farthest = dp_alloc_array(s->memory, blocks, sizeof *s->farthest);
    s->wanted = dp_alloc_zeroed(s->memory, dp_times(tiles * DP_TILE, sizeof *s->wanted));
    s->lines = dp_alloc_zeroed(s->memory, dp_times(tiles, sizeof *s->lines));
    if (!s->farthest || !s->wanted || !s->lines) return false;
    s->flagged = dp_alloc_zeroed(s->memory, dp_times(tiles * DP_TILE, sizeof *s->flagged));
    s->candidate_pixels = dp_alloc_zeroed(s->memory, dp_times(tiles, sizeof *s->candidate_pixels));
    s->away = dp_alloc_zeroed(s->memory, tiles * f->tile_samples / 8);
    s->intersecting_counts = dp_alloc_zeroed(s->memory, tiles * DP_TILE * DP_TILE);
    if (!s->flagged || !s->candidate_pixels || !s->away || !s->intersecting_counts) return false;
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
    v->maps.words = dp_alloc_array(s->memory, 4 * (size_t)v->maps.map, sizeof *v->maps.words);
    if (v->maps.words) dp_pixel_maps_fill(v);
    return v->maps.words;
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
