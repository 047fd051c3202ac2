/* Where a picture begins: the scene, and the nearest triangle of each sample. All stages return DP_OK or fill *diag;
 * `…_free` needs the context, and those of stages that are made when first used check gl->is_lost. */
#ifndef DP_GL_SCENE_H
#define DP_GL_SCENE_H

#include "gl/gl.h"

/* scene.c: takes the meshes, and puts their triangles into one list if that is new; then their vertices onto the
 * screen. */
dp_result dp_gl_scene_take(dp_gl *gl, dp_gl_mesh *const *meshes, size_t count, dp_diag *diag);
dp_result dp_gl_scene_place(dp_gl *gl, dp_diag *diag);
/* Rows of the map from a mesh's own space to the scene's; false if it changes nothing. */
bool dp_gl_placement_of(const dp_gl_mesh *mesh, const double origin[3], double rows[3][4]);
/* The numbers of groups of mesh `index` of the scene. */
dp_gl_group_numbers dp_gl_groups_of(const dp_gl_scene *scene, size_t index);
void dp_gl_scene_free(dp_gl *gl);
void dp_gl_scene_free_host(dp_gl *gl);

/* faces.c: the nearest triangle of each sample. */
dp_result dp_gl_draw_faces(dp_gl *gl, dp_diag *diag);
void dp_gl_faces_free(dp_gl *gl);

/* picture.c: the block of values that all shaders know. */
dp_result dp_gl_upload_block(dp_gl *gl, dp_diag *diag);
/* DP_ERR_ARGUMENT: its size or samples are out of range. */
dp_result dp_gl_check_target(const dp_gl *gl, const dp_gl_target *target, dp_diag *diag);

/* support.c: DP_ERR_UNSUPPORTED names what of the style this back end does not draw. */
dp_result dp_gl_check_style(const dp_gl *gl, const dp_style *style, dp_diag *diag);

#endif
