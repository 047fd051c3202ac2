/* What cameras share. */
#ifndef DP_CORE_CAMERA_H
#define DP_CORE_CAMERA_H

#include "base/vec.h"
#include <drypoint/camera.h>

/* An axis that is not nearly parallel to `forward`: `up`, if it is not; then z and y. */
dp_vec3 dp_usable_up(dp_vec3 forward, dp_vec3 up);

#endif
