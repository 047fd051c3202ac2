/* Where the interiors of two polygons cross (Raskar 2001, 2.4), exactly. */
#ifndef DP_FEATURES_CROSSING_H
#define DP_FEATURES_CROSSING_H

#include "core/frame.h"
#include "base/vec.h"

/* The segment from *from to *to, world space, and the mean of the normals turned to the eye, unit.
 * False when the interiors do not cross (or only touch, or lie in one plane, or share an edge). */
bool dp_crossing_find(const dp_frame *frame, uint32_t a, uint32_t b, dp_vec3 *from, dp_vec3 *to,
                      dp_vec3 *normal);

#endif
