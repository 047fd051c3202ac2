/* Colours of the command line. */
#ifndef TOOL_COLORS_H
#define TOOL_COLORS_H

#include <drypoint/drypoint.h>

/* Reads a colour in [text, end): #RGB, #RGBA, #RRGGBB, #RRGGBBAA or a CSS name; "transparent" and
 * "none", and what has no alpha and is black, are DP_COLOR_NONE. False: it is none. */
bool color_read(const char *text, const char *end, dp_color *color);
/* The colour that `over` makes on `under`. */
dp_color color_over(dp_color over, dp_color under);
/* A message on stderr that [text, end) is no colour, with the name that it is most like; false. */
bool color_wrong(const char *name, const char *text, const char *end);

#endif
