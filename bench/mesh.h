/* A model gathered from a source into one indexed triangle mesh, for programs that need it
 * whole. */
#ifndef BENCH_MESH_H
#define BENCH_MESH_H

#include <drypoint/source.h>

typedef struct mesh {
    float *positions; /* [vertex_count][3] */
    size_t vertex_count;
    uint32_t *indices; /* [triangle_count][3] */
    size_t triangle_count;
} mesh;

/* Reads a model file; polygons become fans of triangles. False: said why on stderr. */
bool mesh_read(const char *path, mesh *m);
/* Writes a model file, by its name's ending. False: said why on stderr. */
bool mesh_write(const mesh *m, const char *path);
void mesh_free(mesh *m);

#endif
