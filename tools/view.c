/* From settings to camera, style and target.
 *
 *     given              camera
 *     nothing, or a view the model's box, fitted
 *     --target           as fitted, but around that point
 *     --eye              towards the box's centre, showing it whole unless --fov is given
 *     --eye, --target    as given */
#include "commands.h"
#include "report.h"

#include <math.h>
#include <string.h>

static const double degree = 0.017453292519943295;
static const double default_fov = 35;

typedef struct box {
    double centre[3], radius; /* of the sphere around it */
    double aspect;            /* of the picture */
} box;

static box box_of(const dp_extent *extent, double aspect) {
    box b = {.aspect = aspect};
    for (int k = 0; k < 3; k++) {
        const double half = 0.5 * (extent->exact_max[k] - extent->exact_min[k]);
        b.centre[k] = extent->exact_min[k] + half;
        b.radius += half * half;
    }
    b.radius = b.radius > 0 ? sqrt(b.radius) : 1;
    return b;
}

/* ---- direction from the model to the eye ---- */

static void from_angles(double azimuth, double elevation, double d[3]) {
    d[0] = sin(azimuth * degree) * cos(elevation * degree);
    d[1] = sin(elevation * degree);
    d[2] = cos(azimuth * degree) * cos(elevation * degree);
    for (int k = 0; k < 3; k++)
        if (fabs(d[k]) < 1e-15) d[k] = 0;
}

static void view_direction(const tool_settings *s, double d[3]) {
    static const double angles[][2] = {[0] = {45, 22.989}, /* 1, 0.6, 1 */
                                       [VIEW_FRONT] = {0, 0},
                                       [VIEW_BACK] = {180, 0},
                                       [VIEW_LEFT] = {-90, 0},
                                       [VIEW_RIGHT] = {90, 0},
                                       [VIEW_TOP] = {0, 90},
                                       [VIEW_BOTTOM] = {0, -90},
                                       [VIEW_ISO] = {45, 35.264389682754654}};
    if (!s->view && !s->has_azimuth && !s->has_elevation) {
        memcpy(d, (const double[3]){1, 0.6, 1}, 3 * sizeof *d);
        return;
    }
    from_angles(s->has_azimuth ? s->azimuth : angles[s->view][0],
                s->has_elevation ? s->elevation : angles[s->view][1], d);
}

/* ---- fields of view, in degrees, vertical ---- */

/* Half the smaller of the vertical and the horizontal field of view. */
static double smaller_half(double fov, double aspect) {
    const double t = tan(0.5 * fov * degree);
    return atan(aspect < 1 ? t * aspect : t);
}

/* The vertical field of view that shows a sphere from a distance. */
static double fov_for(double radius, double distance, double aspect) {
    if (distance <= radius * 1.05)
        return default_fov; /* inside, or so near that perspective would distort */
    const double t = tan(asin(radius / distance));
    return 2 * atan(aspect < 1 ? t / aspect : t) / degree;
}

static double zoomed(double fov, double zoom) {
    return 2 * atan(tan(0.5 * fov * degree) / zoom) / degree;
}

/* ---- cameras ---- */

static double distance_between(const double a[3], const double b[3]) {
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                (a[2] - b[2]) * (a[2] - b[2]));
}

static dp_result project(const tool_settings *s, const dp_extent *extent, const box *b, double fov,
                         double height, dp_camera *camera) {
    const double zoom = s->zoom > 0 ? s->zoom : 1;
    double near_z, far_z;
    dp_camera_near_far(camera, extent->min, extent->max, &near_z, &far_z);
    if (s->has_ortho)
        return dp_camera_orthographic(camera, height / zoom, b->aspect, near_z, far_z);
    return dp_camera_perspective(camera, zoomed(fov, zoom), b->aspect, near_z, far_z);
}

/* Places a camera for which an eye or a target is given. */
static dp_result place(const tool_settings *s, const dp_extent *extent, double aspect,
                       dp_camera *camera) {
    static const double y_up[3] = {0, 1, 0};
    const box b = box_of(extent, aspect);
    double target[3], eye[3];
    memcpy(target, s->has_target ? s->target : b.centre, sizeof target);
    const double radius = b.radius + distance_between(target, b.centre);
    double fov = s->has_fov ? s->fov : default_fov;
    if (s->has_eye) {
        memcpy(eye, s->eye, sizeof eye);
        if (!s->has_fov && !s->has_target)
            fov = fov_for(radius, distance_between(eye, target), b.aspect);
    } else {
        double d[3];
        view_direction(s, d);
        const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        const double distance = radius / sin(smaller_half(fov, b.aspect));
        for (int k = 0; k < 3; k++) eye[k] = target[k] + d[k] / length * distance;
    }
    const dp_result wrong = dp_camera_look_at(camera, eye, target, s->has_up ? s->up : y_up);
    if (wrong) return wrong;
    const double fitted = 2 * radius / (b.aspect < 1 ? b.aspect : 1);
    return project(s, extent, &b, fov, s->ortho > 0 ? s->ortho : fitted, camera);
}

static dp_result fit(const tool_settings *s, const dp_extent *extent, double aspect,
                     dp_camera *camera) {
    dp_fit wanted = {.fov_y = s->fov,
                     .orthographic = s->has_ortho,
                     .height = s->ortho,
                     .aspect = aspect,
                     .zoom = s->zoom};
    memcpy(wanted.exact_min, extent->exact_min, sizeof wanted.exact_min);
    memcpy(wanted.exact_max, extent->exact_max, sizeof wanted.exact_max);
    memcpy(wanted.up, s->up, sizeof wanted.up);
    view_direction(s, wanted.direction);
    return dp_camera_fit(camera, &wanted);
}

int make_camera(const tool_settings *s, const dp_extent *extent, double aspect, dp_camera *camera) {
    memset(camera, 0, sizeof *camera);
    const bool placed = s->has_eye || s->has_target;
    const dp_result wrong =
        placed ? place(s, extent, aspect, camera) : fit(s, extent, aspect, camera);
    if (!wrong) return 0;
    if (placed)
        wrong_usage("the eye is where it looks at, or the model's size is beyond all numbers; move "
                    "--eye or --target");
    else
        wrong_usage("the model's box cannot be fitted; say where to look from with --eye and "
                    "--target");
    return EXIT_USAGE;
}

/* ---- style and target ---- */

dp_style make_style(const tool_settings *s) {
    dp_style style = s->style;
    style.ridge_angle = (float)s->ridge_angle;
    style.valley_angle = (float)s->valley_angle;
    if (s->edges == EDGES_ADJACENCY) style.edges = DP_EDGES_ADJACENCY;
    if (s->method) style.method = (dp_method)(s->method - 1);
    if (s->between) style.between = (dp_between)(s->between - 1);
    /* extruded geometry is what adjacency is for */
    if (style.edges == DP_EDGES_ADJACENCY) style.ink = DP_INK_QUADS;
    if (s->ink) style.ink = (dp_ink)(s->ink - 1);
    if (s->sheet.count) style.hidden.look = DP_HIDDEN_DASHED;
    if (s->hidden == HIDDEN_NONE) style.hidden.look = DP_HIDDEN_NONE;
    if (s->hidden && s->hidden != HIDDEN_NONE) style.hidden.look = (dp_hidden_look)s->hidden;
    style.hidden.levels = s->levels;
    style.hidden.smooth = s->hidden_smooth;
    if (s->smooth > 1) { /* the first word is off, the second auto */
        style.smooth = s->smooth_what == 2 ? DP_SMOOTH_SILHOUETTES : DP_SMOOTH_SURFACE;
        style.smooth_level = (uint32_t)s->smooth - 2;
    }
    style.passes = s->passes;
    style.cull_back_faces = s->cull_back_faces;
    style.edge_table_off = s->edge_table == SWITCH_OFF;
    return style;
}

dp_target make_target(const tool_settings *s) {
    static const uint32_t samples[] = {4, 1, 4, 8, 16}; /* by word, first the default */
    return (dp_target){.width = s->width ? s->width : 1600,
                       .height = s->height ? s->height : 1200,
                       .samples = samples[s->samples]};
}
