/* drypoint/immediate.h: the API of Raskar 2001, Figure 3, in the style of OpenGL.
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
 * colours, theta and phi, surface colour); dp_finish draws all as one scene. Nothing is enabled at
 * first; edges of open surfaces (of a single triangle, say) are borders, and DP_SIL_RIDGE_VALLEY
 * does not hold those: enable DP_BORDER, too. Wrong calls (a vertex outside begin and end, begin twice, …) are reported by dp_finish,
 * so no call before it needs a check.
 *
 * As in OpenGL, vertices left at dp_end that make no whole primitive are ignored. Unlike OpenGL,
 * state may change between dp_begin and dp_end, and takes effect at the next dp_begin. */
#ifndef DRYPOINT_IMMEDIATE_H
#define DRYPOINT_IMMEDIATE_H

#include <drypoint/draw.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Which vertices, counted from 0 at dp_begin, make the polygons; fronts are counter-clockwise. */
typedef enum dp_primitive_kind {
    DP_TRIANGLES = 0,
    DP_TRIANGLE_STRIP, /* (0, 1, 2), (2, 1, 3), (2, 3, 4), … */
    DP_TRIANGLE_FAN,   /* (0, 1, 2), (0, 2, 3), … */
    DP_QUADS,
    DP_QUAD_STRIP, /* (0, 1, 3, 2), (2, 3, 5, 4), … */
    DP_POLYGON     /* all vertices from dp_begin to dp_end, any number */
} dp_primitive_kind;

/* State. `lines`: a set of classes (DP_RIDGE | DP_VALLEY, say). Widths: px, 0.5 to 64; 0 means 2.
 * Angles: degrees in (0, 360); 0 means the default. A value out of range is a wrong call and
 * changes nothing. */

DP_API void dp_enable(dp_context *context, uint32_t lines);
DP_API void dp_disable(dp_context *context, uint32_t lines);
DP_API void dp_line_width(dp_context *context, uint32_t lines, float px);
DP_API void dp_line_color(dp_context *context, uint32_t lines, dp_color color);
DP_API void dp_ridge_angle(dp_context *context, float degrees);
DP_API void dp_valley_angle(dp_context *context, float degrees);
DP_API void dp_surface_color(dp_context *context, dp_color color);
/* As dp_style.xray: 0 to 1; 0 and 1: opaque. */
DP_API void dp_surface_opacity(dp_context *context, float opacity);

/* What holds for the whole picture: paper, ink, strokes, patterns and light on lines, hidden lines, xray_layers,
 * the colour of sections, shading, edge map … Copied. lines, line, ridge_angle, valley_angle, surface and xray
 * are ignored: they are state (above). NULL: all defaults. */
DP_API void dp_set_style(dp_context *context, const dp_style *style);
DP_API void dp_set_camera(dp_context *context, const dp_camera *camera);

DP_API void dp_begin(dp_context *context, dp_primitive_kind kind);
/* Whether edges that start at the next vertices may draw; true at first. An edge shared by two
 * polygons of a strip or fan starts at its earlier vertex. */
DP_API void dp_edge_flag(dp_context *context, bool flag);
DP_API void dp_vertex3f(dp_context *context, float x, float y, float z);
DP_API void dp_vertex3fv(dp_context *context, const float xyz[3]);
/* In double precision: where models lie far from 0, so that float32 would be too coarse, all
 * vertices until dp_finish are counted from an origin among them (dp_batch). */
DP_API void dp_vertex3d(dp_context *context, double x, double y, double z);
DP_API void dp_vertex3dv(dp_context *context, const double xyz[3]);
DP_API void dp_end(dp_context *context);

/* Draws what was recorded and forgets it; state stays. Errors of dp_draw; DP_ERR_ARGUMENT for the
 * first wrong call since the last dp_finish, and then nothing is drawn. */
DP_API dp_result dp_finish(dp_context *context, const dp_target *target, dp_diag *diag);

#ifdef __cplusplus
}
#endif
#endif
