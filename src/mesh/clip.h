/* Inside a clipped source (clip.c): polygons that planes cut, and the batch that is made of them. */
#ifndef DP_MESH_CLIP_H
#define DP_MESH_CLIP_H

#include "mesh/attributes.h"
#include "mesh/polygons.h"
#include "mesh/section.h"

/* A corner of a polygon that is cut. */
typedef struct dp_cut_corner {
    float position[3]; /* about the source's origin */
    float normal[3];   /* 0 0 0: none */
    float texcoord[2];
    bool has_texcoord;
    dp_color color; /* 0: none */
    uint8_t flag;   /* of the edge to the next corner */
} dp_cut_corner;

/* Triangles without indices: every corner has a vertex of its own. */
typedef struct dp_made_batch {
    float *positions, *normals, *texcoords;
    uint32_t *texcoord_indices, *colors;
    uint8_t *flags;
    uint16_t *groups;
    size_t positions_cap, normals_cap, texcoords_cap, texcoord_indices_cap, colors_cap, flags_cap,
        groups_cap;
    size_t triangles;
} dp_made_batch;

/* An edge of a made triangle that lies on a plane: no line of its own where the plane cuts off what
 * lay beyond it. */
typedef struct dp_touching_edge {
    size_t corner;
    uint32_t plane;
} dp_touching_edge;

typedef struct dp_clipping {
    dp_allocator memory;
    dp_section_plane planes[DP_CLIP_PLANES];
    uint32_t plane_count;
    dp_made_batch made;
    dp_cut_segment *cuts[DP_CLIP_PLANES]; /* by plane */
    size_t cut_caps[DP_CLIP_PLANES], cut_counts[DP_CLIP_PLANES];
    dp_touching_edge *touching;
    size_t touching_cap, touching_count;
} dp_clipping;

void dp_clipping_begin(dp_clipping *clipping); /* forgets what was cut */
void dp_clipping_free(dp_clipping *clipping);

/* Distance beyond a plane, 0 where it is no more than float32 rounding. */
double dp_beyond_plane(const dp_section_plane *plane, const float position[3]);

/* Cuts a triangle by all planes and notes where they cut it. False: memory is out. */
bool dp_clip_triangle(dp_clipping *clipping, const dp_cut_corner corners[3], uint16_t group);

/* Adds a triangle to the batch. False: memory is out. */
bool dp_made_add(dp_clipping *clipping, const dp_cut_corner corners[3], uint16_t group);

/* Takes back the edges that touch a plane where a section begins, and sorts the segments of each plane
 * by group and place. */
void dp_clip_settle_touching(dp_clipping *clipping);

#endif
