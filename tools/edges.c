/* Counts a model's edges by their polygons, in a hash table over the positions of their ends, so
 * that models without shared vertices (STL) count right too.
 *
 * The table grows with the model, as this is a tool to inspect files; drawing needs nothing like
 * it.
 *
 * Invariant: a slot is free while its count is 0; the table is at most half full. An edge is
 * identified by a 64-bit fingerprint of its ends' bits: with a hundred million edges, two coincide
 * with a probability of about 1 / 4000, and one count is wrong then. */
#include "edges.h"

#include "progress.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WAITING = 64 };

typedef struct slot {
    uint64_t key;
    uint32_t count;
} slot;

typedef struct table {
    slot *slots;
    size_t size, used; /* size: a power of two */
    uint64_t waiting[WAITING];
    unsigned waiting_count;
} table;

static uint64_t mix(uint64_t x) {
    x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9u;
    x = (x ^ x >> 27) * 0x94D049BB133111EBu;
    return x ^ x >> 31;
}

static uint64_t position_hash(const float p[3]) {
    uint64_t hash = 0x9E3779B97F4A7C15u;
    for (int k = 0; k < 3; k++) {
        const float value = p[k] + 0.0F; /* minus zero is zero */
        uint32_t bits;
        memcpy(&bits, &value, sizeof bits);
        hash = mix(hash + bits);
    }
    return hash;
}

/* Of the hashes of both ends, the same in both directions. */
static uint64_t edge_key(uint64_t x, uint64_t y) { return mix(x < y ? x * 3 + y : y * 3 + x); }

static slot *find(const table *t, uint64_t key) {
    size_t at = (size_t)key & (t->size - 1);
    while (t->slots[at].count && t->slots[at].key != key) at = (at + 1) & (t->size - 1);
    return &t->slots[at];
}

static bool grow(table *t) {
    const table old = *t;
    t->size = old.size ? 2 * old.size : 1 << 16;
    t->slots = calloc(t->size, sizeof *t->slots);
    if (!t->slots) {
        *t = old;
        return false;
    }
    for (size_t k = 0; k < old.size; k++)
        if (old.slots[k].count) *find(t, old.slots[k].key) = old.slots[k];
    free(old.slots);
    return true;
}

static bool count_edge(table *t, uint64_t key) {
    if (2 * t->used >= t->size && !grow(t)) return false;
    slot *const s = find(t, key);
    if (!s->count) t->used++;
    s->key = key;
    if (s->count < UINT32_MAX) s->count++;
    return true;
}

static bool count_waiting(table *t) {
    for (unsigned k = 0; k < t->waiting_count; k++)
        if (!count_edge(t, t->waiting[k])) return false;
    t->waiting_count = 0;
    return true;
}

/* Nearly all time is spent waiting for memory: keys are collected and their slots prefetched, which
 * saves about half of it. */
static bool add_edge(table *t, uint64_t key) {
#if defined(__GNUC__)
    if (t->size) __builtin_prefetch(&t->slots[(size_t)key & (t->size - 1)]);
#endif
    t->waiting[t->waiting_count++] = key;
    return t->waiting_count < WAITING || count_waiting(t);
}

/* ---- polygons ---- */

static const float *corner(const dp_batch *batch, size_t c) {
    const uint32_t v = batch->indices ? batch->indices[c] : (uint32_t)c;
    if (v >= batch->vertex_count) return NULL;
    return (const float *)(const void *)((const char *)batch->positions +
                                         v * batch->position_stride);
}

/* Twice the area, by Newell's sum about the first corner. */
static double area2(const dp_batch *batch, size_t first, size_t last) {
    double sum[3] = {0};
    const float *const o = corner(batch, first);
    for (size_t c = first + 1; c + 1 < last; c++) {
        const float *const p = corner(batch, c), *const q = corner(batch, c + 1);
        double u[3], v[3];
        for (int k = 0; k < 3; k++) u[k] = (double)p[k] - o[k], v[k] = (double)q[k] - o[k];
        for (int k = 0; k < 3; k++)
            sum[k] += u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
    }
    return sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
}

/* Can a polygon be drawn? Otherwise the cause is counted. */
static bool sound(const dp_batch *batch, size_t first, size_t last, edge_counts *counts) {
    if (last - first < 3) {
        counts->corners++;
        return false;
    }
    for (size_t c = first; c < last; c++)
        if (!corner(batch, c)) {
            counts->index++;
            return false;
        }
    for (size_t c = first; c < last; c++) {
        const float *const p = corner(batch, c);
        if (isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2])) continue;
        counts->finite++;
        return false;
    }
    if (area2(batch, first, last) > 0) return true;
    counts->area++;
    return false;
}

static bool add_polygon(table *t, const dp_batch *batch, size_t first, size_t last,
                        dp_extent *extent) {
    const double *const o = batch->origin;
    uint64_t before = position_hash(corner(batch, last - 1));
    for (size_t c = first; c < last; c++) {
        const float *const p = corner(batch, c);
        const uint64_t here = position_hash(p);
        for (int k = 0; k < 3; k++) {
            extent->exact_min[k] = fmin(extent->exact_min[k], o[k] + (double)p[k]);
            extent->exact_max[k] = fmax(extent->exact_max[k], o[k] + (double)p[k]);
        }
        if (here != before && !add_edge(t, edge_key(before, here))) return false;
        before = here;
    }
    return true;
}

static bool add_batch(table *t, const dp_batch *batch, dp_extent *extent, edge_counts *counts) {
    for (size_t i = 0; i < batch->polygon_count; i++) {
        const size_t first = batch->firsts ? batch->firsts[i] : 3 * i;
        const size_t last = batch->firsts ? batch->firsts[i + 1] : 3 * i + 3;
        extent->corners += last - first;
        if (sound(batch, first, last, counts) && !add_polygon(t, batch, first, last, extent))
            return false;
    }
    extent->polygons += batch->polygon_count;
    extent->vertices += batch->vertex_count;
    return count_waiting(t);
}

static dp_result add_source(table *t, dp_source *source, dp_extent *extent, edge_counts *counts,
                            dp_diag *diag) {
    for (;;) {
        dp_batch batch;
        const dp_result result = dp_source_next(source, &batch, diag);
        if (result || !batch.polygon_count) return result;
        progress_report(NULL, -1);
        if (!add_batch(t, &batch, extent, counts)) {
            *diag = (dp_diag){.result = DP_ERR_MEMORY};
            snprintf(diag->message, sizeof diag->message,
                     "out of memory for a table of its edges; draw it all the same");
            return DP_ERR_MEMORY;
        }
    }
}

dp_result count_edges(dp_source *source, dp_extent *extent, edge_counts *counts, dp_diag *diag) {
    table t = {0};
    *counts = (edge_counts){0};
    *extent = (dp_extent){.exact_min = {INFINITY, INFINITY, INFINITY},
                          .exact_max = {-INFINITY, -INFINITY, -INFINITY}};
    const dp_result result = add_source(&t, source, extent, counts, diag);
    if (extent->exact_min[0] > extent->exact_max[0])
        memset(extent->exact_min, 0, sizeof extent->exact_min),
            memset(extent->exact_max, 0, sizeof extent->exact_max);
    for (size_t k = 0; k < t.size; k++) {
        counts->open += t.slots[k].count == 1;
        counts->crowded += t.slots[k].count > 2;
    }
    free(t.slots);
    return result;
}
