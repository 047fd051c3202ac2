/* One reading of the source.
 *
 *     for each part:
 *         in parallel   first task: edges of the last part's pending triangles meet (pending.c)
 *                       the others: classify a chunk -> covering and pending triangles
 *         in order      covering triangles -> the list; when it is full, it is drawn (tiles.c)
 *                       pending triangles  -> stream->pending
 *                       flagged triangles  -> stream->intersecting (second reading)
 *
 * Most triangles end in their chunk. Order is that of the stream, whichever thread classified which
 * chunk.
 *
 * Invariant: a chunk's output does not depend on the edges that meet meanwhile. The share of edges
 * that is followed is fixed when the part begins; edges that are put off after that are dropped
 * when they would meet. */
#include "stream/draw.h"

#include "base/diag.h"

#include <string.h>

/* ------- memory ------- */

static const dp_array output_arrays[] = {DP_ARRAY(dp_chunk_output, corners, corners_cap),
                                         DP_ARRAY(dp_chunk_output, numbers, numbers_cap),
                                         DP_ARRAY(dp_chunk_output, pending, pending_cap),
                                         DP_ARRAY(dp_chunk_output, pixels, pixels_cap)};

bool dp_chunk_output_init(dp_chunk_output *o, const dp_allocator *memory) {
    return dp_reserve(memory, &o->corners, &o->corners_cap, DP_CHUNK, sizeof *o->corners) &&
           dp_reserve(memory, &o->numbers, &o->numbers_cap, DP_CHUNK, sizeof *o->numbers) &&
           dp_reserve(memory, &o->pending, &o->pending_cap, DP_CHUNK, sizeof *o->pending) &&
           dp_reserve(memory, &o->pixels, &o->pixels_cap, DP_CHUNK, sizeof *o->pixels);
}

void dp_chunk_output_free(dp_chunk_output *output, const dp_allocator *memory) {
    dp_arrays_free(memory, output, DP_ARRAYS(output_arrays));
}

uint64_t dp_chunk_output_bytes(const dp_chunk_output *output) {
    return dp_arrays_bytes(output, DP_ARRAYS(output_arrays));
}

static const dp_array worker_arrays[] = {DP_ARRAY(dp_stream_worker, buffer, buffer_cap),
                                         DP_ARRAY(dp_stream_worker, intersecting, intersecting_cap),
                                         DP_ARRAY(dp_stream_worker, partners, partners_cap),
                                         DP_ARRAY(dp_stream_worker, depth, depth_cap),
                                         DP_ARRAY(dp_stream_worker, owners, owners_cap)};

bool dp_stream_worker_init(dp_stream_worker *worker, const dp_input *input,
                           const dp_allocator *memory) {
    worker->chunk = dp_alloc(memory, sizeof *worker->chunk);
    return worker->chunk &&
           dp_reserve(memory, &worker->buffer, &worker->buffer_cap, dp_input_buffer_size(input), 1);
}

void dp_stream_worker_free(dp_stream_worker *worker, const dp_allocator *memory) {
    dp_free(memory, worker->chunk);
    worker->chunk = NULL;
    dp_arrays_free(memory, worker, DP_ARRAYS(worker_arrays));
}

uint64_t dp_stream_worker_bytes(const dp_stream_worker *worker) {
    return (worker->chunk ? sizeof *worker->chunk : 0) +
           dp_arrays_bytes(worker, DP_ARRAYS(worker_arrays));
}

/* ------- readings ------- */

typedef struct job {
    dp_stream_draw *stream;
    dp_reading reading;
    dp_pending_share share; /* of edges that are followed */
    bool joins;             /* the first task joins the last part's edges */
    bool failed;            /* that task is out of memory */
} job;

/* Lists the triangles whose state has one of the flags. Writes every triangle and advances for
 * those listed: a branch could not be predicted. */
static uint32_t list_triangles(dp_chunk *chunk, const uint8_t *states, uint8_t flags) {
    uint32_t count = 0;
    for (uint32_t t = 0; t < chunk->count; t++) {
        chunk->listed[count] = (uint16_t)t;
        count += (states[t] & flags) != 0;
    }
    return count;
}

static void leave_covering(dp_chunk *chunk, uint32_t number, const dp_triangles *triangles,
                           dp_chunk_output *output) {
    output->covering = list_triangles(chunk, chunk->state, DP_TRIANGLE_COVERS);
    for (uint32_t i = 0; i < output->covering; i++) {
        const uint32_t t = chunk->listed[i];
        memcpy(output->corners[i], triangles->corners + t * triangles->stride,
               sizeof *output->corners);
        output->numbers[i] = number + t;
    }
}

static void leave_pending(dp_chunk *chunk, uint32_t number, const dp_triangles *triangles,
                          const dp_input *input, dp_pending_share share, dp_chunk_output *output) {
    uint32_t left = 0;
    for (uint32_t t = 0; t < chunk->count; t++) {
        chunk->listed[left] = (uint16_t)t;
        left += (chunk->lines[t] | chunk->alone[t]) != 0;
    }
    output->pending_count = 0;
    for (uint32_t l = 0; l < left; l++) {
        const uint32_t t = chunk->listed[l];
        dp_pending_triangle *const k = &output->pending[output->pending_count];
        dp_triangle_corners(triangles, t, k->corners);
        for (int i = 0; i < 3; i++) {
            const bool line = chunk->lines[t] >> i & 1, alone = chunk->alone[t] >> i & 1;
            k->edges[i] = line ? DP_EDGE_LINE : alone ? DP_EDGE_ALONE : DP_EDGE_PLAIN;
        }
        for (uint32_t i = 0; i < 3; i++)
            if (k->edges[i] == DP_EDGE_ALONE && !dp_pending_follows(share, k, i))
                k->edges[i] = DP_EDGE_PLAIN;
        output->pending_count += (k->edges[0] | k->edges[1] | k->edges[2]) != 0;
        k->number = number + t;
        k->polygon = dp_input_polygon(input, number + t);
        k->unused = 0;
    }
}

static void leave_flagged(const dp_stream_draw *stream, dp_chunk *chunk, uint32_t number,
                          const dp_triangles *triangles, dp_chunk_output *output) {
    output->pending_count = list_triangles(chunk, chunk->state, DP_TRIANGLE_FLAGGED);
    for (uint32_t i = 0; i < output->pending_count; i++) {
        const uint32_t t = chunk->listed[i];
        float corners[9];
        dp_triangle_corners(triangles, t, corners);
        output->pixels[i] = dp_chunk_pixel(corners, &stream->view);
        dp_pending_triangle *const k = &output->pending[i];
        *k = (dp_pending_triangle){.number = number + t,
                                   .polygon = dp_input_polygon(&stream->input, number + t)};
        memcpy(k->corners, triangles->corners + t * triangles->stride, sizeof k->corners);
    }
}

static void look_for_fans(const dp_stream_draw *stream, dp_chunk *chunk, uint32_t number,
                          const dp_triangles *triangles, dp_stream_worker *own) {
    const uint32_t count =
        stream->fans.count ? list_triangles(chunk, chunk->state, DP_TRIANGLE_COVERS) : 0;
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t e = 0, t = chunk->listed[i]; e < 3; e++) {
            if (!dp_stream_may_be_fan(stream, chunk->edge_key[e][t])) continue;
            if (triangles->flags && !(triangles->flags[t] >> e & 1)) continue;
            float corners[9];
            dp_triangle_corners(triangles, t, corners);
            dp_stream_look_for_fans(stream, corners + 3 * e, corners + 3 * ((e + 1) % 3),
                                    corners + 3 * ((e + 2) % 3), corners, number + t, own);
        }
}

static void classify_chunk(const job *j, uint32_t index, uint32_t worker) {
    dp_stream_draw *const s = j->stream;
    dp_stream_worker *const w = &s->workers[worker];
    dp_chunk_output *const output = &s->outputs[index];
    const uint32_t number = (uint32_t)s->input.first + index * DP_CHUNK;
    dp_triangles triangles;
    output->covering = output->pending_count = 0;
    output->result = dp_input_chunk(&s->input, index, w->buffer, &triangles, &output->diag);
    if (output->result) return;
    dp_chunk_classify(w->chunk, &triangles, &s->view, &w->stats);
    if (j->reading != DP_READ_EDGES) leave_covering(w->chunk, number, &triangles, output);
    if (j->reading == DP_READ_HIDERS) leave_flagged(s, w->chunk, number, &triangles, output);
    if (j->reading == DP_READ_HIDERS) look_for_fans(s, w->chunk, number, &triangles, w);
    if (j->reading == DP_READ_HIDERS || !s->frame->lines) return;
    dp_chunk_edges(w->chunk, &triangles, &s->view);
    /* the first reading has found the lines within the chunk */
    if (j->reading == DP_READ_EDGES) memset(w->chunk->lines, 0, w->chunk->count);
    leave_pending(w->chunk, number, &triangles, &s->input, j->share, output);
}

/* Joins the edges that came with the last part. */
static bool join_edges(dp_stream_draw *s) {
    const bool sound = s->pending.count == s->joined || dp_pending_join(&s->pending, s->joined);
    s->joined = s->pending.count;
    return sound;
}

static void do_task(void *arg, uint32_t index, uint32_t worker) {
    job *const j = arg;
    if (!j->joins)
        classify_chunk(j, index, worker);
    else if (index)
        classify_chunk(j, index - 1, worker);
    else
        j->failed = !join_edges(j->stream);
}

static void list_chunk(void *arg, uint32_t index, uint32_t worker) {
    dp_stream_draw *const s = arg;
    const dp_chunk_output *const output = &s->outputs[index];
    (void)worker;
    memcpy(s->corners + output->first, output->corners, output->covering * sizeof *s->corners);
    memcpy(s->numbers + output->first, output->numbers, output->covering * sizeof *s->numbers);
}

/* Draws the list. In the second reading, pixels without a visible sample point are wanted no
 * more. */
static bool draw_listed(dp_stream_draw *s, dp_reading reading) {
    if (reading != DP_READ_HIDERS) return dp_stream_draw_faces(s);
    if (!dp_stream_hide_probes(s)) return false;
    dp_pixel_maps_fill(&s->view);
    return true;
}

/* Adds the chunks' covering triangles to the list; draws the list first if it has no room. */
static bool list_covering(dp_stream_draw *s, uint32_t chunks, dp_reading reading) {
    uint32_t sum = 0;
    for (uint32_t i = 0; i < chunks; i++) sum += s->outputs[i].covering;
    if (sum > s->input.part - s->covering && !draw_listed(s, reading)) return false;
    for (uint32_t i = 0; i < chunks; i++) {
        s->outputs[i].first = s->covering;
        s->covering += s->outputs[i].covering;
    }
    dp_parallel(s->frame->threads, chunks, list_chunk, s);
    return true;
}

static void copy_pending(void *arg, uint32_t index, uint32_t worker) {
    dp_stream_draw *const s = arg;
    const dp_chunk_output *const output = &s->outputs[index];
    (void)worker;
    memcpy(s->pending.triangles + output->pending_first, output->pending,
           output->pending_count * sizeof *output->pending);
}

/* Adds the chunks' pending triangles. Their edges meet while the next part is classified. */
static bool add_pending(dp_stream_draw *s, uint32_t chunks) {
    dp_pending *const pending = &s->pending;
    size_t sum = pending->count;
    for (uint32_t i = 0; i < chunks; i++) {
        s->outputs[i].pending_first = sum;
        sum += s->outputs[i].pending_count;
    }
    if (sum == pending->count) return true;
    if (!dp_reserve(s->memory, &pending->triangles, &pending->cap, sum, sizeof *pending->triangles))
        return false;
    dp_parallel(s->frame->threads, chunks, copy_pending, s);
    pending->count = sum;
    return true;
}

/* Triangles per pixel: surfaces seen at a grazing angle put thousands into one, and a crossing
 * there cannot be seen. */
enum { INTERSECTING_MOST = 128 };

/* Adds the chunks' intersection candidates; beyond the limit they are given up. */
static bool add_intersecting(dp_stream_draw *s, uint32_t chunks) {
    for (uint32_t i = 0; i < chunks; i++) {
        const dp_chunk_output *const output = &s->outputs[i];
        if (!dp_reserve(s->memory, &s->intersecting, &s->intersecting_cap,
                        s->intersecting_count + output->pending_count, sizeof *s->intersecting))
            return false;
        for (uint32_t k = 0; k < output->pending_count; k++) {
            uint8_t *const counted = &s->intersecting_counts[output->pixels[k]];
            if (*counted > INTERSECTING_MOST) continue;
            ++*counted;
            if (s->intersecting_count < s->intersecting_limit)
                s->intersecting[s->intersecting_count++] = output->pending[k];
            else
                s->stats->edges_lost++;
        }
    }
    return true;
}

static dp_result out_of_memory(dp_diag *diag) {
    return dp_fail(diag, DP_ERR_MEMORY, "out of memory while drawing");
}

static dp_result read_part(dp_stream_draw *s, dp_reading reading, dp_diag *diag) {
    const uint32_t chunks = s->input.count / DP_CHUNK + (s->input.count % DP_CHUNK != 0);
    job j = {.stream = s,
             .reading = reading,
             .share = s->pending.share,
             .joins = s->joined < s->pending.count};
    dp_parallel(s->frame->threads, chunks + j.joins, do_task, &j);
    if (j.failed) return out_of_memory(diag);
    for (uint32_t i = 0; i < chunks; i++)
        if (s->outputs[i].result) {
            if (diag) *diag = s->outputs[i].diag;
            return s->outputs[i].result;
        }
    if (!list_covering(s, chunks, reading) ||
        !(reading == DP_READ_HIDERS ? add_intersecting(s, chunks) && dp_stream_join_fans(s)
                                    : add_pending(s, chunks)))
        return out_of_memory(diag);
    return DP_OK;
}

static dp_result report(const dp_stream_draw *s, double from, double to, dp_diag *diag) {
    double done = dp_input_fraction(&s->input);
    if (done < 0 && s->triangles)
        done = (double)(s->input.first + s->input.count) / (double)s->triangles;
    return s->setup.report(
        s->setup.arg, done < 0 ? done : dp_min(from + (to - from) * dp_min(done, 1), to), diag);
}

static dp_result read_all(dp_stream_draw *s, dp_reading reading, double from, double to,
                          dp_diag *diag) {
    for (;;) {
        dp_result result = dp_input_next(&s->input, diag);
        if (result) return result;
        if (!s->input.count) break;
        if ((result = read_part(s, reading, diag)) || (result = report(s, from, to, diag)))
            return result;
    }
    s->triangles = s->input.first;
    return join_edges(s) && draw_listed(s, reading) ? DP_OK : out_of_memory(diag);
}

dp_result dp_stream_read(dp_stream_draw *s, dp_reading reading, double from, double to,
                         dp_diag *diag) {
    dp_source *const source = s->input.source;
    const dp_stats before = *s->stats;
    dp_result result = DP_OK;
    s->covering = 0;
    s->joined = s->pending.count;
    if (reading != DP_READ_FACES) {
        dp_input_close(&s->input);
        result = dp_input_open(&s->input, source, s->chunks, s->memory, s->stats, diag);
    }
    if (!result) result = read_all(s, reading, from, to, diag);
    if (reading != DP_READ_FACES) {
        const uint64_t lost = s->stats->edges_lost;
        *s->stats = before;
        s->stats->edges_lost = lost;
    }
    return result;
}
