/* Smoothing: polygons become curved PN triangles (Vlachos et al. 2001), cut as finely as the picture
 * needs. */
#ifndef DP_CORE_SMOOTH_H
#define DP_CORE_SMOOTH_H

#include "core/frame.h"
#include "mesh/edge_normals.h"

/* What is made for one frame, kept for the next. Zero is empty. */
typedef struct dp_smooth_store {
    dp_edge_normals edges;
    uint8_t
        *parts; /* [corners] into how many parts the edge from there is cut, and more (smooth.c) */
    float *facing; /* [vertices] as dp_curve_facing, where normals are one */
    struct dp_smooth_block *blocks;

    float (*positions)[3];
    uint32_t *corners, *firsts, *source_polygon, *colors;
    uint16_t *groups, *source_edges;
    uint8_t *edge_flags, *smooth_edges;
    float (*normals)[3];
    float (*texcoords)[2];
    uint32_t *normal_at, *texcoord_at; /* [corners] */
    size_t parts_cap, facing_cap, blocks_cap, positions_cap, corners_cap, firsts_cap, source_cap,
        colors_cap, groups_cap, source_edges_cap, flags_cap, smooth_edges_cap, normals_cap,
        texcoords_cap, normal_at_cap, texcoord_at_cap;
} dp_smooth_store;

void dp_smooth_store_free(dp_smooth_store *store, const dp_allocator *memory);
uint64_t dp_smooth_store_bytes(const dp_smooth_store *store);

typedef struct dp_smooth_setup {
    dp_smoothing what;         /* not DP_SMOOTH_OFF */
    uint32_t level;            /* 0: by size on the screen */
    dp_corner_normals normals; /* of frame->polygons */
    bool wants_normals;        /* the result is to have normals, for shading */
    bool wants_flags;          /* edges inside a patch are to be flagged as diagonals */
} dp_smooth_setup;

/* Replaces frame->polygons by what is borrowed from the store. DP_ERR_MEMORY; DP_ERR_LIMIT when there
 * would be more than 2^30 polygons or vertices. */
dp_result dp_smooth_polygons(dp_smooth_store *store, const dp_smooth_setup *setup, dp_frame *frame,
                             dp_diag *diag);

#endif
