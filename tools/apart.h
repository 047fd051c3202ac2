/* Reads a model in a process of its own, so that a reader that crashes or hangs on a broken file
 * costs an error message and not the program. */
#ifndef TOOL_APART_H
#define TOOL_APART_H

#include <drypoint/source.h>

/* As dp_io_open; the model's arrays are this process's own. seconds: how long reading may take; 0
 * means 60, and one more per MB of the file. To be called before threads are started. The caller
 * destroys *out. */
dp_result open_apart(const char *path, double seconds, dp_source **out, dp_diag *diag);

#endif
