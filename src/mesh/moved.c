/* A source of another one's polygons with moved vertices.
 *
 *     next:  a batch of the inner source, and the partner's if there is one
 *            runs of its vertices, in parallel -> positions
 *            the batch, with these positions and without normals
 *
 * Where the inner source's first batch is stable and the only one, the positions are the source's
 * for good, and what is handed out is stable too, so that it is drawn where it lies. They are written
 * again in each reading, since time, partner, and what an application's function looks at may have
 * changed: the same bits unless something has.
 *
 * Invariant: a vertex depends only on itself and on the time, so runs may be of any length. */
#include "mesh/moved.h"

#include "base/diag.h"
#include "base/hostile.h"
#include "base/vec.h"
#include "mesh/source.h"

enum { RUN = DP_TUNED(4096, 3) /* vertices */ };

typedef struct moved {
    dp_moved_desc desc;
    dp_allocator memory;
    dp_threads *threads; /* NULL: none are lent */
    double time;
    float (*positions)[3], (*normals)[3];
    size_t positions_cap, normals_cap;
    dp_batch ahead; /* of the inner source, read to learn whether the first is the only one */
    bool has_ahead, begun;
    uint64_t handed_out; /* vertices */
} moved;

/* ------- vertices ------- */

typedef struct job {
    moved *self;
    const dp_batch *rest, *other;
} job;

static void move_run(void *arg, uint32_t index, uint32_t worker) {
    const job *const j = arg;
    moved *const m = j->self;
    const size_t first = (size_t)index * RUN, left = j->rest->vertex_count - first;
    (void)worker;
    const dp_vertex_run run = {.time = m->time,
                               .origin = j->rest->origin,
                               .first = m->handed_out + first,
                               .count = left < RUN ? left : RUN,
                               .positions =
                                   (const float *)(const void *)((const char *)j->rest->positions +
                                                                 first * j->rest->position_stride),
                               .stride = j->rest->position_stride,
                               .moved = m->positions + first,
                               .normals = m->desc.normals ? m->normals + first : NULL};
    m->desc.move(m->desc.user, &run, j->other, first);
}

static void move_vertices(moved *m, const dp_batch *rest, const dp_batch *other) {
    job j = {m, rest, other};
    const uint32_t runs = (uint32_t)((rest->vertex_count + RUN - 1) / RUN);
    if (m->threads)
        dp_parallel(m->threads, runs, move_run, &j);
    else
        for (uint32_t k = 0; k < runs; k++) move_run(&j, k, 0);
}

/* ------- batches ------- */

static dp_result out_of_memory(size_t vertices, dp_diag *diag) {
    return dp_fail(diag, DP_ERR_MEMORY, "out of memory for %zu moved vertices", vertices);
}

static dp_result next_of_partner(moved *m, const dp_batch *rest, dp_batch *other, dp_diag *diag) {
    const dp_result result = dp_source_next(m->desc.partner, other, diag);
    if (result || other->vertex_count == rest->vertex_count) return result;
    return dp_fail(
        diag, DP_ERR_FORMAT,
        "two models can be blended only vertex by vertex, but where one has %zu vertices "
        "the other has %zu",
        rest->vertex_count, other->vertex_count);
}

/* Replaces a batch's positions and normals. */
static dp_result move_batch(moved *m, dp_batch *batch, bool stable, dp_diag *diag) {
    dp_batch other;
    const size_t n = batch->vertex_count;
    if (m->desc.partner) {
        const dp_result result = next_of_partner(m, batch, &other, diag);
        if (result) return result;
    }
    if (!dp_reserve(&m->memory, &m->positions, &m->positions_cap, n, sizeof *m->positions) ||
        (m->desc.normals &&
         !dp_reserve(&m->memory, &m->normals, &m->normals_cap, n, sizeof *m->normals)))
        return out_of_memory(n, diag);
    if (n) move_vertices(m, batch, m->desc.partner ? &other : NULL);
    m->handed_out += n;
    if (n) batch->positions = m->positions[0]; /* else all its indices are out of range */
    batch->position_stride = sizeof *m->positions;
    batch->normals = (dp_attribute){0};
    if (m->desc.normals && n) batch->normals = (dp_attribute){.values = m->normals[0], .count = n};
    batch->stable = stable;
    return DP_OK;
}

/* The inner source's next batch, and whether it is stable and the only one. */
static dp_result next_of_inner(moved *m, dp_batch *batch, bool *only, dp_diag *diag) {
    const bool first = !m->begun;
    *only = false;
    m->begun = true;
    if (m->has_ahead) {
        *batch = m->ahead;
        m->has_ahead = false;
        return DP_OK;
    }
    dp_result result = dp_source_next(m->desc.inner, batch, diag);
    if (result || !batch->stable || !first || !batch->polygon_count) return result;
    result = dp_source_next(m->desc.inner, &m->ahead, diag);
    m->has_ahead = !result;
    *only = !result && !m->ahead.polygon_count;
    return result;
}

static dp_result moved_next(void *user, dp_batch *batch, dp_diag *diag) {
    moved *const m = user;
    bool only;
    const dp_result result = next_of_inner(m, batch, &only, diag);
    if (result || !batch->polygon_count) return result;
    return move_batch(m, batch, only, diag);
}

static void begin_reading(moved *m) {
    m->has_ahead = m->begun = false;
    m->handed_out = 0;
}

static dp_result moved_rewind(void *user, dp_diag *diag) {
    moved *const m = user;
    begin_reading(m);
    const dp_result result = dp_source_rewind(m->desc.inner, diag);
    return result || !m->desc.partner ? result : dp_source_rewind(m->desc.partner, diag);
}

/* ------- time, and what is passed on ------- */

static dp_result moved_set_time(void *user, double time, dp_diag *diag) {
    moved *const m = user;
    begin_reading(m);
    dp_result result = dp_source_set_time(m->desc.inner, time, diag);
    if (!result && m->desc.partner) result = dp_source_set_time(m->desc.partner, time, diag);
    if (!result && m->desc.set_time) result = m->desc.set_time(m->desc.user, time, diag);
    if (!result) m->time = time;
    return result;
}

static double moved_duration(void *user) {
    const moved *const m = user;
    const double own = m->desc.duration ? m->desc.duration(m->desc.user) : 0;
    const double inner = dp_source_duration(m->desc.inner);
    return dp_max(own, dp_max(inner, dp_source_duration(m->desc.partner)));
}

static void moved_lend(void *user, dp_threads *threads) {
    moved *const m = user;
    m->threads = threads;
    dp_source_lend(m->desc.inner, threads);
    if (m->desc.partner) dp_source_lend(m->desc.partner, threads);
}

static const char *moved_group_name(void *user, uint32_t group) {
    return dp_source_group_name(((const moved *)user)->desc.inner, group);
}
static uint32_t moved_group_color(void *user, uint32_t group) {
    return dp_source_group_color(((const moved *)user)->desc.inner, group);
}
static const char *moved_remark(void *user) {
    return dp_source_remark(((const moved *)user)->desc.inner);
}
static const char *moved_color_remark(void *user) {
    return dp_source_color_remark(((const moved *)user)->desc.inner);
}

/* ------- making ------- */

static void release(moved *m) {
    const dp_allocator memory = m->memory;
    dp_free(&memory, m->positions);
    dp_free(&memory, m->normals);
    dp_free(&memory, m);
}

static void moved_destroy(void *user) {
    moved *const m = user;
    dp_source_destroy(m->desc.inner);
    dp_source_destroy(m->desc.partner);
    if (m->desc.destroy) m->desc.destroy(m->desc.user);
    release(m);
}

static dp_source_callbacks callbacks_of(moved *m) {
    const dp_source_callbacks *const inner = &m->desc.inner->callbacks;
    const bool rewindable = dp_source_rewindable(m->desc.inner) &&
                            (!m->desc.partner || dp_source_rewindable(m->desc.partner));
    dp_source_callbacks c = {.user = m,
                             .next = moved_next,
                             .rewind = rewindable ? moved_rewind : NULL,
                             .destroy = moved_destroy,
                             .group_name = moved_group_name,
                             .group_color = moved_group_color,
                             .remark = moved_remark,
                             .color_remark = moved_color_remark,
                             .up_assumed = inner->up_assumed,
                             .set_time = moved_set_time,
                             .duration = moved_duration};
    for (int k = 0; k < 3; k++) c.up[k] = inner->up[k];
    return c;
}

dp_result dp_source_moved(const dp_moved_desc *desc, const dp_allocator *memory, dp_source **out,
                          dp_diag *diag) {
    moved *const m = dp_alloc_zeroed(memory, sizeof *m);
    if (!m) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a polygon source");
    m->desc = *desc;
    m->memory = *memory;
    const dp_source_callbacks callbacks = callbacks_of(m);
    const dp_result result = dp_source_from_callbacks(&callbacks, memory, out, diag);
    if (result) return release(m), result;
    (*out)->lend = moved_lend;
    return DP_OK;
}

void *dp_moved_user(const dp_source *source, dp_mover *move) {
    if (!source || source->callbacks.next != moved_next) return NULL;
    const moved *const m = source->callbacks.user;
    return m->desc.move == move ? m->desc.user : NULL;
}
