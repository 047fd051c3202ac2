/* The paths of a run's views: made, told of, and written as SVG, PDF, EPS, DXF and JSON. */
#ifndef TOOL_PATHS_H
#define TOOL_PATHS_H

#include "page.h"

typedef struct view_paths {
    dp_drawing *lines; /* NULL: none are wanted */
    uint8_t *ground;   /* [height][width][4], or NULL */
} view_paths;

/* Makes the paths of the view that the context has drawn last. 0, or the exit code after a
 * message. */
int paths_make(const tool_settings *s, const page_plan *plan, dp_context *context,
               dp_drawing **out);
/* Writes all files that are no PNG. 0, or the exit code after a message. */
int paths_write(const tool_settings *s, const page_plan *plan, const view_paths *paths);
/* Says how many paths there are, what was left out, and what was assumed; NULL: nothing. */
void paths_tell(const tool_settings *s, const page_plan *plan, const view_paths *paths,
                const char *assumed);
/* Warns of what the settings ask for and paths do not have. */
void paths_warn(const tool_settings *s, const dp_style *style);

#endif
