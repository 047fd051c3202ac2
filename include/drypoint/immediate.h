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
 * colours, theta and phi, surface colour) and drawn, all against each other, by dp_finish. Nothing
 * is enabled at first. Calls that are wrong (a vertex outside begin and end, begin twice, …) are
 * remembered and reported by dp_finish, so that no call in between needs to be checked.
 *
 * Not as in OpenGL: state may change between dp_begin and dp_end, and then holds from the next
 * dp_begin. As in OpenGL: vertices at dp_end that make no whole primitive are ignored. */
#ifndef DRYPOINT_IMMEDIATE_H
#define DRYPOINT_IMMEDIATE_H

#include <drypoint/draw.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Vertices are counted from 0; polygons are wound as given, fronts counter-clockwise. */
typedef enum dp_primitive_kind {
    DP_TRIANGLES = 0,
    DP_TRIANGLE_STRIP, /* (0, 1, 2), (2, 1, 3), (2, 3, 4), … */
    DP_TRIANGLE_FAN,   /* (0, 1, 2), (0, 2, 3), … */
    DP_QUADS,
    DP_QUAD_STRIP, /* (0, 1, 3, 2), (2, 3, 5, 4), … */
    DP_POLYGON     /* all vertices from dp_begin to dp_end, any number */
} dp_primitive_kind;

/* State. `lines` is a set of classes (DP_RIDGE | DP_VALLEY, say); widths in px, 0.5 to 64, 0 means
 * 2; angles in degrees in (0, 360), 0 means the default. What is out of range counts as a wrong
 * call and changes nothing. */

DP_API void dp_enable(dp_context *context, uint32_t lines);
DP_API void dp_disable(dp_context *context, uint32_t lines);
DP_API void dp_line_width(dp_context *context, uint32_t lines, float px);
DP_API void dp_line_color(dp_context *context, uint32_t lines, dp_color color);
DP_API void dp_ridge_angle(dp_context *context, float degrees);
DP_API void dp_valley_angle(dp_context *context, float degrees);
DP_API void dp_surface_color(dp_context *context, dp_color color);

/* What holds for the whole picture: method, between, between_offset, ink, passes, paper,
 * cull_back_faces, edge_table_off. Copied; the other members are state (above) and are not looked
 * at. NULL: all defaults. */
DP_API void dp_set_style(dp_context *context, const dp_style *style);
DP_API void dp_set_camera(dp_context *context, const dp_camera *camera);

DP_API void dp_begin(dp_context *context, dp_primitive_kind kind);
/* Of the edges that start from now on; true at first. An edge that two polygons of a strip or fan
 * share starts from its earlier vertex. */
DP_API void dp_edge_flag(dp_context *context, bool flag);
DP_API void dp_vertex3f(dp_context *context, float x, float y, float z);
DP_API void dp_vertex3fv(dp_context *context, const float xyz[3]);
DP_API void dp_end(dp_context *context);

/* Draws what was recorded and forgets it; state stays. Errors as dp_draw, and DP_ERR_ARGUMENT for
 * the first wrong call since the last dp_finish, in which case nothing is drawn. */
DP_API dp_result dp_finish(dp_context *context, const dp_target *target, dp_diag *diag);

#ifdef __cplusplus
}
#endif
#endif
