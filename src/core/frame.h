/* What one drawing works on. draw.c fills it stage by stage; later stages read it. */
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

/* A transformed vertex: 16 bytes, so a triangle's corners take at most three cache lines. */
typedef struct dp_vertex {
    float x, y, d; /* screen space; x is NaN if the vertex must be clipped or is not finite */
    uint32_t key;  /* hash of the position: equal positions have equal keys */
} dp_vertex;

static inline dp_point dp_place(dp_vertex v) { return (dp_point){v.x, v.y, v.d}; }

/* True if a triangle must be clipped (some x is NaN). */
static inline bool dp_needs_clipping(dp_vertex a, dp_vertex b, dp_vertex c) {
    const float sum = a.x + b.x + c.x;
    return sum != sum;
}

typedef struct dp_frame {
    const dp_allocator *memory;
    dp_threads *threads;
    uint32_t lanes;       /* width of the kernels in use (base/kernels.h) */
    double origin[3];     /* of the polygons' positions, world space (dp_batch) */
    dp_view view;         /* of positions: what it calls world space begins at the origin */
    float nearly_edge_on; /* px: thinner polygons' facing is decided in space (outline.h) */
    float step_scale, step_offset; /* pixel size in depth: |d| * step_scale + step_offset */
    float touching, crack; /* pixel sizes by which planes that touch an edge may miss it; px: cracks
                              narrower than this are closed (core/precision.c) */
    double precision;      /* world units: thinner polygons are rounding; 0: none is known */
    const dp_style *styles; /* [style_count], resolved: the picture's, then those of groups */
    uint32_t style_count;
    dp_target target;
    uint32_t lines;   /* classes drawn by any group */
    bool exact_ends;  /* the first style's; not where the source is streamed. What lines there are
                           is then decided more finely too, where a clean mesh needs that */
    bool culls_backs; /* hidden back faces make no lines */
    uint32_t hidden;  /* levels of hidden lines; 0: they are not looked for */
    dp_hidden_look hidden_look; /* theirs */
    bool hidden_smooth;         /* smooth folds, too (find/hidden.c) */
    uint32_t xray; /* layers of surfaces that are seen through, at most; 0: the nearest is all */
    bool painted_later; /* src/shade colours all pixels of tiles with polygons, paper too, … */
    uint8_t *ink_layer; /* … and blends over them what tiles inked: [height][width][4], not
                           premultiplied; or NULL */
    float flat_cosine;  /* cosine: normals closer than this make no fold in any group; 0 to 2, above
                           1: unknown */

    dp_polygons polygons;
    dp_vertex *vertices;
    size_t vertices_cap;
    uint32_t tiles_x, tiles_y;
    dp_bins polygon_bins;
    dp_bins mark_bins; /* of polygons.marks, while there are some */

    const struct dp_adjacency *adjacency; /* mesh/adjacency.h; NULL: lines are found without it */
    float fin_reach; /* px: how far printed silhouettes reach beyond outlined polygons; 0: none */
    uint8_t *facing; /* with adjacency, by polygon: core/facing.h */
    double centre[2], radius; /* px: for polar stroke textures (features/silhouette_edge.h) … */
    double middle_pixel;   /* … and for patterns: pixel size in the middle of the model's box */
    bool any_without_area; /* some polygons have no area */
    uint8_t *outlined;     /* by polygon: does dp_outline_of_edge find an edge that it draws? */

    float *depth; /* [tile][sample]: nearest surface; layout in raster/samples.h */
    size_t tile_samples;
    struct dp_tile_pieces *tile_pieces; /* by tile (core/piece.h) */
    uint32_t *closed; /* with exact_ends, by the upper bits of vertices' keys: core/closed.h */
    uint32_t *rings;  /* the same by vertex, before those at one place are added up */
    uint32_t closed_shift;
    size_t depth_cap, tile_pieces_cap, facing_cap, outlined_cap, closed_cap, rings_cap;
} dp_frame;

/* Frees the arrays that the frame owns (vertices, depth, bins, …); not what it borrows. */
void dp_frame_free(dp_frame *frame, const dp_allocator *memory);
uint64_t dp_frame_bytes(const dp_frame *frame);

/* Where tiles put the ink of pixel (x, y); needs target.rgba. */
static inline uint8_t *dp_ink_place(const dp_frame *f, uint32_t x, uint32_t y) {
    return f->ink_layer ? f->ink_layer + 4 * ((size_t)y * f->target.width + x)
                        : f->target.rgba + (size_t)y * f->target.rgba_stride + 4 * (size_t)x;
}

/* Which of the frame's styles a group has: one of its own, or the picture's. */
static inline uint32_t dp_style_number(const dp_frame *frame, uint32_t group) {
    return group + 1 < frame->style_count ? group + 1 : 0;
}

static inline const dp_style *dp_polygon_style(const dp_frame *frame, uint32_t polygon) {
    const uint32_t group = frame->polygons.groups ? frame->polygons.groups[polygon] : 0;
    return &frame->styles[dp_style_number(frame, group)];
}

/* Has a section's face a colour of its own in any group? */
static inline bool dp_colors_sections(const dp_frame *frame) {
    bool any = false;
    for (uint32_t i = 0; i < frame->style_count; i++) any |= frame->styles[i].section != 0;
    return any && frame->polygons.has_diagonals;
}

/* The opacity of a polygon's surface. A mirror shows its own picture. */
static inline float dp_opacity_of(const dp_frame *frame, uint32_t polygon) {
    const bool mirror =
        frame->polygons.groups && frame->polygons.groups[polygon] == DP_MIRROR_GROUP;
    const float xray = dp_polygon_style(frame, polygon)->xray;
    return xray > 0 && !mirror ? xray : 1;
}

/* Classes with an outside: outlines. */
enum { DP_OUTLINES = DP_SILHOUETTE | DP_BORDER };

/* Does the picture draw textured silhouettes as printed (printed/fins.c)? If not, the same
 * triangles are put beside visible pieces of lines. */
static inline bool dp_draws_fins(const dp_frame *frame) {
    const dp_style *const s = &frame->styles[0];
    return frame->adjacency && s->ink == DP_INK_QUADS && s->method == DP_METHOD_PAPER;
}

#endif
