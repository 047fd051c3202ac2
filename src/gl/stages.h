/* The stages of a picture, in the order in which dp_gl_draw runs them (picture.c). Each has a file of its own, or a
 * few; what it keeps is a struct in gl.h. `…_free` needs the context; those of stages that are made when
 * first used check gl->is_lost. All return DP_OK or fill *diag. */
#ifndef DP_GL_STAGES_H
#define DP_GL_STAGES_H

#include "gl/gl.h"

/* scene.c: takes the meshes, and puts their triangles into one list if that is new; then their vertices onto the
 * screen. */
dp_result dp_gl_scene_take(dp_gl *gl, dp_gl_mesh *const *meshes, size_t count, dp_diag *diag);
dp_result dp_gl_scene_place(dp_gl *gl, dp_diag *diag);
/* Binds vertices, corners and triangles. */
void dp_gl_scene_bind(dp_gl *gl);
void dp_gl_scene_free(dp_gl *gl);
void dp_gl_scene_free_host(dp_gl *gl);

/* faces.c: the nearest triangle of each sample. */
dp_result dp_gl_draw_faces(dp_gl *gl, dp_diag *diag);
/* Binds ids and depth to their units and tells the program. */
void dp_gl_faces_bind(dp_gl *gl, uint32_t program);
void dp_gl_faces_free(dp_gl *gl);

/* mates.c: which half-edges are each other's; nothing is done where they are known. */
dp_result dp_gl_find_mates(dp_gl *gl, dp_diag *diag);
/* edges.c: edges → candidates; half-edges where the eye must decide (no mate, several, one wound the same way, back faces that
 * may be seen) → `disputed`. */
dp_result dp_gl_find_edges(dp_gl *gl, dp_diag *diag);
/* emerge.c: candidates beside which something else is seen become disputed, too; what the eye sees at all of those
 * → candidates. */
dp_result dp_gl_find_emerging(dp_gl *gl, dp_diag *diag);
/* crossings.c: where triangles cross → candidates. */
dp_result dp_gl_find_crossings(dp_gl *gl, dp_diag *diag);
/* visibility.c: candidates → segments. */
dp_result dp_gl_find_visible(dp_gl *gl, dp_diag *diag);
/* visibility.c: was any buffer of these stages full? Then it has been made larger, and they must run again. */
dp_result dp_gl_grow_lines(dp_gl *gl, bool *again, dp_diag *diag);
void dp_gl_lines_free(dp_gl *gl);

/* shading.c: the surface → surface.picture. flat: faces without light (surface.c). */
dp_result dp_gl_paint_surface(dp_gl *gl, dp_diag *diag);
dp_result dp_gl_shade(dp_gl *gl, dp_diag *diag);
/* The picture, into the target's framebuffer. */
dp_result dp_gl_show(dp_gl *gl, dp_diag *diag);
/* pencil.c: the surface in pencil, for DP_SHADING_PENCIL (called by dp_gl_shade). */
dp_result dp_gl_shade_pencil(dp_gl *gl, dp_diag *diag);
void dp_gl_surface_free(dp_gl *gl);
void dp_gl_shading_free(dp_gl *gl);

/* ink.c: segments as strokes over surface.picture. */
dp_result dp_gl_ink_strokes(dp_gl *gl, dp_diag *diag);
void dp_gl_ink_free(dp_gl *gl);
/* quads.c: the paper's added polygons over surface.picture. */
dp_result dp_gl_ink_quads(dp_gl *gl, dp_diag *diag);
void dp_gl_quads_free(dp_gl *gl);
/* fins.c: silhouettes by adjacency, as triangles; textured. */
dp_result dp_gl_ink_fins(dp_gl *gl, dp_diag *diag);
void dp_gl_fins_free(dp_gl *gl);

/* picture.c: the block of values that all shaders know. */
dp_result dp_gl_upload_block(dp_gl *gl, dp_diag *diag);

/* support.c: DP_ERR_UNSUPPORTED names what of the style this back end does not draw. */
dp_result dp_gl_check_style(const dp_gl *gl, const dp_style *style, dp_diag *diag);

#endif
