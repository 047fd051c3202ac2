/* Added polygons as ink: what is drawn (quads.c), how its samples are tested (quads_fill.c,
 * ink.inc), and how it is put into the picture (quads_put.c). */
#ifndef DP_PRINTED_QUADS_H
#define DP_PRINTED_QUADS_H

#include "raster/coverage.h"
#include "features/features.h"
#include "raster/tile.h"

/* A worker's scratch for added polygons as ink. */
typedef struct dp_printer {
    dp_tile *tile;
    uint32_t *ink; /* by sample: class and style (quads.c); below: its depth, the stencil buffer */
    float *ink_depth;
    uint8_t *stencil;
    dp_vec3 *world; /* of one polygon: its corners, and what is made of them */
    dp_clip_point *clip;
    struct dp_screen_edge *screen_edges;
    size_t ink_cap, ink_depth_cap, stencil_cap, world_cap, clip_cap, screen_edges_cap;

    /* With patterns or light (marks.h): `ink` holds numbers of marks, from 1 */
    bool marked;
    struct dp_mark *marks;
    struct dp_shown *shown; /* of those that samples show */
    dp_color *colors;       /* by sample */
    uint32_t *trapped;      /* by sample, stencil: the ink of a quad that is trapped there */
    float *rank;            /* by sample: px to what its ink grows from */
    size_t marks_cap, shown_cap, colors_cap, trapped_cap, rank_cap, mark_count, shown_count;
} dp_printer;

void dp_printer_free(dp_printer *printer, const dp_allocator *memory);
uint64_t dp_printer_bytes(const dp_printer *printer);

/* Draws a tile's lines as added polygons, instead of finding edges, intersections and sample points
 * (quads.c). */
void dp_tile_quads(dp_printer *printer);

/* Moves depth d away from the eye by some pixel sizes: scale * d + offset. In perspective a pixel
 * grows with distance. */
typedef struct dp_step {
    float scale, offset;
} dp_step;

/* What the kernel does with covered samples. */
typedef enum dp_ink_test {
    DP_INK_NEAREST, /* inks what is nearer than surface and ink */
    DP_INK_JOINT,   /* the same, but asks first (dp_quads_ask); triangles only */
    DP_INK_TRAPPED  /* asks about what is close behind another polygon's surface */
} dp_ink_test;

/* How one class of lines of one polygon is drawn. */
typedef struct dp_brush {
    dp_printer *w;
    dp_ink_test test;
    uint32_t ink;
    uint32_t self;            /* tile polygon */
    dp_plane plane;           /* of what is drawn: its depth */
    float reach;              /* px; plane test: how near the planes must cross */
    dp_point root[2];         /* plane test: the edge or corner that it grows from */
    dp_pointd screen_root[2]; /* with marks: the same on the screen */
    dp_step trap;             /* how far behind the surface still counts */
    dp_step nearer;           /* stencil: how far to move it towards the eye */
    bool face, intersections;
    uint32_t other; /* intersections: the last polygon asked about; meets: the answer */
    bool meets;
} dp_brush;

/* A convex polygon of three or four corners, ready to be filled: edge functions as in coverage.h,
 * box in px, inclusive. */
typedef struct dp_ink_shape {
    dp_f4 a, b, c, threshold;
    uint8_t box[4];
    uint32_t corners;
} dp_ink_shape;

/* Ink of a silhouette or ridge polygon, which stands before the surface: nothing is trapped behind
 * it. */
#define DP_INK_ADDED (1u << 31)

/* `style`: its number (dp_style_number), up to 65536. */
static inline uint32_t dp_ink_of(dp_line line, uint32_t style) {
    const bool trapped = line == DP_LINE_VALLEY || line == DP_LINE_INTERSECTION;
    return (trapped ? 0 : DP_INK_ADDED) | (line + 1u) << 17 | style;
}
static inline dp_line dp_ink_line(uint32_t ink) { return (dp_line)((ink >> 17 & 7) - 1); }
static inline uint32_t dp_ink_style(uint32_t ink) { return ink & 0x1ffff; }

/* With what a class of lines is drawn, and whether one polygon draws all of its width. */
dp_pen dp_quads_pen(const dp_style *style, dp_line line);
bool dp_quads_whole(const dp_style *style, dp_line line);
/* Fetches the corners of a tile polygon. False: out of memory. */
bool dp_quads_fetch(dp_printer *printer, uint32_t polygon, dp_primitive *out);

/* Fills a convex polygon of n points in tile space, with the brush's plane as depth. */
typedef void dp_fill(dp_brush *brush, const dp_point *points, uint32_t n);

/* Over the finished faces: the nearest wins; the same for joints of ridges; the between-test of
 * planes. */
dp_fill dp_fill_line, dp_fill_joint, dp_fill_between_planes;
/* The first two, and lines as dp_fill_interval has them, with marks: of polygons of one class at about one
 * depth that from whose edge the sample is least far (marks.h). */
dp_fill dp_fill_marked_line, dp_fill_marked_joint, dp_fill_marked_interval;
/* The two depth buffers (Raskar 2001, 2.3). */
dp_fill dp_fill_interval, dp_fill_trap_in_interval;
/* The stencil buffer (Raskar 2001, 7). */
dp_fill dp_fill_count_down, dp_fill_count_up;

/* Decides the samples lane + i with bit i set, whose depth on the brush's plane is d[i]. The
 * kernel's test of depths is true for them; the rest depends on the polygon that won the sample. */
void dp_quads_ask(dp_brush *brush, size_t lane, uint32_t bits, const float *d);

/* Puts the tile's ink into the target (quads_put.c). */
void dp_quads_put(dp_printer *worker);

#endif
