/* Inside a mesh: bits of its triangles, and what shading needs of its polygons. */
#ifndef DP_GL_MESH_H
#define DP_GL_MESH_H

#include "gl/gl.h"
#include "mesh/polygons.h"

/* Of dp_gl_scene.triangles' second word, beside bits of edges (0 to 5) and the group (16 to 31). */
#define DP_GL_KIND_FACE 64u /* part of a section's face */

/* Uploads normals, texture coordinates and colours, if the polygons have some (attributes.c). */
dp_result dp_gl_mesh_take_attributes(dp_gl_mesh *mesh, const dp_polygons *polygons, dp_diag *diag);

/* Are the application's buffers still there, and as large as they must be? DP_ERR_ARGUMENT. */
dp_result dp_gl_mesh_check(dp_gl_mesh *mesh, dp_diag *diag);

#endif
