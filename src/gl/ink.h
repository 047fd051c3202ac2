/* Lines over surface.picture. */
#ifndef DP_GL_INK_H
#define DP_GL_INK_H

#include "gl/gl.h"

/* ink.c: segments as strokes over surface.picture. */
dp_result dp_gl_ink_strokes(dp_gl *gl, dp_diag *diag);
void dp_gl_ink_free(dp_gl *gl);
/* quads.c: the paper's added polygons over surface.picture. */
dp_result dp_gl_ink_quads(dp_gl *gl, dp_diag *diag);
void dp_gl_quads_free(dp_gl *gl);
/* fins.c: silhouettes by adjacency, as triangles; textured. */
dp_result dp_gl_ink_fins(dp_gl *gl, dp_diag *diag);
void dp_gl_fins_free(dp_gl *gl);

#endif
