/* Finding lines: from half-edges to visible segments, in the order in which dp_gl_draw runs these. */
#ifndef DP_GL_LINES_H
#define DP_GL_LINES_H

#include "gl/gl.h"

/* sides.c: how triangles lie to the eye, and their normals. */
dp_result dp_gl_find_sides(dp_gl *gl, dp_diag *diag);
/* mates.c: which half-edges are each other's; nothing is done where they are known. */
dp_result dp_gl_find_mates(dp_gl *gl, dp_diag *diag);
/* edges.c: edges → candidates; half-edges where the eye must decide (no mate, several, one wound the same way, back faces that
 * may be seen) → `disputed`. */
dp_result dp_gl_find_edges(dp_gl *gl, dp_diag *diag);
/* emerge.c: candidates beside which something else is seen become disputed, too; what the eye sees at all of those
 * → candidates. */
dp_result dp_gl_find_emerging(dp_gl *gl, dp_diag *diag);
/* Was a buffer of emerge.c or crossings.c full? Then it has been made larger, and *again is set. */
dp_result dp_gl_grow_emerging(dp_gl *gl, bool *again, dp_diag *diag);
dp_result dp_gl_grow_crossings(dp_gl *gl, bool *again, dp_diag *diag);
void dp_gl_eye_free(dp_gl *gl);
/* crossings.c: where triangles cross → candidates. */
dp_result dp_gl_find_crossings(dp_gl *gl, dp_diag *diag);
/* visibility.c: candidates → segments. */
dp_result dp_gl_find_visible(dp_gl *gl, dp_diag *diag);
/* visibility.c: what hides segments beyond their ends; done when somebody reads them. */
dp_result dp_gl_find_hiders(dp_gl *gl, dp_diag *diag);
/* visibility.c: was any buffer of these stages full? Then it has been made larger, and they must run again. */
dp_result dp_gl_grow_lines(dp_gl *gl, bool *again, dp_diag *diag);
void dp_gl_lines_free(dp_gl *gl);
/* read.c: what has been read back, on the host. */
void dp_gl_read_free(dp_gl *gl);

#endif
