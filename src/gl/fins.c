/* fins */
#include "gl/ink.h"

dp_result dp_gl_ink_fins(dp_gl *gl, dp_diag *diag) {
    return dp_fail(diag, DP_ERR_UNSUPPORTED, "%s: not drawn by OpenGL", gl->device);
}

void dp_gl_fins_free(dp_gl *gl) { (void)gl; }
