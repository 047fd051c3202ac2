/* All polygons of a frame in one place, convex and planar: what the stages work on. */
#ifndef DP_MESH_POLYGONS_H
#define DP_MESH_POLYGONS_H

#include "mesh/attributes.h"
#include "mesh/corner_tree.h"
#include <drypoint/draw.h>
#include <drypoint/source.h>

/* An edge that is a line by itself: DP_EDGE_SECTION or DP_EDGE_HATCHING. */
typedef struct dp_marked_edge {
    uint32_t polygon, edge; /* number of the corner that it starts from */
} dp_marked_edge;

/* Convex, planar polygons over shared vertices. Borrowed from the source if that has one stable
 * batch that needs no splitting, else from the store below. Indices may still be out of range,
 * coordinates not finite and areas zero: binning drops such polygons. */
typedef struct dp_polygons {
    const float *positions;
    size_t stride; /* bytes */
    uint32_t vertex_count;
    uint32_t made_vertices;         /* the last ones, which smoothing made (core/smooth.h) */
    const uint32_t *corners;        /* [corners] vertex; NULL: corner c is vertex c */
    const uint32_t *firsts;         /* [count + 1] corner; NULL: triangles */
    const uint8_t *edge_flags;      /* [corners] as in dp_batch; or NULL */
    bool has_diagonals;             /* an edge flag may be above DP_EDGE_NORMAL */
    const uint32_t *source_polygon; /* [count] its number in the source; NULL: the same */
    const uint16_t *source_edges;   /* [corners] the edge of the polygon that smoothing found, or
                                       DP_EDGE_INSIDE; NULL: the same */
    const uint8_t *smooth_edges; /* [corners] 1: the surface is smooth across the edge, whose fold
                                       is none; NULL: across none */
    const uint16_t *groups;      /* [count]; NULL: all group 0 */
    dp_attribute normals, texcoords;
    const uint32_t *colors;      /* [vertex_count] as in dp_batch; or NULL */
    const dp_marked_edge *marks; /* [mark_count] edges that are lines by themselves */
    uint32_t mark_count;
    uint32_t count;
} dp_polygons;

/* An edge that lies within a polygon's patch. */
enum { DP_EDGE_INSIDE = UINT16_MAX };

/* Scratch for splitting one polygon; as large as the largest so far. The caller sets `at`. */
typedef struct dp_split_scratch {
    const float **at;         /* position of each corner */
    uint32_t *links;          /* next corner that is left */
    uint32_t (*triangles)[3]; /* the result: corner numbers, wound as the polygon */
    size_t at_cap, links_cap, triangles_cap;
    /* of polygons with many corners (split.c) */
    dp_corner_tree tree;
    struct dp_waiting *waiting;
    uint32_t *previous, *waiters;
    uint64_t *untried;
    size_t waiting_cap, previous_cap, waiters_cap, untried_cap;
} dp_split_scratch;

/* Room for a polygon of n corners; false when memory is out (split.c). */
bool dp_split_scratch_reserve(dp_split_scratch *scratch, size_t n, const dp_allocator *memory);
void dp_split_scratch_free(dp_split_scratch *scratch, const dp_allocator *memory);
uint64_t dp_split_scratch_bytes(const dp_split_scratch *scratch);

/* Arrays that a frame may own, kept for the next frame. Zero is empty. */
typedef struct dp_polygon_store {
    dp_split_scratch scratch;
    float *positions;
    uint32_t *corners, *firsts, *source_polygon, *colors;
    uint8_t *edge_flags;
    uint16_t *groups;
    size_t positions_cap, corners_cap, firsts_cap, source_cap, colors_cap, flags_cap, groups_cap;
    size_t vertices, corner_count, polygons;
    size_t limit;   /* bytes that these arrays and the stages' memory may take; 0: any number */
    bool is_beyond; /* they would have taken more */
    /* Hears how much of the source is read, 0 to 1, rising; an error of its own ends dp_gather. NULL
     * allowed. */
    dp_result (*tell)(void *arg, double done, dp_diag *diag);
    void *tell_arg;
    dp_attribute_store normals, texcoords;
    dp_marked_edge *marks;
    size_t marks_cap;
} dp_polygon_store;

void dp_polygon_store_free(dp_polygon_store *store, const dp_allocator *allocator);
uint64_t dp_polygon_store_bytes(const dp_polygon_store *store);

/* Reads the source to its end (from its start if it can be rewound), moves all positions to the
 * first batch's origin, splits polygons that are not
 * convex and planar, and fills *out. Counts polygons, triangles, split and dropped_corners in
 * *stats. DP_ERR_LIMIT beyond 2^30 polygons, or, with store->is_beyond, beyond store->limit bytes,
 * of which borrowed arrays take none. */
dp_result dp_gather(dp_source *source, dp_polygon_store *store, const dp_allocator *allocator,
                    dp_polygons *out, dp_stats *stats, dp_diag *diag);

static inline const float *dp_vertex_position(const dp_polygons *polygons, uint32_t vertex) {
    return (const float *)(const void *)((const char *)polygons->positions +
                                         (size_t)vertex * polygons->stride);
}
static inline uint32_t dp_first_corner(const dp_polygons *polygons, uint32_t polygon) {
    return polygons->firsts ? polygons->firsts[polygon] : 3 * polygon;
}
static inline uint32_t dp_corner_count(const dp_polygons *polygons, uint32_t polygon) {
    return polygons->firsts ? polygons->firsts[polygon + 1] - polygons->firsts[polygon] : 3;
}
static inline uint32_t dp_corner_vertex(const dp_polygons *polygons, uint32_t corner) {
    return polygons->corners ? polygons->corners[corner] : corner;
}

/* Is it a flag of an edge that may turn out to be a line? */
static inline bool dp_flag_may_be_line(uint8_t flag) {
    return flag == DP_EDGE_NORMAL || flag == DP_EDGE_DIAGONAL;
}

/* May the edge that starts at this corner be a line? Does it bound the polygon? If not, it may
 * still be an outline. */
static inline bool dp_edge_may_be_line(const dp_polygons *polygons, uint32_t corner) {
    return !polygons->edge_flags || dp_flag_may_be_line(polygons->edge_flags[corner]);
}

/* Is the polygon part of a section's face? */
static inline bool dp_is_section_face(const dp_polygons *polygons, uint32_t polygon) {
    return polygons->edge_flags &&
           polygons->edge_flags[dp_first_corner(polygons, polygon)] == DP_EDGE_FACE;
}
static inline bool dp_edge_is_flagged(const dp_polygons *polygons, uint32_t corner) {
    return dp_edge_may_be_line(polygons, corner) &&
           !(polygons->has_diagonals && polygons->edge_flags[corner] == DP_EDGE_DIAGONAL);
}

/* Did smoothing find the surface smooth across the edge? */
static inline bool dp_edge_is_smooth(const dp_polygons *polygons, uint32_t corner) {
    return polygons->smooth_edges && polygons->smooth_edges[corner];
}

/* Polygons are not visited in memory order: these prefetch the vertex numbers of a polygon's first
 * three corners, and (later) their positions. */
static inline void dp_prefetch_corners(const dp_polygons *polygons, uint32_t polygon) {
    if (polygons->corners)
        __builtin_prefetch(&polygons->corners[dp_first_corner(polygons, polygon)]);
}
static inline void dp_prefetch_positions(const dp_polygons *polygons, uint32_t polygon) {
    const uint32_t first = dp_first_corner(polygons, polygon);
    for (uint32_t i = 0; i < 3; i++)
        __builtin_prefetch(dp_vertex_position(polygons, dp_corner_vertex(polygons, first + i)));
}

/* Splitting (split.c). May a polygon with corners at at[i], i < n, stay whole? It is convex and
 * planar then, and does not have so many corners that it were slow to draw. */
bool dp_stays_whole(const float *const *at, uint32_t n);
/* Fills scratch->triangles[n - 2] from scratch->at[n]; returns how many. */
uint32_t dp_split_polygon(dp_split_scratch *scratch, uint32_t n);

#endif
