/* Vertex transformation: world space to screen space, and a key that stands for the position.
 *
 * Invariant: x is NaN of a vertex that is not finite or lies outside the guarded frustum (behind
 * the near plane, for instance). Polygons with such a vertex are clipped one by one
 * (core/outline.c). */
#include "raster/stages.h"

#include "base/hostile.h"
#include "raster/kernels.h"

enum { BLOCK_LEAST = DP_TUNED(512, 5), BLOCK_MOST = DP_TUNED(16384, 5) };

static uint32_t block_size(const dp_frame *frame) {
    return dp_task_size(frame->polygons.vertex_count, BLOCK_LEAST, BLOCK_MOST);
}

/* Vertices that take this many bytes have left a processor's own caches before they are read, and
 * at least half of them are read by other processors. */
static const size_t LARGE = DP_TUNED(2 << 20, 64);

static bool are_read_elsewhere(const dp_frame *frame) {
    return dp_threads_count(frame->threads) > 1 &&
           frame->polygons.vertex_count * sizeof *frame->vertices >= LARGE;
}

static void transform_block(void *arg, uint32_t index, uint32_t worker) {
    const dp_frame *const frame = arg;
    (void)worker;
    const uint32_t size = block_size(frame), first = index * size,
                   count = frame->polygons.vertex_count;
    const uint32_t last = count - first < size ? count : first + size;
    dp_raster_kernels_for(frame->lanes)
        ->transform(&frame->view, dp_vertex_position(&frame->polygons, first),
                    frame->polygons.stride, last - first, frame->vertices + first,
                    are_read_elsewhere(frame));
}

void dp_transform_vertices(dp_frame *frame) {
    const uint32_t count = frame->polygons.vertex_count, size = block_size(frame);
    dp_parallel(frame->threads, count / size + (count % size != 0), transform_block, frame);
}
