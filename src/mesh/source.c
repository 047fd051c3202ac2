/* Polygon sources: the interface between those that have polygons and those that read them.
 *
 * Invariant: a batch from dp_source_next is a well-formed table (corner counts add up, firsts
 * ascend). The consumer checks indices and coordinates. */
#include "mesh/source.h"
#include "mesh/parts.h"

#include "base/diag.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

dp_result dp_source_from_callbacks(const dp_source_callbacks *callbacks,
                                   const dp_allocator *allocator, dp_source **out, dp_diag *diag) {
    if (!out) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_source_from_callbacks: out is NULL");
    *out = NULL;
    if (!callbacks || !callbacks->next)
        return dp_fail(diag, DP_ERR_ARGUMENT, "dp_source_from_callbacks: next is NULL");
    const dp_allocator memory = dp_allocator_resolve(allocator);
    dp_source *const source = dp_alloc(&memory, sizeof *source);
    if (!source) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a polygon source");
    *source = (dp_source){.callbacks = *callbacks, .allocator = memory};
    *out = source;
    return DP_OK;
}

static bool is_aligned(const void *address, size_t stride, size_t size) {
    return ((uintptr_t)address | stride) % size == 0;
}

dp_result dp_check_alignment(const dp_batch *b, dp_diag *diag) {
    const struct {
        const void *address;
        size_t stride, size;
        const char *what;
    } arrays[] = {
        {b->positions, b->position_stride, sizeof(float), "positions"},
        {b->normals.values, b->normals.values ? b->normals.stride : 0, sizeof(float), "normals"},
        {b->texcoords.values, b->texcoords.values ? b->texcoords.stride : 0, sizeof(float),
         "texcoords"},
        {b->indices, 0, sizeof(uint32_t), "indices"},
        {b->firsts, 0, sizeof(uint32_t), "firsts"},
        {b->normals.indices, 0, sizeof(uint32_t), "normals' indices"},
        {b->texcoords.indices, 0, sizeof(uint32_t), "texcoords' indices"},
        {b->colors, 0, sizeof(uint32_t), "colors"},
        {b->groups, 0, sizeof(uint16_t), "groups"},
    };
    if (b->position_stride && b->position_stride < 3 * sizeof(float))
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "a batch's position_stride is %zu bytes, but a position takes %zu",
                       b->position_stride, 3 * sizeof(float));
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        if (!is_aligned(arrays[i].address, arrays[i].stride, arrays[i].size))
            return dp_fail(
                diag, DP_ERR_ARGUMENT,
                "a batch's %s must lie at multiples of %zu bytes: they begin elsewhere, or "
                "their stride of %zu is none",
                arrays[i].what, arrays[i].size, arrays[i].stride);
    return DP_OK;
}

/* A source of one batch of arrays, which it returns once after each rewind. */
typedef struct arrays {
    dp_batch batch;
    dp_allocator allocator;
    bool done;
} arrays;

static dp_result arrays_next(void *user, dp_batch *batch, dp_diag *diag) {
    arrays *const self = user;
    (void)diag;
    if (!self->done) *batch = self->batch;
    self->done = true;
    return DP_OK;
}

static dp_result arrays_rewind(void *user, dp_diag *diag) {
    (void)diag;
    ((arrays *)user)->done = false;
    return DP_OK;
}

static void arrays_destroy(void *user) {
    arrays *const self = user;
    const dp_allocator memory = self->allocator;
    dp_free(&memory, self);
}

dp_result dp_source_from_arrays(const dp_batch *batch, const dp_allocator *allocator,
                                dp_source **out, dp_diag *diag) {
    if (!out || !batch || (batch->polygon_count && !batch->positions))
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "dp_source_from_arrays: arrays, positions or out is NULL");
    *out = NULL;
    const dp_result misplaced = dp_check_alignment(batch, diag);
    if (misplaced) return misplaced;
    const dp_allocator memory = dp_allocator_resolve(allocator);
    arrays *const self = dp_alloc(&memory, sizeof *self);
    if (!self) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a polygon source");
    *self = (arrays){.batch = *batch, .allocator = memory};
    self->batch.stable = true;
    const dp_source_callbacks callbacks = {
        .user = self, .next = arrays_next, .rewind = arrays_rewind, .destroy = arrays_destroy};
    const dp_result result = dp_source_from_callbacks(&callbacks, &memory, out, diag);
    if (result) dp_free(&memory, self);
    return result;
}

/* A table whose counts contradict each other cannot be walked safely. */
dp_result dp_check_batch(const dp_batch *batch, dp_diag *diag) {
    if (!batch->polygon_count) return DP_OK;
    if (!batch->positions)
        return dp_fail(diag, DP_ERR_ARGUMENT, "a batch has polygons but no positions");
    if (batch->vertex_count > UINT32_MAX)
        return dp_fail(diag, DP_ERR_LIMIT, "a batch of %zu vertices; %" PRIu32 " are the most",
                       batch->vertex_count, UINT32_MAX);
    if (dp_times(batch->vertex_count, batch->position_stride) > PTRDIFF_MAX)
        return dp_fail(diag, DP_ERR_ARGUMENT, "%zu vertices %zu bytes apart are beyond any address",
                       batch->vertex_count, batch->position_stride);
    const dp_result misplaced = dp_check_alignment(batch, diag);
    if (misplaced) return misplaced;
    for (int k = 0; k < 3; k++)
        if (!isfinite(batch->origin[k]))
            return dp_fail(diag, DP_ERR_ARGUMENT, "a batch's origin is not finite");
    if (!batch->firsts && batch->corner_count / 3 < batch->polygon_count)
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "a batch of %zu triangles needs three times as many corners; "
                       "its corner_count is %zu",
                       batch->polygon_count, batch->corner_count);
    if (!batch->firsts) return DP_OK;
    for (size_t i = 0; i < batch->polygon_count; i++)
        if (batch->firsts[i] > batch->firsts[i + 1] || batch->firsts[i + 1] > batch->corner_count)
            return dp_fail(diag, DP_ERR_ARGUMENT, "a batch's firsts do not ascend at polygon %zu",
                           i);
    return DP_OK;
}

static dp_result next_batch(dp_source *source, dp_batch *batch, dp_diag *diag) {
    *batch = (dp_batch){0};
    const dp_result result = source->callbacks.next(source->callbacks.user, batch, diag);
    if (result) {
        if (diag->result != result) dp_fail(diag, result, "the polygon source failed");
        return result;
    }
    if (!batch->position_stride) batch->position_stride = 3 * sizeof(float);
    if (!batch->normals.stride) batch->normals.stride = 3 * sizeof(float);
    if (!batch->texcoords.stride) batch->texcoords.stride = 2 * sizeof(float);
    return dp_check_batch(batch, diag);
}

dp_result dp_source_next(dp_source *source, dp_batch *batch, dp_diag *diag) {
    if (!source || !batch) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_source_next: NULL argument");
    dp_diag unused;
    if (!source->holds) return next_batch(source, batch, diag ? diag : &unused);
    *batch = source->held;
    source->holds = false;
    return DP_OK;
}

dp_result dp_source_rewind(dp_source *source, dp_diag *diag) {
    dp_diag unused;
    if (!diag) diag = &unused;
    if (!source || !source->callbacks.rewind)
        return dp_fail(diag, DP_ERR_UNSUPPORTED, "this polygon source can be read only once");
    source->holds = false;
    return source->callbacks.rewind(source->callbacks.user, diag);
}

dp_result dp_source_begin(dp_source *source, double origin[3], dp_diag *diag) {
    dp_diag unused;
    dp_result result = dp_source_rewindable(source) ? dp_source_rewind(source, diag) : DP_OK;
    memset(origin, 0, 3 * sizeof *origin);
    if (result || source->records.read) return result; /* records have none */
    if (!source->holds) result = next_batch(source, &source->held, diag ? diag : &unused);
    if (result) return result;
    source->holds = true;
    memcpy(origin, source->held.origin, 3 * sizeof *origin);
    return DP_OK;
}

dp_result dp_source_begun(dp_source *source, dp_diag *diag) {
    return dp_source_rewindable(source) && !source->holds ? dp_source_rewind(source, diag) : DP_OK;
}

static dp_result move_to(dp_source *source, double time, dp_diag *diag) {
    if (!source->callbacks.set_time) return DP_OK;
    source->holds = false;
    source->moves = true;
    diag->result = DP_OK;
    const dp_result result = source->callbacks.set_time(source->callbacks.user, time, diag);
    if (result && diag->result != result)
        dp_fail(diag, result, "the polygon source cannot be moved to %g s", time);
    return result;
}

/* It is rewound after a failure, too: what was borrowed from a source within may be gone. */
dp_result dp_source_set_time(dp_source *source, double time, dp_diag *diag) {
    dp_diag unused;
    if (!diag) diag = &unused;
    if (!source || !isfinite(time))
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "dp_source_set_time: source is NULL, or the time is not finite");
    const dp_result result = move_to(source, time, diag);
    if (!dp_source_rewindable(source)) return result;
    const dp_result rewound = dp_source_rewind(source, result ? &unused : diag);
    return result ? result : rewound;
}

double dp_source_duration(const dp_source *source) {
    if (!source || !source->callbacks.duration) return 0;
    const double duration = source->callbacks.duration(source->callbacks.user);
    return duration > 0 && isfinite(duration) ? duration : 0;
}

const dp_records *dp_source_records(const dp_source *source) { return &source->records; }

void dp_source_lend(dp_source *source, dp_threads *threads) {
    if (source->lend) source->lend(source->callbacks.user, threads);
}

bool dp_source_part(const dp_source *source, uint32_t group, uint32_t *part) {
    if (!source->part_of_group) return false;
    *part = source->part_of_group(source->callbacks.user, group);
    return true;
}

const dp_allocator *dp_source_memory(const dp_source *source) { return &source->allocator; }

bool dp_source_rewindable(const dp_source *source) { return source && source->callbacks.rewind; }

const char *dp_source_group_name(const dp_source *source, uint32_t group) {
    if (!source || !source->callbacks.group_name) return NULL;
    return source->callbacks.group_name(source->callbacks.user, group);
}

uint32_t dp_source_group_color(const dp_source *source, uint32_t group) {
    if (!source || !source->callbacks.group_color) return 0;
    return source->callbacks.group_color(source->callbacks.user, group);
}

const char *dp_source_remark(const dp_source *source) {
    if (!source || !source->callbacks.remark) return NULL;
    return source->callbacks.remark(source->callbacks.user);
}

const char *dp_source_color_remark(const dp_source *source) {
    if (!source || !source->callbacks.color_remark) return NULL;
    return source->callbacks.color_remark(source->callbacks.user);
}

bool dp_source_up(const dp_source *source, double up[3]) {
    static const dp_source_callbacks unknown = {0};
    const dp_source_callbacks *const c = source ? &source->callbacks : &unknown;
    const double length = sqrt(c->up[0] * c->up[0] + c->up[1] * c->up[1] + c->up[2] * c->up[2]);
    const bool known = length > 0 && isfinite(length);
    for (int k = 0; k < 3; k++) up[k] = known ? c->up[k] / length : k == 1;
    return known && !c->up_assumed;
}

void dp_source_destroy(dp_source *source) {
    if (!source) return;
    const dp_allocator memory = source->allocator;
    if (source->callbacks.destroy) source->callbacks.destroy(source->callbacks.user);
    dp_free(&memory, source);
}
