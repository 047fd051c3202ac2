/* --deform, --morph: models whose vertices move. */
#ifndef TOOL_DEFORM_H
#define TOOL_DEFORM_H

#include "options.h"

/* Deforms and blends the open model as the settings say; `other` is --morph's, or NULL. Takes both,
 * and replaces *source, which is NULL after a failure. 0, or the exit code after a message. */
int deform_model(const tool_settings *s, dp_source **source, dp_source *other);

#endif
