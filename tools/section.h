/* --clip and --section-...: a model cut open. */
#ifndef TOOL_SECTION_H
#define TOOL_SECTION_H

#include "options.h"

/* Stores the values of options: one more plane; a distance in the model's units, or a share. */
bool store_clip(const option *o, const char *value, tool_settings *settings);
bool store_spacing(const option *o, const char *value, tool_section *to);

/* Cuts the source open if the settings say so: *source then is the cut one. 0, or the exit code after
 * a message; the source is destroyed then. */
int open_section(const tool_settings *s, dp_source **source);

#endif
