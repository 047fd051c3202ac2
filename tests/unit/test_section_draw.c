/* Sections as they are drawn: which lines there are, and strokes on faces, which are often seen at a
 * grazing angle (sink/ink). */
#include "base/vec.h"
#include "scene.h"
#include <drypoint/drypoint.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static scene shown;

static void box(float x0, float y0, float z0, float x1, float y1, float z1) {
    scene_box(&shown, (const float[]){x0, y0, z0}, (const float[]){x1, y1, z1});
}

/* What a clip leaves of the scene that is shown. */
static dp_source *clipped(const dp_clip *clip) {
    const dp_batch batch = scene_batch(&shown);
    dp_source *whole, *out;
    dp_diag diag = {0};
    assert_int_equal(dp_source_from_arrays(&batch, NULL, &whole, NULL), DP_OK);
    if (dp_source_clip(whole, clip, NULL, &out, &diag)) fail_msg("%s", diag.message);
    return out;
}

static dp_context *new_context(uint32_t threads) {
    const dp_context_desc desc = {.threads = threads};
    dp_context *context;
    assert_int_equal(dp_context_create(&desc, &context, NULL), DP_OK);
    return context;
}

/* The length of all visible segments of a class, px. */
static double drawn(dp_context *context, dp_line line) {
    size_t count;
    const dp_segment *const s = dp_segments(context, &count);
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        if (s[i].line == line && !s[i].level)
            sum +=
                hypot((double)s[i].b[0] - (double)s[i].a[0], (double)s[i].b[1] - (double)s[i].a[1]);
    return sum;
}

/* A cube from above, cut: the outline of the face is a section, no crease, crossing or border. */
static void a_section_is_drawn(void **state) {
    (void)state;
    static picture out;
    const dp_clip clip = {.planes = {{{0, 0, 1}, 0}}, .plane_count = 1, .hatch_spacing = 10};
    memset(&shown, 0, sizeof shown);
    box(-40, -30, -20, 40, 30, 20);
    dp_source *const source = clipped(&clip);
    dp_context *const context = new_context(2);
    const dp_camera camera = scene_flat_camera();
    const dp_style style = {.line[DP_LINE_SECTION].color = DP_RGB(255, 0, 0),
                            .section = DP_RGB(0, 200, 0),
                            .line[DP_LINE_HATCHING].color = DP_RGB(0, 0, 255)};
    const dp_target target = {.width = SCENE_WIDTH,
                              .height = SCENE_HEIGHT,
                              .rgba = out.rgba,
                              .line_class = out.line_class};
    dp_diag diag = {0};
    if (dp_draw(context, source, &camera, &style, &target, &diag)) fail_msg("%s", diag.message);
    assert_true(fabs(drawn(context, DP_LINE_SECTION) - 2 * (80 + 60)) < 0.01 * 2 * (80 + 60));
    assert_true(fabs(drawn(context, DP_LINE_HATCHING) - 80 * 60 / 10.0) < 0.05 * 80 * 60 / 10);
    for (int line = DP_LINE_RIDGE; line < DP_LINE_SECTION; line++)
        assert_true(drawn(context, (dp_line)line) == 0);
    dp_stats stats;
    dp_stats_of(context, &stats);
    assert_int_equal(stats.dropped, 0);
    const uint8_t *const middle =
        out.rgba + 4 * (SCENE_WIDTH * (SCENE_HEIGHT / 2) + SCENE_WIDTH / 2 + 5);
    assert_int_equal(middle[0], 0);
    assert_int_equal(middle[1], 200);
    /* not asked for, not drawn */
    const dp_style bare = {.lines = DP_SILHOUETTE | DP_HATCHING};
    assert_int_equal(dp_draw(context, source, &camera, &bare, &target, NULL), DP_OK);
    assert_true(drawn(context, DP_LINE_SECTION) == 0);
    assert_true(drawn(context, DP_LINE_HATCHING) > 0);
    dp_context_destroy(context);
    dp_source_destroy(source);
}

/* Behind what hides a face its outline is a hidden line; hatching is none. */
static void hidden_faces_are_not_hatched(void **state) {
    (void)state;
    static picture out;
    const dp_clip clip = {.planes = {{{0, 0, -1}, 0}}, .plane_count = 1, .hatch_spacing = 10};
    memset(&shown, 0, sizeof shown);
    box(-40, -30, -20, 40, 30, 20);
    box(-10, -10, -20, 10, 10, 40);
    dp_source *const source = clipped(&clip);
    dp_context *const context = new_context(2);
    const dp_camera camera = scene_flat_camera();
    const dp_style style = {.hidden.look = DP_HIDDEN_DASHED};
    const dp_target target = {.width = SCENE_WIDTH, .height = SCENE_HEIGHT, .rgba = out.rgba};
    assert_int_equal(dp_draw(context, source, &camera, &style, &target, NULL), DP_OK);
    size_t count, hidden = 0;
    const dp_segment *const s = dp_segments(context, &count);
    for (size_t i = 0; i < count; i++) {
        assert_true(s[i].line != DP_LINE_HATCHING);
        hidden += s[i].line == DP_LINE_SECTION && s[i].level == 1;
    }
    assert_true(hidden >= 4);
    dp_context_destroy(context);
    dp_source_destroy(source);
}

static void what_sections_exclude_is_told(void **state) {
    (void)state;
    static picture out;
    const dp_clip half_z = {.planes = {{{0, 0, 1}, 0}}, .plane_count = 1};
    memset(&shown, 0, sizeof shown);
    box(-40, -30, -20, 40, 30, 20);
    dp_source *const source = clipped(&half_z);
    dp_context *const context = new_context(1);
    const dp_camera camera = scene_flat_camera();
    const dp_target target = {.width = SCENE_WIDTH, .height = SCENE_HEIGHT, .rgba = out.rgba};
    const dp_style smooth = {.smooth = DP_SMOOTH_SURFACE};
    dp_diag diag = {0};
    assert_int_equal(dp_draw(context, source, &camera, &smooth, &target, &diag),
                     DP_ERR_UNSUPPORTED);
    assert_non_null(strstr(diag.message, "sections"));
    const dp_style usual = {0};
    assert_int_equal(dp_draw(context, source, &camera, &usual, &target, &diag), DP_OK);
    dp_context_destroy(context);
    dp_source_destroy(source);
}

/* A long box, cut by a plane that recedes by `slope` units for each one that it rises on the screen;
 * its far edge is 20 px above the middle. */
static void draw_face(double slope, picture *out) {
    memset(&shown, 0, sizeof shown);
    const float far = (float)(20 * slope);
    box(-40, -50, -far, 40, 50, far);
    const dp_clip clip = {.planes = {{{0, slope, 1}, 0}}, .plane_count = 1, .hatch_spacing = 1000};
    dp_source *const source = clipped(&clip);
    dp_context *const context = new_context(0);
    const dp_camera camera = scene_flat_camera();
    const dp_style style = {.line[DP_LINE_SECTION] = {.color = DP_RGB(255, 0, 0), .width = 12}};
    const dp_target target = {.width = SCENE_WIDTH, .height = SCENE_HEIGHT, .rgba = out->rgba};
    assert_int_equal(dp_draw(context, source, &camera, &style, &target, NULL), DP_OK);
    dp_context_destroy(context);
    dp_source_destroy(source);
}

static bool is_red(const picture *p, int x, int y) {
    const uint8_t *const pixel = p->rgba + 4 * (SCENE_WIDTH * y + x);
    return pixel[0] > 250 && pixel[1] < 5 && pixel[2] < 5;
}

/* The half of the far edge's stroke that lies on the face is as wide as the other one. */
static void faces_do_not_cut_their_outlines(void **state) {
    (void)state;
    static picture out;
    static const double slopes[] = {1, 7, 15, 20};
    for (size_t i = 0; i < sizeof slopes / sizeof *slopes; i++) {
        draw_face(slopes[i], &out);
        const int edge = SCENE_HEIGHT / 2 - 20, middle = SCENE_WIDTH / 2;
        for (int x = middle - 30; x < middle + 30; x++) {
            for (int y = edge - 5; y < edge + 5; y++) assert_true(is_red(&out, x, y));
            assert_false(is_red(&out, x, edge - 8));
            assert_false(is_red(&out, x, edge + 8));
        }
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_section_is_drawn),
        cmocka_unit_test(hidden_faces_are_not_hatched),
        cmocka_unit_test(what_sections_exclude_is_told),
        cmocka_unit_test(faces_do_not_cut_their_outlines),
    };
    return cmocka_run_group_tests_name("sections as they are drawn", tests, NULL, NULL);
}
