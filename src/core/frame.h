/* What one drawing works on: filled stage by stage by draw.c, read by every later stage. */
#ifndef DP_CORE_FRAME_H
#define DP_CORE_FRAME_H

#include "base/hostile.h"
#include "base/memory.h"
#include "base/threads.h"
#include "mesh/polygons.h"
#include "core/bin.h"
#include "core/view.h"
#include <drypoint/draw.h>

enum { DP_TILE = DP_TUNED(64, 16) /* px; a row of a tile is one 64-bit mask */ };

/* A vertex after transformation; 16 bytes, so that a triangle's corners take three cache lines at
 * most. */
typedef struct dp_vertex {
    float x, y, d; /* screen space; x is NaN where the vertex must be clipped or is not finite */
    uint32_t key;  /* hash of the position's bits: equal positions have equal keys */
} dp_vertex;

static inline dp_point dp_place(dp_vertex v) { return (dp_point){v.x, v.y, v.d}; }

/* True where a triangle's corners must go through clipping (x is NaN). */
static inline bool dp_needs_clipping(dp_vertex a, dp_vertex b, dp_vertex c) {
    const float sum = a.x + b.x + c.x;
    return sum != sum;
}

typedef struct dp_frame {
    const dp_allocator *memory;
    dp_threads *threads;
    uint32_t lanes; /* of the vectors that kernels use (base/kernels.h) */
    dp_view view;
    float
        nearly_edge_on; /* px: a polygon this thin on the screen needs a second look (outline.h) */
    float step_scale, step_offset; /* depth over one pixel size is d * step_scale + step_offset */
    const dp_style *styles;        /* by group, resolved; [style_count] */
    uint32_t style_count;
    dp_target target;
    uint32_t lines;     /* classes that any group draws */
    bool culls_backs;   /* back faces that are hidden make no lines */
    bool painted_later; /* shading gives every pixel of a tile that holds polygons its colour, paper
                           too … */
    uint8_t *ink_layer; /* … and lays over it what tiles inked already: [height][width][4], not
                           premultiplied; or NULL */
    float flat_cosine;  /* normals closer than this make no fold, whatever the group; 0 to 2, above
                           1: unknown */

    dp_polygons polygons;
    dp_vertex *vertices;
    size_t vertices_cap;
    uint32_t tiles_x, tiles_y;
    dp_bins polygon_bins;

    const struct dp_adjacency *adjacency; /* mesh/adjacency.h; NULL: lines emerge without it */
    float fin_reach; /* px that textured silhouettes reach beyond outlined polygons; 0: none */
    uint8_t *facing; /* with adjacency, by polygon: core/facing.h */
    double centre[2], radius; /* px, polar stroke textures: features/silhouette_edge.h */
    bool seen_through;        /* some polygons have no area */
    uint8_t *outlined;        /* the same: has it an edge that dp_outline_of_edge says it draws? */

    float *depth; /* [tile][cell sample], nearest surface; layout: samples.h */
    size_t tile_samples;
    struct dp_tile_pieces *tile_pieces; /* by tile: core/piece.h */
    size_t depth_cap, tile_pieces_cap, facing_cap, outlined_cap;

    struct dp_stylized
        *stylized; /* instead of strokes, where lines are stylized: strokes/stylized.h */
    size_t stylized_count;
    dp_bins stroke_bins;
} dp_frame;

/* The arrays that the frame owns: vertices, depth, bins, …; not what is borrowed. */
void dp_frame_free(dp_frame *frame, const dp_allocator *memory);
uint64_t dp_frame_bytes(const dp_frame *frame);

/* Where tiles put their ink; needs target.rgba. */
static inline uint8_t *dp_ink_place(const dp_frame *f, uint32_t x, uint32_t y) {
    return f->ink_layer ? f->ink_layer + 4 * ((size_t)y * f->target.width + x)
                        : f->target.rgba + (size_t)y * f->target.rgba_stride + 4 * (size_t)x;
}

static inline const dp_style *dp_polygon_style(const dp_frame *frame, uint32_t polygon) {
    const uint32_t group = frame->polygons.groups ? frame->polygons.groups[polygon] : 0;
    return &frame->styles[group < frame->style_count ? group : 0];
}

/* Classes that have an outside. */
enum { DP_OUTLINES = DP_SILHOUETTE | DP_BORDER };

/* Is the picture drawn so? Else the same geometry lies beside visible pieces of lines
 *. */
static inline bool dp_draws_fins(const dp_frame *frame) {
    const dp_style *const s = &frame->styles[0];
    return frame->adjacency && s->ink == DP_INK_QUADS && s->method == DP_METHOD_PAPER;
}

#endif
