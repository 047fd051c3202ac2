/* Scenes that tests of sinks and segments draw. Include after cmocka's headers. */
#ifndef TESTS_UNIT_SINK_SCENE_H
#define TESTS_UNIT_SINK_SCENE_H

#include "scene.h"

enum { EYE = 260 }; /* both cameras look from +z at the middle */

static dp_context *context;
static picture shown;
static scene made;

static inline int make_context(void **state) {
    (void)state;
    return dp_context_create(NULL, &context, NULL) == DP_OK ? 0 : -1;
}

static inline int destroy_context(void **state) {
    (void)state;
    dp_context_destroy(context);
    return 0;
}

/* ------- scenes ------- */

static inline double random_number(uint32_t *state) {
    *state = *state * 1664525u + 1013904223u;
    return (*state >> 8) / 16777216.0;
}

static inline void make_triangles(uint32_t seed, int count, double spread) {
    made.corners = made.polygons = 0;
    for (int i = 0; i < count; i++) {
        float at[3][3];
        const double x = spread * (random_number(&seed) - 0.5) * SCENE_WIDTH,
                     y = spread * (random_number(&seed) - 0.5) * SCENE_HEIGHT,
                     z = 160 * (random_number(&seed) - 0.5);
        for (int c = 0; c < 3; c++) {
            at[c][0] = (float)(x + 70 * (random_number(&seed) - 0.5));
            at[c][1] = (float)(y + 70 * (random_number(&seed) - 0.5));
            at[c][2] = (float)(z + 70 * (random_number(&seed) - 0.5));
        }
        scene_polygon(&made, 3, (const float(*)[3])at);
    }
}

static inline void make_boxes(void) {
    made.corners = made.polygons = 0;
    scene_box(&made, (const float[3]){-60, -30, -20}, (const float[3]){10, 25, 30});
    scene_box(&made, (const float[3]){-20, -45, -35}, (const float[3]){45, 5, 12});
}

static inline dp_result try_draw(const dp_camera *camera, const dp_style *style) {
    dp_diag diag = {0};
    return scene_draw(context, &made, camera, style, &shown, &diag);
}

static inline void draw(const dp_camera *camera, const dp_style *style) {
    assert_int_equal(try_draw(camera, style), DP_OK);
}

static inline void draw_boxes(const dp_style *style) {
    const dp_camera camera = scene_camera(120, 90, 160, 0, 0, 0);
    make_boxes();
    draw(&camera, style);
}

#endif
