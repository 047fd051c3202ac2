/* drypoint/immediate.h: the API of Raskar 2001, Figure 3, in the spirit of OpenGL.
 *
 *     dp_set_camera(context, &camera);
 *     dp_enable(context, DP_SIL_RIDGE_VALLEY);
 *     dp_begin(context, DP_TRIANGLES);
 *     dp_vertex3f(context, x, y, z);
 *     ...
 *     dp_end(context);
 *     dp_disable(context, DP_SIL_RIDGE_VALLEY);
 *     dp_finish(context, &target, &diag);
 *
 * Polygons are recorded with the state that holds at their dp_begin (enabled classes, widths,
 * colours, theta and phi, surface colour) and drawn, all against each other, by dp_finish. Nothing is
 * enabled at first. Calls that are wrong (a vertex outside begin and end, begin twice, …) are
 * remembered and reported by dp_finish, so that no call in between needs to be checked. */
#ifndef DRYPOINT_IMMEDIATE_H
#define DRYPOINT_IMMEDIATE_H

#include <drypoint/draw.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum dp_primitive_kind {
    DP_TRIANGLES = 0,
    DP_TRIANGLE_STRIP,
    DP_TRIANGLE_FAN,
    DP_QUADS,
    DP_QUAD_STRIP,
    DP_POLYGON
} dp_primitive_kind;

DP_API void dp_enable(dp_context *context, uint32_t lines);
DP_API void dp_disable(dp_context *context, uint32_t lines);
DP_API void dp_line_width(dp_context *context, uint32_t lines, float px);
DP_API void dp_line_color(dp_context *context, uint32_t lines, dp_color color);
DP_API void dp_ridge_angle(dp_context *context, float degrees);
DP_API void dp_valley_angle(dp_context *context, float degrees);
DP_API void dp_surface_color(dp_context *context, dp_color color);

/* What holds for the whole picture: method, between, ink, passes, paper. Copied. */
DP_API void dp_set_style(dp_context *context, const dp_style *style);
DP_API void dp_set_camera(dp_context *context, const dp_camera *camera);

DP_API void dp_begin(dp_context *context, dp_primitive_kind kind);
DP_API void dp_edge_flag(dp_context *context, bool flag); /* of the edges that start from now on */
DP_API void dp_vertex3f(dp_context *context, float x, float y, float z);
DP_API void dp_vertex3fv(dp_context *context, const float xyz[3]);
DP_API void dp_end(dp_context *context);

/* Draws what was recorded and forgets it; state stays. Errors as dp_draw, and DP_ERR_ARGUMENT for the
 * first wrong call since the last dp_finish, in which case nothing is drawn. */
DP_API dp_result dp_finish(dp_context *context, const dp_target *target, dp_diag *diag);

#ifdef __cplusplus
}
#endif
#endif
