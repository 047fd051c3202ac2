/* How finely a model's coordinates were written, and what that allows where parts touch. */
#ifndef DP_CORE_PRECISION_H
#define DP_CORE_PRECISION_H

#include "core/frame.h"

/* px: what float32 corners leave open. */
#define DP_TOUCHING 0.02f
#define DP_CRACK    0.05f

/* Half the unit of the last decimal that the positions have, world units; 0 if they have more than
 * six decimals, as many as float32 can hold at their size, or none that tell. */
double dp_precision_of(const dp_polygons *polygons);

/* How finely a model was written, and its box: of positions spread over it. */
typedef struct dp_written {
    double precision; /* dp_precision_of */
    dp_vec3 least, most;
} dp_written;
dp_written dp_written_of(const dp_polygons *polygons);

/* What that allows in a picture; all as in dp_frame. */
typedef struct dp_tolerances {
    float touching, crack;
    double precision;
} dp_tolerances;
dp_tolerances dp_tolerances_of(const dp_written *written, const dp_view *view);

/* Sets frame->touching, crack and precision from frame->polygons and the view (precision.c). */
void dp_find_tolerances(dp_frame *frame);

/* Is the polygon nowhere thicker than what its corners are rounded by? Its normal tells nothing.
 * Only asked where frame->precision is known. */
bool dp_is_sliver(const dp_frame *frame, uint32_t polygon);

#endif
