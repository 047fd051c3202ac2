/* What corners carry besides positions, for shading. */
#include "gl/mesh.h"

dp_result dp_gl_mesh_take_attributes(dp_gl_mesh *mesh, const dp_polygons *polygons, dp_diag *diag) {
    (void)mesh, (void)polygons, (void)diag;
    return DP_OK;
}
