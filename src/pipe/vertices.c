/* Vertex transformation: world space to screen space, and a key that names the position.
 *
 * A vertex that lies outside the guarded frustum (behind the near plane, say) or is not finite has
 * x = NaN; polygons that use it take the slow way through clipping (outline.c). */
#include "pipe/stages.h"

#include "base/hostile.h"
#include "kernel/kernels.h"

enum { BLOCK = DP_TUNED(16384, 5) };

/* Vertices that take so many bytes or more have left a processor's own caches before they are read,
 * most of them by another processor. */
static const size_t LARGE = DP_TUNED(2 << 20, 64);

static void transform_block(void *arg, uint32_t index, uint32_t worker) {
    const dp_frame *const frame = arg;
    (void)worker;
    const uint32_t first = index * BLOCK, count = frame->polygons.vertex_count;
    const uint32_t last = count - first < BLOCK ? count : first + BLOCK;
    frame->kernels->transform(&frame->view, dp_vertex_position(&frame->polygons, first),
                              frame->polygons.stride, last - first, frame->vertices + first,
                              count * sizeof *frame->vertices >= LARGE);
}

void dp_transform_vertices(dp_frame *frame) {
    const uint32_t count = frame->polygons.vertex_count;
    dp_parallel(frame->threads, count / BLOCK + (count % BLOCK != 0), transform_block, frame);
}
