/* The worked examples of Raskar 2001, in flatland: (x, z), seen from +z. Every segment is a wall
 * that extends along y. */
#include "variants.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Mean width of the ink along the edge at x = 0, px: away from the walls' other edges. */
static double width_at_edge(double reach) { return scene_ink(&shown, -reach, -20, reach, 20) / 40; }

/* Draws a roof and says whether the line at its edge is there, as it should be. */
static void expect_line(const variant *v, uint32_t lines, double dihedral, double theta, double phi,
                        bool expected) {
    enum { PX = 4 };
    const dp_style style = style_of(v, lines, theta, phi, PX);
    scene *roof = new_scene();
    scene_roof(roof, dihedral, 60);
    draw_flat(roof, &style);
    /* a steep wall's other edge is not far away on the screen */
    const double reach = fmin(40, 60 * sin(dihedral * 3.14159265 / 360) - PX - 1);
    const double width = width_at_edge(reach);
    if (!expected && width > 0.02)
        fail_msg("%s: dihedral %g, theta %g, phi %g: %.2f px of ink", v->name, dihedral, theta, phi,
                 width);
    if (expected && (width < v->least * PX || width > v->most * PX))
        fail_msg("%s: dihedral %g, theta %g, phi %g: %.2f px of ink, not %d", v->name, dihedral,
                 theta, phi, width, PX);
    free(roof);
}

/* Raskar 2001, Figure 6: the ridge is sharper than the threshold, its quads stay visible. */
static void figure_6_a_sharp_ridge_shows(void **state) {
    (void)state;
    for (int i = 0; i < VARIANTS; i++) expect_line(&variants[i], DP_RIDGE, 80, 120, 240, true);
}

/* Raskar 2001, Figure 7: it is not, both quads are hidden by the neighbours. */
static void figure_7_a_flat_ridge_does_not(void **state) {
    (void)state;
    for (int i = 0; i < VARIANTS; i++) {
        expect_line(&variants[i], DP_RIDGE, 150, 120, 240, false);
        expect_line(&variants[i], DP_RIDGE, 180, 120, 240, false);
        expect_line(&variants[i], DP_RIDGE, 250, 120, 240, false);
    }
}

/* Raskar 2001, Figure 8, (i) and (ii): a valley sharper than the threshold; (iii) and (iv): one
 * that is not. */
static void figure_8_only_a_sharp_valley_shows(void **state) {
    (void)state;
    for (int i = 0; i < VARIANTS; i++) {
        expect_line(&variants[i], DP_VALLEY, 280, 120, 240, true);
        expect_line(&variants[i], DP_VALLEY, 210, 120, 240, false);
        expect_line(&variants[i], DP_VALLEY, 180, 120, 240, false);
        expect_line(&variants[i], DP_VALLEY, 100, 120, 240, false);
    }
}

/* Raskar 2001, 2.2: "this technique can support the complete range of angles (0, 360)". */
static void thresholds_hold_over_the_whole_range(void **state) {
    static const double thresholds[] = {20, 75, 120, 165, 178, 182, 195, 240, 285, 340};
    static const double angles[] = {30, 60, 90, 135, 172, 180, 188, 225, 270, 300, 330};
    (void)state;
    for (size_t t = 0; t < sizeof thresholds / sizeof *thresholds; t++) {
        for (size_t a = 0; a < sizeof angles / sizeof *angles; a++) {
            const double limit = thresholds[t], angle = angles[a];
            for (int i = 0; i < 4; i += 2) { /* exact strokes, exact quads */
                expect_line(&variants[i], DP_RIDGE, angle, limit, 359, angle <= limit);
                expect_line(&variants[i], DP_VALLEY, angle, 1, limit, angle > limit);
            }
        }
    }
}

/* Raskar 2001, Figure 10: A, then B, then C, under the one-pass between-test. A and B meet in a
 * valley of 270 degrees, B and C in a ridge of 135. */
static void add_a(scene *s) { scene_wall(s, -60, 60, 0, 0, 45); }
static void add_b(scene *s) { scene_wall(s, 0, 0, 40, 40, 45); }
static void add_c(scene *s) { scene_wall(s, 40, 40, 80, 40, 45); }

static double ink_left(void) { return scene_ink(&shown, -30, -20, 0, 20) / 40; }
static double ink_right(void) { return scene_ink(&shown, 0, -20, 30, 20) / 40; }

static void figure_10_quads_emerge_one_by_one(void **state) {
    enum { PX = 6 };
    for (int method = DP_METHOD_EXACT; method <= DP_METHOD_PAPER; method++) {
        const dp_style style = {.lines = DP_VALLEY,
                                .line[DP_LINE_VALLEY].width = PX,
                                .valley_angle = 240,
                                .method = (dp_method)method,
                                .ink = DP_INK_QUADS,
                                .between = DP_BETWEEN_INTERVAL,
                                .between_offset = 4,
                                .passes = 1};
        scene *steps = new_scene();
        add_a(steps); /* (i): a and a' lie between nothing */
        draw_flat(steps, &style);
        assert_true(scene_ink(&shown, -100, -40, 100, 40) < 0.01);
        add_b(steps); /* (ii): b' is trapped behind A; b is not, and A's own a was not kept */
        draw_flat(steps, &style);
        const double trapped = ink_left();
        assert_true(trapped > 1 && trapped <= PX + 0.1);
        assert_true(ink_right() < 0.5); /* at most the pixel that the edge itself runs through */
        add_c(steps);                   /* (iii): c and c' show nothing */
        draw_flat(steps, &style);
        assert_true(fabs(ink_left() - trapped) < 0.01);
        assert_true(scene_ink(&shown, 10, -40, 100, 40) < 0.01);
        /* "if some polygon later occludes A, the color will be appropriately overwritten" */
        scene_wall(steps, -30, 90, 30, 90, 45);
        draw_flat(steps, &style);
        assert_true(scene_ink(&shown, -20, -20, 20, 20) < 0.01);
        free(steps);
    }
    (void)state;
}

/* The same polygons in the other order: the valley shows on the other side. */
static void figure_10_depends_on_the_order(void **state) {
    const dp_style style = {.lines = DP_VALLEY,
                            .line[DP_LINE_VALLEY].width = 6,
                            .valley_angle = 240,
                            .ink = DP_INK_QUADS,
                            .between = DP_BETWEEN_INTERVAL,
                            .between_offset = 4,
                            .passes = 1};
    scene *steps = new_scene();
    (void)state;
    add_c(steps);
    add_b(steps);
    add_a(steps);
    draw_flat(steps, &style);
    assert_true(ink_right() > 1);
    assert_true(ink_left() < 0.5);
    free(steps);
}

/* The plane test does not depend on it, and shows both sides. */
static void plane_test_is_free_of_order(void **state) {
    const dp_style style = {.lines = DP_VALLEY,
                            .line[DP_LINE_VALLEY].width = 6,
                            .valley_angle = 240,
                            .ink = DP_INK_QUADS};
    scene *forth = new_scene(), *back = new_scene();
    picture *first = malloc(sizeof *first);
    (void)state;
    assert_non_null(first);
    add_a(forth), add_b(forth), add_c(forth);
    add_c(back), add_b(back), add_a(back);
    draw_flat(forth, &style);
    memcpy(first, &shown, sizeof *first);
    assert_true(ink_left() > 2 && ink_right() > 2);
    draw_flat(back, &style);
    assert_memory_equal(first->rgba, shown.rgba, sizeof shown.rgba);
    free(first);
    free(forth);
    free(back);
}

/* Raskar 2001, 2.4: two polygons that cross, seen from the front. */
static void intersections_show_where_interiors_cross(void **state) {
    (void)state;
    for (int i = 0; i < VARIANTS; i++) {
        const dp_style style = style_of(&variants[i], DP_INTERSECTION, 120, 240, 4);
        scene *crossed = new_scene();
        scene_wall(crossed, -50, -30, 50, 30, 45);
        scene_wall(crossed, -50, 30, 50, -30, 45);
        draw_flat(crossed, &style);
        const double width = width_at_edge(20);
        /* the paper's interval is as deep everywhere: how wide it is depends on the slopes */
        const double least = variants[i].between == DP_BETWEEN_PLANE ? variants[i].least * 4 : 0.5;
        if (width < least || width > 2.2 * 4)
            fail_msg("%s: %.2f px of ink, not 4", variants[i].name, width);
        if (scene_ink(&shown, -100, -30, -15, 30) + scene_ink(&shown, 15, -30, 100, 30) > 0.5)
            fail_msg("%s: ink away from the intersection", variants[i].name);
        free(crossed);
    }
}

/* Raskar 2001, 3: a ridge edge that is also a silhouette comes out as a silhouette when both are
 * asked for. */
static void an_edge_at_the_rim_is_a_silhouette(void **state) {
    const float min[3] = {-30, -30, -30}, max[3] = {30, 30, 30};
    const dp_camera camera = scene_camera(120, 80, 120, 0, 0, 0);
    const dp_style style = {.lines = DP_SILHOUETTE | DP_RIDGE};
    scene *cube = new_scene();
    unsigned seen[DP_LINE_COUNT + 1] = {0};
    (void)state;
    scene_box(cube, min, max);
    draw(cube, &camera, &style);
    for (int i = 0; i < SCENE_WIDTH * SCENE_HEIGHT; i++) seen[shown.line_class[i]]++;
    assert_true(seen[1 + DP_LINE_SILHOUETTE] > 200);
    assert_true(seen[1 + DP_LINE_RIDGE] > 80);
    assert_true(seen[1 + DP_LINE_SILHOUETTE] > seen[1 + DP_LINE_RIDGE]);
    free(cube);
}

/* Adds an edge that is a line by itself: a polygon without area. */
static void add_marked(scene *s, const float from[3], const float to[3], dp_edge_kind kind) {
    const float corners[3][3] = {
        {from[0], from[1], from[2]}, {to[0], to[1], to[2]}, {to[0], to[1], to[2]}};
    scene_polygon(s, 3, corners);
    const size_t first = s->firsts[s->polygons - 1];
    s->flags[first] = (uint8_t)kind, s->flags[first + 1] = s->flags[first + 2] = DP_EDGE_NEVER;
}

/* A scene with a line of every class: crossing boxes on steps, beside an open sheet, and lines on the
 * front of a box. */
static scene *every_class(void) {
    const float a[3] = {-70, -40, -20}, b[3] = {-10, 20, 20};
    const float c[3] = {-50, -20, -60}, d[3] = {-30, 0, 60};
    scene *made = new_scene();
    scene_box(made, a, b);
    scene_box(made, c, d);
    const float step[4][4][3] = {{{10, -40, 20}, {60, -40, 20}, {60, -10, 20}, {10, -10, 20}},
                                 {{10, -10, 20}, {60, -10, 20}, {60, -10, -20}, {10, -10, -20}},
                                 {{10, -10, -20}, {60, -10, -20}, {60, 20, -20}, {10, 20, -20}},
                                 {{10, 20, -20}, {60, 20, -20}, {60, 20, -50}, {10, 20, -50}}};
    for (int k = 0; k < 4; k++) scene_polygon(made, 4, step[k]);
    add_marked(made, (const float[3]){-65, -30, 20}, (const float[3]){-15, -30, 20},
               DP_EDGE_SECTION);
    add_marked(made, (const float[3]){-65, -36, 20}, (const float[3]){-15, -34, 20},
               DP_EDGE_HATCHING);
    return made;
}

/* Each class alone, each pair, all: ink of the classes asked for and of no other, in their
 * colours. */
static void classes_can_be_switched_and_coloured(void **state) {
    static const dp_color colors[DP_LINE_COUNT] = {
        DP_RGB(255, 0, 0),   DP_RGB(0, 255, 0),   DP_RGB(0, 0, 255),  DP_RGB(255, 0, 255),
        DP_RGB(0, 255, 255), DP_RGB(255, 255, 0), DP_RGB(0, 255, 128)};
    const dp_camera camera = scene_camera(60, 70, 150, 0, -5, 0);
    scene *whole = every_class();
    (void)state;
    for (uint32_t lines = 1; lines <= DP_ALL_LINES; lines++) {
        dp_style style = {.lines = lines};
        unsigned seen[DP_LINE_COUNT + 1] = {0};
        for (int k = 0; k < DP_LINE_COUNT; k++) style.line[k] = (dp_line_style){3, colors[k]};
        draw(whole, &camera, &style);
        for (int i = 0; i < SCENE_WIDTH * SCENE_HEIGHT; i++) {
            const uint8_t *p = shown.rgba + 4 * i;
            const unsigned class = shown.line_class[i];
            assert_true(class <= DP_LINE_COUNT);
            seen[class]++;
            /* several lines that cover less than half of a pixel each may darken it, too */
            const int dark = (lines & (lines - 1)) == 0 ? 120 : 40;
            if (class == 0 && (p[0] < dark || p[1] < dark || p[2] < dark))
                fail_msg("lines %u: pixel %d has ink and no class", lines, i);
        }
        for (int k = 0; k < DP_LINE_COUNT; k++) {
            const bool on = lines >> k & 1;
            if (!on && seen[1 + k] > 0)
                fail_msg("lines %u: %s was not asked for", lines, dp_line_name((dp_line)k));
            if (on && seen[1 + k] < 20)
                fail_msg("lines %u: no %s", lines, dp_line_name((dp_line)k));
        }
    }
    free(whole);
}

/* A fully covered pixel has exactly its class's colour, whatever the class. */
static void colours_are_exact(void **state) {
    const dp_camera camera = scene_camera(60, 70, 150, 0, -5, 0);
    scene *whole = every_class();
    (void)state;
    for (int k = 0; k < DP_LINE_COUNT; k++) {
        dp_style style = {
            .lines = 1u << k, .paper = DP_RGB(250, 240, 230), .surface = DP_RGB(250, 240, 230)};
        unsigned full = 0;
        style.line[k] = (dp_line_style){5, DP_RGB(10, 60, 120)};
        draw(whole, &camera, &style);
        for (int i = 0; i < SCENE_WIDTH * SCENE_HEIGHT; i++) {
            const uint8_t *p = shown.rgba + 4 * i;
            assert_int_equal(p[3], 255);
            full += p[0] == 10 && p[1] == 60 && p[2] == 120;
            assert_true(p[0] >= 10 && p[0] <= 250 && p[2] >= 120 && p[2] <= 230);
        }
        if (full < 20) fail_msg("%s: %u pixels of its colour", dp_line_name((dp_line)k), full);
    }
    free(whole);
}

static void no_lines_means_no_ink(void **state) {
    const dp_camera camera = scene_camera(60, 70, 150, 0, -5, 0);
    const dp_style style = {.lines = DP_NO_LINES};
    scene *whole = every_class();
    unsigned covered = 0;
    (void)state;
    draw(whole, &camera, &style);
    for (int i = 0; i < SCENE_WIDTH * SCENE_HEIGHT; i++) {
        assert_int_equal(shown.line_class[i], 0);
        assert_int_equal(shown.rgba[4 * i], 255);
        covered += isfinite(shown.depth[i]) != 0;
    }
    assert_true(covered > 3000 && covered < SCENE_WIDTH * SCENE_HEIGHT);
    free(whole);
}

/* Depth is the distance along the line of sight, of one of the pixel's samples. */
static void depth_is_exact(void **state) {
    const dp_style style = {.lines = DP_NO_LINES};
    scene *wall = new_scene();
    (void)state;
    scene_wall(wall, -50, 0, 50, 100, 45);
    draw_flat(wall, &style);
    for (int x = 55; x < 145; x++) {
        const double z = (x + 0.5 - SCENE_WIDTH / 2.0) + 50;
        const float depth = shown.depth[SCENE_HEIGHT / 2 * SCENE_WIDTH + x];
        assert_true(fabs((double)depth - (500 - z)) < 0.51);
    }
    assert_true(isinf(shown.depth[0]));
    free(wall);
}

/* An open sheet seen from behind hides what is behind it, unless back faces are culled. */
static void back_faces_are_surface(void **state) {
    dp_style style = {.lines = DP_RIDGE, .ridge_angle = 150};
    scene *hidden = new_scene();
    (void)state;
    scene_roof(hidden, 90, 60);
    scene_wall(hidden, 60, 50, -60, 50, 45); /* its front looks away */
    draw_flat(hidden, &style);
    assert_true(width_at_edge(20) < 0.01);
    style.surface = DP_RGB(200, 220, 240);
    draw_flat(hidden, &style);
    for (int x = 70; x < 130; x++)
        assert_int_equal(shown.rgba[4 * (SCENE_HEIGHT / 2 * SCENE_WIDTH + x)], 200);
    style.cull_back_faces = true;
    style.surface = 0;
    draw_flat(hidden, &style);
    assert_true(width_at_edge(20) > 1.5);
    free(hidden);
}

/* Splitting diagonals never draw: an L, a star, a quadrangle that is not plane. */
static void concave_polygons_show_no_diagonals(void **state) {
    static const float l_shape[6][3] = {{-60, -40, 0}, {60, -40, 0}, {60, 0, 0},
                                        {0, 0, 0},     {0, 40, 0},   {-60, 40, 0}};
    const dp_camera camera = scene_flat_camera();
    (void)state;
    for (int i = 0; i < VARIANTS; i++) {
        for (unsigned all = 0; all < 2; all++) {
            const uint32_t lines = all ? DP_ALL_LINES : DP_RIDGE | DP_VALLEY | DP_INTERSECTION;
            const dp_style style = style_of(&variants[i], lines, 200, 160, 3);
            float star[10][3] = {{0}};
            for (int k = 0; k < 10; k++) {
                const double r = k % 2 ? 18 : 50, angle = k * 3.14159265358979 / 5;
                star[k][0] = (float)(r * cos(angle));
                star[k][1] = (float)(r * sin(angle));
            }
            scene *shape = new_scene();
            scene_polygon(shape, 6, l_shape);
            draw(shape, &camera, &style);
            assert_true(scene_stray(&shown, shape, &camera, 4.5) < 0.01);
            assert_true(isfinite(shown.depth[SCENE_WIDTH * 40 + 70])); /* the upright */
            assert_true(isinf(shown.depth[SCENE_WIDTH * 40 + 130]));   /* what the L leaves out */
            free(shape);
            shape = new_scene();
            scene_polygon(shape, 10, (const float(*)[3])star);
            draw(shape, &camera, &style);
            assert_true(scene_stray(&shown, shape, &camera, 4.5) < 0.01);
            assert_true(isfinite(shown.depth[SCENE_WIDTH * 60 + 100]));
            free(shape);
        }
    }
}

/* Two triangles folded along their diagonal: its flag decides. */
static void edge_flags_keep_edges_from_drawing(void **state) {
    static const float lower[3][3] = {{-50, -40, 0}, {50, -40, 30}, {50, 40, 0}};
    static const float upper[3][3] = {{-50, -40, 0}, {50, 40, 0}, {-50, 40, 30}};
    (void)state;
    for (int i = 0; i < VARIANTS; i++) {
        static const uint8_t flags[] = {DP_EDGE_NEVER, DP_EDGE_NORMAL,   DP_EDGE_DIAGONAL,
                                        DP_EDGE_FACE,  DP_EDGE_FACE + 1, 255};
        for (size_t k = 0; k < sizeof flags; k++) { /* what is unknown is normal */
            const uint8_t flag = flags[k];
            const bool draws = flag == DP_EDGE_NORMAL || flag > DP_EDGE_FACE;
            const dp_style style = style_of(&variants[i], DP_VALLEY, 100, 181, 3);
            scene *fold = new_scene();
            scene_polygon(fold, 3, lower);
            scene_polygon(fold, 3, upper);
            fold->flags[2] = fold->flags[3] = flag;
            draw_flat(fold, &style);
            const double ink = scene_ink(&shown, -10, -10, 10, 10);
            if (!draws && ink > 0.01) fail_msg("%s: edge flag %d draws", variants[i].name, flag);
            if (draws && ink < 5)
                fail_msg("%s: edge flag %d does not draw", variants[i].name, flag);
            free(fold);
        }
    }
}

/* A nonplanar quadrangle is split; the fold in it is no edge of the model. */
static void polygons_that_are_not_plane_show_no_fold(void **state) {
    static const float twisted[4][3] = {{-50, -40, 0}, {50, -40, 40}, {50, 40, 0}, {-50, 40, 40}};
    const dp_style style = {.lines = DP_RIDGE | DP_VALLEY, .ridge_angle = 178, .valley_angle = 182};
    scene *fold = new_scene();
    (void)state;
    scene_polygon(fold, 4, twisted);
    draw_flat(fold, &style);
    assert_true(scene_ink(&shown, -30, -25, 30, 25) < 0.01);
    free(fold);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(figure_6_a_sharp_ridge_shows),
        cmocka_unit_test(figure_7_a_flat_ridge_does_not),
        cmocka_unit_test(figure_8_only_a_sharp_valley_shows),
        cmocka_unit_test(thresholds_hold_over_the_whole_range),
        cmocka_unit_test(figure_10_quads_emerge_one_by_one),
        cmocka_unit_test(figure_10_depends_on_the_order),
        cmocka_unit_test(plane_test_is_free_of_order),
        cmocka_unit_test(intersections_show_where_interiors_cross),
        cmocka_unit_test(an_edge_at_the_rim_is_a_silhouette),
        cmocka_unit_test(classes_can_be_switched_and_coloured),
        cmocka_unit_test(colours_are_exact),
        cmocka_unit_test(no_lines_means_no_ink),
        cmocka_unit_test(depth_is_exact),
        cmocka_unit_test(back_faces_are_surface),
        cmocka_unit_test(concave_polygons_show_no_diagonals),
        cmocka_unit_test(edge_flags_keep_edges_from_drawing),
        cmocka_unit_test(polygons_that_are_not_plane_show_no_fold),
    };
    return cmocka_run_group_tests(tests, make_context, destroy_context);
}
