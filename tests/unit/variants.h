/* Scenes in every way to ink and to shape added polygons, for tests that draw them all. */
#ifndef VARIANTS_H
#define VARIANTS_H

#include "scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

static dp_context *context;
static picture shown;

static inline scene *new_scene(void) {
    scene *made = calloc(1, sizeof *made);
    if (made == NULL) abort();
    return made;
}

static inline void draw(const scene *what, const dp_camera *camera, const dp_style *style) {
    dp_diag diag = {0};
    if (scene_draw(context, what, camera, style, &shown, &diag) != DP_OK)
        fail_msg("dp_draw: %s", diag.message);
}

static inline void draw_flat(const scene *what, const dp_style *style) {
    const dp_camera camera = scene_flat_camera();
    draw(what, &camera, style);
}

/* Every way to ink and to shape the added polygons. */
typedef struct variant {
    const char *name;
    dp_method method;
    dp_ink ink;
    dp_between between;
    double least, most; /* share of the width asked for that must be there */
} variant;

/* The interval and stencil tests draw a valley on one of its sides, where the polygon that was
 * drawn first lies; how wide depends on the angles. */
static const variant variants[] = {
    {"exact strokes", DP_METHOD_EXACT, DP_INK_STROKES, DP_BETWEEN_PLANE, 0.97, 1.03},
    {"paper strokes", DP_METHOD_PAPER, DP_INK_STROKES, DP_BETWEEN_PLANE, 0.97, 1.03},
    {"exact quads", DP_METHOD_EXACT, DP_INK_QUADS, DP_BETWEEN_PLANE, 0.8, 1.2},
    {"paper quads", DP_METHOD_PAPER, DP_INK_QUADS, DP_BETWEEN_PLANE, 0.2, 2.2},
    {"exact interval", DP_METHOD_EXACT, DP_INK_QUADS, DP_BETWEEN_INTERVAL, 0.2, 1.2},
    {"paper interval", DP_METHOD_PAPER, DP_INK_QUADS, DP_BETWEEN_INTERVAL, 0.2, 2.2},
    {"exact stencil", DP_METHOD_EXACT, DP_INK_QUADS, DP_BETWEEN_STENCIL, 0.2, 2.2},
    {"paper stencil", DP_METHOD_PAPER, DP_INK_QUADS, DP_BETWEEN_STENCIL, 0.2, 2.2},
};
enum { VARIANTS = sizeof variants / sizeof *variants };

static inline dp_style style_of(const variant *v, uint32_t lines, double theta, double phi,
                                float px) {
    dp_style style = {.lines = lines,
                      .method = v->method,
                      .ink = v->ink,
                      .between = v->between,
                      .ridge_angle = (float)theta,
                      .valley_angle = (float)phi};
    for (int k = 0; k < DP_LINE_COUNT; k++) style.line[k].width = px;
    return style;
}

static inline int make_context(void **state) {
    (void)state;
    return dp_context_create(NULL, &context, NULL) == DP_OK ? 0 : -1;
}

static inline int destroy_context(void **state) {
    (void)state;
    dp_context_destroy(context);
    return 0;
}

#endif
