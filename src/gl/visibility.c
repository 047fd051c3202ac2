/* Visibility. */
#include "gl/lines.h"

dp_result dp_gl_find_visible(dp_gl *gl, dp_diag *diag) {
    (void)gl, (void)diag;
    return DP_OK;
}

dp_result dp_gl_grow_lines(dp_gl *gl, bool *again, dp_diag *diag) {
    *again = false;
    return dp_gl_grow_emerging(gl, again, diag);
}

void dp_gl_lines_free(dp_gl *gl) {
    dp_gl_lines_store *const l = &gl->lines;
    dp_gl_buffer *const buffers[] = {&l->mates,      &l->slots,    &l->counters,
                                     &l->candidates, &l->segments, &l->disputed};
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++) dp_gl_buffer_free(gl, buffers[i]);
    for (size_t i = 0; i < sizeof l->own / sizeof *l->own; i++) dp_gl_buffer_free(gl, &l->own[i]);
    dp_gl_eye_free(gl);
}
