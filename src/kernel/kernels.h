/* The kernels: loops over many vertices, polygons or samples, for several kinds of processors.
 *
 * Each is written once, in the .inc files, on vectors whose width is a constant (lanes.h), and
 * compiled for each width in plain.c, base.c, avx2.c and avx512.c. Plain C is the truth: the others
 * do the same operations in the same order and give the same bits (tests/unit/test_kernels.c). */
#ifndef DP_KERNEL_KERNELS_H
#define DP_KERNEL_KERNELS_H

#include "core/view.h"
#include <drypoint/style.h>

struct dp_tile_worker;
struct dp_tile_polygon;
struct dp_vertex;
struct dp_crowd;
struct dp_fold_batch;
struct dp_spine;
struct dp_probes;
struct dp_segment_batch;
struct dp_frame;
struct dp_tile_rect;
struct dp_brush;
struct dp_ink_shape;
struct dp_stroke;
struct dp_ink_patch;
struct dp_ink_worker;
struct dp_chunk;
struct dp_triangles;
struct dp_chunk_view;

/* A rectangle's x0 where the kernel leaves the polygon to the general way. */
#define DP_UNPLACED INT16_MIN

typedef struct dp_kernels {
    const char *name; /* "plain", "base", "avx2", "avx512" */
    uint32_t lanes;
    /* `count` positions, `stride` bytes apart, to the screen (transform.inc, raster/vertices.c).
     * `past_caches`: others will read most of it, or it is too much for caches to hold till then.
     */
    void (*transform)(const dp_view *view, const float *positions, size_t stride, uint32_t count,
                      struct dp_vertex *out, bool past_caches);
    /* Which tiles the frame's triangles [first, first + count) reach, widened by margin px
     * (place.inc). */
    void (*place)(const struct dp_frame *frame, float margin, uint32_t first, uint32_t count,
                  struct dp_tile_rect *rects);
    /* Parts a bin's entries: front faces go to ids[*count] and on, back faces to the others
     * (place.inc). */
    void (*part)(const uint32_t *entries, uint32_t n, uint32_t *ids, uint32_t *count,
                 uint32_t *backs, uint32_t *back_count);
    /* Appends triangles to the tile's polygons, planes and boxes made, and draws front faces, or
     * else back faces that are not hidden (assemble.inc). */
    void (*assemble)(struct dp_tile_worker *worker, const uint32_t *ids, uint32_t count,
                     bool backs);
    /* Keeps those triangles that the tile's front faces do not hide; returns how many
     * (cull.inc). */
    uint32_t (*cull)(struct dp_tile_worker *worker, uint32_t *ids, uint32_t count);
    /* Lists those of the tile's polygons that are not hidden, and flags the others; all unless
     * `culling` (cull.inc). */
    void (*see)(struct dp_tile_worker *worker, bool culling);
    /* Draws one convex polygon into the tile's samples (raster.inc). */
    void (*raster)(struct dp_tile_worker *worker, const struct dp_tile_polygon *polygon,
                   uint32_t index);
    /* The unit normals of the tile's unsure triangles (normals.inc). */
    void (*normals)(struct dp_tile_worker *worker);
    /* Appends the edges of the tile's seen triangles to its list, but for those that end at calm
     * vertices, or on rims and are flat (umbrellas.inc); makes normals that are not known, and
     * lists others that are to be made (edges.inc). */
    void (*list_edges)(struct dp_tile_worker *worker);
    /* Unmarks edges whose pair of polygons is flat; false where one has two that do not belong
     * together (edges.inc). */
    bool (*flatten)(struct dp_tile_worker *worker);
    /* Unmarks edges that no second polygon met and that lie hidden (edges.inc). */
    void (*unmark_alone)(struct dp_tile_worker *worker);
    /* Normals and spines of the first `count` edges of a batch (folds.inc). */
    void (*folds)(const dp_view *view, struct dp_fold_batch *batch, uint32_t count);
    /* Makes the sample points [k0, k1) of a spine, from number `at` on, with room for a vector more
     * (points.inc). */
    void (*points)(const struct dp_tile_worker *worker, const struct dp_spine *spine, uint32_t k0,
                   uint32_t k1, const struct dp_probes *out, uint32_t at);
    /* Ends and planes of the first `count` segments of a batch (segments.inc). */
    void (*segments)(const dp_view *view, struct dp_segment_batch *batch, uint32_t count);
    /* Keeps of the tile's close samples those at which both polygons' planes cross, one of which is
     * a front face, and which, if they are triangles, share no corner (meet.inc). */
    void (*cross)(struct dp_tile_worker *worker);
    /* Finds which pixels show a back face, of those asked for and some others (meet.inc). */
    void (*show_backs)(const struct dp_tile_worker *worker, const uint64_t *asked, uint64_t *out);
    /* Lists the numbers of seen polygons that may come near suspects, in `list`, with room for a
     * vector more; returns how many (meet.inc). */
    uint32_t (*come_near)(const struct dp_tile_worker *worker, const uint32_t *cells,
                          uint32_t *list);
    /* Lists in crowd->met those of the crowd in (self, end) whose bounds meet its, but for
     * neighbours and triangles on one side of each other; returns how many (meet.inc). */
    uint32_t (*meet)(const struct dp_crowd *crowd, uint32_t self, uint32_t end);
    /* Hides the tile's grouped sample points that lie behind a seen polygon (hide.inc). */
    void (*hide)(struct dp_tile_worker *worker);
    /* Inks with an added polygon, where the brush's test is true (ink.inc). */
    void (*ink)(struct dp_brush *brush, const struct dp_ink_shape *shape);
    /* Covers a patch of a tile with a stroke, where that covers more than what did before
     * (cover.inc). */
    void (*cover)(const struct dp_frame *frame, const struct dp_stroke *stroke,
                  const struct dp_ink_patch *patch, struct dp_ink_worker *worker);
    /* Lays ink over pixels of a row of a tile, of which `width` lie in the picture (cover.inc). */
    void (*lay)(uint8_t *row, uint32_t width, const float *coverage, uint64_t pixels,
                dp_color color);
    /* Sets state and edge keys of a chunk's triangles, and lists those that are left to the general
     * way: in the first reading, with their normals, and in the second (sift.inc,
     * stream/sift.c). */
    void (*sift)(struct dp_chunk *chunk, const struct dp_triangles *triangles,
                 const struct dp_chunk_view *view);
    void (*touch)(struct dp_chunk *chunk, const struct dp_triangles *triangles,
                  const struct dp_chunk_view *view);
} dp_kernels;

extern const dp_kernels dp_kernels_plain, dp_kernels_base, dp_kernels_avx2, dp_kernels_avx512;

enum { DP_KERNELS_MAX = 4 };

/* Those that this processor runs, slowest first. Returns how many. */
uint32_t dp_kernels_list(const dp_kernels *list[DP_KERNELS_MAX]);

/* The fastest of them. In builds with tests, the environment's DRYPOINT_CPU names another. */
const dp_kernels *dp_kernels_best(void);

#endif
