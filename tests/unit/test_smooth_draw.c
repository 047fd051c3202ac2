/* Smoothing in drawings: how near silhouettes come to the exact curve, that they have no gap, and what
 * else a style says of it. */
#include <drypoint/drypoint.h>

#include "reading.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIZE = 800, BINS = 720 };
static const double PI = 3.14159265358979323846;

/* ------- exact curves ------- */

typedef struct view {
    double eye[3], right[3], up[3], ahead[3], focal; /* px */
} view;

static double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static view view_of(const dp_camera *camera, const double eye[3]) {
    view v;
    for (int k = 0; k < 3; k++) {
        v.eye[k] = eye[k];
        v.right[k] = camera->view[4 * k], v.up[k] = camera->view[4 * k + 1];
        v.ahead[k] = -camera->view[4 * k + 2];
    }
    v.focal = camera->projection[5] * SIZE / 2;
    return v;
}

static void project(const view *v, const double p[3], double at[2]) {
    const double d[3] = {p[0] - v->eye[0], p[1] - v->eye[1], p[2] - v->eye[2]};
    at[0] = SIZE / 2 + v->focal * dot(d, v->right) / dot(d, v->ahead);
    at[1] = SIZE / 2 - v->focal * dot(d, v->up) / dot(d, v->ahead);
}

/* A surface of revolution around y: its tube has radius r around a circle of radius R; R 0: a
 * sphere. */
typedef struct surface {
    double R, r;
} surface;

static void point_on(const surface *s, double u, double v, double p[3], double n[3]) {
    n[0] = cos(u) * cos(v), n[1] = sin(v), n[2] = sin(u) * cos(v);
    p[0] = s->R * cos(u) + s->r * n[0], p[1] = s->r * n[1], p[2] = s->R * sin(u) + s->r * n[2];
}

enum { CURVE = 200000 };
static double curve[CURVE][2];
static size_t curve_count;

/* Contour points: where the normal is at right angles to the line of sight. */
static void find_curve(const surface *s, const view *view) {
    curve_count = 0;
    for (int i = 0; i < 4000; i++) {
        double last = 0;
        for (int k = 0; k <= 720; k++) {
            double p[3], n[3], to[3];
            const double u = 2 * PI * i / 4000, v = 2 * PI * k / 720;
            point_on(s, u, v, p, n);
            for (int c = 0; c < 3; c++) to[c] = p[c] - view->eye[c];
            const double facing = dot(to, n);
            if (k && facing * last < 0 && curve_count < CURVE) {
                point_on(s, u, v - 2 * PI / 720 * facing / (facing - last), p, n);
                project(view, p, curve[curve_count++]);
            }
            last = facing;
        }
    }
}

static double from_curve(double x, double y) {
    double least = INFINITY;
    for (size_t i = 0; i < curve_count; i++) {
        const double dx = curve[i][0] - x, dy = curve[i][1] - y;
        least = fmin(least, dx * dx + dy * dy);
    }
    return sqrt(least);
}

/* ------- drawing a generated model ------- */

/* Reads a shape and gives it the surface's own normals. */
typedef struct model {
    dp_source *shape, *source;
    dp_batch batch;
    float (*normals)[3];
} model;

static model open_model(const char *name, uint64_t triangles, const surface *s) {
    model m;
    const dp_shape_desc desc = {.name = name, .triangles = triangles};
    dp_diag diag;
    assert_int_equal(dp_source_shape(&desc, &m.shape, &diag), DP_OK);
    assert_int_equal(dp_source_next(m.shape, &m.batch, &diag), DP_OK);
    assert_true(m.batch.stable);
    m.normals = calloc(m.batch.vertex_count, sizeof *m.normals);
    assert_non_null(m.normals);
    for (size_t v = 0; v < m.batch.vertex_count; v++) {
        const float *const p =
            (const float *)(const void *)((const char *)m.batch.positions + v * m.batch.position_stride);
        const double out = sqrt((double)(p[0] * p[0] + p[2] * p[2])), off = 1 - (s->R > 0 ? s->R / out : 0);
        m.normals[v][0] = (float)(p[0] * off / s->r), m.normals[v][1] = (float)(p[1] / s->r);
        m.normals[v][2] = (float)(p[2] * off / s->r);
    }
    m.batch.normals = (dp_attribute){m.normals[0], 12, m.batch.vertex_count, NULL};
    assert_int_equal(dp_source_from_arrays(&m.batch, NULL, &m.source, &diag), DP_OK);
    return m;
}

static void close_model(model *m) {
    dp_source_destroy(m->source);
    dp_source_destroy(m->shape);
    free(m->normals);
}

static const dp_segment *draw(dp_context *c, const model *m, int turn, const dp_style *style, view *v,
                              size_t *count) {
    static const double axis[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    static uint8_t rgba[4 * SIZE * SIZE];
    const double az = 0.37 + 0.61 * turn, el = 0.15 + 0.17 * (turn % 5);
    const double eye[3] = {3.6 * cos(az) * cos(el), 3.6 * sin(el), 3.6 * sin(az) * cos(el)};
    const dp_target target = {.width = SIZE, .height = SIZE, .rgba = rgba};
    dp_camera camera;
    dp_diag diag;
    dp_camera_look_at(&camera, eye, axis, up);
    dp_camera_perspective(&camera, 40, 1, 0.1, 100);
    *v = view_of(&camera, eye);
    assert_int_equal(dp_draw(c, m->source, &camera, style, &target, &diag), DP_OK);
    return dp_segments(c, count);
}

static double length_of(const dp_segment *s) {
    return hypot((double)(s->b[0] - s->a[0]), (double)(s->b[1] - s->a[1]));
}

/* Mean distance of the drawn silhouette from the exact curve, px. */
static double mean_distance(const dp_segment *s, size_t count) {
    double sum = 0, length = 0;
    for (size_t i = 0; i < count; i++) {
        const double own = length_of(&s[i]);
        double distance = 0;
        for (int k = 0; k < 4; k++) {
            const double t = (k + 0.5) / 4;
            distance += from_curve((double)s[i].a[0] * (1 - t) + (double)s[i].b[0] * t,
                                   (double)s[i].a[1] * (1 - t) + (double)s[i].b[1] * t) / 4;
        }
        sum += own * distance, length += own;
    }
    return sum / length;
}

static double from_segment(const dp_segment *s, const double p[2]) {
    const double dx = (double)(s->b[0] - s->a[0]), dy = (double)(s->b[1] - s->a[1]),
                 px = p[0] - (double)s->a[0], py = p[1] - (double)s->a[1], square = dx * dx + dy * dy;
    const double t = square > 0 ? fmin(fmax((px * dx + py * dy) / square, 0), 1) : 0;
    return hypot(px - t * dx, py - t * dy);
}

/* The farthest, in px, that a point of the outline (the curve's farthest point in each direction) has
 * to the nearest line: half of what a gap is wide. */
static double widest_gap(const dp_segment *s, size_t count) {
    double widest = 0;
    for (int b = 0; b < BINS; b++) {
        const double x = cos(2 * PI * b / BINS), y = sin(2 * PI * b / BINS);
        size_t best = 0;
        double least = INFINITY;
        for (size_t i = 1; i < curve_count; i++)
            if (curve[i][0] * x + curve[i][1] * y > curve[best][0] * x + curve[best][1] * y) best = i;
        for (size_t i = 0; i < count; i++) least = fmin(least, from_segment(&s[i], curve[best]));
        widest = fmax(widest, least);
    }
    return widest;
}

static void measure(const char *name, uint64_t triangles, surface s, dp_smoothing what, uint32_t level,
                    double most) {
    const dp_style style = {.lines = DP_SILHOUETTE, .smooth = what, .smooth_level = level};
    model m = open_model(name, triangles, &s);
    dp_context *c = NULL;
    dp_diag diag;
    double worst = 0, gap = 0;
    assert_int_equal(dp_context_create(NULL, &c, &diag), DP_OK);
    for (int turn = 0; turn < 10; turn++) {
        size_t count;
        view v;
        const dp_segment *const segments = draw(c, &m, turn, &style, &v, &count);
        find_curve(&s, &v);
        worst = fmax(worst, mean_distance(segments, count));
        gap = fmax(gap, widest_gap(segments, count));
    }
    print_message("%s of %u: level %u, %s: mean distance %.3f px, widest gap %.3f px\n", name,
                  (unsigned)triangles, level, what == DP_SMOOTH_SURFACE ? "surface" : "silhouettes",
                  worst, gap);
    assert_true(worst <= most);
    assert_true(gap <= 1.5);
    dp_context_destroy(c);
    close_model(&m);
}

static const surface SPHERE = {0, 1};

static surface torus_of(void) { /* as it is generated: as wide as 2 units */
    const dp_shape_desc desc = {.name = "torus", .triangles = 576};
    dp_source *source = NULL;
    dp_extent e;
    dp_diag diag;
    assert_int_equal(dp_source_shape(&desc, &source, &diag), DP_OK);
    assert_int_equal(dp_source_extent(source, &e, &diag), DP_OK);
    dp_source_destroy(source);
    const double r = e.exact_max[1];
    return (surface){e.exact_max[0] - r, r};
}

static void a_sphere_of_320_triangles_is_round(void **state) {
    (void)state;
    measure("sphere", 320, SPHERE, DP_SMOOTH_SILHOUETTES, 4, 0.5);
    measure("sphere", 320, SPHERE, DP_SMOOTH_SURFACE, 4, 0.5);
    measure("sphere", 320, SPHERE, DP_SMOOTH_SILHOUETTES, 0, 0.5);
    measure("sphere", 320, SPHERE, DP_SMOOTH_SURFACE, 0, 0.5);
}

static void a_torus_of_576_triangles_is_round(void **state) {
    (void)state;
    const surface torus = torus_of();
    measure("torus", 576, torus, DP_SMOOTH_SILHOUETTES, 4, 0.5);
    measure("torus", 576, torus, DP_SMOOTH_SURFACE, 4, 0.5);
    measure("torus", 576, torus, DP_SMOOTH_SILHOUETTES, 0, 0.5);
    measure("torus", 576, torus, DP_SMOOTH_SURFACE, 0, 0.5);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sphere_of_320_triangles_is_round),
        cmocka_unit_test(a_torus_of_576_triangles_is_round),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
