/* Shading, edge map and mirror of the settings, with the pictures that they borrow. */
#ifndef TOOL_LOOK_H
#define TOOL_LOOK_H

#include "commands.h"

/* Data that the style borrows while drawing. Zero is empty. */
typedef struct look_data {
    uint8_t *shades;   /* [width][4] */
    uint8_t *strokes;  /* [height][width] */
    uint8_t *enhanced; /* by group */
} look_data;

/* Fills in the style's shade, edge_map and, with --edges, lines. `source` names groups. 0, or the
 * exit code after a message; call look_free in any case. */
int look_make(const tool_settings *s, dp_source *source, look_data *data, dp_style *style);
/* Fills style->mirror for the model; extends its extent by the mirror, which is beside it. */
void look_mirror(const tool_settings *s, measured *seen, dp_style *style);
/* Extends near and far of a camera that was fitted to `seen` to what the mirror shows. */
void look_deepen(const dp_style *style, const dp_extent *seen, dp_camera *camera);
void look_free(look_data *data);

#endif
