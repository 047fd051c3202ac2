/* sink/ink: strokes on sections' faces, which are often seen at a grazing angle. */
#include "scene.h"
#include <drypoint/drypoint.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* A long box, cut by a plane that recedes by `slope` units for each one that it rises on the screen;
 * its far edge is 20 px above the middle. */
static void draw_face(double slope, picture *out) {
    static scene shown;
    memset(&shown, 0, sizeof shown);
    const float far = (float)(20 * slope), min[3] = {-40, -50, -far}, max[3] = {40, 50, far};
    scene_box(&shown, min, max);
    const dp_batch batch = scene_batch(&shown);
    dp_source *whole, *source;
    assert_int_equal(dp_source_from_arrays(&batch, NULL, &whole, NULL), DP_OK);
    const dp_clip clip = {.planes = {{{0, slope, 1}, 0}}, .plane_count = 1, .hatch_spacing = 1000};
    assert_int_equal(dp_source_clip(whole, &clip, NULL, &source, NULL), DP_OK);
    dp_context *context;
    assert_int_equal(dp_context_create(NULL, &context, NULL), DP_OK);
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
        cmocka_unit_test(faces_do_not_cut_their_outlines),
    };
    return cmocka_run_group_tests_name("section ink", tests, NULL, NULL);
}
