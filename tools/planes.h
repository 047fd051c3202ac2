/* --output NAME=FILE: the G-buffer and the edge map as pictures beside the drawing. */
#ifndef TOOL_PLANES_H
#define TOOL_PLANES_H

#include "options.h"

/* Allocates the target's planes that are asked for. 0, or the exit code after a message. */
int planes_prepare(const tool_settings *s, dp_target *target);
/* Writes the files. */
int planes_write(const tool_settings *s, const dp_target *target);
void planes_free(dp_target *target);

#endif
