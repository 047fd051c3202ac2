/* The sides of a model, as --up has them. */
#ifndef TOOL_SIDES_H
#define TOOL_SIDES_H

#include "options.h"

typedef struct model_sides {
    double up[3], front[3], right[3]; /* world space, unit vectors */
} model_sides;

/* Of --up, or else what the source says, or what is usual. */
void sides_of(const tool_settings *s, const dp_source *source, model_sides *sides);

/* From the model to the eye, and what is up in the picture, for a word of --view. */
void sides_view(const model_sides *sides, int view, double d[3], double up[3]);
/* The same for angles in degrees: round the model from the front to the right, and up. */
void sides_angles(const model_sides *sides, double azimuth, double elevation, double d[3],
                  double up[3]);

/* What was taken for up, where nobody has said it; NULL: somebody has. */
const char *sides_assumed(const tool_settings *s, const dp_source *source);
/* Says so on a terminal: a drawing of pixels is silent otherwise. */
void sides_tell(const tool_settings *s, const dp_source *source);

#endif
