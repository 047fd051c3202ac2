/* Which lines of a model are visible, sample by sample.
 *
 *     each edge            its class, from its two polygons and the eye
 *     each line            clipped to the view volume and a margin, sampled every quarter pixel
 *     each sample          visible if a ray to the eye (to the near plane) meets no other polygon
 *
 * Rays start a tenth of a pixel off the surface, along the mean normal of the line's two polygons,
 * which themselves do not count. */
#include "reference.h"

#include "mesh.h"

#include <stdlib.h>
#include <string.h>

#define STEP  0.25 /* px between samples */
#define OFF   0.1  /* px that a ray starts off the surface */
#define BLIND 0.05 /* px of the ray's start in which nothing stops it */
#define EDGE_ON                                                                                    \
    1e-6 /* sine of the angle between a polygon and the sight under which its side is moot */
#define DOUBT 1.0 /* degrees around a threshold in which either answer will do */

static const double pi = 3.14159265358979323846;

/* The camera, taken apart. */
typedef struct sight {
    double clip[16]; /* world to clip space, column-major */
    v3 eye, forward; /* eye: perspective only */
    bool orthographic;
    double near;  /* distance of the near plane along the line of sight from the camera's origin */
    double scale; /* of the view matrix */
    double pixel; /* world units per pixel: at distance 1, or everywhere (orthographic) */
    double width, height;
    v3 origin;
} sight;

static sight view_of(const dp_camera *camera, uint32_t width, uint32_t height) {
    const double *v = camera->view, *p = camera->projection;
    sight made = {.width = width, .height = height};
    for (int c = 0; c < 4; c++)
        for (int r = 0; r < 4; r++)
            for (int k = 0; k < 4; k++) made.clip[4 * c + r] += p[4 * k + r] * v[4 * c + k];
    const double square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    made.scale = sqrt(square);
    made.origin = (v3){-(v[0] * v[12] + v[1] * v[13] + v[2] * v[14]) / square,
                       -(v[4] * v[12] + v[5] * v[13] + v[6] * v[14]) / square,
                       -(v[8] * v[12] + v[9] * v[13] + v[10] * v[14]) / square};
    made.eye = made.origin;
    made.forward = v3_unit((v3){-v[2], -v[6], -v[10]});
    made.orthographic = p[15] != 0;
    if (made.orthographic) {
        made.near = (1 + p[14]) / p[10] / made.scale;
        made.pixel = 2 / (p[5] * made.scale * height);
    } else {
        made.near = -p[14] / (1 - p[10]) / made.scale;
        made.pixel = 2 / (p[5] * height);
    }
    return made;
}

typedef struct v4 {
    double x, y, z, w;
} v4;

static v4 to_clip(const sight *view, v3 p) {
    const double *m = view->clip;
    return (v4){m[0] * p.x + m[4] * p.y + m[8] * p.z + m[12],
                m[1] * p.x + m[5] * p.y + m[9] * p.z + m[13],
                m[2] * p.x + m[6] * p.y + m[10] * p.z + m[14],
                m[3] * p.x + m[7] * p.y + m[11] * p.z + m[15]};
}

static double depth_of(const sight *view, v3 p) {
    return v3_dot(v3_sub(p, view->origin), view->forward);
}

static double pixel_at(const sight *view, double depth) {
    return view->orthographic ? view->pixel : view->pixel * depth;
}

/* Unit vector from p towards the eye. */
static v3 towards_eye(const sight *view, v3 p) {
    return view->orthographic ? v3_mul(view->forward, -1) : v3_unit(v3_sub(view->eye, p));
}

/* Sine of the angle at which the eye sees the polygon's front; negative: its back. */
static double facing(const sight *view, const ref_model *model, uint32_t polygon) {
    const mesh_polygon *p = &model->polygons[polygon];
    return v3_dot(p->normal, towards_eye(view, model->positions[model->corners[p->first]]));
}

/* A line to be followed. */
typedef struct feature {
    v3 a, b;
    v3 off; /* unit: away from the surface */
    uint32_t skip[2];
    unsigned kind;
} feature;

static bool visible(const ref_truth *truth, const sight *view, const feature *line, v3 p,
                    double depth) {
    const double pixel = pixel_at(view, depth);
    const v3 from = v3_add(p, v3_mul(line->off, OFF * pixel));
    const v3 direction = towards_eye(view, from);
    const double slope = -v3_dot(direction, view->forward);
    const double far = (depth_of(view, from) - view->near) / slope;
    return !rays_blocked(truth->model->rays, from, direction, BLIND * pixel, far, line->skip[0],
                         line->skip[1]);
}

/* Narrows [*from, *to] to where a function that is f0 at 0 and f1 at 1 is not negative. */
static void narrow(double f0, double f1, double *from, double *to) {
    if (f0 < 0 && f1 < 0)
        *to = -1;
    else if (f0 < 0)
        *from = fmax(*from, f0 / (f0 - f1));
    else if (f1 < 0)
        *to = fmin(*to, f0 / (f0 - f1));
}

/* Cuts the line down to the view volume with its margin. False: it is outside. */
static bool clip_line(const sight *view, feature *line) {
    const v4 a = to_clip(view, line->a), b = to_clip(view, line->b);
    const double mx = 1 + 2 * REF_MARGIN / view->width, my = 1 + 2 * REF_MARGIN / view->height;
    double from = 0, to = 1;
    narrow(a.z + a.w, b.z + b.w, &from, &to);
    narrow(a.w - a.z, b.w - b.z, &from, &to);
    narrow(mx * a.w - a.x, mx * b.w - b.x, &from, &to);
    narrow(mx * a.w + a.x, mx * b.w + b.x, &from, &to);
    narrow(my * a.w - a.y, my * b.w - b.y, &from, &to);
    narrow(my * a.w + a.y, my * b.w + b.y, &from, &to);
    if (from >= to) return false;
    const v3 p = line->a, q = line->b;
    line->a = v3_mix(p, q, from);
    line->b = v3_mix(p, q, to);
    return true;
}

static void add_piece(ref_truth *truth, const feature *line, const double a[3], const double b[3]) {
    mesh_reserve(&truth->pieces, &truth->piece_room, truth->piece_count + 1, sizeof *truth->pieces);
    truth->pieces[truth->piece_count++] = (ref_piece){.a = {a[0], a[1], a[2]},
                                                      .b = {b[0], b[1], b[2]},
                                                      .line = truth->line_count,
                                                      .kind = (uint8_t)line->kind};
}

/* The point a fraction u along the line on the screen, in space: even steps on the screen are not
 * even in space. wa, wb: clip space w of the ends. */
static v3 point_at(const feature *line, double wa, double wb, double u) {
    const double fa = (1 - u) / wa, fb = u / wb;
    return v3_mix(line->a, line->b, fb / (fa + fb));
}

static void follow(ref_truth *truth, const sight *view, feature line) {
    if (!clip_line(view, &line)) return;
    const v4 a = to_clip(view, line.a), b = to_clip(view, line.b);
    if (!(a.w > 0) || !(b.w > 0)) return;
    const double ax = (a.x / a.w + 1) / 2 * view->width, ay = (1 - a.y / a.w) / 2 * view->height;
    const double bx = (b.x / b.w + 1) / 2 * view->width, by = (1 - b.y / b.w) / 2 * view->height;
    const double length = hypot(bx - ax, by - ay);
    if (length < 1e-6) return;
    const size_t steps = (size_t)ceil(length / STEP);
    double start[3] = {0}, end[3] = {0};
    bool open = false;
    for (size_t i = 0; i <= steps; i++) {
        const double u = (i + 0.5) / steps, u0 = (double)i / steps;
        const v3 p = point_at(&line, a.w, b.w, fmin(u, 1));
        const double depth = depth_of(view, p);
        const bool seen = i < steps && visible(truth, view, &line, p, depth);
        if (seen != open) {
            double *const at = seen ? start : end;
            at[0] = ax + (bx - ax) * u0;
            at[1] = ay + (by - ay) * u0;
            at[2] = depth_of(view, point_at(&line, a.w, b.w, u0));
            if (!seen) add_piece(truth, &line, start, end);
            open = seen;
        }
        if (!seen) continue;
        const double x = ax + (bx - ax) * u, y = ay + (by - ay) * u;
        mesh_reserve(&truth->samples, &truth->sample_room, truth->sample_count + 1,
                     sizeof *truth->samples);
        truth->samples[truth->sample_count++] = (ref_sample){
            .x = (float)x,
            .y = (float)y,
            .nx = (float)((ay - by) / length),
            .ny = (float)((bx - ax) / length),
            .along = (float)u,
            .length = (float)length,
            .line = truth->line_count,
            .kind = (uint8_t)line.kind,
            .inside = x >= 2 && y >= 2 && x <= view->width - 2 && y <= view->height - 2};
    }
    truth->line_count++;
}

/* The dihedral angle, degrees: between the insides; flat is 180. */
static double dihedral(const ref_model *model, const mesh_edge *edge) {
    const mesh_polygon *p = &model->polygons[edge->polygon[0]];
    const mesh_polygon *q = &model->polygons[edge->polygon[1]];
    const double angle =
        atan2(v3_len(v3_cross(p->normal, q->normal)), v3_dot(p->normal, q->normal));
    const double side = v3_dot(p->normal, v3_sub(q->centre, model->positions[edge->a]));
    return 180 + (side < 0 ? -angle : angle) * 180 / pi;
}

/* The class of an edge, or REF_CLASS_COUNT for none. */
static unsigned class_of(const ref_model *model, const sight *view, const mesh_edge *edge,
                         double ridge_angle, double valley_angle) {
    const double first = facing(view, model, edge->polygon[0]);
    if (edge->flags == 2) return REF_CLASS_COUNT;
    if (edge->polygons > 2 || edge->flags == 3) return REF_NEUTRAL;
    if (edge->polygons == 1) return fabs(first) < EDGE_ON ? REF_NEUTRAL : DP_LINE_BORDER;
    const double second = facing(view, model, edge->polygon[1]);
    if (!edge->opposed || fabs(first) < EDGE_ON || fabs(second) < EDGE_ON) return REF_NEUTRAL;
    if ((first > 0) != (second > 0)) return DP_LINE_SILHOUETTE;
    if (first < 0) return REF_CLASS_COUNT;
    const double angle = dihedral(model, edge);
    if (fabs(angle - ridge_angle) < DOUBT || fabs(angle - valley_angle) < DOUBT) return REF_NEUTRAL;
    if (angle <= ridge_angle) return DP_LINE_RIDGE;
    return angle > valley_angle ? DP_LINE_VALLEY : REF_CLASS_COUNT;
}

static void follow_edge(ref_truth *truth, const sight *view, const mesh_edge *edge, unsigned kind) {
    const ref_model *model = truth->model;
    v3 off = model->polygons[edge->polygon[0]].normal;
    if (edge->polygons == 1 && facing(view, model, edge->polygon[0]) < 0) off = v3_mul(off, -1);
    if (edge->polygons >= 2) off = v3_unit(v3_add(off, model->polygons[edge->polygon[1]].normal));
    /* A fold whose back is nearer than its front is an outline when seen from behind, where an open
     * model lets one look; whether it is drawn is left to the library. */
    const bool behind = kind == DP_LINE_SILHOUETTE && dihedral(model, edge) > 180;
    feature line = {.a = model->positions[edge->a],
                    .b = model->positions[edge->b],
                    .off = off,
                    .skip = {edge->polygon[0], edge->polygon[1]},
                    .kind = behind ? REF_NEUTRAL : kind};
    follow(truth, view, line);
    if (!behind) return;
    line.off = v3_mul(off, -1);
    follow(truth, view, line);
}

static void follow_crossing(ref_truth *truth, const sight *view, const mesh_crossing *crossing) {
    const ref_model *model = truth->model;
    const uint32_t p = crossing->polygon[0], q = crossing->polygon[1];
    const bool front = facing(view, model, p) > EDGE_ON && facing(view, model, q) > EDGE_ON;
    follow(truth, view,
           (feature){.a = crossing->a,
                     .b = crossing->b,
                     .off = v3_unit(v3_add(model->polygons[p].normal, model->polygons[q].normal)),
                     .skip = {p, q},
                     .kind = front && !crossing->contact ? DP_LINE_INTERSECTION : REF_NEUTRAL});
}

ref_truth *ref_truth_create(const ref_model *model, const dp_camera *camera, uint32_t width,
                            uint32_t height, double ridge_angle, double valley_angle) {
    ref_truth *truth = calloc(1, sizeof *truth);
    const sight view = view_of(camera, width, height);
    if (truth == NULL) abort();
    truth->model = model;
    truth->camera = *camera;
    truth->width = width;
    truth->height = height;
    for (size_t e = 0; e < model->edge_count; e++) {
        const unsigned kind = class_of(model, &view, &model->edges[e], ridge_angle, valley_angle);
        if (kind < REF_CLASS_COUNT) follow_edge(truth, &view, &model->edges[e], kind);
    }
    for (size_t c = 0; c < model->crossing_count; c++)
        follow_crossing(truth, &view, &model->crossings[c]);
    return truth;
}

void ref_truth_destroy(ref_truth *truth) {
    if (truth == NULL) return;
    free(truth->samples);
    free(truth->pieces);
    free(truth);
}

size_t ref_truth_count(const ref_truth *truth, unsigned kind) {
    size_t count = 0;
    for (size_t i = 0; i < truth->sample_count; i++)
        count += truth->samples[i].kind == kind && truth->samples[i].inside;
    return count;
}

double ref_truth_pixel(const ref_truth *truth, double depth) {
    const sight view = view_of(&truth->camera, truth->width, truth->height);
    return pixel_at(&view, depth);
}

double ref_truth_surface(const ref_truth *truth, double x, double y) {
    const sight view = view_of(&truth->camera, truth->width, truth->height);
    const v3 right =
        v3_unit((v3){truth->camera.view[0], truth->camera.view[4], truth->camera.view[8]});
    const v3 up = v3_cross(right, view.forward);
    /* offsets of the projection (p[8], p[12], …) are zero in all cameras that tests use */
    const v3 across = v3_add(v3_mul(right, (x - view.width / 2) * view.pixel),
                             v3_mul(up, (view.height / 2 - y) * view.pixel));
    const v3 from = view.orthographic ? v3_add(view.origin, across) : view.eye;
    const v3 ray = view.orthographic ? view.forward : v3_add(view.forward, across);
    const double length = v3_len(ray);
    const double found = rays_nearest(truth->model->rays, from, v3_mul(ray, 1 / length),
                                      view.near * length, INFINITY, RAYS_NOBODY, RAYS_NOBODY);
    return found / length;
}
