/* The API of Raskar 2001, Figure 3: the same picture as dp_draw, and messages for wrong calls. */
#include "scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static dp_context *context;
static picture shown, expected;

static const dp_target target = {.width = SCENE_WIDTH,
                                 .height = SCENE_HEIGHT,
                                 .rgba = shown.rgba,
                                 .line_class = shown.line_class,
                                 .depth = shown.depth};

static void finish(void) {
    dp_diag diag = {0};
    if (dp_finish(context, &target, &diag) != DP_OK) fail_msg("dp_finish: %s", diag.message);
}

static double ink(void) { return scene_ink(&shown, -100, -60, 100, 60); }

static void send_box(void) {
    static const float at[8][3] = {{-30, -30, -30}, {30, -30, -30}, {-30, 30, -30}, {30, 30, -30},
                                   {-30, -30, 30},  {30, -30, 30},  {-30, 30, 30},  {30, 30, 30}};
    static const int corner[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                     {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    for (int f = 0; f < 6; f++)
        for (int c = 0; c < 4; c++) dp_vertex3fv(context, at[corner[f][c]]);
}

/* Raskar 2001, Figure 3, call by call, against dp_draw. */
static void figure_3_draws_what_the_batch_draws(void **state) {
    const float min[3] = {-30, -30, -30}, max[3] = {30, 30, 30};
    const dp_camera camera = scene_camera(120, 80, 120, 0, 0, 0);
    const dp_style style = {.lines = DP_SIL_RIDGE_VALLEY};
    scene *box = calloc(1, sizeof *box);
    (void)state;
    assert_non_null(box);
    scene_box(box, min, max);
    assert_int_equal(scene_draw(context, box, &camera, &style, &expected, NULL), DP_OK);
    dp_set_camera(context, &camera);
    dp_enable(context, DP_SIL_RIDGE_VALLEY);
    dp_begin(context, DP_QUADS);
    send_box();
    dp_end(context);
    dp_disable(context, DP_SIL_RIDGE_VALLEY);
    finish();
    assert_memory_equal(shown.rgba, expected.rgba, sizeof shown.rgba);
    assert_memory_equal(shown.line_class, expected.line_class, sizeof shown.line_class);
    assert_true(ink() > 500);
    free(box);
}

/* The README's example. A triangle alone has borders, which are no silhouettes. */
static void a_lone_corner_needs_borders(void **state) {
    const dp_camera camera = scene_flat_camera();
    (void)state;
    dp_set_camera(context, &camera);
    for (int borders = 0; borders < 2; borders++) {
        const uint32_t lines = DP_SIL_RIDGE_VALLEY | (borders ? DP_BORDER : 0);
        dp_enable(context, lines);
        dp_begin(context, DP_TRIANGLES);
        dp_vertex3f(context, 0, 0, 0);
        dp_vertex3f(context, 40, 0, 0);
        dp_vertex3f(context, 0, 40, 0);
        dp_end(context);
        dp_disable(context, lines);
        finish();
        assert_int_equal(ink() > 100, borders);
    }
}

/* A strip of the plane z = 0, 80 x 60, in every kind of primitive: one and the same picture. */
static void every_kind_of_primitive(void **state) {
    static const float p[6][3] = {{-40, -30, 0}, {-40, 30, 0}, {0, -30, 0},
                                  {0, 30, 0},    {40, -30, 0}, {40, 30, 0}};
    static const int triangles[] = {0, 2, 1, 1, 2, 3, 2, 4, 3, 3, 4, 5},
                     strip[] = {1, 0, 3, 2, 5, 4};
    static const int fan[] = {0, 2, 4, 5, 3, 1}, quads[] = {0, 2, 3, 1, 2, 4, 5, 3};
    static const int quad_strip[] = {1, 0, 3, 2, 5, 4}, polygon[] = {0, 4, 5, 1};
    const struct {
        dp_primitive_kind kind;
        const int *corners;
        int count;
    } kinds[] = {{DP_TRIANGLES, triangles, 12},  {DP_TRIANGLE_STRIP, strip, 6},
                 {DP_TRIANGLE_FAN, fan, 6},      {DP_QUADS, quads, 8},
                 {DP_QUAD_STRIP, quad_strip, 6}, {DP_POLYGON, polygon, 4}};
    const dp_camera camera = scene_flat_camera();
    (void)state;
    dp_set_camera(context, &camera);
    dp_enable(context, DP_BORDER);
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        dp_begin(context, kinds[k].kind);
        for (int c = 0; c < kinds[k].count; c++) dp_vertex3fv(context, p[kinds[k].corners[c]]);
        dp_end(context);
        finish();
        /* the outline: 2 px wide, nothing within; front faces towards the eye */
        const double outline = 2 * (80 + 60) * 2;
        if (ink() < 0.97 * outline || ink() > 1.03 * outline)
            fail_msg("kind %zu: %g px of ink", k, ink());
        if (scene_ink(&shown, -37, -27, 37, 27) > 0.01) fail_msg("kind %zu: ink inside", k);
        if (k == 0) memcpy(&expected, &shown, sizeof shown);
    }
    dp_disable(context, DP_ALL_LINES);
}

/* Strips turn every other triangle around: all of them face the same way, so that no outline runs
 * between them. */
static void strips_are_wound_consistently(void **state) {
    const dp_camera camera = scene_flat_camera();
    (void)state;
    dp_set_camera(context, &camera);
    dp_enable(context, DP_SILHOUETTE);
    for (int kind = 0; kind < 2; kind++) {
        dp_begin(context, kind ? DP_QUAD_STRIP : DP_TRIANGLE_STRIP);
        for (int i = 0; i < 8; i++)
            dp_vertex3f(context, (float)(-60 + 30 * (i / 2)), i % 2 ? -30.0f : 30.0f, 0);
        dp_end(context);
        finish();
        assert_true(scene_ink(&shown, -55, -25, 55, 25) < 0.01);
    }
    dp_disable(context, DP_ALL_LINES);
}

static void send_roof(float x) {
    dp_vertex3f(context, x - 20, -40, -20), dp_vertex3f(context, x, -40, 0);
    dp_vertex3f(context, x, 40, 0), dp_vertex3f(context, x - 20, 40, -20);
    dp_vertex3f(context, x, -40, 0), dp_vertex3f(context, x + 20, -40, -20);
    dp_vertex3f(context, x + 20, 40, -20), dp_vertex3f(context, x, 40, 0);
}

/* State is taken at dp_begin: two ridges in one picture, each with its own width, colour and
 * theta. */
static void state_holds_at_begin(void **state) {
    const dp_camera camera = scene_flat_camera();
    (void)state;
    dp_set_camera(context, &camera);
    dp_enable(context, DP_RIDGE);
    dp_ridge_angle(context, 120);
    dp_line_width(context, DP_RIDGE, 3);
    dp_line_color(context, DP_RIDGE, DP_RGB(255, 0, 0));
    dp_begin(context, DP_QUADS);
    send_roof(-50);
    dp_end(context);
    dp_line_width(context, DP_RIDGE, 6);
    dp_line_color(context, DP_RIDGE, DP_RGB(0, 0, 255));
    dp_begin(context, DP_QUADS);
    send_roof(0);
    dp_end(context);
    dp_ridge_angle(context, 60); /* 90 degrees are no ridge any more */
    dp_begin(context, DP_QUADS);
    send_roof(50);
    dp_end(context);
    finish();
    const int row = 4 * SCENE_WIDTH * (SCENE_HEIGHT / 2);
    const uint8_t *red = shown.rgba + row + 4 * 50, *blue = shown.rgba + row + 4 * 100;
    const uint8_t *none = shown.rgba + row + 4 * 150;
    assert_true(red[0] == 255 && red[1] == 0 && red[2] == 0);
    assert_true(blue[0] == 0 && blue[1] == 0 && blue[2] == 255);
    assert_true(none[0] == 255 && none[1] == 255 && none[2] == 255);
    /* a coloured pixel counts two thirds */
    assert_in_range(scene_ink(&shown, -56, -20, -44, 20) * 1.5 / 40 * 100, 280, 320);
    assert_in_range(scene_ink(&shown, -9, -20, 9, 20) * 1.5 / 40 * 100, 580, 620);
    assert_in_range(scene_ink(&shown, 44, -20, 56, 20) * 100, 0, 1);
    dp_disable(context, DP_ALL_LINES);
    dp_ridge_angle(context, 150);
    dp_line_width(context, DP_RIDGE, 2);
    dp_line_color(context, DP_RIDGE, DP_RGB(0, 0, 0));
}

/* Nothing enabled: surfaces only; enabled and disabled again: the same. */
static void nothing_is_enabled_at_first(void **state) {
    const dp_camera camera = scene_flat_camera();
    dp_context *fresh = NULL;
    (void)state;
    assert_int_equal(dp_context_create(NULL, &fresh, NULL), DP_OK);
    dp_context *const before = context;
    context = fresh;
    dp_set_camera(context, &camera);
    dp_begin(context, DP_QUADS);
    send_roof(0);
    dp_end(context);
    finish();
    assert_true(ink() < 0.01);
    dp_enable(context, DP_ALL_LINES);
    dp_disable(context, DP_ALL_LINES);
    dp_begin(context, DP_QUADS);
    send_roof(0);
    dp_end(context);
    finish();
    assert_true(ink() < 0.01);
    dp_surface_color(context, DP_RGB(0, 0, 0));
    dp_begin(context, DP_QUADS);
    send_roof(0);
    dp_end(context);
    finish();
    assert_in_range(ink(), 40 * 80 - 40, 40 * 80 + 40);
    context = before;
    dp_context_destroy(fresh);
}

/* dp_finish forgets what was recorded. */
static void finish_forgets(void **state) {
    const dp_camera camera = scene_flat_camera();
    (void)state;
    dp_set_camera(context, &camera);
    dp_enable(context, DP_ALL_LINES);
    dp_begin(context, DP_QUADS);
    send_roof(-50);
    dp_end(context);
    finish();
    assert_true(scene_ink(&shown, -80, -50, -20, 50) > 100);
    dp_begin(context, DP_QUADS);
    send_roof(50);
    dp_end(context);
    finish();
    assert_true(scene_ink(&shown, -80, -50, -20, 50) < 0.01);
    assert_true(scene_ink(&shown, 20, -50, 80, 50) > 100);
    dp_disable(context, DP_ALL_LINES);
}

/* An edge whose flag is off does not draw. */
static void edge_flags_are_kept_per_edge(void **state) {
    const dp_camera camera = scene_flat_camera();
    (void)state;
    dp_set_camera(context, &camera);
    dp_enable(context, DP_BORDER);
    dp_begin(context, DP_POLYGON);
    dp_edge_flag(context, true);
    dp_vertex3f(context, -40, -30, 0);
    dp_edge_flag(context, false);
    dp_vertex3f(context, 40, -30, 0); /* the edge on the right */
    dp_edge_flag(context, true);
    dp_vertex3f(context, 40, 30, 0);
    dp_vertex3f(context, -40, 30, 0);
    dp_end(context);
    finish();
    assert_true(scene_ink(&shown, 35, -25, 45, 25) < 0.01);
    assert_true(scene_ink(&shown, -45, -25, -35, 25) > 90);
    assert_true(scene_ink(&shown, -35, 25, 35, 35) > 130);
    dp_disable(context, DP_ALL_LINES);
}

static void style_holds_for_the_whole_picture(void **state) {
    const dp_camera camera = scene_flat_camera();
    const dp_style style = {.paper = DP_RGB(10, 20, 30)};
    (void)state;
    dp_set_camera(context, &camera);
    dp_set_style(context, &style);
    dp_begin(context, DP_QUADS);
    send_roof(0);
    dp_end(context);
    finish();
    assert_int_equal(shown.rgba[0], 10);
    assert_int_equal(shown.rgba[1], 20);
    assert_int_equal(shown.rgba[2], 30);
    dp_set_style(context, &(const dp_style){0});
}

/* The next dp_finish reports the first wrong call and draws nothing; then all is well
 * again. */
static void expect_misuse(const char *what) {
    dp_diag diag = {0};
    memset(&shown, 0x5A, sizeof shown);
    if (dp_finish(context, &target, &diag) != DP_ERR_ARGUMENT) fail_msg("%s: not told", what);
    assert_int_equal(diag.result, DP_ERR_ARGUMENT);
    if (strstr(diag.message, what) == NULL)
        fail_msg("\"%s\" does not speak of %s", diag.message, what);
    assert_int_equal(shown.rgba[0], 0x5A);
    dp_begin(context, DP_QUADS);
    send_roof(0);
    dp_end(context);
    finish();
}

static void wrong_calls_are_told(void **state) {
    const dp_camera camera = scene_flat_camera();
    (void)state;
    dp_set_camera(context, &camera);
    dp_vertex3f(context, 0, 0, 0);
    expect_misuse("dp_vertex");
    dp_end(context);
    expect_misuse("dp_end");
    dp_begin(context, DP_TRIANGLES);
    dp_begin(context, DP_TRIANGLES);
    dp_end(context);
    expect_misuse("dp_begin");
    dp_begin(context, (dp_primitive_kind)77);
    dp_end(context);
    expect_misuse("dp_begin");
    dp_begin(context, DP_TRIANGLES);
    expect_misuse("dp_end"); /* missing */
    dp_enable(context, 1u << 20);
    expect_misuse("class");
    dp_disable(context, 1u << 20);
    expect_misuse("class");
    dp_line_width(context, DP_RIDGE, -3);
    expect_misuse("width");
    dp_ridge_angle(context, 400);
    expect_misuse("angle");
    dp_valley_angle(context, -1);
    expect_misuse("angle");
    dp_begin(context, DP_TRIANGLES);
    dp_set_camera(context, &camera);
    dp_end(context);
    /* allowed or not, the picture is one camera's: only no crash */
    (void)dp_finish(context, &target, NULL);
}

/* A picture without polygons is the paper. */
static void nothing_recorded_is_paper(void **state) {
    dp_diag diag = {0};
    const dp_camera camera = scene_flat_camera();
    (void)state;
    dp_set_camera(context, &camera);
    const dp_result result = dp_finish(context, &target, &diag);
    if (result != DP_OK) fail_msg("%s", diag.message);
    assert_true(ink() < 0.01);
}

/* Far more vertices than any first allocation. */
static void many_polygons(void **state) {
    const dp_camera camera = scene_flat_camera();
    dp_stats stats;
    (void)state;
    dp_set_camera(context, &camera);
    dp_enable(context, DP_ALL_LINES);
    dp_begin(context, DP_TRIANGLES);
    for (int i = 0; i < 50000; i++) {
        const float x = (float)(i % 200 - 100), y = (float)(i / 200 % 120 - 60);
        dp_vertex3f(context, x, y, 0), dp_vertex3f(context, x + 1, y, 0),
            dp_vertex3f(context, x, y + 1, 0);
    }
    dp_end(context);
    finish();
    dp_stats_of(context, &stats);
    assert_int_equal(stats.polygons, 50000);
    dp_disable(context, DP_ALL_LINES);
}

static int make_context(void **state) {
    (void)state;
    return dp_context_create(NULL, &context, NULL) == DP_OK ? 0 : -1;
}

static int destroy_context(void **state) {
    (void)state;
    dp_context_destroy(context);
    return 0;
}

/* An allocator that counts its blocks. */
static void *counted_alloc(size_t size, void *user) {
    void *const block = malloc(size);
    if (block) ++*(long *)user;
    return block;
}
static void *counted_realloc(void *block, size_t size, void *user) {
    void *const moved = realloc(block, size);
    if (moved && !block) ++*(long *)user;
    return moved;
}
static void counted_free(void *block, void *user) {
    if (block) --*(long *)user;
    free(block);
}

/* Polygons of any number of corners are given back with the context, all of them. */
static void nothing_is_left_behind(void **state) {
    long blocks = 0;
    const dp_allocator counting = {counted_alloc, counted_realloc, counted_free, &blocks};
    const dp_context_desc desc = {.allocator = &counting, .threads = 1};
    const dp_camera camera = scene_flat_camera();
    dp_context *own = NULL;
    (void)state;
    assert_int_equal(dp_context_create(&desc, &own, NULL), DP_OK);
    dp_set_camera(own, &camera);
    dp_enable(own, DP_ALL_LINES);
    for (int corners = 3; corners < 40; corners += 4) { /* a star: every other one further in */
        dp_begin(own, DP_POLYGON);
        for (int i = 0; i < corners; i++) {
            const double turn = 2 * 3.14159265358979 * i / corners, reach = i % 2 ? 20 : 50;
            dp_vertex3f(own, (float)(reach * cos(turn)), (float)(reach * sin(turn)),
                        (float)-corners);
        }
        dp_end(own);
    }
    assert_int_equal(dp_finish(own, &target, NULL), DP_OK);
    dp_context_destroy(own);
    assert_int_equal(blocks, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(figure_3_draws_what_the_batch_draws),
        cmocka_unit_test(a_lone_corner_needs_borders),
        cmocka_unit_test(every_kind_of_primitive),
        cmocka_unit_test(strips_are_wound_consistently),
        cmocka_unit_test(state_holds_at_begin),
        cmocka_unit_test(nothing_is_enabled_at_first),
        cmocka_unit_test(finish_forgets),
        cmocka_unit_test(edge_flags_are_kept_per_edge),
        cmocka_unit_test(style_holds_for_the_whole_picture),
        cmocka_unit_test(wrong_calls_are_told),
        cmocka_unit_test(nothing_recorded_is_paper),
        cmocka_unit_test(many_polygons),
        cmocka_unit_test(nothing_is_left_behind),
    };
    return cmocka_run_group_tests(tests, make_context, destroy_context);
}
