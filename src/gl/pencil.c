/* pencil */
#include "gl/surface.h"

dp_result dp_gl_shade_pencil(dp_gl *gl, dp_diag *diag) {
    return dp_fail(diag, DP_ERR_UNSUPPORTED, "%s: pencil is not drawn by OpenGL", gl->device);
}
