/* What ends a segment (drypoint/draw.h), looked at with rays through random triangles. */
#include "base/hostile.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "sink_scene.h"

typedef struct point {
    double x, y, z;
} point;

static point at(const float p[3]) { return (point){(double)p[0], (double)p[1], (double)p[2]}; }
static point minus(point a, point b) { return (point){a.x - b.x, a.y - b.y, a.z - b.z}; }
static point along(point a, point b, double t) {
    return (point){a.x + t * b.x, a.y + t * b.y, a.z + t * b.z};
}
static double dot(point a, point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static point cross(point a, point b) {
    return (point){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static double length_of(point a) { return sqrt(dot(a, a)); }

/* Where a segment begins (0) or ends (1). */
static point end_of(const dp_segment *s, int k) {
    const double *const p = k ? s->world_b : s->world_a;
    return (point){p[0], p[1], p[2]};
}

/* Where the point is seen, px from the picture's middle, y up; third: towards the eye. */
static point seen_at(point p, bool flat) {
    const double focal = flat ? 1 : SCENE_HEIGHT / 2.0 / tan(25 * 3.14159265358979323846 / 180);
    const double scale = flat ? 1 : focal / (EYE - p.z);
    return (point){p.x * scale, p.y * scale, scale};
}

/* How far outside of a triangle on the screen, px. */
static double outside(const point corner[3], double x, double y) {
    const double turn = (corner[1].x - corner[0].x) * (corner[2].y - corner[0].y) -
                        (corner[1].y - corner[0].y) * (corner[2].x - corner[0].x);
    double most = -INFINITY;
    for (int i = 0; i < 3; i++) {
        const point a = corner[i], b = corner[(i + 1) % 3];
        const double ex = b.x - a.x, ey = b.y - a.y, side = ey * (x - a.x) - ex * (y - a.y);
        most = fmax(most, (turn > 0 ? side : -side) / hypot(ex, ey));
    }
    return most;
}

/* The hider covers a point within two pixels of the sample point behind a hidden end, an eighth of a
 * pixel on, and is nearer. Sample points are lifted by a tenth of a pixel, which planes seen edge-on magnify. */
static void check_hider(const dp_segment *s, int k, bool flat) {
    const point end = end_of(s, k), other = end_of(s, !k);
    const double px = hypot((double)s->b[0] - (double)s->a[0], (double)s->b[1] - (double)s->a[1]);
    const point beyond = along(end, minus(end, other), 0.125 / px), spot = seen_at(beyond, flat);
    point corner[3], on_screen[3];
    assert_true(s->hider[k] < made.polygons);
    assert_true(s->hider[k] != s->polygon && s->hider[k] != s->other);
    for (int c = 0; c < 3; c++) {
        corner[c] = at(made.positions[3 * s->hider[k] + (size_t)c]);
        on_screen[c] = seen_at(corner[c], flat);
    }
    assert_true(outside(on_screen, spot.x, spot.y) < 2);
    const point normal = cross(minus(corner[1], corner[0]), minus(corner[2], corner[0]));
    const point eye = flat ? along(beyond, (point){0, 0, 1}, EYE) : (point){0, 0, EYE};
    const point ray = minus(beyond, eye);
    const double slope = fabs(dot(normal, ray)) / (length_of(normal) * length_of(ray));
    const double t = dot(normal, minus(corner[0], eye)) / dot(normal, ray); /* 1: at the line */
    assert_true((t - 1) * length_of(ray) < 0.3 / spot.z / slope);
}

static void check_picture_end(const dp_segment *s, int k) {
    const float *const p = k ? s->b : s->a;
    const double x = (double)p[0], y = (double)p[1];
    const double from_edge = fmin(fmin(x, SCENE_WIDTH - x), fmin(y, SCENE_HEIGHT - y));
    assert_true(from_edge < 0.4);
}

/* An end that is a vertex is the one that the edge begins or ends with. */
static void check_vertex_end(const dp_segment *s, int k) {
    const size_t corner = (s->edge + (size_t)k) % 3;
    const point from = minus(end_of(s, k), at(made.positions[3 * s->polygon + corner]));
    assert_true(s->edge < 3);
    assert_true(length_of(from) < 1e-3);
}

typedef struct tally {
    size_t hidden, known, picture, vertices, crossings;
} tally;

static void check_ends(bool flat, tally *t) {
    size_t count;
    const dp_segment *const segments = dp_segments(context, &count);
    for (size_t i = 0; i < count; i++) {
        const dp_segment *const s = &segments[i];
        for (int k = 0; k < 2; k++) {
            const bool known = s->end[k] == DP_END_HIDDEN && s->hider[k] != UINT64_MAX;
            assert_true(s->end[k] == DP_END_HIDDEN || s->hider[k] == UINT64_MAX);
            assert_true(s->end[k] != DP_END_CROSSING || s->edge == UINT32_MAX);
            t->hidden += s->end[k] == DP_END_HIDDEN;
            t->known += known;
            t->picture += s->end[k] == DP_END_PICTURE;
            t->vertices += s->end[k] == DP_END_VERTEX;
            t->crossings += s->end[k] == DP_END_CROSSING;
            if (known) check_hider(s, k, flat);
            if (s->end[k] == DP_END_PICTURE) check_picture_end(s, k);
            if (s->end[k] == DP_END_VERTEX) check_vertex_end(s, k);
        }
    }
}

static void ends_are_what_they_say(void **state) {
    (void)state;
    for (int flat = 0; flat < 2; flat++) {
        const dp_camera camera = flat ? scene_flat_camera() : scene_camera(0, 0, EYE, 0, 0, 0);
        tally t = {0};
        for (uint32_t seed = 1; seed <= 12; seed++) {
            make_triangles(100 + seed, 60, seed % 2 ? 0.8 : 1.6);
            draw(&camera, NULL);
            check_ends(flat, &t);
        }
        print_message("hidden %zu, known %zu, picture %zu, vertex %zu, crossing %zu\n", t.hidden,
                      t.known, t.picture, t.vertices, t.crossings);
        assert_true(t.hidden > 500 && t.picture > 50 && t.vertices > 500 && t.crossings > 100);
        /* not where tiles meet, and hostile ones meet often */
        assert_true(t.known >= t.hidden - t.hidden / DP_TUNED(12, 8));
    }
}

/* The planes end lines only where they cut them, also where the near one is close to the eye, so
 * that z / w is nearly 1 for all that is seen. */
static void planes_end_lines(void **state) {
    static const double nears[] = {1e-3, 1, 230};
    (void)state;
    for (int flat = 0; flat < 2; flat++)
        for (size_t i = 0; i < sizeof nears / sizeof *nears; i++) {
            dp_camera camera = scene_camera(0, 0, EYE, 0, 0, 0);
            const double aspect = (double)SCENE_WIDTH / SCENE_HEIGHT;
            size_t count, cut = 0;
            if (flat)
                dp_camera_orthographic(&camera, SCENE_HEIGHT, aspect, nears[i], 1000);
            else
                dp_camera_perspective(&camera, 50, aspect, nears[i], 1e6);
            made.corners = made.polygons = 0;
            scene_polygon(&made, 3,
                          (const float[][3]){{-20, -20, -30}, {20, -20, -30}, {0, 20, 40}});
            draw(&camera, NULL);
            const dp_segment *const s = dp_segments(context, &count);
            for (size_t k = 0; k < 2 * count; k++) cut += s[k / 2].end[k % 2] == DP_END_PICTURE;
            assert_int_equal(count, 3);
            assert_int_equal(cut, nears[i] > 200 ? 2 : 0);
        }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ends_are_what_they_say),
        cmocka_unit_test(planes_end_lines),
    };
    return cmocka_run_group_tests(tests, make_context, destroy_context);
}
