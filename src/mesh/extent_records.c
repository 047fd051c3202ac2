/* The extent and reach of a source with records: every corner is read once, in parallel.
 *
 * Records are cut into blocks, one task each; each worker keeps the box and the reach of what it has
 * read, so the sum does not depend on which worker read what. A triangle with a coordinate that is
 * not finite is counted and left out. Reach is looked for in runs, as in extent.c. */
#include "mesh/source.h"

#include "base/diag.h"
#include "base/hostile.h"
#include "base/threads.h"
#include "base/vec.h"
#include "mesh/wide.h"

#include <math.h>
#include <string.h>

enum {
    BLOCK = DP_TUNED(4096, 3),
    RUN = DP_TUNED(64, 2),     /* triangles */
    SAMPLES = DP_TUNED(64, 3), /* runs */
    PART = DP_TUNED(1024, 5)   /* blocks between two reports of progress */
};

typedef struct box {
    float min[3], max[3];
} box;

static const box empty_box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

/* One worker's sum. Larger than two cache lines, so that workers share none. */
typedef struct seen {
    box box;
    bool reaches; /* `reach` is asked for */
    dp_reach reach;
    uint64_t not_finite;
    uint8_t *buffer;
    dp_diag diag;
    dp_result result;
} seen;

typedef struct job {
    const dp_source *source;
    seen *workers;
    uint64_t first; /* block */
} job;

static void look_at(seen *s, box *b, const uint8_t *record) {
    float p[9];
    memcpy(p, record, sizeof p);
    float sum = 0;
    for (int i = 0; i < 9; i++) sum += p[i] - p[i]; /* 0, or NaN when any is not finite */
    if (sum != 0) {
        s->not_finite++;
        return;
    }
    for (int i = 0; i < 9; i++) {
        b->min[i % 3] = dp_minf(p[i], b->min[i % 3]);
        b->max[i % 3] = dp_maxf(p[i], b->max[i % 3]);
    }
}

typedef float f4 __attribute__((vector_size(16)));
typedef int32_t i4 __attribute__((vector_size(16)));

static f4 choose(i4 mask, f4 a, f4 b) { return (f4)((mask & (i4)a) | (~mask & (i4)b)); }

/* Finds the box of finite triangles; false if any is not finite, and b is unchanged. */
static bool look_at_finite(box *b, const uint8_t *records, uint32_t count, size_t stride) {
    enum { WORD = sizeof(float), STARTS = 3 };
    static const size_t from[STARTS] = {
        0, 4, 5}; /* four words from each: together the nine of a record */
    f4 lo[STARTS], hi[STARTS], sum = {0};
    for (int k = 0; k < STARTS; k++) {
        lo[k] = (f4){INFINITY, INFINITY, INFINITY, INFINITY};
        hi[k] = -lo[k];
    }
    for (uint32_t i = 0; i < count; i++)
        for (int k = 0; k < STARTS; k++) {
            f4 v;
            memcpy(&v, records + i * stride + WORD * from[k], sizeof v);
            lo[k] = choose(v < lo[k], v, lo[k]);
            hi[k] = choose(v > hi[k], v, hi[k]);
            sum += v - v;
        }
    for (int l = 0; l < 4; l++)
        if (sum[l] != 0) return false;
    for (size_t k = 0; k < STARTS; k++)
        for (size_t l = 0; l < 4; l++) {
            const size_t axis = (from[k] + l) % 3;
            b->min[axis] = dp_minf(lo[k][l], b->min[axis]);
            b->max[axis] = dp_maxf(hi[k][l], b->max[axis]);
        }
    return true;
}

/* Is a triangle inside what is known? Quicker than to ask the same of a batch. */
static bool is_inside(const dp_reach *reach, const float p[9]) {
    for (int c = 0; c < 9; c += 3) {
        const double at[3] = {(double)p[c], (double)p[c + 1], (double)p[c + 2]};
        if (!dp_reach_has(reach, at)) return false;
    }
    return true;
}

static void reach_for_all(dp_reach *reach, const uint8_t *records, uint32_t count, size_t stride) {
    static const double no_shift[3] = {0};
    for (uint32_t i = 0; i < count; i++) {
        float p[9];
        memcpy(p, records + i * stride, sizeof p);
        if (is_inside(reach, p)) continue;
        const dp_batch triangle = {.positions = p,
                                   .position_stride = 3 * sizeof *p,
                                   .vertex_count = 3,
                                   .corner_count = 3,
                                   .polygon_count = 1};
        dp_reach_add_polygon(reach, &triangle, 0, 3, no_shift);
    }
}

/* Adds a run's triangles to the reach, if its box says that they may change it. */
static void reach_for(seen *s, const box *b, const uint8_t *records, uint32_t count,
                      size_t stride) {
    double min[3], max[3];
    for (int k = 0; k < 3; k++) min[k] = (double)b->min[k], max[k] = (double)b->max[k];
    if (!s->reaches || min[0] > max[0] || !dp_reach_may_grow(&s->reach, min, max)) return;
    reach_for_all(&s->reach, records, count, stride);
}

static void look_at_run(seen *s, const uint8_t *records, uint32_t count, size_t stride) {
    box b = empty_box;
    if (!look_at_finite(&b, records, count, stride))
        for (uint32_t i = 0; i < count; i++) look_at(s, &b, records + i * stride);
    for (int k = 0; k < 3; k++) {
        s->box.min[k] = dp_minf(b.min[k], s->box.min[k]);
        s->box.max[k] = dp_maxf(b.max[k], s->box.max[k]);
    }
    reach_for(s, &b, records, count, stride);
}

static void look_at_block(void *arg, uint32_t index, uint32_t worker) {
    const job *const j = arg;
    const dp_records *const r = &j->source->records;
    seen *const s = &j->workers[worker];
    const uint64_t first = (j->first + index) * BLOCK, left = r->count - first;
    const uint32_t count = left < BLOCK ? (uint32_t)left : BLOCK;
    const uint32_t run = s->reaches ? RUN : BLOCK;
    if (s->result) return;
    s->result = r->read(r->user, first, count, s->buffer, &s->diag);
    if (s->result) return;
    const uint8_t *const records = s->buffer + r->corners;
    for (uint32_t i = 0; i < count; i += run)
        look_at_run(s, records + i * r->size, count - i < run ? count - i : run, r->size);
}

static dp_result look_at_all(dp_source *source, dp_threads *threads, seen *workers, dp_diag *diag) {
    const dp_records *const r = &source->records;
    const uint64_t blocks = r->count / BLOCK + (r->count % BLOCK != 0);
    for (uint64_t first = 0; first < blocks; first += PART) {
        job j = {source, workers, first};
        dp_parallel(threads, (uint32_t)(blocks - first < PART ? blocks - first : PART),
                    look_at_block, &j);
        for (uint32_t i = 0; i < dp_threads_count(threads); i++)
            if (workers[i].result) {
                *diag = workers[i].diag;
                return workers[i].result;
            }
        if (r->progress && r->progress(r->progress_user, (double)first / (double)blocks))
            return dp_fail(diag, DP_ERR_CANCELLED, "reading was stopped");
    }
    return DP_OK;
}

/* Runs from all over a large file first: then few of the others reach farther. */
static dp_result sample(const dp_source *source, dp_reach *reach, uint8_t *buffer, dp_diag *diag) {
    const dp_records *const r = &source->records;
    const uint64_t step = r->count / SAMPLES;
    if (!reach || step < DP_TUNED(16, 2) * RUN) return DP_OK;
    for (uint64_t i = 0; i + RUN <= r->count; i += step) {
        const dp_result result = r->read(r->user, i, RUN, buffer, diag);
        if (result) return result;
        reach_for_all(reach, buffer + r->corners, RUN, r->size);
    }
    dp_reach_set_limits(reach);
    return DP_OK;
}

static void add_up(const seen *workers, uint32_t count, dp_extent *extent, dp_reach *reach) {
    for (int k = 0; k < 3; k++) {
        float lo = INFINITY, hi = -INFINITY;
        for (uint32_t i = 0; i < count; i++)
            lo = fminf(lo, workers[i].box.min[k]), hi = fmaxf(hi, workers[i].box.max[k]);
        extent->exact_min[k] = (double)lo, extent->exact_max[k] = (double)hi;
        const double farthest = fmax(fabs((double)lo), fabs((double)hi));
        if (lo <= hi) extent->spacing = fmax(extent->spacing, dp_float_spacing(farthest));
    }
    dp_extent_round(extent);
    for (uint32_t i = 0; i < count; i++) {
        extent->not_finite += workers[i].not_finite;
        if (reach) dp_reach_join(reach, &workers[i].reach);
    }
}

dp_result dp_records_measure(dp_source *source, dp_extent *extent, dp_reach *reach, dp_diag *diag) {
    const dp_allocator *const memory = &source->allocator;
    const dp_records *const r = &source->records;
    dp_diag unused;
    if (!diag) diag = &unused;
    *extent = (dp_extent){.polygons = r->count, .corners = 3 * r->count, .vertices = 3 * r->count};
    /* small files are read faster than threads start */
    dp_threads *const threads =
        dp_threads_create(r->count > 64 * BLOCK ? DP_THREADS_BRIEF : 1, NULL, NULL, memory);
    const uint32_t workers = threads ? dp_threads_count(threads) : 0;
    seen *const seen_by = threads ? dp_alloc_array(memory, workers, sizeof *seen_by) : NULL;
    dp_result result =
        seen_by ? DP_OK : dp_fail(diag, DP_ERR_MEMORY, "out of memory for a model's extent");
    for (uint32_t i = 0; seen_by && i < workers; i++) {
        seen_by[i] = (seen){.box = empty_box, .reaches = reach != NULL};
        seen_by[i].buffer = dp_alloc_array(memory, BLOCK, r->size);
        if (!seen_by[i].buffer)
            result = dp_fail(diag, DP_ERR_MEMORY, "out of memory for a model's extent");
    }
    if (!result) result = sample(source, reach, seen_by[0].buffer, diag);
    for (uint32_t i = 0; seen_by && reach && i < workers; i++) seen_by[i].reach = *reach;
    if (!result) result = look_at_all(source, threads, seen_by, diag);
    if (!result) add_up(seen_by, workers, extent, reach);
    for (uint32_t i = 0; seen_by && i < workers; i++) dp_free(memory, seen_by[i].buffer);
    dp_free(memory, seen_by);
    dp_threads_destroy(threads);
    return result ? result : dp_source_rewind(source, diag);
}
