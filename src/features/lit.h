/* Light on lines (Raskar 2001, 5: "the new quads can be rendered with appropriate lighting"). */
#ifndef DP_FEATURES_LIT_H
#define DP_FEATURES_LIT_H

#include "core/view.h"
#include <drypoint/style.h>

/* The style's light, dp_shade.light, in world space; unit. */
dp_vec3 dp_light_direction(const dp_view *view, const dp_style *style);

/* A line's colour where the cosine between its normal and the light is `cosine`: dp_line_lighting.
 * Alpha stays. */
dp_color dp_lit_color(const dp_style *style, dp_color color, double cosine);

#endif
