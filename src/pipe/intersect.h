/* Watching for intersections while faces are drawn (intersect.c). */
#ifndef DP_PIPE_INTERSECT_H
#define DP_PIPE_INTERSECT_H

#include "pipe/tile.h"

/* A crossing is looked for this far around a sample, px: beyond the next sample on the other side. */
static inline float dp_watch_px(const dp_tile_worker *w) { return w->sampling.samples == 1 ? 1.5f : 0.75f; }

/* … or where the gap in depth is less than this many pixel sizes: the other polygon may be the steep one. */
#define DP_WATCH_GAP 8

static inline float dp_watch_reach(const dp_tile_worker *w, const dp_tile_polygon *p) {
    return dp_watch_px(w) * (fabsf(p->dx) + fabsf(p->dy)) +
           (float)fabs(dp_depth_step(&w->frame->view, p->nearest, DP_WATCH_GAP));
}

#endif
