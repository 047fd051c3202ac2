/* A picture by OpenGL with its lines, as twins/look.h has those of dp_draw. */
#ifndef TESTS_GL_GL_LOOK_H
#define TESTS_GL_GL_LOOK_H

#include "gl/context.h"
#include "twins/look.h"

/* The same style as look_draw_source; how->streamed and how->adjacency are not looked at. A failure is in out->diag. */
void gl_look_draw(gl_test *test, dp_source *source, const dp_camera *camera, const look_how *how,
                  look *out);

#endif
