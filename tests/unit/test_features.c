/* The primitive shaders against quads worked out by hand, and the formulas of Raskar 2001, 2. */
#include "features/features.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

enum { SIZE = 400 /* px */ };
static const double PI = 3.14159265358979323846;

static void assert_close(double a, double b, double tolerance) {
    if (!(fabs(a - b) <= tolerance)) fail_msg("%.12g is not %.12g", a, b);
}
static void assert_point(dp_pointd p, double x, double y) {
    assert_close(p.x, x, 1e-6);
    assert_close(p.y, y, 1e-6);
}
static void assert_vector(dp_vec3 a, dp_vec3 b) { assert_close(dp_length(dp_sub(a, b)), 0, 1e-12); }

/* Both cameras stand at z = 10 and look along -z; at z = 0 a unit is 20 px. */
static dp_view view_of(bool perspective) {
    dp_camera camera;
    dp_view view;
    const double eye[3] = {0, 0, 10}, target[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    assert_int_equal(dp_camera_look_at(&camera, eye, target, up), DP_OK);
    const double fov = 2 * atan(1.0) * 180 / PI; /* 20 units at distance 10 */
    assert_int_equal(perspective ? dp_camera_perspective(&camera, fov, 1, 0.1, 100)
                                 : dp_camera_orthographic(&camera, 20, 1, 0.1, 100),
                     DP_OK);
    assert_int_equal(dp_view_init(&view, &camera, SIZE, SIZE, NULL), DP_OK);
    return view;
}

typedef struct polygon {
    dp_view view;
    dp_vec3 world[8];
    dp_clip_point clip[8];
    dp_primitive primitive;
} polygon;

static void set_polygon(polygon *p, bool perspective, const double (*corners)[3], uint32_t n) {
    p->view = view_of(perspective);
    dp_vec3 sum = {0, 0, 0};
    for (uint32_t i = 0; i < n; i++) {
        p->world[i] = dp_v3(corners[i][0], corners[i][1], corners[i][2]);
        p->clip[i] = dp_to_clip(&p->view, p->world[i]);
    }
    for (uint32_t i = 2; i < n; i++)
        sum = dp_add(
            sum, dp_cross(dp_sub(p->world[i - 1], p->world[0]), dp_sub(p->world[i], p->world[0])));
    const dp_vec3 normal = dp_unit(sum);
    p->primitive =
        (dp_primitive){.view = &p->view,
                       .n = n,
                       .world = p->world,
                       .clip = p->clip,
                       .normal = normal,
                       .front = dp_dot(normal, dp_view_vector(&p->view, p->world[0])) < 0};
}

/* A unit square in the plane z = 0, edge 0 along its bottom (front) or turned over (back). */
static const double facing[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
static const double behind[4][3] = {{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}};
/* A wall that leads straight away from an eye at infinity; its normal points to +x. */
static const double edge_on[4][3] = {{0, 0, 0}, {0, 0, -1}, {0, 1, -1}, {0, 1, 0}};

static dp_pen pen_at(dp_method method, double angle) { return dp_pen_make(method, 6, angle); }

static double depth_at(const dp_added *a, double x, double y) {
    return fmin(a->d0 + a->dx * x + a->dy * y, a->nearest);
}

/* How far beside the edge's box a polygon reaches, px: tiles are widened by so much. */
static double furthest(const dp_added *a, const dp_screen_edge *e) {
    double most = 0;
    for (uint32_t i = 0; i < a->count; i++) {
        const dp_pointd p = a->points[i];
        most = fmax(most, fmax(fmin(e->a.x, e->b.x) - p.x, p.x - fmax(e->a.x, e->b.x)));
        most = fmax(most, fmax(fmin(e->a.y, e->b.y) - p.y, p.y - fmax(e->a.y, e->b.y)));
    }
    return most;
}

/* ------- directions ------- */

static dp_vec3 q_at(dp_vec3 e, dp_vec3 n, double angle) {
    const dp_pen pen = pen_at(DP_METHOD_PAPER, angle);
    return dp_quad_direction(e, n, &pen);
}
static dp_vec3 r_at(dp_vec3 e, dp_vec3 n, double angle) {
    const dp_pen pen = pen_at(DP_METHOD_PAPER, angle);
    return dp_quad_normal(e, n, &pen);
}

/* At 180 degrees the quad continues the polygon, at 90 it stands behind it, at 270 before it. */
static void directions_turn_with_the_angle(void **state) {
    const dp_vec3 e = {1, 0, 0}, n = {0, 0, 1}, o = {0, -1, 0};
    (void)state;
    assert_vector(q_at(e, n, 180), o);
    assert_vector(r_at(e, n, 180), n);
    assert_vector(q_at(e, n, 90), dp_v3(0, 0, -1));
    assert_vector(r_at(e, n, 90), o);
    assert_vector(q_at(e, n, 270), dp_v3(0, 0, 1));
    assert_vector(r_at(e, n, 270), dp_v3(0, 1, 0));
    for (double angle = 1; angle < 360; angle += 7) {
        const dp_vec3 q = q_at(e, n, angle), r = r_at(e, n, angle);
        assert_vector(dp_cross(q, e), r);
        assert_close(dp_dot(q, o), -cos(angle * PI / 180), 1e-12);
    }
}

/* ------- exact ------- */

static void silhouette_is_a_band_beside_the_edge(void **state) {
    (void)state;
    for (int perspective = 0; perspective < 2; perspective++) {
        polygon p;
        dp_added out[DP_ADDED_MOST];
        const dp_pen pen = pen_at(DP_METHOD_EXACT, 140);
        set_polygon(&p, perspective, behind, 4);
        assert_false(p.primitive.front);
        /* edge 3 runs from (1, 0) to (0, 0): the fin lies below it, 6 px wide, in the plane z =
         * 0 */
        const uint32_t count = dp_shade_silhouette(&p.primitive, 3, &pen, out);
        assert_true(count >= 1 && out[0].count == 4);
        assert_point(out[0].points[0], 220, 200);
        assert_point(out[0].points[1], 200, 200);
        assert_point(out[0].points[2], 200, 206);
        assert_point(out[0].points[3], 220, 206);
        assert_close(depth_at(&out[0], 210, 203), perspective ? 0.1 : -10, 1e-12);
        /* the joint fills the quarter between it and edge 0's fin */
        assert_int_equal(count, 1 + 3);
        for (uint32_t i = 1; i < count; i++) {
            assert_true(out[i].joint && out[i].count == 3);
            assert_point(out[i].points[0], 200, 200);
            for (int k = 1; k < 3; k++)
                assert_close(hypot(out[i].points[k].x - 200, out[i].points[k].y - 200), 6, 1e-9);
        }
        assert_point(out[count - 1].points[2], 194, 200);
    }
}

static void only_the_right_facing_adds(void **state) {
    polygon front, back;
    dp_added out[DP_ADDED_MOST];
    (void)state;
    set_polygon(&front, true, facing, 4);
    set_polygon(&back, true, behind, 4);
    for (int method = DP_METHOD_EXACT; method <= DP_METHOD_PAPER; method++) {
        const dp_pen ridge = pen_at((dp_method)method, 140),
                     valley = pen_at((dp_method)method, 220);
        assert_int_equal(dp_shade_silhouette(&front.primitive, 0, &ridge, out), 0);
        assert_true(dp_shade_silhouette(&back.primitive, 0, &ridge, out) > 0);
        assert_true(dp_shade_ridge(&front.primitive, 0, &ridge, out) > 0);
        assert_int_equal(dp_shade_ridge(&back.primitive, 0, &ridge, out), 0);
        assert_true(dp_shade_valley(&front.primitive, 0, &valley, out) > 0);
        assert_int_equal(dp_shade_valley(&back.primitive, 0, &valley, out), 0);
    }
}

static void unflagged_edges_add_nothing(void **state) {
    static const uint8_t flags[4] = {1, 0, 1, 1};
    polygon front, back;
    dp_added out[DP_ADDED_MOST];
    (void)state;
    set_polygon(&front, true, facing, 4);
    set_polygon(&back, true, behind, 4);
    front.primitive.edge_flags = back.primitive.edge_flags = flags;
    for (int method = DP_METHOD_EXACT; method <= DP_METHOD_PAPER; method++) {
        const dp_pen pen = pen_at((dp_method)method, 140);
        assert_int_equal(dp_shade_silhouette(&back.primitive, 1, &pen, out), 0);
        assert_int_equal(dp_shade_ridge(&front.primitive, 1, &pen, out), 0);
        assert_int_equal(dp_shade_valley(&front.primitive, 1, &pen, out), 0);
        assert_true(dp_shade_ridge(&front.primitive, 0, &pen, out) > 0);
    }
}

/* Seen face on, a quad at angle a falls by tan(180 - a) pixel sizes per px. */
static void ridge_and_valley_lean_by_their_angles(void **state) {
    static const double angles[] = {100, 120, 140, 170, 180, 190, 220, 250};
    polygon p;
    dp_added out[DP_ADDED_MOST];
    (void)state;
    set_polygon(&p, false, facing, 4);
    for (size_t i = 0; i < sizeof angles / sizeof *angles; i++) {
        const dp_pen pen = pen_at(DP_METHOD_EXACT, angles[i]);
        const double rise = -tan((180 - angles[i]) * PI / 180) / 20;
        assert_true(dp_shade_ridge(&p.primitive, 0, &pen, out) >= 1);
        assert_point(out[0].points[0], 200, 200);
        assert_point(out[0].points[2], 220, 206);
        assert_close(depth_at(&out[0], 210, 200), -10, 1e-9);
        assert_close(depth_at(&out[0], 210, 206), -10 + 6 * rise, 1e-9);
        assert_true(dp_shade_valley(&p.primitive, 0, &pen, out) >= 1);
        assert_close(depth_at(&out[0], 210, 206), -10 + 6 * rise, 1e-9);
    }
}

/* Quads that face away: under the polygon nothing shows; before it everything that is seen does. */
static void quads_that_face_away(void **state) {
    polygon p;
    dp_added out[DP_ADDED_MOST];
    (void)state;
    set_polygon(&p, false, facing, 4);
    const dp_pen low = pen_at(DP_METHOD_EXACT, 60), high = pen_at(DP_METHOD_EXACT, 300);
    assert_int_equal(dp_shade_ridge(&p.primitive, 0, &low, out), 0);
    assert_int_equal(dp_shade_valley(&p.primitive, 0, &high, out), 0);
    assert_true(dp_shade_ridge(&p.primitive, 0, &high, out) >= 1);
    assert_true(depth_at(&out[0], 210, 206) > -10);
    assert_true(dp_shade_valley(&p.primitive, 0, &low, out) >= 1);
    assert_true(depth_at(&out[0], 210, 206) < -10);
}

/* The near edge's fin comes nearer, but not without bound; the far edge's would lead away. */
static void edge_on_polygons_stay_bounded(void **state) {
    dp_added out[DP_ADDED_MOST];
    polygon p;
    (void)state;
    set_polygon(&p, false, edge_on, 4);
    p.primitive.front = false; /* edge-on counts as back-facing */
    const dp_pen pen = pen_at(DP_METHOD_EXACT, 140);
    const uint32_t near_edge = 3, far_edge = 1, eye_edge = 0;
    assert_int_equal(dp_shade_silhouette(&p.primitive, far_edge, &pen, out), 0);
    assert_int_equal(dp_shade_silhouette(&p.primitive, eye_edge, &pen, out),
                     0); /* a point on the screen */
    assert_int_equal(dp_shade_silhouette(&p.primitive, near_edge, &pen, out), 1);
    assert_point(out[0].points[2], 206, 200); /* to +x, where the normal points */
    assert_close(depth_at(&out[0], 206, 190), -10 + DP_STEEPEST * 6 / 20, 1e-9);
}

/* ------- as printed ------- */

/* Straight ahead: V = C, alpha = 90 degrees, V·N = 1: w z, which is 6 px. */
static void paper_silhouette_face_on(void **state) {
    (void)state;
    for (int perspective = 0; perspective < 2; perspective++) {
        const dp_view view = view_of(perspective);
        const dp_vec3 e = {1, 0, 0}, o = {0, 1, 0}, n = {0, 0, -1};
        const dp_vec3 moved = dp_paper_offset(&view, dp_v3(0, 0, 0), e, o, n, 6);
        assert_vector(moved, dp_v3(0, 6 / 20.0, 0));
    }
}

/* P_k + w [E x N] [z sin(alpha) (V·C) / (V·N)], written out again (Raskar 2001, 2.1). */
static void paper_offset_is_as_printed(void **state) {
    const dp_view view = view_of(true);
    const dp_vec3 eye = {0, 0, 10}, c = {0, 0, -1};
    const dp_vec3 n = dp_unit(dp_v3(0.3, -0.2, -1)), e = dp_unit(dp_cross(n, dp_v3(0.1, 1, 0.4)));
    const dp_vec3 p = {1.5, -2, 3}, v = dp_unit(dp_sub(p, eye));
    const double w = 6 / view.focal, z = 7, alpha = acos(dp_dot(v, e));
    const double grown = w * z * sin(alpha) * dp_dot(v, c) / dp_dot(v, n);
    const dp_vec3 o = dp_cross(e, n);
    (void)state;
    assert_true(dp_dot(v, n) > 0);
    assert_vector(dp_paper_offset(&view, p, e, o, n, 6), dp_mad(p, o, grown));
}

static void paper_quads_at_several_angles(void **state) {
    static const double angles[] = {100, 130, 150, 170, 200, 230, 260};
    (void)state;
    for (int perspective = 0; perspective < 2; perspective++) {
        polygon p;
        set_polygon(&p, perspective, facing, 4);
        const dp_vec3 e = dp_edge_direction(&p.primitive, 0), n = p.primitive.normal;
        for (size_t i = 0; i < sizeof angles / sizeof *angles; i++) {
            const dp_pen pen = pen_at(DP_METHOD_PAPER, angles[i]);
            const dp_vec3 q = q_at(e, n, angles[i]), r = r_at(e, n, angles[i]);
            const dp_vec3 moved = dp_paper_offset(&p.view, p.world[1], e, q, r, pen.reach);
            const dp_pointd at = dp_to_screen(&p.view, dp_to_clip(&p.view, moved));
            dp_added out[DP_ADDED_MOST];
            assert_int_equal(dp_shade_ridge(&p.primitive, 0, &pen, out), 1);
            assert_int_equal(out[0].count, 4);
            assert_point(out[0].points[0], 200, 200);
            assert_point(out[0].points[2], at.x, at.y);
            assert_close(depth_at(&out[0], at.x, at.y), at.d, 1e-9);
            /* along the axis the width is right, except for perspective over its depth */
            assert_close(out[0].points[3].y - 200, 6, perspective ? 1.5 : 1e-9);
        }
    }
}

/* 2n corners: a quad beyond every edge and a triangle at every corner. */
static void paper_silhouette_is_a_2n_gon(void **state) {
    polygon p;
    dp_added out[DP_ADDED_MOST];
    (void)state;
    set_polygon(&p, true, behind, 4);
    const dp_pen pen = pen_at(DP_METHOD_PAPER, 0);
    for (uint32_t edge = 0; edge < 4; edge++) {
        assert_int_equal(dp_shade_silhouette(&p.primitive, edge, &pen, out), 2);
        assert_int_equal(out[0].count, 4);
        assert_int_equal(out[1].count, 3);
        /* the triangle's second corner is the quad's third, its first the polygon's */
        assert_point(out[1].points[1], out[0].points[2].x, out[0].points[2].y);
        assert_point(out[1].points[0], out[0].points[1].x, out[0].points[1].y);
    }
}

/* A threshold that turns the quad away from the eye: culled. */
static void paper_quads_facing_away_are_culled(void **state) {
    polygon p;
    dp_added out[DP_ADDED_MOST];
    (void)state;
    set_polygon(&p, true, facing, 4);
    const dp_pen low = pen_at(DP_METHOD_PAPER, 30), high = pen_at(DP_METHOD_PAPER, 330);
    assert_int_equal(dp_shade_ridge(&p.primitive, 0, &low, out), 0);
    assert_int_equal(dp_shade_ridge(&p.primitive, 0, &high, out), 0);
    assert_int_equal(dp_shade_valley(&p.primitive, 0, &high, out), 0);
}

/* ------- safety ------- */

static void check_added(const polygon *p, uint32_t edge, const dp_added *out, uint32_t count,
                        double reach) {
    dp_screen_edge e;
    if (count > 0) assert_true(dp_screen_edge_make(&p->primitive, edge, &e));
    for (uint32_t i = 0; i < count; i++) {
        assert_true(out[i].count >= 3 && out[i].count <= DP_ADDED_POINTS);
        assert_true(isfinite(out[i].d0) && isfinite(out[i].dx) && isfinite(out[i].dy));
        assert_false(isnan(out[i].nearest));
        for (uint32_t k = 0; k < out[i].count; k++)
            assert_true(isfinite(out[i].points[k].x) && isfinite(out[i].points[k].y) &&
                        isfinite(out[i].points[k].d));
        assert_true(furthest(&out[i], &e) <= reach + 1e-3);
    }
}

/* Every shader, both methods: nothing is infinite, and nothing reaches further than binning
 * knows. */
static void check_all(const polygon *p) {
    static dp_primitive_shader *const shaders[] = {dp_shade_silhouette, dp_shade_ridge,
                                                   dp_shade_valley};
    static const double angles[] = {0.01, 20, 89.99, 90, 140, 180, 220, 270, 359.99};
    for (int s = 0; s < 3; s++)
        for (int method = DP_METHOD_EXACT; method <= DP_METHOD_PAPER; method++)
            for (size_t a = 0; a < sizeof angles / sizeof *angles; a++)
                for (uint32_t edge = 0; edge < p->primitive.n; edge++) {
                    dp_added out[DP_ADDED_MOST];
                    const dp_pen pen = pen_at((dp_method)method, angles[a]);
                    const uint32_t count = shaders[s](&p->primitive, edge, &pen, out);
                    assert_true(count <= DP_ADDED_MOST);
                    check_added(p, edge, out, count,
                                pen.reach * (method == DP_METHOD_PAPER ? DP_PAPER_MARGIN : 1));
                }
}

/* A square turned through all directions, near and far, before, beside and behind the eye. */
static void nothing_blows_up(void **state) {
    static const double centres[][3] = {{0, 0, 0},  {3, 2, 9},      {0, 0, 9.95},
                                        {0, 0, 10}, {0.5, 0, 10.2}, {0, 0, 12},
                                        {40, 0, 9}, {-9, 9, 0},     {0, 0, -85}};
    (void)state;
    for (int perspective = 0; perspective < 2; perspective++)
        for (size_t c = 0; c < sizeof centres / sizeof *centres; c++)
            for (int turn = 0; turn < 36; turn++)
                for (int tilt = 0; tilt < 8; tilt++) {
                    const double t = turn * PI / 18, u = tilt * PI / 8;
                    const dp_vec3 a = {cos(t), sin(t) * cos(u), sin(t) * sin(u)};
                    const dp_vec3 b = dp_unit(dp_cross(a, dp_v3(sin(u), 0.1, cos(u))));
                    double corners[4][3];
                    for (int i = 0; i < 4; i++) {
                        const double x = i == 1 || i == 2 ? 1 : -1, y = i >= 2 ? 1 : -1;
                        corners[i][0] = centres[c][0] + a.x * x + b.x * y;
                        corners[i][1] = centres[c][1] + a.y * x + b.y * y;
                        corners[i][2] = centres[c][2] + a.z * x + b.z * y;
                    }
                    polygon p;
                    set_polygon(&p, perspective, (const double(*)[3])corners, 4);
                    check_all(&p);
                    p.primitive.front = !p.primitive.front; /* as rounding may have it */
                    check_all(&p);
                }
}

static void tiny_edges_are_skipped(void **state) {
    static const double needle[3][3] = {{0, 0, 0}, {1e-9, 0, 0}, {0, 1, 0}};
    polygon p;
    (void)state;
    set_polygon(&p, true, needle, 3);
    check_all(&p);
}

/* ------- intersections ------- */

static void polygons_that_share_a_position_touch(void **state) {
    static const float positions[7][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -0.0f, 0},
                                          {5, 5, 5}, {6, 5, 5}, {5, 6, 5}};
    static const uint32_t corners[9] = {0, 1, 2, 3, 4, 5, 4, 5, 6};
    const dp_polygons polygons = {
        .positions = positions[0], .stride = 12, .vertex_count = 7, .corners = corners, .count = 3};
    (void)state;
    assert_true(dp_polygons_touch(&polygons, 0, 1)); /* another vertex at the same place */
    assert_true(dp_polygons_touch(&polygons, 1, 2));
    assert_false(dp_polygons_touch(&polygons, 0, 2));
}

/* A gap of 2 between planes that part by 1 per px: they cross 2 px away. */
static void planes_cross_within_a_reach(void **state) {
    (void)state;
    assert_true(dp_planes_cross_within(2, 0.6f, 0.8f, 2.001f));
    assert_false(dp_planes_cross_within(2, 0.6f, 0.8f, 1.999f));
    assert_false(dp_planes_cross_within(0.001f, 0, 0, 64));
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(directions_turn_with_the_angle),
        cmocka_unit_test(silhouette_is_a_band_beside_the_edge),
        cmocka_unit_test(only_the_right_facing_adds),
        cmocka_unit_test(unflagged_edges_add_nothing),
        cmocka_unit_test(ridge_and_valley_lean_by_their_angles),
        cmocka_unit_test(quads_that_face_away),
        cmocka_unit_test(edge_on_polygons_stay_bounded),
        cmocka_unit_test(paper_silhouette_face_on),
        cmocka_unit_test(paper_offset_is_as_printed),
        cmocka_unit_test(paper_quads_at_several_angles),
        cmocka_unit_test(paper_silhouette_is_a_2n_gon),
        cmocka_unit_test(paper_quads_facing_away_are_culled),
        cmocka_unit_test(nothing_blows_up),
        cmocka_unit_test(tiny_edges_are_skipped),
        cmocka_unit_test(polygons_that_share_a_position_touch),
        cmocka_unit_test(planes_cross_within_a_reach),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
