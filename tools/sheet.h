/* --sheet: several views on one page. */
#ifndef TOOL_SHEET_H
#define TOOL_SHEET_H

#include "page.h"

/* Fills the plan for a model of that extent. 0, or the exit code after a message. */
int sheet_make(const tool_settings *s, dp_source *source, const dp_extent *extent, page_plan *plan);

/* The frame and the title block of a page, as rules and texts (title.c). */
typedef struct title_block {
    double left, top, right, bottom; /* mm, of the frame */
    const char *title, *model, *scale, *unit, *page;
    bool first_angle;
} title_block;

/* mm: the height of the block, which stands in the frame's lower right corner. */
extern const double title_height;
void title_draw(const title_block *block, page_plan *plan);

#endif
