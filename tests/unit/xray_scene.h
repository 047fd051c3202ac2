/* Scenes for tests of x-rays. Include after cmocka's headers. */
#ifndef TESTS_UNIT_XRAY_SCENE_H
#define TESTS_UNIT_XRAY_SCENE_H

#include <drypoint/immediate.h>

#include "sink_scene.h"

enum { W = SCENE_WIDTH, H = SCENE_HEIGHT };

typedef struct canvas {
    uint8_t rgba[4 * W * H];
    float depth[W * H];
    uint16_t id[W * H];
} canvas;

static canvas first;

static inline dp_stats draw_on(canvas *c, const dp_camera *camera, const dp_style *style,
                               uint32_t samples) {
    dp_batch batch = scene_batch(&made);
    if (made.corners == 3 * made.polygons) batch.firsts = NULL; /* triangles have kernels */
    const dp_target target = {.width = W,
                              .height = H,
                              .samples = samples,
                              .rgba = c->rgba,
                              .depth = c->depth,
                              .id = c->id};
    dp_source *source;
    dp_diag diag = {0};
    assert_int_equal(dp_source_from_arrays(&batch, NULL, &source, NULL), DP_OK);
    if (dp_draw(context, source, camera, style, &target, &diag)) fail_msg("%s", diag.message);
    dp_source_destroy(source);
    dp_stats stats;
    dp_stats_of(context, &stats);
    return stats;
}

static inline const uint8_t *pixel_of(const canvas *c, int x, int y) {
    return c->rgba + 4 * (y * W + x);
}

static const dp_color surface = DP_RGB(200, 120, 40), paper = DP_RGB(240, 250, 230);
static float opacities[SCENE_POLYGONS];
static dp_color surfaces[SCENE_POLYGONS];

/* Gives all polygons one look. */
static inline void one_look(float opacity, dp_color color) {
    for (size_t i = 0; i < SCENE_POLYGONS; i++) opacities[i] = opacity, surfaces[i] = color;
}

/* ------- groups ------- */

static inline void put_polygon(size_t i) {
    dp_begin(context, DP_POLYGON);
    for (uint32_t k = made.firsts[i]; k < made.firsts[i + 1]; k++)
        dp_vertex3fv(context, made.positions[k]);
    dp_end(context);
}

static inline dp_stats draw_groups(canvas *c, const dp_camera *camera,
                                   const dp_style *picture_style, uint32_t samples) {
    const dp_target target = {.width = W,
                              .height = H,
                              .samples = samples,
                              .rgba = c->rgba,
                              .depth = c->depth,
                              .id = c->id};
    dp_diag diag = {0};
    dp_stats stats;
    dp_set_style(context, picture_style);
    dp_set_camera(context, camera);
    for (size_t i = 0; i < made.polygons; i++) {
        dp_surface_opacity(context, opacities[i]);
        dp_surface_color(context, surfaces[i]);
        put_polygon(i);
    }
    if (dp_finish(context, &target, &diag)) fail_msg("%s", diag.message);
    dp_stats_of(context, &stats);
    return stats;
}

/* Plates before a roof whose ridge runs down the middle. */
static inline void make_plates(int count) {
    made.corners = made.polygons = 0;
    scene_roof(&made, 90, 30);
    for (int i = 0; i < count; i++) scene_wall(&made, -70, 20 + 9 * i, 70, 20 + 9 * i, 55);
}

/* What a surface of some opacity leaves of a value under it. */
static inline double over(double ink, double under, double opacity) {
    return opacity * ink + (1 - opacity) * under;
}

#endif
