/* Ink. */
#include "gl/ink.h"

dp_result dp_gl_ink_strokes(dp_gl *gl, dp_diag *diag) {
    (void)gl, (void)diag;
    return DP_OK;
}

void dp_gl_ink_free(dp_gl *gl) {
    for (int i = 0; i < 2; i++) dp_gl_texture_free(gl, &gl->ink.coverage[i]);
    if (gl->ink.framebuffer) gl->api.DeleteFramebuffers(1, &gl->ink.framebuffer);
    gl->ink.framebuffer = 0;
}
