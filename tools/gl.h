/* Drawing by OpenGL, for the program and the viewer: a dp_gl, the model's mesh, and a framebuffer. */
#ifndef TOOL_GL_H
#define TOOL_GL_H

#include <drypoint/draw.h>

#include <stdio.h>

typedef struct tool_gl tool_gl;

/* In a context of its own, without a window. 0, or the exit code after a message. */
int gl_open(tool_gl **out);
/* In the application's context, which is current during every call. */
dp_result gl_adopt(void *(*function)(void *user, const char *name), void *user, tool_gl **out,
                   dp_diag *diag);
void gl_close(tool_gl *gl); /* NULL allowed */
/* The device's name. */
const char *gl_device(const tool_gl *gl);

/* What is drawn from now on; `moved`: the same source as before, at another time. */
dp_result gl_take(tool_gl *gl, dp_source *source, bool moved, dp_diag *diag);
/* Draws it as dp_draw would, but into the framebuffer; into target.rgba, too, unless that is NULL. Other planes are
 * refused. */
dp_result gl_draw(tool_gl *gl, const dp_camera *camera, const dp_style *style,
                  const dp_target *target, dp_diag *diag);
/* Makes the lines of the last picture the context's. */
dp_result gl_hand_over(tool_gl *gl, dp_context *context, dp_diag *diag);
/* The framebuffer's name; its first row is the lowest. */
uint32_t gl_framebuffer(const tool_gl *gl);

/* Of the last picture, in dp_draw's terms. */
dp_result gl_stats(tool_gl *gl, dp_stats *stats, dp_diag *diag);
/* Samples of a pixel that the last picture has: as many as were asked for, or the most of the device. */
uint32_t gl_samples(tool_gl *gl);
/* Times the stages from now on. */
void gl_time(tool_gl *gl);
/* Names of the device's stages and their times, device first: as rows, or as members of a JSON object, ", " first. */
void gl_print_table(FILE *out, tool_gl *gl);
void gl_print_json(FILE *out, tool_gl *gl);

#endif
