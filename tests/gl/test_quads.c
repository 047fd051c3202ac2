/* Added polygons as ink on graphics hardware (Raskar 2001): pictures beside those of dp_draw, with the same style. */
#include "gl/context.h"

#include <drypoint/shapes.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 220, HEIGHT = 160 };

/* A model and how it is looked at. */
typedef struct scene {
    const char *shape;
    bool orthographic;
    uint32_t samples, triangles;
} scene;

static dp_camera camera_of(dp_source *source, const scene *s) {
    dp_camera camera;
    const dp_fit fit = {.aspect = (double)WIDTH / HEIGHT, .orthographic = s->orthographic};
    assert_int_equal(dp_camera_fit_source(&camera, &fit, source, NULL, NULL), DP_OK);
    return camera;
}

static void keep(const char *kind, const scene *s, const dp_style *style, const uint8_t *rgba) {
    char name[120];
    snprintf(name, sizeof name, "quads-%s-%d-%d-%d-%s-%u-%s", s->shape, (int)style->method,
             (int)style->between, style->passes, s->orthographic ? "ortho" : "persp", s->samples,
             kind);
    gl_test_keep(name, rgba, WIDTH, HEIGHT);
}

/* Share of pixels within `levels` of the CPU's. */
static double alike(gl_test *t, const scene *s, const dp_style *style, int levels) {
    dp_source *source;
    if (!t->gl) skip();
    const dp_shape made = {.name = s->shape, .triangles = s->triangles ? s->triangles : 1500};
    assert_int_equal(dp_source_from_shape(&made, &source, NULL), DP_OK);
    const dp_camera camera = camera_of(source, s);
    uint8_t *const gpu = gl_test_draw(t, source, &camera, style, WIDTH, HEIGHT, s->samples),
                   *const cpu =
                       gl_test_draw_cpu(source, &camera, style, WIDTH, HEIGHT, s->samples);
    keep("gpu", s, style, gpu), keep("cpu", s, style, cpu);
    const double share = gl_test_alike(gpu, cpu, WIDTH, HEIGHT, levels);
    free(gpu), free(cpu);
    dp_source_destroy(source);
    return share;
}

#include <time.h>
static void prints_all(void **state) {
    setvbuf(stdout, NULL, _IONBF, 0);
    const char *const shapes[] = {"bracket", "gear", "torus", "boxes"};
    const char *const betweens[] = {"plane", "interval", "interval 2", "stencil"};
    for (int i = 0; i < 4; i++)
        for (int m = 0; m < 2; m++)
            for (int b = 0; b < 4; b++)
                for (int o = 0; o < 2; o++)
                    for (int n = 0; n < 2; n++) {
                        const scene s = {shapes[i], o, n ? 4 : 1, 0};
                        dp_style style = {.ink = DP_INK_QUADS, .method = m ? DP_METHOD_PAPER : DP_METHOD_EXACT,
                            .between = b == 0 ? DP_BETWEEN_PLANE : b == 3 ? DP_BETWEEN_STENCIL : DP_BETWEEN_INTERVAL,
                            .passes = b == 2 ? 2 : 0};
                        style.line[0] = (dp_line_style){3, DP_RGB(200,0,0)};
                        style.line[1] = (dp_line_style){3, DP_RGB(0,0,200)};
                        style.line[2] = (dp_line_style){4, DP_RGB(0,160,0)};
                        style.line[3] = (dp_line_style){3, DP_RGB(200,0,200)};
                        if (getenv("Q_M") && atoi(getenv("Q_M")) != m) continue;
                        if (getenv("Q_B") && !strchr(getenv("Q_B"), '0' + b)) continue;
                        if (getenv("Q_S") && atoi(getenv("Q_S")) != i) continue;
                        if (getenv("Q_N") && atoi(getenv("Q_N")) != n) continue;
                        printf("%ld ", (long)(clock() / 1000));
                        printf("%-8s %-6s %-11s %-6s %u: %.5f\n", s.shape, m ? "paper" : "exact", betweens[b], o ? "ortho" : "persp", s.samples,
                               alike(*state, &s, &style, 2));
                    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(prints_all)};
    return cmocka_run_group_tests(tests, gl_test_setup, gl_test_teardown);
}
