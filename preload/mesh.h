/* mesh.h: triangles as a program draws them, and how primitives become triangles. */
#ifndef PRELOAD_MESH_H
#define PRELOAD_MESH_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

/* Object space; edge: 1 when the edge from this corner to the triangle's next is one of the polygon's own,
 * 0 when it divides a quad or polygon. */
struct corner {
    float x, y, z, edge;
};

/* Shared by a display list and the frames that draw it. */
struct mesh {
    atomic_int users;
    struct corner *corners; /* three in a row are a triangle */
    size_t count, room;     /* corners */
    size_t upload, place;   /* the last upload that held it, and where there (lines.c) */
};

/* The most corners of one mesh: 64 MiB. */
enum { MESH_CORNERS_MAX = 3 << 20 };

struct mesh *mesh_create(void); /* NULL without memory */
struct mesh *mesh_share(struct mesh *mesh);
void mesh_release(struct mesh *mesh);

/* The vertices between a glBegin and its glEnd, or of one draw call. */
struct polygon_builder {
    bool open;     /* between begin and end */
    bool unknown;  /* something was drawn whose vertices we do not know: make nothing of it */
    unsigned mode; /* GL_TRIANGLES ... GL_POLYGON */
    float (*vertices)[3];
    size_t count, room;
};

void builder_begin(struct polygon_builder *builder, unsigned mode);
/* Homogeneous; w must be positive, else the draw becomes unknown. */
void builder_vertex(struct polygon_builder *builder, float x, float y, float z, float w);
/* Appends the triangles to the mesh; false when that is not possible for want of memory. */
bool builder_end(struct polygon_builder *builder, struct mesh *mesh);
void builder_free(struct polygon_builder *builder);

/* Is it a mode that fills polygons? */
bool is_polygon_mode(unsigned mode);

#endif
