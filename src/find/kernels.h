/* The kernels that find lines in a tile. */
#ifndef DP_FIND_KERNELS_H
#define DP_FIND_KERNELS_H

#include "core/view.h"
#include "base/kernels.h"

struct dp_intersecting;
struct dp_fold_batch;
struct dp_probes;
struct dp_spine;
struct dp_tile;
struct dp_finder;

typedef struct dp_find_kernels {
    /* Appends the edges of the tile's seen triangles to its list, but for those that end at flat
     * vertices, or on contours and are flat (one-rings.inc); makes normals that are not known, and
     * lists others that are to be made (edges.inc). */
    void (*list_edges)(struct dp_finder *worker);
    /* Unmarks edges whose pair of polygons is flat; false where one has two that do not belong
     * together (edges.inc). */
    bool (*flatten)(struct dp_finder *worker);
    /* Unmarks edges that no second polygon met and that lie hidden (edges.inc). */
    void (*unmark_alone)(struct dp_finder *worker);
    /* Normals and spines of the first `count` edges of a batch (folds.inc). */
    void (*folds)(const dp_view *view, struct dp_fold_batch *batch, uint32_t count);
    /* Makes the sample points [k0, k1) of a spine, from number `at` on, with room for a vector more
     * (points.inc). */
    void (*points)(const struct dp_finder *worker, const struct dp_spine *spine, uint32_t k0,
                   uint32_t k1, const struct dp_probes *out, uint32_t at);
    /* Finds which pixels show a back face, of those asked for and some others (meet.inc). */
    void (*show_backs)(const struct dp_finder *worker, const uint64_t *asked, uint64_t *out);
    /* Lists the numbers of seen polygons that may come near candidate pixels, in `list`, with room for a
     * vector more; returns how many (meet.inc). */
    uint32_t (*come_near)(const struct dp_finder *worker, const uint32_t *cells, uint32_t *list);
    /* Lists in intersection candidates->met those of the intersection candidates in (self, end) whose bounds meet its, but for
     * neighbours and triangles on one side of each other; returns how many (meet.inc). */
    uint32_t (*meet)(const struct dp_intersecting *intersecting, uint32_t self, uint32_t end);
    /* Hides the tile's grouped sample points that lie behind a seen polygon (hide.inc). */
    void (*hide)(struct dp_finder *worker);
    /* The number of the first seen polygon from `from` on whose box holds pixel (x, y) of the tile;
     * seen_count where there is none (next_at.inc). */
    uint32_t (*next_at)(const struct dp_tile *tile, uint32_t from, uint32_t x, uint32_t y);
} dp_find_kernels;

DP_KERNEL_TABLES(dp_find_kernels);

#endif
