/* Small pictures of generated models, for tests of contexts. */
#ifndef DRAWING_H
#define DRAWING_H

#include <drypoint/drypoint.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

enum { WIDTH = 160, HEIGHT = 120, BYTES = 4 * WIDTH * HEIGHT };

static inline dp_source *new_shape(const char *name, const dp_allocator *allocator) {
    const dp_shape shape = {.name = name, .triangles = 2000, .allocator = allocator};
    dp_source *source = NULL;
    dp_diag diag = {0};
    if (dp_source_from_shape(&shape, &source, &diag) != DP_OK && allocator == NULL)
        fail_msg("%s", diag.message);
    return source;
}

static inline dp_camera camera_of(double x, double y, double z) {
    dp_camera camera = {{0}, {0}};
    dp_camera_look_at(&camera, (const double[3]){x, y, z}, (const double[3]){0, 0, 0},
                      (const double[3]){0, 1, 0});
    dp_camera_perspective(&camera, 40, (double)WIDTH / HEIGHT, 0.1, 20);
    return camera;
}

static inline dp_result draw(dp_context *context, dp_source *source, uint8_t *rgba, dp_diag *diag) {
    const dp_camera camera = camera_of(2, 1.5, 2.5);
    const dp_target target = {.width = WIDTH, .height = HEIGHT, .rgba = rgba};
    return dp_draw(context, source, &camera, NULL, &target, diag);
}

#endif
