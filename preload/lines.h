/* lines.h: draws lines onto the finished surfaces. */
#ifndef PRELOAD_LINES_H
#define PRELOAD_LINES_H

#include "context.h"

/* Compiles our programs; false, and says why, when GL cannot. */
bool lines_create_programs(struct painter *painter);
/* Gives them what settings() says, once. Leaves no program bound: only where none was. */
void lines_set_constants(struct painter *painter);

/* Draws the lines of all draws of the frame onto the window, and leaves all of GL's state as it was. Not
 * between glBegin and glEnd, nor while a display list is compiled. */
void lines_draw(struct context *context);

/* ---- frame.c: from draw calls to lines ---- */

/* Around a draw call of polygons, outside of display lists being compiled with GL_COMPILE. frame_open_draw answers
 * whether it gets lines; then its triangles come by frame_add_polygons (from the context's builder) or
 * frame_add_mesh before frame_close_draw. */
bool frame_open_draw(struct context *context);
void frame_add_polygons(struct context *context);
void frame_add_mesh(struct context *context, struct mesh *mesh);
void frame_close_draw(struct context *context);

/* Someone will look at the picture: draws the lines that are due. */
void frame_ink(struct context *context);
/* The depth buffer is cleared, or the picture handed over: forgets what was drawn. */
void frame_reset(struct context *context);
/* glClear. */
void frame_clear(struct context *context, GLbitfield mask);

#endif
