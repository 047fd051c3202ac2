/* Polygons as ink: what quads.c draws, how its samples are tested (quads_fill.c, printed/ink.inc),
 * and what becomes of them in the picture (quads_put.c). */
#ifndef DP_PRINTED_QUADS_H
#define DP_PRINTED_QUADS_H

#include "raster/coverage.h"
#include "features/features.h"
#include "raster/tile.h"

/* A worker's scratch for polygons as ink. */
typedef struct dp_printer {
    dp_tile *tile;
    uint32_t *ink; /* by sample: what it holds (quads.c), its depth, the stencil buffer */
    float *ink_depth;
    uint8_t *stencil;
    dp_vec3 *world; /* corners of one polygon */
    dp_clip_point *clip;
    struct dp_screen_edge *screen_edges;
    size_t ink_cap, ink_depth_cap, stencil_cap, world_cap, clip_cap, screen_edges_cap;
} dp_printer;

void dp_printer_free(dp_printer *printer, const dp_allocator *memory);
uint64_t dp_printer_bytes(const dp_printer *printer);

/* Instead of edges, intersections and probes: the added polygons are the ink (quads.c). */
void dp_tile_quads(dp_printer *printer);

/* Depth d farther by some pixel sizes, as scale * d + offset: a pixel grows with distance in
 * perspective. */
typedef struct dp_step {
    float scale, offset;
} dp_step;

/* What the kernel does with samples that are covered. */
typedef enum dp_ink_test {
    DP_INK_NEAREST, /* inks what is nearer than surface and ink */
    DP_INK_JOINT,   /* asks about the same (dp_quads_ask); only of triangles */
    DP_INK_TRAPPED  /* asks about what lies behind another polygon's surface, but close to it */
} dp_ink_test;

/* How one class of lines of one polygon is drawn. */
typedef struct dp_brush {
    dp_printer *w;
    dp_ink_test test;
    uint32_t ink;
    uint32_t self;    /* tile polygon */
    dp_plane plane;   /* of what is drawn */
    float reach;      /* px, plane test */
    dp_point root[2]; /* the same: what an added polygon grows from */
    dp_step trap;     /* how far behind the surface still counts */
    dp_step nearer;   /* stencil: how far it is moved towards the eye */
    bool face, intersections;
    uint32_t other; /* intersections: the last polygon asked about, and the answer */
    bool meets;
} dp_brush;

/* A convex polygon of four corners, or three, ready to be filled: edges as in coverage.h; the box
 * is px, inclusive. */
typedef struct dp_ink_shape {
    dp_f4 a, b, c, threshold;
    uint8_t box[4];
    uint32_t corners;
} dp_ink_shape;

/* Ink of an added polygon that is as good as a face: not trapped behind one. */
#define DP_INK_ADDED (1u << 31)

static inline uint32_t dp_ink_of(dp_line line, uint32_t group) {
    const bool trapped = line == DP_LINE_VALLEY || line == DP_LINE_INTERSECTION;
    return (trapped ? 0 : DP_INK_ADDED) | (line + 1u) << 16 | group;
}
static inline dp_line dp_ink_line(uint32_t ink) { return (dp_line)((ink >> 16 & 7) - 1); }
static inline uint32_t dp_ink_group(uint32_t ink) { return ink & 0xffff; }

/* Draws a convex polygon in tile space: n points, with the brush's plane as depth. */
typedef void dp_fill(dp_brush *brush, const dp_point *points, uint32_t n);

/* Over the finished faces: the nearest wins; the same for the joints of ridges; and the
 * between-test of planes. */
dp_fill dp_fill_line, dp_fill_joint, dp_fill_between_planes;
/* The paper's two depth buffers. */
dp_fill dp_fill_interval, dp_fill_trap_in_interval;
/* The stencil buffer. */
dp_fill dp_fill_count_down, dp_fill_count_up;

/* Takes the samples lane + i with bit i set, whose depth on the brush's plane is d[i]: the kernel's
 * test is true of them, and what is left to be tested takes a look at the polygon that won them. */
void dp_quads_ask(dp_brush *brush, size_t lane, uint32_t bits, const float *d);

/* The tile's ink to the target (quads_put.c). */
void dp_quads_put(dp_printer *worker);

#endif
