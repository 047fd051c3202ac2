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

static double dot(const double *a, const double *b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

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

/* Walks along one parameter, with the other at `at`, and takes the points where the normal is at right
 * angles to the line of sight. */
static void walk(const surface *s, const view *seen, double at, bool along_u) {
    enum { STEPS = 360 };
    double last = 0;
    for (int k = 0; k <= STEPS; k++) {
        double p[3], n[3], to[3];
        const double t = 2 * PI * k / STEPS;
        point_on(s, along_u ? t : at, along_u ? at : t, p, n);
        for (int c = 0; c < 3; c++) to[c] = p[c] - seen->eye[c];
        const double facing = dot(to, n);
        if (k && facing * last < 0 && curve_count < CURVE) {
            const double zero = t - 2 * PI / STEPS * facing / (facing - last);
            point_on(s, along_u ? zero : at, along_u ? at : zero, p, n);
            project(seen, p, curve[curve_count++]);
        }
        last = facing;
    }
}

static void find_curve(const surface *s, const view *seen) {
    enum { WALKS = 6000 };
    curve_count = 0;
    for (int i = 0; i < 2 * WALKS; i++) walk(s, seen, 2 * PI * i / WALKS, i % 2);
}

static double from_curve(double x, double y) {
    double least = INFINITY;
    for (size_t i = 0; i < curve_count; i++) {
        const double dx = curve[i][0] - x, dy = curve[i][1] - y;
        least = fmin(least, dx * dx + dy * dy);
    }
    return sqrt(least);
}

/* ------- models: soups of triangles with the surface's own normals ------- */

typedef struct model {
    float positions[3 * 600][3], normals[3 * 600][3];
    size_t corners;
    dp_source *source;
} model;

static void add_corner(model *m, const double p[3], const double n[3]) {
    for (int k = 0; k < 3; k++)
        m->positions[m->corners][k] = (float)p[k], m->normals[m->corners][k] = (float)n[k];
    m->corners++;
}

static void open_model(model *m) {
    const dp_batch batch = {.positions = m->positions[0],
                            .vertex_count = m->corners,
                            .corner_count = m->corners,
                            .polygon_count = m->corners / 3,
                            .normals = {m->normals[0], 12, m->corners, NULL},
                            .stable = true};
    dp_diag diag;
    assert_int_equal(dp_source_from_arrays(&batch, NULL, &m->source, &diag), DP_OK);
}

/* A triangle of a sphere, or the four that it is cut into. */
static void add_sphere(model *m, const double a[3], const double b[3], const double c[3],
                       int cuts) {
    const double *const at[3] = {a, b, c};
    double middle[3][3];
    if (!cuts) {
        for (int i = 0; i < 3; i++) add_corner(m, at[i], at[i]);
        return;
    }
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) middle[i][k] = at[i][k] + at[(i + 1) % 3][k];
        const double length = sqrt(dot(middle[i], middle[i]));
        for (int k = 0; k < 3; k++) middle[i][k] /= length;
    }
    for (int i = 0; i < 3; i++) add_sphere(m, at[i], middle[i], middle[(i + 2) % 3], cuts - 1);
    add_sphere(m, middle[0], middle[1], middle[2], cuts - 1);
}

/* 20 * 4^2 triangles. */
static void make_sphere(model *m) {
    static const int faces[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                     {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                     {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                     {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    const double t = (1 + sqrt(5)) / 2, s = 1 / sqrt(1 + t * t), l = t * s;
    const double v[12][3] = {{-s, l, 0}, {s, l, 0}, {-s, -l, 0}, {s, -l, 0},
                             {0, -s, l}, {0, s, l}, {0, -s, -l}, {0, s, -l},
                             {l, 0, -s}, {l, 0, s}, {-l, 0, -s}, {-l, 0, s}};
    m->corners = 0;
    for (int i = 0; i < 20; i++) add_sphere(m, v[faces[i][0]], v[faces[i][1]], v[faces[i][2]], 2);
    assert_int_equal(m->corners, 3 * 320);
    open_model(m);
}

/* 24 * 12 * 2 triangles. */
static void make_torus(model *m, const surface *s) {
    static const int corner[6][2] = {{0, 0}, {1, 1}, {1, 0}, {0, 0}, {0, 1}, {1, 1}};
    m->corners = 0;
    for (int i = 0; i < 24; i++)
        for (int k = 0; k < 12; k++)
            for (int c = 0; c < 6; c++) {
                double p[3], n[3];
                point_on(s, 2 * PI * ((i + corner[c][0]) % 24) / 24,
                         2 * PI * ((k + corner[c][1]) % 12) / 12, p, n);
                add_corner(m, p, n);
            }
    assert_int_equal(m->corners, 3 * 576);
    open_model(m);
}

/* ------- drawing ------- */

static uint8_t rgba[4 * SIZE * SIZE];

static const dp_segment *draw(dp_context *c, const model *m, int turn, const dp_style *style,
                              view *v, size_t *count) {
    static const double axis[3] = {0, 0, 0}, up[3] = {0, 1, 0};
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
                                   (double)s[i].a[1] * (1 - t) + (double)s[i].b[1] * t) /
                        4;
        }
        sum += own * distance, length += own;
    }
    return sum / length;
}

static double from_segment(const dp_segment *s, const double p[2]) {
    const double dx = (double)(s->b[0] - s->a[0]), dy = (double)(s->b[1] - s->a[1]),
                 px = p[0] - (double)s->a[0], py = p[1] - (double)s->a[1],
                 square = dx * dx + dy * dy;
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
            if (curve[i][0] * x + curve[i][1] * y > curve[best][0] * x + curve[best][1] * y)
                best = i;
        for (size_t i = 0; i < count; i++) least = fmin(least, from_segment(&s[i], curve[best]));
        widest = fmax(widest, least);
    }
    return widest;
}

/* What is measured: silhouettes alone and the whole surface, by size and at level 4. */
enum { WAYS = 4 };
static dp_style way(int i) {
    return (dp_style){.lines = DP_SILHOUETTE,
                      .smooth = i % 2 ? DP_SMOOTH_SURFACE : DP_SMOOTH_SILHOUETTES,
                      .smooth_level = i / 2 ? 4 : 0};
}

static void measure(model *m, const surface *s, const char *name) {
    double worst[WAYS] = {0}, gap[WAYS] = {0};
    dp_context *c = NULL;
    dp_diag diag;
    assert_int_equal(dp_context_create(NULL, &c, &diag), DP_OK);
    for (int turn = 0; turn < 10; turn++)
        for (int i = 0; i < WAYS; i++) {
            const dp_style style = way(i);
            size_t count;
            view v;
            const dp_segment *const segments = draw(c, m, turn, &style, &v, &count);
            if (i == 0) find_curve(s, &v);
            worst[i] = fmax(worst[i], mean_distance(segments, count));
            gap[i] = fmax(gap[i], widest_gap(segments, count));
        }
    for (int i = 0; i < WAYS; i++) {
        print_message("%s, level %u, %s: mean distance %.3f px, widest gap %.3f px\n", name,
                      way(i).smooth_level, i % 2 ? "surface" : "silhouettes", worst[i], gap[i]);
        assert_true(worst[i] <= 0.5);
        assert_true(gap[i] <= 1);
    }
    dp_context_destroy(c);
    dp_source_destroy(m->source);
}

static model one; /* large */

static void a_sphere_of_320_triangles_is_round(void **state) {
    (void)state;
    make_sphere(&one);
    measure(&one, &(surface){0, 1}, "sphere");
}

static void a_torus_of_576_triangles_is_round(void **state) {
    (void)state;
    const surface torus = {0.68, 0.27};
    make_torus(&one, &torus);
    measure(&one, &torus, "torus");
}

/* ------- styles ------- */

static void levels_out_of_range_are_refused(void **state) {
    (void)state;
    dp_style resolved;
    dp_diag diag;
    dp_style style = {.smooth = DP_SMOOTH_SURFACE, .smooth_level = DP_SMOOTH_LEVELS + 1};
    assert_int_equal(dp_style_resolve(&style, &resolved, &diag), DP_ERR_ARGUMENT);
    style = (dp_style){.smooth = (dp_smoothing)3};
    assert_int_equal(dp_style_resolve(&style, &resolved, &diag), DP_ERR_ARGUMENT);
    style = (dp_style){.smooth = DP_SMOOTH_SILHOUETTES, .smooth_level = DP_SMOOTH_LEVELS};
    assert_int_equal(dp_style_resolve(&style, &resolved, &diag), DP_OK);
}

/* Pixels that differ. */
static size_t difference(const uint8_t *a, const uint8_t *b) {
    size_t count = 0;
    for (size_t i = 0; i < (size_t)4 * SIZE * SIZE; i += 4) count += memcmp(a + i, b + i, 4) != 0;
    return count;
}

static void threads_do_not_matter_and_styles_work_together(void **state) {
    (void)state;
    static uint8_t first[4 * SIZE * SIZE];
    const dp_style styles[] = {
        {.smooth = DP_SMOOTH_SILHOUETTES},
        {.smooth = DP_SMOOTH_SURFACE, .shade = {.shading = DP_SHADING_GOOCH}},
        {.smooth = DP_SMOOTH_SURFACE, .hidden = {.look = DP_HIDDEN_DASHED}},
        {.smooth = DP_SMOOTH_SURFACE, .edges = DP_EDGES_ADJACENCY},
        {.smooth = DP_SMOOTH_SILHOUETTES, .ink = DP_INK_QUADS},
        {.smooth = DP_SMOOTH_SURFACE, .edge_table_off = true},
        {.smooth = DP_SMOOTH_SURFACE, .shade = {.shading = DP_SHADING_PENCIL}},
        {.smooth = DP_SMOOTH_SURFACE, .mirror = {{0, 1, 0}, -0.5, {0, 0, 0}, 3, 0, 0, 0}},
        {.smooth = DP_SMOOTH_SURFACE,
         .smooth_level = 3,
         .edge_map = {.detector = DP_EDGE_MAP_DIAGONAL}},
    };
    make_torus(&one, &(surface){0.68, 0.27});
    for (size_t i = 0; i < sizeof styles / sizeof *styles; i++) {
        dp_style plain = styles[i];
        plain.smooth = DP_SMOOTH_OFF;
        for (uint32_t threads = 1; threads <= 3; threads++) {
            dp_context *c = NULL;
            dp_diag diag;
            size_t count;
            view v;
            assert_int_equal(dp_context_create(&(dp_context_desc){.threads = threads}, &c, &diag),
                             DP_OK);
            if (threads == 3) { /* a context that has drawn something else */
                draw(c, &one, 1, &plain, &v, &count);
                assert_true(difference(rgba, first) > 200);
            }
            draw(c, &one, 1, &styles[i], &v, &count);
            if (threads == 1) memcpy(first, rgba, sizeof first);
            assert_memory_equal(first, rgba, sizeof first);
            dp_context_destroy(c);
        }
    }
    dp_source_destroy(one.source);
}

/* ------- memory ------- */

typedef struct budget {
    long left; /* allocations that are granted */
    long held; /* blocks */
} budget;

static void *spend(size_t size, void *user) {
    budget *const b = user;
    if (b->left-- <= 0) return NULL;
    b->held++;
    return malloc(size);
}
static void *spend_more(void *block, size_t size, void *user) {
    budget *const b = user;
    if (b->left-- <= 0) return NULL;
    if (!block) b->held++;
    return realloc(block, size);
}
static void give_back(void *block, void *user) {
    if (block) ((budget *)user)->held--;
    free(block);
}

static void want_of_memory_is_told(void **state) {
    (void)state;
    static const double eye[3] = {2, 1, 3}, at[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    const dp_style style = {.smooth = DP_SMOOTH_SURFACE, .shade = {.shading = DP_SHADING_GOOCH}};
    const dp_target target = {.width = 64, .height = 48, .rgba = rgba, .samples = 1};
    dp_camera camera;
    dp_diag diag;
    dp_camera_look_at(&camera, eye, at, up);
    dp_camera_perspective(&camera, 40, 1, 0.1, 100);
    make_sphere(&one);
    for (long granted = 0, done = 0; !done; granted++) {
        budget b = {1000000, 0};
        const dp_allocator memory = {spend, spend_more, give_back, &b};
        dp_context *c = NULL;
        assert_int_equal(
            dp_context_create(&(dp_context_desc){.allocator = &memory, .threads = 1}, &c, &diag),
            DP_OK);
        b.left = granted;
        const dp_result result = dp_draw(c, one.source, &camera, &style, &target, &diag);
        assert_true(result == DP_OK || result == DP_ERR_MEMORY);
        done = result == DP_OK;
        b.left = 1000000;
        assert_int_equal(dp_draw(c, one.source, &camera, &style, &target, &diag), DP_OK);
        dp_context_destroy(c);
        assert_int_equal(b.held, 0);
    }
    dp_source_destroy(one.source);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sphere_of_320_triangles_is_round),
        cmocka_unit_test(a_torus_of_576_triangles_is_round),
        cmocka_unit_test(levels_out_of_range_are_refused),
        cmocka_unit_test(threads_do_not_matter_and_styles_work_together),
        cmocka_unit_test(want_of_memory_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
