/* An OpenGL context without a window. */
#ifndef TOOL_EGL_H
#define TOOL_EGL_H

#include <stdbool.h>

typedef struct egl_context egl_context;

/* Makes a core profile of at least that version current in this thread. NULL: after a message on stderr, which says
 * what to install. */
egl_context *egl_open(int major, int minor);
void egl_close(egl_context *context); /* NULL allowed */
/* The address of an OpenGL function; NULL: there is none. `context` is an egl_context. */
void *egl_function(void *context, const char *name);

#endif
