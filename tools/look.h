/* Shading and edge map as the settings say, with the pictures that they borrow. */
#ifndef TOOL_LOOK_H
#define TOOL_LOOK_H

#include "options.h"

/* What the style borrows while drawing. Zero is empty. */
typedef struct look_data {
    uint8_t *shades;   /* [width][4] */
    uint8_t *strokes;  /* [height][width] */
    uint8_t *enhanced; /* by group */
} look_data;

/* Fills in the style's shade, edge_map and, with --edges, lines. `source` names groups. 0, or the exit
 * code after a message. look_free either way. */
int look_make(const tool_settings *s, dp_source *source, look_data *data, dp_style *style);
void look_free(look_data *data);

#endif
