/* What lies on a page beside its views, as pixels. */
#ifndef TOOL_PAGE_INK_H
#define TOOL_PAGE_INK_H

#include "page.h"

/* Fills the target's rgba with paper; 0 is white, DP_COLOR_NONE nothing. */
void ink_paper(const dp_target *page, dp_color paper);
/* Draws the plan's rules and texts over it, black. */
void ink_page(const page_plan *plan, const dp_target *page);

#endif
