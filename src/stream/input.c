/* Reads a source in parts of many chunks, as triangles.
 *
 * A source with records (a binary STL): a part is a range of record numbers, and each chunk reads
 * its own records in its own thread. Any other source: polygons are copied from batches one after
 * the other and split where they have more than three corners; diagonals never draw.
 *
 * Invariant: a triangle's number is its place in the stream, the same in every reading. */
#include "stream/input.h"

#include "base/diag.h"
#include "mesh/batch.h"
#include "mesh/records.h"

#include <string.h>

static dp_result out_of_memory(dp_diag *diag) {
    return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a part of the model");
}

static const dp_array arrays[] = {DP_ARRAY(dp_input, corners, corners_cap),
                                  DP_ARRAY(dp_input, flags, flags_cap),
                                  DP_ARRAY(dp_input, polygons, polygons_cap)};

uint64_t dp_input_known(const dp_source *source) {
    return dp_source_records(source)->read ? dp_source_records(source)->count : 0;
}

dp_result dp_input_open(dp_input *input, dp_source *source, uint32_t chunks,
                        const dp_allocator *memory, dp_stats *stats, dp_diag *diag) {
    *input =
        (dp_input){.source = source, .memory = memory, .stats = stats, .part = chunks * DP_CHUNK};
    const dp_result begun = dp_source_begun(source, diag);
    if (begun) return begun;
    if (dp_source_records(source)->read) return DP_OK;
    if (dp_reserve(memory, &input->corners, &input->corners_cap, input->part,
                   sizeof *input->corners) &&
        dp_reserve(memory, &input->flags, &input->flags_cap, input->part, sizeof *input->flags) &&
        dp_reserve(memory, &input->polygons, &input->polygons_cap, input->part,
                   sizeof *input->polygons))
        return DP_OK;
    dp_input_close(input);
    return out_of_memory(diag);
}

void dp_input_close(dp_input *input) {
    if (!input->memory) return;
    dp_arrays_free(input->memory, input, DP_ARRAYS(arrays));
    dp_split_scratch_free(&input->scratch, input->memory);
    *input = (dp_input){0};
}

uint64_t dp_input_bytes(const dp_input *input) {
    return dp_arrays_bytes(input, DP_ARRAYS(arrays)) + dp_split_scratch_bytes(&input->scratch);
}

/* ------- polygons of batches ------- */

static void put(dp_input *input, const float *a, const float *b, const float *c, unsigned flags,
                size_t polygon) {
    float *const out = input->corners[input->count];
    memcpy(out, a, 3 * sizeof(float));
    memcpy(out + 3, b, 3 * sizeof(float));
    memcpy(out + 6, c, 3 * sizeof(float));
    for (int i = 0; input->moved && i < 9; i++)
        out[i] = (float)((double)out[i] + input->shift[i % 3]);
    input->flags[input->count] = (uint8_t)flags;
    input->polygons[input->count++] = (uint32_t)(input->handed_out + polygon);
}

/* Bit 0 where the edge from corner `from` of n draws: a diagonal may be an outline. */
static unsigned edge_flag(const dp_batch *batch, size_t first, size_t n, uint32_t from,
                          uint32_t to) {
    if (to != (from + 1) % n || !batch->edge_flags) return true;
    const uint8_t flag = batch->edge_flags[first + from];
    return flag > DP_EDGE_FACE || dp_flag_may_be_line(flag);
}

/* Lines by themselves have no place among the readings' edges. */
static dp_result check_flags(const dp_batch *batch, dp_diag *diag) {
    bool any = false;
    for (size_t i = 0; batch->edge_flags && i < batch->corner_count && !any; i++)
        any = batch->edge_flags[i] == DP_EDGE_SECTION || batch->edge_flags[i] == DP_EDGE_HATCHING;
    if (!any) return DP_OK;
    return dp_fail(
        diag, DP_ERR_UNSUPPORTED,
        "what the clip planes leave is larger than the memory that drawing may take, and lines "
        "of sections cannot be drawn from a stream: allow more memory");
}

static void put_piece(dp_input *input, size_t polygon, size_t first, size_t n, uint32_t a,
                      uint32_t b, uint32_t c) {
    const float *const *const at = input->scratch.at;
    const dp_batch *const batch = &input->batch;
    put(input, at[a], at[b], at[c],
        edge_flag(batch, first, n, a, b) | edge_flag(batch, first, n, b, c) << 1 |
            edge_flag(batch, first, n, c, a) << 2,
        polygon);
}

/* The corners' positions; false where one is not usable, which is counted. */
static bool locate(dp_input *input, size_t first, size_t n) {
    const dp_batch *const batch = &input->batch;
    for (size_t i = 0; i < n; i++) {
        const uint32_t vertex = batch->indices ? batch->indices[first + i] : (uint32_t)(first + i);
        if (vertex >= batch->vertex_count) {
            input->stats->dropped_index++;
            return false;
        }
        const float *const p = (const float *)(const void *)((const char *)batch->positions +
                                                             vertex * batch->position_stride);
        if (!isfinite(p[0]) || !isfinite(p[1]) || !isfinite(p[2])) {
            input->stats->dropped_finite++;
            return false;
        }
        input->scratch.at[i] = p;
    }
    return true;
}

/* False: the part has no room for the polygon, or *result says what went wrong. */
static bool take_polygon(dp_input *input, size_t polygon, dp_result *result, dp_diag *diag) {
    const dp_batch *const batch = &input->batch;
    const size_t first = batch->firsts ? batch->firsts[polygon] : 3 * polygon;
    const size_t n = batch->firsts ? batch->firsts[polygon + 1] - first : 3;
    if (n < 3) return input->stats->dropped_corners++, true;
    if (n - 2 > input->part - input->count) {
        if (!input->count)
            *result = dp_fail(
                diag, DP_ERR_LIMIT,
                "a polygon of %zu corners; streamed, it may have %u, or more with more memory", n,
                input->part + 2);
        return false;
    }
    if (!dp_split_scratch_reserve(&input->scratch, n, input->memory))
        return *result = out_of_memory(diag), false;
    input->stats->triangles += n - 2;
    if (!locate(input, first, n)) return true;
    if (n == 3 || dp_stays_whole(input->scratch.at, (uint32_t)n)) {
        for (uint32_t i = 1; i + 1 < n; i++) put_piece(input, polygon, first, n, 0, i, i + 1);
        return true;
    }
    input->stats->split++;
    const uint32_t pieces = dp_split_polygon(&input->scratch, (uint32_t)n);
    for (uint32_t i = 0; i < pieces; i++) {
        const uint32_t *const t = input->scratch.triangles[i];
        put_piece(input, polygon, first, n, t[0], t[1], t[2]);
    }
    return true;
}

static dp_result next_of_batches(dp_input *input, dp_diag *diag) {
    dp_result result = DP_OK;
    while (input->count < input->part) {
        if (input->taken == input->batch.polygon_count) {
            input->handed_out += input->batch.polygon_count;
            input->taken = 0;
            result = dp_source_next(input->source, &input->batch, diag);
            if (result || !input->batch.polygon_count) return result;
            if ((result = check_flags(&input->batch, diag))) return result;
            if (!input->handed_out)
                memcpy(input->origin, input->batch.origin, sizeof input->origin);
            input->moved = dp_batch_shift(&input->batch, input->origin, input->shift);
            input->stats->polygons += input->batch.polygon_count;
        }
        if (!take_polygon(input, input->taken, &result, diag)) return result;
        input->taken++;
    }
    return DP_OK;
}

/* ------- parts ------- */

dp_result dp_input_next(dp_input *input, dp_diag *diag) {
    const dp_records *const r = dp_source_records(input->source);
    input->first += input->count;
    input->count = 0;
    if (input->first >= UINT32_MAX - 2 - input->part)
        return dp_fail(diag, DP_ERR_LIMIT, "more than %u triangles", UINT32_MAX - 2 - input->part);
    if (!r->read) return next_of_batches(input, diag);
    const uint64_t left = r->count - input->first;
    input->count = left < input->part ? (uint32_t)left : input->part;
    input->stats->polygons += input->count;
    input->stats->triangles += input->count;
    return DP_OK;
}

size_t dp_input_buffer_size(const dp_input *input) {
    return dp_source_records(input->source)->read
               ? dp_source_records(input->source)->size * DP_CHUNK
               : 1;
}

dp_result dp_input_chunk(const dp_input *input, uint32_t index, uint8_t *buffer, dp_triangles *out,
                         dp_diag *diag) {
    const dp_records *const r = dp_source_records(input->source);
    const uint32_t first = index * DP_CHUNK;
    const uint32_t count = input->count - first < DP_CHUNK ? input->count - first : DP_CHUNK;
    if (!r->read) {
        *out = (dp_triangles){(const uint8_t *)input->corners[first], sizeof *input->corners, count,
                              input->flags + first};
        return DP_OK;
    }
    *out = (dp_triangles){buffer + r->corners, r->size, count, NULL};
    return r->read(r->user, input->first + first, count, buffer, diag);
}

double dp_input_fraction(const dp_input *input) {
    const dp_records *const r = dp_source_records(input->source);
    return r->read && r->count ? (double)(input->first + input->count) / (double)r->count : -1;
}
