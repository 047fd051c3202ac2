/* Where a mirror stands (mirror.c). */
#ifndef DP_DRAW_MIRROR_H
#define DP_DRAW_MIRROR_H

#include "core/view.h"
#include "mesh/reflect.h"

#include <drypoint/shade.h>

/* The plane, its normal turned to the eye. */
dp_plane_equation dp_mirror_plane(const dp_mirror *mirror, const dp_view *view);
/* A square around the mirror's centre, facing along the plane's normal. Its sides run along the axes as far as
 * they can. */
void dp_mirror_square(const dp_mirror *mirror, const dp_plane_equation *plane,
                      double corners[4][3]);
/* A light, camera space, as the reflected scene has it. */
void dp_mirror_light(const dp_camera *camera, const dp_plane_equation *plane, float light[3]);

#endif
