/* Mates. */
#include "gl/lines.h"

dp_result dp_gl_find_mates(dp_gl *gl, dp_diag *diag) {
    (void)gl, (void)diag;
    return DP_OK;
}
