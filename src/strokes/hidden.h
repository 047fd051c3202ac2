/* Hidden lines: smoothing of their levels, and the dashes that they are inked with. */
#ifndef DP_STROKES_HIDDEN_H
#define DP_STROKES_HIDDEN_H

#include "strokes/lines.h"

/* The pattern of a hidden line `width` px wide, for strokes with round ends: px of its spine that are
 * drawn, and px to the next. Ends reach half a width beyond, so 12 widths of ink and 3 of paper are
 * 11 and 4. Dots are dashes of no length. Returns false, and leaves `dash`, where the line is
 * whole. */
bool dp_hidden_dash(dp_hidden_look look, float width, float dash[2]);

/* Of segments just made: visible ones are set aside for plain ink, as they come; levels of hidden ones
 * are smoothed, crumbs are dropped, and all are chained (hidden.c). False when memory is out. */
bool dp_finish_hidden(const dp_frame *frame, dp_lines *lines);

/* The hidden chains of `chained`, which may be the same lines, become what is inked of them: they are
 * appended to lines->inked. False when memory is out. */
bool dp_ink_hidden(const dp_frame *frame, const dp_lines *chained, dp_lines *lines);

#endif
