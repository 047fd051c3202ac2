/* One drawing: made ready once, then drawn and written, as often as a film has frames. */
#ifndef TOOL_DRAW_H
#define TOOL_DRAW_H

#include "gl.h"
#include "look.h"
#include "objects.h"
#include "page.h"
#include "paths.h"

typedef struct drawing {
    dp_source *source;
    dp_context *context;
    dp_texture *texture;
    dp_style style;
    object_styles objects; /* of those that have their own */
    dp_target target;      /* planes of the only view; rgba is the whole page */
    look_data look;
    page_plan plan;
    bool pixels, paths; /* what is wanted */
    bool lent;          /* target.rgba is not the drawing's own */
    tool_gl *gl;        /* draws instead of the context; NULL: none */
    bool gl_lent;       /* it is not the drawing's own, and has the source already */
    bool gl_taken;      /* it has the source, perhaps at another time */
    bool samples_told;  /* were there fewer than asked for, it has been said */
    view_paths views[SHEET_MOST];
    dp_stats stats[SHEET_MOST];
} drawing;

/* These return 0, or the exit code after a message; drawing_free in any case. */

/* Plans the pages and makes the style: all that is the same in every frame. `seen` is what cameras
 * are fitted to: the source, or what a film shows of it. */
int drawing_prepare(const tool_settings *s, drawing *d, dp_source *seen, measured *model);
/* Makes the context, and the page unless target.rgba was lent. threads 0: one per processor. */
int drawing_open(const tool_settings *s, drawing *d, uint32_t threads);
/* Draws all views, on a page that is empty again. */
int drawing_draw(const tool_settings *s, drawing *d);
/* Writes the settings' outputs, but no films. */
int drawing_write(const tool_settings *s, drawing *d);
void drawing_free(drawing *d);

/* Did the drawing find no line, although lines were asked for? */
bool drawing_is_empty(const drawing *d);

#endif
