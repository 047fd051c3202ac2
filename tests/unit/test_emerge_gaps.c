/* find/emerge: lines of which the edge table does not know everything must not have gaps. Of edges that
 * run along each other one makes the line, and it must be one that emerges; outlines are whole where
 * a triangle beside them is seen nearly edge-on. */
#include "scene.h"
#include <drypoint/drypoint.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static dp_context *new_context(void) {
    dp_context *context;
    assert_int_equal(dp_context_create(NULL, &context, NULL), DP_OK);
    return context;
}

/* px: visible lines of the class. */
static double drawn(dp_context *context, dp_line line) {
    size_t count;
    const dp_segment *const s = dp_segments(context, &count);
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        if (s[i].line == line)
            sum +=
                hypot((double)s[i].b[0] - (double)s[i].a[0], (double)s[i].b[1] - (double)s[i].a[1]);
    return sum;
}

/* A table's top of squares of one unit, 10 by 10. */
static void add_top(scene *s) {
    for (int z = -5; z < 5; z++)
        for (int x = -5; x < 5; x++) {
            const float x0 = (float)x, x1 = (float)x + 1, z0 = (float)z, z1 = (float)z + 1;
            const float corners[4][3] = {{x0, 0, z0}, {x0, 0, z1}, {x1, 0, z1}, {x1, 0, z0}};
            scene_polygon(s, 4, corners);
        }
}

static void add_box(scene *s) {
    const float min[3] = {-1.25f, 0, -2.5f}, max[3] = {1.5f, 2, 1};
    scene_box(s, min, max);
}

/* A box stands on a table: one of its edges runs along those of the table's squares, which are flat,
 * and one does not. Which comes first in the source does not matter. */
static void what_stands_on_flat_edges_has_a_line(void **state) {
    (void)state;
    static scene s;
    static picture out;
    dp_context *const context = new_context();
    const dp_camera camera = scene_camera(6, 5, 9, 0, 0, 0);
    double valley[2];
    for (int box_first = 0; box_first < 2; box_first++) {
        memset(&s, 0, sizeof s);
        if (box_first) add_box(&s);
        add_top(&s);
        if (!box_first) add_box(&s);
        assert_int_equal(scene_draw(context, &s, &camera, NULL, &out, NULL), DP_OK);
        valley[box_first] = drawn(context, DP_LINE_VALLEY);
    }
    assert_true(valley[1] > 40);
    assert_true(fabs(valley[0] - valley[1]) < 0.5);
    dp_context_destroy(context);
}

/* Is there ink of an outline within a pixel? */
static bool is_outlined(const picture *p, int x, int y) {
    for (int v = y - 1; v <= y + 1; v++)
        for (int u = x - 1; u <= x + 1; u++)
            if (u >= 0 && v >= 0 && u < SCENE_WIDTH && v < SCENE_HEIGHT &&
                p->line_class[v * SCENE_WIDTH + u] == 1 + DP_LINE_SILHOUETTE)
                return true;
    return false;
}

static int count_gaps(const picture *p) {
    int gaps = 0;
    for (int y = 1; y + 1 < SCENE_HEIGHT; y++)
        for (int x = 1; x + 1 < SCENE_WIDTH; x++) {
            const float *const d = p->depth + y * SCENE_WIDTH + x;
            if (isinf(*d)) continue;
            const bool is_border =
                isinf(d[-1]) || isinf(d[1]) || isinf(d[-SCENE_WIDTH]) || isinf(d[SCENE_WIDTH]);
            gaps += is_border && !is_outlined(p, x, y);
        }
    return gaps;
}

/* All around a model that is seen before nothing there is an outline, however it bends. */
static void outlines_are_closed(void **state) {
    (void)state;
    static picture out;
    const dp_shape torus = {.name = "torus"};
    const dp_deform bent = {.kind = DP_DEFORM_WAVE, .amplitude = 0.1};
    const dp_style thin = {.line[DP_LINE_SILHOUETTE].width = 1};
    const dp_target target = {.width = SCENE_WIDTH,
                              .height = SCENE_HEIGHT,
                              .rgba = out.rgba,
                              .depth = out.depth,
                              .line_class = out.line_class};
    dp_source *whole, *source;
    assert_int_equal(dp_source_from_shape(&torus, &whole, NULL), DP_OK);
    assert_int_equal(dp_source_deform(whole, &bent, NULL, &source, NULL), DP_OK);
    dp_context *const context = new_context();
    for (int frame = 0; frame < 120; frame++) {
        const double turn = frame * 0.37;
        const dp_camera camera = scene_camera(2.2 * sin(turn), 1, 2.2 * cos(turn), 0, 0, 0);
        assert_int_equal(dp_source_set_time(source, frame / 120.0, NULL), DP_OK);
        assert_int_equal(dp_source_rewind(source, NULL), DP_OK);
        assert_int_equal(dp_draw(context, source, &camera, &thin, &target, NULL), DP_OK);
        assert_int_equal(count_gaps(&out), 0);
    }
    dp_context_destroy(context);
    dp_source_destroy(source);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_stands_on_flat_edges_has_a_line),
        cmocka_unit_test(outlines_are_closed),
    };
    return cmocka_run_group_tests_name("emerge gaps", tests, NULL, NULL);
}
