/* The picture without lines. */
#ifndef DP_GL_SURFACE_H
#define DP_GL_SURFACE_H

#include "gl/gl.h"

/* Makes surface.picture of the picture's size, and draws into it from now on. */
dp_result dp_gl_open_surface(dp_gl *gl, dp_diag *diag);
/* shading.c: the surface → surface.picture. flat: faces without light (surface.c). */
dp_result dp_gl_paint_surface(dp_gl *gl, dp_diag *diag);
dp_result dp_gl_shade(dp_gl *gl, dp_diag *diag);
/* Binds a framebuffer of the application's to GL_DRAW_FRAMEBUFFER or GL_READ_FRAMEBUFFER. DP_ERR_ARGUMENT. */
dp_result dp_gl_bind_framebuffer(dp_gl *gl, uint32_t point, uint32_t framebuffer, dp_diag *diag);
/* The picture, into the target's framebuffer. */
dp_result dp_gl_show(dp_gl *gl, dp_diag *diag);
/* pencil.c: the surface in pencil, for DP_SHADING_PENCIL (called by dp_gl_shade when the G-buffer is filled):
 * draws the colours of pixels with a surface into gl->shading->color (gl/shading.h), by dp_gl_begin_pass. */
dp_result dp_gl_shade_pencil(dp_gl *gl, dp_diag *diag);
void dp_gl_surface_free(dp_gl *gl);
void dp_gl_shading_free(dp_gl *gl);

#endif
