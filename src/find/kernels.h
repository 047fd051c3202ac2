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
    /* Appends the half-edges of the tile's seen triangles to the list, except those that end at a
     * flat vertex, and flat ones on contours (one_rings.inc). Makes normals that are unknown, and
     * lists triangles whose normals are unsure (edges.inc). */
    void (*list_edges)(struct dp_finder *worker);
    /* Unmarks pairs that are flat. Returns false if some pair is not one edge but two whose keys
     * agree in the compared bits (edges.inc). */
    bool (*flatten)(struct dp_finder *worker);
    /* Unmarks half-edges that no second polygon met and that are hidden (edges.inc). */
    void (*unmark_alone)(struct dp_finder *worker);
    /* Makes normals and spines of the first `count` edges of a batch (folds.inc). */
    void (*folds)(const dp_view *view, struct dp_fold_batch *batch, uint32_t count);
    /* Makes the sample points [k0, k1) of a spine, stored from index `at` on; writes up to a vector
     * beyond them (points.inc). */
    void (*points)(const struct dp_finder *worker, const struct dp_spine *spine, uint32_t k0,
                   uint32_t k1, const struct dp_probes *out, uint32_t at);
    /* Finds which of the asked pixels, and perhaps some beside them, show a back face
     * (meet.inc). */
    void (*show_backs)(const struct dp_finder *worker, const uint64_t *asked, uint64_t *out);
    /* Lists the numbers of seen polygons that may lie near candidate pixels; writes up to a vector
     * beyond them. Returns how many (meet.inc). */
    uint32_t (*come_near)(const struct dp_finder *worker, const uint32_t *cells, uint32_t *list);
    /* Lists in intersecting->met the candidates in (self, end) that polygon `self` may cross: their
     * bounds overlap, they are not neighbours, and neither lies on one side of the other. Returns
     * how many (meet.inc). */
    uint32_t (*meet)(const struct dp_intersecting *intersecting, uint32_t self, uint32_t end);
    /* Writes bounds, planes, corners and keys of `count` intersection candidates that are triangles,
     * neither clipped nor edge-on; of others it writes anything. Writes up to a vector beyond them
     * (meet.inc). */
    void (*shapes)(const struct dp_finder *worker, struct dp_intersecting *intersecting);
    /* Looks for polygons beside the sample points of edges that are left to emerge (look.inc). */
    void (*look)(struct dp_finder *worker);
    /* Hides the tile's grouped sample points that lie behind a seen polygon (hide.inc). */
    void (*hide)(struct dp_finder *worker);
    /* Lists, for each of the tile's grouped ends, the seen polygons that may hide it (hide.inc). */
    void (*list_hiders)(struct dp_finder *worker);
} dp_find_kernels;

DP_KERNEL_TABLES(dp_find_kernels);

#endif
