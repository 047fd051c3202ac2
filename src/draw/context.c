/* A context: what it is made of, and its memory. Every stage's scratch is a struct of its own that
 * is freed and counted in the stage's folder; here they are put together.
 *
 * Invariant: dp_context_bytes is what the allocator has given to the context and not got back, to
 * the byte, whenever no stage runs. What dp_draw takes for its own duration (the sources of a
 * mirror) is not counted, but for a streamed drawing's memory, which is there until the picture is
 * done. */
#include "draw/context.h"

#include "base/diag.h"

#include <stdio.h>
#include <string.h>

static void *noted(dp_context *c, void *block, size_t size) {
    if (!block) atomic_store(&c->refused, size);
    return block;
}

static void *pass_alloc(size_t size, void *user) {
    dp_context *const c = user;
    return noted(c, c->given.alloc(size, c->given.user), size);
}

static void *pass_realloc(void *block, size_t size, void *user) {
    dp_context *const c = user;
    return noted(c, c->given.realloc(block, size, c->given.user), size);
}

static void pass_free(void *block, void *user) {
    const dp_context *const c = user;
    c->given.free(block, c->given.user);
}

/* One of each for every worker. */
static bool make_workers(dp_context *c) {
    const dp_allocator *const memory = &c->memory;
    c->workers = dp_threads_count(c->threads);
    c->bin_workers = dp_alloc_zeroed(memory, c->workers * sizeof *c->bin_workers);
    c->finders = dp_alloc_zeroed(memory, c->workers * sizeof *c->finders);
    c->printers = dp_alloc_zeroed(memory, c->workers * sizeof *c->printers);
    c->found = dp_alloc_zeroed(memory, c->workers * sizeof *c->found);
    return c->bin_workers && c->finders && c->printers && c->found &&
           dp_raster_init(&c->raster, c->workers, memory);
}

static void free_workers(dp_context *c) {
    const dp_allocator *const memory = &c->memory;
    for (uint32_t i = 0; i < c->workers; i++) {
        if (c->bin_workers) dp_bin_worker_free(&c->bin_workers[i], memory);
        if (c->finders) dp_finder_free(&c->finders[i]);
        if (c->printers) dp_printer_free(&c->printers[i], memory);
        if (c->found) dp_found_free(&c->found[i], memory);
    }
    dp_free(memory, c->bin_workers);
    dp_free(memory, c->finders);
    dp_free(memory, c->printers);
    dp_free(memory, c->found);
    dp_raster_free(&c->raster, memory);
}

static uint64_t workers_bytes(const dp_context *c) {
    uint64_t sum = c->workers * (uint64_t)(sizeof *c->bin_workers + sizeof *c->finders +
                                           sizeof *c->printers + sizeof *c->found);
    for (uint32_t i = 0; i < c->workers; i++)
        sum += dp_bin_worker_bytes(&c->bin_workers[i]) + dp_finder_bytes(&c->finders[i]) +
               dp_printer_bytes(&c->printers[i]) + dp_found_bytes(&c->found[i]);
    return sum + dp_raster_bytes(&c->raster);
}

dp_result dp_context_create(const dp_context_desc *desc, dp_context **out, dp_diag *diag) {
    if (!out) return dp_fail(diag, DP_ERR_ARGUMENT, "dp_context_create: out is NULL");
    *out = NULL;
    const dp_context_desc d = desc ? *desc : (dp_context_desc){0};
    if (d.memory && d.memory < DP_MEMORY_LEAST)
        return dp_fail(diag, DP_ERR_ARGUMENT,
                       "%zu bytes of memory are too few; the least is %zu MB", d.memory,
                       DP_MEMORY_LEAST >> 20);
    const dp_allocator memory = dp_allocator_resolve(d.allocator);
    dp_context *const c = dp_alloc_zeroed(&memory, sizeof *c);
    if (!c) return dp_fail(diag, DP_ERR_MEMORY, "out of memory for a context");
    c->given = memory;
    c->memory = (dp_allocator){pass_alloc, pass_realloc, pass_free, c};
    c->limit = d.memory ? d.memory : DP_MEMORY_DEFAULT;
    c->progress = d.progress;
    c->share_to = 1;
    c->user = d.user;
    const dp_result started =
        dp_threads_start(d.threads, d.parallel_for, d.user, &c->memory, &c->threads);
    if (started || !make_workers(c)) {
        dp_context_destroy(c);
        return started == DP_ERR_LIMIT
                   ? dp_fail(diag, DP_ERR_LIMIT, "the system starts no more threads: ask for fewer")
                   : dp_fail(diag, DP_ERR_MEMORY, "out of memory for a context");
    }
    *out = c;
    return DP_OK;
}

void dp_context_destroy(dp_context *c) {
    if (!c) return;
    const dp_allocator memory = c->memory;
    dp_threads_destroy(c->threads);
    free_workers(c);
    dp_frame_free(&c->frame, &memory);
    dp_free(&memory, c->styles);
    dp_polygon_store_free(&c->polygons, &memory);
    dp_normal_store_free(&c->normals, &memory);
    dp_smooth_store_free(&c->smooth, &memory);
    dp_adjacency_free(&c->adjacency, &memory);
    dp_lines_free(&c->drawing, &memory);
    dp_lines_free(&c->once, &memory);
    dp_pool_free(&c->once_scratch, &memory);
    dp_detail_store_free(&c->detail, &memory);
    dp_shade_store_free(&c->shade, &memory);
    dp_xray_free(&c->xray, &memory);
    dp_mirror_store_free(&c->mirror, &memory);
    dp_recording_free(c->recording, &memory);
    dp_free(&memory, c);
}

dp_result dp_context_settle(dp_context *c, dp_result result, dp_diag *diag) {
    const size_t refused = atomic_exchange(&c->refused, 0);
    c->stats.bytes = dp_context_bytes(c);
    if (result != DP_ERR_MEMORY || !diag || !refused) return result;
    const size_t length = strlen(diag->message);
    snprintf(diag->message + length, sizeof diag->message - length,
             ": %zu bytes were asked for in vain; the context holds %llu", refused,
             (unsigned long long)c->stats.bytes);
    return result;
}

uint64_t dp_context_bytes(const dp_context *c) {
    return sizeof *c + dp_threads_bytes(c->threads) + workers_bytes(c) + dp_frame_bytes(&c->frame) +
           dp_polygon_store_bytes(&c->polygons) + dp_normal_store_bytes(&c->normals) +
           dp_smooth_store_bytes(&c->smooth) + dp_adjacency_bytes(&c->adjacency) +
           dp_lines_bytes(&c->drawing) + dp_lines_bytes(&c->once) + c->once_scratch.bytes +
           dp_detail_store_bytes(&c->detail) + dp_shade_store_bytes(&c->shade) +
           dp_xray_bytes(&c->xray) + dp_mirror_store_bytes(&c->mirror) +
           dp_recording_bytes(c->recording) + dp_stream_bytes(c->stream) +
           c->styles_cap * sizeof *c->styles;
}
