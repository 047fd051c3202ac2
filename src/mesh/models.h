/* The builders of generated models: each adds a model's sheets for a given fineness.
 *
 * A builder gets a zeroed model with `fine` (>= 1) and `seed` set, adds sheets and sets extent and
 * centre. The number of triangles grows with `fine`. y is up, z towards the viewer. */
#ifndef DP_MESH_MODELS_H
#define DP_MESH_MODELS_H

#include "mesh/sheet.h"

typedef void dp_builder(dp_model *model);

dp_builder dp_build_cube, dp_build_tetrahedron, dp_build_boxes, dp_build_stairs; /* plane */
dp_builder dp_build_sphere, dp_build_torus, dp_build_cylinder, dp_build_terrain; /* round */
dp_builder dp_build_flag, dp_build_torso;                                        /* soft */
dp_builder dp_build_gear, dp_build_bolt, dp_build_bracket;                       /* parts */

#endif
