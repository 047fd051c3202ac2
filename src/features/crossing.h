/* Where the interiors of two polygons cross (Raskar 2001, 2.4), exactly. */
#ifndef DP_FEATURES_CROSSING_H
#define DP_FEATURES_CROSSING_H

#include "core/frame.h"
#include "base/vec.h"

/* The segment from *from to *to, world space, and the unit mean of the normals turned to the eye.
 * False: the interiors do not cross (they touch, lie in one plane, share an edge or are apart). */
bool dp_crossing_find(const dp_frame *frame, uint32_t a, uint32_t b, dp_vec3 *from, dp_vec3 *to,
                      dp_vec3 *normal);

#endif
