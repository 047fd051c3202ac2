/* A welded mesh with adjacency and crossings: what the reference is computed from. */
#ifndef DP_TEST_MESH_H
#define DP_TEST_MESH_H

#include "rays.h"
#include "reference.h"

typedef struct mesh_polygon {
    uint32_t first, count; /* corners */
    v3 normal;             /* unit, from its front */
    v3 centre;
    uint64_t source; /* its number in the source */
} mesh_polygon;

typedef struct mesh_edge {
    uint32_t a, b; /* vertices, in the direction in which polygon[0] runs */
    uint32_t polygon[2];
    uint32_t polygons; /* how many have it */
    bool opposed;      /* the second polygon runs the other way, as it should */
    uint8_t flags;     /* bit 0: a polygon wants it drawn, bit 1: a polygon does not */
} mesh_edge;

typedef struct mesh_crossing {
    v3 a, b;
    uint32_t polygon[2];
    bool contact; /* they only touch */
} mesh_crossing;

struct ref_model {
    v3 *positions;
    size_t vertex_count, vertex_room;
    uint32_t *corners;
    uint8_t *flags; /* per corner */
    size_t corner_count, corner_room, flag_room;
    mesh_polygon *polygons;
    size_t polygon_count, polygon_room;
    mesh_edge *edges;
    size_t edge_count;
    mesh_crossing *crossings;
    size_t crossing_count, crossing_room;
    rays *rays;  /* owners are polygons */
    double size; /* diagonal of the bounding box */
};

/* Room for `need` items in *block, zeroing nothing; aborts when memory is out. */
void mesh_reserve(void *block_address, size_t *room, size_t need, size_t item_size);

/* Appends to model->crossings those of all pairs of polygons that share no vertex. */
void mesh_find_crossings(ref_model *model, const rays_triangle *triangles, size_t count);

#endif
