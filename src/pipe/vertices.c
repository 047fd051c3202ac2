/* Vertex transformation: world space to screen space, and a key that names the position.
 *
 * A vertex that lies outside the guarded frustum (behind the near plane, say) or is not finite has
 * x = NaN; polygons that use it take the slow way through clipping (outline.c). */
#include "pipe/stages.h"

#include "base/hostile.h"

#include <string.h>

enum { BLOCK = DP_TUNED(16384, 5) };

static uint32_t mix(uint32_t h) {
    h ^= h >> 16;
    h *= 0x7feb352du;
    h ^= h >> 15;
    h *= 0x846ca68bu;
    return h ^ (h >> 16);
}

/* Equal positions get equal keys; adding 0 makes -0 and 0 one. */
static uint32_t position_key(const float p[3]) {
    const float q[3] = {p[0] + 0.0f, p[1] + 0.0f, p[2] + 0.0f};
    uint32_t b[3];
    memcpy(b, q, sizeof b);
    return mix(b[0] * 0x9e3779b1u + mix(b[1] * 0x85ebca77u + mix(b[2])));
}

static dp_vertex transform(const dp_view *view, const float p[3]) {
    dp_vertex out = {NAN, 0, 0, position_key(p)};
    const dp_clip_point c = dp_to_clip(view, dp_v3f(p));
    if (dp_outcode(view, c) || !isfinite(c.x + c.y + c.w)) return out;
    const dp_pointd s = dp_to_screen(view, c);
    out.x = (float)s.x, out.y = (float)s.y, out.d = (float)s.d;
    return out;
}

static void transform_block(void *arg, uint32_t index, uint32_t worker) {
    const dp_frame *const frame = arg;
    (void)worker;
    const uint32_t first = index * BLOCK, count = frame->polygons.vertex_count;
    const uint32_t last = count - first < BLOCK ? count : first + BLOCK;
    for (uint32_t v = first; v < last; v++)
        frame->vertices[v] = transform(&frame->view, dp_vertex_position(&frame->polygons, v));
}

void dp_transform_vertices(dp_frame *frame) {
    const uint32_t count = frame->polygons.vertex_count;
    dp_parallel(frame->threads, count / BLOCK + (count % BLOCK != 0), transform_block, frame);
}
