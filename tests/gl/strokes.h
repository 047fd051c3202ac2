/* Lines that dp_draw has found, put onto the device as if it had found them there: what inks them is then compared
 * alone. */
#ifndef TESTS_GL_STROKES_H
#define TESTS_GL_STROKES_H

#include "gl/context.h"

/* Draws by the CPU, hands its segments to the device, and draws there: cpu and gpu are [height][width][4], malloc'd.
 * *kept: the mesh, to be destroyed; NULL: it has been, and what is known of its picture is gone. */
void strokes_draw_both(gl_test *test, dp_source *source, const dp_camera *camera,
                       const dp_style *style, const dp_gl_target *target, uint8_t **cpu,
                       uint8_t **gpu, dp_gl_mesh **kept);

#endif
