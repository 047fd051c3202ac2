/* A planar mirror, in two pictures: the reflected scene, then the scene with the mirror in it. */
#ifndef DP_GL_MIRROR_H
#define DP_GL_MIRROR_H

#include "gl/gl.h"

/* Meshes of a picture; borrowed until the next call. */
typedef struct dp_gl_mesh_list {
    dp_gl_mesh *const *meshes;
    size_t count;
} dp_gl_mesh_list;

/* Begins the reflected picture: *out are the meshes' images. The light is reflected, and what is kept from picture to
 * picture is that of the last reflected one, until dp_gl_end_image. */
dp_result dp_gl_begin_image(dp_gl *gl, dp_gl_mesh *const *meshes, size_t count,
                            const dp_camera *camera, dp_gl_mesh_list *out, dp_diag *diag);
/* The picture that was drawn becomes what the mirror shows. */
dp_result dp_gl_take_image(dp_gl *gl, dp_diag *diag);
/* After dp_gl_begin_image, whatever happened. */
void dp_gl_end_image(dp_gl *gl);
/* Begins the picture with the mirror: *out are the meshes and the mirror. */
dp_result dp_gl_begin_mirrored(dp_gl *gl, dp_gl_mesh *const *meshes, size_t count,
                               dp_gl_mesh_list *out, dp_diag *diag);
void dp_gl_end_mirrored(dp_gl *gl);
/* Is the reflected picture being drawn? */
bool dp_gl_is_image(const dp_gl *gl);
void dp_gl_mirror_free(dp_gl *gl);

#endif
