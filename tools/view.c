/* From settings to camera, style and target.
 *
 *     given              camera
 *     nothing, or a view fitted to what is drawn
 *     --target           as fitted, but around that point
 *     --eye              towards the box's centre, showing it whole unless --fov is given
 *     --eye, --target    as given */
#include "commands.h"
#include "report.h"
#include "sides.h"

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

static void view_direction(const tool_settings *s, const model_sides *sides, double d[3],
                           double up[3]) {
    static const double angles[][2] = {[0] = {45, 22.989}, /* 1, 0.6, 1 */
                                       [VIEW_FRONT] = {0, 0},
                                       [VIEW_BACK] = {180, 0},
                                       [VIEW_LEFT] = {-90, 0},
                                       [VIEW_RIGHT] = {90, 0},
                                       [VIEW_TOP] = {0, 90},
                                       [VIEW_BOTTOM] = {0, -90},
                                       [VIEW_ISO] = {45, 35.264389682754654}};
    if (s->has_azimuth || s->has_elevation)
        sides_angles(sides, s->has_azimuth ? s->azimuth : angles[s->view][0],
                     s->has_elevation ? s->elevation : angles[s->view][1], d, up);
    else
        sides_view(sides, s->view, d, up);
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

/* A scale is of lengths in the picture, which perspective does not keep. */
static bool is_orthographic(const tool_settings *s) { return s->has_ortho || s->scale.paper > 0; }

static double distance_between(const double a[3], const double b[3]) {
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                (a[2] - b[2]) * (a[2] - b[2]));
}

static dp_result project(const tool_settings *s, const dp_extent *extent, const box *b, double fov,
                         double height, dp_camera *camera) {
    const double zoom = s->zoom > 0 ? s->zoom : 1;
    double near_z, far_z;
    dp_camera_near_far(camera, extent->min, extent->max, &near_z, &far_z);
    if (is_orthographic(s))
        return dp_camera_orthographic(camera, height / zoom, b->aspect, near_z, far_z);
    return dp_camera_perspective(camera, zoomed(fov, zoom), b->aspect, near_z, far_z);
}

/* Places a camera for which an eye or a target is given. */
static dp_result place(const tool_settings *s, const dp_source *source, const dp_extent *extent,
                       double aspect, dp_camera *camera) {
    const box b = box_of(extent, aspect);
    model_sides sides;
    double target[3], eye[3], up[3];
    sides_of(s, source, &sides);
    memcpy(up, sides.up, sizeof up);
    memcpy(target, s->has_target ? s->target : b.centre, sizeof target);
    const double radius = b.radius + distance_between(target, b.centre);
    double fov = s->has_fov ? s->fov : default_fov;
    if (s->has_eye) {
        memcpy(eye, s->eye, sizeof eye);
        if (!s->has_fov && !s->has_target)
            fov = fov_for(radius, distance_between(eye, target), b.aspect);
    } else {
        double d[3];
        view_direction(s, &sides, d, up);
        const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        const double distance = radius / sin(smaller_half(fov, b.aspect));
        for (int k = 0; k < 3; k++) eye[k] = target[k] + d[k] / length * distance;
    }
    const dp_result wrong = dp_camera_look_at(camera, eye, target, up);
    if (wrong) return wrong;
    const double fitted = 2 * radius / (b.aspect < 1 ? b.aspect : 1);
    return project(s, extent, &b, fov, s->ortho > 0 ? s->ortho : fitted, camera);
}

bool is_camera_fitted(const tool_settings *s) {
    return !s->sheet.count && !s->has_eye && !s->has_target;
}

/* Pages ask for the eye before they know the picture's shape. */
double first_aspect(const tool_settings *s) {
    const dp_target target = make_target(s);
    return s->page.width > 0 || s->scale.paper > 0 ? 1 : (double)target.width / target.height;
}

dp_result fit_camera(const tool_settings *s, dp_source *source, const dp_extent *beside,
                     double aspect, dp_camera *camera, dp_extent *extent, dp_diag *diag) {
    dp_fit wanted = {.fov_y = s->fov,
                     .orthographic = is_orthographic(s),
                     .height = s->ortho,
                     .aspect = aspect,
                     .zoom = s->zoom};
    model_sides sides;
    sides_of(s, source, &sides);
    view_direction(s, &sides, wanted.direction, wanted.up);
    memcpy(wanted.exact_min, beside->exact_min, sizeof wanted.exact_min);
    memcpy(wanted.exact_max, beside->exact_max, sizeof wanted.exact_max);
    return dp_camera_fit_source(camera, &wanted, source, extent, diag);
}

int make_camera(const tool_settings *s, dp_source *source, const measured *model, double aspect,
                dp_camera *camera) {
    dp_diag diag = {0};
    dp_result wrong;
    memset(camera, 0, sizeof *camera);
    if (model->aspect == aspect) {
        *camera = model->fitted;
        return 0;
    }
    if (!is_camera_fitted(s)) {
        wrong = place(s, source, &model->extent, aspect, camera);
        if (!wrong) return 0;
        wrong_usage("the eye is where it looks at, or the model's size is beyond all numbers; move "
                    "--eye or --target");
        return EXIT_USAGE;
    }
    wrong = fit_camera(s, source, &model->beside, aspect, camera, NULL, &diag);
    if (!wrong) return 0;
    if (wrong != DP_ERR_ARGUMENT) return report_failure(s->model, &diag);
    wrong_usage("the model's box cannot be fitted; say where to look from with --eye and "
                "--target");
    return EXIT_USAGE;
}

/* ---- style and target ---- */

/* Lines that would not be seen are not drawn: no pen follows them. */
static void leave_out_transparent(dp_style *style) {
    if (style->hidden.look != DP_HIDDEN_NONE) return; /* theirs may be seen */
    if (!style->lines) style->lines = DP_ALL_LINES;
    for (int k = 0; k < DP_LINE_COUNT; k++)
        if (style->line[k].color && !(style->line[k].color & 0xFF)) style->lines &= ~(1u << k);
    if (!style->lines) style->lines = DP_NO_LINES;
}

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
    style.xray = (float)s->xray;
    style.xray_layers = s->xray_layers;
    style.detail = s->has_detail ? (float)s->detail : s->gl ? 0 : 1; /* OpenGL's are exact */
    if (s->smooth > 1) { /* the first word is off, the second auto */
        style.smooth = s->smooth_what == 2 ? DP_SMOOTH_SILHOUETTES : DP_SMOOTH_SURFACE;
        style.smooth_level = (uint32_t)s->smooth - 2;
    }
    style.passes = s->passes;
    style.cull_back_faces = s->cull_back_faces;
    style.edge_table_off = s->edge_table == SWITCH_OFF;
    leave_out_transparent(&style);
    return style;
}

dp_target make_target(const tool_settings *s) {
    static const uint32_t samples[] = {4, 1, 4, 8, 16}; /* by word, first the default */
    return (dp_target){.width = s->width ? s->width : 1600,
                       .height = s->height ? s->height : 1200,
                       .samples = samples[s->samples]};
}
