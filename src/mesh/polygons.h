/* All polygons of a frame in one place, checked and convex: what the pipe works on. */
#ifndef DP_MESH_POLYGONS_H
#define DP_MESH_POLYGONS_H

#include "mesh/attributes.h"
#include <drypoint/draw.h>
#include <drypoint/source.h>

/* Convex, planar polygons over shared vertices. Everything is borrowed from the source where it can
 * be (one stable batch that needs no splitting), from the `store` below otherwise. Indices may
 * still be out of range, coordinates not finite and areas zero: binning drops such polygons. */
typedef struct dp_polygons {
    const float *positions;
    size_t stride; /* bytes */
    uint32_t vertex_count;
    const uint32_t *corners; /* vertex of a corner; NULL: corner c is vertex c */
    const uint32_t *firsts;  /* count + 1 corners; NULL: triangles */
    const uint8_t *edge_flags;
    const uint32_t *source_polygon; /* NULL: the same number */
    const uint16_t *groups;
    dp_attribute normals, texcoords;
    uint32_t count;
} dp_polygons;

/* Corner pointers of one polygon, and what splitting it needs; grown to the largest polygon. */
typedef struct dp_split_scratch {
    const float **at;
    uint32_t *links;
    uint32_t (*triangles)[3];
    size_t at_cap, links_cap, triangles_cap;
} dp_split_scratch;

/* Arrays that a frame may need to own; they stay for the next frame. Zero is empty. */
typedef struct dp_polygon_store {
    dp_split_scratch scratch;
    float *positions;
    uint32_t *corners, *firsts, *source_polygon;
    uint8_t *edge_flags;
    uint16_t *groups;
    size_t positions_cap, corners_cap, firsts_cap, source_cap, flags_cap, groups_cap;
    size_t vertices, corner_count, polygons;
    size_t limit;   /* bytes that these arrays and what the stages make of them may take; 0: any
                       number */
    bool is_beyond; /* they would have taken more */
    dp_attribute_store normals, texcoords;
} dp_polygon_store;

void dp_polygon_store_free(dp_polygon_store *store, const dp_allocator *allocator);

/* Reads the source to its end (from its start when it can be rewound), splits what is not convex
 * and planar, and fills `out`. Counts polygons, triangles, split and dropped_corners in `stats`.
 * DP_ERR_LIMIT beyond 2^30 polygons or, with store->is_beyond, beyond store->limit bytes; what can
 * be borrowed costs none. */
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

/* Polygons are looked at in no order of memory: these prefetch the vertex numbers of a polygon's
 * first three corners, and for their positions, ahead of the time when they are read. */
static inline void dp_prefetch_corners(const dp_polygons *polygons, uint32_t polygon) {
    if (polygons->corners)
        __builtin_prefetch(&polygons->corners[dp_first_corner(polygons, polygon)]);
}
static inline void dp_prefetch_positions(const dp_polygons *polygons, uint32_t polygon) {
    const uint32_t first = dp_first_corner(polygons, polygon);
    for (uint32_t i = 0; i < 3; i++)
        __builtin_prefetch(dp_vertex_position(polygons, dp_corner_vertex(polygons, first + i)));
}

/* Splitting (split.c). `at(i)` is corner i of n in space. */
bool dp_is_convex_planar(const float *const *at, uint32_t n);
/* Fills triangles[n - 2][3] with corner numbers, wound as the polygon; returns how many (fewer than
 * n - 2 where corners coincide or lie on a line). `links` is scratch of n entries. */
uint32_t dp_split_polygon(const float *const *at, uint32_t n, uint32_t *links,
                          uint32_t (*triangles)[3]);

#endif
